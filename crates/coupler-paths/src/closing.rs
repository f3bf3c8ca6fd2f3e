//! Whether the gap between the ends of a path is its closing step, as in a file of a closed curve without its first point at the end.

use coupler_curves::geometry::{Point, Vector};

/// How many steps on either side of a step its prediction is the mean of: two steps follow a curve whose steps change evenly, eight are
/// needed where they are mostly noise. Those are taken which predict the steps of the path better.
const REACHES: [usize; 2] = [1, 4];

/// The least and the greatest limit of a deviation from a prediction, relative to the steps of which that is the mean: two even steps in place of one
/// deviate by 1, four in any path by about 3.
const LIMITS: [f64; 2] = [0.6, 2.5];

/// How much more the closing step may deviate from its prediction than the other steps do.
const MARGIN: f64 = 1.2;

/// Ends are near, in any direction of the gap, if it is no longer than so many times the shorter of the steps beside it, or than this part of
/// the median step.
const NEAR: [f64; 2] = [1.25, 0.5];

/// The gap from the last point of a path to its first, compared with the steps of the path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// 0 if there is none, at most 1 if it is like the steps beside it.
    ratio: f64,
}

impl Gap {
    /// `None` for a path without steps.
    pub fn of(points: &[Point]) -> Option<Gap> {
        let (first, last) = (points.first()?, points.last()?);
        if points.len() < 2 || first == last {
            return (points.len() > 1).then_some(Gap { ratio: 0.0 });
        }
        // Differences and squares are then in the range of numbers.
        let greatest = points.iter().map(|point| point.x.abs().max(point.y.abs())).fold(0.0, f64::max);
        let step = |from: &Point, to: &Point| to / greatest - from / greatest;
        let steps: Vec<Vector> = points.windows(2).map(|pair| step(&pair[0], &pair[1])).collect();
        let gap = step(last, first);
        let lengths: Vec<f64> = steps.iter().map(Vector::norm).collect();
        let beside = lengths[0].min(lengths[lengths.len() - 1]);
        let near = (NEAR[0] * beside).max(NEAR[1] * quantile(&lengths, 0.5));
        let nearness = if near > 0.0 { gap.norm() / near } else { f64::INFINITY };
        let ratio = deviation(&steps, gap).map_or(nearness, |deviation| deviation.min(nearness));
        Some(Gap { ratio })
    }

    /// Whether it is read as a step of the path, which is closed then.
    pub fn is_step(self) -> bool {
        self.ratio <= 1.0
    }

    /// Whether it is much nearer to one reading than to the other.
    pub fn is_certain(self) -> bool {
        !(0.5..=2.0).contains(&self.ratio)
    }
}

/// The deviation of the gap from what the steps beside it predict, over the limit: the greatest deviation of a step within the path. `None` if there are
/// too few steps.
fn deviation(steps: &[Vector], gap: Vector) -> Option<f64> {
    let count = steps.len();
    let of_reach = |reach: usize| {
        // Steps further from the gap follow on either side of it.
        let at_gap = deviation_of(gap, [&steps[count.checked_sub(reach)?..], steps.get(..reach)?])?;
        let inner = |k: usize| deviation_of(steps[k], [&steps[k - reach..k], &steps[k + 1..=k + reach]]);
        let inner: Vec<f64> = (reach..count.saturating_sub(reach)).filter_map(inner).collect();
        let greatest = inner.iter().copied().reduce(f64::max)?;
        Some((quantile(&inner, 0.8), at_gap / (MARGIN * greatest).clamp(LIMITS[0], LIMITS[1])))
    };
    let best =
        REACHES.into_iter().filter_map(of_reach).reduce(|best, other| if other.0 < best.0 { other } else { best });
    best.map(|(_, deviation)| deviation)
}

/// The distance of a step from the mean of those on both sides, relative to their mean length; infinite beside points that are repeated.
fn deviation_of(step: Vector, beside: [&[Vector]; 2]) -> Option<f64> {
    let beside = beside.concat();
    let count = beside.len() as f64;
    let mean = beside.iter().sum::<Vector>() / count;
    let length = beside.iter().map(Vector::norm).sum::<f64>() / count;
    let distance = (step - mean).norm();
    let deviation = if distance == 0.0 { 0.0 } else { distance / length };
    (!deviation.is_nan()).then_some(deviation)
}

/// The value below which a part of the values is; there is at least one.
fn quantile(values: &[f64], part: f64) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values[(part * (values.len() - 1) as f64).round() as usize]
}
