//! `init`: writes a commented manifest.

use std::io::ErrorKind;
use std::path::PathBuf;

use clap::Args;
use coupler_atlas::output;

use super::source::DEFAULT_MANIFEST;
use super::{InputError, Outcome, print, printable};

/// Write a commented manifest to start from.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file to write; it must not exist.
    #[arg(default_value = DEFAULT_MANIFEST)]
    file: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let file = printable(arguments.file.display());
    match output::write_new(&arguments.file, include_bytes!("starter.toml")) {
        Err(output::Error::Write { source, .. }) if source.kind() == ErrorKind::AlreadyExists => {
            Err(InputError(format!("{file} exists already; give another name, or remove the file first")).into())
        }
        result => {
            result?;
            print(&format!("written to {file}; `coupler-atlas render {file}` draws it\n"))?;
            Ok(Outcome::Done)
        }
    }
}
