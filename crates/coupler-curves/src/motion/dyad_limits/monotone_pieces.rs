//! What is certain about an extent between two inputs, by enclosures of it and of its rate.

use super::Dyad;
use crate::linkage::{AssemblyMode, Input, Linkage};
use crate::motion::enclosure::Enclosure;
use crate::motion::joint_series::{SeriesInput, place_as_series};
use crate::motion::series::{Scalar, Series, VectorSeries};

/// Pieces that a turn is first cut into.
const PIECES_PER_TURN: f64 = 16.0;

/// A piece is not halved more often than this: the narrowest is 2^-40, about 1e-12, of a turn.
const MAX_HALVINGS: usize = 36;

/// An extent that lies on a bound all the way is never certain: where this many pieces are uncertain at once, halving ends.
const MAX_OPEN_PIECES: usize = 512;

/// A piece of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub from: f64,
    pub to: f64,
    /// Whether the extent certainly crosses a bound once at most, and then going one way.
    pub is_certain: bool,
}

/// Cuts an input range into pieces on which the extent of a dyad is certain to cross a bound once at most, save on
/// pieces too narrow to be cut.
pub(super) fn cut_into_pieces(linkage: &Linkage, dyad: &Dyad, signs: AssemblyMode, [from, to]: [f64; 2]) -> Vec<Piece> {
    let turns = if linkage.input() == Input::Length { 1.0 } else { (to - from) / 360.0 };
    let n = (turns * PIECES_PER_TURN).ceil().max(1.0);
    let at = |k: f64| if k == n { to } else { from + (to - from) * k / n };
    let mut done = Vec::new();
    let mut open: Vec<[f64; 2]> = (0..n as usize).map(|k| [at(k as f64), at(k as f64 + 1.0)]).collect();
    for halving in 0..=MAX_HALVINGS {
        let halves = halving < MAX_HALVINGS && open.len() <= MAX_OPEN_PIECES;
        let mut next = Vec::new();
        for [from, to] in open {
            let middle = from + (to - from) / 2.0;
            let settled = is_certain(linkage, dyad, signs, [from, middle, to]);
            if settled || !halves || middle <= from || middle >= to {
                done.push(Piece { from, to, is_certain: settled });
            } else {
                next.extend([[from, middle], [middle, to]]);
            }
        }
        open = next;
    }
    done.sort_by(|a, b| a.from.total_cmp(&b.from));
    done
}

/// Whether the extent is sure to keep clear of the bounds, or to go one way and near one bound only.
fn is_certain(linkage: &Linkage, dyad: &Dyad, signs: AssemblyMode, [from, middle, to]: [f64; 3]) -> bool {
    let [low, high] = dyad.extent_bounds();
    let extent = enclose_extent(linkage, dyad, signs, [from, middle, to]);
    let Series([size, rate]) = extent;
    let (above, below) = (size.low > low, size.high < high);
    let is_clear = above && below || size.high < low || size.low > high;
    is_clear || (above || below) && !rate.contains(0.0)
}

/// Bounds on the extent and on its rate, by the mean value theorem for every joint: a place is where it is at the
/// middle of the piece, and no further off than its rate takes it.
fn enclose_extent(
    linkage: &Linkage,
    dyad: &Dyad,
    signs: AssemblyMode,
    [from, middle, to]: [f64; 3],
) -> Series<Enclosure, 2> {
    let input = linkage.input();
    let drive = |at: Enclosure| SeriesInput { value: at, direction: at.cos_sin_deg() };
    let mode = |dyad: usize| f64::from(signs.sign(dyad));
    let joints = dyad.joint;
    let centre: Vec<VectorSeries<Enclosure, 1>> =
        place_as_series(linkage, joints, drive(Enclosure::from(middle)), mode, |_, place, _| place);
    let unit = match input {
        Input::Angle { .. } => Enclosure::from(std::f64::consts::PI) / Enclosure::from(180.0),
        Input::Length => Enclosure::from(1.0),
    };
    let off = (Enclosure::between(from, to) - Enclosure::from(middle)) * unit;
    let mean = |around: Series<Enclosure, 2>, centre: Series<Enclosure, 1>| {
        let [value, rate] = around.0;
        Series([value.intersection(centre.0[0] + rate * off), rate])
    };
    let narrowed = |around: VectorSeries<Enclosure, 2>, centre: VectorSeries<Enclosure, 1>| VectorSeries {
        x: mean(around.x, centre.x),
        y: mean(around.y, centre.y),
    };
    let around = place_as_series(linkage, joints, drive(Enclosure::between(from, to)), mode, |joint, place, _| {
        narrowed(place, centre[joint])
    });
    mean(dyad.extent(|joint| around[joint]), dyad.extent(|joint| centre[joint]))
}
