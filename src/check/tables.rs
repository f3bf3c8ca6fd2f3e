//! The tables of a family, as they are recorded and as they come out now.

use std::path::Path;

use super::cells::CellColumns;
use super::curve_samples::{CurveSamples, PointColumns};
use super::finding::{Change, Finding, Location};
use crate::pipeline::FamilyPipeline;
use crate::record::{CellTable, FamilyRecord, FileRecord, RecordedTable, Row, TableError, parse_rows};
use coupler_curves::exchange::PointTable;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::SolvedCell;

/// What is recorded in `points.csv` and `cells.csv`, where it can be read, and how they are written now.
pub(super) struct Tables<'a> {
    writers: (PointTable<'a>, CellTable<'a>),
    /// The headers they have now.
    headers: [Vec<String>; 2],
    points: Option<RecordedTable>,
    cells: Option<RecordedTable>,
    /// Where the columns of points are that are compared, recorded and now.
    point_columns: Option<[PointColumns; 2]>,
    cell_columns: Option<CellColumns>,
}

impl<'a> Tables<'a> {
    /// Opens the tables of a family in an atlas's folder, and tells what is wrong with them.
    pub fn open(
        press: &'a FamilyPipeline<'a>,
        record: &FamilyRecord,
        output: &Path,
        findings: &mut Vec<Finding>,
    ) -> Tables<'a> {
        let family = &press.composer.planned.family;
        let writers = (PointTable::new(family), CellTable::new(family));
        let headers = [writers.0.header(), writers.1.header()].map(|header| column_names(&header));
        // A table is as long as its samples make it; another may be some times as long before it is thought a mistake.
        const BYTES_PER_ROW: usize = 100;
        const MAX_RATIO: usize = 16;
        let rows = Sampler::new(family.sampling).full_turn().len().max(360)
            * family.template.curve_count().max(1)
            * family.cell_count();
        let most = (1 << 26) + (MAX_RATIO * BYTES_PER_ROW * rows.max(record.curves)) as u64;
        let mut open = |name: &str, header: &[String]| -> Option<RecordedTable> {
            let place = Location::in_family(&family.id).with_file(&format!("{}/{name}", family.id));
            let table =
                RecordedTable::open(&output.join(&family.id).join(name), most, family.cell_count().max(record.cells));
            let mut note = |change| findings.push(place.finding(change));
            let table = match table {
                Ok(table) => table,
                Err(flaw) => {
                    note(Change::Damaged { message: flaw.to_string() });
                    return None;
                }
            };
            table.errors.iter().for_each(|flaw| note(Change::Damaged { message: flaw.to_string() }));
            if let Some(change) = file_change(record.files.iter().find(|file| file.name == name), &table.digests) {
                note(change);
            }
            let [gone, new] = CellColumns::unmatched_names(&table.header, header);
            if !gone.is_empty() || !new.is_empty() {
                let shown =
                    |names: Vec<String>| if names.is_empty() { "none of these".to_owned() } else { names.join(", ") };
                note(Change::FamilyChanged { what: "columns".to_owned(), recorded: shown(gone), current: shown(new) });
            }
            Some(table)
        };
        let points = open("points.csv", &headers[0]);
        let cells = open("cells.csv", &headers[1]);
        let layouts = points.as_ref().and_then(|table| {
            let common: Vec<String> = headers[0].iter().filter(|name| table.header.contains(name)).cloned().collect();
            let both = PointColumns::from_header(&table.header, &common)
                .and_then(|was| Ok([was, PointColumns::from_header(&headers[0], &common)?]));
            let place = Location::in_family(&family.id).with_file(&format!("{}/points.csv", family.id));
            both.map_err(|missing| {
                findings
                    .push(place.finding(Change::Damaged { message: TableError::MissingColumns(missing).to_string() }));
            })
            .ok()
        });
        let parameters: Vec<String> = family.template.parameters.iter().map(|p| p.name.clone()).collect();
        let columns = cells.as_ref().map(|table| CellColumns::from_headers(&table.header, &headers[1], &parameters));
        Tables { writers, headers, points, cells, point_columns: layouts, cell_columns: columns }
    }

    /// The rows of a cell, as they come out now: of points and of cells.
    pub fn current_rows(&self, solved: &SolvedCell) -> [Vec<u8>; 2] {
        let (mut points, mut cells) = (Vec::new(), Vec::new());
        self.writers.0.append_rows(solved, &mut points);
        self.writers.1.append_rows(solved, &mut cells);
        [points, cells]
    }

    /// Whether the recorded rows of a cell are these to the byte, and the columns too; where a table cannot be read there
    /// is nothing to differ from.
    pub fn rows_match(&self, cell: usize, fresh: [&[u8]; 2]) -> [bool; 2] {
        let is_same = |(table, header, fresh): (&Option<RecordedTable>, &Vec<String>, &[u8])| {
            let Some(table) = table else { return true };
            let text = table.cell_text(cell).and_then(Result::ok).map(|(text, _)| text);
            table.header == *header && text.as_deref().unwrap_or_default() == fresh
        };
        let [points, cells] = &self.headers;
        [(&self.points, points, fresh[0]), (&self.cells, cells, fresh[1])].map(is_same)
    }

    /// The curves of a cell: recorded, and as these rows have them. `None` where no points can be read.
    ///
    /// # Errors
    /// Recorded rows that cannot be read.
    pub fn curves(&self, cell: usize, fresh: &[u8]) -> Result<Option<[Vec<CurveSamples>; 2]>, TableError> {
        let (Some(table), Some([was, is])) = (&self.points, &self.point_columns) else { return Ok(None) };
        /// A cell has no more than some times the rows it should have.
        const MAX_RATIO: usize = 16;
        let text = table.cell_text(cell).transpose()?;
        let (text, line) = text.unwrap_or_default();
        if text.is_empty() && !fresh.is_empty() && self.has_curves(cell) {
            return Err(TableError::MissingRows("points.csv"));
        }
        if text.len() > MAX_RATIO * fresh.len() + (1 << 20) {
            let wrong =
                format!("the rows of cell {cell} have {} bytes, where {} are expected", text.len(), fresh.len());
            return Err(TableError::InvalidLine { line, reason: wrong });
        }
        let in_points = |flaw: TableError| match flaw {
            TableError::InvalidLine { line, reason: wrong } => {
                TableError::InvalidLine { line, reason: format!("{wrong} (points.csv)") }
            }
            other => other,
        };
        let old = was.curves(&parse_rows(&text, line, table.header.len()).map_err(in_points)?).map_err(in_points)?;
        Ok(Some([old, is.curves(&parse_rows(fresh, 1, self.headers[0].len())?)?]))
    }

    /// Whether a cell has curves, as its recorded row tells: one that could not be assembled has none, and no points.
    fn has_curves(&self, cell: usize) -> bool {
        let Some(table) = &self.cells else { return true };
        let trace = table.column_index("trace");
        let rows = table.cell_rows(cell).unwrap_or_default();
        rows.first().zip(trace).is_none_or(|(row, trace)| !row.field(trace).is_empty())
    }

    /// The recorded curves of a cell, in order; `None` where they cannot be read.
    pub fn recorded_curves(&self, cell: usize) -> Option<Vec<CurveSamples>> {
        let (table, [was, _]) = (self.points.as_ref()?, self.point_columns.as_ref()?);
        let mut tracks = was.curves(&table.cell_rows(cell).ok()?).ok()?;
        tracks.iter_mut().for_each(|track| drop(track.sort_samples()));
        Some(tracks)
    }

    /// The columns and the recorded rows of a cell; `None` where they cannot be read.
    ///
    /// # Errors
    /// Recorded rows that cannot be read.
    pub fn cell_rows(&self, cell: usize) -> Result<Option<(&CellColumns, Vec<Row>)>, TableError> {
        let (Some(table), Some(columns)) = (&self.cells, &self.cell_columns) else { return Ok(None) };
        let in_cells = |flaw: TableError| match flaw {
            TableError::InvalidLine { line, reason: wrong } => {
                TableError::InvalidLine { line, reason: format!("{wrong} (cells.csv)") }
            }
            other => other,
        };
        Ok(Some((columns, table.cell_rows(cell).map_err(in_cells)?)))
    }

    /// The cells that have recorded rows, in order; `None` where they cannot be read.
    pub fn cell_numbers(&self) -> Option<Vec<usize>> {
        let table = self.cells.as_ref().or(self.points.as_ref())?;
        let mut numbers: Vec<usize> = table.cells().collect();
        numbers.sort_unstable();
        Some(numbers)
    }

    /// The parameters that are recorded, and are parameters still.
    pub fn cell_columns(&self) -> Option<&CellColumns> {
        self.cell_columns.as_ref()
    }

    /// How many columns `cells.csv` has now.
    pub fn cell_column_count(&self) -> usize {
        self.headers[1].len()
    }

    /// The further columns of points that are compared.
    pub fn further_columns(&self) -> &[(String, usize)] {
        self.point_columns.as_ref().map_or(&[], |[_, is]| &is.further_columns)
    }
}

/// How a file differs from its record, if it does: its digests are that of its bytes, and that with plain line ends.
pub(super) fn file_change(record: Option<&FileRecord>, digests: &[String; 2]) -> Option<Change> {
    let Some(recorded) = record.and_then(|record| record.sha256.as_ref()) else {
        return Some(Change::Damaged { message: "is not in the record of the run".to_owned() });
    };
    match digests.iter().position(|digest| digest == recorded) {
        Some(0) => None,
        Some(_) => Some(Change::Rewritten),
        None => Some(Change::Altered),
    }
}

/// The names of a header that this program has written.
fn column_names(header: &str) -> Vec<String> {
    header.trim_end().split(',').map(|name| name.trim_matches('"').to_owned()).collect()
}
