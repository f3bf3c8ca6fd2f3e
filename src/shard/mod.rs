//! Shards: tables of a part of the cells of a manifest, without pages, so that many machines can share an atlas; and the best
//! curves of all shards.
//!
//! A shard depends on nothing but the manifest and its number, so that any machine may make it, also twice: the files have the
//! same bytes. [`write_shard`] makes one, [`gather`] checks that they are complete and finds the best curves.

mod best;
mod best_manifest;
mod columns;
mod direction;
mod error;
mod expression;
mod folder;
mod gather;
mod options;
mod parquet_column;
mod parquet_table;
mod problem;
mod read;
mod record;
mod stream;
mod swept;
mod table;
mod table_format;
mod write;

pub use best_manifest::{best_manifest, is_best_manifest};
pub use columns::{ColumnKind, ColumnRows, Rows, TableColumn, Values, Word};
pub use error::Error;
pub use folder::has_tables;
pub use gather::{BestCurve, FamilyTotals, GatherOptions, Gathered, best_of_table, gather};
pub use options::{Event, Options};
pub(crate) use parquet_table::into_io;
pub use record::{Counts, FORMAT, MAX_TOP, ShardRecord, TableKind, Top};
pub use stream::TableStream;
pub use table_format::TableFormat;
pub use write::write_shard;

pub use crate::sweep::{Division, MAX_SHARDS};
