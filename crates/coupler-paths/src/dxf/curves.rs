//! The curves of DXF as polylines.

use coupler_curves::geometry::{Point, Vector, trig};

use super::groups::Record;

/// Points of a whole circle.
const CIRCLE: f64 = 720.0;

/// Points of each span of a spline.
const SPAN: usize = 64;

/// The most points of an entity.
const MAX_POINTS: usize = 200_000;

/// The most spans of a spline, and its greatest degree.
const MAX_SPANS: usize = MAX_POINTS / SPAN;
const MAX_DEGREE: usize = 25;

/// Points along an arc of an ellipse, from one parameter to another, in radians; `[major, minor]` are its half axes.
pub(super) fn ellipse(centre: Point, [major, minor]: [Vector; 2], [from, to]: [f64; 2]) -> Vec<Point> {
    let count = ((to - from).abs() / std::f64::consts::TAU * CIRCLE).ceil().clamp(1.0, CIRCLE) as usize;
    let at = |k: usize| {
        let angle = from + (to - from) * k as f64 / count as f64;
        centre + major * trig::cos(angle) + minor * trig::sin(angle)
    };
    (0..=count).map(at).collect()
}

/// Adds the points from the last one on to another, along an arc whose bulge is the tangent of a quarter of its angle.
pub(super) fn bulge_to(points: &mut Vec<Point>, to: Point, bulge: f64) {
    let from = points[points.len() - 1];
    if bulge != 0.0 && bulge.is_finite() && from != to {
        let chord = to - from;
        let across = Vector::new(-chord.y, chord.x);
        let centre = from + chord * 0.5 + across * ((1.0 - bulge * bulge) / (4.0 * bulge));
        let radius = from - centre;
        let angle = 4.0 * trig::atan2(bulge, 1.0);
        let arc = ellipse(centre, [radius, Vector::new(-radius.y, radius.x)], [0.0, angle]);
        points.extend_from_slice(&arc[1..arc.len() - 1]);
    }
    points.push(to);
}

/// Points along a spline, a B-spline that may be rational.
///
/// # Errors
/// Its control points, weights and knots do not fit each other.
pub(super) fn spline(record: &Record) -> Result<Vec<Point>, String> {
    let error = |what: &str| format!("line {}: the SPLINE {what}", record.line);
    let (x, y, knots, weights) = (record.numbers(10)?, record.numbers(20)?, record.numbers(40)?, record.numbers(41)?);
    let degree = record.needed(71)? as usize;
    let control: Vec<Point> = x.iter().zip(&y).map(|(x, y)| Point::new(*x, *y)).collect();
    if control.is_empty() {
        return Err(error("has fit points only: convert it to a polyline"));
    }
    let has_weights =
        weights.is_empty() || weights.len() == control.len() && weights.iter().all(|weight| *weight > 0.0);
    let is_sorted = knots.windows(2).all(|pair| pair[0] <= pair[1]);
    if x.len() != y.len()
        || !(1..=MAX_DEGREE).contains(&degree)
        || control.len() <= degree
        || knots.len() != control.len() + degree + 1
        || !has_weights
        || !is_sorted
    {
        return Err(error("has knots, weights and control points that do not fit each other"));
    }
    if control.len() > MAX_SPANS {
        return Err(error(&format!("has more than {MAX_SPANS} control points")));
    }
    let weight = |k: usize| weights.get(k).copied().unwrap_or(1.0);
    let mut points = Vec::new();
    for span in degree..control.len() {
        let (from, to) = (knots[span], knots[span + 1]);
        if from == to {
            continue;
        }
        let first = usize::from(!points.is_empty());
        for step in first..=SPAN {
            let at = from + (to - from) * step as f64 / SPAN as f64;
            // De Boor's algorithm in homogeneous coordinates.
            let mut row: Vec<[f64; 3]> = (span - degree..=span)
                .map(|k| [control[k].x * weight(k), control[k].y * weight(k), weight(k)])
                .collect();
            for level in 1..=degree {
                for k in (level..=degree).rev() {
                    let [low, high] = [knots[span - degree + k], knots[span + 1 + k - level]];
                    let part = if high > low { (at - low) / (high - low) } else { 0.0 };
                    row[k] = std::array::from_fn(|axis| (1.0 - part) * row[k - 1][axis] + part * row[k][axis]);
                }
            }
            let [x, y, w] = row[degree];
            points.push(Point::new(x / w, y / w));
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::super::groups::{Record, groups};
    use super::*;

    #[test]
    fn a_bulge_is_an_arc() {
        // A half circle to the right of the chord's direction, and a quarter to its left.
        for (bulge, centre) in
            [(1.0, [1.0, 0.0]), (-1.0, [1.0, 0.0]), (trig::tan(std::f64::consts::FRAC_PI_8), [1.0, 1.0])]
        {
            let mut points = vec![Point::new(0.0, 0.0)];
            bulge_to(&mut points, Point::new(2.0, 0.0), bulge);
            let centre = Point::new(centre[0], centre[1]);
            let radius = (points[0] - centre).norm();
            assert!(
                points.len() > 100 && points.iter().all(|p| ((p - centre).norm() - radius).abs() < 1e-12),
                "{bulge}"
            );
            // The arc is on the right of the chord if the bulge is positive.
            assert!(points[points.len() / 2].y * bulge < 0.0);
        }
    }

    #[test]
    fn a_rational_spline_is_a_circle() {
        // The quarter of a unit circle as a quadratic spline.
        let text = "0\nSPLINE\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n41\n1\n41\n0.7071067811865476\n41\n1\n\
                    10\n1\n20\n0\n10\n1\n20\n1\n10\n0\n20\n1\n";
        let groups = groups(text).unwrap();
        let points = spline(&Record::all(&groups)[0]).unwrap();
        assert_eq!((points[0], points[points.len() - 1]), (Point::new(1.0, 0.0), Point::new(0.0, 1.0)));
        assert!(points.iter().all(|p| (p.coords.norm() - 1.0).abs() < 1e-12));
    }
}
