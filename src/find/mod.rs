//! What a search for a linkage reads from files: the path it is to trace, and the index of curves.

mod index_file;
mod svg_outlines;
mod target_file;

pub use index_file::{MAX_CURVES, load_index};
pub use target_file::{MAX_POINTS, Outline, parse_outline};
