//! A set of measures.

use std::ops::{BitAnd, BitOr, BitOrAssign};

use super::definition::{Measure, MeasureKey};
use super::measures::ALL;

/// A set of measures, given by their indices in [`ALL`].
///
/// ```
/// use coupler_curves::measure::{ALL, Measure, MeasureSet};
///
/// let set = MeasureSet::EMPTY.with(Measure::MU_WORST).with(Measure::CLASS);
/// assert_eq!(set.iter().map(|k| ALL[k].name).collect::<Vec<_>>(), ["class", "mu_worst_deg"]);
/// assert!(MeasureSet::of(|measure| measure.unit == "deg").contains_all(MeasureSet::EMPTY.with(Measure::MU_WORST)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeasureSet(u128);

const _: () = assert!(ALL.len() < u128::BITS as usize, "a set of measures is one word");

impl MeasureSet {
    /// No measure.
    pub const EMPTY: MeasureSet = MeasureSet(0);
    /// Every measure.
    pub const ALL: MeasureSet = MeasureSet((1 << ALL.len()) - 1);

    /// The same set with a measure.
    pub const fn with<T>(self, key: MeasureKey<T>) -> MeasureSet {
        MeasureSet(self.0 | 1 << key.index)
    }

    /// The measures of the path of a joint; the others, which come before them, are of the motion of the linkage and the same for all joints.
    pub const OF_PATHS: MeasureSet = MeasureSet(MeasureSet::ALL.0 & !((1 << Measure::SENSITIVITY_MAX.index) - 1));

    /// The measures that a condition holds for.
    pub fn of(mut is_in: impl FnMut(&Measure) -> bool) -> MeasureSet {
        (0..ALL.len()).filter(|k| is_in(&ALL[*k])).collect()
    }

    /// Adds a measure by its index.
    ///
    /// # Panics
    /// There is no such measure.
    pub fn insert(&mut self, index: usize) {
        assert!(index < ALL.len(), "there are {} measures, and none {index}", ALL.len());
        self.0 |= 1 << index;
    }

    /// Whether a measure, given by its index, is in the set.
    pub fn contains(self, index: usize) -> bool {
        index < ALL.len() && self.0 & (1 << index) != 0
    }

    /// Whether it has no measures.
    pub fn is_empty(self) -> bool {
        self == MeasureSet::EMPTY
    }

    /// Whether all measures of another set are in this one.
    pub fn contains_all(self, other: MeasureSet) -> bool {
        self & other == other
    }

    /// The indices of its measures, in order.
    pub fn iter(self) -> impl DoubleEndedIterator<Item = usize> + Clone {
        (0..ALL.len()).filter(move |k| self.contains(*k))
    }
}

impl FromIterator<usize> for MeasureSet {
    fn from_iter<I: IntoIterator<Item = usize>>(indices: I) -> MeasureSet {
        let mut set = MeasureSet::EMPTY;
        indices.into_iter().for_each(|index| set.insert(index));
        set
    }
}

impl BitOr for MeasureSet {
    type Output = MeasureSet;

    fn bitor(self, other: MeasureSet) -> MeasureSet {
        MeasureSet(self.0 | other.0)
    }
}

impl BitOrAssign for MeasureSet {
    fn bitor_assign(&mut self, other: MeasureSet) {
        *self = *self | other;
    }
}

impl BitAnd for MeasureSet {
    type Output = MeasureSet;

    fn bitand(self, other: MeasureSet) -> MeasureSet {
        MeasureSet(self.0 & other.0)
    }
}
