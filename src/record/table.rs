//! A recorded table, read cell by cell. It is a file that anyone may have written: whatever is in it, reading it takes
//! bounded memory and time, and ends in rows or in a word on what is wrong.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::RunningDigest;

/// A table whose rows begin with the number of a cell.
#[derive(Debug)]
pub struct RecordedTable {
    file: Mutex<File>,
    /// The names of its columns.
    pub header: Vec<String>,
    /// SHA-256 of its bytes, and of its lines ended as this program ends them.
    pub digests: [String; 2],
    /// Where the rows of each cell are: as a rule in one piece.
    row_ranges: HashMap<usize, Vec<RowRange>>,
    /// What is wrong with it that does not keep its rows from being read.
    pub errors: Vec<TableError>,
}

/// Rows that follow each other.
#[derive(Clone, Copy, Debug)]
struct RowRange {
    /// Where they begin in the file.
    offset: u64,
    len: u64,
    /// The line they begin on, from 1.
    first_line: usize,
}

/// What is wrong with a recorded table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// There is none.
    #[error("is not there")]
    NotFound,
    /// Something else has its name.
    #[error("is {0} and not a file")]
    NotAFile(&'static str),
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It is far larger than what this program could have written.
    #[error("has {bytes} bytes, where no more than {max} are expected")]
    TooLarge {
        /// How many bytes it has.
        bytes: u64,
        /// How many it may have.
        max: u64,
    },
    /// It has no header.
    #[error("is empty")]
    Empty,
    /// Columns are missing from its header.
    #[error("has no column {}", .0.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", "))]
    MissingColumns(Vec<String>),
    /// A cell has no rows.
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
    /// Its last line has no end: it has been cut short.
    #[error("ends in the middle of line {0}")]
    Truncated(usize),
    /// The rows of a cell stand in several places.
    #[error("line {line}: the rows of cell {cell} do not follow each other")]
    NotContiguous {
        /// The cell.
        cell: usize,
        /// Where they are taken up again.
        line: usize,
    },
}

/// The longest line that is read, in bytes.
const MAX_LINE_BYTES: u64 = 1 << 16;

/// How many flaws of one table are told.
const MAX_ERRORS: usize = 20;

/// The byte order mark that some programs put before a text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

impl RecordedTable {
    /// Opens a table that should not be larger than so many bytes and have rows of not many more than so many cells, and
    /// finds the rows of each cell.
    ///
    /// # Errors
    /// What keeps it from being read at all.
    pub fn open(path: &Path, most: u64, cells: usize) -> Result<RecordedTable, TableError> {
        let file = open_regular_file(path, most)?;
        let unreadable = |error: io::Error| TableError::Unreadable(error.to_string());
        let scan = Scan::from_file(&file, most, cells).map_err(unreadable)?;
        let header = scan.header.ok_or(TableError::Empty)?;
        let digests = scan.digests.map(RunningDigest::finish);
        Ok(RecordedTable { file: Mutex::new(file), header, digests, row_ranges: scan.row_ranges, errors: scan.errors })
    }

    /// The place of a column.
    pub fn column_index(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|other| other == name)
    }

    /// The cells that have rows, in no order.
    pub fn cells(&self) -> impl Iterator<Item = usize> {
        self.row_ranges.keys().copied()
    }

    /// The text of a cell's rows, in the order of the file, and the line it begins on; `None` where it has none.
    ///
    /// # Errors
    /// Text that cannot be read again.
    pub fn cell_text(&self, cell: usize) -> Option<Result<(Vec<u8>, usize), TableError>> {
        let pieces = self.row_ranges.get(&cell)?;
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut read = || -> io::Result<Vec<u8>> {
            let mut text = Vec::new();
            for piece in pieces {
                file.seek(SeekFrom::Start(piece.offset))?;
                (&mut *file).take(piece.len).read_to_end(&mut text)?;
            }
            Ok(text)
        };
        let line = pieces.first().map_or(0, |piece| piece.first_line);
        Some(read().map(|text| (text, line)).map_err(|error| TableError::Unreadable(error.to_string())))
    }

    /// The rows of a cell, each with its line.
    ///
    /// # Errors
    /// A row that has not as many fields as there are columns, or is no text.
    pub fn cell_rows(&self, cell: usize) -> Result<Vec<Row>, TableError> {
        let Some(text) = self.cell_text(cell) else { return Ok(Vec::new()) };
        let (text, first) = text?;
        parse_rows(&text, first, self.header.len())
    }
}

/// Opens a file that should not be larger than so many bytes; nothing else that has its name.
///
/// # Errors
/// What keeps it from being read.
pub fn open_regular_file(path: &Path, most: u64) -> Result<File, TableError> {
    let unreadable = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => TableError::NotFound,
        _ => TableError::Unreadable(error.to_string()),
    };
    let metadata = fs::symlink_metadata(path).map_err(unreadable)?;
    let kind = metadata.file_type();
    if !kind.is_file() {
        return Err(TableError::NotAFile(match () {
            () if kind.is_symlink() => "a link",
            () if kind.is_dir() => "a folder",
            () => "a device",
        }));
    }
    if metadata.len() > most {
        return Err(TableError::TooLarge { bytes: metadata.len(), max: most });
    }
    File::open(path).map_err(unreadable)
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The line it stands on, from 1; where the rows of a cell do not follow each other, as if they did.
    pub line: usize,
    /// Its fields.
    pub fields: csv::StringRecord,
}

