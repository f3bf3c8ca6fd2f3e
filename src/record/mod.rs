//! What is recorded of a run: `points.csv`, `cells.csv` and `run.json`.

/// The name of the file by which a run keeps others from writing to its folder.
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
