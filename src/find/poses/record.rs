//! What has been found for poses, for programs.

use std::collections::BTreeMap;

use coupler_find::{Freedom, PlacedDyad, PoseAnswer, PoseFindings, PoseSet};
use serde::Serialize;

/// What has been found, as JSON has it.
#[derive(Debug, Serialize)]
pub struct PoseFindingsRecord {
    freedom: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dyads: Option<Vec<Dyad>>,
    pairs: usize,
    left_out: BTreeMap<&'static str, usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pairs_left_out: Vec<LeftOut>,
    /// The linkages, in order of rank.
    pub results: Vec<PoseRecord>,
}

#[derive(Debug, Serialize)]
struct Dyad {
    #[serde(skip_serializing_if = "Option::is_none")]
    pivot: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pin: Option<[f64; 2]>,
}

#[derive(Debug, Serialize)]
struct LeftOut {
    dyads: [usize; 2],
    reason: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    order: Vec<usize>,
}

/// A linkage that guides a body, as JSON has it.
#[derive(Debug, Serialize)]
pub struct PoseRecord {
    rank: usize,
    linkage: &'static str,
    rms: f64,
    rms_relative: f64,
    errors: Vec<[f64; 2]>,
    parameters: BTreeMap<&'static str, f64>,
    crank_pivot: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    rocker_pivot: Option<[f64; 2]>,
    crank_pins: Vec<[f64; 2]>,
    other_pins: Vec<[f64; 2]>,
    input_deg: Vec<f64>,
    circuit: usize,
    branch: u8,
    one_branch: bool,
    in_order: bool,
    full_turn: bool,
    class: &'static str,
    mu_worst_poses_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    mu_worst_deg: Option<f64>,
    longest_link: f64,
}

impl PoseFindingsRecord {
    /// The record of what has been found for poses.
    pub fn new(findings: &PoseFindings, poses: &PoseSet) -> PoseFindingsRecord {
        let left_out = findings.pairs_left_out.iter().map(|left_out| LeftOut {
            dyads: left_out.dyads,
            reason: left_out.misfit.name(),
            order: left_out.order.clone(),
        });
        let are_samples = matches!(findings.freedom, Freedom::Curve | Freedom::Plane | Freedom::Space);
        PoseFindingsRecord {
            freedom: findings.freedom.name(),
            samples: are_samples.then_some(findings.dyads.len()),
            dyads: (!are_samples).then(|| findings.dyads.iter().map(dyad).collect()),
            pairs: findings.pairs,
            left_out: findings.left_out.iter().map(|(misfit, count)| (misfit.name(), *count)).collect(),
            pairs_left_out: left_out.collect(),
            results: (1..).zip(&findings.answers).map(|(rank, answer)| PoseRecord::new(rank, answer, poses)).collect(),
        }
    }
}

fn dyad(dyad: &PlacedDyad) -> Dyad {
    let [pivot, pin] = [dyad.pivot, dyad.pin].map(|place| place.map(|p| [p.x, p.y]));
    Dyad { pivot, line_deg: dyad.line_deg, pin }
}

impl PoseRecord {
    /// The record of an answer with a rank, from 1.
    pub fn new(rank: usize, answer: &PoseAnswer, poses: &PoseSet) -> PoseRecord {
        let size = poses.size();
        let rms = answer.rms(size);
        let pivots: Vec<[f64; 2]> = answer.guide.pivots().iter().map(|p| [p.x, p.y]).collect();
        let pins = |k: usize| answer.pins.iter().map(|pins| [pins[k].x, pins[k].y]).collect();
        let [mu_worst_poses_deg, mu_worst_deg] = answer.mu_worst_deg;
        PoseRecord {
            rank,
            linkage: answer.guide.name(),
            rms,
            rms_relative: rms / size,
            errors: answer.errors.iter().map(|error| [error.distance, error.angle_deg]).collect(),
            parameters: answer.guide.parameters().into_iter().collect(),
            crank_pivot: pivots[0],
            rocker_pivot: pivots.get(1).copied(),
            crank_pins: pins(0),
            other_pins: pins(1),
            input_deg: answer.inputs_deg.clone(),
            circuit: answer.circuit,
            branch: if answer.branch > 0 { 1 } else { 2 },
            one_branch: answer.on_one_branch,
            in_order: answer.in_order,
            full_turn: answer.is_full_turn,
            class: answer.class,
            mu_worst_poses_deg,
            mu_worst_deg: mu_worst_deg.is_finite().then_some(mu_worst_deg),
            longest_link: answer.longest_link,
        }
    }
}
