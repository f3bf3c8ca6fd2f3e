//! The dimensions of any linkage with an output link for which its output is a wanted function of its input.

mod answer;
mod fitting;
mod followed;
mod search;
mod track;

pub use answer::LinkageFunctionAnswer;
pub use followed::FollowedOutput;
pub use search::{LinkageFunctionError, LinkageFunctionOptions, generate_function_by, most_precision_points};
