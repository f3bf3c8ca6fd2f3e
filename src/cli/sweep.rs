//! `sweep`: solves a part of the cells of a manifest into tables.

use std::path::{Path, PathBuf};

use crate::output;
use crate::shard::{self, Counts, Division, Event, MAX_SHARDS, MAX_TOP, Options, ShardRecord, TableFormat};
use crate::sweep::cells_of_division;
use clap::{Args, ValueHint};
use coupler_curves::family::MEASURES;
use indicatif::ProgressBar;

use super::best_table::best_table;
use super::files::DEFAULT_MANIFEST;
use super::source::{self, ManifestSource};
use super::{Failure, Outcome, choice, files, interrupt, print, print_stderr, printable, progress_bar};
use coupler_curves::text::pluralize;

/// Solve a part of the cells of a manifest, or all, into tables without pages: cells and points of each family, as Parquet.
///
/// A shard depends on the manifest and its number alone, so that many machines can make the shards of one atlas: see
/// docs/scale.md. Files appear whole or not at all, and those that are complete are kept.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest; - for standard input, which needs --output.
    #[arg(default_value = DEFAULT_MANIFEST, value_hint = ValueHint::FilePath)]
    manifest: PathBuf,
    /// The folder to write to, in a folder for each family [default: that of render].
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath, value_parser = files::folder_parser())]
    output: Option<PathBuf>,
    /// Only the I-th of N parts of equal work of each family's cells, I from 0 to N - 1, as in --shard 3/64 [default: 0/1, all cells].
    #[arg(long, value_name = "I/N", value_parser = parse_shard, conflicts_with = "cells")]
    shard: Option<Division>,
    /// Only the cells of a single family with the numbers A to B, both included, as in --cells 1..1000.
    #[arg(long, value_name = "A..B", value_parser = parse_cells)]
    cells: Option<Division>,
    /// The format of the tables: parquet, csv.
    #[arg(long, value_name = "FORMAT", default_value = TableFormat::default().name(), value_parser = parse_format)]
    format: TableFormat,
    /// Write no table of points.
    #[arg(long)]
    no_points: bool,
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=MAX_TOP as i64),
        help = format!("Keep only the N best curves of each family in the shard by --by, 1 to {MAX_TOP}")
    )]
    top: Option<u32>,
    /// What is least for the best curves, as in `sort`: an expression of parameters and measures, with a minus sign for the greatest, as in
    /// --by -straight_length or --by straight_deviation [default: the family's `sort`].
    #[arg(long, value_name = "EXPR", requires = "top", allow_hyphen_values = true)]
    by: Option<String>,
    /// The measures of the tables, in place of those of the manifest, or none; those that `where` and --by use are there in any
    /// case.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    measures: Option<Vec<String>>,
    /// Only this family; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    only: Vec<String>,
    /// Make the shard again, and replace files of other sweeps.
    #[arg(long)]
    force: bool,
    /// The number of threads [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Print only warnings and errors.
    #[arg(short, long)]
    quiet: bool,
}

pub(super) fn parse_shard(text: &str) -> Result<Division, String> {
    let numbers =
        text.split_once('/').and_then(|(index, of)| Some((index.trim().parse().ok()?, of.trim().parse().ok()?)));
    match numbers {
        Some((_, of)) if of > MAX_SHARDS => Err(format!("at most {MAX_SHARDS} shards are possible")),
        Some((index, of)) if index < of => Ok(Division::Shard { index, of }),
        Some((_, of)) if of > 0 => Err(format!("shards are numbered from 0: give 0/{of} to {}/{of}", of - 1)),
        _ => Err("expected a number and the number of shards, as in --shard 3/64".to_owned()),
    }
}

fn parse_cells(text: &str) -> Result<Division, String> {
    let numbers =
        text.split_once("..").and_then(|(first, last)| Some((first.trim().parse().ok()?, last.trim().parse().ok()?)));
    match numbers {
        Some((first, last)) if 0 < first && first <= last => Ok(Division::Cells { first, last }),
        Some((0, _)) => Err("cells are numbered from 1".to_owned()),
        Some(_) => Err("the last number is less than the first".to_owned()),
        None => Err("expected the numbers of the first and the last cell, as in --cells 1..1000".to_owned()),
    }
}

