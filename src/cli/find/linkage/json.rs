//! The JSON of linkages with their dimensions.

use crate::find::LinkageAnswerRecord;
use coupler_find::LinkageAnswer;

use super::super::super::{Failure, report};
use super::super::json::{self, Document, FORMAT, NearestMiss};
use super::super::text::options_of;
use super::LinkageReport;

/// The path and the linkages, as indented JSON.
pub(super) fn json(report: &LinkageReport) -> Result<String, Failure> {
    let entry = |(rank, answer): (usize, &LinkageAnswer)| LinkageAnswerRecord::new(rank, answer);
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
