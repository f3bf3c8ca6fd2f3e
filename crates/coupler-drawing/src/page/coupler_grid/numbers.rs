//! Numbers on a page: aligned at the decimal point, with true minus signs.

use super::super::typography::format_fixed;
use coupler_curves::expression::format_exactly;

/// The greatest relative difference of a value from the number that it stands for: coordinates on a link were divided
/// and are multiplied by the length of their base, which are two roundings, of half an epsilon each.
const ROUNDING: f64 = 1.5 * f64::EPSILON;

/// The decimals that are tried: fewer than give some doubles of about 1 or less in full.
const MAX_DECIMALS: usize = 17;

/// A number in full: with the fewest decimals that give it up to rounding, as a fraction if these are many, or with all digits of
/// the double.
pub(super) fn format_in_full(value: f64) -> String {
    const MAX_SHORT: usize = 8;
    let decimals = exact_decimals(value);
    match decimals {
        Some(decimals) if decimals <= MAX_SHORT => format_fixed(value, decimals),
        _ => fraction(value).or_else(|| Some(format_fixed(value, decimals?))).unwrap_or_else(|| format_exactly(value)),
    }
}

/// A number as a fraction with a denominator below 1000, if it is one up to rounding.
fn fraction(value: f64) -> Option<String> {
    const MAX_DENOMINATOR: u32 = 999;
    let numerator = |denominator: u32| {
        let numerator = (value * f64::from(denominator)).round();
        ((numerator / f64::from(denominator) - value).abs() <= ROUNDING * value.abs()).then_some(numerator)
    };
    let (numerator, denominator) = (2..=MAX_DENOMINATOR).find_map(|d| Some((numerator(d)?, d)))?;
    Some(format!("{} / {denominator}", format_exactly(numerator)))
}

/// The fewest decimals with which a number is given in full, up to rounding.
pub(super) fn exact_decimals(value: f64) -> Option<usize> {
    let is_exact = |decimals: &usize| {
        let read = format!("{value:.decimals$}").parse::<f64>();
        read.is_ok_and(|read| (read - value).abs() <= ROUNDING * value.abs())
    };
    (0..MAX_DECIMALS).find(is_exact)
}

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
        let is_equal = pair[1] - pair[0] <= ROUNDING * pair[0].abs().max(pair[1].abs());
        is_equal || format_fixed(pair[0], decimals) != format_fixed(pair[1], decimals)
    };
    let all_distinct = |decimals: usize| sorted.windows(2).all(|pair| is_distinct(pair, decimals));
    let mut decimals = MIN_DECIMALS;
    while !all_distinct(decimals) && fits(decimals + 1) {
        decimals += 1;
    }
    decimals
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
    fn numbers_in_full_have_no_digits_of_rounding() {
        let third = 1.0 / 3.0;
        let numbers = [(2.5, "2.5"), (3.0, "3"), (-0.25, "−0.25"), (0.1 + 0.2, "0.3"), (0.0, "0")];
        for (value, text) in numbers {
            assert_eq!(format_in_full(value), text);
        }
        assert_eq!(format_in_full(third), "1 / 3");
        assert_eq!(format_in_full(-0.5 + 1.0 / 3.0), "−1 / 6");
        assert_eq!(format_in_full(6.0_f64.sqrt()).parse::<f64>(), Ok(6.0_f64.sqrt()));
    }

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
