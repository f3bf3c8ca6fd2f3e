//! Four-bars as candidates, in closed form: nine parameters, poses, the index of their curves, and the refinement under limits.

mod curve_length;
pub(crate) mod fitting;
pub(crate) mod index;
pub(crate) mod limits;
pub(crate) mod matching;
pub(crate) mod mechanism;
mod nearest_pose;
pub(crate) mod parameters;
pub(crate) mod pose;
pub(crate) mod refinement;
mod sequence;
pub(crate) mod timing;

pub use index::{Index, IndexPart};
pub use mechanism::{Mechanism, placed_parameters};
