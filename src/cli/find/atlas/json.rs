//! The JSON of an atlas's curves.

use crate::find::{AtlasAnswer, AtlasAnswerRecord};

use super::super::super::{Failure, report};
use super::super::json::{self, Document, FORMAT, NearestMiss};
use super::super::text::options_of;
use super::AtlasReport;

/// The path and the curves, as indented JSON.
pub(super) fn json(report: &AtlasReport) -> Result<String, Failure> {
    let entry = |(rank, answer): (usize, &AtlasAnswer)| AtlasAnswerRecord::new(rank, answer, &report.plan);
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
