//! The tables of a family: the recorded ones, and the writers of the current ones.

use std::path::Path;

use super::Error;
use super::cells::CellColumns;
use super::curve_samples::{CurveSamples, PointColumns};
use super::finding::{Change, Finding, Location};
use crate::pipeline::FamilyPipeline;
use crate::record::{CellTable, Digest, FamilyRecord, FileRecord, RecordedTable, Row, TableError, parse_rows};
use coupler_curves::exchange::PointTable;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::SolvedCell;

/// The recorded `points.csv` and `cells.csv`, if they can be read, and the writers of the current ones.
pub(super) struct Tables<'a> {
    writers: (PointTable<'a>, CellTable<'a>),
    /// The current headers.
    headers: [Vec<String>; 2],
    points: Option<RecordedTable>,
    cells: Option<RecordedTable>,
    /// The columns of points to compare, recorded and current.
    point_columns: Option<[PointColumns; 2]>,
    cell_columns: Option<CellColumns>,
}

impl<'a> Tables<'a> {
    /// Opens the tables of a family in the folder of an atlas, and appends the findings on them as files.
    ///
    /// # Errors
    /// The system fails to read one.
    pub fn open(
        pipeline: &'a FamilyPipeline<'a>,
        record: &FamilyRecord,
        output: &Path,
        findings: &mut Vec<Finding>,
    ) -> Result<Tables<'a>, Error> {
        let family = &pipeline.composer.planned.family;
        let writers = (PointTable::new(family), CellTable::new(family));
        let headers = [writers.0.header(), writers.1.header()].map(|header| column_names(&header));
        // The expected size follows from the number of samples; a table many times larger is not read.
        const BYTES_PER_ROW: usize = 100;
        const MAX_RATIO: usize = 16;
        let rows = Sampler::new(family.sampling).full_turn().len().max(360)
            * family.template.curve_count().max(1)
            * family.cell_count();
        let max_bytes = (1 << 26) + (MAX_RATIO * BYTES_PER_ROW * rows.max(record.curves)) as u64;
        let mut open = |name: &str, header: &[String]| -> Result<Option<RecordedTable>, Error> {
            let location = Location::in_family(&family.id).with_file(&format!("{}/{name}", family.id));
            let table = RecordedTable::open(
                &output.join(&family.id).join(name),
                max_bytes,
                family.cell_count().max(record.cells),
            );
            let mut report = |change| findings.push(location.finding(change));
            let table = match table {
                Ok(table) => table,
                Err(error) => {
                    report(Error::or_damage(error)?);
                    return Ok(None);
                }
            };
            table.errors.iter().for_each(|error| report(Change::Damaged { message: error.to_string() }));
            if let Some(change) = file_change(record.files.iter().find(|file| file.name == name), &table.digests) {
                report(change);
            }
            let [removed, added] = CellColumns::unmatched_names(&table.header, header);
            if !removed.is_empty() || !added.is_empty() {
                let list =
                    |names: Vec<String>| if names.is_empty() { "none of these".to_owned() } else { names.join(", ") };
                let (recorded, current) = (list(removed), list(added));
                report(Change::FamilyChanged { what: "columns".to_owned(), recorded, current });
            }
            Ok(Some(table))
        };
        let points = open("points.csv", &headers[0])?;
        let cells = open("cells.csv", &headers[1])?;
        let point_columns = points.as_ref().and_then(|table| {
            let common: Vec<String> = headers[0].iter().filter(|name| table.header.contains(name)).cloned().collect();
            let both = PointColumns::from_header(&table.header, &common)
                .and_then(|recorded_columns| Ok([recorded_columns, PointColumns::from_header(&headers[0], &common)?]));
            let location = Location::in_family(&family.id).with_file(&format!("{}/points.csv", family.id));
            both.map_err(|missing| {
                let message = TableError::MissingColumns(missing).to_string();
                findings.push(location.finding(Change::Damaged { message }));
            })
            .ok()
        });
        let parameters: Vec<String> = family.template.parameters.iter().map(|p| p.name.clone()).collect();
        let cell_columns =
            cells.as_ref().map(|table| CellColumns::from_headers(&table.header, &headers[1], &parameters));
        Ok(Tables { writers, headers, points, cells, point_columns, cell_columns })
    }

    /// The current rows of a cell, in `points.csv` and in `cells.csv`.
    pub fn current_rows(&self, solved: &SolvedCell) -> [Vec<u8>; 2] {
        let (mut points, mut cells) = (Vec::new(), Vec::new());
        self.writers.0.append_rows(solved, &mut points);
        self.writers.1.append_rows(solved, &mut cells);
        [points, cells]
    }

    /// Whether the recorded rows of a cell and their headers equal the current ones byte by byte, for points and for
    /// cells; true for a table that cannot be read.
    ///
    /// # Errors
    /// The recorded rows cannot be read.
    pub fn rows_match(&self, cell: usize, current: [&[u8]; 2]) -> Result<[bool; 2], TableError> {
        let is_same =
            |table: &Option<RecordedTable>, header: &Vec<String>, current: &[u8]| -> Result<bool, TableError> {
                let Some(table) = table else { return Ok(true) };
                let text = table.cell_text(cell).transpose()?.map(|(text, _)| text);
                Ok(table.header == *header && text.as_deref().unwrap_or_default() == current)
            };
        let [points, cells] = &self.headers;
        Ok([is_same(&self.points, points, current[0])?, is_same(&self.cells, cells, current[1])?])
    }

    /// The recorded curves of a cell, and the curves of its current rows of points; `None` if there is no recorded
    /// table of points.
    ///
    /// # Errors
    /// The recorded rows cannot be read.
    pub fn curves(&self, cell: usize, current: &[u8]) -> Result<Option<[Vec<CurveSamples>; 2]>, TableError> {
        let (Some(table), Some([recorded_columns, current_columns])) = (&self.points, &self.point_columns) else {
            return Ok(None);
        };
        /// A cell with more times the expected bytes is not read.
        const MAX_RATIO: usize = 16;
        let text = table.cell_text(cell).transpose()?;
        let (text, line) = text.unwrap_or_default();
        if text.is_empty() && !current.is_empty() && self.has_curves(cell)? {
            return Err(TableError::MissingRows("points.csv"));
        }
        if text.len() > MAX_RATIO * current.len() + (1 << 20) {
            let reason = format!("the rows of cell {cell} have {} bytes, expected {}", text.len(), current.len());
            return Err(TableError::InvalidLine { line, reason });
        }
        let in_points = |error: TableError| match error {
            TableError::InvalidLine { line, reason } => {
                TableError::InvalidLine { line, reason: format!("{reason} (points.csv)") }
            }
            other => other,
        };
        let recorded = recorded_columns
            .curves(&parse_rows(&text, line, table.header.len()).map_err(in_points)?)
            .map_err(in_points)?;
        Ok(Some([recorded, current_columns.curves(&parse_rows(current, 1, self.headers[0].len())?)?]))
    }

    /// Whether a cell has curves according to its recorded row: a cell that is not assembled has none.
    ///
    /// # Errors
    /// The system fails to read the row.
    fn has_curves(&self, cell: usize) -> Result<bool, TableError> {
        let Some(table) = &self.cells else { return Ok(true) };
        let trace = table.column_index("trace");
        let rows = match table.cell_rows(cell) {
            Err(error @ TableError::File(_)) => return Err(error),
            rows => rows.unwrap_or_default(),
        };
        Ok(rows.first().zip(trace).is_none_or(|(row, trace)| !row.field(trace).is_empty()))
    }

    /// The recorded curves of a cell, with their samples in order; `None` if there are none that are right.
    ///
    /// # Errors
    /// The system fails to read them.
    pub fn recorded_curves(&self, cell: usize) -> Result<Option<Vec<CurveSamples>>, Error> {
        let (Some(table), Some([recorded_columns, _])) = (&self.points, &self.point_columns) else { return Ok(None) };
        let curves = table.cell_rows(cell).and_then(|rows| recorded_columns.curves(&rows));
        let mut curves = match curves {
            Ok(curves) => curves,
            Err(error) => return Error::or_damage(error).map(|_| None),
        };
        curves.iter_mut().for_each(|curve| drop(curve.sort_samples()));
        Ok(Some(curves))
    }

    /// The columns of `cells.csv`, and the recorded rows of a cell; `None` if there is no recorded table.
    ///
    /// # Errors
    /// The recorded rows cannot be read.
    pub fn cell_rows(&self, cell: usize) -> Result<Option<(&CellColumns, Vec<Row>)>, TableError> {
        let (Some(table), Some(columns)) = (&self.cells, &self.cell_columns) else { return Ok(None) };
        let in_cells = |error: TableError| match error {
            TableError::InvalidLine { line, reason } => {
                TableError::InvalidLine { line, reason: format!("{reason} (cells.csv)") }
            }
            other => other,
        };
        Ok(Some((columns, table.cell_rows(cell).map_err(in_cells)?)))
    }

    /// The numbers of the cells with recorded rows, ascending; `None` if there is no recorded table.
    pub fn cell_numbers(&self) -> Option<Vec<usize>> {
        let table = self.cells.as_ref().or(self.points.as_ref())?;
        let mut numbers: Vec<usize> = table.cells().collect();
        numbers.sort_unstable();
        Some(numbers)
    }

    /// The columns of the recorded and current `cells.csv`; `None` if there is no recorded table.
    pub fn cell_columns(&self) -> Option<&CellColumns> {
        self.cell_columns.as_ref()
    }

    /// The number of columns of the current `cells.csv`.
    pub fn cell_column_count(&self) -> usize {
        self.headers[1].len()
    }

    /// The further columns of points to compare, with their indices in the current table.
    pub fn further_columns(&self) -> &[(String, usize)] {
        self.point_columns.as_ref().map_or(&[], |[_, current_columns]| &current_columns.further_columns)
    }
}

/// The change of a file since it was recorded; `digests` are that of its bytes, and that of its text with plain line
/// endings.
pub(super) fn file_change(record: Option<&FileRecord>, digests: &[Digest; 2]) -> Option<Change> {
    let Some(recorded) = record.and_then(|record| record.sha256.as_ref()) else {
        return Some(Change::Damaged { message: "is not in the record of the run".to_owned() });
    };
    match digests.iter().position(|digest| digest == recorded) {
        Some(0) => None,
        Some(_) => Some(Change::Rewritten),
        None => Some(Change::Altered),
    }
}

/// The column names in a header written by this program.
fn column_names(header: &str) -> Vec<String> {
    header.trim_end().split(',').map(|name| name.trim_matches('"').to_owned()).collect()
}
