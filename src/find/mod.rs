//! What a search for a linkage reads from files, the path it is to trace, the index of curves and the curves of an atlas; and the search
//! for the dimensions of any linkage on all threads.

mod atlas;
mod index_file;
mod linkage;
mod placed_curve;
mod point_table;
mod svg_outlines;
mod target_file;

pub use atlas::{AtlasAnswer, AtlasOptions, ConditionError, search_atlas};
pub use index_file::{MAX_CURVES, load_index};
pub use linkage::{LinkageAnswer, MAX_SAMPLES, search_linkage};
pub use placed_curve::{PlacedCurve, distinct};
pub use target_file::{MAX_POINTS, Outline, parse_outline};
