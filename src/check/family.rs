//! Compares the output of a family's pipeline with its record.

use std::path::Path;

use super::Error;
use super::cells::CurvePair;
use super::curve::{CurrentCurve, compare_curves};
use super::curve_samples::CurveSamples;
use super::finding::{Change, Finding, Location};
use super::left_out::LeftOut;
use super::matching::match_curves;
use super::numbering::{CellNumbering, RecordedNumber};
use super::pages::{PageFindings, RecordedPages};
use super::tables::Tables;
use crate::manifest::Tolerances;
use crate::pipeline::{FamilyPipeline, PageJob, Sink};
use crate::record::{FamilyRecord, TableError, parse_rows};
use coupler_curves::geometry::Bounds;
use coupler_curves::solve::{MeasuredCurve, SolvedCell, Solver, Status};

/// Receives the output of a family's pipeline, and compares it with the record of the family.
pub(super) struct FamilyCheck<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    location: Location,
    tolerances: Tolerances,
    tables: Tables<'a>,
    pages: RecordedPages<'a>,
    numbering: CellNumbering,
}

/// The findings on a group of cells.
#[derive(Default)]
pub(super) struct CellFindings {
    pub findings: Vec<Finding>,
    /// The numbers of the cells with findings.
    pub changed_cells: Vec<usize>,
    /// The number of curves compared with recorded ones.
    pub curve_count: usize,
    /// What the record of the family counts.
    pub counts: CellCounts,
}

/// What the record of a family counts in its cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct CellCounts {
    /// The cells that are not assembled over the whole range.
    pub not_assembled: usize,
    /// Those of them that are assembled over a part of it.
    pub partly_assembled: usize,
    /// The curves.
    pub curves: usize,
    /// The curves that `where` leaves out.
    pub curves_left_out: usize,
}

impl CellCounts {
    /// Those of some cells.
    fn of_cells(solved: &[SolvedCell]) -> CellCounts {
        CellCounts {
            not_assembled: solved.iter().filter(|solved| solved.status() != Status::Ok).count(),
            partly_assembled: solved.iter().filter(|solved| solved.status() == Status::Partial).count(),
            curves: solved.iter().map(|solved| solved.curves.len()).sum(),
            curves_left_out: solved.iter().map(|solved| solved.left_out_count).sum(),
        }
    }

    /// Those that a record states.
    pub fn of_record(record: &FamilyRecord) -> CellCounts {
        let FamilyRecord { not_assembled, partly_assembled, curves, curves_left_out, .. } = *record;
        CellCounts { not_assembled, partly_assembled, curves, curves_left_out }
    }
}

impl std::ops::AddAssign for CellCounts {
    fn add_assign(&mut self, other: CellCounts) {
        self.not_assembled += other.not_assembled;
        self.partly_assembled += other.partly_assembled;
        self.curves += other.curves;
        self.curves_left_out += other.curves_left_out;
    }
}

impl<'a> FamilyCheck<'a> {
    /// Opens the record of a family, and appends the findings on the family as a whole.
    ///
    /// # Errors
    /// The system fails to read a table.
    pub fn open(
        pipeline: &'a FamilyPipeline<'a>,
        record: &'a FamilyRecord,
        (output, left_out): (&'a Path, LeftOut),
        tolerances: Tolerances,
        findings: &mut Vec<Finding>,
    ) -> Result<FamilyCheck<'a>, Error> {
        let family = &pipeline.composer.planned.family;
        let location = Location::in_family(&family.id);
        if record.linkage != family.template.id {
            let (recorded, current) = (record.linkage.clone(), family.template.id.clone());
            findings.push(location.finding(Change::FamilyChanged {
                what: "the linkage".to_owned(),
                recorded,
                current,
            }));
        }
        let page_count = pipeline.pagination.page_count;
        if record.pages != page_count {
            findings.push(location.finding(Change::Pages { recorded: record.pages, current: page_count }));
        }
        let tables = Tables::open(pipeline, record, output, findings)?;
        let numbering = CellNumbering::from_tables(pipeline, &tables, findings)?;
        let pages = RecordedPages::new(pipeline, record, (output, left_out));
        Ok(FamilyCheck { pipeline, location, tolerances, tables, pages, numbering })
    }

    /// Compares a cell with its recorded rows.
    ///
    /// # Errors
    /// The recorded rows cannot be read.
    fn check_cell(&self, solved: &SolvedCell, result: &mut CellFindings) -> Result<(), TableError> {
        let number = solved.cell.number;
        let location = self.location.with_cell(number);
        let recorded = match self.numbering.recorded_number(number) {
            RecordedNumber::Unknown => return Ok(()),
            RecordedNumber::Missing => {
                result.findings.push(location.finding(Change::CellAdded));
                return Ok(());
            }
            RecordedNumber::Known(recorded) => recorded,
        };
        let [points, cells] = self.tables.current_rows(solved);
        let is_same = self.tables.rows_match(recorded, [&points, &cells])?;
        if is_same == [true, true] {
            result.curve_count += solved.curves.len();
            return Ok(());
        }
        if recorded != number {
            result.findings.push(location.finding(Change::CellRenumbered { recorded }));
        }
        let curves = if is_same[0] {
            let same_curve = |curve: &MeasuredCurve| {
                let key = (curve.trace, curve.circuit);
                let bounds = Bounds::from_points(solved.circuit(curve).points(curve.joint));
                CurvePair { recorded: key, current: key, size: bounds.size().norm(), has_moved: false }
            };
            solved.curves.iter().map(same_curve).collect()
        } else {
            self.check_points(&location, (solved, &points), recorded, result)?
        };
        result.curve_count += curves.len();
        if is_same[1] {
            return Ok(());
        }
        let Some((columns, recorded_rows)) = self.tables.cell_rows(recorded)? else { return Ok(()) };
        let current_rows = parse_rows(&cells, 1, self.tables.cell_column_count())?;
        let rows: [&[_]; 2] = [&recorded_rows, &current_rows];
        columns.compare_rows(&location, rows, &curves, &self.tolerances, &mut result.findings)
    }

