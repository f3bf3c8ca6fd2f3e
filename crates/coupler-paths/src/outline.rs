//! A path that has been read from a file.

use coupler_curves::geometry::Point;
use coupler_find::PathKind;

use crate::closing::Gap;

/// A path.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its points, with y pointing up.
    pub points: Vec<Point>,
    /// The angle of the crank at each point in degrees, where the file has them and they are asked for.
    pub angles_deg: Option<Vec<f64>>,
    /// Whether it is closed, where the file says so.
    pub is_closed: Option<bool>,
    /// What of the file was taken.
    pub reading: Reading,
}

/// What of a file was taken for a path, and what was not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// What was taken, as a clause: which columns, or which outline of how many, in what unit; empty if there is nothing to say.
    pub taken: String,
    /// Whether it has angles, which are not taken because they are not asked for.
    pub has_unused_angles: bool,
}

impl Reading {
    /// All of what it has was taken.
    pub fn of(taken: String) -> Reading {
        Reading { taken, has_unused_angles: false }
    }
}

/// What is to be read of a file.
#[derive(Clone, Copy, Debug)]
pub struct ReadOptions<'a> {
    /// Whether the angles of the crank are read.
    pub is_timed: bool,
    /// The outline to take of several: its id, or its number from 1.
    pub outline: Option<&'a str>,
    /// What is written before it, as messages have it.
    pub outline_option: &'a str,
    /// What the angles are of, as messages have it: `crank` or `body`.
    pub angles_of: &'a str,
}

/// As the command without options reads.
impl Default for ReadOptions<'_> {
    fn default() -> Self {
        ReadOptions { is_timed: false, outline: None, outline_option: "--outline ", angles_of: "crank" }
    }
}

impl Outline {
    /// A path of which there is nothing to say.
    pub fn new(points: Vec<Point>, angles_deg: Option<Vec<f64>>, is_closed: Option<bool>) -> Outline {
        Outline { points, angles_deg, is_closed, reading: Reading::default() }
    }

    /// Whether it is closed: as the file says or, if it does not, if the gap from its last point to its first is like the steps beside it. Adds to
    /// what was taken why, where the file does not say it.
    pub fn decide_closed(&mut self) -> bool {
        if let Some(is_closed) = self.is_closed {
            return is_closed;
        }
        let gap = Gap::of(&self.points);
        let is_closed = gap.is_some_and(Gap::is_step);
        if !self.reading.taken.is_empty() {
            self.reading.taken +=
                if is_closed { "; closed, for its ends are near" } else { "; open, for its ends are apart" };
            if gap.is_some_and(|gap| !gap.is_certain()) {
                self.reading.taken += if is_closed {
                    ", which is not certain: it may be open"
                } else {
                    ", which is not certain: it may be closed and lack the last step"
                };
            }
        }
        is_closed
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
pub(crate) const MAX_PROBLEMS: usize = 20;

/// The first problems, and the number of the others.
pub(crate) fn limited(mut problems: Vec<String>, what: &str) -> Vec<String> {
    if problems.len() > MAX_PROBLEMS {
        let more = problems.len() - MAX_PROBLEMS;
        problems.truncate(MAX_PROBLEMS);
        problems.push(format!("and {more} further {what} that cannot be read"));
    }
    problems
}

/// The index of what is chosen: that with its id, or with its number from 1; `option` is written before it, and `what` is what it chooses from.
///
/// # Errors
/// There is none, or its id is that of several.
pub(crate) fn choose([option, chosen]: [&str; 2], ids: &[Option<&str>], what: &str) -> Result<usize, String> {
    let with_id: Vec<usize> = (0..ids.len()).filter(|k| ids[*k] == Some(chosen)).collect();
    let number = chosen.parse::<usize>().ok().filter(|number| (1..=ids.len()).contains(number));
    match (&with_id[..], number) {
        ([only], _) => Ok(*only),
        ([], Some(number)) => Ok(number - 1),
        ([], None) => {
            const SHOWN: usize = 8;
            let names: Vec<&str> = ids.iter().filter_map(|id| *id).take(SHOWN).collect();
            let names = if names.is_empty() { String::new() } else { format!(", or {}", names.join(", ")) };
            Err(format!("{option}{chosen}: there is no such {what}: give a number from 1 to {}{names}", ids.len()))
        }
        (several, _) => {
            Err(format!("{option}{chosen}: {} have this name: give a number from 1 to {}", several.len(), ids.len()))
        }
    }
}
