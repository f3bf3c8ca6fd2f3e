//! Draws a part of the pages of an atlas, so that several machines can share them.

use std::io;
use std::path::{Component, Path, PathBuf};

use super::files;
use super::initial_record::initial_record;
use super::journal::JournalFile;
use super::lock::Lock;
use super::pages::OutputSink;
use super::previous_run::{self, PreviousRun};
use super::registry::FileRegistry;
use super::{Error, Event, Options, check_interrupt, ownership, scale};
use crate::gallery::FamilyScript;
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, Inputs, page_file_name};
use crate::record::{CellTable, FileRecord, FolderRecord, JournalEntry, PageShardHead, PageShardRecord, RunRecord};
use crate::sweep::Division;
use coupler_curves::exchange::PointTable;
use coupler_drawing::render::{Format, PageFormat};

/// A shard of the pages of an atlas.
#[derive(Debug)]
pub struct PageShard {
    /// Its journal.
    pub path: PathBuf,
    /// What it records.
    pub record: PageShardRecord,
}

/// The beginning and the end of the names of the journals of shards.
const JOURNAL_AFFIXES: (&str, &str) = (".coupler-atlas-", ".journal");

/// The most characters of a manifest in a line of a journal.
const MANIFEST_PART: usize = 1 << 16;

/// The shards that have been drawn into a folder, in order of the names of their journals.
///
/// # Errors
/// A journal cannot be read.
pub fn page_shards(output: &Path) -> Result<Vec<PageShard>, Error> {
    let is_journal = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with(JOURNAL_AFFIXES.0) && name.ends_with(JOURNAL_AFFIXES.1)
    };
    let mut paths: Vec<PathBuf> = files::entries(output).map(|entry| entry.path()).filter(is_journal).collect();
    paths.sort();
    let mut found = Vec::new();
    for path in paths {
        match PageShardRecord::read(&path) {
            Ok(record) => found.extend(record.map(|record| PageShard { path, record })),
            // Another run has just removed it.
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(source) => return Err(Error::Read { path, source }),
        }
    }
    Ok(found)
}

/// The manifest of a shard of pages.
#[derive(Clone, Copy, Debug)]
pub struct PageShardSource<'a> {
    /// Its plan.
    pub plan: &'a Plan,
    /// Its text.
    pub text: &'a str,
    /// Its folder, in which the files are that it names.
    pub folder: &'a Path,
}

/// What a run has drawn of a shard of pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawnPages {
    /// The pages of the shard.
    pub pages: usize,
    /// Those that were drawn, for they were not up to date.
    pub drawn: usize,
    /// Whether the folder has the whole atlas already, so that there is nothing to complete.
    pub is_atlas_complete: bool,
}

/// Draws a part of the pages of each family into the folder of an atlas, and records them in a journal of its own. Pages that
/// are up to date are kept. Other shards may be drawn into the folder at the same time. If the folder has the whole atlas, as
/// when a shard is drawn again after all were gathered, nothing is recorded.
///
/// # Errors
/// As [`super::write_atlas`].
pub fn write_page_shard(
    source: PageShardSource,
    output: &Path,
    options: &Options,
    division: Division,
    report: &mut dyn FnMut(Event),
) -> Result<DrawnPages, Error> {
    let plan = source.plan;
    files::create_folder(output)?;
    let name = |extension: &str| output.join(format!("{}{}{extension}", JOURNAL_AFFIXES.0, division.label(0)));
    let _lock = Lock::wait_for(name(".lock"))?;
    let mut previous = previous_run::read(output, options, report)?;
    ownership::check_owner(plan, output, options, &previous)?;
    let path = name(JOURNAL_AFFIXES.1);
    let shards = page_shards(output)?;
    if shards.is_empty()
        && let Some(pages) = pages_of_complete_atlas(plan, output, options, (division, &previous))
    {
        return Ok(DrawnPages { pages, drawn: 0, is_atlas_complete: true });
    }
    let mut own = None;
    for shard in shards {
        if shard.path == path {
            own = Some(shard.record.run.clone());
        }
        previous.add_pages(shard.record.run);
    }
    let formats = options.formats.as_ref().map(|formats| {
        let mut names: Vec<String> = formats.iter().map(|format| format.name().to_owned()).collect();
        names.sort();
        names.dedup();
        names
    });
    let manifest_folder = relative_path(output, source.folder);
    let head = PageShardHead { division, formats, manifest_folder };
    for folder in plan.families.iter().map(|planned| output.join(&planned.family.id)) {
        if options.overwrite {
            ownership::remove_link(&folder)?;
        } else if ownership::is_link(&folder) {
            return Err(Error::ForeignFile { first: folder, others: 0 });
        }
    }
    let journal = JournalFile::begin(path, initial_entries((plan, source.text), options, head, own))?;
    let (mut pages, mut drawn) = (0, 0);
    for (k, planned) in plan.families.iter().enumerate() {
        check_interrupt(&options.interrupt)?;
        let shard = FamilyPages { plan, planned, output, options, journal: &journal };
        let result = shard.draw(division.shifted(k), &previous, report);
        if let Err(Error::Misfits(_)) = &result {
            let parts = plan.families.iter().enumerate().map(|(k, planned)| (planned, division.shifted(k)));
            scale::explain(plan, parts, options)?;
        }
        let (of_family, drawn_of_family) = result?;
        pages += of_family;
        drawn += drawn_of_family;
    }
    journal.append(&JournalEntry::Finished)?;
    Ok(DrawnPages { pages, drawn, is_atlas_complete: false })
}

