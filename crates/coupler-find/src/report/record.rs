//! An answer as JSON.

use serde::Serialize;

use crate::answer::Answer;
use crate::deviation::Deviation;
use crate::four_bar::mechanism::Mechanism;
use coupler_curves::linkage::{FourBar, PlacedFourBar, Side};

/// How near a curve is to the target, as it is written in JSON, in the unit of the target; docs/find.md describes its keys.
#[derive(Debug, Serialize)]
pub struct FitRecord {
    rank: usize,
    quality: &'static str,
    rms: f64,
    rms_relative: f64,
    max: f64,
    in_order: bool,
    length_ratio: f64,
}

/// An answer as it is written in JSON, in the unit and axes of the target; docs/find.md describes its keys.
#[derive(Debug, Serialize)]
pub struct AnswerRecord {
    #[serde(flatten)]
    fit: FitRecord,
    #[serde(flatten)]
    linkage: LinkageRecord,
    cognates: Vec<LinkageRecord>,
}

#[derive(Debug, Serialize)]
struct LinkageRecord {
    direction: &'static str,
    linkage: &'static str,
    crank_pivot: [f64; 2],
    rocker_pivot: [f64; 2],
    parameters: Parameters,
    side: &'static str,
    circuit: usize,
    branch: u8,
    full_turn: bool,
    input_deg: [f64; 2],
    class: &'static str,
    mu_worst_deg: f64,
    longest_link: f64,
    meets_constraints: bool,
}

#[derive(Debug, Serialize)]
struct Parameters {
    frame: f64,
    crank: f64,
    coupler: f64,
    rocker: f64,
    along: f64,
    across: f64,
}

impl FitRecord {
    /// The record of a deviation with a rank, from 1.
    pub fn new(rank: usize, deviation: &Deviation) -> FitRecord {
        FitRecord {
            rank,
            quality: deviation.quality().name(),
            rms: deviation.rms,
            rms_relative: deviation.rms_relative,
            max: deviation.greatest,
            in_order: deviation.is_in_order,
            length_ratio: deviation.length_ratio,
        }
    }
}

impl AnswerRecord {
    /// The record of an answer with a rank, from 1.
    pub fn new(rank: usize, answer: &Answer) -> AnswerRecord {
        AnswerRecord {
            fit: FitRecord::new(rank, &answer.deviation),
            linkage: LinkageRecord::new(&answer.mechanism),
            cognates: answer.cognates.iter().map(LinkageRecord::new).collect(),
        }
    }
}

impl LinkageRecord {
    fn new(mechanism: &Mechanism) -> LinkageRecord {
        let PlacedFourBar { pivots, lengths: FourBar { frame, crank, coupler, rocker }, coupler_point } =
            mechanism.four_bar;
        let [crank_pivot, rocker_pivot] = pivots.map(|p| [p.x, p.y]);
        LinkageRecord {
            direction: mechanism.direction(),
            linkage: "four-bar",
            crank_pivot,
            rocker_pivot,
            parameters: Parameters { frame, crank, coupler, rocker, along: coupler_point.x, across: coupler_point.y },
            side: mechanism.side_name(),
            circuit: mechanism.circuit,
            branch: if mechanism.side == Side::Left { 1 } else { 2 },
            full_turn: mechanism.is_full_turn,
            input_deg: mechanism.input_deg,
            class: mechanism.class,
            mu_worst_deg: mechanism.mu_worst_deg,
            longest_link: mechanism.longest_link(),
            meets_constraints: mechanism.meets_constraints,
        }
    }
}
