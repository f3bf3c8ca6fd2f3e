//! What names stand for in expressions about the curves of a family, and their values.

use std::cell::LazyCell;
use std::sync::LazyLock;

use super::{Cell, Family, dimensions};
use crate::expression::{Caption, CompiledExpression, Expression, Kind, Scope};
use crate::measure::{self, BOOLEANS, Boolean, Measure, MeasureSet, Value};
use crate::text::format_fixed;

/// What a name of [`Family::scope`] stands for.
#[derive(Clone, Copy, Debug)]
pub enum ScopeName {
    /// A name of cells, by its index in [`Family::names`].
    Own(usize),
    /// A measure that is a number, by its index in [`measure::ALL`].
    Measure(usize),
    /// A boolean.
    Boolean(&'static Boolean),
}

/// The names that follow those of cells, the same in all families, in the order of [`Family::scope`].
static CURVE_NAMES: LazyLock<Vec<ScopeName>> = LazyLock::new(|| {
    let numbers = MeasureSet::of(|measure| !measure.is_word);
    numbers.iter().map(ScopeName::Measure).chain(BOOLEANS.iter().map(ScopeName::Boolean)).collect()
});

impl ScopeName {
    /// What the name at an index of [`Family::scope`] stands for, of cells with so many names; `None` for an index out of range.
    fn at(slot: usize, own_count: usize) -> Option<ScopeName> {
        match slot.checked_sub(own_count) {
            None => Some(ScopeName::Own(slot)),
            Some(further) => CURVE_NAMES.get(further).copied(),
        }
    }

    /// Its value for a curve of a cell; NaN where it has none.
    fn value(self, cell: &Cell, measures: &[Value]) -> f64 {
        match self {
            ScopeName::Own(slot) => cell.values[slot],
            ScopeName::Measure(k) => match measures.get(k) {
                Some(Value::Number(value)) => *value,
                _ => f64::NAN,
            },
            ScopeName::Boolean(boolean) => boolean.value(measures),
        }
    }

    /// The measure that it is, or that a boolean is computed from.
    fn measures(self) -> MeasureSet {
        match self {
            ScopeName::Own(_) => MeasureSet::EMPTY,
            ScopeName::Measure(k) => MeasureSet::from_iter([k]),
            ScopeName::Boolean(boolean) => MeasureSet::of(|measure| measure.name == boolean.measure),
        }
    }
}

impl Family {
    /// The names that `where` may use, with their kinds: those of cells, the numeric measures and the booleans. Inputs
    /// have the names of lengths if an actuator drives the linkage.
    pub fn scope(names: &[String], is_driven_by_length: bool) -> Scope<'_> {
        let own = names.iter().map(|name| (name.as_str(), Kind::Number));
        let of_curves = CURVE_NAMES.iter().filter_map(|name| match name {
            ScopeName::Own(_) => None,
            ScopeName::Measure(k) => Some((measure::ALL[*k].name_for(is_driven_by_length), Kind::Number)),
            ScopeName::Boolean(boolean) => Some((boolean.name, Kind::Boolean)),
        });
        let scope: Scope = own.chain(of_curves).collect();
        scope.with_others_described(names.len(), "a measure: `coupler-atlas list measures` lists them")
    }

    /// What the names of an expression over [`Family::scope`] stand for, without those that follow them in another scope.
    pub fn names_in(&self, expression: &CompiledExpression) -> impl Iterator<Item = ScopeName> {
        expression.slots().iter().filter_map(|slot| ScopeName::at(*slot, self.names.len()))
    }

    /// The value of the name at an index of [`Family::scope`]; NaN where it has no value, or the index is out of range.
    pub fn scope_value(cell: &Cell, measures: &[Value], slot: usize) -> f64 {
        ScopeName::at(slot, cell.values.len()).map_or(f64::NAN, |name| name.value(cell, measures))
    }

    /// The measures that an expression over [`Family::scope`] needs.
    pub fn measures_in(&self, expression: &CompiledExpression) -> MeasureSet {
        Family::measures_of(expression, self.names.len())
    }

    /// The measures that an expression over the [`Family::scope`] of so many names of cells needs.
    pub fn measures_of(expression: &CompiledExpression, own_count: usize) -> MeasureSet {
        let names = expression.slots().iter().filter_map(|slot| ScopeName::at(*slot, own_count));
        names.fold(MeasureSet::EMPTY, |set, name| set | name.measures())
    }

    /// The measures that `where` and `sort` need.
    pub fn selection_measures(&self) -> MeasureSet {
        let expressions = self.filter.iter().chain(&self.sort);
        expressions.fold(MeasureSet::EMPTY, |set, expression| set | self.measures_in(expression))
    }

    /// The measures that the caption lines show.
    pub fn caption_measures(&self) -> MeasureSet {
        let shown = self.captions.iter().flatten().map(|caption| self.measures_in_caption(caption));
        shown.fold(MeasureSet::EMPTY, |set, shown| set | shown)
    }

    /// The measures that a caption line shows.
    pub fn measures_in_caption(&self, caption: &Caption) -> MeasureSet {
        let is_driven_by_length = self.template.is_driven_by_length();
        MeasureSet::of(|measure| caption.uses(measure.name_for(is_driven_by_length)))
    }

