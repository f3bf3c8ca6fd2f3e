//! A drawing of the designs.

use crate::design::Design;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, PanelPage, PanelScale, Paper, PoseChoice};
use coupler_drawing::render::{self, TextMode};

use super::super::format::format_significant;
use super::format::proportions;
use super::report::Report;

/// An SVG with one panel for each design, in order of rank.
pub(super) fn plate(report: &Report) -> Vec<u8> {
    let designs = &report.results.designs;
    // A panel shows the number of its cell; here that is the rank.
    let ranked = |(k, design): (usize, &Design)| {
        let mut solved = design.solved_cell.clone();
        solved.cell.number = k + 1;
        solved
    };
    let solved: Vec<SolvedCell> = designs.iter().enumerate().map(ranked).collect();
    let columns = [1, 2, 3, 2, 3, 3].get(designs.len() - 1).copied().unwrap_or(4);
    let rows = designs.len().div_ceil(columns);
    let panel = |(design, solved)| {
        let design: &Design = design;
        let pose = design.pose.clone().map_or(PoseChoice::Clearest, PoseChoice::Fixed);
        Panel::new(solved).with_caption(caption(design)).with_note(note(design)).with_pose(pose)
    };
    let mut symbols: Vec<String> = designs.iter().flat_map(|design| design.family.names.clone()).collect();
    symbols.sort();
    symbols.dedup();
    let heading = Heading::new("Straight-line linkages")
        .with_family_id("design")
        .with_atlas_title("coupler-atlas")
        .with_source(requirements_line(report))
        .with_symbols(&symbols);
    let sheet = PanelPage {
        heading,
        layout: Layout::Panels { columns, rows },
        panels: designs.iter().zip(&solved).map(panel).collect(),
        scale: PanelScale::Panel,
        key: None,
    };
    let paper = Paper { width: 110.0 * columns as f64 + 20.0, height: 100.0 * rows as f64 + 35.0 };
    render::svg(&page::compose_panels(&sheet, &Options::for_paper(paper)), TextMode::Text)
}

fn caption(design: &Design) -> String {
    format!("{}: {}", design.driven_linkage.kind.id(), proportions(design))
}

fn note(design: &Design) -> String {
    let (straight, performance) = (&design.straight, &design.performance);
    format!(
        "straight {} ± {} over {:.1}° of the {}; μ ≥ {:.1}°; size {}",
        format_significant(straight.length, 5),
        format_significant(straight.deviation, 3),
        design.swing,
        performance.input_link.name(),
        performance.mu_min,
        format_significant(performance.size, 5)
    )
}

/// The requirements in one line.
fn requirements_line(report: &Report) -> String {
    let requirements = &report.requirements;
    let number = |name: &str, value: Option<f64>| value.map(|value| format!("{name} {}", format_significant(value, 5)));
    let parts = [
        number("straight length", requirements.length),
        number("strip width over length at most", Some(requirements.tolerance)),
        number("size at most", requirements.size),
        number("frame p =", requirements.p),
        Some(requirements.mu_min)
            .filter(|&mu| mu > 0.0)
            .map(|mu| format!("transmission angle μ ≥ {}°", format_significant(mu, 4))),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}
