//! Files of tables: written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use coupler_curves::exchange::PointTable;
use coupler_curves::family::Family;
use coupler_curves::solve::SolvedCell;

use super::columns::{Rows, TableColumn, cell_columns, point_columns};
use super::parquet_table::ParquetTable;
use super::record::{ShardRecord, TableKind};
use super::{Division, TableFormat};
use crate::output::{self, AtomicFile};
use crate::record::{CellTable, Digest, RunningDigest};

/// The number of rows of a row group of a table, so that one takes some tens of megabytes in memory.
fn group_rows(table: TableKind) -> usize {
    match table {
        TableKind::Cells => 1 << 16,
        TableKind::Points => 1 << 18,
    }
}

/// The beginning and the end of the names of unfinished files of a shard.
pub(super) fn temporary_affixes(label: &str) -> (String, &'static str) {
    (format!(".coupler-atlas-{label}-"), ".shard")
}

/// The path of a table of a shard.
pub(super) fn table_path(
    folder: &Path,
    table: TableKind,
    (division, cell_count): (Division, usize),
    format: TableFormat,
) -> PathBuf {
    folder.join(format!("{}-{}.{}", table.name(), division.label(cell_count), format.name()))
}

/// The path of the record beside a table that is text.
pub(super) fn record_path(table: &Path) -> PathBuf {
    table.with_extension("json")
}

/// Removes a table, and the record beside it, if there are.
///
/// # Errors
/// The file cannot be removed.
pub(super) fn remove(path: &Path) -> Result<(), output::Error> {
    let is_text = path.extension().is_some_and(|extension| extension == TableFormat::Csv.name());
    for path in [Some(path.to_owned()), is_text.then(|| record_path(path))].into_iter().flatten() {
        match fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => {
                return Err(output::Error::Write { path, source });
            }
            _ => {}
        }
    }
    Ok(())
}

/// Rows of a table in the form in which they are written.
pub(super) enum Chunk {
    /// For a Parquet file.
    Rows(Rows),
    /// For a CSV file, and their number.
    Text(Vec<u8>, usize),
}

/// Makes the rows of a table.
#[derive(Clone, Copy)]
pub(super) struct RowMaker<'a> {
    pub family: &'a Family,
    pub table: TableKind,
    pub format: TableFormat,
    pub columns: &'a [TableColumn],
}

impl RowMaker<'_> {
    /// The rows of some cells.
    pub fn rows(self, cells: &[SolvedCell]) -> Chunk {
        match self.format {
            TableFormat::Parquet => {
                let mut rows = Rows::new(self.columns);
                for solved in cells {
                    match self.table {
                        TableKind::Cells => rows.append_cell(self.family, solved),
                        TableKind::Points => rows.append_points(self.family, solved),
                    }
                }
                Chunk::Rows(rows)
            }
            TableFormat::Csv => {
                let mut text = Vec::new();
                let (cell_table, point_table) = (CellTable::new(self.family), PointTable::new(self.family));
                for solved in cells {
                    match self.table {
                        TableKind::Cells => cell_table.append_rows(solved, &mut text),
                        TableKind::Points => point_table.append_rows(solved, &mut text),
                    }
                }
                let rows = cells.iter().map(|solved| row_count(solved, self.table)).sum();
                Chunk::Text(text, rows)
            }
        }
    }
}

/// The columns of a table.
pub(super) fn columns(family: &Family, table: TableKind) -> Vec<TableColumn> {
    match table {
        TableKind::Cells => cell_columns(family),
        TableKind::Points => point_columns(family),
    }
}

/// The number of rows of a cell.
fn row_count(solved: &SolvedCell, table: TableKind) -> usize {
    match table {
        TableKind::Cells if solved.is_left_out() => 0,
        TableKind::Cells => solved.curves.len().max(1),
        TableKind::Points => solved.curves.iter().map(|curve| solved.circuit(curve).len()).sum(),
    }
}

/// A table that is being written.
pub(super) struct TableWriter {
    path: PathBuf,
    rows: usize,
    file: OpenFile,
}

enum OpenFile {
    Parquet(Box<ParquetTable<AtomicFile>>),
    Csv(Box<CsvTable>),
}

/// A CSV file that is being written.
struct CsvTable {
    file: AtomicFile,
    digest: RunningDigest,
    /// Of the temporary name of its record.
    affixes: (String, &'static str),
}

impl TableWriter {
    /// Begins a table; `label` is that of its shard.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn new(path: PathBuf, maker: RowMaker, label: &str) -> Result<TableWriter, output::Error> {
        let affixes = temporary_affixes(label);
        let mut file = AtomicFile::with_affixes(path.clone(), (&affixes.0, affixes.1))?;
        let failed = |source: io::Error| output::Error::Write { path: path.clone(), source };
        let file = match maker.format {
            TableFormat::Parquet => {
                let table = ParquetTable::new(file, maker.columns, group_rows(maker.table));
                OpenFile::Parquet(Box::new(table.map_err(failed)?))
            }
            TableFormat::Csv => {
                let header = match maker.table {
                    TableKind::Cells => CellTable::new(maker.family).header(),
                    TableKind::Points => PointTable::new(maker.family).header(),
                };
                let mut digest = RunningDigest::default();
                digest.update(header.as_bytes());
                file.write_bytes(header.as_bytes())?;
                OpenFile::Csv(Box::new(CsvTable { file, digest, affixes }))
            }
        };
        Ok(TableWriter { path, rows: 0, file })
    }

    /// Appends rows.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn append(&mut self, chunk: Chunk) -> Result<(), output::Error> {
        let result = match (&mut self.file, chunk) {
            (OpenFile::Parquet(table), Chunk::Rows(rows)) => {
                self.rows += rows.len;
                table.append(rows)
            }
            (OpenFile::Csv(table), Chunk::Text(text, rows)) => {
                self.rows += rows;
                table.digest.update(&text);
                table.file.write_all(&text)
            }
            // The rows are made for the format of the file.
            _ => Ok(()),
        };
        result.map_err(|source| output::Error::Write { path: self.path.clone(), source })
    }

    /// Finishes the table with its record, to which the number of rows is added, and gives it its name.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn commit(self, record: &ShardRecord) -> Result<(), output::Error> {
        let record = ShardRecord { rows: self.rows, ..record.clone() };
        let path = self.path;
        match self.file {
            OpenFile::Parquet(table) => {
                let failed = |source| output::Error::Write { path: path.clone(), source };
                table.finish(record.to_metadata()).map_err(failed)?.commit_durably()
            }
            OpenFile::Csv(table) => {
                let CsvTable { file, digest, affixes } = *table;
                let mut record_file = AtomicFile::with_affixes(record_path(&path), (&affixes.0, affixes.1))?;
                record_file.write_bytes(&TextRecord { record, sha256: digest.finish() }.to_bytes())?;
                record_file.commit_durably()?;
                // The table comes last, so that one without a record is that of others.
                file.commit_durably()
            }
        }
    }
}

/// The record beside a table that is text.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub(super) struct TextRecord {
    /// What the table has.
    #[serde(flatten)]
    pub record: ShardRecord,
    /// The digest of the table.
    pub sha256: Digest,
}

impl TextRecord {
    fn to_bytes(&self) -> Vec<u8> {
        // A record is made of texts, numbers and lists of them, which can always be written as JSON.
        let mut bytes = serde_json::to_vec_pretty(self).unwrap_or_default();
        bytes.push(b'\n');
        bytes
    }
}
