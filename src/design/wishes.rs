//! The dimensions of any linkage by wishes on its measures, on all threads.

use std::sync::atomic::AtomicBool;

use coupler_curves::exchange::{ParameterSet, format_significant, manifest_families};
use coupler_curves::text::{round_apart, round_to_six_digits};
use coupler_find::{DesignAnswer, DesignMiss, DesignOptions, DesignSearch, DesignSpace, Wishes, manifest_head};

use crate::threads::Threads;

/// What a search by wishes has found.
pub struct Designs {
    /// The linkages that meet the wishes, the best first.
    pub answers: Vec<DesignAnswer>,
    /// If there is none, for each wish without which the others can be met, the linkage that comes nearest to it.
    pub misses: Vec<DesignMiss>,
    /// The names of the parameters that were varied.
    pub searched: Vec<String>,
    /// Whether any linkage within the ranges was assembled.
    pub is_any_assembled: bool,
    /// Whether nothing holds the size of the linkages, and the best would be smaller or greater without end.
    pub is_size_unbounded: bool,
    /// Whether the search was told to end, and these are the best so far.
    pub is_interrupted: bool,
}

/// What is said of designs whose size nothing holds.
pub const UNBOUNDED_SIZE: &str =
    "nothing holds the size of these linkages, and better ones are smaller or greater without end";

/// Searches the dimensions of a linkage for wishes, which must be those of its space. The answer does not depend on the number of threads,
/// unless `interrupt` becomes true, which ends the search with what has been found so far. `report_part` receives which part of the search
/// is done, from 0 to 1, after each step.
pub fn by_wishes(
    space: DesignSpace,
    wishes: Wishes,
    options: DesignOptions,
    interrupt: &AtomicBool,
    mut report_part: impl FnMut(f64),
) -> Designs {
    let threads = Threads { interrupt };
    let mut search = DesignSearch::new(space, wishes, options);
    while !threads.is_interrupted() && search.step(&threads) {
        report_part(search.part_done());
    }
    let is_interrupted = threads.is_interrupted();
    let answers = search.answers(&Threads { interrupt: &AtomicBool::new(false) });
    let misses = if answers.is_empty() { search.misses() } else { Vec::new() };
    let searched = search.space().free_names().map(str::to_owned).collect();
    let (is_any_assembled, is_size_unbounded) = (search.is_any_assembled(), search.is_size_unbounded());
    Designs { answers, misses, searched, is_any_assembled, is_size_unbounded, is_interrupted }
}

impl Designs {
    /// What to do where no linkage meets the wishes: what each comes to while the others are met.
    pub fn remedies(&self, wishes: &Wishes) -> Vec<String> {
        if !self.is_any_assembled {
            let remedy = "no linkage within these ranges can be assembled: widen them, or fix fewer parameters";
            return vec![remedy.to_owned()];
        }
        if self.misses.is_empty() {
            let remedy = "leaving out one wish is not enough; leave out two of them, widen the ranges, or try the thorough effort";
            return vec![remedy.to_owned()];
        }
        let others = if wishes.wishes.len() > 1 { "while the others are met" } else { "in these ranges" };
        let remedy = |DesignMiss { wish, nearest }: &DesignMiss| {
            let comes_to = match &nearest.wishes[*wish].value {
                Some((subject, value)) if value.is_nan() => format!("{subject} has no value"),
                Some((subject, value)) => {
                    let bound = wishes.wishes[*wish].bound();
                    let shown = bound.map_or_else(|| round_to_six_digits(*value), |bound| round_apart(*value, bound));
                    format!("{subject} comes to {shown} at best")
                }
                None => "it is not met".to_owned(),
            };
            format!("`{}`: {comes_to} {others}: {}", wishes.wishes[*wish].text(), parameters(nearest))
        };
        self.misses.iter().map(remedy).collect()
    }

    /// A manifest that renders the linkages. `own_linkage` is the text of the linkage, if it is none of the catalogue.
    pub fn manifest(&self, linkage: &str, own_linkage: Option<&str>) -> String {
        let mut out = manifest_head(&format!("design {linkage}"), &format!("Designs of {linkage}"));
        if self.answers.is_empty() {
            return out + "\n# No linkage meets the wishes.\n";
        }
        out.extend(own_linkage.map(|text| format!("\n{text}")));
        let set = |(rank, answer): (usize, &'_ DesignAnswer)| (rank, answer.family.clone(), answer.values.clone());
        let mut ranked: Vec<_> = (1..).zip(&self.answers).map(set).collect();
        ranked.iter_mut().for_each(|(_, family, _)| family.title = format!("Designs of {linkage}"));
        let sets: Vec<ParameterSet> = ranked
            .iter()
            .zip(&self.answers)
            .map(|((rank, family, values), answer)| ParameterSet {
                family,
                values: values.clone(),
                curve_name: format!("{rank}: {}", describe(answer)),
            })
            .collect();
        out + &manifest_families(&sets, own_linkage.is_some())
    }
}

/// What is wished of a linkage and what it has: "`mu worst deg` 67.48, `output swing deg` 110".
pub fn describe(answer: &DesignAnswer) -> String {
    let values = answer.goals.iter().map(|(text, value)| (text, *value));
    let compared = answer.wishes.iter().filter_map(|wish| wish.value.as_ref()).map(|(text, value)| (text, *value));
    let mut shown: Vec<(&String, f64)> = Vec::new();
    for (text, value) in values.chain(compared) {
        if shown.iter().all(|(other, _)| *other != text) {
            shown.push((text, value));
        }
    }
    let parts: Vec<String> =
        shown.iter().map(|(text, value)| format!("{text} {}", round_to_six_digits(*value))).collect();
    parts.join(", ")
}

/// The dimensions: "p = 110, r = 17.674909".
pub fn parameters(answer: &DesignAnswer) -> String {
    /// The digits of a dimension, and the least number that is a decimal.
    const FORM: (usize, f64) = (8, 1e-5);
    let named = answer.family.template.parameters.iter().zip(&answer.values);
    let values =
        named.map(|(parameter, value)| format!("{} = {}", parameter.name, format_significant(*value, FORM.0, FORM.1)));
    values.collect::<Vec<_>>().join(", ")
}
