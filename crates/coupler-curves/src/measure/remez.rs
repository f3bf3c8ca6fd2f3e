//! One point in for another, where the best line, strip or ring is known by a few points that it touches by turns
//! (de la Vallée Poussin, Remez).

/// Points by turns on the one side and on the other, in order, with one of them exchanged for a new point that is
/// further out than they: for a neighbour on the same side, or else for the one at the other end.
///
/// `is_like` tells whether one of them, by its place, is on the side of the new point.
pub(super) fn exchange_point<const N: usize>(
    mut turns: [usize; N],
    new: usize,
    is_like: impl Fn(usize) -> bool,
) -> [usize; N] {
    match turns.iter().filter(|&&k| k < new).count() {
        0 if !is_like(0) => {
            turns.rotate_right(1);
            turns[0] = new;
        }
        before if before == N && !is_like(N - 1) => {
            turns.rotate_left(1);
            turns[N - 1] = new;
        }
        before => {
            let neighbours = [before.saturating_sub(1), before.min(N - 1)];
            turns[if is_like(neighbours[0]) { neighbours[0] } else { neighbours[1] }] = new;
        }
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_stay_in_turn() {
        // Even places are below, odd ones above.
        let with = |new: usize, above: bool| exchange_point([10, 20, 30], new, |k| (k % 2 == 1) == above);
        assert_eq!([with(5, false), with(5, true)], [[5, 20, 30], [5, 10, 20]]);
        assert_eq!([with(15, false), with(15, true)], [[15, 20, 30], [10, 15, 30]]);
        assert_eq!([with(25, false), with(25, true)], [[10, 20, 25], [10, 25, 30]]);
        assert_eq!([with(35, false), with(35, true)], [[10, 20, 35], [20, 30, 35]]);
    }
}
