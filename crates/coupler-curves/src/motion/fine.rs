//! Circuits by enough samples for their curves to be known between them.

use std::sync::LazyLock;

use super::circuit::Route;
use super::sampling::{Circuit, MAX_SAMPLES, Sampler, Sampling};
use crate::linkage::{Input, Linkage};

/// So many samples to a turn, or to a whole circuit that rocks: a polynomial through five of them is off by some hundred
/// thousandth of the way from one to the next where the curve is smooth.
const FINE: usize = 360;

/// The sines and cosines of a turn so finely sampled.
static TURN: LazyLock<Sampler> = LazyLock::new(|| Sampler::new(Sampling::Smooth(FINE)));

impl Circuit {
    /// The same circuit by as many samples as tell of its curves between them, dense towards limits; itself, if it has them.
    pub fn finely(&self, linkage: &Linkage) -> &Circuit {
        let turns = match linkage.input() {
            Input::Angle { turns } => turns as usize,
            Input::Length => 1,
        };
        let samples = FINE.saturating_mul(turns).min(MAX_SAMPLES);
        if self.len() >= samples {
            return self;
        }
        self.fine.get_or_init(|| {
            let route = Route { passes: self.passes.clone(), closed: self.closed };
            Box::new(match samples {
                FINE => TURN.sample(linkage, route),
                _ => Sampler::new(Sampling::Smooth(samples)).sample(linkage, route),
            })
        })
    }
}
