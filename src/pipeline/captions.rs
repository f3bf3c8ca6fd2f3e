//! The captions of the cells of a family.

use std::cell::LazyCell;

use crate::manifest::PlannedFamily;
use coupler_curves::family::{CaptionParameter, Cell};
use coupler_curves::measure::Value;
use coupler_curves::solve::{ChangedCell, SolvedCell, Solver};
use coupler_drawing::page;

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
        self.with_decimals(cell, measures, 0)
    }

    /// The caption of a cell that is not solved: its parameters, where measures are in that of the manifest.
    #[cfg(feature = "pdf")]
    pub fn of_unsolved_cell(&self, cell: &Cell) -> String {
        let family = &self.planned.family;
        let has_measures =
            |caption: &coupler_curves::expression::Caption| !family.measures_in_caption(caption).is_empty();
        if !family.captions[0].as_ref().is_some_and(has_measures) {
            let [caption, _] = self.of_cell(cell, &[]);
            return caption;
        }
        let parameters = self.parameters.iter().map(|parameter| family.caption_dimension(cell, *parameter).to_string());
        parameters.collect::<Vec<_>>().join(", ")
    }

    /// The same as [`Captions::of_cell`] of a solved cell, with as many decimals of derived values as its properties need: the linkage of the rounded values has
    /// the same properties, as they are printed.
    pub fn of_solved_cell(&self, solved: &SolvedCell) -> [String; 2] {
        /// No double has more that matter.
        const MOST: usize = 15;
        let (cell, measures) = (&solved.cell, solved.first_curve_values());
        let printed = |solved: &SolvedCell| {
            let family = &self.planned.family;
            (page::cell_facts(family, solved), family.format_captions(&solved.cell, solved.first_curve_values()))
        };
        let expected = LazyCell::new(|| printed(solved));
        let is_enough = |more: &usize| {
            let rounded = self.planned.family.rounded_in_captions(cell, *more);
            rounded.is_empty() || {
                let changed = ChangedCell::new(&self.planned.family, cell.number, None, &rounded).ok();
                let solved = changed.and_then(|changed| Solver::new(&changed.family).solve(0));
                solved.is_some_and(|solved| printed(&solved) == *expected)
            }
        };
        let more = if self.planned.automatic_caption.is_some() { 0 } else { (0..MOST).find(is_enough).unwrap_or(MOST) };
        self.with_decimals(cell, measures, more)
    }

    /// What varies between the captions, as far as the grid or the cases give it: derived values follow from that by the formulas on the page.
    pub fn varying(&self, cell: &Cell) -> Vec<String> {
        let given = self.parameters.iter().filter(|parameter| parameter.is_given);
        given.map(|parameter| self.planned.family.caption_dimension(cell, *parameter).to_string()).collect()
    }

    fn with_decimals(&self, cell: &Cell, measures: &[Value], more_decimals: usize) -> [String; 2] {
        let PlannedFamily { family, automatic_caption, .. } = self.planned;
        let [stated, note] = family.format_captions_with(cell, measures, more_decimals);
        let is_automatic = automatic_caption.is_some();
        let is_missing = |parameter: &&CaptionParameter| is_automatic || !family.captions_show(**parameter);
        let missing = self.parameters.iter().filter(is_missing);
        let missing = missing.map(|parameter| family.caption_dimension(cell, *parameter).to_string());
        let stated = (!is_automatic && !stated.is_empty()).then_some(stated);
        [stated.into_iter().chain(missing).collect::<Vec<_>>().join(", "), note]
    }
}
