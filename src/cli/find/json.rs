//! The JSON that `find --json` prints.

use std::collections::BTreeMap;

use coupler_curves::template::Template;
use coupler_find::{AnswerRecord, FitRecord, PathKind, PlacedCurve, scaled_values};
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

/// A curve of any linkage, where it is placed on the path.
#[derive(Serialize)]
pub(super) struct PlacedRecord {
    #[serde(flatten)]
    fit: FitRecord,
    direction: &'static str,
    ends: [f64; 2],
    linkage: String,
    trace: usize,
    joint: String,
    circuit: usize,
    pivots: BTreeMap<String, [f64; 2]>,
    parameters: BTreeMap<String, f64>,
    scaled: bool,
    placement: PlacementRecord,
    full_turn: bool,
    class: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    mu_worst_deg: Option<f64>,
    longest_link: f64,
}

#[derive(Serialize)]
struct PlacementRecord {
    mirrored: bool,
    scale: f64,
    rotation_deg: f64,
    shift: [f64; 2],
}

impl PlacedRecord {
    pub(super) fn new(rank: usize, template: &Template, curve: &PlacedCurve) -> PlacedRecord {
        let fit = &curve.fit;
        let scale = fit.placement.scale();
        let values = scaled_values(template, &curve.values, if curve.is_scalable { scale } else { 1.0 });
        let names = template.parameters.iter().map(|parameter| parameter.name.clone());
        PlacedRecord {
            fit: FitRecord::new(rank, &fit.deviation),
            direction: if fit.is_reversed { "backward" } else { "forward" },
            ends: fit.ends,
            linkage: template.id.clone(),
            trace: curve.numbers[0],
            joint: curve.joint.clone(),
            circuit: curve.numbers[1],
            pivots: curve.pivots.iter().map(|(name, p)| (name.clone(), [p.x, p.y])).collect(),
            parameters: names.zip(values).collect(),
            scaled: curve.is_scalable,
            placement: PlacementRecord {
                mirrored: fit.placement.is_mirrored,
                scale,
                rotation_deg: fit.placement.rotation_deg(),
                shift: [fit.placement.shift.re, fit.placement.shift.im],
            },
            full_turn: curve.is_full_turn,
            class: curve.class,
            mu_worst_deg: curve.mu_worst_deg.is_finite().then_some(curve.mu_worst_deg),
            longest_link: curve.longest_link,
        }
    }
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
