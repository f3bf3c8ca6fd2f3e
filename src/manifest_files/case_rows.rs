//! The rows of a table of cases while they are read.

use std::io;

use crate::manifest::{CaseTable, FileProblem, RowPlaces};
use crate::record::RunningDigest;

/// The most bytes of a table of cases.
pub(super) const MAX_TABLE_BYTES: u64 = 512_000_000;

/// The most values of a table, which are in memory: 8 bytes each.
const MAX_VALUES: usize = 50_000_000;

/// Collects the rows of a table, and reports what is wrong in them.
pub(super) struct CaseRows<'r> {
    /// The name of the file, for messages.
    name: String,
    limit: usize,
    report: &'r mut dyn FnMut(FileProblem),
    names: Vec<String>,
    values: Vec<f64>,
    count: usize,
    places: RowPlaces,
}

impl<'r> CaseRows<'r> {
    /// Those of a table of which the first `limit` cases are kept.
    pub fn new(name: &str, limit: usize, report: &'r mut dyn FnMut(FileProblem)) -> CaseRows<'r> {
        let name = name.escape_debug().to_string();
        let places = RowPlaces::Numbered;
        CaseRows { name, limit, report, names: Vec::new(), values: Vec::new(), count: 0, places }
    }

    /// Says of rows in which lines of a text they are.
    pub fn with_lines(&mut self) {
        self.places = RowPlaces::Lines(Vec::new());
    }

    /// Reports a problem at a place in the file, if it has one there.
    pub fn problem(&mut self, place: &str, message: &str, help: &str) {
        let comma = if place.is_empty() { "" } else { ", " };
        let message = format!("`{}`{comma}{place}: {message}", self.name);
        (self.report)(FileProblem::error(message, help.to_owned()));
    }

    /// Reports that the file cannot be read.
    pub fn report_unreadable(&mut self, why: &str) {
        let message = format!("cannot read `{}`: {why}", self.name);
        let help = "give the path of a table as .csv or .parquet, relative to the manifest".to_owned();
        (self.report)(FileProblem::error(message, help));
    }

    /// Takes the names of the columns.
    pub fn set_names(&mut self, names: Vec<String>) {
        self.names = names;
    }

    /// The number of columns.
    pub fn width(&self) -> usize {
        self.names.len()
    }

    /// The name of a column.
    pub fn column(&self, k: usize) -> String {
        format!("column `{}`", self.names[k].escape_debug())
    }

    /// Whether the next row is kept.
    pub fn is_next_kept(&self) -> bool {
        self.count < self.limit
    }

    /// Counts rows that are not kept.
    pub fn skip(&mut self, rows: usize) {
        self.count += rows;
    }

    /// The number of the next row, from 1.
    pub fn next_number(&self) -> usize {
        self.count + 1
    }

    /// Whether so many rows are kept, and not only the first of them.
    ///
    /// # Errors
    /// They have too many values.
    pub fn can_keep(&self, count: usize) -> io::Result<bool> {
        match count <= self.limit && count.saturating_mul(self.width()) > MAX_VALUES {
            true => Err(too_many_values()),
            false => Ok(count <= self.limit),
        }
    }

    /// Adds a row with a value for each column, NaN where it is wrong, and the line that it is in, if there are lines.
    ///
    /// # Errors
    /// There are too many values.
    pub fn push(&mut self, row: &[f64], line: usize) -> io::Result<()> {
        if self.values.len() + row.len() > MAX_VALUES {
            return Err(too_many_values());
        }
        self.values.extend_from_slice(row);
        self.places.push(self.count, line);
        self.count += 1;
        Ok(())
    }

    /// Reports a value that is no number, or none that a case can have.
    pub fn report_value(&mut self, (line, column): (usize, usize), found: &str) {
        let place = match &self.places {
            RowPlaces::Lines(_) => format!("line {line}"),
            RowPlaces::Numbered => format!("row {line}"),
        };
        let place = format!("{place}, {}", self.column(column));
        let help = "write a number, as in 2.5 or 1e-3; expressions and units are for cases in the manifest";
        let shown: String = found.chars().take(MAX_SHOWN).collect();
        let more = if shown.len() < found.len() { "…" } else { "" };
        let message = match found {
            "" => "expected a finite number, found nothing".to_owned(),
            _ => format!("expected a finite number, found `{}{more}`", shown.escape_debug()),
        };
        self.problem(&place, &message, help);
    }

    /// The table; `None` if it has no columns.
    pub fn into_table(self) -> Option<CaseTable> {
        let CaseRows { names, values, count, places, .. } = self;
        if names.is_empty() {
            return None;
        }
        let mut digest = RunningDigest::default();
        names.iter().for_each(|name| digest.update(format!("{name}\n").as_bytes()));
        // Every bit of a value matters.
        let mut bytes = Vec::with_capacity(8 * names.len());
        for row in values.chunks_exact(names.len()) {
            bytes.clear();
            bytes.extend(row.iter().flat_map(|value| value.to_le_bytes()));
            digest.update(&bytes);
        }
        Some(CaseTable { names, values, count, digest: digest.finish().to_string(), rows: places })
    }
}

fn too_many_values() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, format!("it has more than {MAX_VALUES} values"))
}

/// The most characters of a value that a message shows.
const MAX_SHOWN: usize = 40;
