//! Lines of charts as they are drawn.

use super::adaptive::ChartPoint;

/// A line of a chart for one quantity, in as many points as it needs. A point with a value that is not finite is a gap
/// in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinePath {
    /// x and y of its points.
    pub points: Vec<[f64; 2]>,
    /// The least and the greatest y at which it turns or ends, apart from the sides of poles; `None` if there are none.
    pub range: Option<[f64; 2]>,
}

impl LinePath {
    /// The path through densely sampled points, without those that make no visible difference, and with gaps where the
    /// quantity jumps.
    pub(super) fn from_dense_points(points: &[ChartPoint]) -> LinePath {
        let mut kept = Vec::new();
        let mut range: Option<[f64; 2]> = None;
        for run in points.split(|point| !point.is_drawable()).filter(|run| !run.is_empty()) {
            for run in split_at_jumps(run) {
                kept.extend((!kept.is_empty()).then_some([f64::NAN; 2]));
                kept.extend(thinned(run).into_iter().map(|point| point.value));
                range = range.into_iter().chain(settled_range(run)).reduce(union);
            }
        }
        LinePath { points: kept, range }
    }
}

/// The range of two ranges together.
pub(super) fn union(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// The least and the greatest y at which a line turns or ends.
///
/// The sides of a pole are left out: they end, or turn, far from the samples next to them, however many there are, and
/// would determine the range of the axis by chance.
pub(super) fn settled_range(points: &[ChartPoint]) -> Option<[f64; 2]> {
    /// The distance of neighbours, as a fraction of the axis of the cells.
    const CLOSE: f64 = 0.05;
    let height = |k: Option<usize>| points.get(k?).map(|point| point.place[1]).filter(|height| !height.is_nan());
    let is_settled = |k: &usize| {
        let changes = [k.checked_sub(1), Some(k + 1)].map(|near| Some(height(near)? - height(Some(*k))?));
        match changes {
            [Some(before), Some(after)] => before * after >= 0.0 && before.abs().max(after.abs()) <= CLOSE,
            [change, None] | [None, change] => change.is_some_and(|change| change.abs() <= CLOSE),
        }
    };
    let settled = (0..points.len()).filter(is_settled).map(|k| points[k].value[1]);
    settled.fold(None, |range, y| match range {
        None => Some([y, y]),
        Some([low, high]) => Some([low.min(y), high.max(y)]),
    })
}

/// The parts of a run between its jumps: steps that are much greater than those next to them, such as that of an angle
/// from 180° to -180°, or that go against both, as from one side of a pole to the other.
fn split_at_jumps(run: &[ChartPoint]) -> Vec<&[ChartPoint]> {
    /// The smallest jump, as a fraction of the axis.
    const SMALLEST: f64 = 0.05;
    /// How much greater than its neighbours it is.
    const FACTOR: f64 = 8.0;
    let step = |k: Option<usize>| Some(run.get(k? + 1)?.place[1] - run[k?].place[1]);
    let is_jump = |k: usize| {
        let Some(change) = step(Some(k)) else { return false };
        let near: Vec<f64> = [step(k.checked_sub(1)), step(Some(k + 1))].into_iter().flatten().collect();
        let is_greater = |factor: f64| near.iter().all(|near| change.abs() > factor * near.abs());
        let is_opposite = near.len() == 2 && near.iter().all(|near| change * near < 0.0);
        change.abs() > SMALLEST && (is_greater(FACTOR) || (is_opposite && is_greater(1.0)))
    };
    let mut parts = Vec::new();
    let mut start = 0;
    for k in (0..run.len()).filter(|&k| is_jump(k)) {
        parts.push(&run[start..=k]);
        start = k + 1;
    }
    parts.push(&run[start..]);
    parts
}

/// The points of a run without those closer than a tolerance to the line through the others (Ramer 1972, Douglas and
/// Peucker 1973).
fn thinned(run: &[ChartPoint]) -> Vec<ChartPoint> {
    /// The greatest deviation, as a fraction of the axes: 0.05 mm on an axis of 400 mm.
    const TOLERANCE: f64 = 1.0 / 8000.0;
    let mut is_kept = vec![false; run.len()];
    let mut open = vec![[0, run.len().saturating_sub(1)]];
    while let Some([from, to]) = open.pop() {
        let ends = [from, to].map(|k| run.get(k).map(|point| point.place));
        let [Some(a), Some(b)] = ends else { continue };
        (is_kept[from], is_kept[to]) = (true, true);
        let furthest = (from + 1..to).map(|k| (k, distance(run[k].place, a, b)));
        let furthest = furthest.reduce(|a, b| if b.1 > a.1 { b } else { a });
        if let Some((k, distance)) = furthest
            && distance > TOLERANCE
        {
            open.extend([[from, k], [k, to]]);
        }
    }
    run.iter().zip(is_kept).filter(|(_, is_kept)| *is_kept).map(|(point, _)| *point).collect()
}

/// The distance of a point from the segment between two others.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length_squared = along[0] * along[0] + along[1] * along[1];
    let part = ((to[0] * along[0] + to[1] * along[1]) / length_squared).clamp(0.0, 1.0);
    let part = if part.is_nan() { 0.0 } else { part };
    let off = [to[0] - part * along[0], to[1] - part * along[1]];
    (off[0] * off[0] + off[1] * off[1]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::trig;

    fn path(function: fn(f64) -> f64) -> LinePath {
        let point = |k: u32| {
            let x = f64::from(k) / 1000.0;
            ChartPoint { value: [x, function(x)], place: [x, function(x)] }
        };
        LinePath::from_dense_points(&(0..=1000).map(point).collect::<Vec<_>>())
    }

    #[test]
    fn few_points_follow_a_smooth_line() {
        let wave = |x: f64| 0.5 + 0.5 * trig::sin(10.0 * x);
        let LinePath { points, range } = path(wave);
        assert!(points.len() < 150, "{}", points.len());
        let middle = |pair: &[[f64; 2]]| [0, 1].map(|k| (pair[0][k] + pair[1][k]) / 2.0);
        assert!(points.windows(2).map(middle).all(|[x, y]| (wave(x) - y).abs() < 1e-3));
        let [low, high] = range.unwrap();
        assert!(low < 1e-4 && high > 1.0 - 1e-4);
        assert_eq!(path(|x| 0.25 * x).points, [[0.0, 0.0], [1.0, 0.25]]);
        assert_eq!(LinePath::from_dense_points(&[]), LinePath::default());
    }

    #[test]
    fn jumps_and_missing_values_are_gaps() {
        let gaps = |function: fn(f64) -> f64| {
            let points = path(function).points;
            points.iter().filter(|[_, y]| y.is_nan()).count()
        };
        assert_eq!(gaps(|x| (3.0 * x).fract()), 3);
        assert_eq!(gaps(|x| 0.01 / (x - 0.30033)), 1);
        assert_eq!(gaps(|x| if (0.4..0.6).contains(&x) { f64::NAN } else { x }), 1);
        assert_eq!(gaps(|x| (20.0 * (x - 0.5)).clamp(-1.0, 1.0)), 0);
        assert_eq!(gaps(|x| x.sqrt()), 0);
    }
}
