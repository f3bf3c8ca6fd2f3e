//! The command line: arguments, one file for each subcommand, progress and exit codes. No other module prints.

mod aligned_table;
mod best_table;
mod check;
mod choice;
mod color;
mod completions;
mod design;
mod effort;
mod export;
mod failure;
mod files;
mod find;
mod gather;
mod hints;
mod import;
mod init;
mod inspect;
mod interrupt;
mod jams;
mod linkage;
mod list;
mod manual;
mod not_a_manifest;
mod outcome;
mod printable;
mod printing;
mod progress_bar;
mod render;
mod report;
mod schema;
mod source;
mod sweep;
mod validate;

use std::ffi::OsString;

use crate::output;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use color::Color;
use failure::Failure;
use outcome::{EXIT_CODES, EXIT_DIFFERENCE, EXIT_SUCCESS, Outcome};
use printable::{printable, printable_lines};
use printing::{print, print_bytes, print_stderr, print_styled};

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
    Import(import::Arguments),
    Init(init::Arguments),
    Completions(completions::Arguments),
    Man(manual::Manual),
}

/// The greatest width of the help, in columns; narrower terminals and `COLUMNS` make it narrower.
const MAX_HELP_WIDTH: usize = 100;

/// The place of `--color` in the help: after the options of a command, which are numbered from 0, and before `--help`.
const COLOR_DISPLAY_ORDER: usize = 900;

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
        Command::Import(arguments) => import::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, Arguments::command()),
        Command::Man(arguments) => manual::print_manual(&arguments, Arguments::command()),
    };
    let code = match result {
        Ok(Outcome::Done) => EXIT_SUCCESS,
        Ok(Outcome::Difference) => EXIT_DIFFERENCE,
        Err(failure) => failure.report(),
    };
    for (path, error) in output::take_leftovers() {
        let (path, error) = (printable(path.display()), printable(error));
        print_stderr(&format!("warning: cannot remove {path}, a temporary file, which does no harm: {error}\n"));
    }
    code
}

/// The report of a check as text, for people.
pub fn check_report(report: &crate::check::Report) -> String {
    printable_lines(&check::report_text(report))
}

/// The command whose options take negative numbers, so that each says itself what is wrong with them.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let takes_value = |arg: &clap::Arg| arg.get_action().takes_values() && !arg.is_positional();
    command
        .mut_args(|arg| if takes_value(&arg) { arg.allow_negative_numbers(true) } else { arg })
        .mut_subcommands(with_negative_numbers)
}

/// Parses the command line; an error quotes arguments as they can be printed.
fn parse_arguments(given: &[OsString]) -> Result<Arguments, clap::Error> {
    let color = Color::from_arguments(given).for_clap();
    let parse = |arguments: &[OsString]| {
        let mut command = with_negative_numbers(Arguments::command().color(color));
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
