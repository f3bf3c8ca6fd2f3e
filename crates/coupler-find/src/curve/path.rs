//! A given curve as a chain of cubics, its length, and the feet of points on it.

use crate::complex::{Complex, dot, length, mean};
use coupler_curves::geometry::{Point, Similarity};

/// A curve through given points: the cubic spline by the lengths of their chords, with centroid 0 and size 1 of the points. Along an
/// open curve it goes there and back, so that every curve is closed.
///
/// A position along it is the number of a piece plus the part of it, and may be of any round.
#[derive(Clone, Debug)]
pub(crate) struct CurvePath {
    /// The coefficients of the powers of the part of a piece, from 0 to 1.
    pieces: Vec<[Complex; 4]>,
    /// The length up to the beginning of each piece, and in the end that of all.
    lengths: Vec<f64>,
    pub is_open: bool,
    /// The centroid and the size of the given points.
    centre: Complex,
    size: f64,
}

impl CurvePath {
    /// The curve through points; `None` if a coordinate is not finite, or they have no extent. Of points that follow each other in one
    /// place the first counts.
    pub fn new(points: &[Point], is_closed: bool) -> Option<CurvePath> {
        /// Coordinates are known to this part of their greatest, and points to this part of their size.
        const ROUNDING: f64 = 1e-13;
        let given: Vec<Complex> = points.iter().map(|p| Complex::new(p.x, p.y)).collect();
        let centre = mean(&given);
        let size = (given.iter().map(|z| (z - centre).norm_sqr()).sum::<f64>() / given.len().max(1) as f64).sqrt();
        let greatest = given.iter().map(|z| z.re.abs().max(z.im.abs())).fold(0.0, f64::max);
        if !size.is_normal() || size <= ROUNDING * greatest {
            return None;
        }
        let mut knots: Vec<Complex> = Vec::with_capacity(given.len() + 1);
        for z in given.iter().map(|z| (z - centre) / size) {
            if knots.last().is_none_or(|last| length(z - last) > ROUNDING) {
                knots.push(z);
            }
        }
        while is_closed && knots.len() > 1 && length(knots[knots.len() - 1] - knots[0]) <= ROUNDING {
            knots.pop();
        }
        if knots.len() < 2 {
            return None;
        }
        let is_open = !is_closed || knots.len() < 3;
        let slopes = if is_open { open_slopes(&knots) } else { closed_slopes(&knots) };
        let count = knots.len();
        let piece = |k: usize| {
            let [(start, from), (end, to)] = [k, (k + 1) % count].map(|k| (knots[k], slopes[k]));
            let step = length(end - start);
            let chord = end - start;
            [start, from * step, chord * 3.0 - (from * 2.0 + to) * step, (from + to) * step - chord * 2.0]
        };
        let mut pieces: Vec<[Complex; 4]> = (0..if is_open { count - 1 } else { count }).map(piece).collect();
        if is_open {
            let back = |[a, b, c, d]: [Complex; 4]| [a + b + c + d, -(b + c * 2.0 + d * 3.0), c + d * 3.0, -d];
            pieces.extend(pieces.clone().into_iter().rev().map(back));
        }
        let mut whole = 0.0;
        let starts = pieces.iter().map(|piece| {
            whole += length_to(piece, 1.0);
            whole
        });
        let lengths = std::iter::once(0.0).chain(starts).collect();
        Some(CurvePath { pieces, lengths, is_open, centre, size })
    }

    /// The similarity from this curve to the given points.
    pub fn placement(&self) -> Similarity {
        Similarity { is_mirrored: false, factor: Complex::new(self.size, 0.0), shift: self.centre }
    }

    /// The number of pieces: positions that differ by it are one place.
    pub fn period(&self) -> f64 {
        self.pieces.len() as f64
    }

    /// The length of the closed curve.
    pub fn length(&self) -> f64 {
        self.lengths[self.pieces.len()]
    }

    /// The length of the curve from the position 0 to another one, also in other rounds.
    pub fn length_at(&self, position: f64) -> f64 {
        let round = (position / self.period()).floor();
        let (k, u) = self.place(position);
        round * self.length() + self.lengths[k] + length_to(&self.pieces[k], u)
    }

    fn place(&self, position: f64) -> (usize, f64) {
        let whole = position.floor();
        ((whole as i64).rem_euclid(self.pieces.len() as i64) as usize, position - whole)
    }

