//! Measures of a curve; each is a column of `cells.csv` and a name in `where`.

mod asymmetry;
mod axis_motion;
mod budget;
pub(crate) mod circuit_function;
mod class;
mod column;
pub(crate) mod curve;
mod definition;
mod dwell;
mod features;
mod four_bar_type;
mod input_range;
mod measure_set;
mod measures;
mod moves;
mod output;
mod path;
mod portion;
mod rounding;
mod shape;
mod six_bar;
mod speed_ratio;
mod straight;
mod subject;
mod symmetry;
mod symmetry_axis;
mod torque;
mod traced_curve;
mod transmission;
mod word_comparison;

pub use definition::{Measure, MeasureKey, Value};
pub use features::{Dwell, StraightCriterion, StraightPortion, Symmetry, SymmetryAxis};
pub use measure_set::MeasureSet;
pub use measures::{ALL, compute_all};
pub use subject::Subject;
pub use traced_curve::TracedCurve;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    column::{COLUMNS, Column, compute_columns, find_column},
    definition::MeasureValue,
    features::CurveMoves,
    measures::{BOOLEANS, Boolean},
    output::output_limit_poses,
    path::cumulative_lengths,
    torque::input_torque,
    transmission::transmission_angle,
    word_comparison::parse_condition,
};

use rounding::without_rounding;
use traced_curve::start_input;
