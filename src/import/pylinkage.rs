//! pylinkage 1.x: the JSON of a mechanism.

use std::collections::HashMap;

use coupler_curves::geometry::trig;
use serde_json::{Map, Value};

use super::error::{Error, quote};
use super::json_values::{position, unit};
use super::sketch::{Sketch, SketchInput, Slider, SliderLine};

const ORIGIN: &str = "a mechanism of pylinkage";

/// Whether an object has the keys of this format.
pub fn is_pylinkage(object: &Map<String, Value>) -> bool {
    object.contains_key("joints") && object.contains_key("links")
}

/// Reads a mechanism.
///
/// # Errors
/// A joint or a link is wrong, or there are several drivers.
pub fn parse(object: &Map<String, Value>) -> Result<Sketch, Error> {
    let mut sketch = Sketch::new(ORIGIN);
    sketch.title = object.get("name").and_then(Value::as_str).map(str::to_owned);
    sketch.unit = unit(object);
    let mut joints = HashMap::new();
    for (k, joint) in entries(object, "joints")?.iter().enumerate() {
        let place = format!("`joints`, entry {k}");
        let joint = joint.as_object().ok_or_else(|| not_an_object(&place))?;
        let id = id_of(joint, &place)?;
        let index = add_joint(joint, &id, &place, &mut sketch)?;
        if joints.insert(id.clone(), index).is_some() {
            return Err(Error::new(
                place,
                format!("another joint has the id {}", quote(&id)),
                "give each an id of its own",
            ));
        }
    }
    let find = |value: &Value, place: &str| {
        let id = id_text(value);
        let joint = id.as_ref().and_then(|id| joints.get(id)).copied();
        joint.ok_or_else(|| {
            let message = format!("there is no joint {}", quote(&id.unwrap_or_else(|| value.to_string())));
            Error::new(place, message, "name a joint of `joints` by its id")
        })
    };
    let ground = object.get("ground").and_then(id_text);
    for (k, link) in entries(object, "links")?.iter().enumerate() {
        let place = format!("`links`, entry {k}");
        let link = link.as_object().ok_or_else(|| not_an_object(&place))?;
        let id = id_of(link, &place)?;
        let kind = link.get("type").and_then(Value::as_str).unwrap_or("link").to_ascii_lowercase();
        let own: Vec<usize> = entries(link, "joints")
            .map_err(|error| Error { place: place.clone(), ..error })?
            .iter()
            .map(|value| find(value, &place))
            .collect::<Result<_, _>>()?;
        if kind == "ground" || ground.as_ref() == Some(&id) {
            // A joint that slides on a line of the frame is not fixed to it.
            let is_slider = |joint: &usize| sketch.sliders.iter().any(|slider| slider.joint == *joint);
            let fixed: Vec<usize> = own.into_iter().filter(|joint| !is_slider(joint)).collect();
            fixed.into_iter().for_each(|joint| sketch.joints[joint].is_fixed = true);
            continue;
        }
        let index = sketch.add_link(id)?;
        own.iter().for_each(|&joint| sketch.attach(index, joint));
        if kind.contains("driver") {
            let motor = link.get("motor_joint").filter(|motor| !motor.is_null());
            let motor = motor.map(|motor| find(motor, &place)).transpose()?;
            let pivot = motor.or(own.iter().copied().find(|&joint| sketch.joints[joint].is_fixed));
            let Some(pivot) = pivot else {
                return Err(Error::new(
                    place,
                    "the driver has no `motor_joint`",
                    "add the id of its joint on the ground",
                ));
            };
            if sketch.input.is_some() {
                return Err(Error::new(
                    place,
                    "a second link is driven",
                    "leave one driver, and make the other a link",
                ));
            }
            sketch.input = Some(SketchInput::Pivot(pivot));
            sketch.note("the angular velocity and the initial angle of the driver were left out");
            if kind.contains("arc") {
                sketch.note("the arc of the driver was left out: `input` of the linkage would limit it");
            }
        }
    }
    attach_trackers(object, &find, &mut sketch)?;
    Ok(sketch)
}

