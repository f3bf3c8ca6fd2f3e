//! Arguments, one file a subcommand, progress and exit codes. Every print is here.

mod check;
mod design;
mod export;
mod init;
mod inspect;
mod linkage;
mod list;
mod manual;
mod render;
mod schema;
mod source;
mod validate;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use coupler_atlas::output;

const EXIT_CODES: &str = "Exit codes: 0 done; 1 the check found a difference, or with --strict a cell is not assembled; 2 the input was wrong; \
                          3 the machine failed, or another run is writing there; 130 interrupted.";

/// Atlases of coupler curves: solves families of planar linkages and draws them as pages.
#[derive(Debug, Parser)]
#[command(name = "coupler-atlas", version, about, disable_help_subcommand = true, after_help = EXIT_CODES)]
struct Arguments {
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
    Export(export::Arguments),
    List(list::Arguments),
    Init(init::Arguments),
    Completions(manual::Completions),
    Man(manual::Manual),
}

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Done.
    Done,
    /// Done, and a difference or an unassembled cell was found where none was allowed.
    Difference,
}

/// The input was wrong; what is wrong has been said, or is this message.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct InputError(String);

const EXIT_INPUT_ERROR: u8 = 2;
const EXIT_SYSTEM_ERROR: u8 = 3;
const EXIT_INTERRUPTED: u8 = 130;

/// Runs the program.
pub fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Validate(arguments) => validate::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Design(arguments) => design::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::List(arguments) => list::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::Completions(arguments) => manual::print_completions(&arguments),
        Command::Man(arguments) => manual::print_manual(&arguments),
    };
    match result {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Difference) => ExitCode::from(1),
        Err(error) => report_failure(&error),
    }
}

/// Says what went wrong and finds the exit code for it.
fn report_failure(error: &anyhow::Error) -> ExitCode {
    // Whoever reads our output has seen enough: no failure of ours, and nobody to tell.
    let is_pipe = |e: &io::Error| e.kind() == io::ErrorKind::BrokenPipe;
    if error.downcast_ref::<io::Error>().is_some_and(is_pipe) {
        return ExitCode::SUCCESS;
    }
    // Each message names its cause itself, but for what cannot be printed.
    let message = match error.downcast_ref::<io::Error>() {
        Some(error) => format!("cannot write to standard output: {error}; the files that were written are whole"),
        None => error.to_string(),
    };
    if !message.is_empty() {
        let _ = writeln!(io::stderr(), "error: {message}");
    }
    let is_input = error.downcast_ref::<InputError>().is_some()
        || matches!(
            error.downcast_ref(),
            Some(output::Error::Read { .. } | output::Error::Record { .. } | output::Error::Format { .. })
        )
        || matches!(error.downcast_ref(), Some(coupler_atlas::check::Error::Record { .. }));
    let is_interrupted = matches!(error.downcast_ref(), Some(output::Error::Interrupted));
    ExitCode::from(match () {
        () if is_interrupted => EXIT_INTERRUPTED,
        () if is_input => EXIT_INPUT_ERROR,
        () => EXIT_SYSTEM_ERROR,
    })
}

/// Writes a result to standard output.
fn print(text: &str) -> anyhow::Result<()> {
    print_bytes(text.as_bytes())
}

/// Writes a result that need not be text to standard output.
fn print_bytes(bytes: &[u8]) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()?;
    Ok(())
}

/// Says something on standard error; nobody may be listening.
fn print_stderr(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// "1 page", "2 pages".
fn pluralize(n: usize, thing: &str) -> String {
    if n == 1 { format!("1 {thing}") } else { format!("{n} {thing}s") }
}
