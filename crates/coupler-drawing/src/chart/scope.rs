//! The names a chart's expressions may use.

use coupler_curves::expression::{CompiledExpression, Kind};
use coupler_curves::family::Family;
use coupler_curves::measure;

/// The names of a sample itself, before the columns: the input goes by its own name.
pub(super) const SAMPLE_NAMES: [&str; 4] = ["x", "y", "input_deg", "arc"];

/// The names a chart's expressions may use: those of [`Family::scope`], and those of a single sample, `x`, `y`, the
/// input, `arc` and the columns. A family's own name goes before a sample's that is the same.
pub fn scope(names: &[String], is_driven_by_length: bool) -> Vec<(&str, Kind)> {
    let input = if is_driven_by_length { "input_length" } else { "input_deg" };
    let own = SAMPLE_NAMES.map(|name| if name == "input_deg" { input } else { name });
    let columns = measure::COLUMNS.iter().map(|column| column.name);
    let of_samples = own.into_iter().chain(columns).map(|name| (name, Kind::Number));
    Family::scope(names).into_iter().chain(of_samples).collect()
}

/// Whether an expression over [`scope`] has a value for each sample, and not for each curve.
pub fn is_per_sample(value: &CompiledExpression, names: &[String]) -> bool {
    let of_curves = Family::scope(names).len();
    value.slots().iter().any(|&slot| slot >= of_curves)
}

/// The unit of a quantity that is a single name: `deg`, or none.
pub fn unit(text: &str, is_driven_by_length: bool) -> &'static str {
    // The input of an actuator is a length, by whatever name.
    let is_input = text.starts_with("input_") || (text.starts_with("straight_") && text.ends_with("_deg"));
    let is_name = text.chars().all(|c| c.is_alphanumeric() || c == '_');
    if is_name && text.ends_with("_deg") && !(is_driven_by_length && is_input) { "deg" } else { "" }
}

/// What a quantity is, where it is a measure or a column of that name and the family has no such name of its own.
pub fn definition(text: &str, names: &[String]) -> &'static str {
    if names.iter().any(|name| name == text) {
        return "";
    }
    let measures = measure::ALL.iter().map(|measure| (measure.name, measure.definition));
    let columns = measure::COLUMNS.iter().map(|column| (column.name, column.definition));
    let own =
        [("arc", "length along the curve from its first sample"), ("input_deg", "input"), ("input_length", "input")];
    measures.chain(columns).chain(own).find(|(name, _)| *name == text).map_or("", |(_, definition)| definition)
}
