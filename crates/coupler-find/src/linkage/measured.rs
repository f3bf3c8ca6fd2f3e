//! The length of a curve.

use super::circuit::Traced;
use crate::complex::{closed_length, length};

/// The points of a curve of which the length is computed.
const POINTS: usize = 720;

/// The lengths of a curve along it.
pub(super) struct Measured {
    /// The positions of samples, and the length up to each; the last is the end of the round.
    positions: Vec<f64>,
    lengths: Vec<f64>,
}

impl Measured {
    pub fn new(traced: &Traced) -> Option<Measured> {
        let mut positions = traced.positions(POINTS);
        let points = traced.points(&positions)?;
        let mut lengths = vec![0.0];
        for k in 1..points.len() {
            lengths.push(lengths[k - 1] + length(points[k] - points[k - 1]));
        }
        lengths.push(closed_length(&points));
        positions.push(traced.period());
        Some(Measured { positions, lengths })
    }

    pub fn whole(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    pub fn length_at(&self, position: f64) -> f64 {
        let period = self.positions[self.positions.len() - 1];
        let round = (position / period).floor();
        let within = position - round * period;
        let k = self.positions.partition_point(|at| *at <= within).clamp(1, self.positions.len() - 1);
        let part = (within - self.positions[k - 1]) / (self.positions[k] - self.positions[k - 1]);
        round * self.whole() + self.lengths[k - 1] + part * (self.lengths[k] - self.lengths[k - 1])
    }
}
