//! What is written to standard output and standard error.

use std::io::{self, Write};

use super::printable::printable_lines;

/// Writes a text to be read to standard output.
pub(super) fn print(text: &str) -> io::Result<()> {
    print_bytes(printable_lines(text).as_bytes())
}

/// Writes a result for programs, or one that is not text, to standard output as it is.
pub(super) fn print_bytes(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

/// Writes a message with the escape sequences of colours to standard error.
pub(super) fn print_styled(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Writes a message to standard error; a failure to do so is ignored.
pub(super) fn print_stderr(text: &str) {
    let _ = io::stderr().write_all(printable_lines(text).as_bytes());
}
