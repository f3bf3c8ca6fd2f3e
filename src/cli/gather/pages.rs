//! Completes atlases whose pages shards have drawn.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::output::{self, PageShard};
use crate::record::{FolderRecord, PageShardHead, PageShardRecord, RunRecord};
use crate::sweep::{Division, number_ranges};
use coupler_drawing::render::Format;

use super::super::{Failure, print_stderr, printable, render, source};

/// Whether a folder has a whole atlas.
pub(super) fn has_atlas(folder: &Path) -> bool {
    let is_whole = |record: FolderRecord| {
        let families = &record.run.families;
        !record.is_unfinished && !families.is_empty() && families.iter().all(|family| family.inputs_sha256.is_some())
    };
    FolderRecord::read(folder).is_ok_and(is_whole)
}

/// Checks that all pages of an atlas are drawn, and writes what they have in common.
pub(super) fn complete(folder: &Path, shards: &[PageShard], is_quiet: bool) -> Result<(), Failure> {
    let name = printable(folder.display());
    check_origin(&name, shards)?;
    let PageShardRecord { head: PageShardHead { formats, .. }, manifest, .. } = &shards[0].record;
    let path = manifest_path(folder, shards);
    let source = source::with_text(&path, manifest.clone()).map_err(|failure| match failure.is_input() {
        false => failure,
        true => Failure::input(format!(
            "{failure}: the text is that of the manifest of the shards, and the files that it names are looked for beside {}; complete \
             the atlas with `coupler-atlas render MANIFEST -o {name}`, wherever the manifest is now",
            printable(path.display())
        )),
    })?;
    // Shards of a complete atlas that were drawn again need no others.
    if !output::has_atlas_of(&source.plan, folder) {
        check_complete(&name, shards, is_quiet)?;
    }
    let parse = |names: &Vec<String>| names.iter().map(|name| render::parse_format(name)).collect();
    let formats: Option<Result<Vec<Format>, String>> = formats.as_ref().map(parse);
    let formats = formats.transpose().map_err(Failure::input)?;
    render::complete(&source, folder, formats, is_quiet)
}

/// Checks that the shards are of one manifest.
fn check_origin(name: &str, shards: &[PageShard]) -> Result<(), Failure> {
    let PageShardRecord { head: PageShardHead { formats, .. }, manifest, run, .. } = &shards[0].record;
    let is_same = |shard: &PageShard| {
        let PageShardRecord { head, manifest: own, run: own_run, .. } = &shard.record;
        own == manifest
            && head.formats == *formats
            && (&own_run.version, &own_run.manifest) == (&run.version, &run.manifest)
    };
    let Some(other) = shards.iter().find(|shard| !is_same(shard)) else { return Ok(()) };
    let [first, other] = [&shards[0], other].map(|shard| shard.record.head.division);
    Err(Failure::input(format!(
        "{name}: {first} and {other} are of different manifests, formats or versions of the program: draw them again, {}",
        at_once(name)
    )))
}

/// What draws all that is missing.
fn at_once(name: &str) -> String {
    format!("or all that is missing in one run, with `coupler-atlas render MANIFEST -o {name}`")
}

/// Checks that the shards of one number are all complete. What is left of other numbers is not needed, for any of them are all
/// pages.
fn check_complete(name: &str, shards: &[PageShard], is_quiet: bool) -> Result<(), Failure> {
    let at_once = at_once(name);
    // For each number of shards the indices of those that are complete.
    let mut finished: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for (shard, (index, of)) in shards.iter().filter_map(|shard| Some((shard, parts(shard)?))) {
        let complete = finished.entry(of).or_default();
        complete.extend(shard.record.is_finished.then_some(index));
    }
    let is_complete = |(of, indices): (&usize, &BTreeSet<usize>)| indices.len() == *of;
    if let Some((of, _)) = finished.iter().find(|entry| is_complete(*entry)) {
        if finished.len() > 1 && !is_quiet {
            print_stderr(&format!(
                "note: {name}: all {of} shards of pages are complete; those of other numbers are not needed\n"
            ));
        }
        return Ok(());
    }
    let message = if let (1, Some((of, indices))) = (finished.len(), finished.first_key_value()) {
        let missing: Vec<usize> = (0..*of).filter(|index| !indices.contains(index)).collect();
        let first = missing.first().copied().unwrap_or(0);
        format!(
            "{name}: of {of} shards of pages these are not complete: {}; draw them with `coupler-atlas render MANIFEST --shard \
             {first}/{of}` and so on, {at_once}",
            number_ranges(&missing)
        )
    } else {
        let missing = |(of, indices): (&usize, &BTreeSet<usize>)| {
            let missing: Vec<usize> = (0..*of).filter(|index| !indices.contains(index)).collect();
            format!("of {of} these are not complete: {}", number_ranges(&missing))
        };
        let missing: Vec<String> = finished.iter().map(missing).collect();
        format!(
            "{name}: pages are drawn in different numbers of shards, and {}: draw those of one number, {at_once}",
            missing.join(", and ")
        )
    };
    Err(Failure::input(message))
}

/// The path of the manifest of shards: where it is now, if any of them says so.
fn manifest_path(folder: &Path, shards: &[PageShard]) -> PathBuf {
    let place = |shard: &PageShard| {
        let name = shard.record.run.manifest.as_deref().unwrap_or(RunRecord::STANDARD_INPUT);
        folder.join(shard.record.head.manifest_folder.as_deref().unwrap_or_default()).join(name)
    };
    let places: Vec<PathBuf> = shards.iter().map(place).collect();
    places.iter().find(|path| path.is_file()).or(places.first()).cloned().unwrap_or_default()
}

/// The index of a shard, and the number of them.
fn parts(shard: &PageShard) -> Option<(usize, usize)> {
    match shard.record.head.division {
        Division::Shard { index, of } => Some((index, of)),
        Division::Cells { .. } => None,
    }
}
