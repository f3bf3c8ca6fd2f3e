//! Atlases of coupler curves.

pub mod expression;
pub mod geometry;
pub mod linkage;
pub mod motion;
pub mod problem;
