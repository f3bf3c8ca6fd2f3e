//! `gather`: checks that shards are complete, and finds the best of their curves.

mod pages;

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::output;
use crate::shard::{self, GatherOptions, Gathered, MAX_TOP};
use clap::{Args, ValueHint};

use super::sweep::describe_counts;
use super::{Failure, Outcome, files, print_bytes, print_stderr, printable};
use coupler_curves::text::pluralize;

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
    /// What is least for the best curves, as in `sort`: an expression of parameters and measures, with a minus sign for the greatest, as in
    /// --by -straight_length [default: that by which the shards kept theirs, or the family's `sort`].
    #[arg(long, value_name = "EXPR", allow_hyphen_values = true)]
    by: Option<String>,
    /// Write a manifest that renders the linkages of the best curves, which replaces none but one of gather; - for standard output,
    /// in place of the table.
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

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    if let Some(path) = &arguments.toml {
        check_replaceable(path)?;
    }
    let (mut tables, mut atlases, mut complete) = (Vec::new(), Vec::new(), Vec::new());
    for folder in &arguments.folders {
        let shards = output::page_shards(folder)?;
        let has_tables = shard::has_tables(folder)?;
        let has_pages = !shards.is_empty();
        if has_pages {
            atlases.push((folder, shards));
        }
        if has_tables || !has_pages && !pages::has_atlas(folder) {
            tables.push(folder.clone());
        } else if !has_pages {
            complete.push(folder);
        }
    }
    if tables.is_empty() {
        check_options(arguments)?;
    }
    for (folder, shards) in atlases {
        pages::complete(folder, &shards, arguments.quiet)?;
    }
    for folder in complete.iter().filter(|_| !arguments.quiet) {
        print_stderr(&format!("{} has a complete atlas, and no shards to gather\n", printable(folder.display())));
    }
    if tables.is_empty() {
        return Ok(Outcome::Done);
    }
    let options = GatherOptions {
        only: arguments.only.clone(),
        top: arguments.top.map(|top| top as usize),
        by: arguments.by.clone(),
    };
    let gathered = shard::gather(&tables, &options)?;
    if arguments.toml.is_some() && gathered.by.is_empty() {
        let message = "--toml is for the best curves: say how many and by what, as in --top 100 --by -straight_length";
        return Err(Failure::input(message));
    }
    for note in &gathered.notes {
        print_stderr(&format!("note: {}\n", printable(note)));
    }
    if !arguments.quiet {
        print_stderr(&totals(&gathered));
    }
    let is_table_replaced = arguments.toml.as_deref().is_some_and(files::is_standard);
    if !gathered.by.is_empty() && !is_table_replaced {
        print_table(&gathered)?;
    }
    let is_empty = !gathered.by.is_empty() && gathered.best.is_empty();
    if is_empty {
        print_stderr(&format!("note: {}\n", printable(nothing_is_best(&gathered, arguments.toml.as_deref()))));
    }
    if let Some(path) = arguments.toml.as_ref().filter(|_| !is_empty) {
        files::write(path, shard::best_manifest(&gathered).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// Checks that no option is given that is for tables.
fn check_options(arguments: &Arguments) -> Result<(), Failure> {
    let given = [
        ("--top", arguments.top.is_some()),
        ("--by", arguments.by.is_some()),
        ("--toml", arguments.toml.is_some()),
        ("--only", !arguments.only.is_empty()),
    ];
    let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) else { return Ok(()) };
    let names: Vec<String> = arguments.folders.iter().map(|folder| printable(folder.display())).collect();
    Err(Failure::input(format!(
        "{option} is for tables, and there are none in {}: `coupler-atlas sweep` writes them",
        names.join(" or in ")
    )))
}

/// Checks that a file for the best curves would replace nothing but one of an earlier gather.
fn check_replaceable(path: &Path) -> Result<(), Failure> {
    if files::is_standard(path) || !path.is_file() {
        return Ok(());
    }
    let mut beginning = Vec::new();
    let read = File::open(path).and_then(|file| file.take(1 << 16).read_to_end(&mut beginning));
    let first_line = beginning.split(|&byte| byte == b'\n').next().unwrap_or_default();
    match read {
        Ok(_) if shard::is_best_manifest(&String::from_utf8_lossy(first_line)) => Ok(()),
        _ => Err(Failure::input(format!(
            "{} exists already, and is not what gather writes: name another file, or remove it first",
            path.display()
        ))),
    }
}

/// Why there is no best curve.
fn nothing_is_best(gathered: &Gathered, toml: Option<&Path>) -> String {
    let curves: usize = gathered.families.iter().map(|(_, totals)| totals.counts.curves).sum();
    let by = gathered.by.join("`, `");
    let why = match (curves, gathered.families.iter().any(|(_, totals)| totals.has_best_only)) {
        (0, false) => "no cell has a curve".to_owned(),
        (0, true) => format!("no shard has a curve for which `{by}` has a value"),
        _ => format!("`{by}` has no value for any of {}", pluralize(curves, "curve")),
    };
    match toml {
        Some(path) => format!("nothing is the best: {why}; {} is not written", files::output_name(path)),
        None => format!("nothing is the best: {why}"),
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

/// Prints the rows of the best, as in `cells.csv`, and by what they are the best in a last column.
fn print_table(gathered: &Gathered) -> Result<(), Failure> {
    /// The rows that are printed at once.
    const ROWS: usize = 1 << 10;
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(gathered.columns.iter().map(String::as_str).chain(["by"])).map_err(Failure::system)?;
    print_bytes(&writer.into_inner().map_err(Failure::system)?)?;
    for curves in gathered.best.chunks(ROWS) {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for curve in curves {
            let mut key = Vec::new();
            coupler_curves::exchange::append_number(curve.key, &mut key);
            writer.write_record(curve.fields.iter().map(str::as_bytes).chain([&key[..]])).map_err(Failure::system)?;
        }
        print_bytes(&writer.into_inner().map_err(Failure::system)?)?;
    }
    Ok(())
}
