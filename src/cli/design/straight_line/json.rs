//! The JSON that `design --json` prints.

use crate::design::{Design, DrivenLinkage, Driver, ProportionOrigin};
use serde_json::{Map, Value, json};

use super::report::{Report, option_name};
use super::trade_offs::trade_offs;

/// The version of the format.
const FORMAT: u32 = 2;

/// The requirements, the designs, the rejected linkages and the relaxations, as indented JSON.
pub(super) fn json(report: &Report) -> String {
    let Report { requirements, results, .. } = report;
    let designs: Vec<Value> = (0..results.designs.len())
        .map(|k| {
            let mut value = design_json(&results.designs[k]);
            value["trade_offs"] = json!(trade_offs(&results.designs, k));
            value
        })
        .collect();
    let rejected = results.rejected.iter().map(|rejected| {
        let DrivenLinkage { kind, input } = rejected.driven_linkage;
        let condition = rejected.is_closed_form.then(|| kind.closed_condition());
        json!({ "linkage": kind.id(), "input": input_name(input), "condition": condition, "why": rejected.reason })
    });
    let relaxations = results.relaxations.iter().map(|relaxation| {
        let design = design_json(&relaxation.design);
        json!({ "wish": option_name(relaxation.requirement), "to": relaxation.value, "design": design })
    });
    let document = json!({
        "format": FORMAT,
        "wishes": {
            "input": requirements.input.map(input_name),
            "double_point": requirements.double_point,
            "quick_return": requirements.quick_return,
            "p": requirements.p,
            "length": requirements.length,
            "tolerance": requirements.tolerance,
            "size": requirements.size,
            "mu_min_deg": requirements.mu_min,
            "types": requirements.kinds.iter().map(|kind| kind.id()).collect::<Vec<_>>(),
        },
        "designs": designs,
        "left_out": rejected.collect::<Vec<_>>(),
        "relaxations": relaxations.collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

fn input_name(input: Driver) -> &'static str {
    match input {
        Driver::Motor => "motor",
        Driver::Rocker => "rocker",
    }
}

fn design_json(design: &Design) -> Value {
    let DrivenLinkage { kind, input } = design.driven_linkage;
    let names = design.family.template.parameters.iter().map(|parameter| parameter.name.clone());
    let parameters: Map<String, Value> = names.map(|name| (name.clone(), json!(design.parameter(&name)))).collect();
    json!({
        "linkage": kind.id(),
        "input": input_name(input),
        "driven": design.performance.input_link.name(),
        "condition": (design.origin == ProportionOrigin::ClosedCondition).then(|| kind.closed_condition()),
        "parameters": parameters,
        "class": design.class,
        "tolerance": design.tolerance,
        "straight_length": design.straight.length,
        "straight_deviation": design.straight.deviation,
        "straight_start_deg": design.straight.start_input,
        "straight_input_deg": design.straight.input_span,
        "swing_deg": design.swing,
        "mu_worst_deg": design.performance.mu_min,
        "size": design.performance.size,
        "time_ratio": design.time_ratio(),
        // Infinite where the driven link or the point is at rest, which JSON cannot represent.
        "speed_ratio": Some(design.speed_ratio).filter(|ratio| ratio.is_finite()),
        "double_points": design.crunode_count,
    })
}
