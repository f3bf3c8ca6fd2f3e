//! Draws a part of the pages of an atlas, so that several machines can share them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::family::initial_record;
use super::files;
use super::inputs::Inputs;
use super::journal::JournalFile;
use super::lock::Lock;
use super::pages::OutputSink;
use super::previous_run::{self, PreviousRun};
use super::registry::FileRegistry;
use super::{Error, Event, Options, check_interrupt, ownership};
use crate::gallery::FamilyScript;
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, page_file_name};
use crate::record::{CellTable, FileRecord, JournalEntry, PageShardHead, PageShardRecord, RunRecord};
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

/// Draws a part of the pages of each family into the folder of an atlas, and records them in a journal of its own. Pages that
/// are up to date are kept. Other shards may be drawn into the folder at the same time. Returns the number of pages of the
/// shard, and how many of them were drawn.
///
/// # Errors
/// As [`super::write_atlas`].
pub fn write_page_shard(
    (plan, manifest): (&Plan, &str),
    output: &Path,
    options: &Options,
    division: Division,
    report: &mut dyn FnMut(Event),
) -> Result<(usize, usize), Error> {
    files::create_folder(output)?;
    let name = |extension: &str| output.join(format!("{}{}{extension}", JOURNAL_AFFIXES.0, division.label(0)));
    let _lock = Lock::wait_for(name(".lock"))?;
    let mut previous = previous_run::read(output, options, report)?;
    ownership::check_owner(plan, output, options, &previous)?;
    let path = name(JOURNAL_AFFIXES.1);
    let mut own = None;
    for shard in page_shards(output)? {
        if shard.path == path {
            own = Some(shard.record.run.clone());
        }
        previous.add_pages(shard.record.run);
    }
    let formats = options.formats.as_ref();
    let head = PageShardHead {
        division,
        formats: formats.map(|formats| formats.iter().map(|format| format.name().to_owned()).collect()),
    };
    let journal = JournalFile::begin(path, initial_entries((plan, manifest), options, head, own))?;
    let (mut pages, mut drawn) = (0, 0);
    for (k, planned) in plan.families.iter().enumerate() {
        check_interrupt(&options.interrupt)?;
        let shard = FamilyPages { plan, planned, output, options, journal: &journal };
        let (of_family, drawn_of_family) = shard.draw(division.shifted(k), &previous, report)?;
        pages += of_family;
        drawn += drawn_of_family;
    }
    journal.append(&JournalEntry::Finished)?;
    Ok((pages, drawn))
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
    let atlas = JournalEntry::Atlas(RunRecord::new(options.manifest.as_deref(), &plan.title));
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
        let formats = options.formats.as_ref().unwrap_or(&planned.formats);
        let formats: Vec<PageFormat> = formats.iter().copied().filter_map(Format::page_format).collect();
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
            let page = (page + 1, pipeline.pagination.page_count);
            formats.iter().map(move |&format| page_file_name(&family.id, page, format))
        });
        self.check_files(&folder, page_files, &known)?;
        files::create_folder(&folder)?;
        self.journal.append(&JournalEntry::Family(initial_record(&pipeline)))?;
        let registry = FileRegistry::new(&family.id, &folder, &known, self.journal);
        let sink = OutputSink {
            composer: &pipeline.composer,
            formats: &formats,
            inputs: Inputs::new(planned),
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
        let is_foreign = |path: &PathBuf| fs::symlink_metadata(path).is_ok();
        let names = names.filter(|name| !self.options.overwrite && !known.contains(name.as_str()));
        let mut foreign = names.map(|name| folder.join(name)).filter(is_foreign);
        match foreign.next() {
            Some(first) => Err(Error::ForeignFile { first, others: foreign.count() }),
            None => Ok(()),
        }
    }
}
