//! What a piece of the data of a family contains.

use serde::{Deserialize, Serialize};

/// What the pieces of a series contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PieceSeries {
    /// The values of cells and the measures of their curves, by which curves are found: a few dozen bytes a curve.
    Table,
    /// The points of curves, the captions of cells and the layouts of pages: about 600 bytes a curve.
    Curves,
}

impl PieceSeries {
    /// Both series.
    pub const ALL: [PieceSeries; 2] = [PieceSeries::Table, PieceSeries::Curves];

    /// Its name in file names, and in the statements of a script.
    pub fn name(self) -> &'static str {
        match self {
            PieceSeries::Table => "table",
            PieceSeries::Curves => "curves",
        }
    }
}

/// What a piece contains, or some statements of one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PieceContent {
    /// The number of cells.
    pub cells: usize,
    /// The number of curves.
    pub curves: usize,
    /// The number of pages.
    pub pages: usize,
    /// The numbers of the first and the last cell.
    pub numbers: Option<[usize; 2]>,
    /// The greatest number of a traced point.
    pub traces: usize,
    /// The least and the greatest value of each name of the family.
    #[serde(with = "decimals")]
    pub ranges: Vec<[f64; 2]>,
}

/// Numbers as text, which reads back exactly: `serde_json` may read a number with an error in its last bit.
mod decimals {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    pub(super) fn serialize<S: Serializer>(ranges: &[[f64; 2]], serializer: S) -> Result<S::Ok, S::Error> {
        let texts: Vec<[String; 2]> = ranges.iter().map(|range| range.map(|bound| bound.to_string())).collect();
        texts.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<[f64; 2]>, D::Error> {
        let texts = Vec::<[String; 2]>::deserialize(deserializer)?;
        let bound = |text: &String| text.parse::<f64>().map_err(D::Error::custom);
        let range = |[low, high]: &[String; 2]| -> Result<[f64; 2], D::Error> { Ok([bound(low)?, bound(high)?]) };
        texts.iter().map(range).collect()
    }
}

impl PieceContent {
    /// Adds what comes next.
    pub fn add(&mut self, next: &PieceContent) {
        self.cells += next.cells;
        self.curves += next.curves;
        self.pages += next.pages;
        self.numbers = match (self.numbers, next.numbers) {
            (Some([first, _]), Some([_, last])) => Some([first, last]),
            (known, other) => known.or(other),
        };
        self.traces = self.traces.max(next.traces);
        if self.ranges.is_empty() {
            self.ranges.clone_from(&next.ranges);
        }
        for ([least, greatest], [low, high]) in self.ranges.iter_mut().zip(&next.ranges) {
            *least = least.min(*low);
            *greatest = greatest.max(*high);
        }
    }
}

/// The entry of a piece in the index of a family. Everything about a finished piece that the head needs: it can be
/// stored in the record of an unfinished run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PieceIndex {
    /// Its series.
    pub series: PieceSeries,
    /// The size of its file, in bytes.
    pub bytes: usize,
    /// What it contains.
    pub content: PieceContent,
}

/// The statements with some cells and their curves, one for each series; empty if `where` leaves them all out.
#[derive(Clone, Debug, Default)]
pub struct CellData {
    /// The statement of the table.
    pub table: String,
    /// The statement with the points of the curves.
    pub curves: String,
    /// What both contain.
    pub content: PieceContent,
}
