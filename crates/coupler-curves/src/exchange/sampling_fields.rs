//! How a sampling is written.

use crate::family::Sampling;

/// The fields of a `sampling` table: the key, its number, and the spacing if it is not even.
pub(super) fn sampling_fields(sampling: Sampling) -> (&'static str, f64, Option<&'static str>) {
    match sampling {
        Sampling::Step(step) => ("step", step, None),
        Sampling::Samples(samples) => ("samples", samples as f64, None),
        Sampling::DenseAtLimits(samples) => ("samples", samples as f64, Some("smooth")),
        Sampling::ArcLength(samples) => ("samples", samples as f64, Some("arc")),
    }
}
