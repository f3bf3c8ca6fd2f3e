//! What is asked of a search for linkages that guide a body, and all that is wrong with it.

use coupler_curves::geometry::Point;
use coupler_find::{Options, PoseCondition, PoseOptions, PoseSet};

use super::super::request::Request;
use crate::notation::Notation;

/// What is asked of a search for linkages that guide a body.
#[derive(Clone, Debug)]
pub struct PoseRequest<'a> {
    /// What searches for paths are asked, too: of [`super::super::Searched::Poses`].
    pub request: Request<'a>,
    /// Whether the poses may be passed in any order.
    pub any_order: bool,
    /// Whether the poses may be on several circuits or branches.
    pub any_circuit: bool,
    /// Fixed pivots that linkages must have.
    pub given_pivots: Vec<Point>,
}

impl PoseRequest<'_> {
    /// The options of the search.
    ///
    /// # Errors
    /// All problems of the request.
    pub fn check(&self) -> Result<PoseOptions, Vec<String>> {
        let Request { notation, condition, .. } = self.request;
        let condition = condition.map(|text| {
            let option = notation.name("where");
            PoseCondition::new(text).map_err(|error| format!("{option}: `{text}`: {}", error.message_with_help()))
        });
        let PoseRequest { any_order, any_circuit, .. } = *self;
        let wrong_pivots = self.wrong_pivots();
        match (self.request.check(), condition.transpose()) {
            (Ok((options, _)), Ok(condition)) if wrong_pivots.is_empty() => {
                let given_pivots = self.given_pivots.clone();
                let Options { full_turn, max_link, pivots, effort, seed, most, .. } = options;
                Ok(PoseOptions {
                    full_turn,
                    any_order,
                    any_circuit,
                    max_link,
                    pivots,
                    given_pivots,
                    condition,
                    effort,
                    seed,
                    most,
                })
            }
            (others, condition) => {
                let others = others.err().into_iter().flatten().map(|problem| problem.message);
                Err(condition.err().into_iter().chain(others).chain(wrong_pivots).collect())
            }
        }
    }

    /// What is wrong with the given pivots.
    fn wrong_pivots(&self) -> Vec<String> {
        /// A linkage has no more.
        const MOST: usize = 2;
        let option = self.request.notation.name("pivot");
        let pivots = &self.given_pivots;
        let mut problems = Vec::new();
        for (k, pivot) in pivots.iter().enumerate() {
            let Point { coords, .. } = pivot;
            if !pivot.x.is_finite() || !pivot.y.is_finite() {
                problems.push(format!("{option}: ({}, {}) is not finite", coords.x, coords.y));
            } else if pivots[..k].contains(pivot) {
                problems.push(format!("{option}: ({}, {}) is given twice: leave one out", coords.x, coords.y));
            }
        }
        if pivots.len() > MOST {
            let count = pivots.len();
            problems
                .push(format!("{option} is given {count} times, and a linkage has two fixed pivots: give one or two"));
        }
        problems
    }
}

/// Checks that some poses have linkages with given pivots.
///
/// # Errors
/// They are more than three.
pub fn check_given_pivots(notation: Notation, poses: &PoseSet, options: &PoseOptions) -> Result<(), String> {
    /// Of more poses the pivots are on a curve, or are a few points.
    const MOST: usize = 3;
    let count = poses.poses().len();
    if options.given_pivots.is_empty() || count <= MOST {
        return Ok(());
    }
    let which = match count {
        4 => "are on a curve",
        5 => "are at most four points",
        _ => "are where the linkage is nearest to the poses",
    };
    let box_option = match notation {
        Notation::CommandLine => "--pivots XMIN,YMIN,XMAX,YMAX",
        Notation::Python => "pivots=(xmin, ymin, xmax, ymax)",
    };
    let option = notation.name("pivot");
    Err(format!(
        "{option} is of 2 or 3 poses, and the pivots of {count} {which}: leave poses out, or give a box in its place, {box_option}"
    ))
}
