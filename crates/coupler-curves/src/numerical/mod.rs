//! Numerical tools: where a function changes its sign or a condition ceases to hold, and where a function is greatest.
//!
//! | tool | accuracy | evaluations |
//! |---|---|---|
//! | [`Bracket::zero`] of a function that changes its sign | as asked, to four units in the last place | about nine if it is smooth, three for each halving at most |
//! | [`border`] of a condition that holds on one side | as asked, to neighbouring numbers | one for each halving |
//! | [`maximum()`], [`maximum_with_ends`] of a function that rises, then falls | as asked; of a smooth one to the root of its rounding | one for each part of 0.618 |
//! | [`real_roots`] of a polynomial | to its last digits; a double root to the root of its rounding | those of its zeros and of all derivatives' |
//! | [`partition_point`] of indices, from a guess | exact | two for each doubling of the distance from the guess |
//!
//! [`equal_parts`] divides a row of segments, as those of a polyline, into parts of equal length.
//!
//! They end for any function, and none panics: what they return where a function is not as stated is stated with each.

mod division;
mod index;
mod maximum;
mod polynomial;
mod root;

pub use division::{SegmentPlace, equal_parts};
pub use index::partition_point;
pub use maximum::{Maximum, maximum, maximum_with_ends};
pub use polynomial::real_roots;
pub use root::{Bracket, border};
