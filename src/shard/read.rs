//! Reads the tables of cells of shards.

use std::collections::BTreeSet;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use coupler_curves::exchange::append_number;
use parquet::column::reader::ColumnReader;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader};
use parquet::file::serialized_reader::SerializedFileReader;

use super::TableFormat;
use super::record::ShardRecord;
use super::table::{TextRecord, parquet_message, parquet_record, record_path};
use crate::record::{file_digest, open_regular_file, read_regular_file};

/// The most bytes of the record beside a table; a record has a manifest, whose length is limited.
const MAX_RECORD_BYTES: u64 = 1 << 25;

/// A complete table of a shard.
#[derive(Clone, Debug)]
pub(super) struct ShardFile {
    pub path: PathBuf,
    pub record: ShardRecord,
    format: TableFormat,
}

/// The record of a file if it is complete.
pub(super) fn recorded(path: &Path) -> Option<ShardRecord> {
    ShardFile::open(path).ok().map(|file| file.record)
}

impl ShardFile {
    /// Opens a table, and reads what it says of itself.
    ///
    /// # Errors
    /// It is not complete, or no sweep wrote it, as a clause.
    pub fn open(path: &Path) -> Result<ShardFile, String> {
        let path = path.to_owned();
        if path.extension().is_some_and(|extension| extension == TableFormat::Parquet.name()) {
            let record = parquet_record(parquet_reader(&path)?.metadata())?;
            return Ok(ShardFile { path, record, format: TableFormat::Parquet });
        }
        let bytes = read_regular_file(&record_path(&path), MAX_RECORD_BYTES)
            .map_err(|error| format!("its record, {}, {error}", record_path(&path).display()))?;
        let value: serde_json::Value =
            serde_json::from_slice(&bytes).map_err(|error| format!("its record is not JSON: {error}"))?;
        let record = ShardRecord::from_value(value.clone())?;
        let TextRecord { sha256, .. } = serde_json::from_value(value).map_err(|error| error.to_string())?;
        match file_digest(&path) {
            Ok(digest) if digest == sha256 => Ok(ShardFile { path, record, format: TableFormat::Csv }),
            Ok(_) => Err("it is not the file that was written".to_owned()),
            Err(error) => Err(format!("it {error}")),
        }
    }

    /// Passes columns as numbers to `receive`, a part of the rows after the other, with the index of its first row. A missing
    /// value is NaN.
    ///
    /// # Errors
    /// The file cannot be read, as a clause.
    pub fn read_numbers(&self, columns: &[String], mut receive: impl FnMut(usize, &[Vec<f64>])) -> Result<(), String> {
        let places: Vec<usize> = columns.iter().map(|name| self.place(name)).collect::<Result<_, _>>()?;
        match self.format {
            TableFormat::Parquet => {
                let reader = parquet_reader(&self.path)?;
                let mut first = 0;
                for group in 0..reader.num_row_groups() {
                    let group = reader.get_row_group(group).map_err(parquet_message)?;
                    let read = |place: &usize| ParquetColumn::read(&*group, *place).map(|values| values.numbers());
                    let numbers = places.iter().map(read).collect::<Result<Vec<_>, _>>();
                    receive(first, &numbers.map_err(parquet_message)?);
                    first += row_count(&*group);
                }
            }
            TableFormat::Csv => {
                /// The rows of a part.
                const ROWS: usize = 1 << 14;
                let (mut first, mut parts) = (0, vec![Vec::new(); columns.len()]);
                for record in self.csv_reader()?.records() {
                    let record = record.map_err(|error| error.to_string())?;
                    for (part, place) in parts.iter_mut().zip(&places) {
                        // An empty field is no number.
                        part.push(record.get(*place).and_then(|text| text.parse().ok()).unwrap_or(f64::NAN));
                    }
                    if parts[0].len() == ROWS {
                        receive(first, &parts);
                        first += ROWS;
                        parts.iter_mut().for_each(Vec::clear);
                    }
                }
                receive(first, &parts);
            }
        }
        Ok(())
    }

    /// Some rows by their indices: the texts of all columns, as in `cells.csv`.
    ///
    /// # Errors
    /// The file cannot be read, or lacks a row, as a clause.
    pub fn read_rows(&self, wanted: &BTreeSet<usize>) -> Result<Vec<(usize, Vec<String>)>, String> {
        let mut found = Vec::new();
        match self.format {
            TableFormat::Parquet => {
                let reader = parquet_reader(&self.path)?;
                let mut first = 0;
                for group in 0..reader.num_row_groups() {
                    let group = reader.get_row_group(group).map_err(parquet_message)?;
                    let end = first + row_count(&*group);
                    let rows: Vec<usize> = wanted.range(first..end).copied().collect();
                    if !rows.is_empty() {
                        let mut texts: Vec<(usize, Vec<String>)> = rows.iter().map(|row| (*row, Vec::new())).collect();
                        for column in 0..group.num_columns() {
                            let values = ParquetColumn::read(&*group, column).map_err(parquet_message)?.texts();
                            for (row, fields) in &mut texts {
                                fields.push(values.get(*row - first).cloned().unwrap_or_default());
                            }
                        }
                        found.extend(texts);
                    }
                    first = end;
                }
            }
            TableFormat::Csv => {
                for (row, record) in self.csv_reader()?.records().enumerate().filter(|(row, _)| wanted.contains(row)) {
                    let record = record.map_err(|error| error.to_string())?;
                    found.push((row, record.iter().map(str::to_owned).collect()));
                }
            }
        }
        if found.len() == wanted.len() { Ok(found) } else { Err("it lacks rows".to_owned()) }
    }

