use coupler_atlas::geometry::Point;
use coupler_atlas::linkage::Input;
use coupler_atlas::motion::{self, Motion, Sampler, Sampling};
use coupler_atlas::page::{self, Heading, Layout, Options, Panel, Paper, Sheet, View};
use coupler_atlas::render::{self, TextMode};
use coupler_atlas::sweep::Solved;

use super::{Report, cognates};

/// One plate of the linkage, as SVG: in the pose asked for, moving, or where it can be seen best.
pub(super) fn plate(report: &Report, animate: bool) -> Vec<u8> {
    let Report { family, solved, poses, cognates, .. } = report;
    let template = &family.template;
    let [caption, note] = family.describe(&solved.cell, solved.measures());
    let facts = page::facts(solved);
    let own = || Panel { caption, note, facts, solved, view: View::Clearest, inks: Vec::new() };
    let panel = cognates.as_ref().map_or_else(own, |found| cognates::panel(report, found));
    let view = match poses.first() {
        _ if animate => moving(panel.solved),
        Some(pose) => View::At(motion::pose(&panel.solved.linkage, pose.pass, pose.input)),
        None => View::Clearest,
    };
    let panel = Panel { view, ..panel };
    let title = if cognates.is_some() { format!("{} and its cognates", family.title) } else { family.title.clone() };
    let heading = Heading {
        atlas: "coupler-atlas",
        family: &family.id,
        title: &title,
        source: template.source.clone(),
        symbols: &family.names,
        page: 1,
        of: 1,
    };
    let sheet = Sheet { heading, layout: Layout::Panels { columns: 1, rows: 1 }, panels: vec![panel] };
    let options = Options::on(Paper { width: 200.0, height: 150.0 });
    render::svg(&page::compose(&sheet, &options), TextMode::Text)
}

/// The poses of the first circuit, slower towards its limits, as a crank is that is turned by hand; there and back
/// where it does not close.
fn moving(solved: &Solved) -> View {
    /// Between two poses places go straight: over 3 degrees no pin is off its circle by more than a thousandth of its
    /// radius.
    const STEP_DEG: f64 = 3.0;
    const SECONDS_TO_A_TURN: f64 = 4.0;
    let Some(circuit) = solved.motion.circuits.first() else { return View::Clearest };
    let turns = match solved.linkage.input() {
        Input::Angle { .. } => circuit.passes.iter().map(|pass| pass.length() / 360.0).sum::<f64>().max(0.25),
        Input::Length => 1.0,
    };
    let frames = (turns * 360.0 / STEP_DEG).ceil() as usize;
    let motion = Motion::of(&solved.linkage, &Sampler::new(Sampling::Smooth(frames)));
    let Some(circuit) = motion.circuits.first() else { return View::Clearest };
    let joints = solved.linkage.joints.len();
    let pose = |sample: usize| (0..joints).map(|joint| circuit.places.point(joint, sample)).collect::<Vec<Point>>();
    let is_defined = |pose: &Vec<Point>| pose.iter().all(|p| p.x.is_finite() && p.y.is_finite());
    let mut poses: Vec<Vec<Point>> = (0..circuit.len()).map(pose).filter(is_defined).collect();
    if circuit.closed {
        poses.extend(poses.first().cloned());
    } else {
        poses.extend(poses.clone().into_iter().rev().skip(1));
    }
    View::Moving { poses, seconds: (turns * SECONDS_TO_A_TURN * 10.0).round() / 10.0 }
}
