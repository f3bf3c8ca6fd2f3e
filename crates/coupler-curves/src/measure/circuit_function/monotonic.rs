//! The parts of a circuit on which a function is monotonic, and where it reaches a value.

use super::{CircuitFunction, Place, Quantity};

/// A part of a span on which the function is monotonic.
#[derive(Clone, Copy, Debug)]
pub(in crate::measure) struct MonotonicPart {
    span: usize,
    ends: [f64; 2],
    /// The values at its ends.
    pub values: [f64; 2],
}

impl<Q: Quantity> CircuitFunction<Q> {
    /// The monotonic parts of the function, in the order of the circuit.
    pub(in crate::measure) fn monotonic_parts(&self) -> Vec<MonotonicPart> {
        let mut parts = Vec::new();
        for (span, function) in self.spans.iter().enumerate() {
            let cuts: Vec<f64> = [-1.0].into_iter().chain(function.roots.iter().copied()).chain([1.0]).collect();
            for ends in cuts.windows(2).filter(|ends| ends[1] > ends[0]) {
                let values = [ends[0], ends[1]].map(|u| function.series.at(u));
                parts.push(MonotonicPart { span, ends: [ends[0], ends[1]], values });
            }
        }
        parts
    }

    /// The place in a monotonic part at which a value between those at its ends is reached.
    pub(in crate::measure) fn solve_in_part(&self, part: &MonotonicPart, value: f64) -> Place {
        let series = &self.spans[part.span].series;
        let is_bracketed = (part.values[0] < value) != (part.values[1] < value);
        let u = if is_bracketed {
            solve_between(|u| series.at(u) - value, part.ends)
        } else if (part.values[0] - value).abs() < (part.values[1] - value).abs() {
            part.ends[0]
        } else {
            part.ends[1]
        };
        Place { span: part.span, u }
    }

    /// The place at a fraction of a monotonic part.
    pub(in crate::measure) fn place_in_part(&self, part: &MonotonicPart, fraction: f64) -> Place {
        Place { span: part.span, u: part.ends[0] + (part.ends[1] - part.ends[0]) * fraction }
    }

    /// The fraction of a monotonic part at which a place on it is.
    pub(in crate::measure) fn fraction_of_part(&self, part: &MonotonicPart, place: Place) -> f64 {
        ((place.u - part.ends[0]) / (part.ends[1] - part.ends[0])).clamp(0.0, 1.0)
    }
}

/// A root of a function between two points at which its signs differ, to rounding, by false position with the weights
/// of Illinois (Dowell and Jarratt 1971).
pub(super) fn solve_between(f: impl Fn(f64) -> f64, [mut a, mut b]: [f64; 2]) -> f64 {
    const ROUNDS: usize = 100;
    let rounding = f64::EPSILON * a.abs().max(b.abs());
    let (mut fa, mut fb) = (f(a), f(b));
    if fa == 0.0 {
        return a;
    }
    for round in 0..ROUNDS {
        if fb == 0.0 || (b - a).abs() <= rounding {
            break;
        }
        let step = fb * (b - a) / (fb - fa);
        if step.abs() <= rounding / 2.0 {
            break;
        }
        // Every third round halves the bracket, in case the secant moves one of its ends only.
        let c = if step.is_finite() && round % 3 != 2 { b - step } else { (a + b) / 2.0 };
        let fc = f(c);
        if (fc < 0.0) == (fb < 0.0) {
            fa /= 2.0;
        } else {
            (a, fa) = (b, fb);
        }
        (b, fb) = (c, fc);
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::trig;

    #[test]
    fn a_bracketed_root_is_found_to_rounding() {
        let root = solve_between(|x| x * x * x - 2.0, [0.0, 3.0]);
        assert!((root * root * root - 2.0).abs() < 2e-15);
        let steep = solve_between(|x| trig::atan2(x - 0.7, 1e-9), [-1.0, 1.0]);
        assert!((steep - 0.7).abs() < 1e-15);
    }
}
