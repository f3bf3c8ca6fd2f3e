//! A drawing of the linkage.

use coupler_curves::motion;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, Heading, Key, Layout, Options, Panel, PanelPage, PanelScale, PoseChoice};
use coupler_drawing::plate::{PAPER, moving_view};
use coupler_drawing::render::{self, TextMode};

use super::{Report, cognates};

/// An SVG of the linkage: animated, in its pose at the requested input, or in the clearest pose.
pub(super) fn plate(report: &Report, animate: bool) -> Vec<u8> {
    let Report { family, solved, poses, cognates, .. } = report;
    let template = &family.template;
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    let facts = page::cell_facts(family, solved);
    let plain_panel = || Panel::new(solved).with_caption(caption).with_note(note).with_facts(facts);
    let panel = cognates.as_ref().map_or_else(plain_panel, |cognate_set| cognates::panel(report, cognate_set));
    let pose = match poses.first() {
        _ if animate => animated_pose(panel.solved_cell),
        Some(pose) => PoseChoice::Fixed(motion::pose(&panel.solved_cell.linkage, pose.pass, pose.input)),
        None => PoseChoice::Clearest,
    };
    let panel = panel.with_pose(pose);
    let title = if cognates.is_some() { format!("{} and its cognates", family.title) } else { family.title.clone() };
    let key = Key::for_cell(family, &solved.cell);
    let heading = Heading::new(&title)
        .with_family_id(&family.id)
        .with_atlas_title("coupler-atlas")
        .with_source(template.source.clone())
        .with_dimensions(&key.dimensions)
        .with_symbols(&family.names);
    let sheet = PanelPage {
        heading,
        layout: Layout::Panels { columns: 1, rows: 1 },
        panels: vec![panel],
        scale: PanelScale::Panel,
        key: Some(&key),
    };
    let options = Options::for_paper(PAPER);
    render::svg(&page::compose_panels(&sheet, &options), TextMode::Text)
}

/// The poses of the first circuit, one after another.
fn animated_pose(solved: &SolvedCell) -> PoseChoice {
    solved.motion.circuits.first().map_or(PoseChoice::Clearest, |circuit| moving_view(&solved.linkage, circuit, 1))
}
