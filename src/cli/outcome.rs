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
