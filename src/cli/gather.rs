//! `gather`: checks that shards are complete, and finds the best of their curves.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::output::{self, PageShard};
use crate::record::{PageShardHead, PageShardRecord, RunRecord};
use crate::shard::{self, Division, GatherOptions, Gathered, MAX_TOP};
use crate::sweep::number_ranges;
use clap::{Args, ValueHint};
use coupler_drawing::render::Format;

use super::sweep::{describe_counts, shard_error};
use super::{Outcome, files, pluralize, print_bytes, print_stderr, printable, render, source};

/// Check that the shards of a manifest are complete: print the best of their curves as a table, and complete atlases whose pages
/// render --shard has drawn.
///
/// The shards are those that sweep has written into these folders: of one manifest and one version of the program, and each cell
/// of each family in one of them. docs/scale.md describes the tables.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The folders of the shards.
    #[arg(value_name = "DIR", required = true, value_hint = ValueHint::DirPath)]
    folders: Vec<PathBuf>,
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=MAX_TOP as i64),
        help = format!("Print the N best curves of all families by --by, 1 to {MAX_TOP} [default: as many as each shard kept]")
    )]
    top: Option<u32>,
    /// What is greatest for the best curves: an expression of parameters and measures, as in --by straight_length [default: that by
    /// which the shards kept theirs].
    #[arg(long, value_name = "EXPR", allow_hyphen_values = true)]
    by: Option<String>,
    /// Write a manifest that renders the linkages of the best curves; - for standard output, in place of the table.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    toml: Option<PathBuf>,
    /// Only this family; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    only: Vec<String>,
    /// The number of threads [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Print only the table, warnings and errors.
    #[arg(short, long)]
    quiet: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let mut folders = Vec::new();
    for folder in &arguments.folders {
        let shards = output::page_shards(folder)?;
        match shards.is_empty() {
            true => folders.push(folder.clone()),
            false => complete_pages(folder, &shards, arguments.quiet)?,
        }
    }
    if folders.is_empty() {
        return Ok(Outcome::Done);
    }
    let options = GatherOptions {
        only: arguments.only.clone(),
        top: arguments.top.map(|top| top as usize),
        by: arguments.by.clone(),
    };
    let gathered = shard::gather(&folders, &options).map_err(shard_error)?;
    if arguments.toml.is_some() && gathered.by.is_none() {
        let message = "--toml is for the best curves: say how many and by what, as in --top 100 --by straight_length";
        return Err(super::InputError(message.to_owned()).into());
    }
    for note in &gathered.notes {
        print_stderr(&format!("note: {}\n", printable(note)));
    }
    if !arguments.quiet {
        print_stderr(&totals(&gathered));
    }
    let is_table_replaced = arguments.toml.as_deref().is_some_and(files::is_standard);
    if gathered.by.is_some() && !is_table_replaced {
        print_bytes(&table(&gathered)?)?;
    }
    if let Some(path) = &arguments.toml {
        files::write(path, shard::best_manifest(&gathered).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// Checks that all pages of an atlas are drawn, and writes what they have in common.
fn complete_pages(folder: &Path, shards: &[PageShard], is_quiet: bool) -> anyhow::Result<()> {
    let name = printable(folder.display());
    let PageShardRecord { head: PageShardHead { formats, .. }, manifest, run, .. } = &shards[0].record;
    let is_same = |shard: &PageShard| {
        let PageShardRecord { head, manifest: own, run: own_run, .. } = &shard.record;
        own == manifest
            && head.formats == *formats
            && (&own_run.version, &own_run.manifest) == (&run.version, &run.manifest)
    };
    let mut problems = Vec::new();
    if let Some(other) = shards.iter().find(|shard| !is_same(shard)) {
        let [first, other] = [&shards[0], other].map(|shard| shard.record.head.division);
        problems.push(format!(
            "{name}: {first} and {other} are of different manifests, formats or versions of the program: draw them again"
        ));
    }
    let counts: BTreeSet<usize> = shards.iter().filter_map(parts).map(|(_, of)| of).collect();
    if counts.len() > 1 {
        let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
        problems.push(format!("{name}: pages are drawn in {} shards: use one number", counts.join(" and in ")));
    } else if let Some(&of) = counts.first() {
        let finished = shards.iter().filter(|shard| shard.record.is_finished).filter_map(parts);
        let finished: BTreeSet<usize> = finished.map(|(index, _)| index).collect();
        let missing: Vec<usize> = (0..of).filter(|index| !finished.contains(index)).collect();
        if let Some(first) = missing.first() {
            problems.push(format!(
                "{name}: of {of} shards of pages these are not complete: {}; draw them with `coupler-atlas render MANIFEST --shard \
                 {first}/{of}` and so on",
                number_ranges(&missing)
            ));
        }
    }
    if !problems.is_empty() {
        return Err(super::InputErrors::from_messages(&problems).into());
    }
    let path = PathBuf::from(run.manifest.as_deref().unwrap_or(RunRecord::STANDARD_INPUT));
    let source = source::with_text(&path, manifest.clone())?;
    let parse = |names: &Vec<String>| names.iter().map(|name| render::parse_format(name)).collect();
    let formats: Option<Result<Vec<Format>, String>> = formats.as_ref().map(parse);
    let formats = formats.transpose().map_err(super::InputError)?;
    render::complete(&source, folder, formats, is_quiet)
}

/// The index of a shard, and the number of them.
fn parts(shard: &PageShard) -> Option<(usize, usize)> {
    match shard.record.head.division {
        Division::Shard { index, of } => Some((index, of)),
        Division::Cells { .. } => None,
    }
}

/// A line for each family: "evans: 64 shards, 1000 cells (3 not assembled), 990 curves, 178200 points".
fn totals(gathered: &Gathered) -> String {
    let line = |totals: &shard::FamilyTotals| {
        let counts = &totals.counts;
        let described = describe_counts(counts.not_assembled, counts.partly_assembled, counts.cells_left_out);
        let points = if totals.has_points { format!(", {}", pluralize(counts.points, "point")) } else { String::new() };
        format!(
            "{}: {}, {}{described}, {}{points}\n",
            totals.id,
            pluralize(totals.shards, "shard"),
            pluralize(totals.cells, "cell"),
            pluralize(counts.curves, "curve")
        )
    };
    gathered.families.iter().map(|(_, totals)| line(totals)).collect()
}

/// The rows of the best, as in `cells.csv`, and by what they are the best in a last column.
fn table(gathered: &Gathered) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(gathered.columns.iter().map(String::as_str).chain(["by"]))?;
    for curve in &gathered.best {
        let mut key = Vec::new();
        coupler_curves::exchange::append_number(curve.key, &mut key);
        writer.write_record(curve.fields.iter().map(String::as_bytes).chain([&key[..]]))?;
    }
    Ok(writer.into_inner()?)
}
