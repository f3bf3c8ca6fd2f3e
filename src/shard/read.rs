//! Reads the tables of cells of shards.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use csv::StringRecord;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader};
use parquet::file::serialized_reader::SerializedFileReader;

use super::TableFormat;
use super::parquet_column::ParquetColumn;
use super::parquet_table::{NO_DIGEST, find_last, into_io};
use super::problem::FileProblem;
use super::record::{DIGEST_NAME, ShardRecord, column_difference};
use super::table::{TextRecord, record_path};
use crate::record::{Digest, FileError, RunningDigest, file_digest, open_regular_file, read_regular_file};

/// The most bytes of the record beside a table; a record has a manifest, whose length is limited.
const MAX_RECORD_BYTES: u64 = 1 << 25;

/// The most bytes of text of the rows that are kept in memory: for each so many in each column, the length of the longest number, and so
/// many for words, whose longest are reasons; and so many more in all, for a few rows with long names.
const NUMBER_BYTES: usize = 24;
const TEXT_BYTES: usize = 1 << 10;
const SPARE_BYTES: usize = 1 << 20;

/// A complete table of a shard.
#[derive(Clone, Debug)]
pub(super) struct ShardFile {
    pub path: PathBuf,
    pub record: ShardRecord,
    format: TableFormat,
    /// The digest that it states.
    sha256: Digest,
}

impl ShardFile {
    /// Opens a table, and reads what it says of itself; whether that is true says [`ShardFile::verify`].
    ///
    /// # Errors
    /// It is not whole, or no sweep wrote it.
    pub fn open(path: &Path) -> Result<ShardFile, FileProblem> {
        let path = path.to_owned();
        if path.extension().is_some_and(|extension| extension == TableFormat::Parquet.name()) {
            let (record, sha256) = parquet_record(&path)?;
            return Ok(ShardFile { path, record, format: TableFormat::Parquet, sha256 });
        }
        let TextRecord { record, sha256 } = text_record(&path)?;
        open_regular_file(&path, u64::MAX)?;
        Ok(ShardFile { path, record, format: TableFormat::Csv, sha256 })
    }

