//! The linkages among several, of any dimensions, whose curves are nearest to a path.

use std::sync::atomic::AtomicBool;

use coupler_find::{
    Index, JAM_DEG, LinkageAnswer, LinkageIndex, LinkageSearch, LinkageSpace, Options, Search, Searched, Target,
    nearest_miss_by, ranked, simpler_spaces, six_bar_spaces,
};

use super::index_file::load_six_bars;
use super::{Error, Findings, load_index};
use crate::threads::Threads;

/// Several linkages that are searched together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Several {
    /// The six-bars of Watt's and Stephenson's chains.
    SixBars,
    /// These, four-bars, slider-cranks and geared five-bars.
    Any,
}

/// The parameter sets of each linkage that is not in the index.
const SAMPLES: usize = 4000;

/// The four-bars that the search of four-bars finds, from which this one begins.
const FOUR_BARS: usize = 10;

impl Several {
    /// All of them.
    pub const ALL: [Several; 2] = [Several::SixBars, Several::Any];

    /// The name by which they are searched.
    pub fn name(self) -> &'static str {
        match self {
            Several::SixBars => "six-bar",
            Several::Any => "any",
        }
    }

    /// Those of a name.
    pub fn named(name: &str) -> Option<Several> {
        Several::ALL.into_iter().find(|several| several.name() == name)
    }

    /// The linkages: first those whose curves an index has.
    pub fn spaces(self) -> Vec<LinkageSpace> {
        let mut spaces = six_bar_spaces();
        if self == Several::Any {
            spaces.extend(simpler_spaces());
        }
        spaces
    }
}

/// Finds the linkages among several for which their curves are nearest to a target, looked up in an index of about `count` curves of six-bars, which is kept in
/// the user's cache folder. The answer does not depend on the number of threads. `report_part` receives which part of the search is done,
/// from 0 to 1, after each step.
///
/// # Errors
/// `interrupt` is true.
pub fn find_among(
    several: Several,
    target: &Target,
    options: &Options,
    count: Option<usize>,
    interrupt: &AtomicBool,
    mut report_part: impl FnMut(f64),
) -> Result<Findings<LinkageAnswer>, Error> {
    /// The part of the time that the index takes where it is computed.
    const INDEX_PART: f64 = 0.5;
    let threads = Threads { interrupt };
    let spaces = several.spaces();
    let index = match target.angles_deg() {
        None => {
            let count = count.unwrap_or(LinkageIndex::DEFAULT_COUNT);
            let report = |part: f64| report_part(INDEX_PART * part);
            Some(load_six_bars(options.full_turn, count, &threads, report)?)
        }
        Some(_) => None,
    };
    let mut curves = 0;
    let mut search = |target: &Target, options: &Options| -> Result<_, Error> {
        let mut four_bars = Vec::new();
        if several == Several::Any && options.condition.is_none() {
            let own = Options { most: FOUR_BARS, ..options.clone() };
            four_bars = Search::new(target, own).run(&load_index(Index::DEFAULT_COUNT));
        }
        curves = 0;
        let mut run = |half: f64, searched| -> Result<Vec<LinkageAnswer>, Error> {
            let mut search = LinkageSearch::among(&spaces, index.as_ref(), (target, options), SAMPLES, searched);
            four_bars.iter().for_each(|answer| search.add_four_bar(&answer.mechanism.four_bar));
            while search.step(&threads) {
                threads.proceed()?;
                report_part(INDEX_PART + (1.0 - INDEX_PART) * 0.5 * (half + search.part_done()));
            }
            let answers = search.answers(&threads);
            threads.proceed()?;
            curves = search.curve_count() + if searched == Searched::All { 0 } else { curves };
            Ok(answers)
        };
        // Those that do not jam are not the same as the nearest of all that happen not to. Others are looked for where a condition may ask for them, and
        // where there are none.
        let mut answers = run(0.0, Searched::Transmitting(JAM_DEG))?;
        let asks = options.condition.is_some();
        answers.extend(run(1.0, if asks { Searched::All } else { Searched::Groups })?);
        if answers.is_empty() && !asks {
            answers = run(1.0, Searched::All)?;
        }
        Ok(ranked(answers, target.size(), options.most))
    };
    let answers = search(target, options)?;
    let mut nearest_miss = None;
    if answers.is_empty() {
        let nearest = |target: &Target, options: &Options| search(target, options).ok()?.into_iter().next();
        nearest_miss = nearest_miss_by(target, options, nearest, |answer| answer.curve.fit.deviation.rms);
        threads.proceed()?;
    }
    Ok(Findings { curves, answers, nearest_miss })
}

/// The best answer with few links, that with the least links first, and each with more links that is nearer: of those that do not jam, or of all if all do.
pub fn simplest(answers: &[LinkageAnswer]) -> Vec<&LinkageAnswer> {
    let all_jam = answers.iter().all(LinkageAnswer::jams);
    let mut sorted: Vec<&LinkageAnswer> = answers.iter().filter(|answer| all_jam || !answer.jams()).collect();
    let rms = |answer: &LinkageAnswer| answer.curve.fit.deviation.rms;
    sorted.sort_by(|a, b| a.link_count().cmp(&b.link_count()).then_with(|| rms(a).total_cmp(&rms(b))));
    let mut kept: Vec<&LinkageAnswer> = Vec::new();
    for answer in sorted {
        if kept.last().is_none_or(|last| rms(answer) < rms(last) && answer.link_count() > last.link_count()) {
            kept.push(answer);
        }
    }
    kept
}
