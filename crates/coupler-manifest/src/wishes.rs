//! What is wished of the linkages that a search finds.

/// The texts of a search by wishes, as the options of `coupler-atlas design` and the keys of a family's `design` have them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WishTexts {
    /// Conditions on measures and parameters, joined by `and`.
    pub condition: Option<String>,
    /// Expressions that are to be as great as possible.
    pub maximize: Vec<String>,
    /// Expressions that are to be as small as possible.
    pub minimize: Vec<String>,
    /// Ranges of parameters, as in `r = 20..60 by 1`.
    pub range: Vec<String>,
    /// Parameters that keep their default, as in `s`, or a value, as in `p = 100`.
    pub fix: Vec<String>,
}

/// A text of [`WishTexts`], those of a list by their index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WishPlace {
    /// None of them: what is wrong is wrong with all, or what is missing.
    All,
    /// The conditions.
    Condition,
    /// One of `maximize`.
    Maximize(usize),
    /// One of `minimize`.
    Minimize(usize),
    /// One of `range`.
    Range(usize),
    /// One of `fix`.
    Fix(usize),
}

/// A search by wishes whose answers are the cells of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignRequest {
    /// What its answers are called, other than those of any other family.
    pub name: String,
    /// The wishes.
    pub wishes: WishTexts,
    /// The greatest distance of two joints of a link; infinite for any.
    pub max_link: f64,
    /// The most answers, from 1 to [`MAX_DESIGNS`]; without it and the following two, those of the command hold.
    pub best: Option<usize>,
    /// How much is tried.
    pub effort: Option<DesignEffort>,
    /// A number that changes what is tried.
    pub seed: Option<u64>,
    /// Whether the answers are wanted, and not only whether the wishes can be searched for.
    pub is_searched: bool,
}

/// The greatest number of answers of a search.
pub const MAX_DESIGNS: usize = 50;

/// How much a search tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DesignEffort {
    /// A third of the normal effort.
    Quick,
    /// What usually suffices.
    Normal,
    /// Four times the normal effort.
    Thorough,
}

/// The words for how much is tried.
pub(crate) const EFFORTS: [(&str, DesignEffort); 3] =
    [("quick", DesignEffort::Quick), ("normal", DesignEffort::Normal), ("thorough", DesignEffort::Thorough)];
