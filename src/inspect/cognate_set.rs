//! The three four-bars that trace the same coupler curve.

use coupler_curves::linkage::{Cognate, Cognates, FourBarClass, Linkage};
use coupler_curves::motion::Motion;
use coupler_curves::solve::SolvedCell;

/// The three four-bars that trace the same coupler curve.
pub(super) struct CognateSet {
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The link lengths and the third pivot.
    pub cognates: Cognates,
    /// The original as a plain four-bar, and its two cognates.
    pub linkages: [CognateMember; 3],
    /// The original and both cognates, assembled as one linkage.
    pub assembled: SolvedCell,
}

/// One of the three four-bars, with its motion.
pub(super) struct CognateMember {
    /// `original`, `cognate 1` or `cognate 2`.
    pub name: &'static str,
    pub cognate: Cognate,
    pub class: FourBarClass,
    pub linkage: Linkage,
    pub motion: Motion,
}
