//! The linkages of an atlas whose curves are nearest to a path.

mod answer;
mod search;

pub use answer::{AtlasAnswer, AtlasQuery};

use std::sync::atomic::AtomicBool;

use coupler_curves::exchange::{ParameterSet, manifest_families};
use coupler_find::{
    Answer, Condition, Constraint, Index, Mechanism, Options, Search, Target, answer_families, answers_manifest,
    distinct, manifest_head, title_for,
};
use rayon::prelude::*;

use super::{Error, Findings, description};
use crate::manifest::Plan;
use search::AtlasOptions;

/// Finds the curves of an atlas that are nearest to a target. Four-bars are refined, others only placed on it; curves that are the same to a
/// thousandth of the target's size are one. All threads solve cells; memory is bounded.
///
/// # Errors
/// The condition is none in any of the families, or `interrupt` is true.
pub fn find_in_atlas(
    plan: &Plan,
    target: &Target,
    query: &AtlasQuery,
    interrupt: &AtomicBool,
) -> Result<Findings<AtlasAnswer>, Error> {
    let options = AtlasOptions::new(query);
    let (found, curves) = search::search_atlas(plan, target, &options, interrupt)?;
    let answers = ranked(found, target, query);
    let mut nearest_miss = None;
    if answers.is_empty() {
        let mut detours = None;
        let (mut others, _) = search::search_atlas(plan, target, &options.relaxed(), interrupt)?;
        if others.is_empty() && Constraint::Detours.is_set(target, query.options) {
            detours = Some(Constraint::Detours);
            (others, _) = search::search_atlas(plan, &target.opened(), &options.relaxed(), interrupt)?;
        }
        if let Some(nearest) = others.into_iter().next() {
            let mut relax = search::unmet_constraints(plan, target, &options, &nearest)?;
            relax.extend(detours);
            nearest_miss = Some((relax, nearest));
        }
    }
    Ok(Findings { curves, answers, nearest_miss })
}

/// Refines four-bars, merges curves that are the same, and ranks them.
fn ranked(found: Vec<AtlasAnswer>, target: &Target, query: &AtlasQuery) -> Vec<AtlasAnswer> {
    /// The curves that are refined for each answer, because several are refined to the same curve.
    const STARTS_PER_ANSWER: usize = 8;
    let most = query.options.most;
    let distinct = |found: Vec<AtlasAnswer>, most| distinct(found, |answer| &answer.curve.outline, target.size(), most);
    let mut found = distinct(found, STARTS_PER_ANSWER * most);
    // A condition on names that a four-bar does not have cannot be kept in a refinement.
    let condition = query.condition.map(|text| Condition::new(&Mechanism::template(), text)).transpose();
    if query.options.refine
        && !query.is_fixed
        && let Ok(condition) = condition
    {
        let options = Options { most: 1, condition, ..query.options.clone() };
        let index = Index::new();
        let refine = |found: &AtlasAnswer| {
            let start = found.curve.four_bar?;
            let answer = Search::from_four_bar(target, options.clone(), &start).run(&index).into_iter().next()?;
            let solved = answer.mechanism.solved().filter(|_| answer.deviation.rms < found.curve.fit.deviation.rms)?;
            let curve = &solved.curves[0];
            Some((answer, solved.circuit(curve).points(curve.joint).collect()))
        };
        found.par_iter_mut().for_each(|found| {
            if let Some((answer, outline)) = refine(found) {
                (found.refined, found.curve.outline) = (Some(answer), outline);
            }
        });
    }
    found.sort_by(|a, b| a.deviation().rms.total_cmp(&b.deviation().rms));
    distinct(found, most)
}

impl Findings<AtlasAnswer> {
    /// A manifest that renders the linkages: refined four-bars where they are on the path, others in the direction that they have in the
    /// atlas, and as large as they are on the path if their dimensions scale.
    pub fn manifest(&self, name: &str, target: &Target, plan: &Plan) -> String {
        let size = target.size();
        let refined: Vec<Answer> = self.answers.iter().filter_map(|answer| answer.refined.clone()).collect();
        let ranked = (1..).zip(&self.answers);
        let placed: Vec<(usize, &AtlasAnswer)> = ranked.filter(|(_, answer)| answer.refined.is_none()).collect();
        if placed.is_empty() {
            return answers_manifest(name, size, &refined);
        }
        let mut sets = Vec::new();
        let mut out = manifest_head("find", &title_for(name)) + &answer_families(name, size, &refined) + "\n";
        for (rank, answer) in placed {
            let AtlasAnswer { place, name, curve, .. } = answer;
            let as_large = if curve.is_scalable { "as large as on the path" } else { "in its own size" };
            out += &format!("# {rank}: {name}, {as_large}; {}\n", description::placement(curve, size));
            let family = &plan.families[place[0]].family;
            sets.push(ParameterSet {
                family,
                values: answer.scaled_values(plan),
                curve_name: format!("{rank}: {name}"),
            });
        }
        out + &manifest_families(&sets, false)
    }
}
