//! The dimensions of any linkage for which its curve is nearest to a target.
//!
//! A [`LinkageSpace`] says which parameters vary and samples them. The shapes of the curves of many samples are looked up as
//! those of given curves are; those most like the target are placed on it and refined by Levenberg and Marquardt's method on
//! the free parameters and the similarity, with the distances across the curve, as four-bars are. The curves of changed parameters
//! are compared at equal positions along their circuits, a coordinate in which they are regular at limits of the input;
//! derivatives are differences of solved curves. Of a circuit, its passes are kept in each step.

mod aim;
mod answer;
mod circuit;
mod feet;
mod fitting;
mod function;
mod index;
mod measured;
mod placed_curve;
mod poses;
mod ranking;
mod refinement;
mod refinements;
mod restarts;
mod sampled_space;
mod samples;
mod scaling;
mod search;
mod six_bars;
mod space;
mod state;
mod timed;

pub use answer::LinkageAnswer;
pub use function::{
    FollowedOutput, LinkageFunctionAnswer, LinkageFunctionError, LinkageFunctionOptions, generate_function_by,
    most_precision_points,
};
pub use index::{LinkageIndex, LinkageIndexPart, LinkageSampler};
pub use placed_curve::PlacedCurve;
pub use ranking::{JAM_DEG, ranked};
pub use scaling::{is_scalable, scaled_values};
pub use search::{LinkageSearch, Searched};
pub use six_bars::{simpler_spaces, six_bar_spaces};
pub use space::{LinkageSpace, LinkageSpaceError};

pub(crate) use aim::longest_link;
pub(crate) use space::VariationUnit;
