//! Makes a shard.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::Family;
use coupler_curves::solve::{SolvedCell, Status};

use super::Error;
use super::best::Best;
use super::expression::{criteria, is_of_circuits};
use super::options::{Event, Options};
use super::problem::FileProblem;
use super::read::ShardFile;
use super::record::{Counts, ShardRecord, TableKind, Top};
use super::swept::{groups, initial_record, manifest_digest, swept_family};
use super::table::{self, Chunk, RowMaker, TableWriter, table_path, temporary_affixes};
use crate::manifest::Plan;
use crate::output::{self, Lock, create_folder};
use crate::sweep::{self, CellIndices};

/// Makes a shard: solves, measures and filters its cells, and writes their tables into the folders of their families. Files of
/// a shard that are complete already are kept.
///
/// Memory is bounded whatever the number of cells. Of the curves that `top` keeps, each takes some 40 bytes.
///
/// # Errors
/// A file cannot be written, or is of another sweep; the expression of the best is none in any family, or the bare name of a measure of which
/// more is better; without it, a family has no `sort`; the run is interrupted.
pub fn write_shard(plan: &Plan, output: &Path, options: &Options, report: &mut dyn FnMut(Event)) -> Result<(), Error> {
    let is_selected = |id: &String| options.only.is_empty() || options.only.contains(id);
    let criteria = options.top.map(|_| criteria(plan, &is_selected, options.by.as_deref())).transpose()?;
    let manifest_sha256 = manifest_digest(plan);
    let families: Vec<String> = plan.families.iter().map(|planned| planned.family.id.clone()).collect();
    for (k, planned) in plan.families.iter().enumerate() {
        if !is_selected(&planned.family.id) {
            continue;
        }
        let criterion = criteria.as_ref().and_then(|criteria| criteria[k].clone());
        let top = options.top.zip(criterion.as_ref()).map(|(count, own)| Top { count, by: own.text.clone() });
        let by = criterion.and_then(|criterion| criterion.expression);
        let family = swept_family(&planned.family, by.as_ref(), options.measures.as_deref());
        let record = initial_record(planned, &family, (manifest_sha256, &families), (options, top));
        FamilyShard { family: &family, by, record, folder: output.join(&family.id), options }.write(report)?;
    }
    Ok(())
}

/// The part of a family in a shard.
struct FamilyShard<'a> {
    /// With the measures that the tables have.
    family: &'a Family,
    /// The expression of the best; `None` also if the family lacks a name in it, so that it has no best.
    by: Option<CompiledExpression>,
    /// What the table of cells will say of itself, without counts.
    record: ShardRecord,
    folder: PathBuf,
    options: &'a Options,
}

/// What solving some cells has made.
struct Solved {
    cells: Chunk,
    points: Option<Chunk>,
    counts: Counts,
    cell_count: usize,
}

/// A curve of a family by cell, trace and circuit, each from 1.
type Place = [u32; 3];

