//! The assembly mode: the sides of the dyads.

use std::cmp::Ordering;

use super::DyadId;

/// The most dyads a linkage may have: the gallery has a bit of a 32-bit integer for each.
pub const MAX_DYADS: usize = 31;

/// A side of a directed line: left of A -> B is the side of the positive normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side of the positive normal, +1.
    Left,
    /// The side of the negative normal, -1.
    Right,
}

/// The assembly mode of a linkage: the sides of all its dyads.
///
/// Modes are ordered by the side of the first dyad, then the second and so on, left before right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AssemblyMode(u64);

impl Ord for AssemblyMode {
    fn cmp(&self, other: &AssemblyMode) -> Ordering {
        self.0.reverse_bits().cmp(&other.0.reverse_bits())
    }
}

impl PartialOrd for AssemblyMode {
    fn partial_cmp(&self, other: &AssemblyMode) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl AssemblyMode {
    /// The sign of a dyad: 1 left, -1 right.
    pub fn sign(self, dyad: DyadId) -> i8 {
        if self.0 >> dyad.index() & 1 == 0 { 1 } else { -1 }
    }

    /// This mode with one dyad on a given side.
    #[must_use]
    pub fn with_side(self, dyad: DyadId, side: Side) -> AssemblyMode {
        match side {
            Side::Left => AssemblyMode(self.0 & !(1 << dyad.index())),
            Side::Right => AssemblyMode(self.0 | 1 << dyad.index()),
        }
    }

    /// The sides of the first `dyads` dyads, with all others left.
    #[must_use]
    pub fn truncated(self, dyads: usize) -> AssemblyMode {
        if dyads < MAX_DYADS { AssemblyMode(self.0 & !(u64::MAX << dyads)) } else { self }
    }

    /// Whether all dyads but those in a set are on the same sides in another mode.
    pub fn is_same_apart_from(self, dyads: DyadSet, other: AssemblyMode) -> bool {
        (self.0 ^ other.0) & !dyads.0 == 0
    }

    /// This mode with some dyads on their other sides.
    #[must_use]
    pub fn flipped(self, dyads: DyadSet) -> AssemblyMode {
        AssemblyMode(self.0 ^ dyads.0)
    }
}

/// A set of dyads, by their indices; for instance those that are flat at one input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DyadSet(u64);

impl DyadSet {
    /// The empty set.
    pub const EMPTY: DyadSet = DyadSet(0);

    /// One of them.
    pub fn single(dyad: DyadId) -> DyadSet {
        DyadSet(1 << dyad.index())
    }

    /// Whether a dyad is in the set.
    pub fn contains(self, dyad: DyadId) -> bool {
        self.0 >> dyad.index() & 1 == 1
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The dyad with the least index alone; empty for the empty set.
    #[must_use]
    pub fn first(self) -> DyadSet {
        DyadSet(self.0 & self.0.wrapping_neg())
    }

    /// The dyad with the greatest index alone; empty for the empty set.
    #[must_use]
    pub fn last(self) -> DyadSet {
        DyadSet(self.0.checked_ilog2().map_or(0, |bit| 1 << bit))
    }

    /// The dyads that are not in the other set.
    #[must_use]
    pub fn without(self, other: DyadSet) -> DyadSet {
        DyadSet(self.0 & !other.0)
    }

    /// The dyads in either set.
    #[must_use]
    pub fn union(self, other: DyadSet) -> DyadSet {
        DyadSet(self.0 | other.0)
    }
}
