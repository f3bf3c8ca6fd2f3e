//! The gallery: `index.html`, one page that browses the atlas from disk, and a script of data for each family.
//!
//! Nothing can be fetched by a page that is opened from disk, but scripts can be loaded: a family's data is a script of
//! statements, written as its cells and pages come, so that memory stays flat. The page itself is joined from the small
//! files beside this one.

mod data;
mod index;
mod packed;
mod parts;
mod template;

pub use data::{SCRIPT, Statements, sampling, straight};
pub use index::{PAGE, Shown, index};
pub use parts::{Part, SCRIPTS, STYLES, joined};
pub use template::template;
