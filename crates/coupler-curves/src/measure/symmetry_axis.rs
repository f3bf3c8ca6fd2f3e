use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, Vector, complex_product, cross, trig};

/// A line that a curve may be symmetrical about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryAxis {
    /// A point of it.
    pub point: Point,
    /// Its direction, of length 1.
    pub direction: Vector,
}

impl SymmetryAxis {
    /// The line through a point in a direction; `None` where that is none.
    pub fn new(through: Point, direction: Vector) -> Option<SymmetryAxis> {
        let along = direction.try_normalize(0.0).filter(|along| along.x.is_finite() && along.y.is_finite())?;
        Some(SymmetryAxis { point: through, direction: along })
    }

    /// The mirror image of a point.
    pub fn mirror(&self, point: Point) -> Point {
        let by = point - self.point;
        self.point + self.direction * (2.0 * self.direction.dot(&by)) - by
    }

    /// Its direction from the x-axis, in degrees, from 0 up to 180.
    pub fn direction_deg(&self) -> f64 {
        let deg = trig::degrees(trig::atan2(self.direction.y, self.direction.x)).rem_euclid(180.0);
        if deg == 180.0 { 0.0 } else { deg }
    }
}

/// The axis that a curve is symmetrical about if it is about any, by the moments of its length; `None` where moments of
/// up to the third order tell of none, as of a circle.
///
/// An axis of symmetry is a principal axis of the second moments, and moments of an odd order across it vanish. Where the
/// second moments are the same every way, those of the third order tell the axis.
pub(super) fn axis_by_moments(trail: &SampledCurve) -> Option<SymmetryAxis> {
    /// What is less than this part of what it might be is taken for nothing.
    const NONE: f64 = 1e-3;
    let weights = trail.sample_weights();
    let total: f64 = weights.iter().sum();
    let centre = trail.points.iter().zip(&weights).map(|(p, w)| p.coords * *w).sum::<Vector>() / total;
    let (mut all, mut cubes) = (0.0, 0.0);
    let (mut second, mut third, mut threefold) = (Vector::zeros(), Vector::zeros(), Vector::zeros());
    for (p, w) in trail.points.iter().zip(&weights) {
        let z = p.coords - centre;
        let (square, norm2) = (complex_product(z, z), z.norm_squared());
        all += w * norm2;
        cubes += w * norm2 * norm2.sqrt();
        second += square * *w;
        third += z * (w * norm2);
        threefold += complex_product(square, z) * *w;
    }
    let axis = |deg: f64| {
        let (cos, sin) = trig::cos_sin_deg(deg);
        SymmetryAxis::new(Point::from(centre), Vector::new(cos, sin))
    };
    let direction = |moment: Vector, fold: f64| trig::degrees(trig::atan2(moment.y, moment.x)) / fold;
    // How far the odd moments are from vanishing across a line.
    let oddness = |deg: f64| {
        let across = |moment: Vector, deg: f64| {
            let (cos, sin) = trig::cos_sin_deg(deg);
            (moment.y * cos - moment.x * sin).abs()
        };
        across(third, deg) + across(threefold, 3.0 * deg)
    };
    if second.norm() > NONE * all {
        let long = direction(second, 2.0);
        return axis(if oddness(long) <= oddness(long + 90.0) + 1e-9 * cubes { long } else { long + 90.0 });
    }
    match () {
        () if third.norm() > NONE * cubes => axis(direction(third, 1.0)),
        () if threefold.norm() > NONE * cubes => axis(direction(threefold, 3.0)),
        () => None,
    }
}

