//! The sequence of the four-bars of an index.

use crate::complex::{Complex, unit};
use crate::four_bar::parameters::Parameters;
use coupler_curves::linkage::FourBarClass;

/// The classes of the sequence come in turn: two crank-rockers, a drag-link, a triple-rocker.
pub(crate) const CLASSES: usize = 4;

/// The orders of four links.
const PERMUTATIONS: [[usize; 4]; 24] = [
    [0, 1, 2, 3],
    [0, 1, 3, 2],
    [0, 2, 1, 3],
    [0, 2, 3, 1],
    [0, 3, 1, 2],
    [0, 3, 2, 1],
    [1, 0, 2, 3],
    [1, 0, 3, 2],
    [1, 2, 0, 3],
    [1, 2, 3, 0],
    [1, 3, 0, 2],
    [1, 3, 2, 0],
    [2, 0, 1, 3],
    [2, 0, 3, 1],
    [2, 1, 0, 3],
    [2, 1, 3, 0],
    [2, 3, 0, 1],
    [2, 3, 1, 0],
    [3, 0, 1, 2],
    [3, 0, 2, 1],
    [3, 1, 0, 2],
    [3, 1, 2, 0],
    [3, 2, 0, 1],
    [3, 2, 1, 0],
];

/// A four-bar of the sequence, with its crank's pivot at the origin.
///
/// Five numbers of the additive recurrence of Roberts (the powers of the inverse of the real root of x^6 = x + 1), which
/// fills the unit cube evenly, are the slacks in Grashof's condition and the place of the coupler point.
pub(crate) fn four_bar_of_sequence(number: usize) -> Parameters {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    let mut power = 1.0;
    let [a, b, c, r, angle]: [f64; 5] = std::array::from_fn(|_| {
        power /= ROOT;
        (0.5 + power * (number as f64 + 1.0)).fract()
    });
    // From 0 to 50 times the shortest link, half of them less than it.
    let slack = |u: f64| u / (1.02 - u);
    let (x, y, z) = (slack(a), slack(b), slack(c));
    let class = match number % CLASSES {
        0 | 1 => FourBarClass::CrankRocker,
        2 => FourBarClass::DragLink,
        _ => FourBarClass::TripleRocker,
    };
    let [frame, crank, coupler, rocker] = match class {
        // The shortest link is 1, and the slacks of the three conditions that it turns fully are x, y and z.
        FourBarClass::CrankRocker => [1.0 + 0.5 * (y + z), 1.0, 1.0 + 0.5 * (x + z), 1.0 + 0.5 * (x + y)],
        FourBarClass::DragLink => [1.0, 1.0 + 0.5 * (y + z), 1.0 + 0.5 * (x + z), 1.0 + 0.5 * (x + y)],
        // The longest link is longer than Grashof's condition allows, and shorter than the three others together.
        _ => {
            let lengths = [1.0, 1.0 + x, 1.0 + x + y, 1.0 + 2.0 * x + y + 2.0 * c];
            let order = PERMUTATIONS[(number / CLASSES) % PERMUTATIONS.len()];
            order.map(|place| lengths[place])
        }
    };
    let reach = 0.05 + 1.2 * r / (1.1 - r);
    let size = 0.7 * coupler.max(crank.min(frame));
    let point = Complex::new(0.5 * coupler, 0.0) + unit(std::f64::consts::TAU * angle) * (reach * size);
    Parameters {
        crank_pivot: Complex::new(0.0, 0.0),
        direction: Complex::new(1.0, 0.0),
        frame,
        crank,
        coupler,
        rocker,
        point,
    }
}
