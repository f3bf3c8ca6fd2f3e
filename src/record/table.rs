//! Reads a recorded table cell by cell. The file is not trusted: reading it takes bounded memory and time, and ends in
//! rows or in an error, whatever its contents.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::digest::{Digest, RunningDigest};
use super::regular_file::{FileError, open_regular_file};

/// A table whose rows begin with the number of a cell.
#[derive(Debug)]
pub struct RecordedTable {
    path: PathBuf,
    file: Mutex<File>,
    /// The names of its columns.
    pub header: Vec<String>,
    /// SHA-256 of its bytes, and of its text with the line ends and without the byte order mark, as this program writes
    /// it.
    pub digests: [Digest; 2],
    /// The places of the rows of each cell, normally a single range.
    row_ranges: HashMap<usize, Vec<RowRange>>,
    /// Errors that do not prevent its rows from being read.
    pub errors: Vec<TableError>,
}

/// Consecutive rows.
#[derive(Clone, Copy, Debug)]
struct RowRange {
    /// Their first byte in the file.
    offset: u64,
    len: u64,
    /// Their first line, from 1.
    first_line: usize,
}

/// An error in a recorded table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// It has no header.
    #[error("is empty")]
    Empty,
    /// Its header lacks columns.
    #[error("has no column {}", .0.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", "))]
    MissingColumns(Vec<String>),
    /// A cell has no rows in it.
    #[error("has no rows in {0}")]
    MissingRows(&'static str),
    /// A line is not what this program writes.
    #[error("line {line}: {reason}")]
    InvalidLine {
        /// Its number, from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// Its last line has no line end: the file is truncated.
    #[error("ends in the middle of line {0}")]
    Truncated(usize),
    /// The rows of a cell are not consecutive.
    #[error("line {line}: the rows of cell {cell} are not consecutive")]
    NotContiguous {
        /// The cell.
        cell: usize,
        /// The line where they continue.
        line: usize,
    },
}

/// The greatest length of a line, in bytes.
const MAX_LINE_BYTES: u64 = 1 << 16;

/// The most errors kept for one table.
const MAX_ERRORS: usize = 20;

/// The byte order mark that some programs add to a text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

impl RecordedTable {
    /// Opens a table and finds the rows of each cell. `max_bytes` is the greatest size expected, `cell_count` the
    /// number of cells; a table with rows of far more cells is not read to its end.
    ///
    /// # Errors
    /// The table cannot be read at all.
    pub fn open(path: &Path, max_bytes: u64, cell_count: usize) -> Result<RecordedTable, TableError> {
        let file = open_regular_file(path, max_bytes)?;
        let scan = Scan::from_file(&file, max_bytes, cell_count).map_err(FileError::at(path))?;
        let header = scan.header.ok_or(TableError::Empty)?;
        let digests = scan.digests.map(RunningDigest::finish);
        let Scan { row_ranges, errors, .. } = scan;
        Ok(RecordedTable { path: path.to_owned(), file: Mutex::new(file), header, digests, row_ranges, errors })
    }

    /// The index of a column.
    pub fn column_index(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|other| other == name)
    }

    /// The numbers of the cells that have rows, in no particular order.
    pub fn cells(&self) -> impl Iterator<Item = usize> {
        self.row_ranges.keys().copied()
    }

    /// The text of a cell's rows, in the order of the file, and its first line; `None` if it has no rows.
    ///
    /// # Errors
    /// The file can no longer be read.
    pub fn cell_text(&self, cell: usize) -> Option<Result<(Vec<u8>, usize), TableError>> {
        let ranges = self.row_ranges.get(&cell)?;
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut read = || -> io::Result<Vec<u8>> {
            let mut text = Vec::new();
            for range in ranges {
                file.seek(SeekFrom::Start(range.offset))?;
                (&mut *file).take(range.len).read_to_end(&mut text)?;
            }
            Ok(text)
        };
        let line = ranges.first().map_or(0, |range| range.first_line);
        Some(read().map(|text| (text, line)).map_err(|error| FileError::at(&self.path)(error).into()))
    }

    /// The rows of a cell.
    ///
    /// # Errors
    /// A row is not UTF-8 text, or its number of fields is not that of the columns.
    pub fn cell_rows(&self, cell: usize) -> Result<Vec<Row>, TableError> {
        let Some(text) = self.cell_text(cell) else { return Ok(Vec::new()) };
        let (text, first_line) = text?;
        parse_rows(&text, first_line, self.header.len())
    }
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its line, from 1; counted as if the rows of its cell were consecutive.
    pub line: usize,
    /// Its fields.
    pub fields: csv::StringRecord,
}

/// Parses rows with `field_count` fields each, the first of them on line `first_line`.
///
/// # Errors
/// A row has another number of fields, or is not UTF-8 text.
pub fn parse_rows(text: &[u8], first_line: usize, field_count: usize) -> Result<Vec<Row>, TableError> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
    let mut rows = Vec::new();
    for record in reader.records() {
        let before = rows.len();
        let record = record.map_err(|error| {
            let line = error.position().map_or(before, |position| position.line() as usize - 1) + first_line;
            TableError::InvalidLine { line, reason: "it is not UTF-8 text".to_owned() }
        })?;
        let line = record.position().map_or(before, |position| position.line() as usize - 1) + first_line;
        if record.len() != field_count {
            let reason = format!("expected {field_count} fields, found {}", record.len());
            return Err(TableError::InvalidLine { line, reason });
        }
        rows.push(Row { line, fields: record });
    }
    Ok(rows)
}

