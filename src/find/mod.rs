//! The search for linkages whose curves are nearest to a path, on all threads: in an atlas, and for the dimensions of any linkage; and the
//! index of curves in a file.

mod atlas;
pub mod description;
mod drawing;
pub mod function;
mod index_file;
mod linkage;
mod poses;
mod record;
mod request;
mod several;

pub use atlas::{AtlasAnswer, AtlasQuery, find_in_atlas};
pub use drawing::draw_four_bars;
pub use index_file::{MAX_CURVES, load_index};
pub use linkage::find_linkage;
pub use poses::{
    FoundPoses, PoseFindingsRecord, PoseReading, PoseRecord, PoseRequest, Relaxed, check_given_pivots, draw_poses,
    find_poses, guided_body, passing, read_poses,
};
pub use record::{AtlasAnswerRecord, LinkageAnswerRecord};
pub use request::{Request, RequestProblem, Searched, SearchedLinkage};
pub use several::{Several, find_among, simplest};

pub use coupler_paths::{FunctionRows, MAX_POINTS, Outline, ReadOptions, Reading, parse_function, parse_outline};

pub use crate::notation::Notation;
pub use crate::threads::Interrupted;

use coupler_find::Constraint;

/// What has been found in an atlas, or for a linkage.
#[derive(Clone, Debug)]
pub struct Findings<A> {
    /// The number of curves with which the path was compared.
    pub curves: usize,
    /// The answers, the nearest first.
    pub answers: Vec<A>,
    /// If there is none, the constraints to relax, and the nearest answer without them.
    pub nearest_miss: Option<(Vec<Constraint>, A)>,
}

/// Why a search has no result.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The condition has no meaning in any family of the atlas.
    #[error("`{condition}`: {error}")]
    Condition {
        /// Its text.
        condition: String,
        /// What is wrong with it in the first family.
        error: String,
    },
    /// The search was told to end.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