/// The formats of the pages of a family; a book has none.
fn page_formats(planned: &PlannedFamily, options: &Options) -> Vec<PageFormat> {
    let formats = options.formats.as_ref().unwrap_or(&planned.formats);
    formats.iter().copied().filter_map(Format::page_format).collect()
}

/// Whether a folder has a whole atlas, made from this plan by this version of the program, as far as its record says: files may
/// have been changed since, and other families added.
pub fn has_atlas_of(plan: &Plan, folder: &Path) -> bool {
    let is_made = |run: &RunRecord, planned: &PlannedFamily| {
        let record = run.families.iter().find(|record| record.id == planned.family.id);
        record.is_some_and(|record| record.inputs_sha256 == Some(Inputs::new(planned).family_digest()))
    };
    FolderRecord::read(folder).is_ok_and(|FolderRecord { run, is_unfinished, .. }| {
        !is_unfinished && plan.families.iter().all(|planned| is_made(&run, planned))
    })
}

/// The number of pages of a shard if the folder has the whole atlas, and the pages of the shard are intact; the others are not
/// read, for many shards may be drawn again.
fn pages_of_complete_atlas(
    plan: &Plan,
    output: &Path,
    options: &Options,
    (division, previous): (Division, &PreviousRun),
) -> Option<usize> {
    let is_bound = |planned: &PlannedFamily| {
        options.formats.as_ref().unwrap_or(&planned.formats).contains(&Format::Pdf) && previous.book.is_none()
    };
    if options.force
        || !previous.progress.is_empty()
        || previous.families.len() != plan.families.len()
        || plan.families.iter().any(is_bound)
    {
        return None;
    }
    let mut pages = 0;
    for (k, planned) in plan.families.iter().enumerate() {
        let id = &planned.family.id;
        let record = previous.families.iter().find(|record| record.id == *id)?;
        let formats = page_formats(planned, options);
        let own = division.shifted(k).range(if formats.is_empty() { 0 } else { record.pages });
        pages += own.len();
        let inputs = Inputs::new(planned).family_digest();
        if !previous_run::has_pages(record, inputs, (own, &formats), &output.join(id)) {
            return None;
        }
    }
    Some(pages)
}

/// The path that leads from one existing folder to another, so that both may be moved together; the other's own path if
/// there is none, as from one drive to another. `None` if a folder cannot be read, or its name is not Unicode.
fn relative_path(from: &Path, to: &Path) -> Option<String> {
    let to = if to.as_os_str().is_empty() { Path::new(".") } else { to };
    let (from, to) = (from.canonicalize().ok()?, to.canonicalize().ok()?);
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let path = match common {
        0 => to,
        _ => {
            let up = from.components().skip(common).map(|_| Component::ParentDir);
            up.chain(to.components().skip(common)).collect()
        }
    };
    Some(path.to_str()?.to_owned())
}

