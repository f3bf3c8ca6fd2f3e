//! Linkages that generate a function, for programs.

use std::collections::BTreeMap;

use coupler_curves::template::Template;
use coupler_find::{FunctionAnswer, FunctionMethod, GeneratorKind, LinkageFunctionAnswer};
use serde::Serialize;

/// A linkage in closed form, as JSON has it.
#[derive(Debug, Serialize)]
pub struct FunctionRecord {
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

impl FunctionRecord {
    /// The record of an answer with a rank, from 1.
    pub fn new(rank: usize, answer: &FunctionAnswer) -> FunctionRecord {
        FunctionRecord {
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

/// The dimensions of any linkage, as JSON has them.
#[derive(Debug, Serialize)]
pub struct LinkageFunctionRecord {
    rank: usize,
    parameters: BTreeMap<String, f64>,
    input_deg: [f64; 2],
    output: [f64; 2],
    error_greatest: f64,
    error_greatest_input_deg: f64,
    error_rms: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    mu_worst_deg: Option<f64>,
}

impl LinkageFunctionRecord {
    /// The record of an answer with a rank, from 1, whose values are those of the parameters of a template.
    pub fn new(rank: usize, answer: &LinkageFunctionAnswer, template: &Template) -> LinkageFunctionRecord {
        let names = template.parameters.iter().map(|parameter| parameter.name.clone());
        LinkageFunctionRecord {
            rank,
            parameters: names.zip(answer.values.iter().copied()).collect(),
            input_deg: answer.input_deg,
            output: answer.output,
            error_greatest: answer.error.greatest,
            error_greatest_input_deg: answer.error.at,
            error_rms: answer.error.rms,
            mu_worst_deg: answer.mu_worst_deg.is_finite().then_some(answer.mu_worst_deg),
        }
    }
}

/// The name of a method, and its number of precision points if it has some.
pub fn method_name(method: FunctionMethod) -> (&'static str, Option<usize>) {
    match method {
        FunctionMethod::Points(count) => ("points", Some(count)),
        FunctionMethod::LeastSquares => ("least-squares", None),
        FunctionMethod::Minimax => ("minimax", None),
    }
}
