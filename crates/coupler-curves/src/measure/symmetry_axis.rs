//! The axis about which a curve is most nearly symmetrical, and the distance of the curve from its mirror image.

use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, Vector, complex_product, cross, trig};

/// A line about which a curve may be symmetrical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryAxis {
    /// A point on it.
    pub point: Point,
    /// Its direction, of length 1.
    pub direction: Vector,
}

impl SymmetryAxis {
    /// The line through a point in a direction; `None` if the direction is zero or not finite.
    pub fn new(through: Point, direction: Vector) -> Option<SymmetryAxis> {
        let along = direction.try_normalize(0.0).filter(|along| along.x.is_finite() && along.y.is_finite())?;
        Some(SymmetryAxis { point: through, direction: along })
    }

    /// The mirror image of a point.
    pub fn mirror(&self, point: Point) -> Point {
        let offset = point - self.point;
        self.point + self.direction * (2.0 * self.direction.dot(&offset)) - offset
    }

    /// Its direction from the x-axis, in degrees, from 0 up to 180.
    pub fn direction_deg(&self) -> f64 {
        let deg = trig::degrees(trig::atan2(self.direction.y, self.direction.x)).rem_euclid(180.0);
        if deg == 180.0 { 0.0 } else { deg }
    }
}

/// The only line about which a curve can be symmetrical, from the moments of its length; `None` if its moments of up to
/// the third order do not determine one, like those of a circle.
///
/// An axis of symmetry is a principal axis of the second moments, and moments of an odd order across it vanish. If the
/// second moments are isotropic, those of the third order determine the axis.
pub(super) fn axis_by_moments(curve: &SampledCurve) -> Option<SymmetryAxis> {
    /// A moment less than this part of the greatest possible one is negligible.
    const NEGLIGIBLE: f64 = 1e-3;
    let weights = curve.sample_weights();
    let total: f64 = weights.iter().sum();
    let centre = curve.points.iter().zip(&weights).map(|(p, w)| p.coords * *w).sum::<Vector>() / total;
    let (mut all, mut cubes) = (0.0, 0.0);
    let (mut second, mut third, mut threefold) = (Vector::zeros(), Vector::zeros(), Vector::zeros());
    for (p, w) in curve.points.iter().zip(&weights) {
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
    // The magnitude of the odd moments across a line.
    let oddness = |deg: f64| {
        let across = |moment: Vector, deg: f64| {
            let (cos, sin) = trig::cos_sin_deg(deg);
            (moment.y * cos - moment.x * sin).abs()
        };
        across(third, deg) + across(threefold, 3.0 * deg)
    };
    if second.norm() > NEGLIGIBLE * all {
        let long = direction(second, 2.0);
        return axis(if oddness(long) <= oddness(long + 90.0) + 1e-9 * cubes { long } else { long + 90.0 });
    }
    match () {
        () if third.norm() > NEGLIGIBLE * cubes => axis(direction(third, 1.0)),
        () if threefold.norm() > NEGLIGIBLE * cubes => axis(direction(threefold, 3.0)),
        () => None,
    }
}

/// The greatest distance of mirrored samples, at least ninety of them if there are as many, from the chords of the
/// curve.
pub(super) fn rough_residual(curve: &SampledCurve, axis: SymmetryAxis) -> f64 {
    const MIN_SAMPLES: usize = 90;
    let stride = (curve.points.len() / MIN_SAMPLES).max(1);
    let samples = SampleIndex::new(&curve.points);
    let mut near = 0;
    let mut most = 0.0f64;
    for p in curve.points.iter().step_by(stride) {
        let image = axis.mirror(*p);
        near = samples.nearest(image, near);
        // The chords are no further away than the sample itself.
        if (curve.points[near] - image).norm_squared() > most * most {
            most = most.max(curve.distance_to_chords(image, near));
        }
    }
    most
}

/// Samples with bounding boxes of consecutive ones, for the search for the nearest.
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

    /// The sample nearest to a point, searched for from a `guess`.
    fn nearest(&self, point: Point, guess: usize) -> usize {
        let square = |k: usize| (self.points[k] - point).norm_squared();
        let (mut near, mut best) = (guess, square(guess));
        // Descend along the curve to a local minimum first: most boxes are further away than that.
        for step in [1, self.points.len() - 1] {
            while let next = (near + step) % self.points.len()
                && square(next) < best
            {
                (best, near) = (square(next), next);
            }
        }
        for (k, [low, high]) in self.boxes.iter().enumerate() {
            let outside = |low: f64, at: f64, high: f64| (low - at).max(at - high).max(0.0);
            let (x, y) = (outside(low.x, point.x, high.x), outside(low.y, point.y, high.y));
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

/// Refines the axis of a nearly symmetrical curve by least squares, unless it `is_given`. Returns the axis and the
/// greatest distance of the mirror image from the curve.
pub(super) fn refine_axis(curve: &SampledCurve, mut axis: SymmetryAxis, is_given: bool) -> (SymmetryAxis, f64) {
    const ROUNDS: usize = 3;
    /// Every fourth sample is enough to refine the axis.
    const STRIDE: usize = 4;
    let samples = SampleIndex::new(&curve.points);
    let mut near = 0;
    for round in 0.. {
        let mut most = 0.0f64;
        let across = Vector::new(-axis.direction.y, axis.direction.x);
        // The normal equations for a shift and a rotation of the axis.
        let (mut a, mut b, mut c, mut u, mut v) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let is_last = is_given || round == ROUNDS;
        for p in curve.points.iter().step_by(if is_last { 1 } else { STRIDE }) {
            let image = axis.mirror(*p);
            near = samples.nearest(image, near);
            let Some((distance, normal)) = curve.signed_distance(image, near) else { continue };
            most = most.max(distance.abs());
            let offset = image - axis.point;
            let (shift, turn) = (2.0 * normal.dot(&across), 2.0 * cross(offset, normal));
            a += shift * shift;
            b += shift * turn;
            c += turn * turn;
            u += shift * distance;
            v += turn * distance;
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
