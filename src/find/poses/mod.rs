//! Linkages that guide a body through poses: the poses in a file, the search on all threads, and what pages show of them.

mod body;
mod drawing;
mod file;
mod record;
mod request;
mod search;

pub use body::{guided_body, passing};
pub use drawing::draw_poses;
pub use file::{PoseReading, read_poses};
pub use record::{PoseFindingsRecord, PoseRecord};
pub use request::{PoseRequest, check_given_pivots};
pub use search::{FoundPoses, Relaxed, find_poses};
