//! The search for four-bars: from the curves of an index to answers, the nearest first, or the nearest miss.

mod four_bars;
mod lookup;
mod ranking;
mod relaxation;

pub use four_bars::Search;
pub use ranking::Ranking;
pub use relaxation::{Constraint, nearest_miss, nearest_miss_by};
