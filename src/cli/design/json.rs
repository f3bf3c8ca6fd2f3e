use coupler_atlas::design::{Arrangement, Design, Input, Origin};
use serde_json::{Map, Value, json};

use super::compared::trade_offs;
use super::{Report, option};

/// The version of the format.
const FORMAT: u32 = 1;

/// For programs.
pub(super) fn json(report: &Report) -> String {
    let Report { wishes, found, .. } = report;
    let designs: Vec<Value> = (0..found.designs.len())
        .map(|k| {
            let mut value = design(&found.designs[k]);
            value["trade_offs"] = json!(trade_offs(&found.designs, k));
            value
        })
        .collect();
    let left_out = found.left_out.iter().map(|one| {
        let closed = one.is_closed.then(|| one.arrangement.kind.condition());
        json!({ "linkage": one.arrangement.kind.id(), "input": input(one.arrangement), "condition": closed, "why": one.why })
    });
    let relaxations = found.relaxations.iter().map(|relaxation| {
        let design = design(&relaxation.design);
        json!({ "wish": option(relaxation.wish), "to": relaxation.to, "design": design })
    });
    let whole = json!({
        "format": FORMAT,
        "wishes": {
            "input": wishes.input.map(word),
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

fn word(input: Input) -> &'static str {
    match input {
        Input::Motor => "motor",
        Input::Rocker => "rocker",
    }
}

fn input(arrangement: Arrangement) -> &'static str {
    word(arrangement.input)
}

fn design(design: &Design) -> Value {
    let names = design.family.template.parameters.iter().map(|parameter| parameter.name.clone());
    let parameters: Map<String, Value> = names.map(|name| (name.clone(), json!(design.value(&name)))).collect();
    json!({
        "linkage": design.arrangement.kind.id(),
        "input": input(design.arrangement),
        "driven": design.figures.driven.name(),
        "condition": (design.origin == Origin::Condition).then(|| design.arrangement.kind.condition()),
        "parameters": parameters,
        "class": design.class,
        "tolerance": design.tolerance,
        "straight_length": design.straight.length,
        "straight_deviation": design.straight.deviation,
        "straight_start_deg": design.straight.start,
        "straight_input_deg": design.straight.input,
        "swing_deg": design.swing,
        "mu_min_deg": design.figures.mu_min,
        "size": design.figures.size,
        "time_ratio": design.time_ratio(),
        // Unbounded where the driven link or the point stands still; JSON has no infinity.
        "speed_ratio": Some(design.unevenness).filter(|ratio| ratio.is_finite()),
        "double_points": design.double_points,
    })
}
