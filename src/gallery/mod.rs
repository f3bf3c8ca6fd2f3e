//! The gallery: `index.html`, a page that shows the atlas without a server, and a script of data for each family.
//!
//! A page opened from disk cannot fetch files, but it can load scripts. The data of a family is therefore a script of
//! statements, written while its cells and pages are produced, so that memory stays bounded. The page itself is joined
//! from the style sheets and scripts in this folder.

mod assets;
mod family_script;
mod index;
mod template_json;
mod typed_array;

pub use assets::{Asset, SCRIPTS, STYLES, join_modules};
pub use family_script::{FamilyScript, SCRIPT_FILE, sampling_json, straight_json};
pub use index::{GalleryFamily, PAGE_FILE, index_html};
pub use template_json::template_json;
