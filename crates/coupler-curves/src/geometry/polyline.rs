use super::{Point, Vector, cross};

/// Simplifies a polyline to a subset of its points, including the first and the last, so that no omitted point is
/// further than `tolerance` from the result.
///
/// From each point kept, a greedy sweep chooses as the next the last point that lies in the cone of directions in
/// which a line passes all points between within the tolerance, before the polyline turns back.
///
/// # Source
/// Zhao and Saalfeld, *Linear-time sleeve-fitting polyline simplification algorithms*, Auto-Carto 13, 1997.
pub fn simplify_polyline(points: &[Point], tolerance: f64) -> Vec<Point> {
    let Some((&first, rest)) = points.split_first() else { return Vec::new() };
    let mut out = vec![first];
    let mut sleeve = Sleeve::new(first);
    let mut last = first;
    for &point in rest {
        if !sleeve.try_extend(point, tolerance) {
            out.push(last);
            sleeve = Sleeve::new(last);
            sleeve.try_extend(point, tolerance);
        }
        last = point;
    }
    if !rest.is_empty() {
        out.push(last);
    }
    out
}

/// The cone of directions from a point in which a line passes all points so far within a tolerance.
struct Sleeve {
    anchor: Point,
    /// The rightmost and the leftmost direction; `None` while all directions are allowed.
    sides: Option<[Vector; 2]>,
    /// The greatest distance from the anchor of the points further away than the tolerance.
    max_distance: f64,
}

impl Sleeve {
    fn new(anchor: Point) -> Sleeve {
        Sleeve { anchor, sides: None, max_distance: 0.0 }
    }

    /// Narrows the cone by a point; returns `false` if the line cannot end at that point.
    fn try_extend(&mut self, point: Point, tolerance: f64) -> bool {
        let to = point - self.anchor;
        let distance = to.norm();
        let is_within = self.sides.is_none_or(|[right, left]| cross(right, to) >= 0.0 && cross(to, left) >= 0.0);
        if !is_within || distance < self.max_distance {
            return false;
        }
        if distance > tolerance {
            self.max_distance = distance;
            // The tangents from the anchor to the circle of the tolerance about the point.
            let along = to * (((distance - tolerance) * (distance + tolerance)).sqrt() / (distance * distance));
            let across = Vector::new(-to.y, to.x) * (tolerance / (distance * distance));
            let (right, left) = (along - across, along + across);
            self.sides = Some(match self.sides {
                None => [right, left],
                Some([old_right, old_left]) => [
                    if cross(old_right, right) > 0.0 { right } else { old_right },
                    if cross(left, old_left) > 0.0 { left } else { old_left },
                ],
            });
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{distance_to_segment, trig};

    #[test]
    fn omitted_points_are_within_the_tolerance() {
        // A curve with a wide range of curvatures, and a cusp.
        let at = |k: i32| {
            let (cos, sin) = trig::cos_sin_deg(f64::from(k) / 4.0);
            Point::new(cos * cos * cos, sin * cos * cos)
        };
        let points: Vec<Point> = (0..=1440).map(at).collect();
        for tolerance in [1e-1, 1e-2, 1e-3, 1e-4] {
            let kept = simplify_polyline(&points, tolerance);
            assert!(kept.len() < points.len(), "{tolerance}");
            assert_eq!((kept[0], kept[kept.len() - 1]), (points[0], points[1440]));
            for point in &points {
                let nearest = kept.windows(2).map(|pair| distance_to_segment(*point, pair[0], pair[1]));
                // The cone is exact up to the rounding of its tangents.
                assert!(nearest.fold(f64::INFINITY, f64::min) <= tolerance * (1.0 + 1e-9), "{tolerance}");
            }
        }
        // An arc of sagitta s has a chord of about sqrt(8 s): the result has at most twice the chords a circle needs.
        let circle: Vec<Point> = (0..=3600)
            .map(|k| {
                let (cos, sin) = trig::cos_sin_deg(f64::from(k) / 10.0);
                Point::new(cos, sin)
            })
            .collect();
        assert!(simplify_polyline(&circle, 1e-3).len() < 2 * 71);
    }

    #[test]
    fn a_line_is_reduced_to_its_ends_and_a_reversal_is_kept() {
        let line: Vec<Point> = (0..5).map(|k| Point::new(f64::from(k), 0.0)).collect();
        assert_eq!(simplify_polyline(&line, 1e-9), [line[0], line[4]]);
        let back = [line[0], line[3], line[1]];
        assert_eq!(simplify_polyline(&back, 0.1), back);
        assert!(simplify_polyline(&[], 0.1).is_empty());
        assert_eq!(simplify_polyline(&line[..1], 0.1), line[..1]);
    }
}
