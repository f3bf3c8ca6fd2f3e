//! How a curve of a linkage meets the wishes.

/// How a curve of a linkage meets the wishes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Assessment {
    /// The numbers of the traced joint and the circuit, from 1.
    pub curve: [usize; 2],
    /// [`super::wish::Wish::excess`] of each wish, NaN where a value is missing.
    pub excesses: Vec<f64>,
    /// By how much the longest link is too long; negative if it is not.
    pub link_excess: f64,
    /// The goals, as numbers that are to be least.
    pub goals: Vec<f64>,
    /// Whether every wish is met, to its tolerance.
    pub is_met: bool,
}
