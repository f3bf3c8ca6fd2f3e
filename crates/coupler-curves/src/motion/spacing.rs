//! Samples that are not evenly spaced in the input: denser towards limits, or evenly spaced along a path.

use std::f64::consts::PI;

use super::input_columns::InputColumns;
use super::pass::Pass;
use super::pass_positions::positions_at_inputs;
use crate::geometry::trig;
use crate::linkage::{JointId, Linkage};

/// The input at a fraction of a pass, eased towards the ends where a dyad is flat: there a joint's position changes
/// with the root of the input, and so evenly with this fraction.
pub fn eased_input(pass: &Pass, fraction: f64) -> f64 {
    let (from, to) = (pass.from.input.value, pass.to.input.value);
    let eased = match (pass.from.flat_dyads.is_empty(), pass.to.flat_dyads.is_empty()) {
        (true, true) => fraction,
        (false, true) => 1.0 - trig::cos(PI / 2.0 * fraction),
        (true, false) => trig::sin(PI / 2.0 * fraction),
        (false, false) => (1.0 - trig::cos(PI * fraction)) / 2.0,
    };
    from + (to - from) * eased
}

/// The fraction of a pass at which an input is reached, eased as by [`eased_input`]: from 0 to 1, also for an input beyond the pass.
pub fn eased_fraction(pass: &Pass, input: f64) -> f64 {
    let (from, to) = (pass.from.input.value, pass.to.input.value);
    let [before, after] = [(input - from) / (to - from), (to - input) / (to - from)].map(|part| part.clamp(0.0, 1.0));
    let quarter_turns = |sine: f64| trig::asin(sine) / (PI / 2.0);
    match (pass.from.flat_dyads.is_empty(), pass.to.flat_dyads.is_empty()) {
        (true, true) => before,
        (false, true) => 2.0 * quarter_turns((before / 2.0).sqrt()),
        (true, false) => 1.0 - 2.0 * quarter_turns((after / 2.0).sqrt()),
        (false, false) if before < after => quarter_turns(before.sqrt()),
        (false, false) => 1.0 - quarter_turns(after.sqrt()),
    }
}

/// The cumulative length of a joint's path, at many fractions of a pass.
pub(super) struct CumulativeLength {
    /// Fractions of the pass, eased as by [`eased_input`].
    pass_fractions: Vec<f64>,
    /// The length of the path up to each fraction.
    lengths: Vec<f64>,
}

impl CumulativeLength {
    /// Measures a joint's path on a pass by its chords: there are enough of them for an arc and its chord to differ by
    /// less than a part in a hundred thousand.
    pub fn measure(linkage: &Linkage, pass: &Pass, joint: JointId) -> CumulativeLength {
        const CHORDS: usize = 2048;
        let fractions: Vec<f64> = (0..=CHORDS).map(|i| i as f64 / CHORDS as f64).collect();
        let inputs = fractions.iter().map(|&fraction| eased_input(pass, fraction));
        let inputs = InputColumns::from_values(linkage.input(), inputs);
        let positions = positions_at_inputs(linkage, pass, &inputs);
        let mut lengths = vec![0.0];
        for i in 1..fractions.len() {
            let chord = (positions.point(joint, i) - positions.point(joint, i - 1)).norm();
            // An undefined position adds nothing.
            lengths.push(lengths[i - 1] + if chord.is_finite() { chord } else { 0.0 });
        }
        CumulativeLength { pass_fractions: fractions, lengths }
    }

    /// The whole length.
    pub fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// The fraction of the pass up to which the given share of the whole length is traversed.
    pub fn pass_fraction(&self, share: f64) -> f64 {
        let length = share * self.total();
        let i = self.lengths.partition_point(|l| *l < length).clamp(1, self.lengths.len() - 1);
        let [before, after] = [self.lengths[i - 1], self.lengths[i]];
        let fraction = if after > before { (length - before) / (after - before) } else { 1.0 };
        self.pass_fractions[i - 1] + (self.pass_fractions[i] - self.pass_fractions[i - 1]) * fraction
    }
}
