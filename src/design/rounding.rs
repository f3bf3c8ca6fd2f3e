//! Values to a few digits.

/// Rounds a number to four significant digits, up or down.
pub(super) fn round_to_four_digits(value: f64, up: bool) -> f64 {
    let power: i32 = format!("{value:e}").split('e').nth(1).and_then(|power| power.parse().ok()).unwrap_or(0);
    let digits = |power: i32| format!("1e{power}").parse::<f64>().unwrap_or(1.0);
    let units = value / digits(power - 3);
    let units = if up { units.ceil() } else { units.floor() };
    format!("{units}e{}", power - 3).parse().unwrap_or(value)
}
