//! Writes the atlas of a [`Plan`]: names the files, writes each atomically, and keeps those that are up to date.

#[cfg(feature = "pdf")]
mod book;
mod composed_page;
mod error;
mod family;
mod family_writer;
mod files;
mod initial_record;
mod journal;
mod lock;
mod options;
mod ownership;
mod page_shard;
mod pages;
mod previous_run;
mod registry;
mod repair;
mod scale;
mod survey;
mod table_file;
mod temporary;

pub use composed_page::ComposedPage;
pub use error::{Error, is_wrong_input};
pub(crate) use files::{AtomicFile, open_regular};
pub use files::{create_folder, read_bytes, read_text, write as write_file, write_new};
pub(crate) use lock::Lock;
pub use options::{Event, Options};
pub use page_shard::{DrawnPages, PageShard, PageShardSource, has_atlas_of, page_shards, write_page_shard};
pub(crate) use temporary::remove as remove_temporary;
pub use temporary::take_leftovers;

pub use crate::pipeline::{cells_solved_for_page, known_page_count};

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use crate::manifest::{Plan, PlannedFamily};
use crate::record::RunRecord;
use crate::sweep::{self, Division};
use coupler_curves::problem::Problem;
use journal::Journal;
use options::check_interrupt;
use previous_run::PreviousRun;
use survey::{FamilySurvey, Surveyor};

/// The folder of the atlas of a manifest where none is named: that of the manifest, relative to it, or its path without the extension; `None`
/// if it has neither.
pub fn default_folder(plan: &Plan, manifest: &Path) -> Option<PathBuf> {
    match &plan.output {
        Some(output) => Some(manifest.parent().unwrap_or(Path::new("")).join(output)),
        None => Some(manifest.with_extension("")).filter(|stem| stem != manifest),
    }
}

/// What to do about a manifest that [`default_folder`] finds no folder for.
pub fn no_folder_message(manifest: &Path) -> String {
    format!(
        "{} has no extension, without which it would name the folder to write to: add `output = \"…\"` to [atlas], \
         or name a folder with -o",
        manifest.display()
    )
}

/// Writes the atlas of a plan into a folder, and reports progress.
///
/// Files of an earlier run are kept if they are up to date according to its record. Files which that run wrote and
/// which no longer belong to the atlas are removed; other files never are. So are pages that shards have drawn, see
/// [`write_page_shard`], whose journals are removed.
///
/// Every file is written under a temporary name and renamed. When the disk has all of them, `run.json` is. Whatever goes
/// wrong, each file in the folder is complete, old or new, and the record claims nothing that is not true.
///
/// With [`Options::repair`], a record that is lost or damaged is rebuilt first.
///
/// # Errors
/// A file cannot be written; the record of an earlier run is needed and cannot be read, or has another format; the folder
/// has the atlas of another manifest, or files that no earlier run wrote; another run writes to the same folder; the run
/// is interrupted. Finished files are recorded, and the next run continues from there.
pub fn write_atlas(
    plan: &Plan,
    output: &Path,
    options: &Options,
    report: &mut dyn FnMut(Event),
) -> Result<RunRecord, Error> {
    files::create_folder(output)?;
    let _lock = Lock::acquire(output)?;
    // A folder that is not ours is left untouched.
    let recovered = match options.repair {
        true => repair::recover(output, options, report, |folder, options, report| {
            write_atlas(plan, folder, options, report)
        })?,
        false => None,
    };
    let is_recovered = recovered.is_some();
    let mut previous = match recovered {
        Some(recovered) => recovered,
        None => previous_run::read(output, options, report)?,
    };
    // The pages of shards belong to the atlas as a whole.
    let shards = if options.only.is_empty() { page_shards(output)? } else { Vec::new() };
    let journals: Vec<PathBuf> = shards.iter().map(|shard| shard.path.clone()).collect();
    shards.into_iter().for_each(|shard| previous.add_pages(shard.record.run));
    ownership::check_owner(plan, output, options, &previous)?;
    if let Err(error) = ownership::check_files(plan, output, options, &previous) {
        if is_recovered {
            // What is known is recorded, so that the next run needs no repair.
            Journal::open(plan, output, options, previous).close()?;
        }
        return Err(error);
    }
    let result = write_families(plan, output, options, previous, report);
    if let Err(error) = &result {
        journal::suspend(output, matches!(error, Error::Interrupted));
    }
    if let Err(Error::Misfits(problems)) = &result
        && problems.is_empty()
    {
        let selected = plan.families.iter().filter(|planned| options.includes(planned));
        scale::explain(plan, selected.map(|planned| (planned, Division::WHOLE)), options)?;
    }
    let run = result?;
    for path in journals {
        std::fs::remove_file(&path).map_err(|source| Error::Write { path: path.clone(), source })?;
    }
    Ok(run)
}

