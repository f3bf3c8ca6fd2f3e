//! Precision points, and what objections there are to linkages that are exact at them.

use super::defect::defect;
use super::generator::Generator;
use super::options::{FunctionOptions, LeftOut};
use super::precision::GivenStarts;
use super::target::FunctionTarget;

/// Precision points with the starts that are given.
pub(super) struct Problem<'a> {
    pub target: &'a FunctionTarget,
    pub options: &'a FunctionOptions,
    /// The travels of input and output from the start.
    pub points: Vec<[f64; 2]>,
    pub starts: GivenStarts,
    /// The travels of input and output of the whole function.
    pub samples: Vec<[f64; 2]>,
}

impl Problem<'_> {
    /// Why a linkage is no answer, but for conditions.
    pub fn objection(&self, linkage: &Generator) -> Option<LeftOut> {
        let range = [0.0, self.target.travel()];
        if let Some(defect) = defect(linkage, &self.points, range, self.target.size()) {
            return Some(LeftOut::Defect(defect));
        }
        if linkage.ratio() > self.options.max_ratio {
            return Some(LeftOut::MaxRatio);
        }
        (self.options.full_turn && !linkage.is_full_turn()).then_some(LeftOut::FullTurn)
    }

    /// The worst transmission angle over the range, in radians.
    pub fn transmission(&self, linkage: &Generator) -> f64 {
        let start = linkage.starts[0];
        linkage.worst_transmission(start, start + self.target.travel())
    }

    /// What is to be least: the greatest error of a law at its samples, and of rows, which are all exact, what the transmission angle lacks.
    pub fn cost(&self, linkage: &Generator) -> f64 {
        if self.target.as_law().is_none() {
            return -self.transmission(linkage);
        }
        let [input, output] = linkage.starts;
        let turns = linkage.turns_at(self.points[0]).unwrap_or(f64::NAN) - output;
        let error =
            |[x, y]: &[f64; 2]| linkage.output(input + x).map_or(f64::INFINITY, |there| (there + turns - y).abs());
        self.samples.iter().map(error).fold(0.0, f64::max)
    }
}
