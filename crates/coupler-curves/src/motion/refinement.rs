//! Circuits with enough samples for their curves to be interpolated between them.

use std::sync::LazyLock;

use super::circuit::UnsampledCircuit;
use super::sampling::{Circuit, MAX_SAMPLES, Sampler, Sampling};
use crate::linkage::{Input, Linkage};

/// Samples per turn, or per circuit that rocks: a polynomial through five of them is off by about a hundred thousandth
/// of the distance between neighbours where the curve is smooth.
const FINE_SAMPLES: usize = 360;

/// The sampler with [`FINE_SAMPLES`] samples, and its table of sines and cosines.
static FINE_SAMPLER: LazyLock<Sampler> = LazyLock::new(|| Sampler::new(Sampling::DenseAtLimits(FINE_SAMPLES)));

/// The number of samples of a refined circuit of a linkage.
pub(super) fn refined_sample_count(linkage: &Linkage) -> usize {
    let turns = match linkage.input() {
        Input::Angle { turns } => turns as usize,
        Input::Length => 1,
    };
    FINE_SAMPLES.saturating_mul(turns).min(MAX_SAMPLES)
}

impl Circuit {
    /// The same circuit with enough samples for its curves to be interpolated, denser towards limits; this circuit, if
    /// it has as many.
    pub fn refined(&self, linkage: &Linkage) -> &Circuit {
        let samples = refined_sample_count(linkage);
        if self.len() >= samples {
            return self;
        }
        self.refined.get_or_init(|| {
            let circuit = UnsampledCircuit { passes: self.passes.clone(), is_closed: self.is_closed };
            Box::new(match samples {
                FINE_SAMPLES => FINE_SAMPLER.sample_circuit(linkage, circuit),
                _ => Sampler::new(Sampling::DenseAtLimits(samples)).sample_circuit(linkage, circuit),
            })
        })
    }
}
