//! Numbers and counts, as text.

/// A number rounded to `digits` significant digits without trailing zeros; in scientific notation if its magnitude is
/// below `least_decimal` or at least 1e7.
pub(super) fn format_significant(value: f64, digits: usize, least_decimal: f64) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    match rounded {
        0.0 => "0".to_owned(),
        x if x.is_finite() && !(least_decimal..1e7).contains(&x.abs()) => format!("{x:e}"),
        x => x.to_string(),
    }
}

/// "1 page", "2 pages".
pub(super) fn pluralize(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}
