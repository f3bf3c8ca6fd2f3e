//! Ctrl-C.

use std::fmt::Display;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::Failure;
use super::outcome::EXIT_INTERRUPTED;
use super::printing::print_stderr;

/// How long a run may take to end after Ctrl-C before the process ends.
const GRACE_PERIOD: Duration = Duration::from_millis(700);

/// The same for a run that brings to an end what it has found.
pub(super) const LONG_GRACE_PERIOD: Duration = Duration::from_secs(10);

/// A flag that the first Ctrl-C sets; the second ends the program at once, and so does a run that does not look at it, with this
/// error.
pub(super) fn interrupt_flag(message: impl Display) -> Result<Arc<AtomicBool>, Failure> {
    interrupt_flag_within(GRACE_PERIOD, message)
}

/// The same for a run that takes so long to end.
pub(super) fn interrupt_flag_within(grace_period: Duration, message: impl Display) -> Result<Arc<AtomicBool>, Failure> {
    let message = message.to_string();
    let interrupt = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupt);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_INTERRUPTED.into());
        }
        // A cell of very many samples, or a large page, may not look at the flag soon enough. Whatever the threads are
        // doing, files are complete and in the journal.
        let message = message.clone();
        std::thread::spawn(move || {
            std::thread::sleep(grace_period);
            print_stderr(&format!("error: {message}\n"));
            std::process::exit(EXIT_INTERRUPTED.into());
        });
    })
    .map_err(Failure::system)?;
    Ok(interrupt)
}
