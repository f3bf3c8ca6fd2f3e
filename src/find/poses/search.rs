//! The search for linkages that guide a body, on all threads, and what to relax if there are none.

use std::sync::atomic::AtomicBool;

use coupler_find::{PoseFindings, PoseOptions, PoseSet, exact_guides, nearest_guides};

use super::super::Error;
use crate::threads::Threads;

/// The most poses that are passed exactly.
const MOST_EXACT: usize = 5;

/// What has been found for poses.
#[derive(Clone, Debug)]
pub struct FoundPoses {
    /// What has been found.
    pub findings: PoseFindings,
    /// If there is no linkage, what to relax for there to be one.
    pub relaxed: Option<Relaxed>,
}

/// Options without which there are linkages.
#[derive(Clone, Debug)]
pub struct Relaxed {
    /// The options, with words between underscores: `full_turn`, `where`, `pivots`, `max_link`, `any_order`, `any_circuit`.
    pub options: Vec<&'static str>,
    /// What is found without them.
    pub findings: PoseFindings,
}

/// Finds linkages that guide a body through poses: exactly through 2 to 5, and near more. The answer does not depend on the number of threads.
///
/// # Errors
/// `interrupt` is true.
pub fn find_poses(set: &PoseSet, options: &PoseOptions, interrupt: &AtomicBool) -> Result<FoundPoses, Error> {
    let threads = Threads { interrupt };
    let find = |options: &PoseOptions| {
        let findings = match set.poses().len() {
            ..=MOST_EXACT => exact_guides(set, options, &threads),
            _ => nearest_guides(set, options, &threads),
        };
        threads.proceed().map(|()| findings)
    };
    let findings = find(options)?;
    let mut relaxed = None;
    if findings.answers.is_empty() {
        for (names, options) in relaxations(options) {
            let findings = find(&options)?;
            if !findings.answers.is_empty() {
                relaxed = Some(Relaxed { options: names, findings });
                break;
            }
        }
    }
    Ok(FoundPoses { findings, relaxed })
}

/// Weaker options, each alone, then more and more of them together.
fn relaxations(options: &PoseOptions) -> Vec<(Vec<&'static str>, PoseOptions)> {
    type Relax = fn(&mut PoseOptions);
    let all: [(bool, &str, Relax); 7] = [
        (options.full_turn, "full_turn", |o| o.full_turn = false),
        (options.condition.is_some(), "where", |o| o.condition = None),
        (options.pivots.is_some(), "pivots", |o| o.pivots = None),
        (options.max_link.is_finite(), "max_link", |o| o.max_link = f64::INFINITY),
        (!options.any_order, "any_order", |o| o.any_order = true),
        (!options.any_circuit, "any_circuit", |o| o.any_circuit = true),
        (!options.given_pivots.is_empty(), "pivot", |o| o.given_pivots.clear()),
    ];
    let used: Vec<_> = all.into_iter().filter(|(is_set, ..)| *is_set).collect();
    let relaxed = |chosen: &[(bool, &'static str, Relax)]| {
        let mut weaker = options.clone();
        chosen.iter().for_each(|(_, _, relax)| relax(&mut weaker));
        (chosen.iter().map(|(_, name, _)| *name).collect(), weaker)
    };
    let alone = used.iter().map(|one| relaxed(std::slice::from_ref(one)));
    alone.chain((2..=used.len()).map(|count| relaxed(&used[..count]))).collect()
}