/// How far the mirror image of a curve is from it: the greatest distance of mirrored samples, no fewer than ninety of them
/// where there are so many, from the lines between all.
pub(super) fn rough_residual(trail: &SampledCurve, axis: SymmetryAxis) -> f64 {
    const ENOUGH: usize = 90;
    let stride = (trail.points.len() / ENOUGH).max(1);
    let samples = SampleIndex::new(&trail.points);
    let mut near = 0;
    let mut most = 0.0f64;
    for p in trail.points.iter().step_by(stride) {
        let image = axis.mirror(*p);
        near = samples.nearest(image, near);
        // No line to a neighbour is further than the sample itself.
        if (trail.points[near] - image).norm_squared() > most * most {
            most = most.max(trail.distance_to_chords(image, near));
        }
    }
    most
}

/// Samples, with boxes round those that follow one another, by which it is seen that they are not the nearest.
struct SampleIndex<'a> {
    points: &'a [Point],
    boxes: Vec<[Point; 2]>,
}

impl SampleIndex<'_> {
    const BOX_SIZE: usize = 16;

    fn new(points: &[Point]) -> SampleIndex<'_> {
        let corners = |points: &[Point]| points.iter().fold([points[0]; 2], |[low, high], p| [low.inf(p), high.sup(p)]);
        SampleIndex { points, boxes: points.chunks(Self::BOX_SIZE).map(corners).collect() }
    }

    /// The sample that is nearest to a point, looked for beyond `guess`.
    fn nearest(&self, point: Point, guess: usize) -> usize {
        let square = |k: usize| (self.points[k] - point).norm_squared();
        let (mut near, mut best) = (guess, square(guess));
        // Along the curve to where it is nearer than at either side: most boxes are further than that.
        for way in [1, self.points.len() - 1] {
            while let next = (near + way) % self.points.len()
                && square(next) < best
            {
                (best, near) = (square(next), next);
            }
        }
        for (k, [low, high]) in self.boxes.iter().enumerate() {
            let off = |low: f64, at: f64, high: f64| (low - at).max(at - high).max(0.0);
            let (x, y) = (off(low.x, point.x, high.x), off(low.y, point.y, high.y));
            if x * x + y * y < best {
                let first = k * Self::BOX_SIZE;
                for (j, q) in self.points[first..].iter().take(Self::BOX_SIZE).enumerate() {
                    let square = (q - point).norm_squared();
                    if square < best {
                        (best, near) = (square, first + j);
                    }
                }
            }
        }
        near
    }
}

/// The axis about which a nearly symmetrical curve is most nearly so, in the mean of the squares, and how far the image is
/// from the curve there at most; of a given axis only the latter.
pub(super) fn refine_axis(trail: &SampledCurve, mut axis: SymmetryAxis, is_given: bool) -> (SymmetryAxis, f64) {
    const ROUNDS: usize = 3;
    /// Of so many samples one is enough to find the axis by.
    const STRIDE: usize = 4;
    let samples = SampleIndex::new(&trail.points);
    let mut near = 0;
    for round in 0.. {
        let mut most = 0.0f64;
        let across = Vector::new(-axis.direction.y, axis.direction.x);
        // The normal equations of an offset and a turn.
        let (mut a, mut b, mut c, mut u, mut v) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let is_last = is_given || round == ROUNDS;
        for p in trail.points.iter().step_by(if is_last { 1 } else { STRIDE }) {
            let image = axis.mirror(*p);
            near = samples.nearest(image, near);
            let Some((off, normal)) = trail.signed_distance(image, near) else { continue };
            most = most.max(off.abs());
            let by = image - axis.point;
            let (shift, turn) = (2.0 * normal.dot(&across), 2.0 * cross(by, normal));
            a += shift * shift;
            b += shift * turn;
            c += turn * turn;
            u += shift * off;
            v += turn * off;
        }
        let det = a * c - b * b;
        if is_last {
            return (axis, most);
        }
        if det <= 1e-12 * a * c {
            continue;
        }
        let (shift, turn) = ((b * v - c * u) / det, (b * u - a * v) / det);
        let along = axis.direction + across * turn;
        axis = SymmetryAxis::new(axis.point + across * shift, along).unwrap_or(axis);
    }
    (axis, f64::INFINITY)
}
