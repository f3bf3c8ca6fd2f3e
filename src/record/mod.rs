//! What is recorded of a run: `points.csv`, `cells.csv` and `run.json`.

/// The name of the file by which a run keeps others from writing to its folder.
pub const LOCK: &str = ".coupler-atlas.lock";

mod cells;
mod drawn;
mod png;
mod run;
mod table;

pub use cells::{Cells, shortfalls};
pub use drawn::{DrawnCurve, DrawnError, drawn_curves};
pub use png::is_whole_png;
pub use run::{BookRecord, FORMAT, FamilyRecord, FileRecord, LineDigests, ReadError, Run, RunningDigest};
pub use table::{Flaw, Row, Table, open_plain, rows};
