//! Compares a fresh run of a manifest with a recorded atlas: what has changed, where and by how much.
//!
//! The manifest is run again in memory, and its output compared with the recorded tables and pages: first byte by byte,
//! and where the bytes differ, number by number. The recorded atlas is not trusted: invalid files lead to findings,
//! never to a panic, and memory stays bounded.

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

/// The families to check, and the tolerances.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The ids of the families to check; all if empty.
    pub only: Vec<String>,
    /// Tolerances that replace those of the manifest.
    pub tolerances: PartialTolerances,
}

/// The progress of a check.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// The check of a family begins.
    Begin {
        /// The id of the family.
        family: &'a str,
        /// The number of its pages.
        pages: usize,
    },
    /// A page is family_check.
    Page,
    /// The check of a family ends.
    End,
}

/// The result of a check.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// The number of families compared with their records.
    pub families: usize,
    /// The number of curves compared with their records.
    pub curves: usize,
    /// The number of pages compared with their records.
    pub pages: usize,
    /// The number of findings of each kind.
    pub counts: BTreeMap<&'static str, usize>,
    /// The findings, the worst first; at most 20,000 of each family.
    pub findings: Vec<Finding>,
}

/// Why an atlas cannot be family_check.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The record of the atlas cannot be used.
    #[error("cannot use {}: {source}", path.display())]
    Record {
        /// The path of the record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// A run is writing to the atlas.
    #[error("a run is writing to {}: wait for it to end", folder.display())]
    Busy {
        /// The folder of the atlas.
        folder: PathBuf,
    },
}

impl Report {
    /// Whether any finding is a difference.
    pub fn has_differences(&self) -> bool {
        self.findings.iter().any(|finding| finding.change.is_difference())
    }

    /// The number of findings, including those that are not kept in `findings`.
    pub fn total(&self) -> usize {
        self.counts.values().sum()
    }

    /// The number of findings of a family that are kept.
    const MAX_FINDINGS: usize = 20_000;

    /// Counts the findings of a family, and keeps the worst of them.
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

/// Runs a plan, and compares the result with the atlas recorded in a folder; calls `on_event` with the progress.
///
/// # Errors
/// The record of the atlas cannot be read, or a run is writing to its folder.
pub fn check_atlas(
    plan: &Plan,
    recorded: &Path,
    options: &Options,
    on_event: &mut dyn FnMut(Event),
) -> Result<Report, Error> {
    if is_locked(recorded) {
        return Err(Error::Busy { folder: recorded.to_owned() });
    }
    let path = recorded.join("run.json");
    let record = RunRecord::read(&path).map_err(|source| Error::Record { path, source })?;
    let is_requested = |id: &str| options.only.is_empty() || options.only.iter().any(|only| only == id);
    let mut report = Report::default();
    for family in record.families.iter().filter(|family| is_requested(&family.id)) {
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
    for planned in plan.families.iter().filter(|planned| is_requested(&planned.family.id)) {
        match record.families.iter().find(|family| family.id == planned.family.id) {
            Some(family_record) => {
                check_family(plan, planned, family_record, recorded, options, &mut report, on_event);
            }
            None => report.add_findings(vec![Location::in_family(&planned.family.id).finding(Change::FamilyAdded)]),
        }
    }
    sort_worst_first(&mut report.findings);
    Ok(report)
}

/// Whether a run has locked a folder; the lock file of a run that was killed is not locked.
fn is_locked(folder: &Path) -> bool {
    let lock = File::open(folder.join(LOCK_FILE_NAME));
    lock.is_ok_and(|lock| matches!(lock.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

/// Checks a family, and adds the findings to the report.
fn check_family(
    plan: &Plan,
    planned: &PlannedFamily,
    record: &FamilyRecord,
    recorded: &Path,
    options: &Options,
    report: &mut Report,
    on_event: &mut dyn FnMut(Event),
) {
    // A check is not interrupted.
    let Some(pipeline) = FamilyPipeline::new(plan, planned, &AtomicBool::new(false)) else { return };
    on_event(Event::Begin { family: &planned.family.id, pages: pipeline.pagination.page_count });
    let tolerances = options.tolerances.or(planned.tolerances).or_defaults();
    let mut findings = Vec::new();
    let family_check = FamilyCheck::open(&pipeline, record, recorded, tolerances, &mut findings);
    let (mut changed_cells, mut pages) = (Vec::new(), Vec::new());
    let result = pipeline.run(&family_check, |output| {
        match output {
            Output::Cells(cells) => {
                findings.extend(cells.findings);
                changed_cells.extend(cells.changed_cells);
                report.curves += cells.curve_count;
            }
            Output::Page(page) => {
                pages.push(page);
                on_event(Event::Page);
            }
        }
        Ok::<(), Infallible>(())
    });
    let Ok(()) = result;
    report.families += 1;
    report.pages += pages.len();
    findings.extend(family_check.page_findings(pages, &changed_cells));
    if let Some(script) = record.files.iter().find(|file| file.name == SCRIPT_FILE) {
        findings.extend(gallery::check_file(recorded, &format!("{}/{SCRIPT_FILE}", planned.family.id), script));
    }
    report.add_findings(findings);
    on_event(Event::End);
}
