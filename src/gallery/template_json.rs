//! Templates and expressions as JSON, for the solver of the page.

use serde_json::{Map, Value, json};

use coupler_curves::expression::{CompiledExpression, PostfixToken, Scope, Unit};
use coupler_curves::template::{
    CircuitSelection, CoincidentDyads, Continuation, Coordinate, InputValue, JointKindTemplate, Parameter, Side,
    Template,
};

/// An expression as a number or a list of postfix tokens: numbers, `[slot]` for the value of a name, operators, and
/// functions with the number of their arguments, as in `"sqrt/1"`.
pub(super) fn expression_json(expression: &CompiledExpression) -> Value {
    postfix_json(expression.postfix())
}

fn postfix_json(tokens: impl Iterator<Item = PostfixToken>) -> Value {
    let token_json = |token| match token {
        PostfixToken::Number(value) => json!(value),
        PostfixToken::Name(slot) => json!([slot]),
        PostfixToken::Operator(symbol) => json!(symbol),
        PostfixToken::Call(name, arguments) => json!(format!("{name}/{arguments}")),
    };
    let mut tokens: Vec<Value> = tokens.map(token_json).collect();
    if tokens.len() == 1 && tokens[0].is_number() { tokens.remove(0) } else { Value::Array(tokens) }
}

/// A value of the input, in degrees or as a length.
fn input_json(value: &InputValue) -> Value {
    let to_degrees = (value.unit == Some(Unit::Rad)).then_some(PostfixToken::Call("deg", 1));
    postfix_json(value.value.postfix().chain(to_degrees))
}

fn coordinate_json(coordinate: &Coordinate) -> Value {
    match coordinate {
        Coordinate::Single(value) => expression_json(value),
        Coordinate::Range { from, to, count } => {
            json!({ "from": expression_json(from), "to": expression_json(to), "count": count })
        }
    }
}

fn side_sign(side: Side) -> i8 {
    match side {
        Side::Left => 1,
        Side::Right => -1,
    }
}

/// How a joint is placed, with the keys of a manifest; other joints are given by their indices.
fn joint_kind_json(kind: &JointKindTemplate) -> Value {
    let e = expression_json;
    match kind {
        JointKindTemplate::Fixed([x, y]) => json!({ "fixed": [e(x), e(y)] }),
        JointKindTemplate::Crank { pivot, length } => json!({ "crank": pivot, "length": e(length) }),
        JointKindTemplate::Gear { crank, pivot, length, ratio: [n, m], phase } => {
            let phase = input_json(phase);
            json!({ "gear": crank, "about": pivot, "length": e(length), "ratio": [e(n), e(m)], "phase": phase })
        }
        JointKindTemplate::Piston { base, length, offset, side: of } => {
            json!({ "piston": base, "length": e(length), "offset": e(offset), "side": side_sign(*of) })
        }
        JointKindTemplate::Dyad { base, lengths: [l0, l1], side: of } => {
            json!({ "dyad": base, "lengths": [e(l0), e(l1)], "side": side_sign(*of) })
        }
        JointKindTemplate::Slide { from, length, line, offset, side: of } => {
            json!({ "slide": from, "length": e(length), "line": line, "offset": e(offset), "side": side_sign(*of) })
        }
        JointKindTemplate::Yoke { from, line, offset, angle } => {
            json!({ "yoke": from, "line": line, "offset": e(offset), "angle": input_json(angle) })
        }
        JointKindTemplate::Slot { base, offset, side: of } => {
            json!({ "slot": base, "offset": e(offset), "side": side_sign(*of) })
        }
        JointKindTemplate::Parallelogram { corners } => json!({ "parallelogram": corners }),
        JointKindTemplate::Point { base, along, across } => {
            json!({ "point": base, "along": coordinate_json(along), "across": coordinate_json(across) })
        }
        JointKindTemplate::Distances { base, distances: [d0, d1], side: of } => {
            json!({ "point": base, "distances": [e(d0), e(d1)], "side": side_sign(*of) })
        }
    }
}

/// A parameter of a template whose names are those of `scope`.
fn parameter_json(parameter: &Parameter, scope: &Scope) -> Value {
    let default = parameter
        .default
        .as_ref()
        .and_then(|default| default.compile(scope, coupler_curves::expression::Kind::Number).ok());
    json!({
        "name": parameter.name,
        "min": parameter.min,
        "max": parameter.max,
        "default": default.as_ref().map(expression_json),
    })
}

/// A template as JSON, with the keys and words of a manifest.
pub fn template_json(template: &Template) -> Value {
    let scope = Scope::from_numbers(template.parameters.iter().map(|parameter| parameter.name.as_str()));
    let joint = |joint: &coupler_curves::template::JointTemplate| {
        let mut entry = Map::new();
        entry.insert("name".to_owned(), json!(joint.name));
        if let Value::Object(placed) = joint_kind_json(&joint.kind) {
            entry.extend(placed);
        }
        Value::Object(entry)
    };
    let placement = template.orientation;
    let axis = placement.transform_vector(coupler_curves::geometry::Vector::new(1.0, 0.0));
    json!({
        "id": template.id,
        "parameters": template.parameters.iter().map(|p| parameter_json(p, &scope)).collect::<Vec<_>>(),
        "joints": template.joints.iter().map(joint).collect::<Vec<_>>(),
        "trace": template.traced,
        "seen_from": template.seen_from,
        "placement": { "mirror": placement.handedness() < 0.0, "cos": axis.x, "sin": axis.y },
        "circuits": match template.circuits { CircuitSelection::Start => "start", CircuitSelection::All => "all" },
        "continuation": match template.continuation {
            Continuation::Smooth => "smooth",
            Continuation::Branch => "branch",
        },
        "coincident": match template.coincident {
            CoincidentDyads::Together => "together",
            CoincidentDyads::First => "first",
            CoincidentDyads::Last => "last",
        },
        "start": template.start.as_ref().map(input_json),
        "input": template.input.as_ref().map(|[from, to]| [input_json(from), input_json(to)]),
        "arc": template.arc.as_ref().map(|([from, to], branch)| {
            json!({ "input": [input_json(from), input_json(to)], "branch": branch })
        }),
    })
}
