//! Names with their values.

use coupler_curves::text::round_to_six_digits;

/// A name with its value, as in "A = 1.5".
pub(super) fn assignment(names: &[String], slot: usize, value: f64) -> String {
    format!("{} = {}", names.get(slot).map_or("", String::as_str), round_to_six_digits(value))
}

/// A name with its values from the least to the greatest, as in "A = 1.5 to 4", or with its only value.
pub(super) fn range(names: &[String], slot: usize, values: impl Iterator<Item = f64>) -> String {
    let [least, greatest] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    let least_said = assignment(names, slot, least);
    if least == greatest { least_said } else { format!("{least_said} to {}", round_to_six_digits(greatest)) }
}
