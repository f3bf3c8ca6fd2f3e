//! The arguments of `render`.

use std::path::PathBuf;

use crate::sweep::Division;
use clap::{Args, ValueHint};
use coupler_drawing::render::Format;

use super::super::files::DEFAULT_MANIFEST;
use super::super::{choice, files, sweep};

/// Solve every family of a manifest, and write its pages and point sets.
#[derive(Clone, Debug, Args)]
pub struct Arguments {
    /// The manifest; - for standard input, which needs --output.
    #[arg(default_value = DEFAULT_MANIFEST, value_hint = ValueHint::FilePath)]
    pub(super) manifest: PathBuf,
    /// The folder to write to [default: `output` of the manifest, relative to it, or else its path without the
    /// extension].
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath, value_parser = files::folder_parser())]
    pub(super) output: Option<PathBuf>,
    /// The formats of pages, instead of the manifest's: svg, png, pdf (one book); pages that an earlier run wrote in
    /// other formats are kept.
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', value_parser = parse_format)]
    pub(super) format: Option<Vec<Format>>,
    /// Render only this family, and leave the files of others unchanged; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    pub(super) only: Vec<String>,
    /// Draw every page, including those that are up to date.
    #[arg(long)]
    pub(super) force: bool,
    /// Replace the atlas of another manifest, and files that no earlier run wrote.
    #[arg(long)]
    pub(super) overwrite: bool,
    /// Rebuild a run.json that is lost or damaged from the files that are as the manifest makes them, and complete the atlas;
    /// no other file is changed.
    #[arg(long, conflicts_with_all = ["only", "overwrite", "shard", "watch"])]
    pub(super) repair: bool,
    /// The number of threads [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) jobs: Option<u16>,
    /// Draw only the I-th of N equal parts of the pages of each family, I from 0 to N - 1, as in --shard 3/64; gather completes
    /// the atlas when all are drawn.
    #[arg(long, value_name = "I/N", value_parser = sweep::parse_shard, conflicts_with_all = ["only", "strict", "open", "watch"])]
    pub(super) shard: Option<Division>,
    /// Exit with 1 if a cell that `where` does not leave out cannot be assembled over the whole requested range.
    #[arg(long)]
    pub(super) strict: bool,
    /// Print only warnings and errors.
    #[arg(short, long)]
    pub(super) quiet: bool,
    /// Open the gallery, or else the book, in the program that the system has for it; with --watch, a page that shows the
    /// pages and the problems of the manifest as they change.
    #[arg(long)]
    pub(super) open: bool,
    /// Render again whenever the manifest changes, until Ctrl-C.
    #[arg(long, conflicts_with = "strict")]
    pub(super) watch: bool,
}

pub(in crate::cli) fn parse_format(name: &str) -> Result<Format, String> {
    let format = choice::parse("format", name, &Format::ALL.map(|format| (format.name(), format)))?;
    match format.is_built_in() {
        true => Ok(format),
        false => {
            let name = format.name();
            Err(format!("this build cannot write `{name}`: build the program with the feature `pdf`"))
        }
    }
}
