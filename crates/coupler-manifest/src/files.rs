//! What a manifest needs besides its text: the files that it names, and the answers of its searches.

use coupler_curves::problem::{Problem, Span};
use coupler_curves::template::Template;

use crate::wishes::{DesignRequest, WishPlace};

/// Reads the files that a manifest names, by their paths relative to the manifest, and searches for the linkages that it wishes.
pub trait Files {
    /// The bytes of a font file. The error says why it cannot be read.
    fn font(&self, path: &str) -> Result<Vec<u8>, String>;

    /// The cases in a table, of which the first `limit` are kept. Everything that is wrong in it is reported, and names the file; `None` if
    /// not even its columns are known.
    fn cases(&self, path: &str, limit: usize, report: &mut dyn FnMut(FileProblem)) -> Option<CaseTable>;

    /// The values of the parameters of a linkage that meet wishes, the best first. Everything that is wrong with the wishes is reported, each with
    /// its place, or that nothing meets them; `None` then, or if the answers are not wanted.
    fn designs(
        &self,
        template: &Template,
        request: &DesignRequest,
        report: &mut dyn FnMut(WishPlace, FileProblem),
    ) -> Option<CaseTable>;
}

/// What reads the files of a manifest, and searches for it; `None` if neither is done.
pub type FileReader<'a> = Option<&'a dyn Files>;

/// What is wrong in a file, or with wishes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileProblem {
    /// The message, with the place in the file.
    pub message: String,
    /// How to fix it.
    pub help: String,
    /// Whether the cases can be used all the same.
    pub is_warning: bool,
}

impl FileProblem {
    /// One with which the cases cannot be used.
    pub fn error(message: String, help: String) -> FileProblem {
        FileProblem { message, help, is_warning: false }
    }

    /// It at a place of the manifest.
    pub(crate) fn at(self, span: Span) -> Problem {
        let problem = if self.is_warning { Problem::warning } else { Problem::error }(span, self.message);
        problem.with_help(self.help)
    }
}

/// The cases in a file.
#[derive(Clone, Debug)]
pub struct CaseTable {
    /// The names of its columns, each one that an expression may use.
    pub names: Vec<String>,
    /// The values of the cases that are kept, case by case; NaN where a value is wrong.
    pub values: Vec<f64>,
    /// The number of cases, kept or not.
    pub count: usize,
    /// A digest of the names and values.
    pub digest: String,
    /// Where its rows are.
    pub rows: RowPlaces,
}

/// Where the rows of a table are, for messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RowPlaces {
    /// In lines of a text: the indices of rows, from 0, with their lines, from 1. The rows after one are in the lines after its line.
    Lines(Vec<(usize, usize)>),
    /// In a file without lines.
    Numbered,
}

impl RowPlaces {
    /// Adds the line of the next row.
    pub fn push(&mut self, row: usize, line: usize) {
        let RowPlaces::Lines(known) = self else { return };
        if known.last().is_none_or(|(first, of_first)| row - first != line - of_first) {
            known.push((row, line));
        }
    }

    /// The place of a row by its index, from 0: "line 7", or "row 6".
    pub fn place(&self, row: usize) -> String {
        let RowPlaces::Lines(known) = self else { return format!("row {}", row + 1) };
        let after = known.partition_point(|(first, _)| *first <= row);
        let line = after.checked_sub(1).map(|k| known[k]).map_or(row + 2, |(first, line)| line + row - first);
        format!("line {line}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_in_their_lines() {
        let mut rows = RowPlaces::Lines(Vec::new());
        let lines = [2, 3, 5, 6, 7, 10];
        lines.iter().enumerate().for_each(|(row, line)| rows.push(row, *line));
        assert_eq!(rows, RowPlaces::Lines(vec![(0, 2), (2, 5), (5, 10)]));
        let found: Vec<String> = (0..lines.len()).map(|row| rows.place(row)).collect();
        assert_eq!(found, lines.map(|line| format!("line {line}")));
        assert_eq!(RowPlaces::Numbered.place(0), "row 1");
    }
}