/// Adds a joint, and its slider if it has one.
fn add_joint(joint: &Map<String, Value>, id: &str, place: &str, sketch: &mut Sketch) -> Result<usize, Error> {
    let name = joint.get("name").and_then(Value::as_str).filter(|name| !name.trim().is_empty()).unwrap_or(id);
    let kind = joint.get("type").and_then(Value::as_str).unwrap_or("revolute").to_ascii_lowercase();
    let at = position(joint.get("position").unwrap_or(&Value::Null), &format!("{place}, `position`"))?;
    let index = sketch.add_joint(name, at)?;
    match kind.as_str() {
        "revolute" => {}
        "ground" => sketch.joints[index].is_fixed = true,
        "tracker" => sketch.joints[index].is_traced = true,
        "prismatic" => {
            let [x, y] = position(joint.get("axis").unwrap_or(&Value::Null), &format!("{place}, `axis`"))?;
            let length = trig::hypot(x, y);
            if !(length.is_normal() && length.is_finite()) {
                return Err(Error::new(place, "its axis has no direction", "write one, as in [1, 0]"));
            }
            let direction = [x / length, y / length];
            sketch.sliders.push(Slider {
                joint: index,
                line: SliderLine::Direction { direction, carrier: None },
                block: None,
            });
            if let Some(point) = joint.get("line_point").filter(|point| !point.is_null()) {
                let [u, v] = position(point, &format!("{place}, `line_point`"))?;
                let offset = direction[0] * (at[1] - v) - direction[1] * (at[0] - u);
                if offset.abs() > 1e-6 * (1.0 + trig::hypot(at[0] - u, at[1] - v)) {
                    sketch.note(format!(
                        "the joint {} is not on its line; it slides on the parallel through it",
                        quote(name)
                    ));
                }
            }
        }
        _ => {
            let message = format!("a joint of the type {}, which a drawing cannot express", quote(&kind));
            return Err(Error::new(place, message, "make it ground, revolute, prismatic or tracker"));
        }
    }
    Ok(index)
}

/// Puts each tracker on the link of its two joints.
fn attach_trackers(
    object: &Map<String, Value>,
    find: &dyn Fn(&Value, &str) -> Result<usize, Error>,
    sketch: &mut Sketch,
) -> Result<(), Error> {
    for (k, joint) in entries(object, "joints")?.iter().enumerate() {
        let place = format!("`joints`, entry {k}");
        let Some(tracker) = joint.as_object().filter(|_| sketch.joints[k].is_traced) else { continue };
        let mut base = [0; 2];
        for (joint, key) in base.iter_mut().zip(["ref_joint1_id", "ref_joint2_id"]) {
            *joint = find(tracker.get(key).unwrap_or(&Value::Null), &format!("{place}, `{key}`"))?;
        }
        let has_base = |link: &usize| base.iter().all(|joint| sketch.links[*link].joints.contains(joint));
        let link = match (0..sketch.links.len()).find(has_base) {
            Some(link) => link,
            None => {
                let link = sketch.add_link(sketch.joints[k].name.clone())?;
                base.into_iter().for_each(|joint| sketch.attach(link, joint));
                link
            }
        };
        sketch.attach(link, k);
    }
    Ok(())
}

pub(super) fn entries<'j>(object: &'j Map<String, Value>, key: &str) -> Result<&'j [Value], Error> {
    let list = object.get(key).and_then(Value::as_array).map(Vec::as_slice);
    list.ok_or_else(|| Error::new(ORIGIN, format!("there is no list `{key}`"), "add it"))
}

pub(super) fn not_an_object(place: &str) -> Error {
    Error::new(place, "expected an object", "write it as { \"id\": … }")
}

/// An id, which may be a text or a number.
pub(super) fn id_text(value: &Value) -> Option<String> {
    match value {
        Value::String(id) => Some(id.clone()),
        Value::Number(id) => Some(id.to_string()),
        _ => None,
    }
}

fn id_of(object: &Map<String, Value>, place: &str) -> Result<String, Error> {
    let id = object.get("id").and_then(id_text);
    id.ok_or_else(|| Error::new(place, "it has no `id`", "add one, which no other has"))
}
