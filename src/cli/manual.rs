//! `man`: the manual page, generated from the arguments.

use std::io;

use crate::gallery::{KERNEL_FILE, PAGE_FILE};
use crate::record::{JOURNAL_FILE_NAME, RUN_FILE_NAME};
use clap::Args;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};

use super::files::DEFAULT_MANIFEST;
use super::{EXIT_CODES, Failure, Outcome, color, print_bytes};

/// Print the manual page in roff: coupler-atlas man | man -l -
#[derive(Debug, Args)]
pub struct Manual {}

/// Commands, in the order in which one may run them in an empty folder, and what they do.
const EXAMPLES: [(&str, &str); 7] = [
    ("coupler-atlas init", "Write a commented manifest, atlas.toml, to start from."),
    ("coupler-atlas render", "Draw its atlas into the folder that it names, output; output/index.html shows it."),
    ("coupler-atlas check --against output", "Report what has changed since it was drawn."),
    ("coupler-atlas export mine:1 --format dxf -o curve.dxf", "Write a curve of it as a CAD drawing."),
    ("coupler-atlas inspect hoeken --at 30", "Describe a linkage of the catalogue, and its pose at 30 degrees."),
    (
        "coupler-atlas design straight-line --input motor --length 100 --toml > best.toml",
        "Write a manifest of the straight-line linkages that a motor can drive.",
    ),
    ("coupler-atlas render - -o best < best.toml", "Draw the atlas of a manifest from standard input."),
];

/// The files of an atlas, and what they are.
fn files() -> [(String, &'static str); 8] {
    let in_folder = |name: &str| format!("DIR/{name}");
    [
        (DEFAULT_MANIFEST.to_owned(), "The manifest of commands that are given none."),
        (in_folder(PAGE_FILE), "The gallery of the atlas in the folder DIR, for a browser."),
        (in_folder(KERNEL_FILE), "The script by which the gallery moves, measures and exports linkages."),
        (in_folder("FAMILY/FAMILY-001.svg"), "The first page of a family; also as .png."),
        (in_folder("FAMILY/points.csv"), "The points of the curves of a family."),
        (in_folder("FAMILY/cells.csv"), "The parameters and measures of the cells of a family."),
        (in_folder(RUN_FILE_NAME), "The record of the atlas: which manifest made it, and the digests of its files."),
        (in_folder(JOURNAL_FILE_NAME), "What an unfinished run has done; the next run continues from there."),
    ]
}

/// Prints one manual page: the program, then a section for each command.
pub fn print_manual(_: &Manual, mut command: clap::Command) -> Result<Outcome, Failure> {
    command.build();
    let mut page = Vec::new();
    let program = Man::new(command.clone());
    program.render_title(&mut page)?;
    program.render_name_section(&mut page)?;
    program.render_synopsis_section(&mut page)?;
    program.render_description_section(&mut page)?;
    program.render_options_section(&mut page)?;
    for command in command.get_subcommands().filter(|command| !command.is_hide_set()) {
        write_command_section(command, &mut page)?;
    }
    write_table("FILES", &files(), &mut page)?;
    let codes = EXIT_CODES.map(|(code, meaning)| (code.to_string(), sentence(meaning)));
    write_table("EXIT STATUS", &codes, &mut page)?;
    write_table("ENVIRONMENT", &color::VARIABLES, &mut page)?;
    write_table("EXAMPLES", &EXAMPLES, &mut page)?;
    program.render_version_section(&mut page)?;
    print_bytes(&page)?;
    Ok(Outcome::Done)
}

/// Writes a section of terms, each with its description.
fn write_table(title: &str, rows: &[(impl AsRef<str>, impl AsRef<str>)], page: &mut Vec<u8>) -> io::Result<()> {
    let mut roff = Roff::new();
    roff.control("SH", [title]);
    for (term, description) in rows {
        roff.control("TP", []);
        roff.text([bold(term.as_ref())]);
        roff.text([roman(description.as_ref())]);
    }
    roff.to_writer(page)
}

/// A text as a sentence: "Success."
fn sentence(text: &str) -> String {
    let mut rest = text.chars();
    let first: String = rest.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}.", rest.as_str())
}

/// Writes the section of a command: its synopsis, description and options, without those of the program.
fn write_command_section(command: &clap::Command, page: &mut Vec<u8>) -> io::Result<()> {
    use io::Write;
    let mut body = Vec::new();
    let global: Vec<clap::Id> =
        command.get_arguments().filter(|argument| argument.is_global_set()).map(|a| a.get_id().clone()).collect();
    let hide = |command: clap::Command, id| command.mut_arg(id, |argument| argument.hide(true));
    let man = Man::new(global.into_iter().fold(command.clone(), hide));
    man.render_synopsis_section(&mut body)?;
    man.render_description_section(&mut body)?;
    man.render_options_section(&mut body)?;
    // Sections of the command's own page become subsections of this one.
    let body = String::from_utf8_lossy(&body).replace(".SH ", ".SS ");
    writeln!(page, ".SH {}", command.get_name().to_uppercase())?;
    page.write_all(body.as_bytes())
}
