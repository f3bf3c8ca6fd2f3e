//! Points, vectors, transforms and bounds in the plane, and deterministic trigonometry.
//!
//! Axes are right-handed, counter-clockwise is positive, y points up. Angles are in radians unless a name ends in
//! `_deg`. Trigonometry and powers go through the `libm` crate, so that a manifest gives the same bits on every
//! machine; `+ - * / sqrt` are exact everywhere by IEEE 754.

mod bounds;
mod capsule_tree;
mod chebyshev;
mod order;
mod orientation;
mod polyline;
mod similarity;
mod spline;
#[doc(hidden)]
pub mod trig;
mod vectors;

pub use bounds::Bounds;
pub use orientation::Orientation;
pub use similarity::Similarity;
pub use spline::{CubicBezier, Spline, SplineSegment};

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    capsule_tree::{Capsule, CapsuleTree},
    chebyshev::{Chebyshev, TERMS, Zeros},
    order::{in_rising_order, rising_order},
    polyline::simplify_polyline,
    similarity::Complex,
    vectors::{complex_product, cross, curvature, distance_to_segment, left_normal},
};

/// A point of the plane.
pub type Point = nalgebra::Point2<f64>;

/// A vector of the plane.
pub type Vector = nalgebra::Vector2<f64>;
