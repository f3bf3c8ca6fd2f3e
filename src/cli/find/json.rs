//! The JSON that `find --json` prints.

use coupler_find::{AnswerRecord, PathKind};
use serde::Serialize;

use super::super::{Failure, report};
use super::Report;
use super::text::options_of;

/// The version of the format.
pub(super) const FORMAT: u32 = 1;

/// What has been found for a path, in entries of its kind.
#[derive(Serialize)]
pub(super) struct Document<E> {
    pub target: Target,
    /// The number of curves with which it was compared, where that is reported.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curves: Option<usize>,
    /// The names of the parameters that were searched.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub searched: Option<Vec<String>>,
    pub results: Vec<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest_miss: Option<NearestMiss<E>>,
}

#[derive(Serialize)]
pub(super) struct NearestMiss<E> {
    pub relax: Vec<&'static str>,
    pub result: E,
}

#[derive(Serialize)]
pub(super) struct Target {
    /// What of the file was taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    read: Option<String>,
    points: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angles_deg: Option<Vec<f64>>,
    closed: bool,
    kind: &'static str,
    size: f64,
}

pub(super) fn target(target: &coupler_find::Target, reading: &str) -> Target {
    Target {
        read: Some(reading.to_owned()).filter(|reading| !reading.is_empty()),
        points: target.points().iter().map(|p| [p.x, p.y]).collect(),
        angles_deg: target.angles_deg().map(<[f64]>::to_vec),
        closed: target.kind() == PathKind::Closed,
        kind: target.kind().name(),
        size: target.size(),
    }
}

/// The path, the linkages and their cognates, as indented JSON.
pub(super) fn json(report: &Report) -> Result<String, Failure> {
    let Report { reading, target, answers, nearest_miss, .. } = report;
    let miss = nearest_miss.as_ref().map(|(constraints, answer)| NearestMiss {
        relax: options_of(constraints),
        result: AnswerRecord::new(1, answer),
    });
    let document = Document {
        target: self::target(target, reading),
        curves: None,
        searched: None,
        results: (1..).zip(answers).map(|(rank, answer)| AnswerRecord::new(rank, answer)).collect(),
        nearest_miss: miss,
    };
    report::json(FORMAT, &document)
}
