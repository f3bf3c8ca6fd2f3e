//! What to relax where no linkage meets the constraints.

use super::answer::Answer;
use super::index::Index;
use super::options::Options;
use super::search::Search;
use super::target::Target;

/// A constraint that can be relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint {
    /// [`Options::condition`].
    Condition,
    /// [`Options::pivots`].
    Pivots,
    /// [`Options::max_link`].
    MaxLink,
    /// [`Options::full_turn`].
    FullTurn,
}

impl Constraint {
    const ALL: [Constraint; 4] = [Constraint::Condition, Constraint::Pivots, Constraint::MaxLink, Constraint::FullTurn];

    /// The options without the constraint; `None` if they do not have it.
    fn relaxed(self, options: &Options) -> Option<Options> {
        let (has_it, options) = match self {
            Constraint::Condition => (options.condition.is_some(), Options { condition: None, ..options.clone() }),
            Constraint::Pivots => (options.pivots.is_some(), Options { pivots: None, ..options.clone() }),
            Constraint::MaxLink => {
                (options.max_link.is_finite(), Options { max_link: f64::INFINITY, ..options.clone() })
            }
            Constraint::FullTurn => (options.full_turn, Options { full_turn: false, ..options.clone() }),
        };
        has_it.then_some(options)
    }
}

/// The answer that is nearest to a target without one or several of the constraints, and these: of those that suffice alone the
/// one with the nearest answer, or else all of them. `None` if there is no answer even then. It takes a search for each.
pub fn nearest_miss(target: &Target, index: &Index, options: &Options) -> Option<(Vec<Constraint>, Answer)> {
    let search = |options: &Options| Search::new(target, options.clone()).run(index).into_iter().next();
    nearest_miss_by(options, search, |answer| answer.rms)
}

/// The same for any search, given by the nearest answer for options, and the deviation of an answer.
pub fn nearest_miss_by<A>(
    options: &Options,
    search: impl Fn(&Options) -> Option<A>,
    rms: impl Fn(&A) -> f64,
) -> Option<(Vec<Constraint>, A)> {
    let options = Options { most: 1, ..options.clone() };
    let alone = Constraint::ALL.into_iter().filter_map(|constraint| {
        let answer = search(&constraint.relaxed(&options)?)?;
        Some((vec![constraint], answer))
    });
    let nearest = alone.reduce(|best, other| if rms(&other.1) < rms(&best.1) { other } else { best });
    nearest.or_else(|| {
        let all = Constraint::ALL.into_iter().filter(|constraint| constraint.relaxed(&options).is_some());
        let all: Vec<Constraint> = all.collect();
        let free =
            all.iter().fold(options.clone(), |options, constraint| constraint.relaxed(&options).unwrap_or(options));
        Some((all, search(&free)?))
    })
}
