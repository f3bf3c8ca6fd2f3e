//! Compares a fresh run of a manifest with a recorded atlas: what has changed, where and by how much.
//!
//! The manifest is run again in memory, and its output compared with the recorded tables and pages: first byte by byte,
//! and where the bytes differ, number by number. The recorded atlas is not trusted: invalid files lead to findings,
//! never to a panic, and memory stays bounded.

mod cells;
mod curve;
mod curve_samples;
mod drawn_curves;
mod error;
mod family;
mod finding;
mod gallery;
mod hausdorff;
mod images;
mod left_out;
mod matching;
mod measures;
mod numbering;
mod outdated;
mod overlays;
mod pages;
mod run_record;
mod tables;

pub use error::Error;
pub use finding::{Change, Displacement, Finding, Location};
pub use left_out::LeftOut;
pub use overlays::{Overlay, draw_overlays};

use std::collections::BTreeMap;
use std::fs::TryLockError;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;

use crate::gallery::{KERNEL_FILE, PAGE_FILE, is_data_file_name};
use crate::manifest::{PartialTolerances, Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, GroupsDone, Output};
use crate::record::{FamilyRecord, FileRecord, FolderRecord, LOCK_FILE_NAME, RUN_FILE_NAME, open_regular_file};
use family::{CellCounts, FamilyCheck};

/// The families to check, and the tolerances.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The ids of the families to check; all if empty.
    pub only: Vec<String>,
    /// Tolerances that replace those of the manifest.
    pub tolerances: PartialTolerances,
    /// Set to true to end the check soon.
    pub interrupt: Arc<AtomicBool>,
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
    /// A page was checked.
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
    /// What the folder leaves out, and was not compared.
    pub left_out: LeftOut,
    /// The number of findings of each kind.
    pub counts: BTreeMap<&'static str, usize>,
    /// The findings, the worst first; at most 20,000 of each family.
    pub findings: Vec<Finding>,
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
/// The record of the atlas cannot be read, the system fails to read another of its files, a run is writing to its folder, or the check is interrupted.
pub fn check_atlas(
    plan: &Plan,
    recorded: &Path,
    options: &Options,
    on_event: &mut dyn FnMut(Event),
) -> Result<Report, Error> {
    if is_locked(recorded) {
        return Err(Error::Busy { folder: recorded.to_owned() });
    }
    let path = recorded.join(RUN_FILE_NAME);
    let folder_record = FolderRecord::read_altered(recorded).map_err(|source| Error::Record { path, source })?;
    let record = &folder_record.run;
    let is_requested = |id: &str| options.only.is_empty() || options.only.iter().any(|only| only == id);
    let left_out = LeftOut::of(&folder_record, recorded, &options.only);
    let mut report = Report { left_out, ..Report::default() };
    let outdated = outdated::check_version(record);
    let is_outdated = outdated.is_some();
    let other_version = is_outdated.then_some(record.version.as_str());
    report.add_findings(outdated.into_iter().collect());
    report.add_findings(run_record::check_origin(&folder_record).into_iter().collect());
    for family in record.families.iter().filter(|family| is_requested(&family.id)) {
        if plan.families.iter().all(|planned| planned.family.id != family.id) {
            report.add_findings(vec![Location::in_family(&family.id).finding(Change::FamilyRemoved)]);
        }
    }
    if options.only.is_empty() && !is_outdated {
        if !left_out.leaves_images() {
            let volumes = record.book.iter().flat_map(|book| &book.files);
            for file in volumes {
                report.add_findings(images::check_volume(recorded, file)?.into_iter().collect());
            }
            report.add_findings(images::check_images_file(&folder_record).into_iter().collect());
        }
        let check_file = |(name, file): (&str, Option<&FileRecord>)| match file {
            Some(file) if file.name == name && left_out.leaves_gallery() => Ok(None),
            Some(file) if file.name == name => gallery::check_file(recorded, name, file),
            None if folder_record.is_unfinished => Ok(None),
            _ => {
                let message = format!("does not list {name}");
                Ok(Some(Location::default().with_file(RUN_FILE_NAME).finding(Change::Damaged { message })))
            }
        };
        let files = [(PAGE_FILE, record.gallery.as_ref()), (KERNEL_FILE, record.kernel.as_ref())];
        for file in files {
            report.add_findings(check_file(file)?.into_iter().collect());
        }
    }
    let mut other_inputs = Vec::new();
    for planned in plan.families.iter().filter(|planned| is_requested(&planned.family.id)) {
        match record.families.iter().find(|family| family.id == planned.family.id) {
            Some(family_record) => {
                let family = (planned, family_record);
                let finding = check_family(plan, family, (recorded, other_version), options, &mut report, on_event)?;
                other_inputs.extend(finding);
            }
            None => report.add_findings(vec![Location::in_family(&planned.family.id).finding(Change::FamilyAdded)]),
        }
    }
    if report.findings.is_empty() {
        report.add_findings(other_inputs);
        report.add_findings(run_record::check_atlas(plan, record).into_iter().collect());
    }
    sort_worst_first(&mut report.findings);
    Ok(report)
}

