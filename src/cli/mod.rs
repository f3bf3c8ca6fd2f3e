//! The command line: arguments, one file for each subcommand, progress and exit codes. No other module prints.

mod check;
mod choice;
mod color;
mod completions;
mod design;
mod export;
mod files;
mod find;
mod format;
mod gather;
mod hints;
mod init;
mod inspect;
mod linkage;
mod list;
mod manual;
mod not_a_manifest;
mod printable;
mod render;
mod report;
mod schema;
mod source;
mod sweep;
mod validate;

use std::ffi::OsString;
use std::io::{self, Write};

use crate::{output, shard};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use color::Color;
use format::pluralize;
use printable::{printable, printable_lines};

/// The exit codes, and what they mean.
const EXIT_CODES: [(u8, &str); 5] = [
    (EXIT_SUCCESS, "success"),
    (EXIT_DIFFERENCE, "check found a difference, or render --strict a cell that is not assembled over the whole range"),
    (EXIT_INPUT_ERROR, "the input was wrong"),
    (EXIT_SYSTEM_ERROR, "the system failed, or another run is writing to the folder"),
    (EXIT_INTERRUPTED, "interrupted"),
];

/// The exit codes, at the end of the help.
fn exit_codes_help() -> String {
    format!("Exit codes: {}.", EXIT_CODES.map(|(code, meaning)| format!("{code} {meaning}")).join("; "))
}

/// Solve families of planar linkages, and draw their coupler curves as the pages of an atlas.
#[derive(Debug, Parser)]
#[command(
    name = "coupler-atlas",
    version,
    disable_help_subcommand = true,
    max_term_width = MAX_HELP_WIDTH,
    after_help = exit_codes_help()
)]
struct Arguments {
    /// Whether messages have colours; auto: on a terminal, unless NO_COLOR is set, and wherever CLICOLOR_FORCE is set.
    #[arg(
        long,
        global = true,
        value_name = "WHEN",
        value_enum,
        default_value_t = Color::default(),
        display_order = COLOR_DISPLAY_ORDER
    )]
    color: Color,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(render::Arguments),
    Validate(validate::Arguments),
    Check(check::Arguments),
    Inspect(inspect::Arguments),
    Design(Box<design::Arguments>),
    Find(Box<find::Arguments>),
    Export(export::Arguments),
    List(list::Arguments),
    Sweep(sweep::Arguments),
    Gather(gather::Arguments),
    Init(init::Arguments),
    Completions(completions::Arguments),
    Man(manual::Manual),
}

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Success.
    Done,
    /// Success, but `check` found a difference, or `render --strict` an unassembled cell.
    Difference,
}

/// An error in the user's input, for which the exit code is 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct InputError(String);

/// Errors in the user's input, and notes on them, a line for each; the first line is an error.
#[derive(Debug, thiserror::Error)]
#[error("{}", .0.join("\n"))]
struct InputErrors(Vec<String>);

impl InputErrors {
    /// Several errors.
    fn from_messages(messages: &[String]) -> InputErrors {
        let prefix = |k: usize| if k == 0 { "" } else { "error: " };
        // Further lines of a message belong to it.
        let lines = |(k, message): (usize, &String)| {
            format!("{}{message}", prefix(k)).lines().map(str::to_owned).collect::<Vec<_>>()
        };
        InputErrors(messages.iter().enumerate().flat_map(lines).collect())
    }
}

/// The greatest width of the help, in columns; narrower terminals and `COLUMNS` make it narrower.
const MAX_HELP_WIDTH: usize = 100;

/// The place of `--color` in the help: after the options of a command, which are numbered from 0, and before `--help`.
const COLOR_DISPLAY_ORDER: usize = 900;

const EXIT_SUCCESS: u8 = 0;
const EXIT_DIFFERENCE: u8 = 1;
const EXIT_INPUT_ERROR: u8 = 2;
const EXIT_SYSTEM_ERROR: u8 = 3;
const EXIT_INTERRUPTED: u8 = 130;

