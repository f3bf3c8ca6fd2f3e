//! The gallery: `index.html`, a page that shows the atlas without a server, and a script of data for each family.
//!
//! A page opened from disk cannot fetch files, but it can load scripts. The data of a family are therefore scripts of
//! statements, in pieces of bounded size that the page loads when a view shows what is in them. They are written while
//! cells and pages are produced, so that memory stays bounded. The page itself is joined from the style sheets and
//! scripts in this folder, and has a module for WebAssembly, the kernel, which computes with the linkages.

mod assets;
mod base91;
mod family_script;
mod index;
mod piece;
mod pieces;
mod typed_array;

pub use assets::{Asset, KERNEL, join_modules, scripts, styles};
pub use base91::encode_base91;
pub use family_script::{FamilyScript, SCRIPT_FILE};
pub use index::{DataBytes, GalleryFamily, PAGE_FILE, index_html};
pub use piece::{CellData, PieceContent, PieceIndex, PieceSeries};
pub use pieces::{
    DataFile, MAX_PIECE_BYTES, MAX_SINGLE_FILE_BYTES, OpenPiece, PieceWriter, is_data_file_name, parse_piece_file_name,
    piece_file_name,
};
