use coupler_atlas::design::{Design, DrivenLinkage, Driver, ProportionOrigin};
use serde_json::{Map, Value, json};

use super::trade_offs::trade_offs;
use super::{Report, option_name};

/// The version of the format.
const FORMAT: u32 = 1;

/// For programs.
pub(super) fn json(report: &Report) -> String {
    let Report { requirements: wishes, results: found, .. } = report;
    let designs: Vec<Value> = (0..found.designs.len())
        .map(|k| {
            let mut value = design(&found.designs[k]);
            value["trade_offs"] = json!(trade_offs(&found.designs, k));
            value
        })
        .collect();
    let left_out = found.rejected.iter().map(|one| {
        let closed = one.is_closed_form.then(|| one.driven_linkage.kind.closed_condition());
        json!({ "linkage": one.driven_linkage.kind.id(), "input": arrangement_input(one.driven_linkage), "condition": closed, "why": one.reason })
    });
    let relaxations = found.relaxations.iter().map(|relaxation| {
        let design = design(&relaxation.design);
        json!({ "wish": option_name(relaxation.requirement), "to": relaxation.value, "design": design })
    });
    let whole = json!({
        "format": FORMAT,
        "wishes": {
            "input": wishes.input.map(input_name),
            "double_point": wishes.double_point,
            "quick_return": wishes.quick_return,
            "p": wishes.p,
            "length": wishes.length,
            "tolerance": wishes.tolerance,
            "size": wishes.size,
            "mu_min_deg": wishes.mu_min,
            "types": wishes.kinds.iter().map(|kind| kind.id()).collect::<Vec<_>>(),
        },
        "designs": designs,
        "left_out": left_out.collect::<Vec<_>>(),
        "relaxations": relaxations.collect::<Vec<_>>(),
    });
    format!("{whole:#}\n")
}

fn input_name(input: Driver) -> &'static str {
    match input {
        Driver::Motor => "motor",
        Driver::Rocker => "rocker",
    }
}

fn arrangement_input(arrangement: DrivenLinkage) -> &'static str {
    input_name(arrangement.input)
}

fn design(design: &Design) -> Value {
    let names = design.family.template.parameters.iter().map(|parameter| parameter.name.clone());
    let parameters: Map<String, Value> = names.map(|name| (name.clone(), json!(design.parameter(&name)))).collect();
    json!({
        "linkage": design.driven_linkage.kind.id(),
        "input": arrangement_input(design.driven_linkage),
        "driven": design.performance.input_link.name(),
        "condition": (design.origin == ProportionOrigin::ClosedCondition).then(|| design.driven_linkage.kind.closed_condition()),
        "parameters": parameters,
        "class": design.class,
        "tolerance": design.tolerance,
        "straight_length": design.straight.length,
        "straight_deviation": design.straight.deviation,
        "straight_start_deg": design.straight.start_input,
        "straight_input_deg": design.straight.input_span,
        "swing_deg": design.swing,
        "mu_min_deg": design.performance.mu_min,
        "size": design.performance.size,
        "time_ratio": design.time_ratio(),
        // Unbounded where the driven link or the point stands still; JSON has no infinity.
        "speed_ratio": Some(design.speed_ratio).filter(|ratio| ratio.is_finite()),
        "double_points": design.crunode_count,
    })
}
