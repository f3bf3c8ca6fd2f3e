//! The JSON that `find --function --json` prints.

use std::collections::BTreeMap;

use coupler_curves::geometry::trig;
use coupler_find::{FunctionAnswer, FunctionMethod, GeneratorKind};
use serde::Serialize;

use super::super::super::{Failure, report as reports};
use super::super::json::FORMAT;
use super::report::FunctionReport;
use crate::find::function::words::findings_in_words;

#[derive(Serialize)]
struct Document {
    function: Function,
    method: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    precision_points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    solutions: Option<usize>,
    left_out: String,
    results: Vec<Record>,
}

#[derive(Serialize)]
struct Function {
    name: String,
    input_travel_deg: f64,
    output_is_length: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<Vec<[f64; 2]>>,
}

#[derive(Serialize)]
struct Record {
    rank: usize,
    linkage: &'static str,
    parameters: BTreeMap<&'static str, f64>,
    side: &'static str,
    input_deg: [f64; 2],
    output: [f64; 2],
    error_greatest: f64,
    error_greatest_input_deg: f64,
    error_rms: f64,
    error_zeros_input_deg: Vec<f64>,
    class: &'static str,
    full_turn: bool,
    mu_worst_deg: f64,
    longest_to_shortest: f64,
}

impl Record {
    fn new(rank: usize, answer: &FunctionAnswer) -> Record {
        Record {
            rank,
            linkage: match answer.kind {
                GeneratorKind::FourBar => "four-bar",
                GeneratorKind::SliderCrank => "slider-crank",
            },
            parameters: answer.dimensions.iter().copied().collect(),
            side: answer.side,
            input_deg: answer.input_deg,
            output: answer.output,
            error_greatest: answer.error.greatest,
            error_greatest_input_deg: answer.error.at,
            error_rms: answer.error.rms,
            error_zeros_input_deg: answer.error.zeros.clone(),
            class: answer.class,
            full_turn: answer.is_full_turn,
            mu_worst_deg: answer.mu_worst_deg,
            longest_to_shortest: answer.ratio,
        }
    }
}

/// The function and the linkages, as indented JSON.
pub(super) fn json(report: &FunctionReport) -> Result<String, Failure> {
    let target = &report.target;
    let output = |value: f64| if target.is_length() { value } else { trig::degrees(value) };
    let rows =
        target.row_count().map(|_| target.samples().into_iter().map(|[x, y]| [trig::degrees(x), output(y)]).collect());
    let last = report.attempts.last();
    let method = last.map_or(report.options.method, |attempt| attempt.method);
    let document = Document {
        function: Function {
            name: report.name.clone(),
            input_travel_deg: trig::degrees(target.travel()),
            output_is_length: target.is_length(),
            rows,
        },
        method: match method {
            FunctionMethod::Points(_) => "points",
            FunctionMethod::LeastSquares => "least-squares",
            FunctionMethod::Minimax => "minimax",
        },
        precision_points: match method {
            FunctionMethod::Points(count) => Some(count),
            _ => None,
        },
        solutions: last.and_then(|attempt| attempt.findings.solutions),
        left_out: last.map_or(String::new(), |attempt| findings_in_words(&attempt.findings)),
        results: (1..).zip(report.answers()).map(|(rank, answer)| Record::new(rank, answer)).collect(),
    };
    reports::json(FORMAT, &document)
}
