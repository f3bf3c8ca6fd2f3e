//! The JSON of an atlas's curves.

use std::collections::BTreeMap;

use coupler_atlas::find::{AtlasAnswer, scaled_values};
use coupler_curves::find::{AnswerRecord, FitRecord};
use serde::Serialize;

use super::super::super::report;
use super::super::json::{self, FORMAT, Target};
use super::{AtlasReport, Found};

#[derive(Serialize)]
struct Document {
    target: Target,
    curves: usize,
    results: Vec<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest_miss: Option<NearestMiss>,
}

#[derive(Serialize)]
struct NearestMiss {
    relax: Vec<&'static str>,
    result: Entry,
}

#[derive(Serialize)]
struct Entry {
    cell: String,
    cell_number: usize,
    refined: bool,
    #[serde(flatten)]
    result: Linkage,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Linkage {
    Refined(Box<AnswerRecord>),
    Placed(Box<Placed>),
}

#[derive(Serialize)]
struct Placed {
    #[serde(flatten)]
    fit: FitRecord,
    direction: &'static str,
    ends: [f64; 2],
    linkage: String,
    trace: usize,
    circuit: usize,
    pivots: BTreeMap<String, [f64; 2]>,
    parameters: BTreeMap<String, f64>,
    scaled: bool,
    placement: Placement,
    full_turn: bool,
    class: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    mu_worst_deg: Option<f64>,
    longest_link: f64,
}

#[derive(Serialize)]
struct Placement {
    mirrored: bool,
    scale: f64,
    rotation_deg: f64,
    shift: [f64; 2],
}

/// The path and the curves, as indented JSON.
pub(super) fn json(report: &AtlasReport) -> anyhow::Result<String> {
    let entry = |(rank, found): (usize, &Found)| entry(report, rank, found);
    let miss = report.nearest_miss.as_ref();
    let document = Document {
        target: json::target(&report.target),
        curves: report.curves,
        results: (1..).zip(&report.answers).map(entry).collect(),
        nearest_miss: miss.map(|(relax, found)| NearestMiss { relax: relax.clone(), result: entry((1, found)) }),
    };
    report::json(FORMAT, &document)
}

fn entry(report: &AtlasReport, rank: usize, Found { curve, refined }: &Found) -> Entry {
    let result = match refined {
        Some(answer) => Linkage::Refined(Box::new(AnswerRecord::new(rank, answer))),
        None => Linkage::Placed(Box::new(placed(report, rank, curve))),
    };
    Entry { cell: curve.name.clone(), cell_number: curve.numbers[0], refined: refined.is_some(), result }
}

fn placed(report: &AtlasReport, rank: usize, curve: &AtlasAnswer) -> Placed {
    let template = &report.plan.families[curve.place[0]].family.template;
    let fit = &curve.fit;
    let scale = fit.placement.scale();
    let values = scaled_values(template, &curve.values, if curve.is_scalable { scale } else { 1.0 });
    let names = template.parameters.iter().map(|parameter| parameter.name.clone());
    Placed {
        fit: FitRecord::new(rank, fit),
        direction: if fit.is_reversed { "backward" } else { "forward" },
        ends: fit.ends,
        linkage: template.id.clone(),
        trace: curve.numbers[1],
        circuit: curve.numbers[2],
        pivots: curve.pivots.iter().map(|(name, p)| (name.clone(), [p.x, p.y])).collect(),
        parameters: names.zip(values).collect(),
        scaled: curve.is_scalable,
        placement: Placement {
            mirrored: fit.placement.is_mirrored,
            scale,
            rotation_deg: fit.placement.rotation_deg(),
            shift: [fit.placement.shift.x, fit.placement.shift.y],
        },
        full_turn: curve.is_full_turn,
        class: curve.class,
        mu_worst_deg: curve.mu_worst_deg.is_finite().then_some(curve.mu_worst_deg),
        longest_link: curve.longest_link,
    }
}
