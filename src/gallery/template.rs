//! Templates and expressions in JSON, for the page's own solver.

use serde_json::{Map, Value, json};

use coupler_curves::expression::{Bound, Postfix, Unit};
use coupler_curves::template::{
    Circuits, Coincident, Continuation, Coordinate, InputValue, Parameter, Placing, Side, Template,
};

/// An expression: a number, or a program for a stack machine: numbers are pushed, a name's place in brackets pushes its
/// value, words are operators, or functions with their number of arguments.
pub(super) fn expression(bound: &Bound) -> Value {
    program(bound.postfix())
}

fn program(steps: impl Iterator<Item = Postfix>) -> Value {
    let step = |step| match step {
        Postfix::Number(value) => json!(value),
        Postfix::Name(slot) => json!([slot]),
        Postfix::Operator(symbol) => json!(symbol),
        Postfix::Call(name, arguments) => json!(format!("{name}/{arguments}")),
    };
    let mut steps: Vec<Value> = steps.map(step).collect();
    if steps.len() == 1 && steps[0].is_number() { steps.remove(0) } else { Value::Array(steps) }
}

/// A value of the input, in degrees or as a length.
fn input(value: &InputValue) -> Value {
    let degrees = (value.unit == Some(Unit::Rad)).then_some(Postfix::Call("deg", 1));
    program(value.value.postfix().chain(degrees))
}

fn coordinate(coordinate: &Coordinate) -> Value {
    match coordinate {
        Coordinate::One(value) => expression(value),
        Coordinate::Range { from, to, count } => {
            json!({ "from": expression(from), "to": expression(to), "count": count })
        }
    }
}

fn side(side: Side) -> i8 {
    match side {
        Side::Left => 1,
        Side::Right => -1,
    }
}

/// How a joint is placed, in the words of a manifest; joints by their places.
fn placing(placing: &Placing) -> Value {
    let e = expression;
    match placing {
        Placing::Fixed([x, y]) => json!({ "fixed": [e(x), e(y)] }),
        Placing::Crank { pivot, length } => json!({ "crank": pivot, "length": e(length) }),
        Placing::Gear { crank, pivot, length, ratio: [n, m], phase } => {
            json!({ "gear": crank, "about": pivot, "length": e(length), "ratio": [e(n), e(m)], "phase": input(phase) })
        }
        Placing::Piston { base, length, offset, side: of } => {
            json!({ "piston": base, "length": e(length), "offset": e(offset), "side": side(*of) })
        }
        Placing::Dyad { base, lengths: [l0, l1], side: of } => {
            json!({ "dyad": base, "lengths": [e(l0), e(l1)], "side": side(*of) })
        }
        Placing::Slide { from, length, line, offset, side: of } => {
            json!({ "slide": from, "length": e(length), "line": line, "offset": e(offset), "side": side(*of) })
        }
        Placing::Yoke { from, line, offset, angle } => {
            json!({ "yoke": from, "line": line, "offset": e(offset), "angle": input(angle) })
        }
        Placing::Slot { base, offset, side: of } => {
            json!({ "slot": base, "offset": e(offset), "side": side(*of) })
        }
        Placing::Parallelogram { corners } => json!({ "parallelogram": corners }),
        Placing::Point { base, along, across } => {
            json!({ "point": base, "along": coordinate(along), "across": coordinate(across) })
        }
        Placing::Distances { base, distances: [d0, d1], side: of } => {
            json!({ "point": base, "distances": [e(d0), e(d1)], "side": side(*of) })
        }
    }
}

/// A parameter; `slots` are the places of the template's own names.
fn parameter(parameter: &Parameter, scope: &[(&str, coupler_curves::expression::Kind)]) -> Value {
    let default = parameter
        .default
        .as_ref()
        .and_then(|default| default.bind(scope, coupler_curves::expression::Kind::Number).ok());
    json!({
        "name": parameter.name,
        "min": parameter.min,
        "max": parameter.max,
        "default": default.as_ref().map(expression),
    })
}

/// A template, in the words of a manifest.
pub fn template(template: &Template) -> Value {
    let number = coupler_curves::expression::Kind::Number;
    let scope: Vec<(&str, coupler_curves::expression::Kind)> =
        template.parameters.iter().map(|parameter| (parameter.name.as_str(), number)).collect();
    let joint = |joint: &coupler_curves::template::JointTemplate| {
        let mut entry = Map::new();
        entry.insert("name".to_owned(), json!(joint.name));
        if let Value::Object(placed) = placing(&joint.placing) {
            entry.extend(placed);
        }
        Value::Object(entry)
    };
    let placement = template.placement;
    let axis = placement.vector(coupler_curves::geometry::Vector::new(1.0, 0.0));
    json!({
        "id": template.id,
        "parameters": template.parameters.iter().map(|p| parameter(p, &scope)).collect::<Vec<_>>(),
        "joints": template.joints.iter().map(joint).collect::<Vec<_>>(),
        "trace": template.traced,
        "seen_from": template.seen_from,
        "placement": { "mirror": placement.handedness() < 0.0, "cos": axis.x, "sin": axis.y },
        "circuits": match template.circuits { Circuits::Start => "start", Circuits::All => "all" },
        "continuation": match template.continuation {
            Continuation::Smooth => "smooth",
            Continuation::Branch => "branch",
        },
        "coincident": match template.coincident {
            Coincident::Together => "together",
            Coincident::First => "first",
            Coincident::Last => "last",
        },
        "start": template.start.as_ref().map(input),
        "input": template.input.as_ref().map(|[from, to]| [input(from), input(to)]),
        "arc": template.arc.as_ref().map(|([from, to], branch)| json!({ "input": [input(from), input(to)], "branch": branch })),
    })
}
