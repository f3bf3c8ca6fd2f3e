//! The scale of an axis: range, ticks and tick labels.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::number::{decimal, decimal_exponent, format_fixed, format_scientific};
use crate::chart::{AxisRange, is_drawable, widen_range};

/// The options of a scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScaleOptions {
    /// Whether it is logarithmic.
    pub is_log: bool,
    /// Whether its values are degrees, for which steps such as 45 and 90 are round.
    pub is_in_degrees: bool,
    /// The least and the greatest value; those of the data if `None`.
    pub range: Option<[f64; 2]>,
    /// The ends of the scale without a `range`.
    pub ends: RangeEnds,
    /// The number of ticks that fit, about; at least 2.
    pub target_ticks: usize,
}

/// The ends of a scale that has no given range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum RangeEnds {
    /// The next round numbers.
    Round,
    /// This fraction of the range of the values beyond them.
    Padded(f64),
}

/// The scale of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    pub low: f64,
    pub high: f64,
    pub is_log: bool,
    /// The values with labels, ascending.
    pub ticks: Vec<f64>,
    /// Values without labels that have a grid line.
    minor_ticks: Vec<f64>,
    /// The power of ten of the last decimal place.
    last_decimal_exponent: i32,
}

impl Scale {
    /// The scale for some values; `None` if none of them can be drawn.
    pub fn from_values(values: impl Iterator<Item = f64>, options: &ScaleOptions) -> Option<Scale> {
        let drawn = values.filter(|&value| is_drawable(value, options.is_log));
        let (low, high) = drawn.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        if low > high {
            return None;
        }
        let mut scale =
            if options.is_log { Scale::logarithmic(low, high, options) } else { Scale::linear(low, high, options) };
        scale.ticks.retain(|tick| (scale.low..=scale.high).contains(tick));
        scale.minor_ticks.retain(|tick| (scale.low..=scale.high).contains(tick));
        Some(scale)
    }

    fn linear(low: f64, high: f64, options: &ScaleOptions) -> Scale {
        let [mut low, mut high] = options.range.unwrap_or_else(|| widen_range(low, high));
        if let (RangeEnds::Padded(fraction), None) = (options.ends, options.range) {
            let padding = fraction * (high - low);
            (low, high) = (low - padding, high + padding);
        }
        let is_rounded = options.ends == RangeEnds::Round && options.range.is_none();
        // A single number would not say what the scale is.
        let is_enough = |step: &TickStep| is_rounded || step.last(high) > step.first(low);
        let target = options.target_ticks;
        let steps = (target..target + 4).map(|target_ticks| ScaleOptions { target_ticks, ..*options });
        let mut steps = steps.map(|options| round_step(high - low, &options));
        let step = steps.find(is_enough).unwrap_or_else(|| round_step(high - low, options));
        let (mut from, mut to) = (step.first(low), step.last(high));
        if is_rounded {
            // Zero is shown if it is close to the values.
            let reaches_zero = |near: f64, far: f64| near * far > 0.0 && near.abs() < 0.25 * far.abs();
            (from, to) = (step.last(low), step.first(high));
            from = if reaches_zero(low, high) && low > 0.0 { 0.0 } else { from };
            to = if reaches_zero(high, low) && high < 0.0 { 0.0 } else { to };
            (low, high) = (low.min(step.multiple(from)), high.max(step.multiple(to)));
        }
        // The limit applies if a step is lost in rounding.
        let count = (to - from).clamp(-1.0, 100.0) as usize;
        let ticks: Vec<f64> =
            if to >= from { (0..=count).map(|k| step.multiple(from + k as f64)).collect() } else { Vec::new() };
        Scale { low, high, is_log: false, ticks, minor_ticks: Vec::new(), last_decimal_exponent: step.exponent }
    }

