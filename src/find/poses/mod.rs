//! Linkages that guide a body through poses: the poses in a file, the search on all threads, and its drawing.

mod drawing;
mod file;
mod search;

pub use drawing::draw_poses;
pub use file::{PoseReading, read_poses};
pub use search::{FoundPoses, Relaxed, find_poses};