/// Writes the atlas into a folder that may be written to.
fn write_families(
    plan: &Plan,
    output: &Path,
    options: &Options,
    previous: PreviousRun,
    report: &mut dyn FnMut(Event),
) -> Result<RunRecord, Error> {
    let resumable: HashSet<String> = previous.progress.iter().map(|progress| progress.family.clone()).collect();
    files::remove_temporary_files(output, &|family| resumable.contains(family));
    let mut journal = Journal::open(plan, output, options, previous);
    #[cfg(feature = "pdf")]
    let is_surveyed = book::families_to_survey(plan, output, options, &journal);
    #[cfg(not(feature = "pdf"))]
    let is_surveyed = vec![false; plan.families.len()];
    let mut surveys: Vec<Option<FamilySurvey>> = plan.families.iter().map(|_| None).collect();
    let families = plan.families.iter().enumerate().zip(is_surveyed).zip(&mut surveys);
    for (((number, planned), is_surveyed), survey) in
        families.filter(|(((_, planned), _), _)| options.includes(planned))
    {
        check_interrupt(&options.interrupt)?;
        let surveyor = is_surveyed.then(|| Surveyor::new(planned, &plan.book, number));
        *survey = family::write((plan, planned), output, options, (&mut journal, surveyor), report)?;
    }
    if options.only.is_empty() {
        journal.remove_unplanned_families(report)?;
    }
    // A build without PDF leaves the book of another as it is.
    #[cfg(feature = "pdf")]
    book::write(plan, output, options, (&mut journal, surveys), report)?;
    journal.write_gallery()?;
    if !resumable.is_empty() {
        // Tables of an earlier run that this one did not continue.
        files::remove_temporary_files(output, &|_| false);
    }
    journal.close()
}

/// The problems of families whose linkages do not fit their pages at the scale that the manifest gives, each with what to do about it.
pub fn scale_problems(plan: &Plan) -> Vec<Problem> {
    let never = AtomicBool::new(false);
    let problem = |planned: &PlannedFamily| {
        scale::scale_problem(plan, planned, (&planned.formats, Division::WHOLE), &never).ok().flatten()
    };
    plan.families.iter().filter_map(problem).collect()
}

/// Warns of each family of which no curve is shown, because `where` keeps no cell or none can be assembled: from the
/// record of a run, or by a sweep if there is none. States how near its cells come.
pub fn empty_family_warnings(plan: &Plan, record: Option<&RunRecord>) -> Vec<Problem> {
    let is_empty = |planned: &PlannedFamily| match record {
        None if planned.family.filter.is_some() => sweep::kept_cells(&planned.family).is_empty(),
        None => !sweep::has_curve(&planned.family),
        Some(run) => run.families.iter().any(|record| record.id == planned.family.id && record.curves == 0),
    };
    plan.families.iter().filter(|planned| is_empty(planned)).map(empty_family_warning).collect()
}

/// Warns of a family of which no curve is shown, and states how near its cells come.
pub fn empty_family_warning(planned: &PlannedFamily) -> Problem {
    let family = &planned.family;
    let span = planned.filter_span.clone().unwrap_or_else(|| planned.span.clone());
    let cells = family.cell_count();
    let diagnosis = sweep::diagnose(family, 0..cells);
    let is_unassembled = diagnosis.unassembled == cells && (family.filter.is_none() || family.filter_uses_measures());
    let (message, remedy) = match (is_unassembled, cells) {
        (true, 1) => ("the only cell cannot be assembled".to_owned(), "change the lengths"),
        (true, _) => (format!("none of the {cells} cells can be assembled"), "change the lengths"),
        (false, 1) => ("`where` does not keep the only cell".to_owned(), "relax the condition"),
        (false, _) => (format!("`where` keeps none of the {cells} cells"), "relax the condition"),
    };
    let found = diagnosis.describe(cells);
    let help = if found.is_empty() { remedy.to_owned() } else { format!("{remedy}: {found}") };
    Problem::warning(span, message).with_help(help)
}
