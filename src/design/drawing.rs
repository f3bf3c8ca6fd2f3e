//! A drawing of the designs of a linkage.

use coupler_drawing::page::PoseChoice;

use super::plate::{ShownDesign, designs_plate};
use super::wishes::{Designs, describe, parameters};

/// The designs on one page as SVG, under a line on what was wished; there must be one.
pub fn draw_designs(linkage: &str, wished: String, designs: &Designs) -> Vec<u8> {
    let shown = designs.answers.iter().map(|answer| ShownDesign {
        solved: answer.solved.clone(),
        caption: describe(answer),
        note: parameters(answer),
        pose: PoseChoice::Clearest,
    });
    let symbols = designs.answers.iter().flat_map(|answer| answer.family.names.clone()).collect();
    designs_plate(&format!("Designs of {linkage}"), wished, symbols, shown.collect())
}
