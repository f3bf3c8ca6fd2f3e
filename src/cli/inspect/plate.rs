use coupler_atlas::export::Options as Taken;
use coupler_curves::motion;
use coupler_curves::solve::Solved;
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, Sheet, View};
use coupler_drawing::plate::moving_view;
use coupler_drawing::render::{self, TextMode};

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
    let options = Options::on(Taken::PAPER);
    render::svg(&page::compose(&sheet, &options), TextMode::Text)
}

/// The poses of the first circuit.
fn moving(solved: &Solved) -> View {
    solved.motion.circuits.first().map_or(View::Clearest, |circuit| moving_view(&solved.linkage, circuit, 1))
}
