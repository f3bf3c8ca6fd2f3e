//! pylinkage: the JSON of a linkage by its components, each with the joints that it is placed from, as versions before 1.0 write it.

use std::collections::HashMap;

use coupler_curves::geometry::{Point, Vector, left_normal, trig};
use serde_json::{Map, Value};

use super::error::{Error, quote};
use super::json_values::unit;
use super::pylinkage::{entries, id_text, not_an_object};
use super::sketch::{Sketch, SketchInput, Slider, SliderLine};

const ORIGIN: &str = "a linkage of pylinkage, by its components";

/// Whether an object has the keys of this format.
pub fn is_components(object: &Map<String, Value>) -> bool {
    let is_list = |key: &str| object.get(key).is_some_and(Value::is_array);
    is_list("components") || is_list("joints") && !object.contains_key("links")
}

/// Reads a linkage. Its joints are where its distances and angles put them, next to where the file has them.
///
/// # Errors
/// A component is wrong or of a kind that a drawing cannot express, or a second crank is driven.
pub fn parse(object: &Map<String, Value>) -> Result<Sketch, Error> {
    let key = if object.get("components").is_some_and(Value::is_array) { "components" } else { "joints" };
    let mut sketch = Sketch::new(ORIGIN);
    sketch.title = object.get("name").and_then(Value::as_str).map(str::to_owned);
    sketch.unit = unit(object);
    let mut components = Vec::new();
    for (k, value) in entries(object, key)?.iter().enumerate() {
        let place = format!("`{key}`, entry {k}");
        let fields = value.as_object().ok_or_else(|| not_an_object(&place))?;
        let name = fields.get("name").or(fields.get("id")).and_then(id_text);
        let name = name.ok_or_else(|| Error::new(&place, "it has no `name`", "add one, which no other has"))?;
        components.push(Component { name, fields, place });
    }
    let mut assembly = Assembly { sketch, joints: HashMap::new() };
    // A component may be before those that it is placed from.
    while !components.is_empty() {
        let count = components.len();
        let mut waiting = Vec::new();
        for component in components {
            if !assembly.add(&component)? {
                waiting.push(component);
            }
        }
        if let [first, ..] = &waiting[..]
            && waiting.len() == count
        {
            let message = format!("{} is placed from a joint that is not there, or from itself", quote(&first.name));
            return Err(Error::new(&first.place, message, "name joints of the file that do not depend on it"));
        }
        components = waiting;
    }
    assembly.sketch.note("speeds, steps of angles, strokes and arcs were left out");
    Ok(assembly.sketch)
}

/// A component of the file.
struct Component<'j> {
    name: String,
    fields: &'j Map<String, Value>,
    place: String,
}

impl Component<'_> {
    fn error(&self, message: impl std::fmt::Display, remedy: &str) -> Error {
        Error::new(format!("{}, {}", self.place, quote(&self.name)), message, remedy)
    }

    /// The value of the first of some keys, which versions call it by.
    fn value(&self, keys: &[&str]) -> Option<&Value> {
        keys.iter().find_map(|key| self.fields.get(*key).filter(|value| !value.is_null()))
    }

    fn number(&self, keys: &[&str]) -> Result<f64, Error> {
        let value = self.value(keys);
        value.and_then(Value::as_f64).ok_or_else(|| {
            let found = value.map_or("nothing".to_owned(), |value| quote(&value.to_string()));
            self.error(format!("expected a number for `{}`, found {found}", keys[0]), "write one, as in 2.5")
        })
    }

    /// Where the file has it.
    fn position(&self) -> Result<Point, Error> {
        Ok(Point::new(self.number(&["x"])?, self.number(&["y"])?))
    }
}

/// The joints that have been placed.
struct Assembly {
    sketch: Sketch,
    joints: HashMap<String, usize>,
}

