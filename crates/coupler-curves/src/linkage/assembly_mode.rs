use std::cmp::Ordering;

use super::Side;

/// The sides of all dyads at once: the assembly mode.
///
/// Modes are in the order of their first dyads' sides, left before right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct AssemblyMode(u32);

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
    pub fn sign(self, dyad: usize) -> i8 {
        if self.0 >> dyad & 1 == 0 { 1 } else { -1 }
    }

    /// The same with another side of one dyad.
    #[must_use]
    pub fn with_side(self, dyad: usize, side: Side) -> AssemblyMode {
        match side {
            Side::Left => AssemblyMode(self.0 & !(1 << dyad)),
            Side::Right => AssemblyMode(self.0 | 1 << dyad),
        }
    }

    /// Those of the first `dyads` dyads; of the others, left.
    #[must_use]
    pub fn truncated(self, dyads: usize) -> AssemblyMode {
        AssemblyMode(self.0 & !(u32::MAX << dyads))
    }

    /// All assembly modes of that many dyads; the side of the last changes fastest, left first.
    pub fn all(dyads: usize) -> impl Iterator<Item = AssemblyMode> {
        (0..1u32 << dyads).map(move |k| AssemblyMode(if dyads == 0 { 0 } else { k.reverse_bits() >> (32 - dyads) }))
    }

    /// The same with some dyads on their other sides.
    #[must_use]
    pub fn flipped(self, dyads: DyadSet) -> AssemblyMode {
        AssemblyMode(self.0 ^ dyads.0)
    }
}

/// Some of the dyads, by their places: those that lie flat somewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DyadSet(u32);

impl DyadSet {
    /// None of them.
    pub const EMPTY: DyadSet = DyadSet(0);

    /// One of them.
    pub fn single(dyad: usize) -> DyadSet {
        DyadSet(1 << dyad)
    }

    /// Whether a dyad is among them.
    pub fn contains(self, dyad: usize) -> bool {
        self.0 >> dyad & 1 == 1
    }

    /// Whether there are none.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The one that is placed before the others; none of none.
    #[must_use]
    pub fn first(self) -> DyadSet {
        DyadSet(self.0 & self.0.wrapping_neg())
    }

    /// The one that is placed after the others; none of none.
    #[must_use]
    pub fn last(self) -> DyadSet {
        DyadSet(self.0.checked_ilog2().map_or(0, |bit| 1 << bit))
    }

    /// These and those.
    #[must_use]
    pub fn union(self, other: DyadSet) -> DyadSet {
        DyadSet(self.0 | other.0)
    }
}