impl FamilyShard<'_> {
    fn write(&self, report: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let record = &self.record;
        let path = |table| table_path(&self.folder, table, (record.division, record.cell_count), self.options.format);
        let cells_path = path(TableKind::Cells);
        let label = record.division.label(record.cell_count);
        create_folder(&self.folder).map_err(|error| match error {
            output::Error::Write { source, .. } if is_no_folder(source.kind()) => {
                let exists = |path: &&Path| fs::symlink_metadata(path).is_ok();
                Error::NotAFolder(self.folder.ancestors().find(exists).unwrap_or(&self.folder).to_owned())
            }
            error => error.into(),
        })?;
        // Another run of this shard may be at work: what it writes is kept.
        let lock = Lock::wait_for(self.folder.join(format!(".coupler-atlas-{label}.lock")))?;
        if let Some(complete) = self.complete_record(&cells_path, &path(TableKind::Points))? {
            report(Event::End { record: &complete, path: &cells_path, is_kept: true });
            return Ok(());
        }
        if lock.is_exclusive() {
            self.remove_temporary_files(&label);
        }
        let range = record.first_cell - 1..record.last_cell;
        report(Event::Begin { family: &self.family.id, cells: range.len() });
        let counts = match &self.by {
            None if self.options.top.is_some() => {
                self.write_tables(&CellIndices::Listed(Vec::new()), None, (&path, &label), report)?
            }
            None => self.write_tables(&CellIndices::Range(range), None, (&path, &label), report)?,
            Some(by) => {
                let (best, counts) = self.find_best(by, &CellIndices::Range(range), report)?;
                let mut cells: Vec<u32> = best.iter().map(|place| place[0] - 1).collect();
                cells.dedup();
                let cells = CellIndices::Listed(cells);
                let kept = self.write_tables(&cells, Some((&best, counts)), (&path, &label), &mut |_| {})?;
                Counts { curves: kept.curves, points: kept.points, ..counts }
            }
        };
        let complete = ShardRecord { counts, ..record.clone() };
        report(Event::End { record: &complete, path: &cells_path, is_kept: false });
        Ok(())
    }

    /// The record of the table of cells if all files of the shard are complete.
    ///
    /// # Errors
    /// A file is not of this shard, and would be replaced; or it cannot be read.
    fn complete_record(&self, cells: &Path, points: &Path) -> Result<Option<ShardRecord>, Error> {
        if self.options.force {
            return Ok(None);
        }
        let cells = self.existing_record(cells, &self.record)?;
        // A shard without tables of points has none of another.
        if let Some(cells) = cells.as_ref().filter(|cells| !cells.has_points && !self.options.has_points) {
            return Ok(Some(cells.clone()));
        }
        let points = self.existing_record(points, &self.points_record(Counts::default()))?;
        Ok(cells
            .zip(points)
            .filter(|(cells, points)| cells.has_points && cells.counts == points.counts)
            .map(|(cells, _)| cells))
    }

    /// The record of a table that has its name already; `None` if there is none, or if it is damaged and made again.
    fn existing_record(&self, path: &Path, expected: &ShardRecord) -> Result<Option<ShardRecord>, Error> {
        let verified = ShardFile::open(path).and_then(|file| file.verify().map(|()| file.record));
        let reason = match verified {
            Ok(record) => match record.difference_from(expected) {
                None => return Ok(Some(record)),
                Some(reason) => reason,
            },
            Err(FileProblem::Missing | FileProblem::Damaged(_)) => return Ok(None),
            Err(FileProblem::Foreign(reason)) => reason,
            Err(FileProblem::Unreadable(reason)) => {
                let source = std::io::Error::other(reason);
                return Err(output::Error::Write { path: path.to_owned(), source }.into());
            }
        };
        Err(Error::OtherShard { path: path.to_owned(), reason })
    }

    fn points_record(&self, counts: Counts) -> ShardRecord {
        let columns = table::columns(self.family, TableKind::Points);
        ShardRecord { table: TableKind::Points, counts, ..self.record.clone() }.with_columns(&columns)
    }

    /// Removes the unfinished files of killed runs of this shard.
    fn remove_temporary_files(&self, label: &str) {
        let (begin, end) = temporary_affixes(label);
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if entry.file_name().to_str().is_some_and(|name| name.starts_with(&begin) && name.ends_with(end)) {
                output::remove_temporary(&entry.path());
            }
        }
    }

    /// The best curves in order of cell, trace and circuit, and the counts of all cells. Only the measures that are needed for
    /// it are computed.
    fn find_best(
        &self,
        by: &CompiledExpression,
        cells: &CellIndices,
        report: &mut dyn FnMut(Event),
    ) -> Result<(Vec<Place>, Counts), Error> {
        let needed = self.family.measures_in(by);
        let most = self.options.top.unwrap_or(0);
        // Of joints that are traced on one circuit the first counts for all.
        let is_of_circuits = is_of_circuits(self.family, by);
        let rank = |_, solved: Vec<SolvedCell>| {
            let mut ranked: Vec<(f64, Place)> = Vec::new();
            for solved in &solved {
                for (k, curve) in solved.curves.iter().enumerate() {
                    if is_of_circuits && solved.curves[..k].iter().any(|other| other.circuit == curve.circuit) {
                        continue;
                    }
                    let key = by.evaluate(|slot| Family::scope_value(&solved.cell, &curve.values, slot));
                    ranked.push((key, [solved.cell.number, curve.trace, curve.circuit].map(|number| number as u32)));
                }
            }
            (ranked, count(&solved), solved.len())
        };
        let (mut best, mut counts) = (Best::new(most), Counts::default());
        sweep::process_groups(
            self.family,
            groups(self.family, cells, Some(needed)),
            rank,
            |(ranked, counted, cells)| {
                self.check_interrupt()?;
                ranked.into_iter().for_each(|(key, place)| best.add(key, place));
                counts.add(&counted);
                report(Event::Cells(cells));
                Ok::<(), Error>(())
            },
        )?;
        let mut places: Vec<Place> = best.into_sorted().into_iter().map(|ranked| ranked.place).collect();
        places.sort_unstable();
        Ok((places, counts))
    }

    /// Writes the tables of some cells, if `best` is given only those curves, with the counts of all cells.
    fn write_tables(
        &self,
        cells: &CellIndices,
        best: Option<(&[Place], Counts)>,
        (path, label): (&dyn Fn(TableKind) -> PathBuf, &str),
        report: &mut dyn FnMut(Event),
    ) -> Result<Counts, Error> {
        let tables = [TableKind::Cells, TableKind::Points].map(|table| (table, table::columns(self.family, table)));
        let maker = |k: usize| {
            let (table, columns) = &tables[k];
            RowMaker { family: self.family, table: *table, format: self.options.format, columns }
        };
        let (cell_maker, point_maker) = (maker(0), self.options.has_points.then(|| maker(1)));
        let mut cell_table = TableWriter::new(path(TableKind::Cells), cell_maker, label)?;
        let point_table = point_maker.map(|maker| TableWriter::new(path(TableKind::Points), maker, label));
        let mut point_table = point_table.transpose()?;
        let make = |_, mut solved: Vec<SolvedCell>| {
            if let Some((best, _)) = best {
                for solved in &mut solved {
                    let cell = solved.cell.number;
                    solved.curves.retain(|curve| {
                        let place = [cell, curve.trace, curve.circuit].map(|number| number as u32);
                        best.binary_search(&place).is_ok()
                    });
                }
            }
            Solved {
                cells: cell_maker.rows(&solved),
                points: point_maker.map(|maker| maker.rows(&solved)),
                counts: count(&solved),
                cell_count: solved.len(),
            }
        };
        let mut counts = Counts::default();
        sweep::process_groups(self.family, groups(self.family, cells, None), make, |solved| {
            self.check_interrupt()?;
            cell_table.append(solved.cells)?;
            if let (Some(table), Some(points)) = (&mut point_table, solved.points) {
                table.append(points)?;
            }
            counts.add(&solved.counts);
            report(Event::Cells(solved.cell_count));
            Ok::<(), Error>(())
        })?;
        let counts = match best {
            Some((_, all)) => Counts { curves: counts.curves, points: counts.points, ..all },
            None => counts,
        };
        // The shard is complete when its table of cells is there.
        match point_table {
            Some(table) => table.commit(&self.points_record(counts))?,
            None => table::remove(&path(TableKind::Points))?,
        }
        cell_table.commit(&ShardRecord { counts, ..self.record.clone() })?;
        Ok(counts)
    }

    fn check_interrupt(&self) -> Result<(), Error> {
        if self.options.interrupt.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
    }
}

/// Whether a folder cannot be made because something else has its name, or that of a folder above it.
fn is_no_folder(kind: std::io::ErrorKind) -> bool {
    matches!(kind, std::io::ErrorKind::AlreadyExists | std::io::ErrorKind::NotADirectory)
}

/// What cells come to.
fn count(cells: &[SolvedCell]) -> Counts {
    let mut counts = Counts::default();
    for solved in cells {
        if solved.is_left_out() {
            counts.cells_left_out += 1;
            continue;
        }
        counts.curves += solved.curves.len();
        counts.curves_left_out += solved.left_out_count;
        match solved.status() {
            Status::Ok => {}
            Status::Partial => counts.partly_assembled += 1,
            Status::None | Status::Failed => counts.not_assembled += 1,
        }
        counts.points += solved.curves.iter().map(|curve| solved.circuit(curve).len()).sum::<usize>();
    }
    counts
}
