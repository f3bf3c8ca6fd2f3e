use super::{Point, Vector, cross};

/// A polyline with as few of its points as a sweep from its beginning finds, first and last among them: none of the
/// others is further than `tolerance` from it.
///
/// From each point kept, the next is the last of those that lie in the cone of directions in which a line passes all
/// between within the tolerance, before the polyline turns back.
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

/// The directions from a point in which a line passes all points so far within a tolerance.
struct Sleeve {
    anchor: Point,
    /// The rightmost and the leftmost direction; all where there are none yet.
    sides: Option<[Vector; 2]>,
    /// How far the furthest point is, of those that are no longer at the anchor.
    max_distance: f64,
}

impl Sleeve {
    fn new(anchor: Point) -> Sleeve {
        Sleeve { anchor, sides: None, max_distance: 0.0 }
    }

    /// Narrows the sleeve by a point, if the line may end there.
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
    fn what_is_left_out_is_within_the_tolerance() {
        // A Lissajous curve with turns of every sharpness, and a cusp where it turns back.
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
                // The sleeve is exact but for the rounding of its tangents.
                assert!(nearest.fold(f64::INFINITY, f64::min) <= tolerance * (1.0 + 1e-9), "{tolerance}");
            }
        }
        // An arc of sagitta s has chords of about sqrt(8 s): no more of them than twice what a circle needs.
        let circle: Vec<Point> = (0..=3600)
            .map(|k| {
                let (cos, sin) = trig::cos_sin_deg(f64::from(k) / 10.0);
                Point::new(cos, sin)
            })
            .collect();
        assert!(simplify_polyline(&circle, 1e-3).len() < 2 * 71);
    }

    #[test]
    fn a_line_is_its_ends_and_a_turn_back_is_kept() {
        let line: Vec<Point> = (0..5).map(|k| Point::new(f64::from(k), 0.0)).collect();
        assert_eq!(simplify_polyline(&line, 1e-9), [line[0], line[4]]);
        let back = [line[0], line[3], line[1]];
        assert_eq!(simplify_polyline(&back, 0.1), back);
        assert!(simplify_polyline(&[], 0.1).is_empty());
        assert_eq!(simplify_polyline(&line[..1], 0.1), line[..1]);
    }
}
