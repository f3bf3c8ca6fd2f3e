//! Readings of a curve at a place: input, position, speed and transmission angle.

use serde_json::{Value, json};

use coupler_curves::geometry::{Point, distance_to_segment};
use coupler_curves::linkage::Input;
use coupler_curves::motion;

use crate::study::{Place, Study};

/// The number of places of a circuit among which the one nearest to a point is searched for.
const PLACES: usize = 720;

/// The steps of the Gauss-Newton method from the nearest chord to the nearest point of the curve.
const NEWTON_STEPS: usize = 6;

/// The reading at a place; null if there is no such pass.
pub(crate) fn reading_json(study: &Study, place: Place) -> Value {
    let Some(pass) = study.passes().get(place.pass) else { return Value::Null };
    let pose = motion::pose(&study.linkage, pass, place.input);
    let at = pose[study.joint];
    json!({
        "pass": place.pass,
        "input": place.input,
        "place": [at.x, at.y],
        "speed": study.velocity(pass, place.input).norm(),
        "mu": study.transmission_angle(&pose),
    })
}

/// The place where the curve is nearest to a point.
pub(crate) fn nearest_place(study: &Study, point: Point) -> Option<Place> {
    let places: Vec<(Place, Point)> = study
        .places(PLACES)
        .filter_map(|place| Some((place, study.joint_position(study.joint, place.pass, place.input)?)))
        .collect();
    let on_one_pass = places.windows(2).filter(|pair| pair[0].0.pass == pair[1].0.pass);
    let distance = |pair: &&[(Place, Point)]| distance_to_segment(point, pair[0].1, pair[1].1);
    let nearest = on_one_pass.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let [(from, at), (to, end)] = [nearest[0], nearest[1]];
    let chord = end - at;
    let share = if chord.norm_squared() > 0.0 { chord.dot(&(point - at)) / chord.norm_squared() } else { 0.0 };
    let input = from.input + share.clamp(0.0, 1.0) * (to.input - from.input);
    Some(Place { pass: from.pass, input: refine(study, from.pass, (input, [from.input, to.input]), point) })
}

/// The input of a pass at which the traced point is nearest to a point, from a near one and within a range.
fn refine(study: &Study, k: usize, (start, [a, b]): (f64, [f64; 2]), point: Point) -> f64 {
    let pass = &study.passes()[k];
    let unit = if study.linkage.input() == Input::Length { 1.0 } else { 180.0 / std::f64::consts::PI };
    let (low, high) = (a.min(b), a.max(b));
    let mut input = start;
    for _ in 0..NEWTON_STEPS {
        let Some(at) = study.joint_position(study.joint, k, input) else { break };
        let velocity = study.velocity(pass, input);
        let square = velocity.norm_squared();
        if !square.is_finite() || square == 0.0 {
            break;
        }
        input = (input + velocity.dot(&(point - at)) / square * unit).clamp(low, high);
    }
    input
}
