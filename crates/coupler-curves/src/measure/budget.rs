//! The work that a measure of a curve may take. It is counted in parts and steps, never in time, so that the same curve has the
//! same measures on every machine. A measure that would take more is too close to tell: it has no value, and `too_close` says so.
//!
//! More is taken where a search does not converge: where links are so short, or joints so near each other, that what is divided is
//! rounding.

use std::cell::Cell;

/// The most parts that a function along a circuit, or the length of a curve, is divided into: sixteen for each piece of a
/// circuit that has as many as it may have.
pub const MAX_PARTS: usize = 16_384;

/// The most steps from one monotonic part of the output to the next in the search for its dwell.
pub const MAX_DWELL_STEPS: usize = 40_000_000;

/// The most points of portions that are compared with a line or a circle in the search for one straight or circular portion.
pub const MAX_PORTION_POINTS: usize = 10_000_000;

/// The most pairs of parts of a curve that are examined for crossings.
pub const MAX_PAIRS: usize = 100_000;

/// A search would take more steps than it may.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManySteps;

/// The steps that a search has left.
#[derive(Debug)]
pub struct Steps(Cell<Option<usize>>);

impl Steps {
    /// For a search that may take so many.
    pub fn new(limit: usize) -> Steps {
        Steps(Cell::new(Some(limit)))
    }

    /// Takes some.
    ///
    /// # Errors
    /// There are not as many; then there are none.
    pub fn take(&self, count: usize) -> Result<(), TooManySteps> {
        self.0.set(self.0.get().and_then(|left| left.checked_sub(count)));
        self.check()
    }

    /// Checks that what was taken has been there.
    ///
    /// # Errors
    /// It was not.
    pub fn check(&self) -> Result<(), TooManySteps> {
        self.0.get().map(drop).ok_or(TooManySteps)
    }
}
