//! The exchange step of a minimax fit by a line, strip or ring that touches a few points on alternating sides (de la
//! Vallée Poussin, Remez).

/// Exchanges one of the `alternating` points, which are in order and on alternating sides, for a new point that is
/// further out: a neighbour on the same side, or else the one at the other end.
///
/// `is_like` returns whether the point at an index of `alternating` is on the side of the new point.
pub fn exchange_point<const N: usize>(
    mut alternating: [usize; N],
    new: usize,
    is_like: impl Fn(usize) -> bool,
) -> [usize; N] {
    match alternating.iter().filter(|&&k| k < new).count() {
        0 if !is_like(0) => {
            alternating.rotate_right(1);
            alternating[0] = new;
        }
        before if before == N && !is_like(N - 1) => {
            alternating.rotate_left(1);
            alternating[N - 1] = new;
        }
        before => {
            let neighbours = [before.saturating_sub(1), before.min(N - 1)];
            alternating[if is_like(neighbours[0]) { neighbours[0] } else { neighbours[1] }] = new;
        }
    }
    alternating
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_stay_alternating() {
        // Points with even indices are below, those with odd ones above.
        let exchanged = |new: usize, above: bool| exchange_point([10, 20, 30], new, |k| (k % 2 == 1) == above);
        assert_eq!([exchanged(5, false), exchanged(5, true)], [[5, 20, 30], [5, 10, 20]]);
        assert_eq!([exchanged(15, false), exchanged(15, true)], [[15, 20, 30], [10, 15, 30]]);
        assert_eq!([exchanged(25, false), exchanged(25, true)], [[10, 20, 25], [10, 25, 30]]);
        assert_eq!([exchanged(35, false), exchanged(35, true)], [[10, 20, 35], [20, 30, 35]]);
    }
}
