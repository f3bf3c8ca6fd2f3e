//! What is recorded of a run: `points.csv`, `cells.csv` and `run.json`.

mod cells;
mod number;
mod points;
mod run;
mod table;

pub use cells::{Cells, shortfalls};
pub use number::shortest;
pub use points::Points;
pub use table::{Flaw, Row, Table, rows};
pub use run::{BookRecord, FORMAT, FamilyRecord, FileRecord, ReadError, Run, RunningDigest};
