//! Some of the points of a row, with which portions are compared roughly.

use crate::geometry::Point;

/// Every nth point of a row.
#[derive(Clone, Debug)]
pub struct EveryNth {
    pub points: Vec<Point>,
    /// The length of the curve up to each.
    pub lengths: Vec<f64>,
    /// The travel of the input up to each.
    pub travel: Vec<f64>,
    /// The number of points at which a portion may begin.
    pub start_count: usize,
    pub is_closed: bool,
    /// Their positions in the row.
    pub positions: Vec<usize>,
    pub stride: usize,
}

impl EveryNth {
    /// The last point at which a portion that begins at a point may end.
    pub fn last_end(&self, from: usize) -> usize {
        if self.is_closed { from + self.start_count - 1 } else { self.points.len() - 1 }
    }

    /// What of a quantity that grows along the curve, given at each point, is between the point before another and it.
    pub fn step_before(&self, quantity: &[f64], from: usize) -> f64 {
        match from {
            0 if self.is_closed => quantity[self.start_count] - quantity[self.start_count - 1],
            0 => 0.0,
            _ => quantity[from] - quantity[from - 1],
        }
    }

    /// A quantity, given at each point, at the point after another, or at the last.
    pub fn at_next(&self, quantity: &[f64], to: usize) -> f64 {
        quantity[(to + 1).min(quantity.len() - 1)]
    }

    /// The first point not before another after which a quantity that grows along the curve reaches a value; one more
    /// than `last` if none does.
    pub fn first_reaching(&self, quantity: &[f64], value: f64, after: usize, last: usize) -> usize {
        // Most often the quantity grows evenly.
        let mean = (quantity[quantity.len() - 1] - quantity[0]) / (quantity.len() - 1) as f64;
        let steps = ((value - self.at_next(quantity, after)) / mean).max(0.0);
        let mut to = after.saturating_add(steps as usize).min(last + 1);
        while to > after && self.at_next(quantity, to - 1) >= value {
            to -= 1;
        }
        while to <= last && self.at_next(quantity, to) < value {
            to += 1;
        }
        to
    }

    /// Marks the starts between two positions of the row, with those next to them.
    pub fn cover(&self, is_covered: &mut [bool], [a, b]: [f64; 2]) {
        let count = self.start_count as f64;
        let index = |position: f64| position * count / self.positions[self.start_count] as f64;
        let (first, last) = (index(a.min(b)).floor() as i64, index(a.max(b)).ceil() as i64);
        for k in first..=last.min(first + self.start_count as i64) {
            if let Some(covered) = is_covered.get_mut(k.rem_euclid(self.start_count as i64) as usize) {
                *covered = true;
            }
        }
    }
}
