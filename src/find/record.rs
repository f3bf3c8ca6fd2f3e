//! Answers as JSON.

use std::collections::BTreeMap;

use coupler_curves::template::Template;
use coupler_find::{AnswerRecord, FitRecord, LinkageAnswer, PlacedCurve, scaled_values};
use serde::Serialize;

use super::atlas::AtlasAnswer;
use super::description::branch;
use crate::manifest::Plan;

/// A curve of any linkage, where it is placed on the path.
#[derive(Debug, Serialize)]
struct PlacedRecord {
    #[serde(flatten)]
    fit: FitRecord,
    direction: &'static str,
    ends: [f64; 2],
    linkage: String,
    trace: usize,
    joint: String,
    circuit: usize,
    pivots: BTreeMap<String, [f64; 2]>,
    parameters: BTreeMap<String, f64>,
    scaled: bool,
    placement: PlacementRecord,
    full_turn: bool,
    class: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    mu_worst_deg: Option<f64>,
    longest_link: f64,
}

#[derive(Debug, Serialize)]
struct PlacementRecord {
    mirrored: bool,
    scale: f64,
    rotation_deg: f64,
    shift: [f64; 2],
}

impl PlacedRecord {
    fn new(rank: usize, template: &Template, curve: &PlacedCurve) -> PlacedRecord {
        let fit = &curve.fit;
        let scale = fit.placement.scale();
        let values = scaled_values(template, &curve.values, if curve.is_scalable { scale } else { 1.0 });
        let names = template.parameters.iter().map(|parameter| parameter.name.clone());
        PlacedRecord {
            fit: FitRecord::new(rank, &fit.deviation),
            direction: if fit.is_reversed { "backward" } else { "forward" },
            ends: fit.ends,
            linkage: template.id.clone(),
            trace: curve.numbers[0],
            joint: curve.joint.clone(),
            circuit: curve.numbers[1],
            pivots: curve.pivots.iter().map(|(name, p)| (name.clone(), [p.x, p.y])).collect(),
            parameters: names.zip(values).collect(),
            scaled: curve.is_scalable,
            placement: PlacementRecord {
                mirrored: fit.placement.is_mirrored,
                scale,
                rotation_deg: fit.placement.rotation_deg(),
                shift: [fit.placement.shift.re, fit.placement.shift.im],
            },
            full_turn: curve.is_full_turn,
            class: curve.class,
            mu_worst_deg: curve.mu_worst_deg.is_finite().then_some(curve.mu_worst_deg),
            longest_link: curve.longest_link,
        }
    }
}

/// The dimensions of a linkage, and where it is on the path, as JSON has them.
#[derive(Debug, Serialize)]
pub struct LinkageAnswerRecord {
    #[serde(flatten)]
    placed: PlacedRecord,
    branch: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    input_deg: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    input_length: Option<[f64; 2]>,
}

impl LinkageAnswerRecord {
    /// The record of an answer with a rank, from 1.
    pub fn new(rank: usize, answer: &LinkageAnswer) -> LinkageAnswerRecord {
        let template = &answer.family.template;
        let is_length = template.is_driven_by_length();
        LinkageAnswerRecord {
            placed: PlacedRecord::new(rank, template, &answer.curve),
            branch: branch(answer),
            input_deg: (!is_length).then_some(answer.inputs),
            input_length: is_length.then_some(answer.inputs),
        }
    }
}

/// A curve of an atlas, as JSON has it.
#[derive(Debug, Serialize)]
pub struct AtlasAnswerRecord {
    cell: String,
    cell_number: usize,
    refined: bool,
    #[serde(flatten)]
    result: PlacedOrRefined,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum PlacedOrRefined {
    Refined(Box<AnswerRecord>),
    Placed(Box<PlacedRecord>),
}

impl AtlasAnswerRecord {
    /// The record of an answer with a rank, from 1, in the atlas of a plan.
    pub fn new(rank: usize, answer: &AtlasAnswer, plan: &Plan) -> AtlasAnswerRecord {
        let AtlasAnswer { place, name, curve, refined } = answer;
        let result = match refined {
            Some(answer) => PlacedOrRefined::Refined(Box::new(AnswerRecord::new(rank, answer))),
            None => {
                let template = &plan.families[place[0]].family.template;
                PlacedOrRefined::Placed(Box::new(PlacedRecord::new(rank, template, curve)))
            }
        };
        AtlasAnswerRecord { cell: name.clone(), cell_number: place[1] + 1, refined: refined.is_some(), result }
    }
}
