//! The JSON of an atlas's curves.

use crate::find::AtlasAnswer;
use coupler_find::AnswerRecord;
use serde::Serialize;

use super::super::super::{Failure, report};
use super::super::json::{self, Document, FORMAT, NearestMiss, PlacedRecord};
use super::super::text::options_of;
use super::AtlasReport;

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
    Placed(Box<PlacedRecord>),
}

/// The path and the curves, as indented JSON.
pub(super) fn json(report: &AtlasReport) -> Result<String, Failure> {
    let entry = |(rank, answer): (usize, &AtlasAnswer)| entry(report, rank, answer);
    let miss = report.findings.nearest_miss.as_ref();
    let document = Document {
        target: json::target(&report.target, &report.reading),
        curves: Some(report.findings.curves),
        searched: None,
        results: (1..).zip(&report.findings.answers).map(entry).collect(),
        nearest_miss: miss
            .map(|(relax, nearest)| NearestMiss { relax: options_of(relax), result: entry((1, nearest)) }),
    };
    report::json(FORMAT, &document)
}

fn entry(report: &AtlasReport, rank: usize, answer: &AtlasAnswer) -> Entry {
    let AtlasAnswer { place, name, curve, refined } = answer;
    let result = match refined {
        Some(answer) => Linkage::Refined(Box::new(AnswerRecord::new(rank, answer))),
        None => {
            let template = &report.plan.families[place[0]].family.template;
            Linkage::Placed(Box::new(PlacedRecord::new(rank, template, curve)))
        }
    };
    Entry { cell: name.clone(), cell_number: place[1] + 1, refined: refined.is_some(), result }
}
