//! What a search for a linkage reads from files: the path it is to trace, the index of curves, and the curves of an atlas.

mod atlas;
mod index_file;
mod svg_outlines;
mod target_file;

pub use atlas::{AtlasAnswer, AtlasOptions, ConditionError, are_same, scaled_values, search_atlas};
pub use index_file::{MAX_CURVES, load_index};
pub use target_file::{MAX_POINTS, Outline, parse_outline};
