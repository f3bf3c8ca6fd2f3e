//! Numbers as people read them.

/// A number in the fewest digits that read back to the same value, with a true minus sign.
pub fn format_exactly(value: f64) -> String {
    // Adding 0 makes a negative zero positive.
    (value + 0.0).to_string().replace('-', "−")
}

/// A number as people write it: exactly, or if that takes more digits than anyone writes, for it was computed, in six significant digits after ≈.
pub fn format_as_written(value: f64) -> String {
    let (exact, rounded) = (format_exactly(value), round_to_six_digits(value));
    match is_same_number(value, rounded) {
        true => format_exactly(rounded),
        false if count_digits(&exact) <= MAX_WRITTEN_DIGITS => exact,
        false => format!("≈{}", format_exactly(rounded)),
    }
}

/// A number in full, if anyone writes it so: in a dozen digits, or as a fraction, with its decimal beside it if the denominator is more than 12.
pub fn format_in_full_if_short(value: f64) -> Option<String> {
    const MAX_SIMPLE_DENOMINATOR: u32 = 12;
    let in_full = Some(format_in_full(value)).filter(|text| count_digits(text) <= MAX_WRITTEN_DIGITS)?;
    let is_simple = !in_full.contains('/') || fraction(value, MAX_SIMPLE_DENOMINATOR).is_some();
    Some(if is_simple { in_full } else { format_for_building(value) })
}

/// A number in full, and its decimal beside a fraction, for a workshop.
pub fn format_for_building(value: f64) -> String {
    match format_in_full(value) {
        text if text.contains('/') => format!("{text} ≈ {}", format_exactly(round_to_six_digits(value))),
        text => text,
    }
}

/// The most digits that anyone writes.
const MAX_WRITTEN_DIGITS: usize = 12;

/// The number of digits of a number.
fn count_digits(number: &str) -> usize {
    number.chars().filter(char::is_ascii_digit).count()
}

/// A number with a fixed number of decimals; a zero has no minus sign.
pub fn format_fixed(value: f64, decimals: usize) -> String {
    let number = format!("{value:.decimals$}");
    let is_zero = number.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { number.trim_start_matches('-').to_owned() } else { number }
}

/// The value rounded to six significant digits.
pub fn round_to_six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// A value rounded to the fewest significant digits, at least six, in which it differs from another one.
pub fn round_apart(value: f64, other: f64) -> f64 {
    let rounded = |value: f64, digits: usize| format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    (6..17)
        .map(|digits| [value, other].map(|value| rounded(value, digits)))
        .find(|[a, b]| a != b)
        .map_or(value, |[a, _]| a)
}

/// Whether two values stand for one number, up to rounding: coordinates on a link were divided and are multiplied by the length of
/// their base, which are two roundings, of half an epsilon each.
pub fn is_same_number(a: f64, b: f64) -> bool {
    const ROUNDING: f64 = 1.5 * f64::EPSILON;
    (a - b).abs() <= ROUNDING * a.abs().max(b.abs())
}

/// The decimals that are tried: fewer than give some doubles of about 1 or less in full.
const MAX_DECIMALS: usize = 17;

/// A number in full: with the fewest decimals that give it up to rounding, as a fraction if these are many, or with all digits of
/// the double.
pub fn format_in_full(value: f64) -> String {
    const MAX_SHORT: usize = 8;
    const MAX_DENOMINATOR: u32 = 999;
    let typographic = |decimals: usize| format_fixed(value, decimals).replace('-', "−");
    let decimals = exact_decimals(value);
    match decimals {
        Some(decimals) if decimals <= MAX_SHORT => typographic(decimals),
        _ => fraction(value, MAX_DENOMINATOR)
            .or_else(|| Some(typographic(decimals?)))
            .unwrap_or_else(|| format_exactly(value)),
    }
}

/// A number as a fraction with a denominator up to a greatest one, if it is one up to rounding.
fn fraction(value: f64, max_denominator: u32) -> Option<String> {
    let numerator = |denominator: u32| {
        let numerator = (value * f64::from(denominator)).round();
        is_same_number(numerator / f64::from(denominator), value).then_some(numerator)
    };
    let (numerator, denominator) = (2..=max_denominator).find_map(|d| Some((numerator(d)?, d)))?;
    Some(format!("{} / {denominator}", format_exactly(numerator)))
}

/// The fewest decimals with which a number is given in full, up to rounding.
pub fn exact_decimals(value: f64) -> Option<usize> {
    let is_exact = |decimals: &usize| {
        let read = format!("{value:.decimals$}").parse::<f64>();
        read.is_ok_and(|read| is_same_number(read, value))
    };
    (0..MAX_DECIMALS).find(is_exact)
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
    fn numbers_that_no_one_writes_are_rounded_and_fractions_to_build_by_have_decimals() {
        for (value, short, to_build_by, written) in [
            (2.5, Some("2.5"), "2.5", "2.5"),
            (10.0 / 3.0, Some("10 / 3"), "10 / 3 ≈ 3.33333", "≈3.33333"),
            (59.0 / 19.0, Some("59 / 19 ≈ 3.10526"), "59 / 19 ≈ 3.10526", "≈3.10526"),
            (-35.367_540_827_182_72, None, "−35.36754082718272", "≈−35.3675"),
            (0.1 + 0.2, Some("0.3"), "0.3", "0.3"),
            (1.234_567_89, Some("1.23456789"), "1.23456789", "1.23456789"),
        ] {
            assert_eq!(format_in_full_if_short(value).as_deref(), short);
            assert_eq!(format_for_building(value), to_build_by);
            assert_eq!(format_as_written(value), written);
        }
    }

    #[test]
    fn numbers_that_are_compared_are_told_apart() {
        for (a, b, texts) in [
            (2.5, 3.25, ["2.5", "3.25"]),
            (2.5, 2.500001, ["2.5", "2.500001"]),
            (2.4999999996, 2.5, ["2.4999999996", "2.5"]),
            (1.0, 1.0 + f64::EPSILON, ["1", "1.0000000000000002"]),
            (3.0, 3.0, ["3", "3"]),
        ] {
            assert_eq!([round_apart(a, b), round_apart(b, a)].map(|x| x.to_string()), texts);
        }
    }

    #[test]
    fn long_decimals_that_are_fractions_are_written_as_fractions() {
        for (value, text) in [
            (22.0 / 9.0, "22 / 9"),
            (-1.0 / 3.0, "−1 / 3"),
            (2.5, "2.5"),
            (1.0 / 1024.0, "0.0009765625"),
            (2.598_076_211_353_316, "2.598076211353316"),
            (1e-300, &format_exactly(1e-300)),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(format_in_full(value), text);
        }
    }
}