fn parse_format(name: &str) -> Result<TableFormat, String> {
    choice::parse("format", name, &TableFormat::ALL.map(|format| (format.name(), format)))
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let measures = arguments.measures.as_deref().map(parse_measures).transpose()?;
    let division = arguments.shard.or(arguments.cells).unwrap_or(Division::WHOLE);
    let is_selected = |id: &str| arguments.only.is_empty() || arguments.only.iter().any(|only| only == id);
    let source = source::read_for_tables(&arguments.manifest, &|family| {
        if is_selected(&family.id) { cells_of_division(family, division) } else { 0..0 }
    })?;
    source.require_families(&arguments.only)?;
    check_cells(&source, division, &is_selected)?;
    let output = source.output_folder(arguments.output.as_deref())?;
    let options = Options {
        division,
        format: arguments.format,
        has_points: !arguments.no_points,
        top: arguments.top.map(|top| top as usize),
        by: arguments.by.clone(),
        measures,
        only: arguments.only.clone(),
        force: arguments.force,
        interrupt: interrupt::interrupt_flag(shard::Error::Interrupted)?,
    };
    let mut bar = ProgressBar::hidden();
    let mut written: Vec<(String, Option<(PathBuf, usize)>)> = Vec::new();
    let (mut empty, mut unranked): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    shard::write_shard(&source.plan, &output, &options, &mut |event| match event {
        Event::Begin { .. } if arguments.quiet => {}
        Event::Begin { family, cells } => {
            bar = progress_bar::of_things(family, cells, "cells");
        }
        Event::Cells(cells) => bar.inc(cells as u64),
        Event::End { record, path, is_kept } => {
            bar.finish_and_clear();
            let has_best = record.top.is_some() && record.counts.curves > 0;
            written.push((summary(record, path, is_kept), has_best.then(|| (path.to_owned(), record.counts.curves))));
            // Of a part of the cells another may have curves.
            if record.counts.curves == 0 && is_whole(record) {
                let Counts { cells_left_out, not_assembled, .. } = record.counts;
                match &record.top {
                    Some(top) if cells_left_out + not_assembled < record.cell_count => {
                        unranked.push(format!("note: {}: `{}` has no value for any curve\n", record.family, top.by));
                    }
                    _ if (1..=MAX_DIAGNOSED_CELLS).contains(&record.cell_count) => empty.push(record.family.clone()),
                    _ => {}
                }
            }
        }
    })?;
    unranked.iter().for_each(|note| print_stderr(note));
    let empty = source.plan.families.iter().filter(|planned| empty.contains(&planned.family.id));
    source.report_problems(&empty.map(output::empty_family_warning).collect::<Vec<_>>());
    if arguments.quiet {
        return Ok(Outcome::Done);
    }
    for (summary, best) in written {
        print(&summary)?;
        if let Some((path, curves)) = best {
            let shown = shard::best_of_table(&path, MAX_SHOWN)?;
            print(&best_table(&shown, options.measures.as_deref().unwrap_or_default()))?;
            if let more @ 1.. = curves - shown.best.len() {
                print(&format!("     and {more} more in the table\n"))?;
            }
        }
    }
    Ok(Outcome::Done)
}

/// The most of the best curves of a family that are printed.
const MAX_SHOWN: usize = 100;

/// The most cells of a family of which it is said why none is kept; for that they are solved again.
const MAX_DIAGNOSED_CELLS: usize = 100_000;

/// Whether a table is of all cells of its family.
fn is_whole(record: &ShardRecord) -> bool {
    record.last_cell + 1 - record.first_cell == record.cell_count
}

/// The names of measures, or none.
fn parse_measures(names: &[String]) -> Result<Vec<String>, Failure> {
    if names.len() == 1 && names[0].trim() == "none" {
        return Ok(Vec::new());
    }
    let known: Vec<(&str, &str)> =
        MEASURES.iter().flat_map(|measure| measure.names()).map(|name| (name, name)).collect();
    let parse = |name: &String| choice::parse("measure", name, &known).map(str::to_owned);
    names
        .iter()
        .map(parse)
        .collect::<Result<_, String>>()
        .map_err(|message| Failure::input(format!("--measures: {message}")))
}

/// Checks that a range of cells is one of a single family.
fn check_cells(source: &ManifestSource, division: Division, is_selected: &dyn Fn(&str) -> bool) -> Result<(), Failure> {
    let Division::Cells { first, last } = division else { return Ok(()) };
    let mut families =
        source.plan.families.iter().map(|planned| &planned.family).filter(|family| is_selected(&family.id));
    match (families.next(), families.next()) {
        (Some(family), Some(other)) => Err(Failure::input(format!(
            "--cells is for a single family: name one with --only, as in --only {}, of {}, {} and others",
            family.id, family.id, other.id
        ))),
        (Some(family), None) if last > family.cell_count() => {
            let count = family.cell_count();
            let which = if first > count { first } else { last };
            Err(Failure::input(format!(
                "--cells: `{}` has no cell {which}: its cells are numbered from 1 to {count}",
                family.id
            )))
        }
        _ => Ok(()),
    }
}

/// "evans: cells 1 to 20 of 100 (1 not assembled), 19 curves, written to output/evans/cells-00000-of-00005.parquet".
fn summary(record: &ShardRecord, path: &Path, is_kept: bool) -> String {
    let ShardRecord { family, first_cell, last_cell, cell_count, .. } = record;
    let cells = match last_cell + 1 - first_cell {
        0 => format!("none of {}", pluralize(*cell_count, "cell")),
        1 => format!("cell {first_cell} of {cell_count}"),
        _ => format!("cells {first_cell} to {last_cell} of {cell_count}"),
    };
    let counts =
        describe_counts(record.counts.not_assembled, record.counts.partly_assembled, record.counts.cells_left_out);
    let written = if is_kept { "complete in" } else { "written to" };
    let curves = match &record.top {
        Some(top) => format!("the best {} by `{}`", pluralize(record.counts.curves, "curve"), top.by),
        None => pluralize(record.counts.curves, "curve"),
    };
    format!("{family}: {cells}{counts}, {curves}, {written} {}\n", printable(path.display()))
}

/// " (1 not assembled, 3 left out by `where`)", or nothing.
pub(super) fn describe_counts(not_assembled: usize, partly_assembled: usize, left_out: usize) -> String {
    let counts = [
        (not_assembled, "not assembled"),
        (partly_assembled, "assembled over a part of the range"),
        (left_out, "left out by `where`"),
    ];
    let counts = counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let counts: Vec<String> = counts.collect();
    if counts.is_empty() { String::new() } else { format!(" ({})", counts.join(", ")) }
}
