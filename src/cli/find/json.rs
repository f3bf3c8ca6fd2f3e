//! The JSON that `find --json` prints.

use coupler_curves::find::{self, AnswerRecord, PathKind};
use serde::Serialize;

use super::super::report;
use super::Report;
use super::text::option_of;

/// The version of the format.
pub(super) const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document {
    target: Target,
    results: Vec<AnswerRecord>,
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
    result: AnswerRecord,
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
        result: AnswerRecord::new(1, answer),
    });
    let document = Document {
        target: self::target(target),
        results: (1..).zip(answers).map(|(rank, answer)| AnswerRecord::new(rank, answer)).collect(),
        nearest_miss: miss,
    };
    report::json(FORMAT, &document)
}
