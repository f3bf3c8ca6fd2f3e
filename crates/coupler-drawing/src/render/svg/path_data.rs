//! Path data, which is the `d` attribute of a path: millimetres, rounded to 1/1000 mm.

use std::fmt::Write;

use super::number::{Number, to_micrometres};
use crate::scene::{Curve, Path};
use coupler_curves::geometry::{Point, SplineSegment};

/// Appends the data of a path in relative coordinates.
pub(super) fn write_path_data(out: &mut String, path: &Path) {
    let mut writer = PathWriter::default();
    for line in &path.polylines {
        for (k, &point) in line.points.iter().enumerate() {
            writer.write_command(out, if k == 0 { 'm' } else { 'l' }, &[point]);
        }
        if line.is_closed {
            writer.close(out);
        }
    }
}

/// Appends the data of splines in relative coordinates.
pub(super) fn write_spline_data(out: &mut String, curve: &Curve) {
    let mut writer = PathWriter::default();
    for spline in &curve.splines {
        writer.write_command(out, 'm', &[spline.start]);
        for (start, segment) in spline.segments_with_starts() {
            match *segment {
                SplineSegment::Line(end) => writer.write_command(out, 'l', &[end]),
                SplineSegment::Cubic([b, c, d]) => match parabola_control([start, b, c, d]) {
                    Some(control) => writer.write_command(out, 'q', &[control, d]),
                    None => writer.write_command(out, 'c', &[b, c, d]),
                },
            }
        }
    }
}

/// The control point of a cubic Bézier curve that is a parabola, so that it can be written as a quadratic one; `None` if
/// it is none.
fn parabola_control([a, b, c, d]: [Point; 4]) -> Option<Point> {
    /// In millimetres: more than the rounding of positions, and far less than that of the numbers written.
    const SAME: f64 = 1e-7;
    let control = |end: Point, control: Point| control + (control - end) * 0.5;
    let (from_start, from_end) = (control(a, b), control(d, c));
    ((from_start - from_end).norm() <= SAME).then_some(from_start)
}

/// The data of a path in absolute coordinates, in which interpolated values are interpolated positions.
pub(super) fn absolute_path_data(path: &Path) -> String {
    let mut out = String::new();
    for line in &path.polylines {
        for (k, point) in line.points.iter().enumerate() {
            let [x, y] = [point.x, point.y].map(|c| Number(to_micrometres(c)));
            let _ = write!(out, "{}{x} {y}", if k == 0 { 'M' } else { 'L' });
        }
        if line.is_closed {
            out.push('Z');
        }
    }
    out
}

/// Writes path data in relative coordinates. Positions are rounded to micrometres before they are subtracted, so that
/// rounding errors do not add up.
#[derive(Default)]
pub(super) struct PathWriter {
    current: [i64; 2],
    start: [i64; 2],
    last_command: Option<char>,
}

impl PathWriter {
    /// Appends a command with its points.
    #[inline]
    pub fn write_command(&mut self, out: &mut String, command: char, points: &[Point]) {
        let from = self.current;
        if self.last_command == Some(command) && command != 'm' || self.last_command == Some('m') && command == 'l' {
            // A repeated command is left out, and so is a line after a move, which is implied.
            self.last_command = Some(command);
            self.write_point(out, from, points[0], true);
        } else {
            // The first move of a path is relative to the origin.
            out.push(command);
            self.last_command = Some(command);
            self.write_point(out, from, points[0], false);
        }
        for &point in &points[1..] {
            self.write_point(out, from, point, true);
        }
        if command == 'm' {
            self.start = self.current;
        }
    }

    #[inline]
    fn write_point(&mut self, out: &mut String, from: [i64; 2], point: Point, is_separated: bool) {
        self.current = [to_micrometres(point.x), to_micrometres(point.y)];
        let (x, y) = (self.current[0] - from[0], self.current[1] - from[1]);
        if is_separated && x >= 0 {
            out.push(' ');
        }
        // Writing to a string cannot fail.
        let _ = Number(x).write_to(out);
        if y >= 0 {
            out.push(' ');
        }
        let _ = Number(y).write_to(out);
    }

    /// Closes the current contour.
    pub fn close(&mut self, out: &mut String) {
        out.push('z');
        self.current = self.start;
        self.last_command = Some('z');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_data_is_relative_without_accumulated_rounding() {
        let mut out = String::new();
        let mut writer = PathWriter::default();
        let at = Point::new;
        for (command, point) in [('m', at(1.0, 2.0)), ('l', at(1.5, 1.0)), ('l', at(1.4, 1.0)), ('m', at(0.0, 0.0))] {
            writer.write_command(&mut out, command, &[point]);
        }
        writer.close(&mut out);
        writer.write_command(&mut out, 'l', &[at(3.0, -1.0)]);
        assert_eq!(out, "m1 2 .5-1-.1 0m-1.4-1zl3-1");
    }
}
