//! The data of a family in pieces of bounded size, so that the page loads only those in view.
//!
//! A browser cannot parse a script of more than 512 MB, and keeps what a script contains in memory. The data are
//! therefore divided twice: by what they are for, into two series, and each series into pieces.

use super::family_script::{FamilyScript, SCRIPT_FILE};
use super::piece::{CellData, PieceContent, PieceIndex, PieceSeries};

/// The greatest size of a piece, in bytes; only a single group of cells may be larger. A piece of this size is read and
/// parsed in a few hundredths of a second, and a family of a million curves has a few hundred pieces.
pub const MAX_PIECE_BYTES: usize = 4_000_000;

/// The data of a family up to this size, in bytes, are in its head, so that small families have one file.
pub const MAX_SINGLE_FILE_BYTES: usize = 1_000_000;

/// The file name of the n-th piece of a series, from 1.
pub fn piece_file_name(series: PieceSeries, number: usize) -> String {
    format!("gallery-{}-{number:04}.js", series.name())
}

/// The series and the number of the piece with this file name; `None` if it is not such a name.
pub fn parse_piece_file_name(name: &str) -> Option<(PieceSeries, usize)> {
    let (series, number) = name.strip_prefix("gallery-")?.strip_suffix(".js")?.split_once('-')?;
    let series = PieceSeries::ALL.into_iter().find(|known| known.name() == series)?;
    let number = number.parse().ok()?;
    (number > 0 && piece_file_name(series, number) == name).then_some((series, number))
}

/// Whether a file of a family's folder has this name because it contains data for the gallery.
pub fn is_data_file_name(name: &str) -> bool {
    name == SCRIPT_FILE || parse_piece_file_name(name).is_some()
}

/// A file with data for the gallery.
#[derive(Clone, Debug, PartialEq)]
pub struct DataFile {
    /// Its name in the folder of the family.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A piece to which statements are being added.
#[derive(Clone, Debug)]
pub struct OpenPiece {
    /// Its statements so far, without those that begin and end a piece.
    pub statements: String,
    /// What they contain.
    pub content: PieceContent,
}

/// Distributes the data of a family over files, in the order of a run: cells, and pages among them or after them.
///
/// It writes nothing: files are returned when they are complete. Between two additions its whole state is in its public
/// fields, from which a killed run can be resumed.
#[derive(Clone, Debug)]
pub struct PieceWriter<'a> {
    script: FamilyScript<'a>,
    /// The finished pieces of both series, in the order in which they were finished.
    pub finished: Vec<PieceIndex>,
    /// The open piece of each series, in the order of [`PieceSeries::ALL`].
    pub open: [OpenPiece; 2],
}

impl<'a> PieceWriter<'a> {
    /// A writer for the data of a family.
    pub fn new(script: FamilyScript<'a>) -> PieceWriter<'a> {
        let open = || OpenPiece { statements: String::new(), content: PieceContent::default() };
        PieceWriter { script, finished: Vec::new(), open: [open(), open()] }
    }

    /// The file names of the finished pieces.
    pub fn finished_names(&self) -> Vec<String> {
        let mut counts = [0; 2];
        let name = |piece: &PieceIndex| {
            counts[piece.series as usize] += 1;
            piece_file_name(piece.series, counts[piece.series as usize])
        };
        self.finished.iter().map(name).collect()
    }

    /// Adds some cells; the pieces that are full without them.
    pub fn add_cells(&mut self, data: &CellData) -> Vec<DataFile> {
        let statements = [(PieceSeries::Table, &data.table), (PieceSeries::Curves, &data.curves)];
        statements.into_iter().filter_map(|(series, text)| self.add(series, text, &data.content)).collect()
    }

    /// Adds the statement of a page; the piece that is full without it.
    pub fn add_page(&mut self, statement: &str) -> Option<DataFile> {
        self.add(PieceSeries::Curves, statement, &PieceContent { pages: 1, ..PieceContent::default() })
    }

    fn add(&mut self, series: PieceSeries, text: &str, content: &PieceContent) -> Option<DataFile> {
        if text.is_empty() {
            return None;
        }
        let is_full = {
            let open = &self.open[series as usize];
            !open.statements.is_empty() && open.statements.len() + text.len() > MAX_PIECE_BYTES
        };
        let full = if is_full { self.finish_piece(series) } else { None };
        let open = &mut self.open[series as usize];
        open.statements.push_str(text);
        open.content.add(content);
        full
    }

    /// Ends the open piece of a series, unless it is empty.
    fn finish_piece(&mut self, series: PieceSeries) -> Option<DataFile> {
        let open = &mut self.open[series as usize];
        let (statements, content) = (std::mem::take(&mut open.statements), std::mem::take(&mut open.content));
        if statements.is_empty() {
            return None;
        }
        let number = self.finished.iter().filter(|piece| piece.series == series).count() + 1;
        let (begin, end) = (self.script.begin_piece(series, number), self.script.end());
        let file = DataFile { name: piece_file_name(series, number), text: format!("{begin}{statements}{end}") };
        self.finished.push(PieceIndex { series, bytes: file.text.len(), content });
        Some(file)
    }

    /// The last files: the pieces that are still open, and the head. Of a small family it is the head alone, which then
    /// contains everything.
    pub fn finish(mut self) -> Vec<DataFile> {
        let size: usize = self.open.iter().map(|open| open.statements.len()).sum();
        let head = |text| DataFile { name: SCRIPT_FILE.to_owned(), text };
        if self.finished.is_empty() && size <= MAX_SINGLE_FILE_BYTES {
            let pieces: Vec<PieceIndex> = PieceSeries::ALL
                .into_iter()
                .zip(&self.open)
                .map(|(series, open)| PieceIndex { series, bytes: 0, content: open.content.clone() })
                .collect();
            let statements: String = self.open.iter().map(|open| open.statements.as_str()).collect();
            return vec![head(self.script.head(&pieces, &statements))];
        }
        let mut files: Vec<DataFile> =
            PieceSeries::ALL.into_iter().filter_map(|series| self.finish_piece(series)).collect();
        files.push(head(self.script.head(&self.finished, "")));
        files
    }
}
