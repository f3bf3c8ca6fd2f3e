use svgtypes::{PathParser, PathSegment};

use coupler_curves::geometry::{Point, Vector};

/// Why path data cannot be read.
pub(super) enum PathError {
    /// It is none, or goes beyond straight lines between finite places.
    NotLines,
    /// It has more points than there is room for.
    TooManyPoints,
}

/// The polylines of path data, each of two points or more; a closed one ends where it began. `room` is how many points
/// may still be read.
pub(super) fn parse_polylines(data: &str, room: &mut usize) -> Result<Vec<Vec<Point>>, PathError> {
    let mut lines: Vec<Vec<Point>> = Vec::new();
    let (mut at, mut start, mut is_open) = (Point::origin(), Point::origin(), false);
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|_| PathError::NotLines)?;
        let to = segment_end(segment, at, start)
            .filter(|to| to.x.is_finite() && to.y.is_finite())
            .ok_or(PathError::NotLines)?;
        if let PathSegment::MoveTo { .. } = segment {
            (start, is_open) = (to, false);
        } else {
            // A line that is begun takes its beginning, too.
            *room = room.checked_sub(if is_open { 1 } else { 2 }).ok_or(PathError::TooManyPoints)?;
            match lines.last_mut().filter(|_| is_open) {
                Some(line) => line.push(to),
                None => lines.push(vec![at, to]),
            }
            is_open = !matches!(segment, PathSegment::ClosePath { .. });
        }
        at = to;
    }
    Ok(lines)
}

/// Where a segment ends; `None` of one that is not straight.
fn segment_end(segment: PathSegment, at: Point, start: Point) -> Option<Point> {
    let from = |abs: bool| if abs { Point::origin() } else { at };
    Some(match segment {
        PathSegment::MoveTo { abs, x, y } | PathSegment::LineTo { abs, x, y } => from(abs) + Vector::new(x, y),
        PathSegment::HorizontalLineTo { abs, x } => Point::new(from(abs).x + x, at.y),
        PathSegment::VerticalLineTo { abs, y } => Point::new(at.x, from(abs).y + y),
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
    fn lines_are_read_as_svg_has_them() {
        let cases: [(&str, &[&[[f64; 2]]]); 6] = [
            ("", &[]),
            ("M1 2", &[]),
            ("m1 2 .5-1-.5 0m-1 1 3 3", &[&[[1.0, 2.0], [1.5, 1.0], [1.0, 1.0]], &[[0.0, 2.0], [3.0, 5.0]]]),
            ("M1,2L3,4H0V1h2v2", &[&[[1.0, 2.0], [3.0, 4.0], [0.0, 4.0], [0.0, 1.0], [2.0, 1.0], [2.0, 3.0]]]),
            // What follows a closed line begins where that began.
            ("m1 1h1v1zl-1 0", &[&[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 1.0]], &[[1.0, 1.0], [0.0, 1.0]]]),
            ("M0 0L1e2-.5.5 1", &[&[[0.0, 0.0], [100.0, -0.5], [0.5, 1.0]]]),
        ];
        for (data, expected) in cases {
            assert_eq!(read(data).unwrap(), expected, "{data}");
        }
    }

    #[test]
    fn what_is_no_line_is_refused() {
        for data in
            ["M0 0Q1 1 2 2", "M0 0c1 1 2 2 3 3", "M0 0A1 1 0 0 1 2 2", "L1 1", "M0 0L1", "M0 0L1e999 0", "M0 0 x"]
        {
            assert_eq!(read(data), None, "{data}");
        }
        assert!(matches!(parse_polylines("M0 0h1h1h1", &mut 3), Err(PathError::TooManyPoints)));
    }
}
