//! The names that the expressions of a chart may use.

use coupler_curves::expression::{CompiledExpression, Kind, Scope};
use coupler_curves::family::Family;
use coupler_curves::measure;

/// The names of the values of a sample other than the columns; `input_deg` is `input_length` if the input is a length.
pub(super) const SAMPLE_NAMES: [&str; 4] = ["x", "y", "input_deg", "arc"];

/// The names that the expressions of a chart may use, with their kinds: those of [`Family::scope`], then those of a
/// sample, which are `x`, `y`, the input, `arc` and the columns. A family's own name takes precedence over a sample's.
pub fn scope(names: &[String], is_driven_by_length: bool) -> Scope<'_> {
    let input = if is_driven_by_length { "input_length" } else { "input_deg" };
    let sample_names = SAMPLE_NAMES.map(|name| if name == "input_deg" { input } else { name });
    let columns = measure::COLUMNS.iter().map(|column| column.name);
    let of_samples = sample_names.into_iter().chain(columns).map(|name| (name, Kind::Number));
    let mut scope = Family::scope(names, is_driven_by_length);
    scope.extend(of_samples);
    scope
}

/// Whether an expression over [`scope`] has a value for each sample rather than for each curve.
pub fn is_per_sample(value: &CompiledExpression, names: &[String]) -> bool {
    let curve_slots = Family::scope(names, false).len();
    value.slots().iter().any(|&slot| slot >= curve_slots)
}
