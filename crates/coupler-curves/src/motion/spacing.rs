//! Samples that are not even in the input: dense towards limits, or even along the path.

use std::f64::consts::PI;

use super::circuit::Pass;
use super::path;
use crate::geometry::trig;
use crate::linkage::{JointId, Linkage};

/// The input at a part of a pass, dense towards the ends where a dyad lies flat: there a joint's place goes with the
/// root of the input, and this makes it go evenly.
pub(super) fn eased_input(pass: &Pass, part: f64) -> f64 {
    let (from, to) = (pass.from.input.value, pass.to.input.value);
    let eased = match (pass.from.flat_dyads.is_empty(), pass.to.flat_dyads.is_empty()) {
        (true, true) => part,
        (false, true) => 1.0 - trig::cos(PI / 2.0 * part),
        (true, false) => trig::sin(PI / 2.0 * part),
        (false, false) => (1.0 - trig::cos(PI * part)) / 2.0,
    };
    from + (to - from) * eased
}

/// How far a joint has come along its path, at many places of a pass.
pub(super) struct CumulativeLength {
    /// Parts of the pass, as [`eased_input`] takes them.
    pass_fractions: Vec<f64>,
    /// Length of the path up to there.
    lengths: Vec<f64>,
}

impl CumulativeLength {
    /// Measures a joint's path over a pass by chords: with so many of them an arc and its chord differ by less than a
    /// part in a hundred thousand.
    pub fn measure(linkage: &Linkage, pass: &Pass, joint: JointId) -> CumulativeLength {
        const CHORDS: usize = 2048;
        let parts: Vec<f64> = (0..=CHORDS).map(|i| i as f64 / CHORDS as f64).collect();
        let inputs: Vec<f64> = parts.iter().map(|&part| eased_input(pass, part)).collect();
        let places = path::positions_at_inputs(linkage, pass, &inputs);
        let mut lengths = vec![0.0];
        for i in 1..parts.len() {
            let chord = (places.point(joint, i) - places.point(joint, i - 1)).norm();
            // A place that is undefined adds nothing.
            lengths.push(lengths[i - 1] + if chord.is_finite() { chord } else { 0.0 });
        }
        CumulativeLength { pass_fractions: parts, lengths }
    }

    /// The whole length.
    pub fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The part of the pass at which so much of the whole length is behind.
    pub fn pass_fraction(&self, share: f64) -> f64 {
        let length = share * self.total();
        let i = self.lengths.partition_point(|l| *l < length).clamp(1, self.lengths.len() - 1);
        let [before, after] = [self.lengths[i - 1], self.lengths[i]];
        let over = if after > before { (length - before) / (after - before) } else { 1.0 };
        self.pass_fractions[i - 1] + (self.pass_fractions[i] - self.pass_fractions[i - 1]) * over
    }
}
