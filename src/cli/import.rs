//! `import`: prints a manifest with a linkage of another program.

use std::io::ErrorKind;
use std::path::Path;

use crate::import::{self, Format};
use crate::manifest;
use crate::output;
use clap::{Args, ValueHint};
use coupler_curves::problem;

use super::{Failure, Outcome, choice, color, files, print_bytes, print_stderr, print_styled, printable};

/// Print a manifest with a linkage of another program: an address of PMKS+, a mechanism of pylinkage or linkage_sim, an
/// expression of Pyslvs, a file of Linkage, LINKS or LInK, a table of joints and bars.
///
/// The linkage is a drawing of joints by coordinates, with a family of one cell; what was left out is in comments. Nothing
/// is fetched from a network. docs/import.md describes the formats.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The file, or the address or expression itself; - for standard input.
    #[arg(value_name = "FILE|ADDRESS", value_hint = ValueHint::FilePath)]
    source: String,
    /// The format, where it does not follow from the text: pmks, pylinkage, pyslvs, links, linkage2, linkage_sim, csv.
    #[arg(long, value_name = "NAME", value_parser = parse_format)]
    format: Option<Format>,
    /// What is driven, in place of the input in the text: a link on the frame by two of its joints, as in "A, B", or the
    /// angle from a line of a link to one of another, as in "A B, B C".
    #[arg(long, value_name = "JOINTS")]
    input: Option<String>,
}

fn parse_format(name: &str) -> Result<Format, String> {
    choice::parse("format", name, &Format::ALL.map(|format| (format.name(), format)))
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = Path::new(&arguments.source);
    let is_text = import::is_text(&arguments.source) && !path.is_file();
    let (name, text) = match is_text {
        true => ("the linkage".to_owned(), arguments.source.clone()),
        false => (files::input_name(path), read_text(path)?),
    };
    let drawing = import::read(&text, arguments.format, arguments.input.as_deref())
        .map_err(|error| Failure::input(printable(format_args!("{name}: {error}"))))?;
    let manifest = import::manifest_text(&drawing);
    let outcome = manifest::parse(&manifest);
    let styled = color::is_stderr_styled();
    let report = problem::report(&outcome.problems, "the manifest", &manifest, styled);
    if styled {
        print_styled(&report)
    } else {
        print_stderr(&report)
    }
    if outcome.plan.is_none() {
        return Err(Failure::input(format!(
            "{name}: it cannot be drawn so: change it where it was made, or name another input with --input"
        )));
    }
    print_bytes(manifest.as_bytes())?;
    Ok(Outcome::Done)
}

/// Reads a file, or standard input.
fn read_text(path: &Path) -> Result<String, Failure> {
    let name = files::input_name(path);
    output::read_text(path).map_err(|error| match error {
        output::Error::Read { source, .. } if source.kind() == ErrorKind::InvalidData => {
            Failure::input(format!("{name} is not a text: give one of the formats in docs/import.md"))
        }
        output::Error::Read { source, .. } if files::is_standard(path) => files::standard_input_error(&source),
        output::Error::Read { source, .. } if source.kind() == ErrorKind::NotFound => {
            Failure::input(format!("cannot find {name}: give a file, or an address with its `?` in quotation marks"))
        }
        output::Error::Read { source, .. } if source.kind() == ErrorKind::IsADirectory => {
            Failure::input(format!("{name} is a folder: give a file in it"))
        }
        error => error.into(),
    })
}
