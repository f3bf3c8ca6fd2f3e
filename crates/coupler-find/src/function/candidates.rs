//! The linkages that a search has found, the best first, before conditions that must be solved for.

use super::generator::Generator;
use super::options::LeftOut;

/// The linkages that a search has found.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    /// The best first.
    pub linkages: Vec<Generator>,
    /// The point at which outputs that differ by whole turns are compared with the wanted one.
    pub near: [f64; 2],
    /// Linkages that differ by less are the same.
    pub distance: f64,
    /// What is left out, and how many of each kind.
    pub left_out: Vec<(LeftOut, usize)>,
    /// Of all solutions of precision points, how many there are.
    pub solutions: Option<usize>,
    /// Whether precision points have no isolated solutions.
    pub is_degenerate: bool,
}

/// The least transmission angles that are asked for in turn if there is a condition, in degrees.
pub(super) const TRANSMISSION_DEG: &[f64] = &[0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 60.0];

/// The distance at which linkages that are not all there are, of infinitely many, are answers of their own: 3 % of a length, or about 2 degrees.
pub(super) const DISTANCE: f64 = 0.03;

/// Sorts by what is to be least, and leaves that out; the order does not depend on threads.
pub(super) fn sorted(mut found: Vec<(f64, Generator)>) -> Vec<Generator> {
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, linkage)| linkage).collect()
}

/// The first of some linkages that differ by a distance, at most so many.
pub(super) fn apart(linkages: Vec<Generator>, distance: f64, most: usize) -> Vec<Generator> {
    let mut kept: Vec<Generator> = Vec::new();
    for linkage in linkages {
        if kept.len() == most {
            break;
        }
        if kept.iter().all(|other| other.distance_to(&linkage) >= distance) {
            kept.push(linkage);
        }
    }
    kept
}
