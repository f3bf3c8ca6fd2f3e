//! The work that a measure of a curve may take. It is counted in parts and steps, never in time, so that the same curve has the
//! same measures on every machine. A measure that would take more is too close to tell: it has no value, and `too_close` says so.
//!
//! More is taken where a search does not converge: where links are so short, or joints so near each other, that what is divided is
//! rounding.

/// The most parts that a function along a circuit, or the length of a curve, is divided into: sixteen for each piece of a
/// circuit that has as many as it may have.
pub const MAX_PARTS: usize = 16_384;

/// The most steps from one monotonic part of the output to the next in the search for its dwell.
pub const MAX_DWELL_STEPS: usize = 400_000_000;

/// The most pairs of parts of a curve that are examined for crossings.
pub const MAX_PAIRS: usize = 100_000;
