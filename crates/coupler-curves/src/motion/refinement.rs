//! Circuits by enough samples for their curves to be known between them.

use std::sync::LazyLock;

use super::circuit::UnsampledCircuit;
use super::sampling::{Circuit, MAX_SAMPLES, Sampler, Sampling};
use crate::linkage::{Input, Linkage};

/// So many samples to a turn, or to a whole circuit that rocks: a polynomial through five of them is off by some hundred
/// thousandth of the way from one to the next where the curve is smooth.
const FINE_SAMPLES: usize = 360;

/// The sines and cosines of a turn so finely sampled.
static FINE_SAMPLER: LazyLock<Sampler> = LazyLock::new(|| Sampler::new(Sampling::DenseAtLimits(FINE_SAMPLES)));

impl Circuit {
    /// The same circuit by as many samples as tell of its curves between them, dense towards limits; itself, if it has them.
    pub fn refined(&self, linkage: &Linkage) -> &Circuit {
        let turns = match linkage.input() {
            Input::Angle { turns } => turns as usize,
            Input::Length => 1,
        };
        let samples = FINE_SAMPLES.saturating_mul(turns).min(MAX_SAMPLES);
        if self.len() >= samples {
            return self;
        }
        self.refined.get_or_init(|| {
            let route = UnsampledCircuit { passes: self.passes.clone(), is_closed: self.is_closed };
            Box::new(match samples {
                FINE_SAMPLES => FINE_SAMPLER.sample_circuit(linkage, route),
                _ => Sampler::new(Sampling::DenseAtLimits(samples)).sample_circuit(linkage, route),
            })
        })
    }
}