    fn logarithmic(low: f64, high: f64, options: &ScaleOptions) -> Scale {
        let given = options.range;
        let [low, high] = given.unwrap_or([low, high]);
        let bottom = decimal_exponent(low);
        let top = decimal_exponent(high) + 1;
        let multiples = |digits: &[u32]| -> Vec<f64> {
            (bottom..=top).flat_map(|power| digits.iter().map(move |&digit| decimal(f64::from(digit), power))).collect()
        };
        let round = multiples(&[1, 2, 5]);
        let below = round.iter().copied().filter(|tick| *tick <= low).fold(low, |_, tick| tick);
        let above = round.iter().copied().find(|tick| *tick >= high).unwrap_or(high);
        let [mut low, mut high] = if given.is_some() { [low, high] } else { [below, above] };
        if low >= high {
            (low, high) = (low / 2.0, high * 2.0);
        }
        let within = |tick: &f64| (low..=high).contains(tick);
        let powers: Vec<f64> = multiples(&[1]).into_iter().filter(within).collect();
        let round_count = round.iter().copied().filter(within).count();
        let (ticks, minor) = if powers.len() >= 2 && round_count > options.target_ticks.max(2) + 2 {
            let stride = powers.len().div_ceil(options.target_ticks.max(2));
            let minor = if stride > 1 { powers.clone() } else { multiples(&[2, 3, 4, 5, 6, 7, 8, 9]) };
            (powers.into_iter().step_by(stride).collect(), minor)
        } else {
            (round, multiples(&[3, 4, 6, 7, 8, 9]))
        };
        Scale { low, high, is_log: true, ticks, minor_ticks: minor, last_decimal_exponent: bottom }
    }

    /// The position of a value along the axis: 0 at its start, 1 at its end; clamped to a million lengths of the axis.
    /// A value that cannot be drawn is at its start.
    pub fn fraction(&self, value: f64) -> f64 {
        let axis = AxisRange { low: self.low, high: self.high, is_log: self.is_log };
        axis.fraction(value).unwrap_or(0.0).clamp(-1e6, 1e6)
    }

    /// The label of a tick: `0.25`, `−3`, or `2×10⁻⁷` if the ticks are far from 1.
    pub fn tick_label(&self, tick: f64) -> String {
        let most = self.ticks.iter().fold(0.0, |most: f64, tick| most.max(tick.abs()));
        if self.is_log {
            let least = self.ticks.first().copied().unwrap_or(1.0);
            let is_plain = decimal_exponent(least) >= -4 && decimal_exponent(most) <= 4;
            return if is_plain {
                format_fixed(tick, -decimal_exponent(tick))
            } else {
                format_scientific(tick, decimal_exponent(tick), 0)
            };
        }
        let power = if most > 0.0 { decimal_exponent(most) } else { 0 };
        // 2, 4, …, 10 rather than 0.2, 0.4, …, 1.0.
        let is_ten = power - self.last_decimal_exponent == 1 && most == decimal(1.0, power);
        let power = if is_ten && !(-4..=5).contains(&power) { self.last_decimal_exponent } else { power };
        if (-4..=5).contains(&power) {
            format_fixed(tick, -self.last_decimal_exponent)
        } else {
            format_scientific(tick, power, power - self.last_decimal_exponent)
        }
    }
}

/// A round step between ticks: `units` times a power of ten.
struct TickStep {
    units: f64,
    exponent: i32,
}

impl TickStep {
    /// The number of steps from zero to a value.
    fn steps_from_zero(&self, value: f64) -> f64 {
        value / decimal(self.units, self.exponent)
    }

    /// The first multiple from a value on, and the last up to it, in steps.
    fn first(&self, from: f64) -> f64 {
        (self.steps_from_zero(from) - 1e-9).ceil()
    }

    fn last(&self, to: f64) -> f64 {
        (self.steps_from_zero(to) + 1e-9).floor()
    }

    /// A multiple of the step, correctly rounded.
    fn multiple(&self, steps: f64) -> f64 {
        decimal(steps * self.units, self.exponent)
    }
}

