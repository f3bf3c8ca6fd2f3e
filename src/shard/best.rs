//! The best of many curves, in bounded memory.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// A curve by its rank: the less its key the better, and of equal keys the one that comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ranked<T> {
    /// The value of the expression that is least for the best; never NaN.
    pub key: f64,
    /// Its place, by which equal ones are ordered.
    pub place: T,
}

impl<T: Ord> Ord for Ranked<T> {
    /// The better one is greater.
    fn cmp(&self, other: &Ranked<T>) -> Ordering {
        other.key.total_cmp(&self.key).then_with(|| other.place.cmp(&self.place))
    }
}

impl<T: Ord> PartialOrd for Ranked<T> {
    fn partial_cmp(&self, other: &Ranked<T>) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T: PartialEq> Eq for Ranked<T> {}

/// The best of those that have been added, at most a number of them.
#[derive(Clone, Debug)]
pub(super) struct Best<T: Ord> {
    most: usize,
    /// The worst on top.
    kept: BinaryHeap<Reverse<Ranked<T>>>,
}

impl<T: Ord> Best<T> {
    /// None yet, and at most this number.
    pub fn new(most: usize) -> Best<T> {
        Best { most, kept: BinaryHeap::new() }
    }

    /// Adds one; a key that is NaN is no key. Zero has no sign.
    pub fn add(&mut self, key: f64, place: T) {
        if key.is_nan() || self.most == 0 {
            return;
        }
        let ranked = Ranked { key: key + 0.0, place };
        if self.kept.len() < self.most {
            self.kept.push(Reverse(ranked));
        } else if let Some(mut worst) = self.kept.peek_mut()
            && worst.0 < ranked
        {
            *worst = Reverse(ranked);
        }
    }

    /// Adds those of others.
    pub fn merge(mut self, other: Best<T>) -> Best<T> {
        other.kept.into_iter().for_each(|Reverse(ranked)| self.add(ranked.key, ranked.place));
        self
    }

    /// The best, best first.
    pub fn into_sorted(self) -> Vec<Ranked<T>> {
        self.kept.into_sorted_vec().into_iter().map(|Reverse(ranked)| ranked).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_are_those_of_a_sorted_list() {
        let keys = [3.0, -1.0, f64::NAN, 7.0, 3.0, 0.0, -0.0, f64::INFINITY, 7.0];
        for most in 0..10 {
            let mut sorted: Vec<(f64, usize)> = keys.into_iter().zip(0..).filter(|(key, _)| !key.is_nan()).collect();
            sorted.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap().then(a.1.cmp(&b.1)));
            sorted.truncate(most);
            for split in 0..=keys.len() {
                let part = |range: std::ops::Range<usize>| {
                    let mut best = Best::new(most);
                    range.for_each(|k| best.add(keys[k], k));
                    best
                };
                let best = part(split..keys.len()).merge(part(0..split)).into_sorted();
                assert_eq!(
                    best.iter().map(|ranked| ranked.place).collect::<Vec<_>>(),
                    sorted.iter().map(|(_, k)| *k).collect::<Vec<_>>()
                );
            }
        }
    }
}
