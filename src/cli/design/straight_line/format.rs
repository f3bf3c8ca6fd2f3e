//! Numbers and proportions of designs, as text.

use crate::design::Design;

use crate::format::format_significant;

/// A ratio with two decimals, or ∞.
pub(super) fn format_ratio(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "∞".to_owned() }
}

/// The parameters of a design, including derived ones: "p = 2, r = 1.5".
pub(super) fn proportions(design: &Design) -> String {
    let parameters = design.family.template.parameters.iter();
    let values = parameters
        .map(|parameter| format!("{} = {}", parameter.name, format_significant(design.parameter(&parameter.name), 6)));
    values.collect::<Vec<_>>().join(", ")
}
