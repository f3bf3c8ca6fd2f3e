//! Checks that shards are of one manifest, and that each cell is in one of them.

use std::collections::{BTreeMap, BTreeSet};

use coupler_curves::family::Family;
use rayon::prelude::*;

use super::super::problem::FileProblem;
use super::super::read::ShardFile;
use super::super::record::{ShardRecord, TableKind, Top, column_difference};
use super::super::{Division, table};
use crate::sweep::{MAX_RANGES, number_ranges};

/// Checks that all files are of one manifest and version, and have the best by the same expression.
pub(super) fn check_origin(files: &[ShardFile], problems: &mut Vec<String>) {
    let mut origins: BTreeMap<_, Vec<&ShardFile>> = BTreeMap::new();
    for file in files {
        let record = &file.record;
        origins.entry((record.manifest_sha256, &record.families, &record.version)).or_default().push(file);
    }
    if origins.len() > 1 {
        let mut groups: Vec<&Vec<&ShardFile>> = origins.values().collect();
        groups.sort_by_key(|files| (std::cmp::Reverse(files.len()), &files[0].path));
        let of = |group: &&Vec<&ShardFile>| {
            let first = &group[0];
            let others = if group.len() == 1 { String::new() } else { format!(" and {} more", group.len() - 1) };
            let digest = first.record.manifest_sha256.to_string();
            format!("{}{others}: manifest {}, version {}", first.path.display(), &digest[..8], first.record.version)
        };
        problems.push(format!(
            "the shards are of {} manifests or versions of the program; gather those of one:\n  {}",
            groups.len(),
            groups.iter().map(of).collect::<Vec<_>>().join("\n  ")
        ));
        return;
    }
    let mut first_of_family: BTreeMap<&str, &ShardFile> = BTreeMap::new();
    let count = |file: &ShardFile| file.record.top.as_ref().map(|top| top.count);
    // The best of different families may be those by their own `sort`.
    let differing = files.iter().find_map(|file| {
        let first = *first_of_family.entry(&file.record.family).or_insert(file);
        let is_other = |first: &&ShardFile| first.record.top != file.record.top;
        Some(first)
            .filter(is_other)
            .or(files.first().filter(|first| count(first) != count(file)))
            .map(|first| (first, file))
    });
    if let Some((first, other)) = differing {
        let describe = |top: &Option<Top>| match top {
            Some(Top { count, by }) => format!("the best {count} by `{by}`"),
            None => "all curves".to_owned(),
        };
        problems.push(format!(
            "{} has {}, and {} has {}: make them with the same options",
            first.path.display(),
            describe(&first.record.top),
            other.path.display(),
            describe(&other.record.top)
        ));
    }
}

/// Checks that the files of a family, of which there is one at least, have each of its cells once, and leaves out those that are
/// there twice. The family is as the files record it.
pub(super) fn check_family(
    family: &Family,
    files: &mut Vec<ShardFile>,
    (notes, missing): (&mut Vec<String>, &mut MissingShards),
    problems: &mut Vec<String>,
) {
    files.sort_by(|a, b| {
        let place = |file: &ShardFile| {
            let ShardRecord { first_cell, last_cell, division, .. } = file.record;
            (first_cell, last_cell, division, file.path.clone())
        };
        place(a).cmp(&place(b))
    });
    let mut kept: Vec<ShardFile> = Vec::new();
    for file in files.drain(..) {
        // The same shard made on two machines.
        let beside = kept.iter().rev().take_while(|other| other.record.division == file.record.division);
        match beside.into_iter().find(|other| other.record.has_same_rows(&file.record)) {
            Some(other) => notes.push(format!(
                "{} and {} are the same shard, which counts once",
                other.path.display(),
                file.path.display()
            )),
            None => kept.push(file),
        }
    }
    *files = kept;
    let first = &files[0];
    if let Some(other) = files.iter().find(|file| file.record.columns != first.record.columns) {
        let (a, b) = (first.path.display(), other.path.display());
        let difference = column_difference(&first.record.columns, &other.record.columns);
        problems.push(format!(
            "{a} and {b} have different columns{difference}: make them with the same --measures, and with the same measures in \
             `sort`, charts and captions"
        ));
    }
    if let Some(other) = files.iter().find(|file| file.record.has_points != first.record.has_points) {
        let [with, without] = if first.record.has_points { [first, other] } else { [other, first] };
        problems.push(format!(
            "{} has a table of points, and {} has none: make both with or without --no-points",
            with.path.display(),
            without.path.display()
        ));
    } else if first.record.has_points {
        let columns: Vec<String> =
            table::columns(family, TableKind::Points).into_iter().map(|column| column.name).collect();
        problems.extend(files.par_iter().filter_map(|file| points_problem(file, &columns)).collect::<Vec<_>>());
    }
    check_coverage(&family.id, files, missing, problems);
}

