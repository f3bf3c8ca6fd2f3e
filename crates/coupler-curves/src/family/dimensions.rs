//! The dimensions of a family's linkages as text: those that all cells share, and those of a cell.

use super::{Cell, Family, ParameterSpace};
use crate::expression::{Caption, CompiledExpression, MathText, Unit, displayed_name, format_number};
use crate::template::ParameterKind;
use crate::text::{format_as_written, format_for_building, format_in_full_if_short, is_same_number};

/// A name that the caption of a cell should show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptionParameter {
    /// Its index in [`Family::names`].
    pub slot: usize,
    /// Whether the grid or the cases give its value; otherwise it is derived.
    pub is_given: bool,
}

/// How a family gives a value to a name.
enum Source<'f> {
    /// The grid or the cases give the same value to every cell.
    Constant(f64),
    /// Cells differ in the value they are given.
    Varying,
    /// An expression that depends on no name that varies.
    ConstantFormula(&'f CompiledExpression, f64),
    /// An expression whose value varies.
    Formula(&'f CompiledExpression),
}

impl Family {
    /// The indices of the names that the grid or the cases give different values to, in order.
    pub fn varying_slots(&self) -> Vec<usize> {
        match &self.space {
            ParameterSpace::Grid(axes) => {
                let varies =
                    |axis: &&super::Axis| (1..axis.values.len()).any(|k| axis.values.get(k) != axis.values.get(0));
                let mut slots: Vec<usize> = axes.iter().filter(varies).map(|axis| axis.slot).collect();
                slots.sort_unstable();
                slots
            }
            ParameterSpace::Cases(cases) => {
                let value = |case: &super::Case, slot: usize| {
                    case.iter().find(|(given, _)| *given == slot).map(|(_, value)| *value)
                };
                let varies =
                    |slot: &usize| cases.windows(2).any(|pair| value(&pair[0], *slot) != value(&pair[1], *slot));
                let mut slots = self.space.assigned_slots();
                slots.retain(varies);
                slots
            }
            ParameterSpace::Table { slots: columns, values } => {
                let mut rows = values.chunks_exact(columns.len().max(1));
                let first = rows.next().unwrap_or_default();
                let mut differs = vec![false; columns.len()];
                for row in rows {
                    for ((differs, value), of_first) in differs.iter_mut().zip(row).zip(first) {
                        *differs |= value != of_first;
                    }
                }
                let mut slots: Vec<usize> =
                    columns.iter().zip(differs).filter(|(_, differs)| *differs).map(|(slot, _)| *slot).collect();
                slots.sort_unstable();
                slots
            }
        }
    }

    /// What all cells have in common: "r = 1", "s = a", "u = 150 cos(π / 6) = 129.904". Numbers are exact; the value of
    /// a formula has up to six significant digits, and is left out if it varies.
    ///
    /// A helper is among them if a formula uses it. Empty if the family has no cells.
    pub fn common_dimensions(&self) -> Vec<MathText> {
        if self.cell_count() == 0 { Vec::new() } else { self.dimension_texts(&self.sources()) }
    }

    /// Every dimension of a cell, in the same form; its values need not be those of the family.
    pub fn cell_dimensions(&self, cell: &Cell) -> Vec<MathText> {
        let mut sources: Vec<Source> = cell.values.iter().map(|value| Source::Constant(*value)).collect();
        for (slot, formula) in &self.derived {
            let value = cell.values[*slot];
            if formula.evaluate(|slot| cell.values[slot]) == value {
                sources[*slot] = Source::ConstantFormula(formula, value);
            }
        }
        self.dimension_texts(&sources)
    }

    /// The text of each source that does not vary from cell to cell, of the names that are dimensions.
    fn dimension_texts(&self, sources: &[Source]) -> Vec<MathText> {
        let dimension = |(slot, source): (usize, &Source)| {
            let left = MathText::from_name(&self.names[slot]);
            let unit = self.unit(slot);
            match source {
                Source::Varying => None,
                Source::Constant(value) => Some(self.equation_of(slot, building_number(*value))),
                Source::Formula(formula) => Some(left.equal_to(formula.to_math_text())),
                Source::ConstantFormula(formula, value) => {
                    let text = formula.to_math_text();
                    let is_number = text.to_string() == format_as_written(*value);
                    let (is_rounded, number) = rounded_number(*value, None);
                    let sign = if is_rounded { " ≈ " } else { " = " };
                    let value =
                        if is_number { text } else { text.with_words(sign).with_words(number.replace('-', "−")) };
                    Some(left.equal_to(value).with_words(unit))
                }
            }
        };
        let of_linkages = sources.iter().enumerate().filter(|(slot, _)| self.is_dimension(*slot));
        of_linkages.filter_map(dimension).collect()
    }

    /// The caption of cells where the manifest gives none, in the form of a manifest: each of the
    /// [`Family::caption_parameters`]. `None` if there is none.
    pub fn automatic_caption(&self) -> Option<String> {
        let equation = |parameter: &CaptionParameter| {
            let name = &self.names[parameter.slot];
            format!("{} = {{{name}}}{}", displayed_name(name), self.unit(parameter.slot))
        };
        let equations: Vec<String> = self.caption_parameters().iter().map(equation).collect();
        (!equations.is_empty()).then(|| equations.join(", "))
    }

    /// The value of a parameter in a cell: "u = 3.75" exactly if it is given, and with up to six significant digits if it
    /// is derived, for the formula of those is stated.
    pub fn caption_dimension(&self, cell: &Cell, CaptionParameter { slot, is_given }: CaptionParameter) -> MathText {
        let value = cell.values[slot];
        self.equation_of(slot, if is_given { given_number(value, None) } else { rounded_number(value, None) })
    }

    /// A name, by its index in [`Family::names`], and a value in full: "p = 2.5", "phase = 30°"; one that takes more digits than anyone
    /// writes was computed, and has six significant ones.
    pub fn equation(&self, slot: usize, value: f64) -> MathText {
        self.equation_of(slot, given_number(value, None))
    }

    /// A name, by its index, with its values from the least to the greatest, as [`Family::equation`] has them: "p = 2.5 to 4"; with its only value if
    /// they are equal.
    pub fn equation_of_range(&self, slot: usize, values: impl Iterator<Item = f64>) -> MathText {
        let [least, greatest] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        let [first, last] = [least, greatest].map(|value| given_number(value, None));
        let to = if least == greatest { String::new() } else { format!("{} to {}", self.unit(slot), last.1) };
        self.equation_of(slot, (first.0 || last.0, first.1 + &to))
    }

    fn equation_of(&self, slot: usize, (is_rounded, number): (bool, String)) -> MathText {
        let (sign, number) = (if is_rounded { '≈' } else { '=' }, number.replace('-', "−"));
        MathText::from_name(&self.names[slot]).with_words(format!(" {sign} {number}{}", self.unit(slot)))
    }

    /// Whether the grid or the cases give the value of a name, by its index in [`Family::names`].
    pub(super) fn is_given(&self, slot: usize) -> bool {
        self.space.assigned_slots().contains(&slot)
    }

    /// The derived values that captions round, as they print them with more decimals than stated: names and rounded values.
    pub fn rounded_in_captions(&self, cell: &Cell, more_decimals: usize) -> Vec<(String, f64)> {
        let shown = self.captions.iter().flatten().flat_map(Caption::shown_names);
        let rounded = |(name, decimals): (&str, Option<usize>)| {
            let slot = self.names.iter().position(|own| own == name).filter(|slot| !self.is_given(*slot))?;
            let (is_rounded, number) = rounded_number(cell.values[slot], Some(decimals? + more_decimals));
            is_rounded.then(|| Some((name.to_owned(), number.parse().ok()?)))?
        };
        shown.filter_map(rounded).collect()
    }

    /// Whether the captions show a parameter: by itself if it is given, for then it is shown in full.
    pub fn captions_show(&self, CaptionParameter { slot, is_given }: CaptionParameter) -> bool {
        let name = &self.names[slot];
        let shows = |caption: &Caption| match is_given {
            true => caption.shown_names().any(|(shown, _)| shown == name),
            false => caption.uses(name),
        };
        self.captions.iter().flatten().any(shows)
    }

    /// The names that the caption of a cell should show: those that vary, without parameters that are equal to another.
    pub fn caption_parameters(&self) -> Vec<CaptionParameter> {
        let parameter = |(slot, source): (usize, Source)| match source {
            Source::Varying if self.is_dimension(slot) => Some(CaptionParameter { slot, is_given: true }),
            Source::Formula(formula) => {
                let is_own = slot < self.template.parameters.len() && formula.name_or_number().is_none();
                is_own.then_some(CaptionParameter { slot, is_given: false })
            }
            _ => None,
        };
        self.sources().into_iter().enumerate().filter_map(parameter).collect()
    }

    /// Whether a name is a parameter of the linkage, or a helper that a formula uses.
    fn is_dimension(&self, slot: usize) -> bool {
        slot < self.template.parameters.len() || self.derived.iter().any(|(_, formula)| formula.slots().contains(&slot))
    }

    /// The source of each name's value, in the order of the names.
    fn sources(&self) -> Vec<Source<'_>> {
        let first = self.cell(0);
        let given = self.space.assigned_slots();
        let mut sources: Vec<Source> = first.values.iter().map(|value| Source::Constant(*value)).collect();
        self.varying_slots().into_iter().for_each(|slot| sources[slot] = Source::Varying);
        // In the order of computation: what a formula uses comes before it.
        for (slot, formula) in self.derived.iter().filter(|(slot, _)| !given.contains(slot)) {
            let varies = |used: &usize| matches!(sources[*used], Source::Varying | Source::Formula(_));
            sources[*slot] = match formula.slots().iter().any(varies) {
                true => Source::Formula(formula),
                false => Source::ConstantFormula(formula, first.values[*slot]),
            };
        }
        sources
    }

    /// The unit of a parameter, as written after a number.
    fn unit(&self, slot: usize) -> &'static str {
        match self.template.parameters.get(slot).map(|parameter| parameter.kind) {
            Some(ParameterKind::Angle(Unit::Rad)) => " rad",
            Some(ParameterKind::Angle(_)) => "°",
            _ => "",
        }
    }
}

/// A value that is given, as it is printed: with a number of decimals if these give it in full, and otherwise in full; whether it is
/// rounded, to six significant digits, as one is that takes more digits than anyone writes and so was computed.
pub(super) fn given_number(value: f64, decimals: Option<usize>) -> (bool, String) {
    let (is_rounded, stated) = rounded_number(value, decimals);
    match format_in_full_if_short(value) {
        Some(in_full) if is_rounded => (false, in_full),
        _ if !is_rounded => (false, stated),
        _ => rounded_number(value, None),
    }
}

/// A value that is given, as it is built by: a fraction has its decimal beside it.
fn building_number(value: f64) -> (bool, String) {
    match given_number(value, None) {
        (false, number) if number.contains('/') => (false, format_for_building(value)),
        given => given,
    }
}

/// A value with a number of decimals or up to six significant digits; whether that rounds it.
pub(super) fn rounded_number(value: f64, decimals: Option<usize>) -> (bool, String) {
    let number = format_number(value, decimals);
    let is_rounded = number.parse().map_or(true, |printed| !is_same_number(printed, value));
    (is_rounded, number)
}
