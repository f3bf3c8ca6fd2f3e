//! The record of a run: `points.csv`, `cells.csv`, `run.json`, and the curves drawn in SVG pages.

/// The name of the file that a run locks, so that no other run writes to its folder.
pub const LOCK_FILE_NAME: &str = ".coupler-atlas.lock";

mod cells;
mod drawn_curve;
mod png;
mod run;
mod table;

pub use cells::{CellTable, read_unassembled_cells};
pub use drawn_curve::{DrawnCurve, DrawnCurveError, read_drawn_curves};
pub use png::is_intact_png;
pub use run::{BookRecord, FORMAT_VERSION, FamilyRecord, FileRecord, ReadError, RunRecord, RunningDigest, TextDigests};
pub use table::{RecordedTable, Row, TableError, open_regular_file, parse_rows};
