//! The parts of a circuit on which a function is monotonic, and where it reaches a value.

use super::{CircuitFunction, NARROW, Place, Quantity};
use crate::numerical::Bracket;

/// A part of a span on which the function is monotonic.
#[derive(Clone, Copy, Debug)]
pub(in crate::measure) struct MonotonicPart {
    span: usize,
    ends: [f64; 2],
    /// The values at evenly spaced places, from one end to the other.
    samples: [f64; MonotonicPart::SAMPLES + 1],
}

impl MonotonicPart {
    /// The intervals between the samples.
    pub(in crate::measure) const SAMPLES: usize = 8;

    /// The values at its ends.
    pub(in crate::measure) fn values(&self) -> [f64; 2] {
        [self.samples[0], self.samples[MonotonicPart::SAMPLES]]
    }
}

/// The parameter at a fraction of the way between two.
fn between([from, to]: [f64; 2], fraction: f64) -> f64 {
    from + (to - from) * fraction
}

/// The parameter of a sample of the part between two.
fn sampled(ends: [f64; 2], k: usize) -> f64 {
    between(ends, k as f64 / MonotonicPart::SAMPLES as f64)
}

impl<Q: Quantity> CircuitFunction<Q> {
    /// The monotonic parts of the function, in the order of the circuit, without those that are so narrow that a stationary point is not
    /// told from the end of its span.
    pub(in crate::measure) fn monotonic_parts(&self) -> Vec<MonotonicPart> {
        let mut parts = Vec::new();
        for (span, function) in self.spans.iter().enumerate() {
            let cuts: Vec<f64> = [-1.0].into_iter().chain(function.roots.iter().copied()).chain([1.0]).collect();
            for ends in cuts.windows(2).map(|cuts| [cuts[0], cuts[1]]).filter(|[from, to]| to - from > NARROW) {
                let samples = std::array::from_fn(|k| function.series.at(sampled(ends, k)));
                parts.push(MonotonicPart { span, ends, samples });
            }
        }
        parts
    }

    /// The place in a monotonic part at which a value between those at its ends is reached, to an accuracy of the parameter.
    pub(in crate::measure) fn solve_in_part(&self, part: &MonotonicPart, value: f64, accuracy: f64) -> Place {
        let series = &self.spans[part.span].series;
        // Between the two samples nearest to it.
        let [first, last] = part.values();
        let is_before = |sample: &f64| (*sample < value) == (first < last);
        let after = part.samples.iter().position(|sample| !is_before(sample));
        let after = after.unwrap_or(MonotonicPart::SAMPLES).max(1);
        let ends = [after - 1, after].map(|k| sampled(part.ends, k));
        let excesses = [after - 1, after].map(|k| part.samples[k] - value);
        let nearer = ends[if excesses[0].abs() < excesses[1].abs() { 0 } else { 1 }];
        let bracket = Bracket::new(ends, excesses);
        let u = bracket.map_or(nearer, |bracket| bracket.zero(accuracy, |u| series.at(u) - value));
        Place { span: part.span, u }
    }

    /// The derivatives of the function and of the covered input with respect to the parameter of the piece at a place.
    pub(in crate::measure) fn slope_and_input_rate(&self, place: Place) -> [f64; 2] {
        let span = &self.spans[place.span];
        [span.slope.at(place.u), span.piece.map.input_rate(place.u).abs()]
    }

    /// The place at a fraction of a monotonic part.
    pub(in crate::measure) fn place_in_part(&self, part: &MonotonicPart, fraction: f64) -> Place {
        Place { span: part.span, u: between(part.ends, fraction) }
    }

    /// The fraction of a monotonic part at which a place on it is.
    pub(in crate::measure) fn fraction_of_part(&self, part: &MonotonicPart, place: Place) -> f64 {
        ((place.u - part.ends[0]) / (part.ends[1] - part.ends[0])).clamp(0.0, 1.0)
    }
}