    /// Compares the curves of a cell with its recorded points; returns the pairs of curves that were compared.
    ///
    /// # Errors
    /// The recorded rows cannot be read.
    fn check_points(
        &self,
        location: &Location,
        (solved, points): (&SolvedCell, &[u8]),
        recorded: usize,
        result: &mut CellFindings,
    ) -> Result<Vec<CurvePair>, TableError> {
        let Some([mut recorded_curves, current_curves]) = self.tables.curves(recorded, points)? else {
            return Ok(Vec::new());
        };
        let mut missing = Vec::new();
        for curve in &mut recorded_curves {
            let order_errors = curve.sort_samples();
            let curve_location = location.with_curve(curve.trace, curve.circuit);
            for message in order_errors.messages() {
                result.findings.push(curve_location.finding(Change::Damaged { message }));
            }
            missing.push(order_errors.missing);
        }
        let mut pairs = Vec::new();
        let mut traces: Vec<usize> = recorded_curves.iter().chain(&current_curves).map(|curve| curve.trace).collect();
        traces.sort_unstable();
        traces.dedup();
        for trace in traces {
            let of_trace = |curves: &[CurveSamples]| -> Vec<usize> {
                (0..curves.len()).filter(|&k| curves[k].trace == trace).collect()
            };
            let select = |curves: &[CurveSamples], indices: &[usize]| -> Vec<CurveSamples> {
                indices.iter().map(|&k| curves[k].clone()).collect()
            };
            let recorded_indices = of_trace(&recorded_curves);
            let olds = select(&recorded_curves, &recorded_indices);
            let news = select(&current_curves, &of_trace(&current_curves));
            let matching = match_curves(&olds, &news);
            let recorded_changes = matching.recorded_changes.into_iter().map(|(a, change)| (olds[a].circuit, change));
            let current_changes = matching.current_changes.into_iter().map(|(b, change)| (news[b].circuit, change));
            let changes = recorded_changes.chain(current_changes);
            result
                .findings
                .extend(changes.map(|(circuit, change)| location.with_curve(trace, circuit).finding(change)));
            for [a, b] in matching.pairs {
                let (old, new) = (&olds[a], &news[b]);
                let mut pair = CurvePair {
                    recorded: (trace, old.circuit),
                    current: (trace, new.circuit),
                    size: new.size(),
                    has_moved: false,
                };
                let is_same = |curve: &&MeasuredCurve| curve.trace == trace && curve.circuit == new.circuit;
                if let Some(curve) = solved.curves.iter().find(is_same) {
                    let current = CurrentCurve { samples: new, solved, curve };
                    let columns = (missing[recorded_indices[a]].clone(), self.tables.further_columns());
                    let changes = compare_curves(old, current, columns, &self.tolerances);
                    pair.has_moved = !changes.is_empty();
                    let curve_location = location.with_curve(trace, new.circuit);
                    result.findings.extend(changes.into_iter().map(|change| curve_location.finding(change)));
                }
                pairs.push(pair);
            }
        }
        Ok(pairs)
    }

    /// The recorded curves of a cell, given by its current number, and the cell solved again; `None` if there are none
    /// that are right.
    ///
    /// # Errors
    /// The system fails to read them.
    pub fn recorded_and_current(&self, number: usize) -> Result<Option<(Vec<CurveSamples>, SolvedCell)>, Error> {
        let RecordedNumber::Known(recorded) = self.numbering.recorded_number(number) else { return Ok(None) };
        let family = &self.pipeline.composer.planned.family;
        let solved = number.checked_sub(1).and_then(|k| Solver::new(family).solve(k));
        Ok(self.tables.recorded_curves(recorded)?.zip(solved))
    }

    /// The findings on pages that are not explained by the changed cells.
    pub fn page_findings(&self, pages: Vec<PageFindings>, changed_cells: &[usize]) -> Vec<Finding> {
        self.pages.findings(pages, changed_cells)
    }
}

impl Sink for FamilyCheck<'_> {
    type CellsOutput = CellFindings;
    type PageOutput = PageFindings;
    type Error = Error;

    fn receive_cells(&self, solved: &[SolvedCell]) -> Result<CellFindings, Error> {
        let mut result = CellFindings { counts: CellCounts::of_cells(solved), ..CellFindings::default() };
        for solved in solved.iter().filter(|solved| !solved.is_left_out()) {
            let before = result.findings.len();
            if let Err(error) = self.check_cell(solved, &mut result) {
                let location = self.location.with_cell(solved.cell.number);
                result.findings.push(location.finding(Error::or_damage(error)?));
            }
            if result.findings.len() > before {
                result.changed_cells.push(solved.cell.number);
            }
        }
        Ok(result)
    }

    fn receive_page(&self, job: PageJob) -> Result<PageFindings, Error> {
        // Recorded pages show the recorded numbers of cells.
        self.pages.check_page(job, |cell| self.tables.recorded_curves(cell))
    }

    /// The recorded and the current page, and the rows of the cells on them.
    fn bytes_per_page(&self) -> usize {
        4 << 20
    }
}
