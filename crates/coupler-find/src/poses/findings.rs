//! What is asked of linkages that guide a body, and what is found.

use std::collections::BTreeMap;

use super::answer::PoseAnswer;
use super::body::PoseSet;
use super::condition::PoseCondition;
use super::dyad::Dyad;
use super::dyad_space::Freedom;
use super::pair::{Misfit, Wish};
use crate::complex::Complex;
use crate::options::{Effort, Options};
use coupler_curves::geometry::{Bounds, Point, trig};

/// What is asked of the linkages that guide a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseOptions {
    /// Whether the crank must turn fully.
    pub full_turn: bool,
    /// Whether the poses may be passed in any order.
    pub any_order: bool,
    /// Whether the poses may be on several circuits or branches.
    pub any_circuit: bool,
    /// The greatest distance of two joints of a link, in sizes of the poses; may be infinite.
    pub max_link: f64,
    /// The box of the fixed pivots, in the unit of the poses.
    pub pivots: Option<Bounds>,
    /// Fixed pivots that every linkage has, at most two and of two or three poses, in the unit of the poses: they may be outside the box.
    pub given_pivots: Vec<Point>,
    /// A condition on the linkage.
    pub condition: Option<PoseCondition>,
    /// How many dyads are tried where there are infinitely many.
    pub effort: Effort,
    /// The number from which the dyads follow that are tried near the best.
    pub seed: u64,
    /// The most answers.
    pub most: usize,
}

impl Default for PoseOptions {
    /// As of a search for a path, with the poses in order on one branch.
    fn default() -> PoseOptions {
        let Options { full_turn, max_link, pivots, effort, seed, most, .. } = Options::default();
        PoseOptions {
            full_turn,
            any_order: false,
            any_circuit: false,
            max_link,
            pivots,
            given_pivots: Vec::new(),
            condition: None,
            effort,
            seed,
            most,
        }
    }
}

/// A dyad in the plane of the poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedDyad {
    /// The fixed pivot; `None` for a slider.
    pub pivot: Option<Point>,
    /// The direction of a slider's line, or of a slot's at the first pose, in degrees, 0 to 180.
    pub line_deg: Option<f64>,
    /// The pin at the first pose; `None` for a slot.
    pub pin: Option<Point>,
}

/// What has been found for some poses.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseFindings {
    /// How many dyads the poses have.
    pub freedom: Freedom,
    /// The dyads: all if they are finitely many, and otherwise the samples of which linkages were made.
    pub dyads: Vec<PlacedDyad>,
    /// How many pairs of a crank and another dyad were tried.
    pub pairs: usize,
    /// How many of them were left out for each reason.
    pub left_out: BTreeMap<Misfit, usize>,
    /// Of finitely many dyads, each pair that was left out.
    pub pairs_left_out: Vec<PairLeftOut>,
    /// The answers, the best transmission angle first; of poses that are not passed exactly, the nearest first.
    pub answers: Vec<PoseAnswer>,
}

/// Two of finitely many dyads that make no linkage that passes the poses as asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PairLeftOut {
    /// The numbers of the dyad of the crank and of the other, from 1.
    pub dyads: [usize; 2],
    /// Why it is left out.
    pub misfit: Misfit,
    /// If it is for the order of the poses, the one in which they are passed.
    pub order: Vec<usize>,
}

/// The wishes that are checked of pairs of dyads.
pub(super) fn wish(options: &PoseOptions) -> Wish {
    let PoseOptions { full_turn, any_order, any_circuit, max_link, .. } = *options;
    Wish { full_turn, any_order, any_circuit, max_link }
}

/// A dyad in the plane of the poses.
pub(super) fn placed_dyad(set: &PoseSet, dyad: &Dyad) -> PlacedDyad {
    let line_deg = match dyad {
        Dyad::Slider { normal, .. } | Dyad::Slot { normal, .. } => {
            Some(trig::degrees(trig::atan2(normal.re, -normal.im)).rem_euclid(180.0))
        }
        Dyad::Revolute { .. } => None,
    };
    let place = |z: Option<Complex>| z.map(|z| set.place(z));
    PlacedDyad { pivot: place(dyad.pivot()), line_deg, pin: place(dyad.pin()) }
}
