//! A family as it comes off the press, held against what is recorded of it.

use coupler_curves::solve;
use std::convert::Infallible;
use std::path::Path;

use super::cells::CurvePair;
use super::curve::{CurrentCurve, compare_curves};
use super::curve_samples::CurveSamples;
use super::finding::{Change, Finding, Location};
use super::matching::match_curves;
use super::numbering::{CellNumbering, RecordedNumber};
use super::pages::{PageFindings, RecordedPages};
use super::tables::Tables;
use crate::manifest::Tolerances;
use crate::pipeline::{FamilyPipeline, PageJob, Sink};
use crate::record::{FamilyRecord, TableError, parse_rows};
use coupler_curves::motion::Sampler;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// A family that is held against its record.
pub(super) struct FamilyCheck<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    location: Location,
    tolerances: Tolerances,
    tables: Tables<'a>,
    pages: RecordedPages<'a>,
    numbering: CellNumbering,
}

/// What is found of some cells.
#[derive(Default)]
pub(super) struct CellFindings {
    pub findings: Vec<Finding>,
    /// The cells that are not as they were.
    pub changed_cells: Vec<usize>,
    /// How many curves were held against recorded ones.
    pub curve_count: usize,
}

impl<'a> FamilyCheck<'a> {
    /// Opens what is recorded of a family, and tells what is wrong with it as a whole.
    pub fn open(
        press: &'a FamilyPipeline<'a>,
        record: &'a FamilyRecord,
        output: &'a Path,
        tolerances: Tolerances,
        findings: &mut Vec<Finding>,
    ) -> FamilyCheck<'a> {
        let family = &press.composer.planned.family;
        let place = Location::in_family(&family.id);
        if record.linkage != family.template.id {
            let (what, was, is) = ("the linkage".to_owned(), record.linkage.clone(), family.template.id.clone());
            findings.push(place.finding(Change::FamilyChanged { what, recorded: was, current: is }));
        }
        if record.pages != press.pagination.page_count {
            findings
                .push(place.finding(Change::Pages { recorded: record.pages, current: press.pagination.page_count }));
        }
        let tables = Tables::open(press, record, output, findings);
        let numbering = CellNumbering::from_tables(press, &tables, findings);
        let pages = RecordedPages::new(press, record, output);
        FamilyCheck { pipeline: press, location: place, tolerances, tables, pages, numbering }
    }

    /// Holds a cell against its recorded rows.
    fn check_cell(&self, solved: &SolvedCell, held: &mut CellFindings) -> Result<(), TableError> {
        let number = solved.cell.number;
        let place = self.location.with_cell(number);
        let recorded = match self.numbering.recorded_number(number) {
            RecordedNumber::Unknown => return Ok(()),
            RecordedNumber::Missing => {
                held.findings.push(place.finding(Change::CellAdded));
                return Ok(());
            }
            RecordedNumber::Known(recorded) => recorded,
        };
        let [points, cells] = self.tables.current_rows(solved);
        let is_same = self.tables.rows_match(recorded, [&points, &cells]);
        if is_same == [true, true] {
            held.curve_count += solved.curves.len();
            return Ok(());
        }
        if recorded != number {
            held.findings.push(place.finding(Change::CellRenumbered { recorded }));
        }
        let curves = if is_same[0] {
            let own = |curve: &MeasuredCurve| {
                let key = (curve.trace, curve.circuit);
                CurvePair { recorded: key, current: key, size: f64::NAN }
            };
            solved.curves.iter().map(own).collect()
        } else {
            self.check_points(&place, (solved, &points), recorded, held)?
        };
        held.curve_count += curves.len();
        if is_same[1] {
            return Ok(());
        }
        let Some((columns, was)) = self.tables.cell_rows(recorded)? else { return Ok(()) };
        let is = parse_rows(&cells, 1, self.tables.cell_column_count())?;
        columns.compare_rows(&place, [&was, &is], &curves, &self.tolerances, &mut held.findings)
    }

    /// Holds the curves of a cell against its recorded points, and tells which was held against which.
    fn check_points(
        &self,
        place: &Location,
        (solved, fresh): (&SolvedCell, &[u8]),
        recorded: usize,
        held: &mut CellFindings,
    ) -> Result<Vec<CurvePair>, TableError> {
        let Some([mut was, is]) = self.tables.curves(recorded, fresh)? else { return Ok(Vec::new()) };
        let mut missing = Vec::new();
        for track in &mut was {
            let disorder = track.sort_samples();
            let of = place.with_curve(track.trace, track.circuit);
            for wrong in disorder.messages() {
                held.findings.push(of.finding(Change::Damaged { message: wrong }));
            }
            missing.push(disorder.missing);
        }
        let mut pairs = Vec::new();
        let mut traces: Vec<usize> = was.iter().chain(&is).map(|track| track.trace).collect();
        traces.sort_unstable();
        traces.dedup();
        for trace in traces {
            let of = |tracks: &[CurveSamples]| -> Vec<usize> {
                (0..tracks.len()).filter(|&k| tracks[k].trace == trace).collect()
            };
            let (ours, theirs) = (of(&is), of(&was));
            let tracks = |all: &[CurveSamples], places: &[usize]| -> Vec<CurveSamples> {
                places.iter().map(|&k| all[k].clone()).collect()
            };
            let (olds, news) = (tracks(&was, &theirs), tracks(&is, &ours));
            let matching = match_curves(&olds, &news);
            let lost = matching.recorded_changes.into_iter().map(|(a, change)| (olds[a].circuit, change));
            let found = matching.current_changes.into_iter().map(|(b, change)| (news[b].circuit, change));
            held.findings
                .extend(lost.chain(found).map(|(circuit, change)| place.with_curve(trace, circuit).finding(change)));
            for [a, b] in matching.pairs {
                let (old, new) = (&olds[a], &news[b]);
                pairs.push(CurvePair {
                    recorded: (trace, old.circuit),
                    current: (trace, new.circuit),
                    size: new.size(),
                });
                let is_ours = |curve: &&MeasuredCurve| curve.trace == trace && curve.circuit == new.circuit;
                let Some(curve) = solved.curves.iter().find(is_ours) else { continue };
                let fresh = CurrentCurve { samples: new, solved, curve };
                let left_out = missing[theirs[a]].clone();
                let changes = compare_curves(old, fresh, (left_out, self.tables.further_columns()), &self.tolerances);
                let curve = place.with_curve(trace, new.circuit);
                held.findings.extend(changes.into_iter().map(|change| curve.finding(change)));
            }
        }
        Ok(pairs)
    }

    /// The recorded curves of a cell, by its present number, and that cell; nothing where they cannot be read.
    pub fn recorded_and_current(&self, number: usize) -> Option<(Vec<CurveSamples>, SolvedCell)> {
        let RecordedNumber::Known(recorded) = self.numbering.recorded_number(number) else { return None };
        let family = &self.pipeline.composer.planned.family;
        let solved = solve::solve_cell(family, &Sampler::new(family.sampling), number.checked_sub(1)?)?;
        Some((self.tables.recorded_curves(recorded)?, solved))
    }

    /// The findings on pages, when it is known which cells have changed.
    pub fn page_findings(&self, pages: Vec<PageFindings>, changed: &[usize]) -> Vec<Finding> {
        self.pages.findings(pages, changed)
    }
}

impl Sink for FamilyCheck<'_> {
    type CellsOutput = CellFindings;
    type PageOutput = PageFindings;
    type Error = Infallible;

    fn receive_cells(&self, solved: &[SolvedCell]) -> Result<CellFindings, Infallible> {
        let mut held = CellFindings::default();
        for solved in solved.iter().filter(|solved| !solved.is_left_out()) {
            let before = held.findings.len();
            if let Err(flaw) = self.check_cell(solved, &mut held) {
                let place = self.location.with_cell(solved.cell.number);
                held.findings.push(place.finding(Change::Damaged { message: flaw.to_string() }));
            }
            if held.findings.len() > before {
                held.changed_cells.push(solved.cell.number);
            }
        }
        Ok(held)
    }

    fn receive_page(&self, leaf: PageJob) -> Result<PageFindings, Infallible> {
        // Pages tell of cells by the numbers under which they are recorded.
        Ok(self.pages.check_page(leaf, |cell| self.tables.recorded_curves(cell)))
    }

    /// Two pages of text, and the rows of the cells on them.
    fn bytes_per_page(&self) -> usize {
        4 << 20
    }
}
