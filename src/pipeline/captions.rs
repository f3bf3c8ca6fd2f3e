//! The captions of the cells of a family.

use crate::manifest::PlannedFamily;
use coupler_curves::family::{CaptionParameter, Cell};
use coupler_curves::measure::Value;

/// What is said of the cells of a family, on pages and wherever a book lists them.
#[derive(Clone, Debug)]
pub struct Captions<'a> {
    planned: &'a PlannedFamily,
    /// The parameters that captions should show.
    parameters: Vec<CaptionParameter>,
}

impl<'a> Captions<'a> {
    /// The captions of a family.
    pub fn new(planned: &'a PlannedFamily) -> Captions<'a> {
        Captions { planned, parameters: planned.family.caption_parameters() }
    }

    /// The caption of a cell and the note below it, with the measures of one of its curves, if they are known, filled in. A
    /// caption that the manifest or the linkage gives is completed by the parameters that it does not show in full.
    pub fn of_cell(&self, cell: &Cell, measures: &[Value]) -> [String; 2] {
        let PlannedFamily { family, automatic_caption, .. } = self.planned;
        let [stated, note] = family.format_captions(cell, measures);
        let is_automatic = automatic_caption.is_some();
        let is_missing = |parameter: &&CaptionParameter| is_automatic || !family.captions_show(cell, **parameter);
        let missing = self.parameters.iter().filter(is_missing);
        let missing = missing.map(|parameter| family.caption_dimension(cell, *parameter).to_string());
        let stated = (!is_automatic && !stated.is_empty()).then_some(stated);
        [stated.into_iter().chain(missing).collect::<Vec<_>>().join(", "), note]
    }
}
