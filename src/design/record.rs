//! A design for programs.

use std::collections::BTreeMap;

use coupler_curves::measure::Measure;
use coupler_find::DesignAnswer;
use serde::Serialize;

/// A design, as JSON has it.
#[derive(Clone, Debug, Serialize)]
pub struct DesignRecord {
    rank: usize,
    parameters: BTreeMap<String, f64>,
    joint: String,
    trace: usize,
    circuit: usize,
    goals: Vec<f64>,
    wishes: Vec<WishRecord>,
    class: Option<&'static str>,
    mu_worst_deg: Option<f64>,
    longest_link: f64,
}

#[derive(Clone, Debug, Serialize)]
struct WishRecord {
    wish: String,
    value: Option<f64>,
    met: bool,
}

impl DesignRecord {
    /// The record of an answer with a rank, from 1.
    pub fn new(rank: usize, answer: &DesignAnswer) -> DesignRecord {
        let curve = &answer.solved.curves[0];
        let named = answer.family.template.parameters.iter().zip(&answer.values);
        DesignRecord {
            rank,
            parameters: named.map(|(parameter, value)| (parameter.name.clone(), *value)).collect(),
            joint: answer.solved.linkage.joints[curve.joint].name.clone(),
            trace: curve.trace,
            circuit: curve.circuit,
            goals: answer.goals.iter().map(|(_, value)| *value).collect(),
            wishes: answer
                .wishes
                .iter()
                .map(|wish| WishRecord {
                    wish: wish.text.clone(),
                    value: wish.value.as_ref().map(|(_, value)| *value),
                    met: wish.is_met,
                })
                .collect(),
            class: curve.measure(Measure::CLASS),
            mu_worst_deg: answer.mu_worst_deg(),
            longest_link: answer.longest_link,
        }
    }
}