/// The least round step that makes no more ticks than the target.
fn round_step(length: f64, options: &ScaleOptions) -> TickStep {
    const DEGREES: [f64; 12] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0, 720.0];
    let least = length / options.target_ticks.max(2) as f64;
    let in_degrees = DEGREES.into_iter().find(|step| *step >= least * (1.0 - 1e-9));
    if let (true, true, Some(units)) = (options.is_in_degrees, least >= 0.5, in_degrees) {
        return TickStep { units, exponent: 0 };
    }
    let exponent = decimal_exponent(least);
    let fits = |units: &f64| decimal(*units, exponent) >= least * (1.0 - 1e-9);
    match [1.0, 2.0, 5.0].into_iter().find(fits) {
        Some(units) => TickStep { units, exponent },
        None => TickStep { units: 1.0, exponent: exponent + 1 },
    }
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (self.fraction(*value) * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { self.minor_ticks.clone() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        self.tick_label(*value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64], options: ScaleOptions) -> Vec<String> {
        let scale = Scale::from_values(values.iter().copied(), &options).unwrap();
        scale.ticks.iter().map(|tick| scale.tick_label(*tick)).collect()
    }

    const ROUND: ScaleOptions =
        ScaleOptions { is_log: false, is_in_degrees: false, range: None, ends: RangeEnds::Round, target_ticks: 6 };

    #[test]
    fn ticks_are_round_and_have_short_labels() {
        assert_eq!(labels(&[1.2, 3.9], ROUND), ["1.0", "1.5", "2.0", "2.5", "3.0", "3.5", "4.0"]);
        assert_eq!(labels(&[0.1, 3.9], ROUND), ["0", "1", "2", "3", "4"]);
        assert_eq!(labels(&[-0.031, 0.02], ROUND), ["−0.04", "−0.03", "−0.02", "−0.01", "0.00", "0.01", "0.02"]);
        assert_eq!(labels(&[2.0e-12, 9.7e-12], ROUND), ["0", "2×10⁻¹²", "4×10⁻¹²", "6×10⁻¹²", "8×10⁻¹²", "10×10⁻¹²"]);
        assert_eq!(labels(&[0.0, 3.0e12], ROUND).last().unwrap(), "3.0×10¹²");
        assert_eq!(labels(&[1.0, 1.0 + 4e-10], ROUND)[1], "1.0000000001");
        let degrees = ScaleOptions { is_in_degrees: true, ends: RangeEnds::Padded(0.0), ..ROUND };
        assert_eq!(labels(&[0.0, 360.0], degrees), ["0", "60", "120", "180", "240", "300", "360"]);
        assert_eq!(labels(&[35.2, 98.0], degrees), ["45", "60", "75", "90"]);
        let narrow = ScaleOptions { ends: RangeEnds::Padded(0.0), target_ticks: 2, ..ROUND };
        assert_eq!(labels(&[2.2, 5.8], narrow), ["3", "4", "5"]);
    }

    #[test]
    fn a_logarithmic_scale_has_powers_of_ten() {
        let log = ScaleOptions { is_log: true, ..ROUND };
        assert_eq!(labels(&[3e-7, 4e-3], log), ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"]);
        assert_eq!(labels(&[0.002, 40.0], log), ["0.01", "0.1", "1", "10"]);
        assert_eq!(labels(&[0.02, 0.4], log), ["0.02", "0.05", "0.1", "0.2", "0.5"]);
        assert_eq!(labels(&[30.0, 40.0], log), ["20", "50"]);
        assert_eq!(labels(&[1e-30, 1.0], log).len(), 6, "every sixth power of 31");
        // Values that are not positive have no logarithm.
        assert_eq!(Scale::from_values([0.0, -1.0].into_iter(), &log), None);
        let scale = Scale::from_values([0.0, 0.01, 10.0].into_iter(), &log).unwrap();
        assert_eq!([0.01, 0.1, 1.0, 10.0].map(|v| (scale.fraction(v) * 3.0).round()), [0.0, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn extreme_values_do_not_panic() {
        let extreme =
            [0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, f64::NAN, f64::INFINITY, 1e300];
        let variants = [false, true].map(|is_log| ScaleOptions { is_log, ..ROUND });
        for &a in &extreme {
            for &b in &extreme {
                for options in variants
                    .iter()
                    .flat_map(|o| [*o, ScaleOptions { ends: RangeEnds::Padded(0.03), is_in_degrees: true, ..*o }])
                {
                    let Some(scale) = Scale::from_values([a, b].into_iter(), &options) else { continue };
                    assert!(scale.low < scale.high, "{a} {b} {options:?}: {scale:?}");
                    assert!(scale.ticks.iter().all(|tick| !scale.tick_label(*tick).is_empty()));
                    for value in [a, b].into_iter().filter(|v| is_drawable(*v, options.is_log)) {
                        assert!(
                            (-1e-9..=1.0 + 1e-9).contains(&scale.fraction(value)),
                            "{a} {b} {options:?}: {scale:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_single_value_is_in_the_middle() {
        for value in [0.0, 5.0, -3e-9, 2e12] {
            let scale = Scale::from_values([value, value * (1.0 + 1e-15)].into_iter(), &ROUND).unwrap();
            assert!((0.2..0.8).contains(&scale.fraction(value)), "{scale:?}");
        }
    }
}
