//! The JSON that `find --json` prints.

use coupler_curves::find::{self, Answer, Mechanism, PathKind};
use coupler_curves::linkage::{FourBar, PlacedFourBar, Side};
use serde::Serialize;

use super::super::report;
use super::text::option_of;
use super::{Report, text};

/// The version of the format.
pub(super) const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document {
    target: Target,
    results: Vec<Result>,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest_miss: Option<NearestMiss>,
}

#[derive(Serialize)]
pub(super) struct Target {
    points: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angles_deg: Option<Vec<f64>>,
    closed: bool,
    kind: &'static str,
    size: f64,
}

#[derive(Serialize)]
struct NearestMiss {
    relax: Vec<&'static str>,
    result: Result,
}

#[derive(Serialize)]
pub(super) struct Result {
    rank: usize,
    quality: &'static str,
    rms: f64,
    rms_relative: f64,
    max: f64,
    in_order: bool,
    length_ratio: f64,
    #[serde(flatten)]
    linkage: Linkage,
    cognates: Vec<Linkage>,
}

#[derive(Serialize)]
struct Linkage {
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

#[derive(Serialize)]
struct Parameters {
    frame: f64,
    crank: f64,
    coupler: f64,
    rocker: f64,
    along: f64,
    across: f64,
}

pub(super) fn target(target: &find::Target) -> Target {
    Target {
        points: target.points().iter().map(|p| [p.x, p.y]).collect(),
        angles_deg: target.angles_deg().map(<[f64]>::to_vec),
        closed: target.kind() == PathKind::Closed,
        kind: target.kind().name(),
        size: target.size(),
    }
}

/// The path, the linkages and their cognates, as indented JSON.
pub(super) fn json(report: &Report) -> anyhow::Result<String> {
    let Report { target, answers, nearest_miss, .. } = report;
    let miss = nearest_miss.as_ref().map(|(constraints, answer)| NearestMiss {
        relax: constraints.iter().map(|constraint| option_of(*constraint)).collect(),
        result: result(1, answer),
    });
    let document = Document {
        target: self::target(target),
        results: (1..).zip(answers).map(|(rank, answer)| result(rank, answer)).collect(),
        nearest_miss: miss,
    };
    report::json(FORMAT, &document)
}

pub(super) fn result(rank: usize, answer: &Answer) -> Result {
    Result {
        rank,
        quality: answer.quality().name(),
        rms: answer.rms,
        rms_relative: answer.rms_relative,
        max: answer.greatest,
        in_order: answer.is_in_order,
        length_ratio: answer.length_ratio,
        linkage: linkage(&answer.mechanism),
        cognates: answer.cognates.iter().map(linkage).collect(),
    }
}

fn linkage(mechanism: &Mechanism) -> Linkage {
    let PlacedFourBar { pivots, lengths: FourBar { frame, crank, coupler, rocker }, coupler_point } =
        mechanism.four_bar;
    let [crank_pivot, rocker_pivot] = pivots.map(|p| [p.x, p.y]);
    Linkage {
        direction: text::direction(mechanism),
        linkage: "four-bar",
        crank_pivot,
        rocker_pivot,
        parameters: Parameters { frame, crank, coupler, rocker, along: coupler_point.x, across: coupler_point.y },
        side: text::side(mechanism),
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
