//! Given curves: looked up by their shapes, and placed on a target.

pub(crate) mod alignment;
pub(crate) mod fit;
pub(crate) mod index;
pub(crate) mod path;

pub use fit::{CurveFit, CurveFitter};
pub use index::{CurveIndex, CurveLookup, CurveShape};
