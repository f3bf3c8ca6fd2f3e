//! The JSON that `find --function --json` prints.

use coupler_curves::geometry::trig;
use serde::Serialize;

use super::super::super::{Failure, report as reports};
use super::super::json::FORMAT;
use super::report::FunctionReport;
use crate::find::Notation;
use crate::find::function::words::findings_in_words;
use crate::find::function::{FunctionRecord, method_name};

#[derive(Serialize)]
struct Document {
    function: Function,
    method: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    precision_points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    solutions: Option<usize>,
    left_out: String,
    results: Vec<FunctionRecord>,
}

#[derive(Serialize)]
struct Function {
    name: String,
    input_travel_deg: f64,
    output_is_length: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<Vec<[f64; 2]>>,
}

/// The function and the linkages, as indented JSON.
pub(super) fn json(report: &FunctionReport) -> Result<String, Failure> {
    let target = &report.target;
    let output = |value: f64| if target.is_length() { value } else { trig::degrees(value) };
    let rows =
        target.row_count().map(|_| target.samples().into_iter().map(|[x, y]| [trig::degrees(x), output(y)]).collect());
    let last = report.attempts.last();
    let (method, precision_points) = method_name(last.map_or(report.options.method, |attempt| attempt.method));
    let document = Document {
        function: Function {
            name: report.name.clone(),
            input_travel_deg: trig::degrees(target.travel()),
            output_is_length: target.is_length(),
            rows,
        },
        method,
        precision_points,
        solutions: last.and_then(|attempt| attempt.findings.solutions),
        left_out: last.map_or(String::new(), |attempt| findings_in_words(&attempt.findings, Notation::CommandLine)),
        results: (1..).zip(report.answers()).map(|(rank, answer)| FunctionRecord::new(rank, answer)).collect(),
    };
    reports::json(FORMAT, &document)
}
