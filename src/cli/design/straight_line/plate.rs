//! A drawing of the designs.

use crate::design::{Design, ShownDesign, designs_plate};
use coupler_drawing::page::PoseChoice;

use super::format::proportions;
use super::report::Report;
use crate::format::format_significant;

/// An SVG with one panel for each design, in order of rank.
pub(super) fn plate(report: &Report) -> Vec<u8> {
    let designs = &report.results.designs;
    let shown = |design: &Design| ShownDesign {
        solved: design.solved_cell.clone(),
        caption: caption(design),
        note: note(design),
        pose: design.pose.clone().map_or(PoseChoice::Clearest, PoseChoice::Fixed),
    };
    let shown: Vec<ShownDesign> = designs.iter().map(shown).collect();
    let symbols = designs.iter().flat_map(|design| design.family.names.clone()).collect();
    designs_plate("Straight-line linkages", requirements_line(report), symbols, shown)
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
