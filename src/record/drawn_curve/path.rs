//! Parses SVG path data that consists of straight lines and Bézier curves.

use svgtypes::{PathParser, PathSegment};

use super::FLATNESS_MM;
use coupler_curves::geometry::{CubicBezier, Point, Spline, SplineSegment, Vector};

/// An error of parsing path data.
pub(super) enum PathError {
    /// The data is invalid, or has other segments than lines and Bézier curves between finite points.
    NotSplines,
    /// The data has more points than allowed.
    TooManyPoints,
}

/// Parses path data into splines of at least one segment; a closed one ends where it begins. `points_left` is the number of
/// points that may still be read; it is reduced by those of the flattened splines.
pub(super) fn parse_splines(data: &str, points_left: &mut usize) -> Result<Vec<Spline>, PathError> {
    let mut splines: Vec<Spline> = Vec::new();
    let (mut current, mut start, mut is_open) = (Point::origin(), Point::origin(), false);
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|_| PathError::NotSplines)?;
        if let PathSegment::MoveTo { abs, x, y } = segment {
            current = if abs { Point::new(x, y) } else { current + Vector::new(x, y) };
            (start, is_open) = (current, false);
            continue;
        }
        let is_finite = |p: &Point| p.x.is_finite() && p.y.is_finite();
        let parsed = parse_segment(segment, current, start)
            .filter(|parsed| is_finite(&current) && parsed.points().iter().all(is_finite))
            .ok_or(PathError::NotSplines)?;
        // A new spline has its starting point, too.
        let count = chord_count(current, &parsed) + usize::from(!is_open);
        *points_left = points_left.checked_sub(count).ok_or(PathError::TooManyPoints)?;
        current = parsed.end();
        match splines.last_mut().filter(|_| is_open) {
            Some(spline) => spline.segments.push(parsed),
            None => splines.push(Spline { start, segments: vec![parsed] }),
        }
        is_open = !matches!(segment, PathSegment::ClosePath { .. });
    }
    Ok(splines)
}

/// The number of chords that a segment has when it is flattened.
fn chord_count(start: Point, segment: &SplineSegment) -> usize {
    match *segment {
        SplineSegment::Line(_) => 1,
        SplineSegment::Cubic([b, c, d]) => CubicBezier([start, b, c, d]).chord_count(FLATNESS_MM),
    }
}

/// A segment from the current point; `None` if it is neither straight nor a Bézier curve of its own control points.
fn parse_segment(segment: PathSegment, current: Point, start: Point) -> Option<SplineSegment> {
    let origin = |abs: bool| if abs { Vector::zeros() } else { current.coords };
    let at = |abs: bool, x: f64, y: f64| Point::from(origin(abs) + Vector::new(x, y));
    Some(match segment {
        PathSegment::LineTo { abs, x, y } => SplineSegment::Line(at(abs, x, y)),
        PathSegment::HorizontalLineTo { abs, x } => SplineSegment::Line(Point::new(origin(abs).x + x, current.y)),
        PathSegment::VerticalLineTo { abs, y } => SplineSegment::Line(Point::new(current.x, origin(abs).y + y)),
        PathSegment::ClosePath { .. } => SplineSegment::Line(start),
        PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
            SplineSegment::Cubic([at(abs, x1, y1), at(abs, x2, y2), at(abs, x, y)])
        }
        PathSegment::Quadratic { abs, x1, y1, x, y } => {
            let (control, end) = (at(abs, x1, y1), at(abs, x, y));
            let towards = |from: Point| from + (control - from) * (2.0 / 3.0);
            SplineSegment::Cubic([towards(current), towards(end), end])
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points of the splines.
    fn read(data: &str) -> Option<Vec<Vec<[f64; 2]>>> {
        let pairs = |spline: Spline| spline.points().map(|p| [p.x, p.y]).collect();
        parse_splines(data, &mut 100_000).ok().map(|splines| splines.into_iter().map(pairs).collect())
    }

    #[test]
    fn lines_are_parsed_as_in_svg() {
        let cases: [(&str, &[&[[f64; 2]]]); 6] = [
            ("", &[]),
            ("M1 2", &[]),
            ("m1 2 .5-1-.5 0m-1 1 3 3", &[&[[1.0, 2.0], [1.5, 1.0], [1.0, 1.0]], &[[0.0, 2.0], [3.0, 5.0]]]),
            ("M1,2L3,4H0V1h2v2", &[&[[1.0, 2.0], [3.0, 4.0], [0.0, 4.0], [0.0, 1.0], [2.0, 1.0], [2.0, 3.0]]]),
            // The line after a closed one begins at its starting point.
            ("m1 1h1v1zl-1 0", &[&[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 1.0]], &[[1.0, 1.0], [0.0, 1.0]]]),
            ("M0 0L1e2-.5.5 1", &[&[[0.0, 0.0], [100.0, -0.5], [0.5, 1.0]]]),
        ];
        for (data, expected) in cases {
            assert_eq!(read(data).unwrap(), expected, "{data}");
        }
    }

    #[test]
    fn bezier_curves_are_parsed_as_in_svg() {
        let cubic = [[1.0, 1.0], [2.0, 1.0], [3.0, 2.0], [4.0, 4.0]];
        for data in ["M1 1C2 1 3 2 4 4", "m1 1c1 0 2 1 3 3"] {
            assert_eq!(read(data).unwrap(), [cubic], "{data}");
        }
        let two = [&cubic[..], &[[5.0, 4.0], [5.0, 5.0], [5.0, 6.0]]].concat();
        assert_eq!(read("m1 1c1 0 2 1 3 3 1 0 1 1 1 2").unwrap(), [two]);
        // A parabola, as a cubic.
        let parabola = [[0.0, 0.0], [2.0, 4.0], [4.0, 4.0], [6.0, 0.0]];
        for data in ["M0 0Q3 6 6 0", "m0 0q3 6 6 0"] {
            assert_eq!(read(data).unwrap(), [parabola], "{data}");
        }
    }

    #[test]
    fn other_segments_are_errors() {
        for data in [
            "M0 0A1 1 0 0 1 2 2",
            "M0 0c1 1 2 2 3 3s1 1 2 2",
            "M0 0q1 1 2 2t2 2",
            "L1 1",
            "M0 0L1",
            "M0 0L1e999 0",
            "M0 0C1e999 0 1 1 2 2",
            "M1e999 0L1 1",
            "M0 0 x",
        ] {
            assert_eq!(read(data), None, "{data}");
        }
    }

    #[test]
    fn the_points_of_flattened_splines_are_limited() {
        let is_allowed =
            |data: &str, mut points: usize| !matches!(parse_splines(data, &mut points), Err(PathError::TooManyPoints));
        assert!(is_allowed("M0 0h1h1h1", 4) && !is_allowed("M0 0h1h1h1", 3));
        assert!(!is_allowed("M0 0C1e9 0 0 1e9 1 1", 1_000_000));
        let Ok(splines) = parse_splines("M0 0C10 0 0 10 10 10", &mut 1_000) else { panic!("a curve") };
        let count = splines[0].flatten(FLATNESS_MM).len();
        assert!(count > 100 && is_allowed("M0 0C10 0 0 10 10 10", count));
        assert!(!is_allowed("M0 0C10 0 0 10 10 10", count - 1));
    }
}
