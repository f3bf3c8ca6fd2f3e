//! Numbers on a page: aligned at the decimal point, with true minus signs.

use super::super::typography::format_fixed;
use coupler_curves::text::{exact_decimals, is_same_number};

/// The decimals of a column of coordinates: all that they have, if they fit, or else as many as distinguish the values
/// from each other and from zero; at least two.
pub(super) fn coordinate_decimals(values: &[f64]) -> usize {
    /// The number of characters that fit the column.
    const MAX_CHARACTERS: usize = 7;
    const MIN_DECIMALS: usize = 2;
    let fits =
        |decimals: usize| values.iter().all(|value| format_fixed(*value, decimals).chars().count() <= MAX_CHARACTERS);
    let exact =
        values.iter().map(|value| exact_decimals(*value)).try_fold(0, |most, decimals| Some(most.max(decimals?)));
    if let Some(exact) = exact.map(|exact| exact.max(MIN_DECIMALS)).filter(|exact| fits(*exact)) {
        return exact;
    }
    let mut sorted: Vec<f64> = values.iter().copied().chain([0.0]).collect();
    sorted.sort_by(f64::total_cmp);
    let is_distinct = |pair: &[f64], decimals: usize| {
        is_same_number(pair[0], pair[1]) || format_fixed(pair[0], decimals) != format_fixed(pair[1], decimals)
    };
    let all_distinct = |decimals: usize| sorted.windows(2).all(|pair| is_distinct(pair, decimals));
    let mut decimals = MIN_DECIMALS;
    while !all_distinct(decimals) && fits(decimals + 1) {
        decimals += 1;
    }
    decimals
}

/// Whether a number with some decimals is not the number in full.
pub(super) fn is_rounded(value: f64, decimals: usize) -> bool {
    exact_decimals(value).is_none_or(|exact| exact > decimals)
}

/// The decimals with which the greatest of some magnitudes has `digits` significant digits, at most twice as many.
pub(super) fn significant_decimals(values: impl Iterator<Item = f64>, digits: usize) -> usize {
    let greatest = values.map(f64::abs).filter(|value| value.is_finite()).fold(0.0, f64::max);
    let (mut decimals, mut power) = (digits.saturating_sub(1), 1.0);
    while greatest >= 10.0 * power && decimals > 0 {
        (decimals, power) = (decimals - 1, 10.0 * power);
    }
    while greatest < power && decimals < 2 * digits {
        (decimals, power) = (decimals + 1, 0.1 * power);
    }
    decimals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_decimals_of_a_column_are_those_of_its_values_if_they_fit() {
        assert_eq!(coordinate_decimals(&[0.5, 1.0, -2.0]), 2);
        assert_eq!(coordinate_decimals(&[0.125, 1.0]), 3);
        assert_eq!(coordinate_decimals(&[1.0 / 3.0, 1.0]), 2);
        assert_eq!(coordinate_decimals(&[0.9995, 1.0005, 0.0001 / 3.0]), 5);
    }

    #[test]
    fn the_greatest_number_has_the_significant_digits() {
        let cases: [(&[f64], usize); 6] =
            [(&[1.234, 0.01], 3), (&[0.4], 4), (&[12.0], 2), (&[12_345.0], 0), (&[0.0], 8), (&[f64::NAN, 9.9], 3)];
        for (values, decimals) in cases {
            assert_eq!(significant_decimals(values.iter().copied(), 4), decimals, "{values:?}");
        }
    }
}
