//! Checks that shards are complete and of one manifest, and finds the best of their curves.

mod coverage;
mod gathered;
mod ranking;

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::Error;
use super::folder::{FoundTables, is_table};
use super::problem::FileProblem;
use super::read::ShardFile;
use super::record::Counts;
use crate::manifest::{self, Plan};
use coverage::{MissingShards, check_family, check_origin};
use ranking::{Ranking, rank};

pub use gathered::{BestCurve, FamilyTotals, GatherOptions, Gathered};

/// Checks the shards in some folders, and finds the best curves.
///
/// # Errors
/// All problems of the shards: files that are not complete, shards that are missing, of other manifests or twice with
/// different contents; an expression that is none in any family.
pub fn gather(folders: &[PathBuf], options: &GatherOptions) -> Result<Gathered, Error> {
    let mut found = FoundTables::default();
    folders.iter().try_for_each(|folder| found.add(folder))?;
    let is_selected = |id: &str| options.only.is_empty() || options.only.iter().any(|only| only == id);
    let opened: Vec<_> = found.tables.par_iter().map(|path| (path, ShardFile::open(path))).collect();
    let (mut files, mut failed) = (Vec::new(), Vec::new());
    for (path, opened) in opened {
        match opened {
            Ok(file) => files.push(file),
            Err(problem) => failed.push((path.clone(), problem)),
        }
    }
    failed.extend(found.unreadable.into_iter().map(|(path, error)| (path, FileProblem::Unreadable(error.to_string()))));
    let families = files.first().map(|file: &ShardFile| file.record.families.clone()).unwrap_or_default();
    if let Some(id) = options.only.iter().find(|id| !families.is_empty() && !families.contains(id)) {
        let help = coupler_curves::problem::suggestion(id, &families.iter().map(String::as_str).collect::<Vec<_>>());
        return Err(Error::Problems(vec![format!("there is no family `{id}`: {help}")]));
    }
    // A folder that cannot be read matters if it has the name of a family, as any may if nothing else tells.
    let matters = |path: &Path, is_file: bool| {
        let name = |path: &Path| path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        let folder = if is_file { name(path.parent().unwrap_or(Path::new(""))) } else { name(path) };
        match families.contains(&folder) {
            true => is_selected(&folder),
            false => is_file || families.is_empty(),
        }
    };
    failed.retain(|(path, _)| matters(path, is_table(path)));
    files.retain(|file| is_selected(&file.record.family));
    let verified: Vec<_> = files.par_iter().map(|file| (file.path.clone(), file.verify())).collect();
    failed.extend(verified.into_iter().filter_map(|(path, verified)| Some((path, verified.err()?))));
    let mut problems: Vec<String> = failed.iter().map(|(path, problem)| problem.describe(path)).collect();
    if files.is_empty() && problems.is_empty() {
        let names: Vec<String> = folders.iter().map(|folder| folder.display().to_string()).collect();
        problems.push(format!(
            "there are no tables of shards in {}: `coupler-atlas sweep` writes them",
            names.join(" or in ")
        ));
    }
    if failed.iter().any(|(_, problem)| matches!(problem, FileProblem::Unreadable(_))) {
        return Err(Error::Unreadable(problems));
    }
    check_origin(&files, &mut problems);
    if !problems.is_empty() {
        return Err(Error::Problems(problems));
    }
    let mut notes = Vec::new();
    let mut gathered = Vec::new();
    let mut missing = MissingShards::default();
    for id in families.iter().filter(|id| is_selected(id)) {
        let (mut own, others): (Vec<_>, Vec<_>) = files.into_iter().partition(|file| file.record.family == *id);
        files = others;
        let Some(first) = own.first() else {
            problems.push(format!("{id}: there are no shards: sweep it, or gather the others with --only"));
            continue;
        };
        match manifest::parse(&first.record.manifest).plan {
            Some(plan) => {
                check_family(&plan.families[0].family, &mut own, (&mut notes, &mut missing), &mut problems);
                gathered.push((plan, own));
            }
            None => problems.push(format!("{}: the manifest in it cannot be read", first.path.display())),
        }
    }
    problems.extend(missing.describe());
    if !problems.is_empty() {
        return Err(Error::Problems(problems));
    }
    let Ranking { by, columns, best } = rank(&gathered, options, &mut notes)?;
    let families = gathered.into_iter().map(|(plan, files)| (plan, totals(&files))).collect();
    Ok(Gathered { families, notes, by, columns, best })
}

/// The best curves in a table of cells that a sweep with [`Options::top`](super::Options::top) has made, at most a number of them.
///
/// # Errors
/// It cannot be read.
pub fn best_of_table(path: &Path, most: usize) -> Result<Gathered, Error> {
    let problem = |message| Error::Problems(vec![message]);
    let file = ShardFile::open(path).map_err(|error| problem(error.describe(path)))?;
    let plan = manifest::parse(&file.record.manifest).plan;
    let plan = plan.ok_or_else(|| problem(format!("{}: the manifest in it cannot be read", path.display())))?;
    let top = file.record.top.as_ref().map(|top| top.count.min(most));
    let gathered = [(plan, vec![file])];
    let Ranking { by, columns, best } =
        rank(&gathered, &GatherOptions { top, ..GatherOptions::default() }, &mut Vec::new())?;
    let families = gathered.into_iter().map(|(plan, files)| (plan, totals(&files))).collect();
    Ok(Gathered { families, notes: Vec::new(), by, columns, best })
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
        has_best_only: record.top.is_some(),
    }
}

impl BestCurve {
    /// The name of the curve, as `export` takes it: `evans:3.1.1`.
    pub fn name(&self, families: &[(Plan, FamilyTotals)]) -> String {
        let [cell, trace, circuit] = self.place;
        format!("{}:{cell}.{trace}.{circuit}", families[self.family].1.id)
    }
}
