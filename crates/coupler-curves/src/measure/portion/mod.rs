//! Straight and circular portions of a curve: which are the longest, or the narrowest.
//!
//! From the points to the portions: rows of points along a curve ([`row`], [`every_nth`]); the strip and the annulus of any points
//! ([`strip`], [`annulus`], by the exchange of [`remez`]), and of the curve between any two positions, where it touches them
//! ([`touching`], [`curve_strip`], [`curve_ring`]); the longest portion near one ([`longest_near`]), and of all ([`longest`]), straight
//! to a tolerance ([`longest_straight`], [`strokes`]) or circular ([`circular`]), and the narrowest of a given length or input
//! ([`straightest`]).

mod annulus;
mod circular;
mod contact;
mod curve_ring;
mod curve_strip;
mod every_nth;
mod longest;
mod longest_near;
mod longest_straight;
mod remez;
mod row;
mod straightest;
mod strip;
mod strokes;
mod touching;

pub use circular::{CircularPortion, longest_circular};
pub use curve_strip::{CurveStrips, PortionStrip};
pub use longest::{EXACT, INTERVALS, LEAST_SHARE, SPACING};
pub use longest_straight::longest_straight;
pub use row::Row;
pub use straightest::{Narrowest, straightest};
pub use strip::{convex_hull, min_max};
