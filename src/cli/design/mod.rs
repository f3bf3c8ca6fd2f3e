//! `design`: finds the dimensions of linkages for what is wished of them.

mod straight_line;
mod wishes;

use clap::{Args, Subcommand};

use super::{Failure, Outcome};

/// Find the dimensions of any linkage by wishes on its measures; design straight-line finds straight-line linkages.
///
/// Conditions (--where) are met and goals (--maximize, --minimize) are as great or as small as possible, within the ranges of the parameters.
/// Of several goals the answers are trade-offs: none is exceeded by another one in all of them. If no linkage meets the conditions, the
/// error says for each what it comes to while the others are met. docs/design.md begins from what is wished.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    #[command(subcommand)]
    task: Option<Task>,
    #[command(flatten)]
    wishes: wishes::WishArguments,
}

#[derive(Debug, Subcommand)]
enum Task {
    StraightLine(Box<straight_line::Arguments>),
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match &arguments.task {
        Some(Task::StraightLine(arguments)) => straight_line::run(arguments),
        None => wishes::run(&arguments.wishes),
    }
}
