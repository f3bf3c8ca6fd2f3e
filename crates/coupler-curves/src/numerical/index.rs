//! The first index from which on a condition does not hold.

use std::ops::Range;

/// The first index of a range at which a condition does not hold, which holds at all before it and at none after it; the end of
/// the range if it holds at all.
///
/// From a guess, which is moved into the range, it goes on in steps that double, and then halves the last one: it evaluates the
/// condition about twice the binary logarithm of the distance from the guess. For another condition this is an index at
/// which it does not hold and before which it does, as far as it was evaluated.
pub fn partition_point(range: Range<usize>, guess: usize, mut holds: impl FnMut(usize) -> bool) -> usize {
    // It holds before the one, and not from the other on.
    let (mut low, mut high, mut step) = (range.start, range.end.max(range.start), 1);
    let guess = guess.clamp(low, high);
    if guess < high && holds(guess) {
        low = guess + 1;
        while step <= high - low && holds(low - 1 + step) {
            low += step;
            step *= 2;
        }
        high = high.min((low - 1).saturating_add(step));
    } else {
        high = guess;
        while step <= high - low && !holds(high - step) {
            high -= step;
            step *= 2;
        }
        low = low.max((high + 1).saturating_sub(step));
    }
    while low < high {
        let middle = low + (high - low - 1) / 2;
        if holds(middle) { low = middle + 1 } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn empty_ranges_and_conditions_that_hold_everywhere_or_nowhere_have_an_end() {
        assert_eq!(partition_point(3..3, 0, |_| unreachable!()), 3);
        for guess in [0, 2, 5, 7, 100] {
            assert_eq!(partition_point(2..7, guess, |_| true), 7);
            assert_eq!(partition_point(2..7, guess, |_| false), 2);
        }
        let half = usize::MAX / 2;
        assert_eq!(partition_point(0..usize::MAX, half, |_| true), usize::MAX);
        assert_eq!(partition_point(0..usize::MAX, half, |_| false), 0);
    }

    proptest! {
        #[test]
        fn any_border_is_found_in_evaluations_that_grow_with_the_logarithm_of_its_distance(
            start in 0usize..1000, length in 0usize..100_000, border in 0usize..100_000, guess in 0usize..100_000,
        ) {
            let range = start..start + length;
            let (border, guess) = (start + border.min(length), start + guess.min(length));
            let mut count = 0;
            let found = partition_point(range.clone(), guess, |index| {
                assert!(range.contains(&index));
                count += 1;
                index < border
            });
            prop_assert_eq!(found, border);
            prop_assert!(count <= 2 + 2 * (border.abs_diff(guess) + 1).ilog2(), "{} for {}", count, border.abs_diff(guess));
        }
    }
}