/// Runs the program with the arguments of a command line, of which the first is the program's name, and returns the exit code.
/// Arguments that are wrong, and those that ask for help, end the process.
pub fn run(given: &[OsString]) -> u8 {
    let arguments = match parse_arguments(given) {
        Ok(arguments) => arguments,
        Err(error) => error.exit(),
    };
    arguments.color.set();
    let result = match arguments.command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Validate(arguments) => validate::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Design(arguments) => design::run(&arguments),
        Command::Find(arguments) => find::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Gather(arguments) => gather::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => manual::print_manual(&arguments),
    };
    match result {
        Ok(Outcome::Done) => EXIT_SUCCESS,
        Ok(Outcome::Difference) => EXIT_DIFFERENCE,
        Err(error) => report_failure(&error),
    }
}

/// The report of a check as text, for people.
pub fn check_report(report: &crate::check::Report) -> String {
    printable_lines(&check::report_text(report))
}

/// Parses the command line; an error quotes arguments as they can be printed.
fn parse_arguments(given: &[OsString]) -> Result<Arguments, clap::Error> {
    let color = Color::from_arguments(given).for_clap();
    let parse = |arguments: &[OsString]| {
        let mut command = Arguments::command().color(color);
        let matches = command.try_get_matches_from_mut(arguments)?;
        Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
    };
    parse(given).map_err(|error| {
        let shown: Vec<OsString> = given.iter().map(|argument| printable(argument.to_string_lossy()).into()).collect();
        let error = parse(&shown).err().unwrap_or_else(|| {
            // Only the unprintable characters were wrong.
            clap::Error::raw(error.kind(), "an argument has control characters\n")
        });
        hints::with_hint(error, &Arguments::command(), &shown)
    })
}

/// Prints an error, and returns the exit code for it.
fn report_failure(error: &anyhow::Error) -> u8 {
    // A reader that closes the pipe early, as `head` does, is not an error.
    let is_pipe = |e: &io::Error| e.kind() == io::ErrorKind::BrokenPipe;
    if error.downcast_ref::<io::Error>().is_some_and(is_pipe) {
        return EXIT_SUCCESS;
    }
    // The messages of all other errors name what failed.
    let lines = match (error.downcast_ref::<io::Error>(), error.downcast_ref::<InputErrors>()) {
        (Some(error), _) => {
            vec![format!("cannot write to standard output: {error}; the files that were written are complete")]
        }
        (None, Some(InputErrors(lines))) => lines.clone(),
        (None, None) => vec![error.to_string()],
    };
    if lines.iter().any(|line| !line.is_empty()) {
        let lines: Vec<String> = lines.iter().map(printable).collect();
        print_stderr(&format!("error: {}\n", lines.join("\n")));
    }
    let is_input = error.downcast_ref::<InputError>().is_some()
        || error.downcast_ref::<InputErrors>().is_some()
        || matches!(
            error.downcast_ref(),
            Some(
                output::Error::Read { .. }
                    | output::Error::Record { .. }
                    | output::Error::ForeignRecord { .. }
                    | output::Error::OtherManifest { .. }
                    | output::Error::ForeignFile { .. }
                    | output::Error::TooManyFiles { .. }
            )
        )
        || matches!(error.downcast_ref(), Some(crate::check::Error::Record { .. }));
    let is_interrupted = matches!(error.downcast_ref(), Some(output::Error::Interrupted))
        || matches!(error.downcast_ref(), Some(shard::Error::Interrupted));
    match () {
        () if is_interrupted => EXIT_INTERRUPTED,
        () if is_input => EXIT_INPUT_ERROR,
        () => EXIT_SYSTEM_ERROR,
    }
}

/// Writes a text to be read to standard output.
fn print(text: &str) -> anyhow::Result<()> {
    print_bytes(printable_lines(text).as_bytes())
}

/// Writes a result for programs, or one that is not text, to standard output as it is.
fn print_bytes(bytes: &[u8]) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()?;
    Ok(())
}

/// Writes a message with the escape sequences of colours to standard error.
fn print_styled(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Writes a message to standard error; a failure to do so is ignored.
fn print_stderr(text: &str) {
    let _ = io::stderr().write_all(printable_lines(text).as_bytes());
}
