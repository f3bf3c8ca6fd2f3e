//! Why a linkage that is exact at precision points does not pass them in one motion.

use super::generator::Generator;

/// Why a linkage does not generate a function, though its output is exact at all precision points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Defect {
    /// Two points, by their numbers from 1, are on different branches: the linkage would have to be taken apart, or pass a limit.
    Branch([usize; 2]),
    /// Between two points are inputs at which the linkage cannot be assembled.
    Limit([usize; 2]),
    /// Between two points the rocker turns by another angle than it should, a whole turn more or less.
    Turns([usize; 2]),
    /// The range of the input reaches beyond a limit, outside of the points.
    Range,
}

/// Radians, or sizes of the output: the rounding of a solution, with room for points near limits, where it is its root.
const SAME: f64 = 1e-5;

/// The first defect of a linkage with precision points, each the travels of input and output, on the way from the first to the last and in a
/// range of the travel; outputs that differ by less than 1e-5 of `size` are the same.
pub(super) fn defect(linkage: &Generator, points: &[[f64; 2]], [from, to]: [f64; 2], size: f64) -> Option<Defect> {
    let [input, output] = linkage.starts;
    let turns = points.first().and_then(|first| linkage.turns_at(*first)).unwrap_or(0.0);
    for (k, pair) in points.windows(2).enumerate() {
        let numbers = [k + 1, k + 2];
        let [[before, _], [x, y]] = [pair[0], pair[1]];
        if !linkage.is_assembled_between(input + before, input + x) {
            // The other branch may be reached through the limit, or in no way.
            let other = Generator::side_of(linkage.kind, linkage.lengths, [input + x, output + y]) != linkage.side;
            return Some(if other { Defect::Branch(numbers) } else { Defect::Limit(numbers) });
        }
        let is_there = |linkage: &Generator, turns: f64| {
            let there = linkage.output(input + x);
            there.is_none_or(|there| (there + turns - output - y).abs() <= SAME * size)
        };
        if !is_there(linkage, turns) {
            let mirrored = Generator { side: -linkage.side, ..*linkage };
            let is_mirrored = mirrored.turns_at(pair[1]).is_some_and(|turns| is_there(&mirrored, turns));
            return Some(if is_mirrored { Defect::Branch(numbers) } else { Defect::Turns(numbers) });
        }
    }
    (!linkage.is_assembled_between(input + from, input + to)).then_some(Defect::Range)
}