impl Assembly {
    /// Adds a component, if all joints that it is placed from have been.
    fn add(&mut self, component: &Component) -> Result<bool, Error> {
        let kind = component.fields.get("type").and_then(Value::as_str).unwrap_or_default();
        let count = match kind {
            "Static" | "Ground" => 0,
            "Crank" | "ArcCrank" => 1,
            "Revolute" | "Pivot" | "RRRDyad" | "Fixed" | "FixedDyad" | "PointTracker" => 2,
            "Prismatic" | "Linear" | "RRPDyad" => 3,
            _ => {
                let message = format!("a component of the type {}, which a drawing cannot express", quote(kind));
                let remedy = "make it Ground, Crank, ArcCrank, RRRDyad, FixedDyad, PointTracker or RRPDyad";
                return Err(component.error(message, remedy));
            }
        };
        const KEYS: [&[&str]; 3] = [
            &["joint0", "anchor", "anchor1", "revolute_anchor"],
            &["joint1", "anchor2", "line_anchor1"],
            &["joint2", "line_anchor2"],
        ];
        let mut bases = Vec::new();
        for keys in &KEYS[..count] {
            let Some(base) = self.base(component, keys)? else { return Ok(false) };
            bases.push(base);
        }
        let joint = match bases[..] {
            [pivot] => self.add_crank(component, pivot)?,
            [a, b] if matches!(kind, "Revolute" | "Pivot" | "RRRDyad") => self.add_dyad(component, [a, b])?,
            [a, b] => self.add_point(component, [a, b], kind == "PointTracker")?,
            [from, a, b] => self.add_slider(component, from, [a, b])?,
            _ => self.add_fixed(&component.name, component.position()?)?,
        };
        if self.joints.insert(component.name.clone(), joint).is_some() {
            let message = format!("another joint is called {}", quote(&component.name));
            return Err(component.error(message, "give each a name of its own"));
        }
        Ok(true)
    }

    /// A joint that a component is placed from; `None` if it has not been placed.
    fn base(&mut self, component: &Component, keys: &[&str]) -> Result<Option<usize>, Error> {
        let missing = || component.error(format!("it has no `{}`", keys[0]), "name the joint that it is placed from");
        let value = component.value(keys).ok_or_else(missing)?;
        let Value::Object(fields) = value else {
            let name = id_text(value).ok_or_else(missing)?;
            return Ok(self.joints.get(&name).copied());
        };
        let name = fields.get("ref").or(fields.get("name")).and_then(id_text).ok_or_else(missing)?;
        if let Some(&joint) = self.joints.get(&name) {
            return Ok(Some(joint));
        }
        if fields.get("inline") != Some(&Value::Bool(true)) {
            return Ok(None);
        }
        let pivot = Component { name: name.clone(), fields, place: component.place.clone() };
        // A joint without a name has the number of an object in memory.
        let is_number = name.bytes().all(|byte| byte.is_ascii_digit());
        let shown = if is_number { format!("O{}", self.sketch.joints.len()) } else { name.clone() };
        let joint = self.add_fixed(&shown, pivot.position()?)?;
        self.joints.insert(name, joint);
        Ok(Some(joint))
    }

    fn add_joint(&mut self, name: &str, position: Point) -> Result<usize, Error> {
        self.sketch.add_joint(name, [position.x, position.y])
    }

    fn add_fixed(&mut self, name: &str, position: Point) -> Result<usize, Error> {
        let joint = self.add_joint(name, position)?;
        self.sketch.joints[joint].is_fixed = true;
        Ok(joint)
    }

    fn at(&self, joint: usize) -> Point {
        let [x, y] = self.sketch.joints[joint].position;
        Point::new(x, y)
    }

    /// Adds a bar between two joints.
    fn add_bar(&mut self, joints: [usize; 2]) -> Result<(), Error> {
        let name = joints.map(|joint| self.sketch.joints[joint].name.as_str()).join("-");
        let link = self.sketch.add_link(name)?;
        joints.into_iter().for_each(|joint| self.sketch.attach(link, joint));
        Ok(())
    }

    /// Attaches a joint to the link, or to the frame, that has two others; returns whether there is one.
    fn attach_to_link_of(&mut self, joint: usize, bases: [usize; 2]) -> bool {
        if bases.iter().all(|&base| self.sketch.joints[base].is_fixed) {
            self.sketch.joints[joint].is_fixed = true;
            return true;
        }
        let links = self.sketch.links_at(bases[0]);
        let link = links.into_iter().find(|&link| self.sketch.links[link].joints.contains(&bases[1]));
        link.into_iter().for_each(|link| self.sketch.attach(link, joint));
        link.is_some()
    }