impl Row {
    /// A field as a number; NaN if it is empty. `name` is the name of the column, for errors.
    ///
    /// # Errors
    /// The field is not a number as this program writes it.
    pub fn number(&self, column: usize, name: &str) -> Result<f64, TableError> {
        let text = self.field(column);
        let error = || TableError::InvalidLine {
            line: self.line,
            reason: format!("{name} is {}, expected a number", quoted(text)),
        };
        match text {
            "" => Ok(f64::NAN),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            _ => text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(error),
        }
    }

    /// A field as an integer. `name` is the name of the column, for errors.
    ///
    /// # Errors
    /// The field is not an integer.
    pub fn integer(&self, column: usize, name: &str) -> Result<i64, TableError> {
        let text = self.field(column);
        let error = || TableError::InvalidLine {
            line: self.line,
            reason: format!("{name} is {}, expected an integer", quoted(text)),
        };
        text.parse().map_err(|_| error())
    }

    /// A field as text; empty if there is none.
    pub fn field(&self, column: usize) -> &str {
        self.fields.get(column).unwrap_or_default()
    }
}

/// An untrusted field in backquotes, shortened and escaped.
fn quoted(text: &str) -> String {
    const MAX_CHARS: usize = 40;
    let shown: String = text.chars().take(MAX_CHARS).collect();
    let more = if shown.len() < text.len() { "…" } else { "" };
    format!("`{}{more}`", shown.escape_debug())
}

/// The result of reading a table once.
#[derive(Default)]
struct Scan {
    header: Option<Vec<String>>,
    digests: [RunningDigest; 2],
    row_ranges: HashMap<usize, Vec<RowRange>>,
    errors: Vec<TableError>,
    /// The cell of the last row.
    last_cell: Option<usize>,
    /// How many more row ranges may be stored.
    row_ranges_left: usize,
}

impl Scan {
    fn from_file(file: &File, max_bytes: u64, cell_count: usize) -> io::Result<Scan> {
        // Generous, so that an atlas of fewer cells, or one with shuffled rows, can still be compared.
        let mut scan = Scan { row_ranges_left: 10 * cell_count + 100_000, ..Scan::default() };
        // The limit ends the loop even if the file grows while it is read.
        let mut reader = BufReader::with_capacity(1 << 18, file).take(max_bytes);
        let (mut offset, mut number, mut line) = (0, 0, Vec::new());
        loop {
            line.clear();
            number += 1;
            let bytes = (&mut reader).take(MAX_LINE_BYTES).read_until(b'\n', &mut line)? as u64;
            if bytes == 0 {
                return Ok(scan);
            }
            if bytes == MAX_LINE_BYTES && line.last() != Some(&b'\n') {
                let reason = format!("it is longer than {MAX_LINE_BYTES} bytes; the rest is not read");
                scan.add_error(TableError::InvalidLine { line: number, reason });
                return Ok(scan);
            }
            scan.scan_line(&line, offset, number);
            offset += bytes;
            if scan.row_ranges_left == 0 {
                let reason = "there are rows of far more cells than the family has; the rest is not read".to_owned();
                scan.add_error(TableError::InvalidLine { line: number, reason });
                return Ok(scan);
            }
        }
    }

    fn add_error(&mut self, error: TableError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(error);
        }
    }

    /// Reads a line that begins at `offset`; `number` is its number, from 1.
    fn scan_line(&mut self, line: &[u8], offset: u64, number: usize) {
        let marked = if number == 1 { line.strip_prefix(BYTE_ORDER_MARK) } else { None };
        let text = marked.unwrap_or(line);
        let ended = text.strip_suffix(b"\n");
        let bare = ended.unwrap_or(text);
        let bare = bare.strip_suffix(b"\r").unwrap_or(bare);
        self.digests[0].update(line);
        self.digests[1].update(bare);
        if ended.is_some() {
            self.digests[1].update(b"\n");
        } else {
            self.add_error(TableError::Truncated(number));
        }
        if number == 1 {
            self.header = parse_header(bare);
            return;
        }
        if bare.is_empty() {
            return;
        }
        let first = bare.split(|&b| b == b',').next().unwrap_or_default();
        let cell = std::str::from_utf8(first).ok().and_then(|text| text.trim_matches('"').parse::<usize>().ok());
        match cell.filter(|&cell| cell > 0) {
            Some(cell) => self.add_row(cell, offset, line.len() as u64, number),
            None => {
                let reason = format!(
                    "it begins with {}, expected the number of a cell",
                    quoted(&String::from_utf8_lossy(first))
                );
                self.add_error(TableError::InvalidLine { line: number, reason });
                self.last_cell = None;
            }
        }
    }

    /// Stores the place of a row.
    fn add_row(&mut self, cell: usize, offset: u64, bytes: u64, line: usize) {
        let ranges = self.row_ranges.entry(cell).or_default();
        match ranges.last_mut() {
            Some(range) if self.last_cell == Some(cell) => range.len += bytes,
            open => {
                let is_again = open.is_some();
                self.row_ranges_left -= 1;
                ranges.push(RowRange { offset, len: bytes, first_line: line });
                if is_again {
                    self.add_error(TableError::NotContiguous { cell, line });
                }
            }
        }
        self.last_cell = Some(cell);
    }
}

fn parse_header(line: &[u8]) -> Option<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line);
    let record = reader.records().next()?.ok()?;
    Some(record.iter().map(|name| name.trim().to_owned()).collect())
}
