//! A drawing of designs.

use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, Heading, Layout, Options, Panel, PanelPage, PanelScale, Paper, PoseChoice};
use coupler_drawing::render::{self, TextMode};

/// A design as it is drawn.
pub struct ShownDesign {
    /// The linkage with the curve that is shown.
    pub solved: SolvedCell,
    /// The line under it.
    pub caption: String,
    /// The line under that.
    pub note: String,
    /// In which pose it is drawn.
    pub pose: PoseChoice,
}

/// An SVG with one panel for each design, in order of rank, under a title and a line on what was wished; there must be one.
pub fn designs_plate(title: &str, wished: String, mut symbols: Vec<String>, mut designs: Vec<ShownDesign>) -> Vec<u8> {
    let columns = [1, 2, 3, 2, 3, 3].get(designs.len() - 1).copied().unwrap_or(4);
    let rows = designs.len().div_ceil(columns);
    // A panel shows the number of its cell; here that is the rank.
    (1..).zip(&mut designs).for_each(|(rank, design)| design.solved.cell.number = rank);
    symbols.sort();
    symbols.dedup();
    let heading = Heading::new(title)
        .with_family_id("design")
        .with_atlas_title("coupler-atlas")
        .with_source(wished)
        .with_symbols(&symbols);
    let sheet = PanelPage {
        heading,
        layout: Layout::Panels { columns, rows },
        panels: designs.iter().map(panel).collect(),
        scale: PanelScale::Panel,
        key: None,
    };
    let paper = Paper { width: 110.0 * columns as f64 + 20.0, height: 100.0 * rows as f64 + 35.0 };
    render::svg(&page::compose_panels(&sheet, &Options::for_paper(paper)), TextMode::Text)
}

fn panel(design: &ShownDesign) -> Panel<'_> {
    Panel::new(&design.solved)
        .with_caption(design.caption.clone())
        .with_note(design.note.clone())
        .with_pose(design.pose.clone())
}
