//! What to relax where no linkage meets the constraints.

use crate::answer::Answer;
use crate::four_bar::index::Index;
use crate::options::Options;
use crate::search::four_bars::Search;
use crate::target::{PathKind, Target};

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
    /// That curves have no long detours from a target that is not open.
    Detours,
}

/// What is searched for.
type Sought = (Target, Options);

impl Constraint {
    const ALL: [Constraint; 5] =
        [Constraint::Condition, Constraint::Pivots, Constraint::MaxLink, Constraint::FullTurn, Constraint::Detours];

    /// Whether a search has the constraint.
    pub fn is_set(self, target: &Target, options: &Options) -> bool {
        match self {
            Constraint::Condition => options.condition.is_some(),
            Constraint::Pivots => options.pivots.is_some(),
            Constraint::MaxLink => options.max_link.is_finite(),
            Constraint::FullTurn => options.full_turn,
            Constraint::Detours => target.kind() != PathKind::Open,
        }
    }

    /// The search without the constraint.
    fn relaxed(self, (mut target, mut options): Sought) -> Sought {
        match self {
            Constraint::Condition => options.condition = None,
            Constraint::Pivots => options.pivots = None,
            Constraint::MaxLink => options.max_link = f64::INFINITY,
            Constraint::FullTurn => options.full_turn = false,
            Constraint::Detours => target = target.opened(),
        }
        (target, options)
    }
}

/// The answer that is nearest to a target without one or several of the constraints, and these: of those that suffice alone the
/// one with the nearest answer, or else all of them. `None` if there is no answer even then. It takes a search for each.
pub fn nearest_miss(target: &Target, index: &Index, options: &Options) -> Option<(Vec<Constraint>, Answer)> {
    let search =
        |target: &Target, options: &Options| Search::new(target, options.clone()).run(index).into_iter().next();
    nearest_miss_by(target, options, search, |answer| answer.deviation.rms)
}

/// The same for any search, given by the nearest answer for a target with options, and the deviation of an answer.
pub fn nearest_miss_by<A>(
    target: &Target,
    options: &Options,
    mut search: impl FnMut(&Target, &Options) -> Option<A>,
    rms: impl Fn(&A) -> f64,
) -> Option<(Vec<Constraint>, A)> {
    let is_set = |constraint: &Constraint| constraint.is_set(target, options);
    let set: Vec<Constraint> = Constraint::ALL.into_iter().filter(is_set).collect();
    let sought = || (target.clone(), Options { most: 1, ..options.clone() });
    let alone = set.iter().filter_map(|constraint| {
        let (target, options) = constraint.relaxed(sought());
        Some((vec![*constraint], search(&target, &options)?))
    });
    let nearest = alone.reduce(|best, other| if rms(&other.1) < rms(&best.1) { other } else { best });
    nearest.or_else(|| {
        let (target, options) = set.iter().fold(sought(), |sought, constraint| constraint.relaxed(sought));
        Some((set, search(&target, &options)?))
    })
}
