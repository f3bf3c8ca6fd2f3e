//! A drawing of the designs of a linkage.

use coupler_curves::exchange::format_significant;
use coupler_drawing::page::PoseChoice;
use coupler_find::DesignAnswer;

use super::plate::{ShownDesign, designs_plate};
use super::wishes::{Designs, describe};

/// The designs on one page as SVG, under a line on what was wished; there must be one.
pub fn draw_designs(linkage: &str, wished: String, designs: &Designs) -> Vec<u8> {
    let shown = designs.answers.iter().map(|answer| ShownDesign {
        solved: answer.solved.clone(),
        caption: describe(answer),
        note: dimensions(answer),
        pose: PoseChoice::Clearest,
    });
    let symbols = designs.answers.iter().flat_map(|answer| answer.family.names.clone()).collect();
    designs_plate(&format!("Designs of {linkage}"), wished, symbols, shown.collect())
}

/// The dimensions: "p = 110, r = 17.674909".
pub fn dimensions(answer: &DesignAnswer) -> String {
    /// Of a dimension, significant ones.
    const DIGITS: usize = 8;
    /// Numbers below are in scientific notation.
    const LEAST: f64 = 1e-5;
    let named = answer.family.template.parameters.iter().zip(&answer.values);
    let values =
        named.map(|(parameter, value)| format!("{} = {}", parameter.name, format_significant(*value, DIGITS, LEAST)));
    values.collect::<Vec<_>>().join(", ")
}
