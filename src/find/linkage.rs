//! The dimensions of a linkage for which its curve is nearest to a path.

use std::sync::atomic::AtomicBool;

use coupler_curves::exchange::{ParameterSet, manifest_families};
use coupler_curves::family::Family;
use coupler_find::{
    LinkageAnswer, LinkageSearch, LinkageSpace, Options, Target, answers_manifest, manifest_head, nearest_miss_by,
    title_for,
};

use super::{Error, Findings, description};
use crate::threads::Threads;

/// Finds the dimensions of a linkage for which its curves are nearest to a target, looked up in `samples` parameter sets or a number that
/// depends on the linkage. Curves that are the same to a thousandth of the target's size are one. The answer does not depend on the number of
/// threads. `report_part` receives which part of the search is done, from 0 to 1, after each step.
///
/// # Errors
/// `interrupt` is true.
pub fn find_linkage(
    space: &LinkageSpace,
    target: &Target,
    options: &Options,
    samples: Option<usize>,
    interrupt: &AtomicBool,
    mut report_part: impl FnMut(f64),
) -> Result<Findings<LinkageAnswer>, Error> {
    let threads = Threads { interrupt };
    let mut search = |target: &Target, options: &Options| -> Result<_, Error> {
        let mut search = LinkageSearch::new(space, target, options, samples);
        while search.step(&threads) {
            threads.proceed()?;
            report_part(search.part_done());
        }
        let answers = search.answers(&threads);
        threads.proceed()?;
        Ok((answers, search.curve_count()))
    };
    let (answers, curves) = search(target, options)?;
    let mut nearest_miss = None;
    if answers.is_empty() {
        let nearest = |target: &Target, options: &Options| search(target, options).ok()?.0.into_iter().next();
        nearest_miss = nearest_miss_by(target, options, nearest, |answer| answer.curve.fit.deviation.rms);
        threads.proceed()?;
    }
    Ok(Findings { curves, answers, nearest_miss })
}

impl Findings<LinkageAnswer> {
    /// A manifest that renders the linkages: in the direction that they have on the path and mirrored as there, and as large if their
    /// dimensions scale. Families have no shift; comments have it. `own_linkage` is the text of the linkage, if it is none of the catalogue.
    pub fn manifest(&self, name: &str, target: &Target, own_linkage: Option<&str>) -> String {
        if self.answers.is_empty() {
            return answers_manifest(name, target.size(), &[]);
        }
        let mut out = manifest_head("find", &title_for(name));
        out.extend(own_linkage.map(|text| format!("\n{text}")));
        out.push('\n');
        let placed = |(rank, answer): (usize, &LinkageAnswer)| {
            let mut family = answer.placed_family();
            family.title = format!("{}: curve {rank}", family.title);
            family
        };
        let families: Vec<Family> = (1..).zip(&self.answers).map(placed).collect();
        let mut sets = Vec::new();
        for ((rank, answer), family) in (1..).zip(&self.answers).zip(&families) {
            out += &format!("# {rank}: {}\n", description::exact_placement(&answer.curve, target.size()));
            let curve_name = format!("{rank}: {}", description::deviation(&answer.curve.fit.deviation, target.size()));
            sets.push(ParameterSet { family, values: answer.curve.values.clone(), curve_name });
        }
        out + &manifest_families(&sets, own_linkage.is_some())
    }
}
