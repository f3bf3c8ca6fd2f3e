//! Work on another thread, while the calling one shows progress and looks for Ctrl-C. No other Python thread waits for it.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use pyo3::prelude::*;

use crate::error::Error;

/// How often the calling thread looks for Ctrl-C and shows progress.
const LOOK: Duration = Duration::from_millis(50);

/// How long interrupted work may take to end; after that the call returns, and the work ends by itself.
const GRACE: Duration = Duration::from_millis(500);

/// What work and the calling thread know of each other.
#[derive(Clone, Debug, Default)]
pub struct Task {
    /// Whether the work is to end soon.
    pub interrupt: Arc<AtomicBool>,
    name: Arc<Mutex<String>>,
    done: Arc<AtomicUsize>,
    total: Arc<AtomicUsize>,
}

impl Task {
    /// Begins a part of the work with a name and a number of steps.
    pub fn begin(&self, name: &str, total: usize) {
        if let Ok(mut own) = self.name.lock() {
            *own = name.to_owned();
        }
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// Reports further steps.
    pub fn advance(&self, steps: usize) {
        self.done.fetch_add(steps, Ordering::Relaxed);
    }

    /// Begins work that reports which part of it is done, from 0 to 1; what it does again does not count.
    pub fn report_parts(&self, name: &str) -> impl FnMut(f64) {
        /// The steps that are shown of the whole work.
        const STEPS: usize = 1000;
        self.begin(name, STEPS);
        let mut done = 0;
        move |part: f64| {
            let steps = (part * STEPS as f64) as usize;
            self.advance(steps.saturating_sub(done));
            done = done.max(steps);
        }
    }

    /// Whether the work is to end soon.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    fn progress(&self) -> (usize, usize, String) {
        let name = self.name.lock().map(|name| name.clone()).unwrap_or_default();
        (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed), name)
    }
}

/// Checks that this process has the threads on which work is divided: those of a process that was forked are not in the new one, and
/// what waits for them would never end.
///
/// # Errors
/// They are those of another process.
pub fn require_threads() -> PyResult<()> {
    static PROCESS: OnceLock<u32> = OnceLock::new();
    match *PROCESS.get_or_init(std::process::id) == std::process::id() {
        true => Ok(()),
        false => Err(Error::new_err(
            "this process was forked from one that had computed on several threads, which a fork does not have: start processes with the method              \"spawn\" or \"forkserver\", as in multiprocessing.get_context(\"spawn\")",
        )),
    }
}

/// Runs work on another thread and returns its result. `progress` is the argument of that name, see `coupler_atlas/_progress.py`.
///
/// # Errors
/// Ctrl-C, or an exception of `progress`; the work is then told to end. A fork has no threads.
pub fn run<T: Send + 'static>(
    py: Python,
    progress: Option<&Bound<PyAny>>,
    work: impl FnOnce(&Task) -> T + Send + 'static,
) -> PyResult<T> {
    require_threads()?;
    let reporter = py.import("coupler_atlas._progress")?.getattr("reporter")?.call1((progress,))?;
    run_with(py, if reporter.is_none() { None } else { Some(&reporter) }, work)
}

/// The same with a reporter, or none.
pub fn run_with<T: Send + 'static>(
    py: Python,
    reporter: Option<&Bound<PyAny>>,
    work: impl FnOnce(&Task) -> T + Send + 'static,
) -> PyResult<T> {
    let task = Task::default();
    let (sender, mut receiver) = mpsc::channel();
    let own = task.clone();
    std::thread::spawn(move || {
        // Nobody receives the result of work that was given up.
        let _ = sender.send(work(&own));
    });
    let mut shown = (0, 0, String::new());
    let result = loop {
        let (same, message) = py.detach(move || {
            let message = receiver.recv_timeout(LOOK);
            (receiver, message)
        });
        receiver = same;
        let is_done = !matches!(message, Err(RecvTimeoutError::Timeout));
        let now = task.progress();
        let report = || -> PyResult<()> {
            if let Some(reporter) = reporter.filter(|_| now != shown) {
                reporter.call1((now.0, now.1, now.2.as_str()))?;
            }
            py.check_signals()
        };
        if let Err(error) = report() {
            task.interrupt.store(true, Ordering::Relaxed);
            if !is_done {
                py.detach(move || drop(receiver.recv_timeout(GRACE)));
            }
            break Err(error);
        }
        shown = now;
        match message {
            Ok(result) => break Ok(result),
            Err(RecvTimeoutError::Disconnected) => break Err(Error::new_err("a thread of the program has panicked")),
            Err(RecvTimeoutError::Timeout) => {}
        }
    };
    if let Some(close) = reporter.and_then(|reporter| reporter.getattr("close").ok()) {
        close.call0()?;
    }
    result
}
