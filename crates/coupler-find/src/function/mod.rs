//! Function generation: the linkages whose output is a wanted function of their input.
//!
//! A [`FunctionTarget`] has rows of inputs and outputs, or a [`Law`]. The linkages that are exact at three to five precision points are solved for
//! in closed form, all of them, and those that do not pass the points in one motion are left out; where starts are left open the best are searched
//! over their whole range. Over many points the error of the output is made least, in mean square by Levenberg and Marquardt's method, or its greatest
//! magnitude by sums of high powers and Remez's exchange.

mod elimination;
mod generator;
mod precision;

mod law;
mod target;

mod defect;
mod structural_error;

mod exchange;
mod fit;

mod options;

mod candidates;

mod problem;

mod open_starts;

mod by_fit;
mod by_points;

mod answer;
mod search;

pub use answer::{FunctionAnswer, OutputFunction};
pub use defect::Defect;
pub use generator::GeneratorKind;
pub use law::{Law, LawError};
pub use options::{FunctionMethod, FunctionOptions, LeftOut};
pub use search::{FunctionFindings, generate_function};
pub use structural_error::StructuralError;
pub use target::{FunctionTarget, FunctionTargetError};
