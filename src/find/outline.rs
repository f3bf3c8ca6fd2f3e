//! A path that has been read from a file.

use coupler_curves::find::PathKind;
use coupler_curves::geometry::Point;

/// A path.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its points, with y pointing up.
    pub points: Vec<Point>,
    /// The angle of the crank at each point in degrees, where the file has them and they are asked for.
    pub angles_deg: Option<Vec<f64>>,
    /// Whether it is closed, where the file says so.
    pub is_closed: Option<bool>,
}

impl Outline {
    /// Whether the gap from its last point to its first is at most one and a half times the median distance of neighbours.
    pub fn looks_closed(&self) -> bool {
        const GAP: f64 = 1.5;
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else { return false };
        let mut steps: Vec<f64> = self.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        steps.sort_by(f64::total_cmp);
        let median = match steps.len() {
            0 => 0.0,
            count if count % 2 == 1 => steps[count / 2],
            count => 0.5 * (steps[count / 2 - 1] + steps[count / 2]),
        };
        (last - first).norm() <= GAP * median
    }

    /// Takes the angles of the crank at its points, in degrees: its own or, if it has none and is closed, those of equal steps of a turn; `None`
    /// if it is open and has none. A closing point that repeats the first is then left out.
    pub fn take_timing(&mut self, kind: PathKind) -> Option<Vec<f64>> {
        if self.angles_deg.is_none() && kind == PathKind::Closed {
            while self.points.len() > 1 && self.points.first() == self.points.last() {
                self.points.pop();
            }
            let count = self.points.len();
            self.angles_deg = Some((0..count).map(|k| 360.0 * k as f64 / count as f64).collect());
        }
        self.angles_deg.take()
    }
}

/// The most problems of a file that are listed.
pub(super) const MAX_PROBLEMS: usize = 20;

/// The first problems, and the number of the others.
pub(super) fn limited(mut problems: Vec<String>, what: &str) -> Vec<String> {
    if problems.len() > MAX_PROBLEMS {
        let more = problems.len() - MAX_PROBLEMS;
        problems.truncate(MAX_PROBLEMS);
        problems.push(format!("and {more} further {what} that cannot be read"));
    }
    problems
}
