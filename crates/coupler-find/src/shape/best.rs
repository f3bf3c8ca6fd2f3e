//! The best of many, in bounded memory.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// The best that have been added, at most a number of them: how good each is, the more the greater, and its number. What is kept depends on
/// what is added, but not on the order.
#[derive(Clone, Debug)]
pub(crate) struct Best {
    most: usize,
    /// The value of the worst, once all places are taken.
    floor: f32,
    /// The worst on top.
    kept: BinaryHeap<Reverse<Ranked>>,
}

/// A value with a number: of equal values the one with the least number is better.
#[derive(Clone, Copy, Debug)]
struct Ranked(f32, usize);

impl Ord for Ranked {
    fn cmp(&self, other: &Ranked) -> Ordering {
        self.0.total_cmp(&other.0).then(other.1.cmp(&self.1))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Ranked) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Ranked) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ranked {}

impl Best {
    /// None yet, and at most so many.
    pub fn new(most: usize) -> Best {
        Best { most, floor: f32::NEG_INFINITY, kept: BinaryHeap::new() }
    }

    /// What is less than this is not kept.
    #[inline]
    pub fn floor(&self) -> f32 {
        self.floor
    }

    /// Adds one; a value that is NaN is none.
    #[inline]
    pub fn add(&mut self, value: f32, number: usize) {
        // Most are not among the best.
        if value >= self.floor {
            self.keep(Ranked(value, number));
        }
    }

    fn keep(&mut self, ranked: Ranked) {
        if self.kept.len() < self.most {
            self.kept.push(Reverse(ranked));
        } else if let Some(mut worst) = self.kept.peek_mut()
            && worst.0 < ranked
        {
            *worst = Reverse(ranked);
        }
        if self.kept.len() == self.most {
            self.floor = self.kept.peek().map_or(f32::INFINITY, |Reverse(Ranked(worst, _))| *worst);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// The best first.
    pub fn sorted(&self) -> Vec<(f32, usize)> {
        let mut sorted: Vec<Ranked> = self.kept.iter().map(|Reverse(ranked)| *ranked).collect();
        sorted.sort_by(|a, b| b.cmp(a));
        sorted.into_iter().map(|Ranked(value, number)| (value, number)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_are_those_of_a_sorted_list_in_any_order() {
        let values = [3.0, -1.0, f32::NAN, 7.0, 3.0, f32::INFINITY, 7.0, 3.0];
        for most in 0..10 {
            let mut sorted: Vec<(f32, usize)> =
                values.into_iter().zip(0..).filter(|(value, _)| !value.is_nan()).collect();
            sorted.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            sorted.truncate(most);
            for first in 0..values.len() {
                let mut best = Best::new(most);
                (first..values.len()).chain(0..first).for_each(|number| best.add(values[number], number));
                assert_eq!(best.sorted(), sorted);
                let floor = sorted.last().map_or(f32::INFINITY, |(worst, _)| *worst);
                assert_eq!(best.floor(), if sorted.len() == most { floor } else { f32::NEG_INFINITY });
            }
        }
    }
}
