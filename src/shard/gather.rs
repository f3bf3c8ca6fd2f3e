//! Checks that shards are complete and of one manifest, and finds the best of their curves.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::Family;
use coupler_curves::measure;
use rayon::prelude::*;

use super::best::{Best, Ranked};
use super::read::{ShardFile, find_tables};
use super::record::{Counts, TableKind, Top};
use super::write::compile;
use super::{Division, Error};
use crate::manifest::{self, Plan, PlannedFamily};
use crate::output;
use crate::sweep::{MAX_RANGES, number_ranges};

/// What is gathered.
#[derive(Clone, Debug, Default)]
pub struct GatherOptions {
    /// The ids of the families; all if empty.
    pub only: Vec<String>,
    /// How many of the best curves of all families are found.
    pub top: Option<usize>,
    /// The expression that is greatest for the best; that by which the shards kept theirs if `None`.
    pub by: Option<String>,
}

/// Complete shards.
#[derive(Debug)]
pub struct Gathered {
    /// The plan of a manifest for each family, as the shards record it: with all that determines a curve whose parameters are
    /// known.
    pub families: Vec<(Plan, FamilyTotals)>,
    /// What a user may want to know, as sentences without an end.
    pub notes: Vec<String>,
    /// The expression of the best.
    pub by: Option<String>,
    /// The columns of the best.
    pub columns: Vec<String>,
    /// The best curves, best first; of equal ones the order is that of families, cells, traces and circuits.
    pub best: Vec<BestCurve>,
}

/// The shards of a family.
#[derive(Clone, Debug)]
pub struct FamilyTotals {
    /// The id of the family.
    pub id: String,
    /// The text of the manifest of the family alone.
    pub manifest: String,
    /// The number of its cells.
    pub cells: usize,
    /// The number of shards.
    pub shards: usize,
    /// The number of rows of the tables of cells.
    pub rows: usize,
    /// The sums of their counts.
    pub counts: Counts,
    /// Whether there are tables of points.
    pub has_points: bool,
}

/// One of the best curves.
#[derive(Clone, Debug, PartialEq)]
pub struct BestCurve {
    /// The value of the expression.
    pub key: f64,
    /// The index of its family in [`Gathered::families`].
    pub family: usize,
    /// Its cell, trace and circuit, each from 1.
    pub place: [usize; 3],
    /// The values of the parameters of its linkage.
    pub parameters: Vec<f64>,
    /// The texts of its row in the order of [`Gathered::columns`]; empty where its family lacks a column.
    pub fields: Vec<String>,
}

/// Checks the shards in some folders, and finds the best curves.
///
/// # Errors
/// All problems of the shards: files that are not complete, shards that are missing, of other manifests or twice with
/// different contents; an expression that is none in any family.
pub fn gather(folders: &[PathBuf], options: &GatherOptions) -> Result<Gathered, Error> {
    let mut paths = Vec::new();
    for folder in folders {
        let found = find_tables(folder);
        paths.extend(found.map_err(|source| output::Error::Read { path: folder.clone(), source })?);
    }
    let opened: Vec<Result<ShardFile, String>> = paths.par_iter().map(|path| open(path)).collect();
    let (files, mut problems): (Vec<_>, Vec<_>) = opened.into_iter().partition(Result::is_ok);
    let mut files: Vec<ShardFile> = files.into_iter().flatten().collect();
    let mut problems: Vec<String> = problems.drain(..).filter_map(Result::err).collect();
    if files.is_empty() {
        if problems.is_empty() {
            let names: Vec<String> = folders.iter().map(|folder| folder.display().to_string()).collect();
            problems.push(format!(
                "there are no tables of shards in {}: `coupler-atlas sweep` writes them",
                names.join(" or in ")
            ));
        }
        return Err(Error::Problems(problems));
    }
    check_origin(&files, &mut problems);
    if !problems.is_empty() {
        return Err(Error::Problems(problems));
    }
    let families = files[0].record.families.clone();
    if let Some(id) = options.only.iter().find(|id| !families.contains(id)) {
        let help = coupler_curves::problem::suggestion(id, &families.iter().map(String::as_str).collect::<Vec<_>>());
        return Err(Error::Problems(vec![format!("there is no family `{id}`: {help}")]));
    }
    let is_selected = |id: &String| options.only.is_empty() || options.only.contains(id);
    let mut notes = Vec::new();
    let mut gathered = Vec::new();
    let mut missing = MissingShards::new();
    for id in families.iter().filter(|id| is_selected(id)) {
        let (mut own, others): (Vec<_>, Vec<_>) = files.into_iter().partition(|file| file.record.family == *id);
        files = others;
        check_family(id, &mut own, (&mut notes, &mut missing), &mut problems);
        if let Some(first) = own.first() {
            match manifest::parse(&first.record.manifest).plan {
                Some(plan) => gathered.push((plan, own)),
                None => problems.push(format!("{}: the manifest in it cannot be read", first.path.display())),
            }
        }
    }
    problems.extend(missing.iter().map(|(of, (indices, families))| missing_shards(*of, indices, families)));
    if !problems.is_empty() {
        return Err(Error::Problems(problems));
    }
    let (top, by) = ranking(&gathered, options)?;
    let (columns, best) = match &by {
        Some(by) => find_best(&gathered, top, by)?,
        None => (Vec::new(), Vec::new()),
    };
    let families = gathered.into_iter().map(|(plan, files)| (plan, totals(&files))).collect();
    Ok(Gathered { families, notes, by, columns, best })
}

