//! The JSON of linkages with their dimensions.

use coupler_find::LinkageAnswer;
use serde::Serialize;

use super::super::super::{Failure, report};
use super::super::json::{self, Document, FORMAT, NearestMiss, PlacedRecord};
use super::super::text::options_of;
use super::LinkageReport;
use super::text::branch;

#[derive(Serialize)]
struct Entry {
    #[serde(flatten)]
    placed: PlacedRecord,
    branch: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    input_deg: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    input_length: Option<[f64; 2]>,
}

/// The path and the linkages, as indented JSON.
pub(super) fn json(report: &LinkageReport) -> Result<String, Failure> {
    let entry = |(rank, answer): (usize, &LinkageAnswer)| entry(rank, answer);
    let miss = report
        .findings
        .nearest_miss
        .as_ref()
        .map(|(constraints, answer)| NearestMiss { relax: options_of(constraints), result: entry((1, answer)) });
    let document = Document {
        target: json::target(&report.target, &report.reading),
        curves: Some(report.findings.curves),
        searched: report.searched.clone(),
        results: (1..).zip(&report.findings.answers).map(entry).collect(),
        nearest_miss: miss,
    };
    report::json(FORMAT, &document)
}

fn entry(rank: usize, answer: &LinkageAnswer) -> Entry {
    let template = &answer.family.template;
    let is_length = template.is_driven_by_length();
    Entry {
        placed: PlacedRecord::new(rank, template, &answer.curve),
        branch: branch(answer),
        input_deg: (!is_length).then_some(answer.inputs),
        input_length: is_length.then_some(answer.inputs),
    }
}
