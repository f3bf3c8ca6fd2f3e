//! A drawing of the linkage.

use coupler_curves::motion;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{Options, PoseChoice};
use coupler_drawing::plate::{self, PAPER, moving_view};
use coupler_drawing::render::{self, TextMode};

use super::cognates;
use super::inspection::Inspection;

/// An SVG of the linkage: animated, in its pose at the requested input, or in the clearest pose.
pub(super) fn plate(inspection: &Inspection, animate: bool) -> Vec<u8> {
    let Inspection { family, poses, cognates, .. } = inspection;
    let solved = cognates.as_ref().map_or(&inspection.solved, |cognate_set| &cognate_set.assembled);
    let pose = match poses.first() {
        _ if animate => animated_pose(solved),
        Some(pose) => PoseChoice::Fixed(motion::pose(&solved.linkage, &pose.pass, pose.input)),
        None => PoseChoice::Clearest,
    };
    let options = Options::for_paper(PAPER);
    let scene = match cognates {
        Some(cognate_set) => {
            let title = format!("{} and its cognates", family.title);
            plate::compose_panel(family, &title, cognates::panel(inspection, cognate_set).with_pose(pose), &options)
        }
        None => plate::compose_cell(family, solved, pose, &options),
    };
    render::svg(&scene, TextMode::Text)
}

/// The poses of the first circuit, one after another.
fn animated_pose(solved: &SolvedCell) -> PoseChoice {
    solved.motion.circuits.first().map_or(PoseChoice::Clearest, |circuit| moving_view(&solved.linkage, circuit, 1))
}