/// Rows with so many fields, the first of them on a line of this number.
///
/// # Errors
/// A row that has another number of fields, or is no text.
pub fn parse_rows(text: &[u8], first: usize, fields: usize) -> Result<Vec<Row>, TableError> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
    let mut rows = Vec::new();
    for record in reader.records() {
        let before = rows.len();
        let record = record.map_err(|error| {
            let line = error.position().map_or(before, |at| at.line() as usize - 1) + first;
            TableError::InvalidLine { line, reason: "it is not UTF-8 text".to_owned() }
        })?;
        let line = record.position().map_or(before, |at| at.line() as usize - 1) + first;
        if record.len() != fields {
            let wrong = format!("{} fields for {fields} columns", record.len());
            return Err(TableError::InvalidLine { line, reason: wrong });
        }
        rows.push(Row { line, fields: record });
    }
    Ok(rows)
}

impl Row {
    /// A number in it; one that is missing is none.
    ///
    /// # Errors
    /// A field that is no number this program writes.
    pub fn number(&self, column: usize, name: &str) -> Result<f64, TableError> {
        let text = self.field(column);
        let wrong = || TableError::InvalidLine {
            line: self.line,
            reason: format!("{name} is {}, which is no number", quoted(text)),
        };
        match text {
            "" => Ok(f64::NAN),
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            _ => text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(wrong),
        }
    }

    /// A whole number in it.
    ///
    /// # Errors
    /// A field that is none.
    pub fn integer(&self, column: usize, name: &str) -> Result<i64, TableError> {
        let text = self.field(column);
        let wrong = || TableError::InvalidLine {
            line: self.line,
            reason: format!("{name} is {}, which is no whole number", quoted(text)),
        };
        text.parse().map_err(|_| wrong())
    }

    /// A field.
    pub fn field(&self, column: usize) -> &str {
        self.fields.get(column).unwrap_or_default()
    }
}

/// A field of a stranger's, as it can be shown.
fn quoted(text: &str) -> String {
    const MAX_CHARS: usize = 40;
    let shown: String = text.chars().take(MAX_CHARS).collect();
    let more = if shown.len() < text.len() { "…" } else { "" };
    format!("`{}{more}`", shown.escape_debug())
}

/// What is found by going through a table once.
#[derive(Default)]
struct Scan {
    header: Option<Vec<String>>,
    digests: [RunningDigest; 2],
    row_ranges: HashMap<usize, Vec<RowRange>>,
    errors: Vec<TableError>,
    /// The cell of the last row.
    last_cell: Option<usize>,
    /// How many more pieces are kept.
    row_ranges_left: usize,
}

impl Scan {
    fn from_file(file: &File, most: u64, cells: usize) -> io::Result<Scan> {
        // An atlas that has lost most of its cells may be compared, and one whose rows are shuffled.
        let mut scan = Scan { row_ranges_left: 10 * cells + 100_000, ..Scan::default() };
        // A file that grows while it is read is not followed for ever.
        let mut reader = BufReader::with_capacity(1 << 18, file).take(most);
        let (mut at, mut number, mut line) = (0, 0, Vec::new());
        loop {
            line.clear();
            number += 1;
            let bytes = (&mut reader).take(MAX_LINE_BYTES).read_until(b'\n', &mut line)? as u64;
            if bytes == 0 {
                return Ok(scan);
            }
            if bytes == MAX_LINE_BYTES && line.last() != Some(&b'\n') {
                let wrong = format!("it is longer than {MAX_LINE_BYTES} bytes; what follows is not read");
                scan.add_error(TableError::InvalidLine { line: number, reason: wrong });
                return Ok(scan);
            }
            scan.scan_line(&line, at, number);
            at += bytes;
            if scan.row_ranges_left == 0 {
                let wrong = "there are rows of far more cells than the family has; what follows is not read".to_owned();
                scan.add_error(TableError::InvalidLine { line: number, reason: wrong });
                return Ok(scan);
            }
        }
    }

    fn add_error(&mut self, flaw: TableError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(flaw);
        }
    }

    fn scan_line(&mut self, line: &[u8], at: u64, number: usize) {
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
            Some(cell) => self.add_row(cell, at, line.len() as u64, number),
            None => {
                let wrong = format!("it begins with {}, which is no cell", quoted(&String::from_utf8_lossy(first)));
                self.add_error(TableError::InvalidLine { line: number, reason: wrong });
                self.last_cell = None;
            }
        }
    }

    fn add_row(&mut self, cell: usize, at: u64, bytes: u64, line: usize) {
        let pieces = self.row_ranges.entry(cell).or_default();
        match pieces.last_mut() {
            Some(piece) if self.last_cell == Some(cell) => piece.len += bytes,
            open => {
                let is_again = open.is_some();
                self.row_ranges_left -= 1;
                pieces.push(RowRange { offset: at, len: bytes, first_line: line });
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
