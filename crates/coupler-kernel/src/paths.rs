//! The curve of a study: its path in dashes, the speed along it, and its measures.

use serde_json::{Map, Value, json};

use coupler_curves::geometry::{Point, Spline, Vector};
use coupler_curves::linkage::Input;
use coupler_curves::measure::{self, StraightPortion, TracedCurve};
use coupler_curves::motion::Motion;
use coupler_curves::path::{DashPattern, joint_path};
use coupler_drawing::page::{self, dash_period};

use crate::response::Numbers;
use crate::study::{Place, Study};

/// The path of the traced point, no chord further from the curve than `tolerance`, and its dashes: their points one after
/// another, and the index of the first point of each.
pub(crate) fn path_json(study: &Study, options: &page::Options, tolerance: f64, numbers: &mut Numbers) -> Value {
    let linkage = &study.linkage;
    let period = dash_period(linkage, std::slice::from_ref(&study.circuit), options);
    let pattern = DashPattern { period, dash_span: period * options.theme.dash_fraction };
    // Half of the tolerance for the splines, and half for their chords.
    let path = joint_path(linkage, &study.circuit, study.joint, pattern, tolerance / 2.0);
    let chords = |spline: &Spline| spline.flatten(tolerance / 2.0);
    let (mut dashes, mut starts): (Vec<Point>, Vec<f64>) = (Vec::new(), Vec::new());
    for dash in &path.dashes {
        starts.push(dashes.len() as f64);
        dashes.extend(chords(&dash.spline));
    }
    json!({
        "lead": numbers.points(path.whole.iter().flat_map(chords)),
        "dashes": numbers.points(dashes),
        "starts": numbers.array(starts),
    })
}

/// The speed of the traced point at about `count` places of the circuit, per radian or unit of length of the input; not
/// finite at limits.
pub(crate) fn speeds_json(study: &Study, count: usize, numbers: &mut Numbers) -> Value {
    let places: Vec<Place> = study.places(count).collect();
    let speed = |place: &Place| study.velocity(&study.passes()[place.pass], place.input).norm();
    json!({
        "passes": numbers.array(places.iter().map(|place| place.pass as f64)),
        "inputs": numbers.array(places.iter().map(|place| place.input)),
        "speeds": numbers.array(places.iter().map(speed)),
    })
}

/// All measures of the curve as the program computes them, infinite ones as words, and its straight portion.
pub(crate) fn measures_json(study: &Study, numbers: &mut Numbers) -> Value {
    let motion = Motion { circuits: vec![study.circuit.clone()], assembly_error: None };
    let curve = TracedCurve::new(&study.linkage, &motion, &motion.circuits[0], study.joint)
        .with_straight_criterion(study.family.straight);
    let values: Map<String, Value> = measure::ALL
        .iter()
        .zip(measure::compute_all(&curve))
        .map(|(measure, value)| {
            let value = match value {
                // JSON has no infinity.
                measure::Value::Number(number) if number.is_infinite() => json!(number.to_string()),
                measure::Value::Number(number) => json!(number),
                measure::Value::Word(word) => json!(word),
                measure::Value::Missing => Value::Null,
            };
            (measure.name.to_owned(), value)
        })
        .collect();
    let (straight, ..) = curve.computed_marks();
    json!({ "values": values, "straight": straight.and_then(|portion| portion_json(study, portion, numbers)) })
}

/// A straight portion: its points, and the places on the circuit where it begins and ends.
fn portion_json(study: &Study, portion: StraightPortion, numbers: &mut Numbers) -> Option<Value> {
    let from = start_of_portion(study, &portion)?;
    let to = place_after(study, from, portion.input_span);
    let place = |place: Place| json!({ "pass": place.pass, "input": place.input });
    Some(json!({ "points": numbers.points(portion.points), "from": place(from), "to": place(to) }))
}

/// The place where a portion begins: of those with its input, perhaps a turn away, that where the traced point is
/// nearest to its first point.
fn start_of_portion(study: &Study, portion: &StraightPortion) -> Option<Place> {
    let first = *portion.points.first()?;
    let turns = match study.linkage.input() {
        Input::Angle { .. } => [0.0, -1.0, 1.0].map(|turn| turn * study.linkage.input().period()),
        Input::Length => [0.0; 3],
    };
    let places = study.passes().iter().enumerate().flat_map(|(pass, moved)| {
        let [low, high] = moved.input_range();
        // The input was interpolated between samples.
        let slack = 1e-6 * (high - low);
        turns.iter().map(move |turn| portion.start_input + turn).filter_map(move |input| {
            let is_inside = input >= low - slack && input <= high + slack;
            is_inside.then_some(Place { pass, input: input.clamp(low, high) })
        })
    });
    let distance = |place: &Place| -> f64 {
        let at = study.joint_position(study.joint, place.pass, place.input);
        at.map_or(f64::INFINITY, |at: Point| Vector::norm(&(at - first)))
    };
    places.map(|place| (distance(&place), place)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
}

/// The place on the circuit that is some input further, over limits and over the start of a closed circuit.
fn place_after(study: &Study, from: Place, span: f64) -> Place {
    let passes = study.passes();
    let (mut place, mut left) = (from, span);
    // A portion is no longer than the circuit.
    for _ in 0..=passes.len() {
        let pass = &passes[place.pass];
        let rest = (pass.to.input.value - place.input).abs();
        let is_last = place.pass + 1 == passes.len() && !study.circuit.is_closed;
        if left <= rest || is_last {
            place.input += pass.input_direction() * left.min(rest);
            return place;
        }
        left -= rest;
        place.pass = (place.pass + 1) % passes.len();
        place.input = passes[place.pass].from.input.value;
    }
    place
}
