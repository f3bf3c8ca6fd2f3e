//! A fresh run held against a recorded one: what has changed, where and by how much.
//!
//! The manifest is run afresh in memory. What comes off the press is held against the recorded tables and pages: to the
//! byte first, and what differs there by its numbers. A recorded atlas is input like any other: whatever is in it, there
//! is a finding and no panic, and memory stays bounded.

mod cells;
mod curve;
mod curve_samples;
mod family;
mod finding;
mod gallery;
mod hausdorff;
mod matching;
mod numbering;
mod overlays;
mod pages;
mod tables;

pub use finding::{Change, Displacement, Finding, Location};
pub use overlays::{Overlay, draw_overlays};

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use serde::Serialize;

use crate::gallery::{PAGE_FILE, SCRIPT_FILE};
use crate::manifest::{PartialTolerances, Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, Output};
use crate::record::{FamilyRecord, LOCK_FILE_NAME, ReadError, RunRecord};
use family::FamilyCheck;

/// What is to be checked, and how strictly.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The families to check; all where empty.
    pub only: Vec<String>,
    /// Tolerances that count in place of the manifest's.
    pub tolerances: PartialTolerances,
}

/// Something that happened while checking.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// A family with so many pages is begun.
    Begin {
        /// Its id.
        family: &'a str,
        /// Its pages.
        pages: usize,
    },
    /// A page is done.
    Page,
    /// A family is done.
    End,
}

/// What a check has found.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// How many families were held against their records.
    pub families: usize,
    /// How many curves.
    pub curves: usize,
    /// How many pages.
    pub pages: usize,
    /// How many findings there are of each kind.
    pub counts: BTreeMap<&'static str, usize>,
    /// What was found, the worst first; of very many, the worst of each family.
    pub findings: Vec<Finding>,
}

/// Why nothing could be checked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The record of the atlas cannot be used.
    #[error("cannot use {}: {source}", path.display())]
    Record {
        /// The record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// A run is writing to the atlas.
    #[error("a run is writing to {}: wait for its end", folder.display())]
    Busy {
        /// The atlas's folder.
        folder: PathBuf,
    },
}

impl Report {
    /// Whether anything differs.
    pub fn has_differences(&self) -> bool {
        self.findings.iter().any(|finding| finding.change.is_difference())
    }

    /// How many findings there are, those that are not kept among them.
    pub fn total(&self) -> usize {
        self.counts.values().sum()
    }

    /// So many findings of a family are kept.
    const MAX_FINDINGS: usize = 20_000;

    fn add_findings(&mut self, mut findings: Vec<Finding>) {
        for finding in &findings {
            *self.counts.entry(finding.change.kind()).or_default() += 1;
        }
        sort_worst_first(&mut findings);
        findings.truncate(Report::MAX_FINDINGS);
        self.findings.extend(findings);
    }
}

fn sort_worst_first(findings: &mut [Finding]) {
    findings.sort_by(|a, b| {
        let ((rank, size), (other_rank, other_size)) = (a.change.sort_key(), b.change.sort_key());
        rank.cmp(&other_rank).then(size.total_cmp(&other_size))
    });
}

/// Runs a plan and holds what comes of it against the atlas recorded in a folder.
///
/// # Errors
/// A record of the atlas that cannot be read.
pub fn check_atlas(
    plan: &Plan,
    recorded: &Path,
    options: &Options,
    tell: &mut dyn FnMut(Event),
) -> Result<Report, Error> {
    if is_locked(recorded) {
        return Err(Error::Busy { folder: recorded.to_owned() });
    }
    let path = recorded.join("run.json");
    let record = RunRecord::read(&path).map_err(|source| Error::Record { path, source })?;
    let is_asked = |id: &str| options.only.is_empty() || options.only.iter().any(|only| only == id);
    let mut report = Report::default();
    for family in record.families.iter().filter(|family| is_asked(&family.id)) {
        if plan.families.iter().all(|planned| planned.family.id != family.id) {
            report.add_findings(vec![Location::in_family(&family.id).finding(Change::FamilyRemoved)]);
        }
    }
    if let Some(book) = record.book.as_ref().filter(|_| options.only.is_empty()) {
        report.add_findings(book.files.iter().filter_map(|file| pages::check_volume(recorded, &file.name)).collect());
    }
    if let Some(page) = record.gallery.as_ref().filter(|_| options.only.is_empty()) {
        report.add_findings(gallery::check_file(recorded, PAGE_FILE, page).into_iter().collect());
    }
    for planned in plan.families.iter().filter(|planned| is_asked(&planned.family.id)) {
        match record.families.iter().find(|family| family.id == planned.family.id) {
            Some(of) => check_family(plan, planned, of, recorded, options, &mut report, tell),
            None => report.add_findings(vec![Location::in_family(&planned.family.id).finding(Change::FamilyAdded)]),
        }
    }
    sort_worst_first(&mut report.findings);
    Ok(report)
}

/// Whether a run has locked a folder; a lock that is left behind locks nothing.
fn is_locked(folder: &Path) -> bool {
    let lock = File::open(folder.join(LOCK_FILE_NAME));
    lock.is_ok_and(|lock| matches!(lock.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

fn check_family(
    plan: &Plan,
    planned: &PlannedFamily,
    record: &FamilyRecord,
    recorded: &Path,
    options: &Options,
    report: &mut Report,
    tell: &mut dyn FnMut(Event),
) {
    // Nobody stops this.
    let Some(press) = FamilyPipeline::new(plan, planned, &AtomicBool::new(false)) else { return };
    tell(Event::Begin { family: &planned.family.id, pages: press.pagination.page_count });
    let tolerances = options.tolerances.or(planned.tolerances).or_defaults();
    let mut findings = Vec::new();
    let checked = FamilyCheck::open(&press, record, recorded, tolerances, &mut findings);
    let (mut changed, mut pages) = (Vec::new(), Vec::new());
    let result = press.run(&checked, |off| {
        match off {
            Output::Cells(held) => {
                findings.extend(held.findings);
                changed.extend(held.changed_cells);
                report.curves += held.curve_count;
            }
            Output::Page(page) => {
                pages.push(page);
                tell(Event::Page);
            }
        }
        Ok::<(), Infallible>(())
    });
    // There is nothing that could go wrong.
    let Ok(()) = result;
    report.families += 1;
    report.pages += pages.len();
    findings.extend(checked.page_findings(pages, &changed));
    if let Some(script) = record.files.iter().find(|file| file.name == SCRIPT_FILE) {
        findings.extend(gallery::check_file(recorded, &format!("{}/{SCRIPT_FILE}", planned.family.id), script));
    }
    report.add_findings(findings);
    tell(Event::End);
}
