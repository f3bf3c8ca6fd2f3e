//! What is asked of linkages that generate a function, and why some are no answers.

use super::defect::Defect;
use super::generator::GeneratorKind;
use crate::condition::Condition;

/// How a linkage is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionMethod {
    /// The output is exact at so many precision points, 3 to 5.
    Points(usize),
    /// The mean square of the error is least.
    LeastSquares,
    /// The greatest error is least.
    Minimax,
}

/// What is asked of linkages that generate a function.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionOptions {
    /// Which linkage.
    pub kind: GeneratorKind,
    /// How it is found.
    pub method: FunctionMethod,
    /// The input at the start in degrees, if it is given. The crank may point the opposite way, as links of negative length do.
    pub input_start_deg: Option<f64>,
    /// The output at the start in degrees or as a length, if it is given; likewise for the rocker.
    pub output_start: Option<f64>,
    /// Whether the crank must turn fully.
    pub full_turn: bool,
    /// The greatest ratio of the longest link to the shortest; may be infinite.
    pub max_ratio: f64,
    /// A condition over the parameters of [`GeneratorKind::template`] and the measures, over the range of the input.
    pub condition: Option<Condition>,
    /// The most answers.
    pub most: usize,
}

/// Why a linkage that has been found is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeftOut {
    /// It does not pass its precision points in one motion.
    Defect(Defect),
    /// A link would have an imaginary length.
    Imaginary,
    /// A link would have an infinite length.
    Infinite,
    /// Its links differ too much in length.
    MaxRatio,
    /// Its crank does not turn fully.
    FullTurn,
    /// It does not meet the condition.
    Condition,
}
