//! The steps of a search on all threads.

use std::sync::atomic::{AtomicBool, Ordering};

use coupler_find::Workers;
use rayon::prelude::*;

/// A search was told to end.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error("interrupted")]
pub struct Interrupted;

/// All threads, until a search is interrupted.
pub(crate) struct Threads<'a> {
    pub interrupt: &'a AtomicBool,
}

impl Threads<'_> {
    /// Whether it is.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    /// Ends a search that is interrupted.
    ///
    /// # Errors
    /// It is.
    pub fn proceed(&self) -> Result<(), Interrupted> {
        if self.is_interrupted() { Err(Interrupted) } else { Ok(()) }
    }
}

impl Workers for Threads<'_> {
    fn most_at_once(&self) -> usize {
        usize::MAX
    }

    fn map<T: Send, R: Send>(&self, items: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
        let results = items.into_par_iter().map(|item| (!self.is_interrupted()).then(|| work(item)));
        results.collect::<Option<Vec<R>>>().unwrap_or_default()
    }
}
