//! The JSON that `design LINKAGE --json` prints.

use std::collections::BTreeMap;

use crate::design::Designs;
use coupler_curves::measure::Measure;
use coupler_find::{DesignAnswer, Direction, Wishes};
use serde::Serialize;

use super::super::super::{Failure, report};

/// The version of the format.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document {
    linkage: String,
    searched: Vec<String>,
    wishes: Vec<String>,
    goals: Vec<GoalRecord>,
    max_link: Option<f64>,
    interrupted: bool,
    designs: Vec<DesignRecord>,
    /// What each wish comes to while the others are met.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    misses: Vec<MissRecord>,
}

#[derive(Serialize)]
struct GoalRecord {
    expression: String,
    direction: &'static str,
}

#[derive(Serialize)]
struct DesignRecord {
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

#[derive(Serialize)]
struct WishRecord {
    wish: String,
    value: Option<f64>,
    met: bool,
}

#[derive(Serialize)]
struct MissRecord {
    wish: String,
    design: DesignRecord,
}

/// The wishes and the designs, as indented JSON.
pub(super) fn json(linkage: &str, wishes: &Wishes, designs: &Designs) -> Result<String, Failure> {
    let texts: Vec<String> = wishes.wishes.iter().map(|wish| wish.text()).collect();
    let goal = |goal: &coupler_find::Goal| GoalRecord {
        expression: goal.text.clone(),
        direction: if goal.direction == Direction::Greatest { "maximize" } else { "minimize" },
    };
    let document = Document {
        linkage: linkage.to_owned(),
        searched: designs.searched.clone(),
        goals: wishes.goals.iter().map(goal).collect(),
        max_link: Some(wishes.max_link).filter(|length| length.is_finite()),
        interrupted: designs.is_interrupted,
        designs: (1..).zip(&designs.answers).map(record).collect(),
        misses: designs
            .misses
            .iter()
            .map(|miss| MissRecord { wish: texts[miss.wish].clone(), design: record((1, &miss.nearest)) })
            .collect(),
        wishes: texts,
    };
    report::json(FORMAT, &document)
}

fn record((rank, answer): (usize, &DesignAnswer)) -> DesignRecord {
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
