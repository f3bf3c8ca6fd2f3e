//! Parses SVG path data that consists of straight lines.

use svgtypes::{PathParser, PathSegment};

use coupler_curves::geometry::{Point, Vector};

/// An error of parsing path data.
pub(super) enum PathError {
    /// The data is invalid, or has other segments than straight lines between finite points.
    NotLines,
    /// The data has more points than allowed.
    TooManyPoints,
}

/// Parses path data into polylines of at least two points; a closed polyline ends where it begins. `points_left` is the
/// number of points that may still be read; it is reduced by those that are.
pub(super) fn parse_polylines(data: &str, points_left: &mut usize) -> Result<Vec<Vec<Point>>, PathError> {
    let mut lines: Vec<Vec<Point>> = Vec::new();
    let (mut current, mut start, mut is_open) = (Point::origin(), Point::origin(), false);
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|_| PathError::NotLines)?;
        let to = segment_end(segment, current, start)
            .filter(|to| to.x.is_finite() && to.y.is_finite())
            .ok_or(PathError::NotLines)?;
        if let PathSegment::MoveTo { .. } = segment {
            (start, is_open) = (to, false);
        } else {
            // A new line has its starting point, too.
            *points_left = points_left.checked_sub(if is_open { 1 } else { 2 }).ok_or(PathError::TooManyPoints)?;
            match lines.last_mut().filter(|_| is_open) {
                Some(line) => line.push(to),
                None => lines.push(vec![current, to]),
            }
            is_open = !matches!(segment, PathSegment::ClosePath { .. });
        }
        current = to;
    }
    Ok(lines)
}

/// The end of a segment; `None` if it is not straight.
fn segment_end(segment: PathSegment, current: Point, start: Point) -> Option<Point> {
    let origin = |abs: bool| if abs { Point::origin() } else { current };
    Some(match segment {
        PathSegment::MoveTo { abs, x, y } | PathSegment::LineTo { abs, x, y } => origin(abs) + Vector::new(x, y),
        PathSegment::HorizontalLineTo { abs, x } => Point::new(origin(abs).x + x, current.y),
        PathSegment::VerticalLineTo { abs, y } => Point::new(current.x, origin(abs).y + y),
        PathSegment::ClosePath { .. } => start,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(data: &str) -> Option<Vec<Vec<[f64; 2]>>> {
        let pairs = |line: Vec<Point>| line.iter().map(|p| [p.x, p.y]).collect();
        parse_polylines(data, &mut 100).ok().map(|lines| lines.into_iter().map(pairs).collect())
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
    fn other_segments_are_errors() {
        for data in
            ["M0 0Q1 1 2 2", "M0 0c1 1 2 2 3 3", "M0 0A1 1 0 0 1 2 2", "L1 1", "M0 0L1", "M0 0L1e999 0", "M0 0 x"]
        {
            assert_eq!(read(data), None, "{data}");
        }
        assert!(matches!(parse_polylines("M0 0h1h1h1", &mut 3), Err(PathError::TooManyPoints)));
    }
}