    /// Whether `where` uses any measure, and so leaves out cells without curves.
    pub fn filter_uses_measures(&self) -> bool {
        self.filter.as_ref().is_some_and(|filter| !self.measures_in(filter).is_empty())
    }

    /// Whether `where` keeps a curve with these measures.
    pub fn keeps(&self, cell: &Cell, measures: &[Value]) -> bool {
        let Some(filter) = &self.filter else { return true };
        filter.evaluate(|slot| Family::scope_value(cell, measures, slot)) == 1.0
    }

    /// The value that a curve with these measures is sorted by on pages; NaN where it is not defined.
    pub fn sort_key(&self, cell: &Cell, measures: &[Value]) -> f64 {
        self.sort
            .as_ref()
            .map_or(cell.number as f64, |sort| sort.evaluate(|slot| Family::scope_value(cell, measures, slot)))
    }

    /// The caption lines of a cell, with its values and the measures of its first curve filled in; empty where the
    /// family has none.
    pub fn format_captions(&self, cell: &Cell, measures: &[Value]) -> [String; 2] {
        self.format_captions_with(cell, measures, 0)
    }

    /// The same, with more decimals than stated of derived values that are rounded.
    pub fn format_captions_with(&self, cell: &Cell, measures: &[Value], more_decimals: usize) -> [String; 2] {
        let format = |line: &Caption| self.format_line(line, cell, measures, more_decimals);
        self.captions.each_ref().map(|line| line.as_ref().map(format).unwrap_or_default())
    }

    /// A caption over [`Family::scope`] with the values of a cell and the measures of a curve filled in.
    pub fn format_caption(&self, caption: &Caption, cell: &Cell, measures: &[Value]) -> String {
        self.format_line(caption, cell, measures, 0)
    }

    fn format_line(&self, caption: &Caption, cell: &Cell, measures: &[Value], more_decimals: usize) -> String {
        static OF_CURVES: [LazyLock<Scope>; 2] =
            [LazyLock::new(|| Family::scope(&[], false)), LazyLock::new(|| Family::scope(&[], true))];
        let of_curves = &OF_CURVES[usize::from(self.template.is_driven_by_length())];
        let own_names = LazyCell::new(|| Scope::from_numbers(self.names.iter().map(String::as_str)));
        // The family's own names come before the measures.
        let find = |name: &str| match own_names.index_of(name) {
            Some(slot) => Some(ScopeName::Own(slot)),
            None => ScopeName::at(of_curves.index_of(name)?, 0),
        };
        let load = |name: &str| find(name).map_or(f64::NAN, |name| name.value(cell, measures));
        let word = |name: &str| {
            let is_named = |(measure, _): &(&Measure, &Value)| measure.name == name && measure.is_word;
            match measure::ALL.iter().zip(measures).find(is_named)? {
                (_, Value::Word(word)) => Some(*word),
                _ => Some("–"),
            }
        };
        let own_slot = |name: &str| own_names.index_of(name);
        // Values of measures are known to be rounded.
        let number = |expression: &Expression, decimals: Option<usize>, value: f64| {
            if let Some(ScopeName::Measure(k)) = expression.as_name().and_then(find)
                && let (true, "deg", Some(decimals)) =
                    (measure::ALL[k].is_input_position, measure::ALL[k].unit, decimals)
            {
                return Some((false, input_position(value, decimals)));
            }
            let is_of_dimensions = expression.names().iter().all(|name| own_slot(name).is_some());
            is_of_dimensions.then(|| match expression.as_name().and_then(own_slot) {
                Some(slot) if self.is_given(slot) => dimensions::given_number(value, decimals),
                Some(_) if dimensions::rounded_number(value, decimals).0 => {
                    dimensions::rounded_number(value, decimals.map(|n| n + more_decimals))
                }
                _ => dimensions::rounded_number(value, decimals),
            })
        };
        caption.format_with(load, word, number)
    }
}

/// A position of the input in degrees with a number of decimals. One that would be rounded up to a full turn has up to two decimals more, and is 0 if
/// these round it, too: a crank that begins at 359.6° has not turned.
fn input_position(value: f64, decimals: usize) -> String {
    const TURN: f64 = 360.0;
    let rounded = |decimals| format_fixed(value, decimals);
    let is_turn = |text: &String| value < TURN && text.parse() == Ok(TURN);
    (decimals..=decimals + 2).map(rounded).find(|text| !is_turn(text)).unwrap_or_else(|| format_fixed(0.0, decimals))
}

#[cfg(test)]
mod tests {
    use super::input_position;

    #[test]
    fn no_position_of_an_input_is_rounded_to_a_turn() {
        let positions = [
            (359.4, "359"),
            (359.6, "359.6"),
            (359.96, "359.96"),
            (359.996, "0"),
            (0.2, "0"),
            (360.2, "360"),
            (-0.2, "0"),
        ];
        for (value, text) in positions {
            assert_eq!(input_position(value, 0), text);
        }
        assert_eq!(input_position(359.96, 1), "359.96");
    }
}
