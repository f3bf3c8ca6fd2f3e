//! The gallery: `index.html`, one page that browses the atlas from disk, and a script of data for each family.
//!
//! Nothing can be fetched by a page that is opened from disk, but scripts can be loaded: a family's data is a script of
//! statements, written as its cells and pages come, so that memory stays flat. The page itself is joined from the small
//! files beside this one.

mod assets;
mod family_script;
mod index;
mod template_json;
mod typed_array;

pub use assets::{Asset, SCRIPTS, STYLES, join_modules};
pub use family_script::{FamilyScript, SCRIPT_FILE, sampling_json, straight_json};
pub use index::{GalleryFamily, PAGE_FILE, index_html};
pub use template_json::template_json;
