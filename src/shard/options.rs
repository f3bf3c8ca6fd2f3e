//! How a shard is made, and what is reported meanwhile.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::record::ShardRecord;
use super::table_format::TableFormat;
use crate::sweep::Division;

/// How a shard is made.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which cells of each family it has.
    pub division: Division,
    /// The format of its tables.
    pub format: TableFormat,
    /// Whether it has tables of points.
    pub has_points: bool,
    /// Keeps only so many of the best curves of each family of the shard.
    pub top: Option<usize>,
    /// The expression that is least for the best; the family's own `sort` if `None`.
    pub by: Option<String>,
    /// The measures of the tables, by name, in place of the manifest's; those that `where` and the expression of the best use are
    /// among them in any case.
    pub measures: Option<Vec<String>>,
    /// The ids of the families; all if empty.
    pub only: Vec<String>,
    /// Whether to replace files of other sweeps, and to make complete ones again.
    pub force: bool,
    /// Set to true to end the run soon.
    pub interrupt: Arc<AtomicBool>,
}

/// Progress of a run.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// A family is begun.
    Begin {
        /// Its id.
        family: &'a str,
        /// The number of its cells in the shard.
        cells: usize,
    },
    /// Cells are solved; with `top`, the best of them are solved again.
    Cells(usize),
    /// A family is finished.
    End {
        /// The record of its table of cells.
        record: &'a ShardRecord,
        /// The path of that table.
        path: &'a Path,
        /// Whether its files were there already.
        is_kept: bool,
    },
}
