//! What is asked of a search.

use crate::condition::Condition;
use coupler_curves::geometry::Bounds;

/// How many linkages are tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effort {
    /// A third of the normal effort.
    Quick,
    /// Less than half a second for a hundred points.
    #[default]
    Normal,
    /// Four times the normal effort.
    Thorough,
}

/// What the linkages must satisfy.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Whether the crank must turn fully.
    pub full_turn: bool,
    /// The greatest distance of two joints of a link, in sizes of the target; may be infinite.
    pub max_link: f64,
    /// The box of the fixed pivots, in the unit of the target.
    pub pivots: Option<Bounds>,
    /// A condition on the linkage.
    pub condition: Option<Condition>,
    /// How many linkages are tried.
    pub effort: Effort,
    /// Whether the curves of the index are refined, or only placed on the target.
    pub refine: bool,
    /// The number from which the linkages follow that are tried near those that have been found.
    pub seed: u64,
    /// The most answers.
    pub most: usize,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            full_turn: true,
            max_link: 10.0,
            pivots: None,
            condition: None,
            effort: Effort::default(),
            refine: true,
            seed: 1,
            most: 10,
        }
    }
}