    fn add_crank(&mut self, component: &Component, pivot: usize) -> Result<usize, Error> {
        if self.sketch.input.is_some() {
            return Err(component.error("a second crank is driven", "leave one crank, and make the other a FixedDyad"));
        }
        let radius = component.number(&["distance", "radius", "r"])?;
        let pivot_at = self.at(pivot);
        let direction = match component.value(&["x"]) {
            Some(_) => component.position()? - pivot_at,
            None => {
                let angle = component.number(&["initial_angle"])?;
                Vector::new(trig::cos(angle), trig::sin(angle))
            }
        };
        let Some(direction) = unit_vector(direction) else {
            return Err(component.error("it is drawn at its pivot", "give it another place"));
        };
        let joint = self.add_joint(&component.name, pivot_at + direction * radius)?;
        self.add_bar([pivot, joint])?;
        self.sketch.input = Some(SketchInput::Line([pivot, joint]));
        Ok(joint)
    }

    fn add_dyad(&mut self, component: &Component, bases: [usize; 2]) -> Result<usize, Error> {
        let first = component.number(&["distance0", "distance1"])?;
        let second = component.number(if component.value(&["distance0"]).is_some() {
            &["distance1"]
        } else {
            &["distance2"]
        })?;
        let [a, b] = bases.map(|joint| self.at(joint));
        let line = b - a;
        let distance = line.norm();
        let along = (distance * distance + first * first - second * second) / (2.0 * distance);
        let across = nearest_root(first * first - along * along, first);
        let (Some(direction), Some(across)) = (unit_vector(line), across) else {
            let message = format!("its distances {first} and {second} do not meet over {distance}");
            return Err(component.error(message, "give it others, or draw the linkage in another pose"));
        };
        let position = nearest(a + direction * along, left_normal(direction) * across, component.position()?);
        let joint = self.add_joint(&component.name, position)?;
        if !self.attach_to_link_of(joint, bases) {
            bases.into_iter().try_for_each(|base| self.add_bar([base, joint]))?;
        }
        Ok(joint)
    }

    fn add_point(&mut self, component: &Component, bases: [usize; 2], is_traced: bool) -> Result<usize, Error> {
        let (distance, angle) = (component.number(&["distance", "r"])?, component.number(&["angle"])?);
        let [a, b] = bases.map(|joint| self.at(joint));
        let Some(direction) = unit_vector(b - a) else {
            return Err(component.error("the two joints of its line are at one place", "draw them apart"));
        };
        let turned = direction * trig::cos(angle) + left_normal(direction) * trig::sin(angle);
        let joint = self.add_joint(&component.name, a + turned * distance)?;
        self.sketch.joints[joint].is_traced = is_traced;
        if !self.attach_to_link_of(joint, bases) {
            let message = "it keeps an angle to the line of two joints that are on no common link";
            return Err(component.error(message, "name two joints of one link"));
        }
        Ok(joint)
    }

    fn add_slider(&mut self, component: &Component, from: usize, line: [usize; 2]) -> Result<usize, Error> {
        let length = component.number(&["revolute_radius", "distance"])?;
        let [a, b] = line.map(|joint| self.at(joint));
        let from_at = self.at(from);
        let foot_and_way = unit_vector(b - a).and_then(|direction| {
            let foot = a + direction * direction.dot(&(from_at - a));
            let height = (foot - from_at).norm();
            Some((foot, direction * nearest_root(length * length - height * height, length)?))
        });
        let Some((foot, way)) = foot_and_way else {
            let message = format!("its link of the length {length} does not reach its line");
            return Err(component.error(message, "give it another, or draw the linkage in another pose"));
        };
        let joint = self.add_joint(&component.name, nearest(foot, way, component.position()?))?;
        self.add_bar([from, joint])?;
        self.sketch.sliders.push(Slider { joint, line: SliderLine::Joints(line), block: None });
        Ok(joint)
    }
}

/// A vector of the length 1 in a direction, if it is one.
fn unit_vector(vector: Vector) -> Option<Vector> {
    let length = vector.norm();
    (length.is_normal() && length.is_finite()).then(|| vector / length)
}

/// The root of a square, which is taken for 0 if it is so by rounding only, compared with the square of a length.
fn nearest_root(square: f64, length: f64) -> Option<f64> {
    let is_zero = square.abs() <= 1e-12 * length * length;
    if is_zero { Some(0.0) } else { (square > 0.0).then(|| square.sqrt()) }
}

/// That of the two points to either side of a middle that is nearer to where the file has it.
fn nearest(middle: Point, way: Vector, drawn: Point) -> Point {
    let [ahead, behind] = [middle + way, middle - way];
    if (behind - drawn).norm() < (ahead - drawn).norm() { behind } else { ahead }
}
