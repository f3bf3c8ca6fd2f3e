use coupler_atlas::export::Options as Taken;
use coupler_curves::motion;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, PanelPage, PoseChoice};
use coupler_drawing::plate::moving_view;
use coupler_drawing::render::{self, TextMode};

use super::{Report, cognates};

/// One plate of the linkage, as SVG: in the pose asked for, moving, or where it can be seen best.
pub(super) fn plate(report: &Report, animate: bool) -> Vec<u8> {
    let Report { family, solved, poses, cognates, .. } = report;
    let template = &family.template;
    let [caption, note] = family.format_captions(&solved.cell, solved.first_curve_values());
    let facts = page::cell_facts(solved);
    let own = || Panel { caption, note, facts, solved_cell: solved, pose: PoseChoice::Clearest, link_inks: Vec::new() };
    let panel = cognates.as_ref().map_or_else(own, |found| cognates::panel(report, found));
    let view = match poses.first() {
        _ if animate => animated_view(panel.solved_cell),
        Some(pose) => PoseChoice::Fixed(motion::pose(&panel.solved_cell.linkage, pose.pass, pose.input)),
        None => PoseChoice::Clearest,
    };
    let panel = Panel { pose: view, ..panel };
    let title = if cognates.is_some() { format!("{} and its cognates", family.title) } else { family.title.clone() };
    let heading = Heading {
        atlas_title: "coupler-atlas",
        family_id: &family.id,
        family_title: &title,
        source: template.source.clone(),
        symbols: &family.names,
        page: 1,
        page_count: 1,
    };
    let sheet = PanelPage { heading, layout: Layout::Panels { columns: 1, rows: 1 }, panels: vec![panel] };
    let options = Options::for_paper(Taken::PLATE_PAPER);
    render::svg(&page::compose_panels(&sheet, &options), TextMode::Text)
}

/// The poses of the first circuit.
fn animated_view(solved: &SolvedCell) -> PoseChoice {
    solved.motion.circuits.first().map_or(PoseChoice::Clearest, |circuit| moving_view(&solved.linkage, circuit, 1))
}
