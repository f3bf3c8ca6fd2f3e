//! The ranges of parameters, as parts of them from 0 to 1.

use coupler_curves::geometry::trig;

/// A parameter that varies within a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    /// The parameter.
    pub slot: usize,
    pub range: Range,
    /// The distance of the values that it may have, from the low end of the range on; any if `None`.
    pub step: Option<f64>,
}

/// A range, and how it is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    /// By equal factors; both ends are positive.
    Factors([f64; 2]),
    /// By equal differences.
    Differences([f64; 2]),
    /// A whole turn from an angle on: its length in the unit of the angle.
    Turn { from: f64, length: f64 },
}

impl Range {
    /// The range between two numbers, by factors if both are positive.
    pub fn new(ends: [f64; 2]) -> Range {
        if ends[0] > 0.0 { Range::Factors(ends) } else { Range::Differences(ends) }
    }

    pub fn ends(self) -> [f64; 2] {
        match self {
            Range::Factors(ends) | Range::Differences(ends) => ends,
            Range::Turn { from, length } => [from, from + length],
        }
    }
}

impl Axis {
    /// The value at a part of the range; beyond its ends it comes back, and a turn goes on.
    pub fn value(&self, part: f64) -> f64 {
        let value = self.unstepped(part);
        let [low, high] = self.range.ends();
        match self.step {
            Some(step) => low + ((value - low) / step).round().min(((high - low) / step + 1e-9).floor()) * step,
            None => value,
        }
    }

    /// The same, whatever its steps.
    pub fn unstepped(&self, part: f64) -> f64 {
        let within = 1.0 - (part.rem_euclid(2.0) - 1.0).abs();
        match self.range {
            Range::Factors([low, high]) => (low * trig::exp(trig::ln(high / low) * within)).clamp(low, high),
            Range::Differences([low, high]) => (low + (high - low) * within).clamp(low, high),
            Range::Turn { from, length } => from + length * part.rem_euclid(1.0),
        }
    }

    /// The part of the range at which a value is; `None` if it is beyond it.
    pub fn part(&self, value: f64) -> Option<f64> {
        let [low, high] = self.range.ends();
        let rounding = 1e-9 * (high - low);
        let part = match self.range {
            Range::Factors(_) => trig::ln((value / low).max(f64::MIN_POSITIVE)) / trig::ln(high / low),
            Range::Differences(_) | Range::Turn { .. } => (value - low) / (high - low),
        };
        (value >= low - rounding && value <= high + rounding).then_some(part.clamp(0.0, 1.0))
    }

    /// The part of the range at which the value is some steps from that at another part; `None` if it would leave the range.
    pub fn stepped(&self, part: f64, steps: f64) -> Option<f64> {
        self.part(self.value(part) + steps * self.step?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stay_in_their_range() {
        let axis = |range, step| Axis { slot: 0, range, step };
        let factors = axis(Range::new([20.0, 80.0]), None);
        assert!((factors.value(0.5) - 40.0).abs() < 1e-12);
        assert_eq!([factors.value(0.0), factors.value(1.0), factors.value(2.0)], [20.0, 80.0, 20.0]);
        let whole = axis(Range::new([-3.0, 4.5]), Some(1.0));
        for k in -20..40 {
            let value = whole.value(f64::from(k) / 9.0);
            assert!((-3.0..=4.0).contains(&value) && value.fract() == 0.0, "{value}");
        }
        let turn = axis(Range::Turn { from: -180.0, length: 360.0 }, None);
        assert_eq!([turn.value(0.25), turn.value(1.25), turn.value(-0.75)], [-90.0; 3]);
    }
}
