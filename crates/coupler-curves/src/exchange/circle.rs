use crate::geometry::{Bounds, Point, cross, trig};

/// A circle, or the arc of one that a path covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    pub centre: Point,
    pub radius: f64,
    /// The start and the end of the arc, in degrees counter-clockwise; `None` for the whole circle.
    pub arc_deg: Option<[f64; 2]>,
}

/// The greatest distance of a point from the circle, relative to the radius.
const RELATIVE_TOLERANCE: f64 = 1e-9;

/// The greatest radius of an arc, relative to the path's extent; a flatter path remains a polyline.
const MAX_RELATIVE_RADIUS: f64 = 1e4;

/// The least number of points: fewer may lie on a circle by chance.
const MIN_POINTS: usize = 12;

/// The circle through all points of a path and all `further` points, if there is one; the path may reverse on it.
pub(super) fn fit_circle(path: &[Point], further: &[Point]) -> Option<Circle> {
    let all = || path.iter().chain(further);
    if path.len() + further.len() < MIN_POINTS {
        return None;
    }
    let (centre, radius) = circumcircle(path)?;
    let is_on = |p: &Point| ((p - centre).norm() - radius).abs() <= RELATIVE_TOLERANCE * radius;
    let extent = Bounds::from_points(path.iter().copied()).size().max();
    if radius > MAX_RELATIVE_RADIUS * extent || !all().all(is_on) {
        return None;
    }
    // The signed angle about the centre from the first point.
    let mut angle = 0.0;
    let [mut least, mut most] = [(0.0, path[0]); 2];
    for pair in path.windows(2) {
        let (a, b) = (pair[0] - centre, pair[1] - centre);
        angle += trig::atan2(cross(a, b), a.dot(&b));
        if angle < least.0 {
            least = (angle, pair[1]);
        }
        if angle > most.0 {
            most = (angle, pair[1]);
        }
    }
    let is_whole = trig::degrees(most.0 - least.0) >= 360.0 * (1.0 - RELATIVE_TOLERANCE);
    let arc_deg = (!is_whole).then(|| [least, most].map(|(_, p)| direction_deg(p, centre)));
    // Digits beyond the precision of the points are rounded off.
    let place = 12 - trig::log10(radius).ceil() as i32;
    Some(Circle { centre: centre.map(|c| round_to_places(c, place)), radius: round_to_places(radius, place), arc_deg })
}

/// The circle through the first point, the point furthest from it, and the point furthest from their line.
fn circumcircle(path: &[Point]) -> Option<(Point, f64)> {
    let a = *path.first()?;
    let by = |value: &dyn Fn(&Point) -> f64| path.iter().copied().max_by(|p, q| value(p).total_cmp(&value(q)));
    let b = by(&|p| (p - a).norm_squared())?;
    let c = by(&|p| cross(b - a, p - a).abs())?;
    let (ab, ac) = (b - a, c - a);
    let twice = 2.0 * cross(ab, ac);
    let (b2, c2) = (ab.norm_squared(), ac.norm_squared());
    let from_a = Point::new((ac.y * b2 - ab.y * c2) / twice, (ab.x * c2 - ac.x * b2) / twice);
    let radius = from_a.coords.norm();
    radius.is_finite().then(|| (a + from_a.coords, radius)).filter(|_| radius > 0.0)
}

/// The direction of a point from another, in degrees in [0, 360), to nine decimal places.
fn direction_deg(p: Point, from: Point) -> f64 {
    let deg = round_to_places(trig::degrees(trig::atan2(p.y - from.y, p.x - from.x)), 9);
    let deg = if deg < 0.0 { deg + 360.0 } else { deg };
    round_to_places(deg, 9)
}

/// Rounds a number to decimal places; to an integer if `places` is negative.
fn round_to_places(value: f64, places: i32) -> f64 {
    let places = usize::try_from(places).unwrap_or(0).min(100);
    // A formatted number can always be parsed. Adding 0 removes the sign of zero.
    format!("{value:.places$}").parse::<f64>().unwrap_or(value) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(from: i32, to: i32, step: usize) -> Vec<Point> {
        let at = |deg: i32| {
            let (cos, sin) = trig::cos_sin_deg(f64::from(deg));
            Point::new(3.0 + 2.0 * cos, -1.0 + 2.0 * sin)
        };
        (from..=to).step_by(step).map(at).collect()
    }

    #[test]
    fn circles_and_arcs_are_recognised() {
        let whole = fit_circle(&arc(0, 360, 5), &[]).unwrap();
        assert_eq!(whole, Circle { centre: Point::new(3.0, -1.0), radius: 2.0, arc_deg: None });
        let mut reversing = arc(-30, 50, 4);
        reversing.extend(arc(-30, 50, 4).into_iter().rev());
        let part = fit_circle(&reversing, &[]).unwrap();
        assert_eq!(part.arc_deg, Some([330.0, 50.0]));
        let mut dented = arc(0, 360, 5);
        dented[20].x += 1e-7;
        assert_eq!(fit_circle(&dented, &[]), None);
        let line: Vec<Point> = (0..20).map(|k| Point::new(f64::from(k), 2.0)).collect();
        assert_eq!(fit_circle(&line, &[]), None);
        assert_eq!(fit_circle(&arc(0, 8, 4), &[]), None, "three points always lie on a circle");
        assert_eq!(fit_circle(&[Point::origin(); 20], &[]), None);
    }
}
