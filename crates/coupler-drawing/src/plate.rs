//! A plate of one curve with its linkage, still or moving.

use coupler_curves::exchange::SelectedCurve;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Input, Linkage};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};

use crate::page::{self, Heading, Layout, Options, Panel, PanelPage, Paper, PoseChoice};
use crate::scene::Scene;

/// The paper of plates.
pub const PAPER: Paper = Paper { width: 200.0, height: 150.0 };

/// Draws a curve with its linkage and its caption.
pub fn compose(chosen: &SelectedCurve, view: PoseChoice, options: &Options) -> Scene {
    let SelectedCurve { family, source, solved, .. } = chosen;
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    let name = chosen.name();
    let heading = Heading {
        atlas_title: &name,
        family_id: &family.id,
        family_title: &family.title,
        source: (*source).to_owned(),
        symbols: &family.names,
        page: 1,
        page_count: 1,
    };
    let panel = Panel {
        caption,
        note,
        facts: page::cell_facts(solved),
        solved_cell: solved,
        pose: view,
        link_inks: Vec::new(),
    };
    let sheet = PanelPage { heading, layout: Layout::Panels { columns: 1, rows: 1 }, panels: vec![panel] };
    page::compose_panels(&sheet, options)
}

/// The poses of a circuit, by its number from 1, slower towards its limits, as a crank is that is turned by hand; there
/// and back where it does not close.
pub fn moving_view(linkage: &Linkage, circuit: &Circuit, number: usize) -> PoseChoice {
    /// Between two poses places go straight: over 3 degrees no pin is off its circle by more than a thousandth of its
    /// radius.
    const STEP_DEG: f64 = 3.0;
    const SECONDS_PER_TURN: f64 = 4.0;
    let turns = match linkage.input() {
        Input::Angle { .. } => circuit.passes.iter().map(|pass| pass.input_length() / 360.0).sum::<f64>().max(0.25),
        Input::Length => 1.0,
    };
    let frames = (turns * 360.0 / STEP_DEG).ceil() as usize;
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::DenseAtLimits(frames)));
    let Some(circuit) = number.checked_sub(1).and_then(|k| motion.circuits.get(k)) else { return PoseChoice::Clearest };
    let joints = linkage.joints.len();
    let pose = |sample: usize| (0..joints).map(|joint| circuit.positions.point(joint, sample)).collect::<Vec<Point>>();
    let is_defined = |pose: &Vec<Point>| pose.iter().all(|p| p.x.is_finite() && p.y.is_finite());
    let mut poses: Vec<Vec<Point>> = (0..circuit.len()).map(pose).filter(is_defined).collect();
    if circuit.is_closed {
        poses.extend(poses.first().cloned());
    } else {
        poses.extend(poses.clone().into_iter().rev().skip(1));
    }
    PoseChoice::Animated { poses, seconds: (turns * SECONDS_PER_TURN * 10.0).round() / 10.0 }
}
