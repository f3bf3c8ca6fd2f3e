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
mod numbering;
mod outdated;
mod overlays;
mod pages;
mod tables;

pub use error::Error;
pub use finding::{Change, Displacement, Finding, Location};
pub use left_out::LeftOut;
pub use overlays::{Overlay, draw_overlays};

use std::collections::{BTreeMap, HashSet};
use std::fs::TryLockError;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;

use crate::gallery::{KERNEL_FILE, PAGE_FILE, SCRIPT_FILE, is_data_file_name};
use crate::manifest::{PartialTolerances, Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, GroupsDone, Output, page_file_name};
use crate::record::{
    FamilyRecord, FileRecord, FolderRecord, LOCK_FILE_NAME, RUN_FILE_NAME, ReadError, open_regular_file,
};
use coupler_drawing::render::PageFormat;
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
/// The record of the atlas cannot be read, a run is writing to its folder, or the check is interrupted.
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
    report.add_findings(outdated.into_iter().collect());
    report.add_findings(check_origin(&folder_record).into_iter().collect());
    for family in record.families.iter().filter(|family| is_requested(&family.id)) {
        if plan.families.iter().all(|planned| planned.family.id != family.id) {
            report.add_findings(vec![Location::in_family(&family.id).finding(Change::FamilyRemoved)]);
        }
    }
    if options.only.is_empty() && !is_outdated {
        if !left_out.has_images() {
            let volumes = record.book.iter().flat_map(|book| &book.files);
            report.add_findings(volumes.filter_map(|file| images::check_volume(recorded, file)).collect());
            report.add_findings(images::check_images_file(&folder_record).into_iter().collect());
        }
        let check_file = |(name, file): (&str, Option<&FileRecord>)| match file {
            Some(file) if file.name == name && left_out.has_gallery() => None,
            Some(file) if file.name == name => gallery::check_file(recorded, name, file),
            None if folder_record.is_unfinished => None,
            _ => {
                let message = format!("does not list {name}");
                Some(Location::default().with_file(RUN_FILE_NAME).finding(Change::Damaged { message }))
            }
        };
        let files = [(PAGE_FILE, record.gallery.as_ref()), (KERNEL_FILE, record.kernel.as_ref())];
        report.add_findings(files.into_iter().filter_map(check_file).collect());
    }
    for planned in plan.families.iter().filter(|planned| is_requested(&planned.family.id)) {
        match record.families.iter().find(|family| family.id == planned.family.id) {
            Some(family_record) => {
                let family = (planned, family_record);
                check_family(plan, family, (recorded, is_outdated), options, &mut report, on_event)?;
            }
            None => report.add_findings(vec![Location::in_family(&planned.family.id).finding(Change::FamilyAdded)]),
        }
    }
    if report.findings.is_empty() && record.title != plan.title {
        let message = format!("has the title {:?}, expected {:?}", record.title, plan.title);
        report.add_findings(vec![Location::default().with_file(RUN_FILE_NAME).finding(Change::Damaged { message })]);
    }
    sort_worst_first(&mut report.findings);
    Ok(report)
}

/// The finding on a record that is not as this program has written it.
fn check_origin(FolderRecord { run, is_as_written, .. }: &FolderRecord) -> Option<Finding> {
    let message = if !is_as_written {
        format!("{}: `render --repair` rebuilds it", ReadError::Altered)
    } else if run.program != env!("CARGO_PKG_NAME") {
        format!(
            "it was written by {}, not by {}: `render` records the atlas again",
            run.program,
            env!("CARGO_PKG_NAME")
        )
    } else {
        return None;
    };
    Some(Location::default().with_file(RUN_FILE_NAME).finding(Change::Damaged { message }))
}

/// Whether a run has locked a folder; the lock file of a run that was killed is not locked.
fn is_locked(folder: &Path) -> bool {
    let lock = open_regular_file(&folder.join(LOCK_FILE_NAME), u64::MAX);
    lock.is_ok_and(|lock| matches!(lock.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

/// Checks a family, and adds the findings to the report.
///
/// # Errors
/// The check is interrupted.
fn check_family(
    plan: &Plan,
    (planned, record): (&PlannedFamily, &FamilyRecord),
    (recorded, is_outdated): (&Path, bool),
    options: &Options,
    report: &mut Report,
    on_event: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let Some(pipeline) = FamilyPipeline::new(plan, planned, &options.interrupt) else {
        return Err(Error::Interrupted);
    };
    on_event(Event::Begin { family: &planned.family.id, pages: pipeline.pagination.page_count });
    let tolerances = options.tolerances.or(planned.tolerances).or_defaults();
    let mut findings = Vec::new();
    let family_check = FamilyCheck::open(&pipeline, record, (recorded, report.left_out), tolerances, &mut findings);
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
    findings.extend(family_check.page_findings(pages, &changed_cells));
    let data_files = record.files.iter().filter(|file| is_data_file_name(&file.name) && !report.left_out.has_gallery());
    for file in data_files {
        findings.extend(gallery::check_file(recorded, &format!("{}/{}", planned.family.id, file.name), file));
    }
    if is_outdated {
        findings.retain(outdated::is_comparable);
    } else if findings.is_empty() {
        findings.extend(check_counts(&pipeline, record, counts));
    }
    report.add_findings(findings);
    on_event(Event::End);
    Ok(())
}

/// The finding on the record of a family whose files are as recorded, if it does not say what is in them.
fn check_counts(pipeline: &FamilyPipeline, record: &FamilyRecord, counts: CellCounts) -> Option<Finding> {
    let (family, arrangement) = (&pipeline.composer.planned.family, &pipeline.arrangement);
    let location = Location::in_family(&family.id).with_file(RUN_FILE_NAME);
    let message = if record.inputs_sha256.is_none() {
        "does not say that the family is complete"
    } else if [record.cells, record.kept, record.unassembled_left_out]
        != [family.cell_count(), arrangement.kept.len(), arrangement.unassembled_left_out]
    {
        "has another number of cells"
    } else if CellCounts::of_record(record) != counts {
        "has another number of curves, or of cells that are not assembled"
    } else if record.title != family.title {
        "has another title of the family"
    } else if !lists_all_pages(pipeline, record) {
        "does not list all pages of the family"
    } else {
        return None;
    };
    Some(location.finding(Change::Damaged { message: message.to_owned() }))
}

/// Whether the record of a family lists each of its pages in the same formats, and no other pages.
fn lists_all_pages(pipeline: &FamilyPipeline, record: &FamilyRecord) -> bool {
    let page_count = pipeline.pagination.page_count;
    let listed: HashSet<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
    let has_tables = ["cells.csv", "points.csv", SCRIPT_FILE].iter().all(|name| listed.contains(name));
    let data_files = 2 + listed.iter().filter(|name| is_data_file_name(name)).count();
    let page_files: usize = PageFormat::ALL
        .into_iter()
        .map(|format| {
            let is_listed =
                |page: &usize| listed.contains(page_file_name(&record.id, (*page, page_count), format).as_str());
            (1..=page_count).filter(is_listed).count()
        })
        .filter(|&count| count == page_count)
        .sum();
    has_tables && data_files + page_files == record.files.len()
}
