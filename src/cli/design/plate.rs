use coupler_atlas::design::Design;
use coupler_curves::solve::Solved;
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, Paper, Sheet, View};
use coupler_drawing::render::{self, TextMode};

use super::Report;
use super::text::{proportions, short};

/// The designs on one plate, in order of rank, as SVG.
pub(super) fn plate(report: &Report) -> Vec<u8> {
    let designs = &report.found.designs;
    // A panel is numbered by its cell: here by its rank.
    let ranked = |(k, design): (usize, &Design)| {
        let mut solved = design.solved.clone();
        solved.cell.number = k + 1;
        solved
    };
    let solved: Vec<Solved> = designs.iter().enumerate().map(ranked).collect();
    let columns = [1, 2, 3, 2, 3, 3].get(designs.len() - 1).copied().unwrap_or(4);
    let rows = designs.len().div_ceil(columns);
    let panel = |(design, solved)| {
        let design: &Design = design;
        let view = design.pose.clone().map_or(View::Clearest, View::At);
        Panel {
            inks: Vec::new(),
            caption: caption(design),
            note: note(design),
            facts: Default::default(),
            solved,
            view,
        }
    };
    let mut symbols: Vec<String> = designs.iter().flat_map(|design| design.family.names.clone()).collect();
    symbols.sort();
    symbols.dedup();
    let heading = Heading {
        atlas: "coupler-atlas",
        family: "design",
        title: "Straight-line linkages",
        source: wished(report),
        symbols: &symbols,
        page: 1,
        of: 1,
    };
    let sheet = Sheet {
        heading,
        layout: Layout::Panels { columns, rows },
        panels: designs.iter().zip(&solved).map(panel).collect(),
    };
    let paper = Paper { width: 110.0 * columns as f64 + 20.0, height: 100.0 * rows as f64 + 35.0 };
    render::svg(&page::compose(&sheet, &Options::on(paper)), TextMode::Text)
}

fn caption(design: &Design) -> String {
    format!("{}: {}", design.arrangement.kind.id(), proportions(design))
}

fn note(design: &Design) -> String {
    let (straight, figures) = (&design.straight, &design.figures);
    format!(
        "straight {} ± {} over {:.1}° of the {}; μ ≥ {:.1}°; size {}",
        short(straight.length, 5),
        short(straight.deviation, 3),
        design.swing,
        figures.driven.name(),
        figures.mu_min,
        short(figures.size, 5)
    )
}

/// What was wished, in a line.
fn wished(report: &Report) -> String {
    let wishes = &report.wishes;
    let number = |name: &str, value: Option<f64>| value.map(|value| format!("{name} {}", short(value, 5)));
    let parts = [
        number("straight length", wishes.length),
        number("strip's width over length at most", Some(wishes.tolerance)),
        number("size at most", wishes.size),
        number("frame p =", wishes.p),
        Some(wishes.mu_min).filter(|&mu| mu > 0.0).map(|mu| format!("transmission angle μ ≥ {}°", short(mu, 4))),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}