fn open(path: &Path) -> Result<ShardFile, String> {
    ShardFile::open(path).map_err(|reason| format!("{}: {reason}; make the shard again", path.display()))
}

/// Checks that all files are of one manifest and version, and have the best by the same expression.
fn check_origin(files: &[ShardFile], problems: &mut Vec<String>) {
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
    let first = &files[0];
    if let Some(other) = files.iter().find(|file| file.record.top != first.record.top) {
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

/// Checks that the files of a family have each of its cells once, and leaves out those that are there twice.
fn check_family(
    id: &str,
    files: &mut Vec<ShardFile>,
    (notes, missing): (&mut Vec<String>, &mut MissingShards),
    problems: &mut Vec<String>,
) {
    if files.is_empty() {
        problems.push(format!("{id}: there are no shards: sweep it, or gather the others with --only"));
        return;
    }
    files.sort_by(|a, b| {
        let place = |file: &ShardFile| (file.record.first_cell, file.record.last_cell, file.path.clone());
        place(a).cmp(&place(b))
    });
    let mut kept: Vec<ShardFile> = Vec::new();
    for file in files.drain(..) {
        // The same shard made on two machines.
        match kept.last().filter(|last| last.record == file.record) {
            Some(last) => notes.push(format!(
                "{} and {} are the same shard, which counts once",
                last.path.display(),
                file.path.display()
            )),
            None => kept.push(file),
        }
    }
    *files = kept;
    let first = &files[0];
    if let Some(other) = files.iter().find(|file| file.record.columns != first.record.columns) {
        let (a, b) = (first.path.display(), other.path.display());
        problems.push(format!("{a} and {b} have different columns: make them with the same --measures"));
    }
    if let Some(other) = files.iter().find(|file| file.record.has_points != first.record.has_points) {
        let [with, without] = if first.record.has_points { [first, other] } else { [other, first] };
        problems.push(format!(
            "{} has a table of points, and {} has none: make both with or without --no-points",
            with.path.display(),
            without.path.display()
        ));
    } else if first.record.has_points {
        problems.extend(files.par_iter().filter_map(points_problem).collect::<Vec<_>>());
    }
    check_coverage(id, files, missing, problems);
}

/// What is wrong with the table of points beside a table of cells.
fn points_problem(file: &ShardFile) -> Option<String> {
    let name = file.path.file_name()?.to_str()?.replacen(TableKind::Cells.name(), TableKind::Points.name(), 1);
    let path = file.path.with_file_name(name);
    let reason = match ShardFile::open(&path) {
        Err(reason) => reason,
        Ok(points) => {
            let record = &points.record;
            let is_own = record.table == TableKind::Points
                && record.manifest_sha256 == file.record.manifest_sha256
                && record.first_cell == file.record.first_cell
                && record.last_cell == file.record.last_cell
                && record.counts == file.record.counts;
            if is_own {
                return None;
            }
            format!("it does not belong to {}", file.path.display())
        }
    };
    Some(format!("{}: {reason}; make the shard again", path.display()))
}

/// Reports cells that are in no file or in two; the files are in order of their first cells.
fn check_coverage(id: &str, files: &[ShardFile], missing_shards: &mut MissingShards, problems: &mut Vec<String>) {
    let cell_count = files[0].record.cell_count;
    let mut missing = Vec::new();
    let mut next = 1;
    let mut previous: Option<&ShardFile> = None;
    for file in files.iter().filter(|file| file.record.first_cell <= file.record.last_cell) {
        let record = &file.record;
        if record.first_cell > next {
            missing.push((next, record.first_cell - 1));
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
        missing.push((next, cell_count));
    }
    if missing.is_empty() {
        return;
    }
    let shard_count = |file: &ShardFile| match file.record.division {
        Division::Shard { of, .. } => Some(of),
        Division::Cells { .. } => None,
    };
    let of = shard_count(&files[0]).filter(|of| files.iter().all(|file| shard_count(file) == Some(*of)));
    if let Some(of) = of {
        let present: BTreeSet<(usize, usize)> =
            files.iter().map(|file| (file.record.first_cell, file.record.last_cell)).collect();
        let is_missing = |index: &usize| {
            let range = Division::Shard { index: *index, of }.range(cell_count);
            !range.is_empty() && !present.contains(&(range.start + 1, range.end))
        };
        let (indices, families) = missing_shards.entry(of).or_default();
        indices.extend((0..of).filter(is_missing));
        families.push(id.to_owned());
        return;
    }
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

/// The indices of the missing ones among a number of shards, and the families that lack any.
type MissingShards = BTreeMap<usize, (BTreeSet<usize>, Vec<String>)>;

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

fn totals(files: &[ShardFile]) -> FamilyTotals {
    let record = &files[0].record;
    let mut counts = Counts::default();
    files.iter().for_each(|file| counts.add(&file.record.counts));
    FamilyTotals {
        id: record.family.clone(),
        manifest: record.manifest.clone(),
        cells: record.cell_count,
        shards: files.len(),
        rows: files.iter().map(|file| file.record.rows).sum(),
        counts,
        has_points: record.has_points,
    }
}

/// How many of the best are found, and by which expression.
fn ranking(gathered: &[(Plan, Vec<ShardFile>)], options: &GatherOptions) -> Result<(usize, Option<String>), Error> {
    let recorded = gathered.first().and_then(|(_, files)| files[0].record.top.clone());
    let problem = |message: String| Err(Error::Problems(vec![message]));
    match (options.top, &options.by, recorded) {
        (top, by, Some(recorded)) => {
            if let Some(by) = by.as_ref().filter(|by| **by != recorded.by) {
                return problem(format!("the shards have only the best by `{}`, not by `{by}`", recorded.by));
            }
            match top {
                Some(top) if top > recorded.count => {
                    problem(format!("the shards have only the best {}, not {top}", recorded.count))
                }
                top => Ok((top.unwrap_or(recorded.count), Some(recorded.by))),
            }
        }
        (Some(top), Some(by), None) => Ok((top, Some(by.clone()))),
        (Some(_), None, None) => problem("by what are they the best? Add --by, as in --by straight_length".to_owned()),
        (None, Some(_), None) => problem("how many are the best? Add --top, as in --top 100".to_owned()),
        (None, None, None) => Ok((0, None)),
    }
}

/// The place of a row: its family, cell, trace and circuit, its file and its index.
type Row = ([usize; 4], usize, usize);

/// The best curves and the columns of their rows.
fn find_best(
    gathered: &[(Plan, Vec<ShardFile>)],
    top: usize,
    by: &str,
) -> Result<(Vec<String>, Vec<BestCurve>), Error> {
    let mut best: Best<Row> = Best::new(top);
    let mut failure = None;
    let mut is_known = false;
    for (k, (plan, files)) in gathered.iter().enumerate() {
        let expression = match compile(plan, &|_| true, by) {
            Ok(compiled) => compiled.into_iter().next().flatten(),
            Err(error) => {
                failure = failure.or(Some(error));
                None
            }
        };
        let Some(expression) = expression else { continue };
        is_known = true;
        let family = &plan.families[0].family;
        let search = |(n, file): (usize, &ShardFile)| best_of_file((k, family), (n, file), &expression, top);
        let merge = |a: Best<Row>, b: Best<Row>| Ok(a.merge(b));
        let found: Result<Best<Row>, String> =
            files.par_iter().enumerate().map(search).try_reduce(|| Best::new(top), merge);
        best = best.merge(found.map_err(|message| Error::Problems(vec![message]))?);
    }
    if let (Some(error), false) = (failure, is_known) {
        return Err(error);
    }
    read_best(gathered, best.into_sorted())
}

fn best_of_file(
    (k, family): (usize, &Family),
    (n, file): (usize, &ShardFile),
    expression: &CompiledExpression,
    top: usize,
) -> Result<Best<Row>, String> {
    let mut columns = ["cell", "trace", "circuit"].map(str::to_owned).to_vec();
    // The column of each slot of the expression.
    let mut slots: Vec<(usize, usize)> = Vec::new();
    for &slot in expression.slots() {
        let column = column_name(family, slot);
        let known = columns.iter().position(|other| other == column);
        slots.push((slot, known.unwrap_or(columns.len())));
        if known.is_none() {
            columns.push(column.to_owned());
        }
    }
    let mut best = Best::new(top);
    let result = file.read_numbers(&columns, |first, values| {
        for (row, ((cell, trace), circuit)) in values[0].iter().zip(&values[1]).zip(&values[2]).enumerate() {
            // A cell without curves has no trace.
            if trace.is_nan() {
                continue;
            }
            let load = |slot: usize| {
                let place = slots.iter().find(|(known, _)| *known == slot);
                place.and_then(|(_, column)| values[*column].get(row)).copied().unwrap_or(f64::NAN)
            };
            let place = [k, *cell as usize, *trace as usize, *circuit as usize];
            best.add(expression.evaluate(load), (place, n, first + row));
        }
    });
    result.map(|()| best).map_err(|reason| format!("{}: {reason}", file.path.display()))
}

/// The column for the name at an index of [`Family::scope`], which is that of a number.
fn column_name(family: &Family, slot: usize) -> &str {
    let mut numbers = measure::ALL.iter().filter(|measure| !measure.is_word);
    match slot.checked_sub(family.names.len()) {
        None => &family.names[slot],
        Some(slot) => numbers.nth(slot).map_or("", |measure| measure.name_for(family.template.is_driven_by_length())),
    }
}

/// The rows of the best, with the columns of all their families.
fn read_best(
    gathered: &[(Plan, Vec<ShardFile>)],
    best: Vec<Ranked<Row>>,
) -> Result<(Vec<String>, Vec<BestCurve>), Error> {
    let mut wanted: BTreeMap<(usize, usize), BTreeSet<usize>> = BTreeMap::new();
    for Ranked { place: ([family, ..], file, row), .. } in &best {
        wanted.entry((*family, *file)).or_default().insert(*row);
    }
    let families: BTreeSet<usize> = wanted.keys().map(|(family, _)| *family).collect();
    let columns = all_columns(families.iter().map(|family| &gathered[*family]));
    let wanted: Vec<((usize, usize), BTreeSet<usize>)> = wanted.into_iter().collect();
    let read = |((family, n), rows): &((usize, usize), BTreeSet<usize>)| {
        let file = &gathered[*family].1[*n];
        let rows = file.read_rows(rows).map_err(|reason| format!("{}: {reason}", file.path.display()))?;
        Ok(rows.into_iter().map(|(row, fields)| ((*family, *n, row), fields)).collect::<Vec<_>>())
    };
    let rows: Result<Vec<_>, String> = wanted.par_iter().map(read).collect();
    let rows = rows.map_err(|message| Error::Problems(vec![message]))?;
    let mut rows: BTreeMap<(usize, usize, usize), Vec<String>> = rows.into_iter().flatten().collect();
    let curve = |Ranked { key, place: ([family, place @ ..], n, row) }: Ranked<Row>| {
        let texts = rows.remove(&(family, n, row)).unwrap_or_default();
        let (plan, files) = &gathered[family];
        let own = &files[n].record.columns;
        let field = |name: &String| {
            let at = own.iter().position(|column| column == name);
            at.and_then(|at| texts.get(at)).cloned().unwrap_or_default()
        };
        let template = &plan.families[0].family.template;
        let parameters = template.parameters.iter().map(|parameter| field(&parameter.name));
        let parameters = parameters.map(|text| text.parse().unwrap_or(f64::NAN)).collect();
        BestCurve { key, family, place, parameters, fields: columns.iter().map(field).collect() }
    };
    let best = best.into_iter().map(curve).collect();
    Ok((columns, best))
}

/// The columns of some families in the order of tables: numbers, the parameters of all, status and reason, measures, family and
/// joint.
fn all_columns<'g>(families: impl Iterator<Item = &'g (Plan, Vec<ShardFile>)>) -> Vec<String> {
    let (mut parameters, mut measures): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    for (plan, files) in families {
        let PlannedFamily { family, .. } = &plan.families[0];
        let count = family.template.parameters.len();
        let columns = &files[0].record.columns;
        let middle = columns.get(3 + count + 2..columns.len().saturating_sub(2)).unwrap_or_default();
        for (names, known) in
            [(columns.get(3..3 + count).unwrap_or_default(), &mut parameters), (middle, &mut measures)]
        {
            for name in names {
                if !known.contains(name) {
                    known.push(name.clone());
                }
            }
        }
    }
    // Each family has its measures in the order of all of them.
    let order = |name: &String| {
        measure::ALL.iter().position(|measure| measure.names().any(|own| own == name)).unwrap_or(usize::MAX)
    };
    measures.sort_by_key(order);
    let fixed = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    [
        fixed(&["cell", "trace", "circuit"]),
        parameters,
        fixed(&["status", "reason"]),
        measures,
        fixed(&["family", "joint"]),
    ]
    .concat()
}

impl BestCurve {
    /// The name of the curve, as `export` takes it: `evans:3.1.1`.
    pub fn name(&self, families: &[(Plan, FamilyTotals)]) -> String {
        let [cell, trace, circuit] = self.place;
        format!("{}:{cell}.{trace}.{circuit}", families[self.family].1.id)
    }
}
