//! The record of a run: `points.csv`, `cells.csv`, `run.json`, `images.json`, and the curves drawn in SVG pages.

/// The name of the file that a run locks, so that no other run writes to its folder.
pub const LOCK_FILE_NAME: &str = ".coupler-atlas.lock";

mod cells;
mod digest;
mod drawn_curve;
mod folder;
mod images;
mod journal;
mod png;
mod regular_file;
mod rendered_from;
mod run;
mod table;

pub use cells::{CellTable, read_unassembled_cells};
pub use digest::{Digest, RunningDigest, TextDigests};
pub use drawn_curve::{DrawnCurve, DrawnCurveError, SolvedCurve, read_drawn_curves};
pub use folder::{FolderRecord, ImagesState, images_of_run, read_images};
pub use images::IMAGES_FILE_NAME;
pub use journal::{FamilyProgress, JournalEntry, PageShardHead, PageShardRecord, PartialFile, path_in_atlas};
pub use png::is_intact_png;
pub use regular_file::{FileError, file_digest, open_regular_file, read_regular_file};
pub use rendered_from::{UnknownManifest, check_families, manifest_of};
pub use run::{
    BookRecord, FORMAT_VERSION, FamilyRecord, FileRecord, JOURNAL_FILE_NAME, MAX_RECORDED_FILES, RUN_FILE_NAME,
    ReadError, RunRecord, has_images,
};
pub use table::{RecordedTable, Row, TableError, parse_rows};