    /// Reads the whole file, and compares it with its digest.
    ///
    /// # Errors
    /// It is not the file that was written, or cannot be read.
    pub fn verify(&self) -> Result<(), FileProblem> {
        let digest = match self.format {
            TableFormat::Parquet => parquet_digest(&self.path, self.sha256)?,
            TableFormat::Csv => file_digest(&self.path)?,
        };
        match digest == self.sha256 {
            true => Ok(()),
            false => Err(FileProblem::Damaged("it is not the file that was written".to_owned())),
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
                for_row_groups(&self.path, |group, rows| {
                    let columns = places.iter().map(|place| ParquetColumn::open(group, *place));
                    let mut columns = columns.collect::<Result<Vec<_>, _>>().map_err(parquet_message)?;
                    for part in parts(rows) {
                        let read = |column: &mut ParquetColumn| column.read(part.len()).map(|values| values.numbers());
                        let numbers = columns.iter_mut().map(read).collect::<Result<Vec<_>, _>>();
                        receive(part.start, &numbers.map_err(parquet_message)?);
                    }
                    Ok(())
                })?;
            }
            TableFormat::Csv => {
                let (mut first, mut parts) = (0, vec![Vec::new(); columns.len()]);
                for record in self.csv_reader()?.records() {
                    let record = record.map_err(|error| error.to_string())?;
                    for (part, place) in parts.iter_mut().zip(&places) {
                        // An empty field is no number.
                        part.push(record.get(*place).and_then(|text| text.parse().ok()).unwrap_or(f64::NAN));
                    }
                    if parts[0].len() == PART_ROWS {
                        receive(first, &parts);
                        first += PART_ROWS;
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
    /// The file cannot be read, lacks a row, or has more text than a sweep writes, as a clause.
    pub fn read_rows(&self, wanted: &BTreeSet<usize>) -> Result<Vec<(usize, StringRecord)>, String> {
        let mut found = Vec::new();
        let most = SPARE_BYTES + wanted.len() * (self.record.columns.len() * NUMBER_BYTES + TEXT_BYTES);
        let mut rest = most;
        let mut count = |bytes: usize| -> Result<(), String> {
            let counted = rest.checked_sub(bytes).map(|fewer| rest = fewer);
            counted.ok_or_else(|| format!("{} of its rows have more text than the limit of {most} bytes", wanted.len()))
        };
        match self.format {
            TableFormat::Parquet => {
                for_row_groups(&self.path, |group, rows| {
                    let mut records: Vec<(usize, StringRecord)> =
                        wanted.range(rows.clone()).map(|row| (*row, StringRecord::new())).collect();
                    if records.is_empty() {
                        return Ok(());
                    }
                    for column in 0..group.num_columns() {
                        let mut column = ParquetColumn::open(group, column).map_err(parquet_message)?;
                        let mut records = records.iter_mut().peekable();
                        for part in parts(rows.clone()) {
                            let values = column.read(part.len()).map_err(parquet_message)?;
                            let own = std::iter::from_fn(|| records.next_if(|(row, _)| part.contains(row)));
                            let (wanted, own): (Vec<usize>, Vec<&mut StringRecord>) =
                                own.map(|(row, record)| (*row - part.start, record)).unzip();
                            for (record, text) in own.into_iter().zip(values.texts(&wanted)) {
                                let text = text?;
                                count(text.len())?;
                                record.push_field(&text);
                            }
                        }
                    }
                    found.extend(records);
                    Ok(())
                })?;
            }
            TableFormat::Csv => {
                for (row, record) in self.csv_reader()?.records().enumerate().filter(|(row, _)| wanted.contains(row)) {
                    let record = record.map_err(|error| error.to_string())?;
                    count(record.as_slice().len())?;
                    found.push((row, record));
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

/// Reads the record beside a table that is text.
fn text_record(table: &Path) -> Result<TextRecord, FileProblem> {
    let path = record_path(table);
    let its_record = |what: String| format!("its record, {}, {what}", path.display());
    let bytes = read_regular_file(&path, MAX_RECORD_BYTES).map_err(|error| match error {
        // The record is written first.
        FileError::NotFound if fs::symlink_metadata(table).is_err() => FileProblem::Missing,
        FileError::Unreadable { .. } => FileProblem::Unreadable(its_record(error.to_string())),
        error => FileProblem::Foreign(its_record(error.to_string())),
    })?;
    let value: serde_json::Value = serde_json::from_slice(&bytes).map_err(|error| {
        let message = its_record(format!("is not JSON: {error}"));
        if error.is_eof() { FileProblem::Damaged(message) } else { FileProblem::Foreign(message) }
    })?;
    let record = ShardRecord::from_value(value.clone())?;
    let sha256 = value.get("sha256").cloned().and_then(|value| serde_json::from_value(value).ok());
    let sha256 = sha256.ok_or_else(|| FileProblem::Damaged(its_record("states no digest".to_owned())))?;
    Ok(TextRecord { record, sha256 })
}

/// Opens a Parquet file. `parquet` takes the length of a file for 0 where the system fails to say it.
fn open_parquet(path: &Path, file: File) -> Result<SerializedFileReader<File>, FileProblem> {
    let same = file.try_clone().map_err(FileError::at(path))?;
    SerializedFileReader::new(file).map_err(|error| match same.metadata() {
        Ok(_) => parquet_problem(error),
        Err(error) => FileError::at(path)(error).into(),
    })
}

/// Reads the record of a Parquet file, and the digest that it states.
fn parquet_record(path: &Path) -> Result<(ShardRecord, Digest), FileProblem> {
    let mut file = open_regular_file(path, u64::MAX)?;
    let mut beginning = Vec::new();
    let read = (&mut file).take(PARQUET_MAGIC.len() as u64).read_to_end(&mut beginning);
    read.map_err(FileError::at(path))?;
    // What does not begin as a Parquet file is no part of one.
    if !PARQUET_MAGIC.starts_with(&beginning) {
        return Err(FileProblem::Foreign("it is not a Parquet file".to_owned()));
    }
    let reader = open_parquet(path, file)?;
    let metadata = reader.metadata().file_metadata();
    let pairs = || metadata.key_value_metadata().into_iter().flatten();
    let record = ShardRecord::from_metadata(pairs().map(|pair| (pair.key.as_str(), pair.value.as_deref())))?;
    let rows = metadata.num_rows();
    if usize::try_from(rows) != Ok(record.rows) {
        return Err(FileProblem::Damaged(format!("it has {rows} rows, and states {}", record.rows)));
    }
    let columns: Vec<String> =
        metadata.schema_descr().columns().iter().map(|column| column.name().to_owned()).collect();
    if columns != record.columns {
        let difference = column_difference(&columns, &record.columns);
        return Err(FileProblem::Damaged(format!("it has other columns than it states{difference}")));
    }
    let stated = pairs().find(|pair| pair.key == DIGEST_NAME).and_then(|pair| pair.value.clone());
    let sha256 = stated.and_then(|text| serde_json::from_value(serde_json::Value::String(text)).ok());
    let sha256 = sha256.ok_or_else(|| FileProblem::Damaged("it states no digest".to_owned()))?;
    Ok((record, sha256))
}

/// The bytes with which a Parquet file begins and ends.
const PARQUET_MAGIC: &[u8] = b"PAR1";

/// The bytes after the metadata: their number, and [`PARQUET_MAGIC`].
const PARQUET_TAIL: u64 = 8;

/// The digest of a Parquet file, in which the one that it states counts as [`NO_DIGEST`].
fn parquet_digest(path: &Path, stated: Digest) -> Result<Digest, FileProblem> {
    let mut file = open_regular_file(path, u64::MAX)?;
    let mut digest = RunningDigest::default();
    let mut read = || -> io::Result<Vec<u8>> {
        let length = file.seek(SeekFrom::End(0))?;
        let mut tail = [0; 4];
        file.seek(SeekFrom::Start(length.saturating_sub(PARQUET_TAIL)))?;
        file.read_exact(&mut tail)?;
        let end = u64::from(u32::from_le_bytes(tail)) + PARQUET_TAIL;
        file.rewind()?;
        io::copy(&mut (&mut file).take(length.saturating_sub(end)), &mut digest)?;
        let mut metadata = Vec::new();
        (&mut file).take(end.min(length)).read_to_end(&mut metadata)?;
        Ok(metadata)
    };
    let mut metadata = read().map_err(FileError::at(path))?;
    if let Some(place) = find_last(&metadata, stated.to_string().as_bytes()) {
        metadata[place..place + NO_DIGEST.len()].copy_from_slice(&NO_DIGEST);
    }
    digest.update(&metadata);
    Ok(digest.finish())
}

/// Why a Parquet file cannot be used.
fn parquet_problem(error: ParquetError) -> FileProblem {
    match into_io(error) {
        error if matches!(error.kind(), io::ErrorKind::Other | io::ErrorKind::UnexpectedEof) => {
            FileProblem::Damaged(format!("it is not a whole Parquet file: {error}"))
        }
        error => FileProblem::Unreadable(error.to_string()),
    }
}

/// Passes the row groups of a Parquet file to `visit`, each with the indices of its rows.
fn for_row_groups(
    path: &Path,
    mut visit: impl FnMut(&dyn RowGroupReader, Range<usize>) -> Result<(), String>,
) -> Result<(), String> {
    let file = open_regular_file(path, u64::MAX).map_err(|error| format!("it {error}"))?;
    let reader = open_parquet(path, file).map_err(FileProblem::into_message)?;
    let mut first = 0;
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group).map_err(parquet_message)?;
        let rows = first..first + row_count(&*group);
        first = rows.end;
        visit(&*group, rows)?;
    }
    Ok(())
}

/// The message of an error of reading a Parquet file, as a clause.
fn parquet_message(error: ParquetError) -> String {
    parquet_problem(error).into_message()
}

fn row_count(group: &dyn RowGroupReader) -> usize {
    usize::try_from(group.metadata().num_rows()).unwrap_or(0)
}

/// The rows of a table that are read at once.
const PART_ROWS: usize = 1 << 12;

/// Rows in parts of [`PART_ROWS`].
fn parts(rows: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    rows.clone().step_by(PART_ROWS).map(move |first| first..rows.end.min(first + PART_ROWS))
}
