//! The tables of a family, as they are recorded and as they come out now.

use std::path::Path;

use super::cells::Columns;
use super::finding::{Change, Finding, Place};
use super::track::{Layout, Track};
use crate::press::Press;
use crate::record::{Cells, FamilyRecord, FileRecord, Flaw, Row, Table, rows};
use coupler_curves::exchange::Points;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::Solved;

/// What is recorded in `points.csv` and `cells.csv`, where it can be read, and how they are written now.
pub(super) struct Tables<'a> {
    writers: (Points<'a>, Cells<'a>),
    /// The headers they have now.
    headers: [Vec<String>; 2],
    points: Option<Table>,
    cells: Option<Table>,
    /// Where the columns of points are that are compared, recorded and now.
    layouts: Option<[Layout; 2]>,
    columns: Option<Columns>,
}

impl<'a> Tables<'a> {
    /// Opens the tables of a family in an atlas's folder, and tells what is wrong with them.
    pub fn open(press: &'a Press<'a>, record: &FamilyRecord, output: &Path, findings: &mut Vec<Finding>) -> Tables<'a> {
        let family = &press.composer.planned.family;
        let writers = (Points::new(family), Cells::new(family));
        let headers = [writers.0.header(), writers.1.header()].map(|header| names(&header));
        // A table is as long as its samples make it; another may be some times as long before it is thought a mistake.
        const A_ROW: usize = 100;
        const TIMES: usize = 16;
        let rows =
            Sampler::new(family.sampling).turn().len().max(360) * family.template.curves().max(1) * family.cells();
        let most = (1 << 26) + (TIMES * A_ROW * rows.max(record.curves)) as u64;
        let mut open = |name: &str, header: &[String]| -> Option<Table> {
            let place = Place::family(&family.id).file(&format!("{}/{name}", family.id));
            let table = Table::open(&output.join(&family.id).join(name), most, family.cells().max(record.cells));
            let mut note = |change| findings.push(place.has(change));
            let table = match table {
                Ok(table) => table,
                Err(flaw) => {
                    note(Change::Damaged { wrong: flaw.to_string() });
                    return None;
                }
            };
            table.flaws.iter().for_each(|flaw| note(Change::Damaged { wrong: flaw.to_string() }));
            if let Some(change) = altered(record.files.iter().find(|file| file.name == name), &table.digests) {
                note(change);
            }
            let [gone, new] = Columns::differing(&table.header, header);
            if !gone.is_empty() || !new.is_empty() {
                let shown =
                    |names: Vec<String>| if names.is_empty() { "none of these".to_owned() } else { names.join(", ") };
                note(Change::FamilyChanged { what: "columns".to_owned(), was: shown(gone), is: shown(new) });
            }
            Some(table)
        };
        let points = open("points.csv", &headers[0]);
        let cells = open("cells.csv", &headers[1]);
        let layouts = points.as_ref().and_then(|table| {
            let common: Vec<String> = headers[0].iter().filter(|name| table.header.contains(name)).cloned().collect();
            let both = Layout::of(&table.header, &common).and_then(|was| Ok([was, Layout::of(&headers[0], &common)?]));
            let place = Place::family(&family.id).file(&format!("{}/points.csv", family.id));
            both.map_err(|missing| {
                findings.push(place.has(Change::Damaged { wrong: Flaw::Columns(missing).to_string() }));
            })
            .ok()
        });
        let parameters: Vec<String> = family.template.parameters.iter().map(|p| p.name.clone()).collect();
        let columns = cells.as_ref().map(|table| Columns::of(&table.header, &headers[1], &parameters));
        Tables { writers, headers, points, cells, layouts, columns }
    }

    /// The rows of a cell, as they come out now: of points and of cells.
    pub fn fresh(&self, solved: &Solved) -> [Vec<u8>; 2] {
        let (mut points, mut cells) = (Vec::new(), Vec::new());
        self.writers.0.rows(solved, &mut points);
        self.writers.1.rows(solved, &mut cells);
        [points, cells]
    }

    /// Whether the recorded rows of a cell are these to the byte, and the columns too; where a table cannot be read there
    /// is nothing to differ from.
    pub fn is_same(&self, cell: usize, fresh: [&[u8]; 2]) -> [bool; 2] {
        let is_same = |(table, header, fresh): (&Option<Table>, &Vec<String>, &[u8])| {
            let Some(table) = table else { return true };
            let text = table.text(cell).and_then(Result::ok).map(|(text, _)| text);
            table.header == *header && text.as_deref().unwrap_or_default() == fresh
        };
        let [points, cells] = &self.headers;
        [(&self.points, points, fresh[0]), (&self.cells, cells, fresh[1])].map(is_same)
    }

    /// The curves of a cell: recorded, and as these rows have them. `None` where no points can be read.
    ///
    /// # Errors
    /// Recorded rows that cannot be read.
    pub fn tracks(&self, cell: usize, fresh: &[u8]) -> Result<Option<[Vec<Track>; 2]>, Flaw> {
        let (Some(table), Some([was, is])) = (&self.points, &self.layouts) else { return Ok(None) };
        /// A cell has no more than some times the rows it should have.
        const TIMES: usize = 16;
        let text = table.text(cell).transpose()?;
        let (text, line) = text.unwrap_or_default();
        if text.is_empty() && !fresh.is_empty() && self.has_curves(cell) {
            return Err(Flaw::Rows("points.csv"));
        }
        if text.len() > TIMES * fresh.len() + (1 << 20) {
            let wrong =
                format!("the rows of cell {cell} have {} bytes, where {} are expected", text.len(), fresh.len());
            return Err(Flaw::Line { line, wrong });
        }
        let in_points = |flaw: Flaw| match flaw {
            Flaw::Line { line, wrong } => Flaw::Line { line, wrong: format!("{wrong} (points.csv)") },
            other => other,
        };
        let old = was.tracks(&rows(&text, line, table.header.len()).map_err(in_points)?).map_err(in_points)?;
        Ok(Some([old, is.tracks(&rows(fresh, 1, self.headers[0].len())?)?]))
    }

    /// Whether a cell has curves, as its recorded row tells: one that could not be assembled has none, and no points.
    fn has_curves(&self, cell: usize) -> bool {
        let Some(table) = &self.cells else { return true };
        let trace = table.column("trace");
        let rows = table.rows(cell).unwrap_or_default();
        rows.first().zip(trace).is_none_or(|(row, trace)| !row.field(trace).is_empty())
    }

    /// The recorded curves of a cell, in order; `None` where they cannot be read.
    pub fn recorded_tracks(&self, cell: usize) -> Option<Vec<Track>> {
        let (table, [was, _]) = (self.points.as_ref()?, self.layouts.as_ref()?);
        let mut tracks = was.tracks(&table.rows(cell).ok()?).ok()?;
        tracks.iter_mut().for_each(|track| drop(track.put_in_order()));
        Some(tracks)
    }

    /// The columns and the recorded rows of a cell; `None` where they cannot be read.
    ///
    /// # Errors
    /// Recorded rows that cannot be read.
    pub fn cells(&self, cell: usize) -> Result<Option<(&Columns, Vec<Row>)>, Flaw> {
        let (Some(table), Some(columns)) = (&self.cells, &self.columns) else { return Ok(None) };
        let in_cells = |flaw: Flaw| match flaw {
            Flaw::Line { line, wrong } => Flaw::Line { line, wrong: format!("{wrong} (cells.csv)") },
            other => other,
        };
        Ok(Some((columns, table.rows(cell).map_err(in_cells)?)))
    }

    /// The cells that have recorded rows, in order; `None` where they cannot be read.
    pub fn numbers(&self) -> Option<Vec<usize>> {
        let table = self.cells.as_ref().or(self.points.as_ref())?;
        let mut numbers: Vec<usize> = table.cells().collect();
        numbers.sort_unstable();
        Some(numbers)
    }

    /// The parameters that are recorded, and are parameters still.
    pub fn columns(&self) -> Option<&Columns> {
        self.columns.as_ref()
    }

    /// How many columns `cells.csv` has now.
    pub fn width_of_cells(&self) -> usize {
        self.headers[1].len()
    }

    /// The further columns of points that are compared.
    pub fn further(&self) -> &[(String, usize)] {
        self.layouts.as_ref().map_or(&[], |[_, is]| &is.further)
    }
}

/// How a file differs from its record, if it does: its digests are that of its bytes, and that with plain line ends.
pub(super) fn altered(record: Option<&FileRecord>, digests: &[String; 2]) -> Option<Change> {
    let Some(recorded) = record.and_then(|record| record.sha256.as_ref()) else {
        return Some(Change::Damaged { wrong: "is not in the record of the run".to_owned() });
    };
    match digests.iter().position(|digest| digest == recorded) {
        Some(0) => None,
        Some(_) => Some(Change::Rewritten),
        None => Some(Change::Altered),
    }
}

/// The names of a header that this program has written.
fn names(header: &str) -> Vec<String> {
    header.trim_end().split(',').map(|name| name.trim_matches('"').to_owned()).collect()
}