/// Whether a run has locked a folder; the lock file of a run that was killed is not locked.
fn is_locked(folder: &Path) -> bool {
    let lock = open_regular_file(&folder.join(LOCK_FILE_NAME), u64::MAX);
    lock.is_ok_and(|lock| matches!(lock.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

/// Checks a family, adds the findings to the report, and returns the one on its inputs, which counts if there is no other.
///
/// # Errors
/// The check is interrupted, or the system fails to read a file.
fn check_family(
    plan: &Plan,
    (planned, record): (&PlannedFamily, &FamilyRecord),
    (recorded, other_version): (&Path, Option<&str>),
    options: &Options,
    report: &mut Report,
    on_event: &mut dyn FnMut(Event),
) -> Result<Option<Finding>, Error> {
    let Some(pipeline) = FamilyPipeline::new(plan, planned, &options.interrupt) else {
        return Err(Error::Interrupted);
    };
    on_event(Event::Begin { family: &planned.family.id, pages: pipeline.pagination.page_count });
    let tolerances = options.tolerances.clone().or(planned.tolerances.clone()).or_defaults();
    let mut findings = Vec::new();
    let family_check = FamilyCheck::open(&pipeline, record, (recorded, report.left_out), tolerances, &mut findings)?;
    let (mut changed_cells, mut pages) = (Vec::new(), Vec::new());
    let mut counts = CellCounts::default();
    pipeline.run(&family_check, GroupsDone::default(), |output| {
        if options.interrupt.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        match output {
            Output::Cells(cells) => {
                findings.extend(cells.findings);
                changed_cells.extend(cells.changed_cells);
                report.curves += cells.curve_count;
                counts += cells.counts;
            }
            Output::Page(page) => {
                pages.push(page);
                on_event(Event::Page);
            }
            Output::Done(_) => {}
        }
        Ok(())
    })?;
    report.families += 1;
    report.pages += pages.len();
    let other_inputs: Vec<String> = pages.iter_mut().flat_map(|page| std::mem::take(&mut page.other_inputs)).collect();
    findings.extend(family_check.page_findings(pages, &changed_cells));
    let data_files =
        record.files.iter().filter(|file| is_data_file_name(&file.name) && !report.left_out.leaves_gallery());
    for file in data_files {
        findings.extend(gallery::check_file(recorded, &format!("{}/{}", planned.family.id, file.name), file)?);
    }
    if let Some(version) = other_version {
        findings.retain(|finding| outdated::is_comparable(finding, version));
    } else if findings.is_empty() {
        findings.extend(run_record::check_family(&pipeline, record, counts));
    }
    report.add_findings(findings);
    on_event(Event::End);
    Ok(run_record::check_inputs(planned, record, &other_inputs))
}