/// The first lines of a journal: what the shard is, and the files that an earlier run of it has written.
fn initial_entries(
    (plan, manifest): (&Plan, &str),
    options: &Options,
    head: PageShardHead,
    own: Option<RunRecord>,
) -> impl Iterator<Item = JournalEntry> {
    let characters: Vec<char> = manifest.chars().collect();
    let parts: Vec<JournalEntry> =
        characters.chunks(MANIFEST_PART).map(|part| JournalEntry::Manifest(part.iter().collect())).collect();
    let atlas = JournalEntry::Atlas(Box::new(RunRecord::new(options.manifest.as_deref(), &plan.title)));
    let families = own.map(|run| run.families).unwrap_or_default().into_iter().flat_map(|family| {
        let files = family.files.clone().into_iter().map({
            let id = family.id.clone();
            move |file| JournalEntry::written(&id, file)
        });
        std::iter::once(JournalEntry::Family(family.without_files())).chain(files)
    });
    [atlas, JournalEntry::Shard(head)].into_iter().chain(parts).chain(families)
}

/// The pages of a family in a shard.
struct FamilyPages<'a> {
    plan: &'a Plan,
    planned: &'a PlannedFamily,
    output: &'a Path,
    options: &'a Options,
    journal: &'a JournalFile,
}

impl FamilyPages<'_> {
    fn draw(
        &self,
        division: Division,
        previous: &PreviousRun,
        report: &mut dyn FnMut(Event),
    ) -> Result<(usize, usize), Error> {
        let FamilyPages { plan, planned, options, .. } = *self;
        let family = &planned.family;
        let folder = self.output.join(&family.id);
        let formats = page_formats(planned, options);
        let pipeline = FamilyPipeline::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
        let pages = division.range(pipeline.pagination.page_count);
        if pages.is_empty() || formats.is_empty() {
            return Ok((0, 0));
        }
        report(Event::Begin { family: &family.id, pages: pages.len() });
        let record = previous.families.iter().find(|record| record.id == family.id);
        let mut known = record.map(|record| record.files.clone()).unwrap_or_default();
        if options.force {
            known.iter_mut().for_each(|file| *file = FileRecord::from_name(&file.name));
        }
        let page_files = pages.clone().flat_map(|page| {
            let of = pipeline.pagination.page_count;
            formats.iter().map(move |&format| page_file_name(&family.id, page + 1, of, format))
        });
        self.check_files(&folder, page_files, &known)?;
        files::create_folder(&folder)?;
        self.journal.append(&JournalEntry::Family(initial_record(&pipeline)))?;
        let registry = FileRegistry::new(&family.id, &folder, &known, self.journal);
        let sink = OutputSink {
            composer: &pipeline.composer,
            formats: &formats,
            tables: (PointTable::new(family), CellTable::new(family)),
            script: FamilyScript::new(plan, planned),
            registry: &registry,
            interrupt: &options.interrupt,
            // The book is composed when all shards are drawn.
            surveyor: None,
        };
        let mut drawn = 0;
        pipeline.run_pages(&sink, pages.clone(), |page| {
            drawn += usize::from(page.is_drawn);
            // Those that were drawn are in the journal.
            for file in page.files.into_iter().filter(|_| !page.is_drawn) {
                self.journal.append(&JournalEntry::written(&family.id, file))?;
            }
            report(Event::Page);
            Ok(())
        })?;
        Ok((pages.len(), drawn))
    }

    /// Checks that no file of a page exists, unless an earlier run wrote it.
    fn check_files(
        &self,
        folder: &Path,
        names: impl Iterator<Item = String>,
        known: &[FileRecord],
    ) -> Result<(), Error> {
        let known: std::collections::HashSet<&str> = known.iter().map(|file| file.name.as_str()).collect();
        let mut foreign = names.filter(|_| !self.options.overwrite).filter_map(|name| {
            let path = folder.join(&name);
            ownership::is_foreign(&path, known.contains(name.as_str())).then_some(path)
        });
        match foreign.next() {
            Some(first) => Err(Error::ForeignFile { first, others: foreign.count() }),
            None => Ok(()),
        }
    }
}
