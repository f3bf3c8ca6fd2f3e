//! A family as it comes off the press, held against what is recorded of it.

use coupler_curves::solve;
use std::convert::Infallible;
use std::path::Path;

use super::cells::Pair;
use super::circuits::matched;
use super::curve::{Fresh, compare};
use super::finding::{Change, Finding, Place};
use super::numbering::{Numbering, Recorded};
use super::pages::{Page, Pages};
use super::tables::Tables;
use super::track::Track;
use crate::manifest::Tolerances;
use crate::press::{Hand, Leaf, Press};
use crate::record::{FamilyRecord, Flaw, rows};
use coupler_curves::motion::Sampler;
use coupler_curves::solve::{Curve, Solved};

/// A family that is held against its record.
pub(super) struct Checked<'a> {
    press: &'a Press<'a>,
    place: Place,
    tolerances: Tolerances,
    tables: Tables<'a>,
    pages: Pages<'a>,
    numbering: Numbering,
}

/// What is found of some cells.
#[derive(Default)]
pub(super) struct Held {
    pub findings: Vec<Finding>,
    /// The cells that are not as they were.
    pub changed: Vec<usize>,
    /// How many curves were held against recorded ones.
    pub curves: usize,
}

impl<'a> Checked<'a> {
    /// Opens what is recorded of a family, and tells what is wrong with it as a whole.
    pub fn open(
        press: &'a Press<'a>,
        record: &'a FamilyRecord,
        output: &'a Path,
        tolerances: Tolerances,
        findings: &mut Vec<Finding>,
    ) -> Checked<'a> {
        let family = &press.composer.planned.family;
        let place = Place::family(&family.id);
        if record.linkage != family.template.id {
            let (what, was, is) = ("the linkage".to_owned(), record.linkage.clone(), family.template.id.clone());
            findings.push(place.has(Change::FamilyChanged { what, was, is }));
        }
        if record.pages != press.setting.pages {
            findings.push(place.has(Change::Pages { was: record.pages, is: press.setting.pages }));
        }
        let tables = Tables::open(press, record, output, findings);
        let numbering = Numbering::of(press, &tables, findings);
        let pages = Pages::new(press, record, output);
        Checked { press, place, tolerances, tables, pages, numbering }
    }

    /// Holds a cell against its recorded rows.
    fn cell(&self, solved: &Solved, held: &mut Held) -> Result<(), Flaw> {
        let number = solved.cell.number;
        let place = self.place.cell(number);
        let recorded = match self.numbering.recorded(number) {
            Recorded::Unknown => return Ok(()),
            Recorded::Nowhere => {
                held.findings.push(place.has(Change::CellAdded));
                return Ok(());
            }
            Recorded::As(recorded) => recorded,
        };
        let [points, cells] = self.tables.fresh(solved);
        let is_same = self.tables.is_same(recorded, [&points, &cells]);
        if is_same == [true, true] {
            held.curves += solved.curves.len();
            return Ok(());
        }
        if recorded != number {
            held.findings.push(place.has(Change::CellRenumbered { was: recorded }));
        }
        let curves = if is_same[0] {
            let own = |curve: &Curve| {
                let key = (curve.trace, curve.circuit);
                Pair { was: key, is: key, size: f64::NAN }
            };
            solved.curves.iter().map(own).collect()
        } else {
            self.points(&place, (solved, &points), recorded, held)?
        };
        held.curves += curves.len();
        if is_same[1] {
            return Ok(());
        }
        let Some((columns, was)) = self.tables.cells(recorded)? else { return Ok(()) };
        let is = rows(&cells, 1, self.tables.width_of_cells())?;
        columns.compare(&place, [&was, &is], &curves, &self.tolerances, &mut held.findings)
    }

    /// Holds the curves of a cell against its recorded points, and tells which was held against which.
    fn points(
        &self,
        place: &Place,
        (solved, fresh): (&Solved, &[u8]),
        recorded: usize,
        held: &mut Held,
    ) -> Result<Vec<Pair>, Flaw> {
        let Some([mut was, is]) = self.tables.tracks(recorded, fresh)? else { return Ok(Vec::new()) };
        let mut missing = Vec::new();
        for track in &mut was {
            let disorder = track.put_in_order();
            let of = place.curve(track.trace, track.circuit);
            for wrong in disorder.wrongs() {
                held.findings.push(of.has(Change::Damaged { wrong }));
            }
            missing.push(disorder.missing);
        }
        let mut pairs = Vec::new();
        let mut traces: Vec<usize> = was.iter().chain(&is).map(|track| track.trace).collect();
        traces.sort_unstable();
        traces.dedup();
        for trace in traces {
            let of =
                |tracks: &[Track]| -> Vec<usize> { (0..tracks.len()).filter(|&k| tracks[k].trace == trace).collect() };
            let (ours, theirs) = (of(&is), of(&was));
            let tracks =
                |all: &[Track], places: &[usize]| -> Vec<Track> { places.iter().map(|&k| all[k].clone()).collect() };
            let (olds, news) = (tracks(&was, &theirs), tracks(&is, &ours));
            let matching = matched(&olds, &news);
            let lost = matching.lost.into_iter().map(|(a, change)| (olds[a].circuit, change));
            let found = matching.found.into_iter().map(|(b, change)| (news[b].circuit, change));
            held.findings.extend(lost.chain(found).map(|(circuit, change)| place.curve(trace, circuit).has(change)));
            for [a, b] in matching.pairs {
                let (old, new) = (&olds[a], &news[b]);
                pairs.push(Pair { was: (trace, old.circuit), is: (trace, new.circuit), size: new.size() });
                let is_ours = |curve: &&Curve| curve.trace == trace && curve.circuit == new.circuit;
                let Some(curve) = solved.curves.iter().find(is_ours) else { continue };
                let fresh = Fresh { track: new, solved, curve };
                let left_out = missing[theirs[a]].clone();
                let changes = compare(old, fresh, (left_out, self.tables.further()), &self.tolerances);
                let curve = place.curve(trace, new.circuit);
                held.findings.extend(changes.into_iter().map(|change| curve.has(change)));
            }
        }
        Ok(pairs)
    }

    /// The recorded curves of a cell, by its present number, and that cell; nothing where they cannot be read.
    pub fn both(&self, number: usize) -> Option<(Vec<Track>, Solved)> {
        let Recorded::As(recorded) = self.numbering.recorded(number) else { return None };
        let family = &self.press.composer.planned.family;
        let solved = solve::solve(family, &Sampler::new(family.sampling), number.checked_sub(1)?)?;
        Some((self.tables.recorded_tracks(recorded)?, solved))
    }

    /// The findings on pages, when it is known which cells have changed.
    pub fn on_pages(&self, pages: Vec<Page>, changed: &[usize]) -> Vec<Finding> {
        self.pages.findings(pages, changed)
    }
}

impl Hand for Checked<'_> {
    type Cells = Held;
    type Page = Page;
    type Error = Infallible;

    fn cells(&self, solved: &[Solved]) -> Result<Held, Infallible> {
        let mut held = Held::default();
        for solved in solved.iter().filter(|solved| !solved.is_left_out()) {
            let before = held.findings.len();
            if let Err(flaw) = self.cell(solved, &mut held) {
                let place = self.place.cell(solved.cell.number);
                held.findings.push(place.has(Change::Damaged { wrong: flaw.to_string() }));
            }
            if held.findings.len() > before {
                held.changed.push(solved.cell.number);
            }
        }
        Ok(held)
    }

    fn page(&self, leaf: Leaf) -> Result<Page, Infallible> {
        // Pages tell of cells by the numbers under which they are recorded.
        Ok(self.pages.check(leaf, |cell| self.tables.recorded_tracks(cell)))
    }

    /// Two pages of text, and the rows of the cells on them.
    fn bytes(&self) -> usize {
        4 << 20
    }
}