    /// The point at a position.
    pub fn point(&self, position: f64) -> Complex {
        let (k, u) = self.place(position);
        point(&self.pieces[k], u)
    }

    /// The derivative by the position.
    pub fn velocity(&self, position: f64) -> Complex {
        let (k, u) = self.place(position);
        let [_, velocity, _] = rates(&self.pieces[k], u);
        velocity
    }

    /// The positions at about equal distances along the curve.
    pub fn spaced_evenly(&self, count: usize) -> Vec<f64> {
        let step = self.length() / count as f64;
        let mut k = 0;
        let position = |n: usize| {
            let at = step * n as f64;
            while k + 1 < self.pieces.len() && self.lengths[k + 1] <= at {
                k += 1;
            }
            k as f64 + ((at - self.lengths[k]) / (self.lengths[k + 1] - self.lengths[k])).clamp(0.0, 1.0)
        };
        (0..count).map(position).collect()
    }

    /// The points at these positions.
    pub fn even_points(&self, count: usize) -> Vec<Complex> {
        self.spaced_evenly(count).into_iter().map(|position| self.point(position)).collect()
    }

    /// Positions between which the curve is nearly straight: its knots, or some of them, or some on each piece, from `least` to twice as
    /// many.
    pub fn knots(&self, least: usize) -> Vec<f64> {
        let count = self.pieces.len();
        let (step, parts) = (count.div_ceil(2 * least), least.div_ceil(count));
        let of_piece = |k: usize| (0..parts).map(move |part| k as f64 + part as f64 / parts as f64);
        (0..count).step_by(step).flat_map(of_piece).collect()
    }

    /// The foot of a point near a position: the position where the distance is least among its neighbours.
    pub fn foot(&self, near: f64, target: Complex) -> f64 {
        const ROUNDS: usize = 40;
        /// The sine of the angle between a perpendicular and the curve; the distance is then exact to rounding.
        const PERPENDICULAR: f64 = 1e-10;
        let mut round = near.floor();
        let mut u = near - round;
        for _ in 0..ROUNDS {
            let (k, _) = self.place(round);
            let [at, velocity, acceleration] = rates(&self.pieces[k], u);
            let offset = target - at;
            let (slope, square) = (dot(offset, velocity), velocity.norm_sqr());
            let best = offset.norm_sqr();
            if slope * slope <= PERPENDICULAR * PERPENDICULAR * square * best {
                break;
            }
            // Beyond the end of a piece the next one must come nearer, too, which at a corner it may not.
            let beyond = match slope > 0.0 {
                true if u >= 1.0 => Some((round + 1.0, 0.0)),
                false if u <= 0.0 => Some((round - 1.0, 1.0)),
                _ => None,
            };
            if let Some((next, start)) = beyond {
                let [_, velocity, _] = rates(&self.pieces[self.place(next).0], start);
                if dot(offset, velocity) * slope <= 0.0 {
                    break;
                }
                (round, u) = (next, start);
                continue;
            }
            let newton = square - dot(offset, acceleration);
            let mut step = slope / if newton > 0.1 * square { newton } else { square };
            let mut moved = None;
            for _ in 0..6 {
                let next = (u + step).clamp(0.0, 1.0);
                if (target - point(&self.pieces[k], next)).norm_sqr() < best {
                    moved = Some(next);
                    break;
                }
                step *= 0.25;
            }
            let Some(next) = moved else { break };
            u = next;
        }
        round + u
    }
}

fn point([a, b, c, d]: &[Complex; 4], u: f64) -> Complex {
    a + (b + (c + d * u) * u) * u
}

/// The point of a piece and its first two derivatives.
fn rates([a, b, c, d]: &[Complex; 4], u: f64) -> [Complex; 3] {
    [a + (b + (c + d * u) * u) * u, b + (c * 2.0 + d * (3.0 * u)) * u, c * 2.0 + d * (6.0 * u)]
}

/// The length of a piece from its beginning, by the rule of Gauss with four points.
fn length_to(piece: &[Complex; 4], u: f64) -> f64 {
    const NODES: [(f64, f64); 2] =
        [(0.339_981_043_584_856_26, 0.652_145_154_862_546_1), (0.861_136_311_594_052_6, 0.347_854_845_137_453_85)];
    let speed = |x: f64| length(rates(piece, 0.5 * u * (1.0 + x))[1]);
    let sum: f64 = NODES.iter().map(|(x, weight)| weight * (speed(*x) + speed(-x))).sum();
    0.5 * u * sum
}

