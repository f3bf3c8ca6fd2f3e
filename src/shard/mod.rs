//! Shards: tables of a part of the cells of a manifest, without pages, so that many machines can share an atlas; and the best
//! curves of all shards.
//!
//! A shard depends on nothing but the manifest and its number, so that any machine may make it, also twice: the files have the
//! same bytes. [`write_shard`] makes one, [`gather`] checks that they are complete and finds the best curves.

mod best;
mod best_manifest;
mod columns;
mod expression;
mod folder;
mod gather;
mod parquet_table;
mod problem;
mod read;
mod record;
mod stream;
mod swept;
mod table;
mod write;

pub use best_manifest::{best_manifest, is_best_manifest};
pub use columns::{ColumnKind, ColumnRows, Rows, TableColumn, Values, Word};
pub use folder::has_tables;
pub use gather::{BestCurve, FamilyTotals, GatherOptions, Gathered, gather};
pub use record::{Counts, FORMAT, ShardRecord, TableKind, Top};
pub use stream::TableStream;
pub use write::{Event, Options, write_shard};

pub use crate::sweep::{Division, MAX_SHARDS};

use std::path::PathBuf;

use crate::output;

/// The format of the tables of a shard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum TableFormat {
    /// Parquet, with typed columns.
    #[default]
    Parquet,
    /// Comma-separated values, as `cells.csv` and `points.csv` have them, with a record beside each.
    Csv,
}

impl TableFormat {
    /// Every format.
    pub const ALL: [TableFormat; 2] = [TableFormat::Parquet, TableFormat::Csv];

    /// Its name, and the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            TableFormat::Parquet => "parquet",
            TableFormat::Csv => "csv",
        }
    }
}

/// The greatest number of curves that the best may be.
pub const MAX_TOP: usize = 1_000_000;

/// An error of making or gathering shards.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read or written.
    #[error(transparent)]
    Output(#[from] output::Error),
    /// The run was interrupted.
    #[error("interrupted: shards that are complete are kept, and the next run makes this one again")]
    Interrupted,
    /// Tables are to be written into what is no folder.
    #[error("{} is not a folder: name another with -o", .0.display())]
    NotAFolder(PathBuf),
    /// The expression that orders curves cannot be used.
    #[error("--by: `{text}`: {message}")]
    Expression {
        /// The expression.
        text: String,
        /// Why.
        message: String,
    },
    /// A file of another sweep has the name of one to be written.
    #[error("{} is not to be replaced: {reason}; write to another folder with -o, or replace it with --force", path.display())]
    OtherShard {
        /// The file.
        path: PathBuf,
        /// What it is, as a clause.
        reason: String,
    },
    /// The shards cannot be gathered.
    #[error("{}", .0.join("\n"))]
    Problems(Vec<String>),
}