/// What is wrong with the table of points beside a table of cells, which has these columns.
fn points_problem(file: &ShardFile, columns: &[String]) -> Option<String> {
    let name = file.path.file_name()?.to_str()?.replacen(TableKind::Cells.name(), TableKind::Points.name(), 1);
    let path = file.path.with_file_name(name);
    let check = || {
        let points = ShardFile::open(&path)?;
        points.verify()?;
        let expected = ShardRecord { table: TableKind::Points, columns: columns.to_vec(), ..file.record.clone() };
        let difference = points.record.difference_from(&expected);
        let difference =
            difference.or((points.record.counts != expected.counts).then(|| "it has other curves".to_owned()));
        match difference {
            Some(why) => Err(FileProblem::Damaged(format!("it does not belong to {}: {why}", file.path.display()))),
            None => Ok(()),
        }
    };
    check().err().map(|problem| problem.describe(&path))
}

/// Reports cells that are in no file or in two; the files are in order of their first cells.
fn check_coverage(id: &str, files: &[ShardFile], missing_shards: &mut MissingShards, problems: &mut Vec<String>) {
    let cell_count = files[0].record.cell_count;
    // Each with the file before and after it.
    let mut missing = Vec::new();
    let mut next = 1;
    let mut previous: Option<&ShardFile> = None;
    for file in files.iter().filter(|file| file.record.first_cell <= file.record.last_cell) {
        let record = &file.record;
        if record.first_cell > next {
            missing.push(((next, record.first_cell - 1), (previous, Some(file))));
        }
        if let Some(previous) = previous.filter(|_| record.first_cell < next) {
            problems.push(format!(
                "{id}: the cells {} to {} are in {} and in {}: move one of them away",
                record.first_cell,
                record.last_cell.min(next - 1),
                previous.path.display(),
                file.path.display()
            ));
        }
        next = next.max(record.last_cell + 1);
        previous = Some(file);
    }
    if next <= cell_count {
        missing.push(((next, cell_count), (previous, None)));
    }
    if missing.is_empty() {
        return;
    }
    let shard = |file: &ShardFile| match file.record.division {
        Division::Shard { index, of } => Some((index, of)),
        Division::Cells { .. } => None,
    };
    let of = shard(&files[0]).map(|(_, of)| of);
    let present: Option<BTreeSet<usize>> =
        files.iter().map(|file| shard(file).filter(|shard| Some(shard.1) == of).map(|(index, _)| index)).collect();
    if let Some((of, present)) = of.zip(present) {
        let index = |file: Option<&ShardFile>| file.and_then(shard).map(|(index, _)| index);
        let (indices, families) = missing_shards.0.entry(of).or_default();
        for (_, (before, after)) in missing {
            let between = index(before).map_or(0, |index| index + 1)..index(after).unwrap_or(of);
            indices.extend(between.filter(|index| !present.contains(index)));
        }
        families.push(id.to_owned());
        return;
    }
    let missing: Vec<(usize, usize)> = missing.into_iter().map(|(cells, _)| cells).collect();
    let (first, last) = missing[0];
    let ranges: Vec<String> = missing.iter().take(MAX_RANGES).map(|(a, b)| format!("{a} to {b}")).collect();
    let more = missing.len().saturating_sub(MAX_RANGES);
    let more = if more == 0 { String::new() } else { format!(" and {more} more ranges") };
    problems.push(format!(
        "{id}: the cells {}{more} of {cell_count} are missing: make them with `coupler-atlas sweep MANIFEST --cells {first}..{last}` \
         and so on",
        ranges.join(", ")
    ));
}

/// For each number of shards the indices of those that are missing, and the families that lack any.
#[derive(Debug, Default)]
pub(super) struct MissingShards(BTreeMap<usize, (BTreeSet<usize>, Vec<String>)>);

impl MissingShards {
    /// A message for each number of shards.
    pub fn describe(&self) -> impl Iterator<Item = String> {
        self.0.iter().map(|(of, (indices, families))| missing_shards(*of, indices, families))
    }
}

/// The message for shards that are missing; a run makes a shard of all families.
fn missing_shards(of: usize, indices: &BTreeSet<usize>, families: &[String]) -> String {
    let indices: Vec<usize> = indices.iter().copied().collect();
    let first = indices.first().copied().unwrap_or(0);
    let (what, verb) = if indices.len() == 1 { ("shard", "is") } else { ("shards", "are") };
    let families = match families {
        [only] => only.clone(),
        [first, others @ ..] => format!("{first} and {} more", others.len()),
        [] => String::new(),
    };
    format!(
        "{families}: {what} {} of {of} {verb} missing: make them with `coupler-atlas sweep MANIFEST --shard {first}/{of}` and so on",
        number_ranges(&indices)
    )
}
