//! The points of a curve that are nearest to others.

use coupler_curves::geometry::Similarity;

use super::circuit::Traced;
use crate::complex::{Complex, dot};

/// A point of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Its position on the curve, or its input if the target is timed.
    pub position: f64,
    /// The point, in the plane of the curve.
    pub at: Complex,
}

/// The first two derivatives of a curve at a position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rates {
    pub velocity: Complex,
    acceleration: Complex,
}

impl Rates {
    /// Those at the second of three points with a step from each to the next.
    pub fn new([before, at, after]: [Complex; 3], step: f64) -> Rates {
        Rates { velocity: (after - before) / (2.0 * step), acceleration: (after - at * 2.0 + before) / (step * step) }
    }
}

/// Where feet are looked for.
pub(crate) struct Near {
    pub positions: Vec<f64>,
    /// The derivatives at these positions, of this curve or of one that differs little. With them feet are right up to the square of the error
    /// of the derivatives, and take a third of the points.
    pub rates: Option<Vec<Rates>>,
    /// The most rounds of Newton's method.
    pub rounds: usize,
}

/// A foot on its way.
struct Moving {
    /// The number of the point.
    number: usize,
    step: f64,
    /// Whether the derivatives are those at the position of this curve.
    has_exact_rates: bool,
    /// Whether the step was too long, and is tried again, shorter.
    is_shortened: bool,
}

/// The interval of positions from which derivatives are computed.
const STEP: f64 = 1e-4;

/// A foot is found when the cosine of the angle between the offset and the curve is this small: the distance is then exact to rounding, or its
/// square to a millionth of a millionth, with derivatives that are not exact either.
const PERPENDICULAR: f64 = 1e-10;
const NEARLY_PERPENDICULAR: f64 = 1e-6;

/// The points of a curve where the distances from other points are least among their neighbours: Newton's method for all of them at once, each
/// step of which comes nearer.
pub(super) fn feet(traced: &Traced, placed: &Similarity, points: &[Complex], near: Near) -> Option<Vec<Foot>> {
    let Near { positions, rates, rounds } = near;
    let has_exact_rates = rates.is_none();
    let perpendicular = if has_exact_rates { PERPENDICULAR } else { NEARLY_PERPENDICULAR };
    let own: Vec<Complex> = points.iter().map(|point| placed.preimage(*point)).collect();
    let scale = placed.scale();
    let (at, mut rates) = match rates {
        Some(rates) => (traced.points(&positions)?, rates),
        None => with_rates(traced, &positions)?.into_iter().unzip(),
    };
    let mut feet: Vec<Foot> = positions.into_iter().zip(at).map(|(position, at)| Foot { position, at }).collect();
    let all = (0..points.len()).map(|number| Moving { number, step: 0.0, has_exact_rates, is_shortened: false });
    let is_open = |moving: &mut Moving, feet: &[Foot], rates: &[Rates]| {
        let (foot, rates) = (&feet[moving.number], &rates[moving.number]);
        let step = newton_step(own[moving.number] - foot.at, rates, (perpendicular, scale));
        moving.step = step.unwrap_or(0.0);
        step.is_some()
    };
    let mut open: Vec<Moving> = all.collect();
    open.retain_mut(|moving| is_open(moving, &feet, &rates));
    for _ in 0..rounds {
        if open.is_empty() {
            break;
        }
        let trials: Vec<f64> = open.iter().map(|moving| feet[moving.number].position + moving.step).collect();
        let at = traced.points(&trials)?;
        // Those with whose derivatives no step came nearer.
        let mut unknown: Vec<usize> = Vec::new();
        for (k, (moving, at)) in open.iter_mut().zip(at).enumerate() {
            let (foot, own) = (&mut feet[moving.number], own[moving.number]);
            moving.is_shortened = false;
            if (own - at).norm_sqr() < (own - foot.at).norm_sqr() {
                rates[moving.number].advance(foot.at, at, moving.step);
                *foot = Foot { position: foot.position + moving.step, at };
                moving.has_exact_rates = false;
            } else if moving.has_exact_rates {
                moving.step *= 0.25;
                moving.is_shortened = true;
            } else {
                unknown.push(k);
            }
        }
        let positions: Vec<f64> = unknown.iter().map(|k| feet[open[*k].number].position).collect();
        for (k, (_, exact)) in unknown.iter().zip(with_rates(traced, &positions)?) {
            rates[open[*k].number] = exact;
            open[*k].has_exact_rates = true;
        }
        open.retain_mut(
            |moving| {
                if moving.is_shortened { moving.step.abs() > 1e-12 } else { is_open(moving, &feet, &rates) }
            },
        );
    }
    Some(feet)
}

/// The step of Newton's method towards the foot of a point, from its offset; `None` if it is there.
fn newton_step(offset: Complex, rates: &Rates, (perpendicular, scale): (f64, f64)) -> Option<f64> {
    /// The greatest step.
    const MOST: f64 = 0.1;
    /// The square of a distance that is rounding, in sizes of the target.
    const ROUNDING: f64 = 1e-32;
    let Rates { velocity, acceleration } = *rates;
    let (slope, speed, square) = (dot(offset, velocity), velocity.norm_sqr(), offset.norm_sqr());
    if slope * slope <= perpendicular * perpendicular * speed * square || square * scale * scale <= ROUNDING {
        return None;
    }
    let newton = speed - dot(offset, acceleration);
    Some((slope / if newton > 0.1 * speed { newton } else { speed }).clamp(-MOST, MOST))
}

impl Rates {
    /// The derivatives after a step from one point to another: the velocity has changed by what the step tells.
    fn advance(&mut self, from: Complex, to: Complex, step: f64) {
        /// Shorter steps tell rounding.
        const LEAST: f64 = 1e-6;
        if step.abs() > LEAST {
            // Exact where the derivatives are off by a constant.
            self.velocity = (to - from) / step + self.acceleration * (0.5 * step);
        } else {
            self.velocity += self.acceleration * step;
        }
    }
}

/// The points and the derivatives at positions.
fn with_rates(traced: &Traced, positions: &[f64]) -> Option<Vec<(Complex, Rates)>> {
    let all: Vec<f64> = positions.iter().flat_map(|position| [position - STEP, *position, position + STEP]).collect();
    let at = traced.points(&all)?;
    Some(at.as_chunks::<3>().0.iter().map(|at| (at[1], Rates::new(*at, STEP))).collect())
}