/// The slopes of the cubic spline by the lengths of chords at the knots of a closed curve, of which there are at least three.
fn closed_slopes(knots: &[Complex]) -> Vec<Complex> {
    let count = knots.len();
    let chord = |k: usize| knots[(k + 1) % count] - knots[k];
    let steps: Vec<f64> = (0..count).map(|k| length(chord(k))).collect();
    let before = |k: usize| (k + count - 1) % count;
    let mut diagonal: Vec<f64> = (0..count).map(|k| 2.0 * (steps[before(k)] + steps[k])).collect();
    let right = |k: usize| {
        let [earlier, later] = [before(k), k].map(|k| chord(k) / steps[k]);
        (earlier * steps[k] + later * steps[before(k)]) * 3.0
    };
    // The two corners of the matrix are a product of two vectors (Sherman and Morrison).
    let (lower_corner, upper_corner) = (steps[before(count - 1)], steps[0]);
    let pivot = -diagonal[0];
    diagonal[0] -= pivot;
    diagonal[count - 1] -= lower_corner * upper_corner / pivot;
    let mut update = vec![Complex::new(0.0, 0.0); count];
    (update[0].re, update[count - 1].re) = (pivot, lower_corner);
    let below = |k: usize| steps[k];
    let above = |k: usize| steps[before(k)];
    let solution = solve_tridiagonal(&diagonal, (below, above), (0..count).map(right).collect());
    let response = solve_tridiagonal(&diagonal, (below, above), update);
    let last = upper_corner / pivot;
    let factor = (solution[0] + solution[count - 1] * last) / (1.0 + response[0].re + last * response[count - 1].re);
    solution.iter().zip(&response).map(|(value, response)| value - factor * response.re).collect()
}

/// The slopes at the knots of an open curve, of which there are at least two: at its ends those of the polynomial through the
/// nearest four.
fn open_slopes(knots: &[Complex]) -> Vec<Complex> {
    let count = knots.len();
    let steps: Vec<f64> = knots.windows(2).map(|pair| length(pair[1] - pair[0])).collect();
    let end_slope = |at: &dyn Fn(usize) -> usize| {
        let points: Vec<Complex> = (0..count.min(4)).map(|k| knots[at(k)]).collect();
        let mut places = vec![0.0];
        points.windows(2).for_each(|pair| places.push(places[places.len() - 1] + length(pair[1] - pair[0])));
        // Newton's divided differences.
        let mut differences = points;
        let (mut slope, mut product) = (Complex::new(0.0, 0.0), 1.0);
        for order in 1..places.len() {
            for k in 0..places.len() - order {
                differences[k] = (differences[k + 1] - differences[k]) / (places[k + order] - places[k]);
            }
            slope += differences[0] * product;
            product *= -places[order];
        }
        slope
    };
    let (first, last) = (end_slope(&|k| k), -end_slope(&|k| count - 1 - k));
    let diagonal: Vec<f64> =
        (0..count).map(|k| if k == 0 || k == count - 1 { 1.0 } else { 2.0 * (steps[k - 1] + steps[k]) }).collect();
    let right = |k: usize| match k {
        0 => first,
        k if k == count - 1 => last,
        k => {
            let [earlier, later] = [k - 1, k].map(|k| (knots[k + 1] - knots[k]) / steps[k]);
            (earlier * steps[k] + later * steps[k - 1]) * 3.0
        }
    };
    let below = |k: usize| if k == count - 1 { 0.0 } else { steps[k] };
    let above = |k: usize| if k == 0 { 0.0 } else { steps[k - 1] };
    solve_tridiagonal(&diagonal, (below, above), (0..count).map(right).collect())
}

/// The solution of a system whose matrix has a diagonal and an entry on both sides of it.
fn solve_tridiagonal(
    diagonal: &[f64],
    (below, above): (impl Fn(usize) -> f64, impl Fn(usize) -> f64),
    mut right: Vec<Complex>,
) -> Vec<Complex> {
    let count = diagonal.len();
    let mut pivots = diagonal.to_vec();
    for k in 1..count {
        let factor = below(k) / pivots[k - 1];
        pivots[k] -= factor * above(k - 1);
        let before = right[k - 1];
        right[k] -= before * factor;
    }
    for k in (0..count).rev() {
        let after = if k + 1 < count { right[k + 1] * above(k) } else { Complex::new(0.0, 0.0) };
        right[k] = (right[k] - after) / pivots[k];
    }
    right
}
