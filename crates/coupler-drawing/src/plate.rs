//! A plate of one curve with its linkage, still or moving.

use coupler_curves::CouplerCurve;
use coupler_curves::exchange::SelectedCurve;
use coupler_curves::family::Family;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Input, Linkage};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};
use coupler_curves::solve::SolvedCell;

use crate::page::{self, Heading, Key, Layout, Options, Panel, PanelPage, PanelScale, Paper, PoseChoice};
use crate::render::{self, TextMode};
use crate::scene::Scene;

/// The paper of a plate, in millimetres.
pub const PAPER: Paper = Paper { width: 200.0, height: 150.0 };

/// A plate of a coupler curve as SVG: the curve with its linkage and its caption, on [`PAPER`] in the default theme.
pub fn svg(curve: &CouplerCurve) -> Vec<u8> {
    let scene = compose(&curve.selected(), PoseChoice::Clearest, &Options::for_paper(PAPER));
    render::svg(&scene, TextMode::Text)
}

/// Draws a curve with its linkage and its caption.
pub fn compose(curve: &SelectedCurve, pose: PoseChoice, options: &Options) -> Scene {
    page::compose_panels(
        &panel_page(curve, &curve.name(), pose, &Key::for_cell(curve.family, &curve.solved.cell)),
        options,
    )
}

/// Draws a linkage with all its curves, in a pose: the page of a cell by itself.
pub fn compose_cell(family: &Family, solved: &SolvedCell, pose: PoseChoice, options: &Options) -> Scene {
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    let facts = page::cell_facts(family, solved);
    let panel = Panel::new(solved).with_caption(caption).with_note(note).with_facts(facts).with_pose(pose);
    compose_panel(family, &family.title, panel, options)
}

/// Draws a panel of a cell of a family as a page by itself.
pub fn compose_panel(family: &Family, title: &str, panel: Panel, options: &Options) -> Scene {
    let key = Key::for_cell(family, &panel.solved_cell.cell);
    let heading = Heading::new(title)
        .with_family_id(&family.id)
        .with_atlas_title("coupler-atlas")
        .with_source(family.template.source.clone())
        .with_dimensions(&key.dimensions)
        .with_symbols(&family.names)
        .with_unit(family.unit);
    let sheet = PanelPage {
        heading,
        layout: Layout::Panels { columns: 1, rows: 1 },
        panels: vec![panel],
        scale: PanelScale::Panel,
        key: Some(&key),
    };
    page::compose_panels(&sheet, options)
}

/// The plate as a page of one panel, with its key; `name` is that of the curve.
pub(crate) fn panel_page<'a>(curve: &'a SelectedCurve, name: &'a str, pose: PoseChoice, key: &'a Key) -> PanelPage<'a> {
    let SelectedCurve { family, source, solved, .. } = curve;
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    let heading = Heading::new(&family.title)
        .with_family_id(&family.id)
        .with_atlas_title(name)
        .with_source(*source)
        .with_dimensions(&key.dimensions)
        .with_symbols(&family.names)
        .with_unit(family.unit);
    let facts = page::cell_facts(family, solved);
    let panel = Panel::new(solved).with_caption(caption).with_note(note).with_facts(facts).with_pose(pose);
    PanelPage {
        heading,
        layout: Layout::Panels { columns: 1, rows: 1 },
        panels: vec![panel],
        scale: PanelScale::Panel,
        key: Some(key),
    }
}

/// The poses of a circuit as an animation, denser towards the limits of the input; an open circuit is traversed
/// forwards and backwards.
///
/// `number` is the circuit's number, from 1; the choice is [`PoseChoice::Clearest`] if the linkage has no such circuit.
pub fn moving_view(linkage: &Linkage, circuit: &Circuit, number: usize) -> PoseChoice {
    /// Positions are interpolated linearly between two poses: over 3 degrees no pin leaves its circle by more than a
    /// thousandth of the radius.
    const STEP_DEG: f64 = 3.0;
    const SECONDS_PER_TURN: f64 = 4.0;
    let turns = match linkage.input() {
        Input::Angle { .. } => circuit.passes.iter().map(|pass| pass.input_length() / 360.0).sum::<f64>().max(0.25),
        Input::Length => 1.0,
    };
    let frames = (turns * 360.0 / STEP_DEG).ceil() as usize;
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::DenseAtLimits(frames)));
    let Some(circuit) = number.checked_sub(1).and_then(|k| motion.circuits.get(k)) else { return PoseChoice::Clearest };
    let pose =
        |sample: usize| linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect::<Vec<Point>>();
    let is_defined = |pose: &Vec<Point>| pose.iter().all(|p| p.x.is_finite() && p.y.is_finite());
    let mut poses: Vec<Vec<Point>> = (0..circuit.len()).map(pose).filter(is_defined).collect();
    if circuit.is_closed {
        poses.extend(poses.first().cloned());
    } else {
        poses.extend(poses.clone().into_iter().rev().skip(1));
    }
    PoseChoice::Animated { poses, seconds: (turns * SECONDS_PER_TURN * 10.0).round() / 10.0 }
}
