//! How a command ends: its outcome, the errors in its input, and the exit codes.

/// The exit codes, and what they mean.
pub(super) const EXIT_CODES: [(u8, &str); 5] = [
    (EXIT_SUCCESS, "success"),
    (EXIT_DIFFERENCE, "check found a difference, or render --strict a cell that is not assembled over the whole range"),
    (EXIT_INPUT_ERROR, "the input was wrong"),
    (EXIT_SYSTEM_ERROR, "the system failed, or another run is writing to the folder"),
    (EXIT_INTERRUPTED, "interrupted"),
];

pub(super) const EXIT_SUCCESS: u8 = 0;
pub(super) const EXIT_DIFFERENCE: u8 = 1;
pub(super) const EXIT_INPUT_ERROR: u8 = 2;
pub(super) const EXIT_SYSTEM_ERROR: u8 = 3;
pub(super) const EXIT_INTERRUPTED: u8 = 130;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Success.
    Done,
    /// Success, but `check` found a difference, or `render --strict` an unassembled cell.
    Difference,
}

/// An error in the user's input, for which the exit code is 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(super) struct InputError(pub String);

/// Errors in the user's input, and notes on them, a line for each; the first line is an error.
#[derive(Debug, thiserror::Error)]
#[error("{}", .0.join("\n"))]
pub(super) struct InputErrors(pub Vec<String>);

impl InputErrors {
    /// Several errors.
    pub fn from_messages(messages: &[String]) -> InputErrors {
        let prefix = |k: usize| if k == 0 { "" } else { "error: " };
        // Further lines of a message belong to it.
        let lines = |(k, message): (usize, &String)| {
            format!("{}{message}", prefix(k)).lines().map(str::to_owned).collect::<Vec<_>>()
        };
        InputErrors(messages.iter().enumerate().flat_map(lines).collect())
    }
}
