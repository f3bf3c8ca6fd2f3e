//! `init`: writes a commented manifest.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::output;
use clap::{Args, ValueHint};

use super::files::DEFAULT_MANIFEST;
use super::{Failure, Outcome, files, print, print_bytes, printable};

/// Write a commented manifest to start from.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file to write, which must not exist; its folder is created if it does not. - for standard output.
    #[arg(default_value = DEFAULT_MANIFEST, value_hint = ValueHint::FilePath)]
    file: PathBuf,
}

const STARTER: &[u8] = include_bytes!("starter.toml");

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if files::is_standard(&arguments.file) {
        print_bytes(STARTER)?;
        return Ok(Outcome::Done);
    }
    let file = printable(arguments.file.display());
    if let Some(folder) = arguments.file.parent().filter(|folder| *folder != Path::new("")) {
        output::create_folder(folder)?;
    }
    match output::write_new(&arguments.file, STARTER) {
        Err(output::Error::Write { source, .. }) if source.kind() == ErrorKind::AlreadyExists => {
            Err(Failure::input(format!("{file} exists already; give another name, or remove the file first")))
        }
        result => {
            result?;
            print(&format!("written to {file}; `coupler-atlas render {file}` draws it\n"))?;
            Ok(Outcome::Done)
        }
    }
}
