//! Pieces of the input on which a dyad has one limit at most, by enclosures of its extent and of the derivative.

use super::dyad::Dyad;
use crate::linkage::{AssemblyMode, DyadId, Input, Linkage};
use crate::motion::enclosure::Enclosure;
use crate::motion::joint_series::{SeriesInput, place_as_series};
use crate::motion::series::{Scalar, Series, VectorSeries};

/// The number of pieces that a turn is first cut into.
const PIECES_PER_TURN: f64 = 16.0;

/// The greatest number of halvings of a piece: the narrowest is 2^-40, about 1e-12, of a turn.
const MAX_HALVINGS: usize = 36;

/// Near an end of the range at which the extent is at a bound no piece is certain: those within this part of the range are
/// not halved. There the joints depend on the root of the distance from the end, and finer pieces would be many.
const FLAT_END: f64 = 1.0 / 16_777_216.0;

/// Halving ends when this many pieces are uncertain, because an extent that stays at a bound is never certain.
const MAX_OPEN_PIECES: usize = 512;

/// A piece of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub from: f64,
    pub to: f64,
    /// Whether the extent certainly crosses a bound once at most.
    pub is_certain: bool,
}

/// Cuts an input range into pieces on which the extent of a dyad is certain to cross a bound once at most, except on
/// pieces too narrow to be halved. `is_flat` says whether the extent is at a bound at each end of the range.
pub(super) fn cut_into_pieces(
    linkage: &Linkage,
    dyad: &Dyad,
    mode: AssemblyMode,
    [from, to]: [f64; 2],
    is_flat: [bool; 2],
) -> Vec<Piece> {
    let reach = FLAT_END * (to - from);
    let is_at_flat_end = |[a, b]: [f64; 2]| is_flat[0] && b - from <= reach || is_flat[1] && to - a <= reach;
    let turns = if linkage.input() == Input::Length { 1.0 } else { (to - from) / 360.0 };
    let n = (turns * PIECES_PER_TURN).ceil().max(1.0);
    let at = |k: f64| if k == n { to } else { from + (to - from) * k / n };
    let mut done = Vec::new();
    let mut open: Vec<[f64; 2]> = (0..n as usize).map(|k| [at(k as f64), at(k as f64 + 1.0)]).collect();
    for halving in 0..=MAX_HALVINGS {
        let can_halve = halving < MAX_HALVINGS && open.len() <= MAX_OPEN_PIECES;
        let mut next = Vec::new();
        for [from, to] in open {
            let middle = from + (to - from) / 2.0;
            let is_certain_here = is_certain(linkage, dyad, mode, [from, middle, to]);
            let is_narrow = is_at_flat_end([from, to]) || middle <= from || middle >= to;
            if is_certain_here || !can_halve || is_narrow {
                done.push(Piece { from, to, is_certain: is_certain_here });
            } else {
                next.extend([[from, middle], [middle, to]]);
            }
        }
        open = next;
    }
    done.sort_by(|a, b| a.from.total_cmp(&b.from));
    done
}

/// Whether the extent certainly reaches no bound, or reaches one bound only and is monotonic.
fn is_certain(linkage: &Linkage, dyad: &Dyad, mode: AssemblyMode, [from, middle, to]: [f64; 3]) -> bool {
    let [low, high] = dyad.extent_bounds();
    let extent = enclose_extent(linkage, dyad, mode, [from, middle, to]);
    let Series([size, rate]) = extent;
    let (above, below) = (size.low > low, size.high < high);
    let is_clear = above && below || size.high < low || size.low > high;
    is_clear || (above || below) && !rate.contains(0.0)
}

/// Bounds on the extent and on its derivative, by the mean value theorem for every joint: its position differs from
/// that at the middle of the piece by no more than its greatest derivative times the distance.
fn enclose_extent(
    linkage: &Linkage,
    dyad: &Dyad,
    mode: AssemblyMode,
    [from, middle, to]: [f64; 3],
) -> Series<Enclosure, 2> {
    let input = linkage.input();
    let input_at = |at: Enclosure| SeriesInput { value: at, direction: at.cos_sin_deg() };
    let sign = |dyad: DyadId| f64::from(mode.sign(dyad));
    let joints = dyad.joint.index();
    let centre: Vec<VectorSeries<Enclosure, 1>> =
        place_as_series(linkage, joints, input_at(Enclosure::from(middle)), sign, |_, position, _| position);
    let unit = match input {
        Input::Angle { .. } => Enclosure::from(std::f64::consts::PI) / Enclosure::from(180.0),
        Input::Length => Enclosure::from(1.0),
    };
    let offset = (Enclosure::between(from, to) - Enclosure::from(middle)) * unit;
    let mean = |around: Series<Enclosure, 2>, centre: Series<Enclosure, 1>| {
        let [value, rate] = around.0;
        Series([value.intersection(centre.0[0] + rate * offset), rate])
    };
    let narrowed = |around: VectorSeries<Enclosure, 2>, centre: VectorSeries<Enclosure, 1>| VectorSeries {
        x: mean(around.x, centre.x),
        y: mean(around.y, centre.y),
    };
    let around = place_as_series(linkage, joints, input_at(Enclosure::between(from, to)), sign, |joint, place, _| {
        narrowed(place, centre[joint])
    });
    mean(dyad.extent(|joint| around[joint]), dyad.extent(|joint| centre[joint]))
}
