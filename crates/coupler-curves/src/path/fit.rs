//! Fits a cubic Bézier curve to a part of a curve.

use crate::geometry::{CubicBezier, Point, Vector, cross, left_normal};

/// The share of the tolerance within which the points must be: between them the deviation may be a little greater.
pub(super) const AT_POINTS: f64 = 0.85;

/// The control points of the cubic between two points, with the given directions there, that is within `tolerance` of
/// the curve through `points`, evenly spaced between its ends; `None` if there is none, or it is not found.
///
/// First a parabola is tried, whose control point is where the tangents meet. Otherwise the distances of the control points
/// from the ends are found by Gauss and Newton's method, for the least squares of the distances of the points, each
/// measured along the normal of the cubic at its foot.
///
/// # Source
/// Wang, Pottmann and Liu, *Fitting B-spline curves to point clouds by curvature-based squared distance minimization*,
/// ACM Transactions on Graphics 25, 2006: tangent distance minimization.
pub(super) fn fit_cubic(
    [start, end]: [Point; 2],
    [leaving, arriving]: [Vector; 2],
    points: &[Point],
    tolerance: f64,
) -> Option<[Point; 2]> {
    /// It converges in two or three rounds, or the part is too long for a cubic.
    const ROUNDS: usize = 4;
    /// A cubic that is so many times worse than allowed after the second round will not do.
    const HOPELESS: f64 = 8.0;
    let enough = AT_POINTS * tolerance;
    let feet = foot_parameters([start, end], points);
    let length = feet.length;
    let cubic = |[a, b]: [f64; 2]| CubicBezier([start, start + leaving * a, end - arriving * b, end]);
    let controls = |CubicBezier([_, b, c, _]): CubicBezier| [b, c];
    if let Some(handles) = parabola_handles(end - start, [leaving, arriving]).filter(|[a, b]| a.max(*b) < length) {
        let candidate = cubic(handles);
        if is_within(enough, &candidate, points, &feet.parameters) {
            return Some(controls(candidate));
        }
    }
    let mut feet = feet.parameters;
    let mut handles = [length / 3.0; 2];
    for round in 0..ROUNDS {
        let candidate = cubic(handles);
        let distance = greatest_distance(&candidate, points, &mut feet);
        if distance <= enough {
            return Some(controls(candidate));
        }
        if distance.is_nan() || round >= 2 && distance > HOPELESS * enough {
            return None;
        }
        let step = gauss_newton_step(&candidate, [leaving, arriving], points, &feet)?;
        handles = [handles[0] + step[0], handles[1] + step[1]];
        if !handles.iter().all(|handle| (0.0..=length).contains(handle)) {
            return None;
        }
    }
    None
}

/// Parameters of points on a cubic, at first.
struct FootParameters {
    parameters: Vec<f64>,
    /// The length of the polyline through the points.
    length: f64,
}

/// The share of the length of a polyline at each of its inner points.
fn foot_parameters([start, end]: [Point; 2], points: &[Point]) -> FootParameters {
    let (mut length, mut last) = (0.0, start);
    let mut parameters: Vec<f64> = Vec::with_capacity(points.len());
    for point in points {
        length += (point - last).norm();
        last = *point;
        parameters.push(length);
    }
    length += (end - last).norm();
    parameters.iter_mut().for_each(|parameter| *parameter /= length);
    FootParameters { parameters, length }
}

/// The distances of the control points of a parabola, as a cubic, from its ends; `None` if the tangents do not meet ahead
/// of the one and behind the other.
fn parabola_handles(chord: Vector, [leaving, arriving]: [Vector; 2]) -> Option<[f64; 2]> {
    let sine = cross(leaving, arriving);
    let handles = [cross(chord, arriving) / sine, cross(leaving, chord) / sine].map(|distance| distance * 2.0 / 3.0);
    handles.iter().all(|handle| *handle > 0.0 && handle.is_finite()).then_some(handles)
}

/// Where a point is from the cubic with some coefficients at a parameter.
#[inline]
fn offset([a, b, c, d]: &[Vector; 4], point: &Point, t: f64) -> Vector {
    a - point.coords + (b + (c + d * t) * t) * t
}

/// A parameter nearer to the foot of a point, by Newton's method.
#[inline]
fn nearer_foot(coefficients: &[Vector; 4], point: &Point, t: f64) -> f64 {
    let [_, b, c, d] = coefficients;
    let (offset, first) = (offset(coefficients, point, t), b + (c * 2.0 + d * (3.0 * t)) * t);
    let second = c * 2.0 + d * (6.0 * t);
    let step = offset.dot(&first) / (first.norm_squared() + offset.dot(&second));
    if step.is_finite() { (t - step).clamp(0.0, 1.0) } else { t }
}

/// The square of the distance of a point from a cubic at a parameter, which is moved towards its foot.
#[inline]
fn distance_squared(coefficients: &[Vector; 4], point: &Point, t: &mut f64) -> f64 {
    *t = nearer_foot(coefficients, point, nearer_foot(coefficients, point, *t));
    offset(coefficients, point, *t).norm_squared()
}

/// Whether no point is further than a distance from a cubic; near their feet are these parameters.
fn is_within(distance: f64, cubic: &CubicBezier, points: &[Point], feet: &[f64]) -> bool {
    let coefficients = cubic.coefficients();
    let is_near = |(point, &(mut t)): (&Point, &f64)| distance_squared(&coefficients, point, &mut t).sqrt() <= distance;
    points.iter().zip(feet).all(is_near)
}

/// Moves the parameters of points towards their feet on a cubic, and returns the greatest distance of a point from there:
/// none is further from the cubic.
fn greatest_distance(cubic: &CubicBezier, points: &[Point], feet: &mut [f64]) -> f64 {
    let coefficients = cubic.coefficients();
    let mut greatest = 0.0f64;
    for (point, t) in points.iter().zip(feet) {
        let square = distance_squared(&coefficients, point, t);
        if square.is_nan() || square > greatest {
            greatest = square;
        }
    }
    greatest.sqrt()
}

/// The changes of the distances of the control points from the ends that make the distances of the points least, to first
/// order; `None` if nothing changes these.
fn gauss_newton_step(
    cubic: &CubicBezier,
    [leaving, arriving]: [Vector; 2],
    points: &[Point],
    feet: &[f64],
) -> Option<[f64; 2]> {
    /// Of the diagonal, added to it: nearly straight parts say little about the distances.
    const DAMPING: f64 = 1e-6;
    let (mut aa, mut ab, mut bb, mut ar, mut br) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (point, &t) in points.iter().zip(feet) {
        let s = 1.0 - t;
        let normal = left_normal(cubic.derivatives(t)[0]).try_normalize(0.0)?;
        let distance = normal.dot(&(point - cubic.point(t)));
        let rates = [3.0 * s * s * t * normal.dot(&leaving), -3.0 * s * t * t * normal.dot(&arriving)];
        aa += rates[0] * rates[0];
        ab += rates[0] * rates[1];
        bb += rates[1] * rates[1];
        ar += rates[0] * distance;
        br += rates[1] * distance;
    }
    let damping = DAMPING * (aa + bb);
    (aa, bb) = (aa + damping, bb + damping);
    let determinant = aa * bb - ab * ab;
    let step = [(ar * bb - br * ab) / determinant, (br * aa - ar * ab) / determinant];
    step.iter().all(|change| change.is_finite()).then_some(step)
}