    /// The index of a column.
    fn place(&self, name: &str) -> Result<usize, String> {
        let place = self.record.columns.iter().position(|column| column == name);
        place.ok_or_else(|| format!("it has no column `{name}`: sweep it with that measure"))
    }

    fn csv_reader(&self) -> Result<csv::Reader<File>, String> {
        let file = open_regular_file(&self.path, u64::MAX).map_err(|error| format!("it {error}"))?;
        Ok(csv::Reader::from_reader(file))
    }
}

fn parquet_reader(path: &Path) -> Result<SerializedFileReader<File>, String> {
    let file = open_regular_file(path, u64::MAX).map_err(|error| format!("it {error}"))?;
    SerializedFileReader::new(file).map_err(parquet_message)
}

fn row_count(group: &dyn RowGroupReader) -> usize {
    usize::try_from(group.metadata().num_rows()).unwrap_or(0)
}

/// A column of a row group.
struct ParquetColumn {
    /// For each row whether it has a value, 1 or 0; empty if all have one.
    levels: Vec<i16>,
    values: ParquetValues,
}

enum ParquetValues {
    Integers(Vec<i64>),
    Numbers(Vec<f64>),
    Words(Vec<ByteArray>),
}

impl ParquetColumn {
    fn read(group: &dyn RowGroupReader, column: usize) -> Result<ParquetColumn, ParquetError> {
        let rows = row_count(group);
        let mut levels = Vec::new();
        macro_rules! values {
            ($reader:expr) => {{
                let mut values = Vec::new();
                let (read, ..) = $reader.read_records(rows, Some(&mut levels), None, &mut values)?;
                (read, values)
            }};
        }
        let (read, values) = match group.get_column_reader(column)? {
            ColumnReader::Int32ColumnReader(mut reader) => {
                let (read, values): (usize, Vec<i32>) = values!(reader);
                (read, ParquetValues::Integers(values.into_iter().map(i64::from).collect()))
            }
            ColumnReader::Int64ColumnReader(mut reader) => {
                let (read, values) = values!(reader);
                (read, ParquetValues::Integers(values))
            }
            ColumnReader::DoubleColumnReader(mut reader) => {
                let (read, values) = values!(reader);
                (read, ParquetValues::Numbers(values))
            }
            ColumnReader::ByteArrayColumnReader(mut reader) => {
                let (read, values) = values!(reader);
                (read, ParquetValues::Words(values))
            }
            _ => return Err(ParquetError::General("a column has another type".to_owned())),
        };
        if read != rows {
            return Err(ParquetError::General(format!("a column has {read} rows of {rows}")));
        }
        Ok(ParquetColumn { levels, values })
    }

    /// The values of all rows: `convert` of those that are not missing.
    fn rows<T: Clone, V>(levels: &[i16], values: &[V], missing: T, convert: impl Fn(&V) -> T) -> Vec<T> {
        let mut values = values.iter().map(convert);
        if levels.is_empty() {
            return values.collect();
        }
        let value = |level: &i16| if *level == 0 { None } else { values.next() };
        levels.iter().map(value).map(|value| value.unwrap_or_else(|| missing.clone())).collect()
    }

    /// The numbers of all rows; NaN where there is none.
    fn numbers(&self) -> Vec<f64> {
        let levels = &self.levels;
        match &self.values {
            ParquetValues::Integers(values) => ParquetColumn::rows(levels, values, f64::NAN, |value| *value as f64),
            ParquetValues::Numbers(values) => ParquetColumn::rows(levels, values, f64::NAN, |value| *value),
            ParquetValues::Words(values) => ParquetColumn::rows(levels, values, f64::NAN, |_| f64::NAN),
        }
    }

    /// The texts of all rows; empty where there is no value.
    fn texts(&self) -> Vec<String> {
        let levels = &self.levels;
        match &self.values {
            ParquetValues::Integers(values) => ParquetColumn::rows(levels, values, String::new(), i64::to_string),
            ParquetValues::Numbers(values) => ParquetColumn::rows(levels, values, String::new(), |value| {
                let mut digits = Vec::new();
                append_number(*value, &mut digits);
                String::from_utf8(digits).unwrap_or_default()
            }),
            ParquetValues::Words(values) => ParquetColumn::rows(levels, values, String::new(), |value| {
                String::from_utf8_lossy(value.data()).into_owned()
            }),
        }
    }
}

/// The tables of cells in a folder and its folders, in order of their paths.
///
/// # Errors
/// The folder cannot be read.
pub(super) fn find_tables(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let is_table = |path: &Path| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        name.starts_with("cells-") && TableFormat::ALL.iter().any(|format| format.name() == extension)
    };
    for entry in folder.read_dir()? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_type()?.is_dir() {
            // A folder that cannot be read has no tables.
            let inner = path.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
            found.extend(inner.filter(|path| is_table(path)));
        } else if is_table(&path) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
