//! The search for a function on all threads.

use std::sync::atomic::AtomicBool;

use coupler_find::{FunctionFindings, FunctionMethod, FunctionOptions, FunctionTarget, generate_function};

use super::super::Error;
use crate::threads::Threads;

/// What has been found by a method.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionAttempt {
    /// How.
    pub method: FunctionMethod,
    /// What.
    pub findings: FunctionFindings,
}

/// Finds linkages by some methods in turn until one has an answer: all attempts, the last of which is what has been found. The answer does not depend on the
/// number of threads.
///
/// # Errors
/// `interrupt` is true.
pub fn find_function(
    target: &FunctionTarget,
    options: &FunctionOptions,
    methods: &[FunctionMethod],
    interrupt: &AtomicBool,
) -> Result<Vec<FunctionAttempt>, Error> {
    let threads = Threads { interrupt };
    let mut attempts: Vec<FunctionAttempt> = Vec::new();
    for &method in methods {
        let findings = generate_function(target, &FunctionOptions { method, ..options.clone() }, &threads);
        threads.proceed()?;
        attempts.push(FunctionAttempt { method, findings });
        if attempts.last().is_some_and(|attempt| !attempt.findings.answers.is_empty()) {
            break;
        }
    }
    Ok(attempts)
}
