//! The JSON that `design LINKAGE --json` prints.

use crate::design::{DesignRecord, Designs};
use coupler_find::{Direction, Wishes};
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
        designs: (1..).zip(&designs.answers).map(|(rank, answer)| DesignRecord::new(rank, answer)).collect(),
        misses: designs
            .misses
            .iter()
            .map(|miss| MissRecord { wish: texts[miss.wish].clone(), design: DesignRecord::new(1, &miss.nearest) })
            .collect(),
        wishes: texts,
    };
    report::json(FORMAT, &document)
}
