//! Why a command fails, and with which exit code.

use std::fmt::{self, Display, Formatter};
use std::io;

use super::outcome::{EXIT_INPUT_ERROR, EXIT_INTERRUPTED, EXIT_SUCCESS, EXIT_SYSTEM_ERROR};
use super::printable::printable;
use super::printing::print_stderr;
use crate::{check, output, shard};

/// Why a command fails: what is said, a line each, of which further ones may be errors of their own or notes, and the exit code.
#[derive(Debug)]
pub(super) struct Failure {
    lines: Vec<String>,
    exit_code: u8,
}

impl Failure {
    /// The system failed.
    pub fn system(message: impl ToString) -> Failure {
        Failure { lines: vec![message.to_string()], exit_code: EXIT_SYSTEM_ERROR }
    }

    /// The input was wrong.
    pub fn input(message: impl ToString) -> Failure {
        Failure { exit_code: EXIT_INPUT_ERROR, ..Failure::system(message) }
    }

    /// The input was wrong in several ways.
    pub fn inputs(messages: &[String]) -> Failure {
        let prefix = |k: usize| if k == 0 { "" } else { "error: " };
        // Further lines of a message belong to it.
        let lines = |(k, message): (usize, &String)| {
            format!("{}{message}", prefix(k)).lines().map(str::to_owned).collect::<Vec<_>>()
        };
        Failure { lines: messages.iter().enumerate().flat_map(lines).collect(), exit_code: EXIT_INPUT_ERROR }
    }

    fn interrupted(message: impl ToString) -> Failure {
        Failure { exit_code: EXIT_INTERRUPTED, ..Failure::system(message) }
    }

    /// Whether the input was wrong.
    pub fn is_input(&self) -> bool {
        self.exit_code == EXIT_INPUT_ERROR
    }

    /// Whether the command was interrupted.
    pub fn is_interrupted(&self) -> bool {
        self.exit_code == EXIT_INTERRUPTED
    }

    /// Prints what is said, and returns the exit code.
    pub fn report(&self) -> u8 {
        if self.lines.iter().any(|line| !line.is_empty()) {
            let lines: Vec<String> = self.lines.iter().map(printable).collect();
            print_stderr(&format!("error: {}\n", lines.join("\n")));
        }
        self.exit_code
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(&self.lines.join("\n"))
    }
}

/// Of standard output: other errors name their files.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Failure {
        // A reader that closes the pipe early, as `head` does, is not an error.
        match error.kind() {
            io::ErrorKind::BrokenPipe => Failure { lines: Vec::new(), exit_code: EXIT_SUCCESS },
            _ => Failure::system(format_args!(
                "cannot write to standard output: {error}; the files that were written are complete"
            )),
        }
    }
}

impl From<output::Error> for Failure {
    fn from(error: output::Error) -> Failure {
        match error {
            output::Error::Interrupted => Failure::interrupted(error),
            _ if error.is_input() => Failure::input(error),
            _ => Failure::system(error),
        }
    }
}

impl From<check::Error> for Failure {
    fn from(error: check::Error) -> Failure {
        match &error {
            check::Error::Record { source, .. } if !source.is_system_failure() => Failure::input(error),
            check::Error::Interrupted => Failure::interrupted(error),
            _ => Failure::system(error),
        }
    }
}

impl From<shard::Error> for Failure {
    fn from(error: shard::Error) -> Failure {
        match error {
            shard::Error::Output(error) => error.into(),
            shard::Error::Interrupted => Failure::interrupted(error),
            shard::Error::Unreadable(problems) => Failure::system(problems.join("\nerror: ")),
            shard::Error::Problems(problems) => Failure::inputs(&problems),
            error => Failure::input(error),
        }
    }
}

impl From<rayon::ThreadPoolBuildError> for Failure {
    fn from(error: rayon::ThreadPoolBuildError) -> Failure {
        Failure::system(error)
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Failure {
        Failure::system(error)
    }
}
