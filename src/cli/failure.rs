//! The errors of commands.

use std::io;

use super::outcome::{EXIT_INPUT_ERROR, EXIT_INTERRUPTED, EXIT_SUCCESS, EXIT_SYSTEM_ERROR, InputError, InputErrors};
use super::printable::printable;
use super::printing::print_stderr;
use crate::{output, shard};

/// Prints an error, and returns the exit code for it.
pub(super) fn report_failure(error: &anyhow::Error) -> u8 {
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
        || error.downcast_ref().is_some_and(output::Error::is_input)
        || matches!(error.downcast_ref(), Some(crate::check::Error::Record { source, .. }) if !source.is_system_failure());
    let is_interrupted = matches!(error.downcast_ref(), Some(output::Error::Interrupted))
        || matches!(error.downcast_ref(), Some(shard::Error::Interrupted));
    match () {
        () if is_interrupted => EXIT_INTERRUPTED,
        () if is_input => EXIT_INPUT_ERROR,
        () => EXIT_SYSTEM_ERROR,
    }
}
