//! The gallery: `index.html`, a page that shows the atlas without a server, a script of data for each family, and
//! `kernel.js`, which computes with the linkages.
//!
//! A page opened from disk cannot fetch files, but it can load scripts. The data of a family are therefore scripts of
//! statements, in pieces of bounded size that the page loads when a view shows what is in them. They are written while
//! cells and pages are produced, so that memory stays bounded. So is the kernel, a module for WebAssembly, a script that
//! the page loads when it needs it. The page itself is joined from the style sheets and scripts in this folder.

mod assets;
mod family_script;
mod index;
mod kernel_script;
mod piece;
mod pieces;
mod typed_array;

pub use assets::{Asset, join_modules, scripts, styles};
pub use family_script::{FamilyScript, SCRIPT_FILE};
pub use index::{DataBytes, GalleryFamily, PAGE_FILE, index_html, plate_html};
pub use kernel_script::{KERNEL, KERNEL_FILE, kernel_script};
pub use piece::{CellData, PieceContent, PieceIndex, PieceSeries};
pub use pieces::{
    DataFile, MAX_PIECE_BYTES, MAX_SINGLE_FILE_BYTES, OpenPiece, PieceWriter, is_data_file_name, parse_piece_file_name,
    piece_file_name,
};
