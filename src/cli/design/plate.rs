use coupler_atlas::design::Design;
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, PanelPage, Paper, PoseChoice};
use coupler_drawing::render::{self, TextMode};

use super::Report;
use super::text::{format_significant, proportions};

/// The designs on one plate, in order of rank, as SVG.
pub(super) fn plate(report: &Report) -> Vec<u8> {
    let designs = &report.results.designs;
    // A panel is numbered by its cell: here by its rank.
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
        let view = design.pose.clone().map_or(PoseChoice::Clearest, PoseChoice::Fixed);
        Panel {
            link_inks: Vec::new(),
            caption: caption(design),
            note: note(design),
            facts: Default::default(),
            solved_cell: solved,
            pose: view,
        }
    };
    let mut symbols: Vec<String> = designs.iter().flat_map(|design| design.family.names.clone()).collect();
    symbols.sort();
    symbols.dedup();
    let heading = Heading {
        atlas_title: "coupler-atlas",
        family_id: "design",
        family_title: "Straight-line linkages",
        source: requirements_line(report),
        symbols: &symbols,
        page: 1,
        page_count: 1,
    };
    let sheet = PanelPage {
        heading,
        layout: Layout::Panels { columns, rows },
        panels: designs.iter().zip(&solved).map(panel).collect(),
    };
    let paper = Paper { width: 110.0 * columns as f64 + 20.0, height: 100.0 * rows as f64 + 35.0 };
    render::svg(&page::compose_panels(&sheet, &Options::for_paper(paper)), TextMode::Text)
}

fn caption(design: &Design) -> String {
    format!("{}: {}", design.driven_linkage.kind.id(), proportions(design))
}

fn note(design: &Design) -> String {
    let (straight, figures) = (&design.straight, &design.performance);
    format!(
        "straight {} ± {} over {:.1}° of the {}; μ ≥ {:.1}°; size {}",
        format_significant(straight.length, 5),
        format_significant(straight.deviation, 3),
        design.swing,
        figures.input_link.name(),
        figures.mu_min,
        format_significant(figures.size, 5)
    )
}

/// What was wished, in a line.
fn requirements_line(report: &Report) -> String {
    let wishes = &report.requirements;
    let number = |name: &str, value: Option<f64>| value.map(|value| format!("{name} {}", format_significant(value, 5)));
    let parts = [
        number("straight length", wishes.length),
        number("strip's width over length at most", Some(wishes.tolerance)),
        number("size at most", wishes.size),
        number("frame p =", wishes.p),
        Some(wishes.mu_min)
            .filter(|&mu| mu > 0.0)
            .map(|mu| format!("transmission angle μ ≥ {}°", format_significant(mu, 4))),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}
