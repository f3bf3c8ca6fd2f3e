//! linkage_sim: the JSON of bodies with points in their own coordinates, and of joints between them.

use std::collections::HashMap;

use serde_json::{Map, Value};

use super::assembly::{Hold, HoldKind, Pose, assemble};
use super::error::{Error, quote};
use super::json_values::{position, unit};
use super::sketch::{Sketch, SketchInput, Slider, SliderLine};

const ORIGIN: &str = "a mechanism of linkage_sim";

/// The body that is the frame.
const GROUND: &str = "ground";

/// The most points of all bodies: two for each joint, some of which are joined.
const MAX_POINTS: usize = 4 * Sketch::MAX_PARTS;

/// Whether an object has the keys of this format.
pub fn is_linkage_sim(object: &Map<String, Value>) -> bool {
    object.contains_key("bodies")
}

/// Reads a mechanism, and puts its bodies together.
///
/// # Errors
/// A body or a joint is wrong, or the bodies do not fit together.
pub fn parse(object: &Map<String, Value>) -> Result<Sketch, Error> {
    let mut bodies = Bodies::read(table(object, "bodies")?)?;
    let mut joints = Vec::new();
    for (id, value) in table(object, "joints")? {
        check_count(joints.len() + 1, MAX_POINTS / 2, "joints")?;
        joints.push(Joint::read(id, value, &bodies)?);
    }
    let drivers = match object.get("drivers") {
        None | Some(Value::Null) => Vec::new(),
        Some(_) => {
            let drivers = table(object, "drivers")?.iter();
            drivers.map(|(id, value)| Driver::read(id, value, &bodies)).collect::<Result<Vec<_>, _>>()?
        }
    };
    bodies.assemble(&joints, drivers.first())?;
    bodies.join(&joints);
    let mut sketch = Sketch::new(ORIGIN);
    sketch.title = object.get("name").and_then(Value::as_str).map(str::to_owned);
    sketch.unit = unit(object);
    let places = bodies.draw(&joints, &mut sketch)?;
    add_sliders(&bodies, &joints, &places, &mut sketch)?;
    if let [driver, further @ ..] = &drivers[..] {
        let is_driven = |joint: &&Joint| {
            let [a, b] = driver.bodies;
            joint.kind == JointKind::Pin && (joint.bodies == [a, b] || joint.bodies == [b, a])
        };
        let pin = joints.iter().find(is_driven).and_then(|joint| places.joints[joint.points[0]]);
        let links = driver.bodies.map(|body| places.links[bodies.welded[body]]);
        sketch.input = pin.map(|pivot| SketchInput::Turn { pivot, links });
        further.iter().for_each(|other| sketch.note(format!("the driver {} was left out", quote(&other.id))));
    }
    sketch.note("masses, forces, load cases and speeds were left out");
    sketch.note("the file has no pose: its bodies were put together in one in which they fit");
    Ok(sketch)
}

/// What kind of joint it is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum JointKind {
    Pin,
    Weld,
    /// A slider, by the direction of its line on the first body.
    Slider([f64; 2]),
}

struct Joint {
    id: String,
    kind: JointKind,
    bodies: [usize; 2],
    /// The points that it joins, of all points.
    points: [usize; 2],
    /// The angle of the second body less that of the first, if the joint keeps it.
    angle: f64,
}

struct Driver {
    id: String,
    bodies: [usize; 2],
    angle: f64,
}

struct BodyPoint {
    body: usize,
    name: String,
    position: [f64; 2],
}

struct Bodies {
    /// Their names, the ground first.
    names: Vec<String>,
    points: Vec<BodyPoint>,
    poses: Vec<Pose>,
    /// For each body the first of those that it is welded to.
    welded: Vec<usize>,
    /// For each point the first of those that are at its place.
    shared: Vec<usize>,
}

/// What joints and links of the sketch are made from the points and the bodies.
struct Places {
    joints: Vec<Option<usize>>,
    links: Vec<Option<usize>>,
}

impl Bodies {
    fn read(bodies: &Map<String, Value>) -> Result<Bodies, Error> {
        if !bodies.contains_key(GROUND) {
            return Err(Error::new("`bodies`", format!("there is no body `{GROUND}`"), "call the frame so"));
        }
        check_count(bodies.len(), Sketch::MAX_PARTS, "bodies")?;
        let others = bodies.keys().filter(|name| *name != GROUND).cloned();
        let names: Vec<String> = std::iter::once(GROUND.to_owned()).chain(others).collect();
        let mut points = Vec::new();
        for (body, name) in names.iter().enumerate() {
            let place = format!("the body {}", quote(name));
            let own = bodies[name].get("attachment_points").and_then(Value::as_object);
            let own = own.ok_or_else(|| Error::new(&place, "it has no table `attachment_points`", "add it"))?;
            for (point, value) in own {
                let position = position(value, &format!("{place}, {}", quote(point)))?;
                check_count(points.len() + 1, MAX_POINTS, "points")?;
                points.push(BodyPoint { body, name: point.clone(), position });
            }
        }
        let (welded, shared) = ((0..names.len()).collect(), (0..points.len()).collect());
        Ok(Bodies { poses: vec![Pose::default(); names.len()], names, points, welded, shared })
    }

    /// The body that a key of a table names.
    fn find(&self, fields: &Map<String, Value>, key: &str, place: &str) -> Result<usize, Error> {
        let name = text(fields, key, place)?;
        self.names
            .iter()
            .position(|other| *other == name)
            .ok_or_else(|| Error::new(place, format!("there is no body {}", quote(name)), "name a body of `bodies`"))
    }

    /// The point of a body that a key of a table names.
    fn find_point(&self, body: usize, fields: &Map<String, Value>, key: &str, place: &str) -> Result<usize, Error> {
        let name = text(fields, key, place)?;
        self.points.iter().position(|point| point.body == body && point.name == name).ok_or_else(|| {
            let message = format!("the body {} has no point {}", quote(&self.names[body]), quote(name));
            Error::new(place, message, "name one of its `attachment_points`")
        })
    }

    /// Puts the bodies together, if possible in the pose in which the driver begins.
    fn assemble(&mut self, joints: &[Joint], driver: Option<&Driver>) -> Result<(), Error> {
        let coordinates = self.points.iter().flat_map(|point| point.position);
        let size = coordinates.fold(0.0_f64, |size, x| size.max(x.abs()));
        let scale = if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let scaled = |points: [usize; 2]| points.map(|point| self.points[point].position.map(|x| x / scale));
        let mut holds = Vec::new();
        for &Joint { kind, bodies, points, angle, .. } in joints {
            let kinds = match kind {
                JointKind::Pin => vec![HoldKind::Point(scaled(points))],
                JointKind::Weld => vec![HoldKind::Point(scaled(points)), HoldKind::Angle(angle)],
                JointKind::Slider(line) => vec![HoldKind::Line(scaled(points), line), HoldKind::Angle(angle)],
            };
            holds.extend(kinds.into_iter().map(|kind| Hold { bodies, kind }));
        }
        let driven = driver.map(|driver| Hold { bodies: driver.bodies, kind: HoldKind::Angle(driver.angle) });
        let with_driver: Vec<Hold> = holds.iter().copied().chain(driven).collect();
        let poses = assemble(self.names.len(), &with_driver).or_else(|| assemble(self.names.len(), &holds));
        let mut poses = poses.ok_or_else(|| {
            Error::new(ORIGIN, "no pose was found in which its bodies fit together", "check the points of its joints")
        })?;
        poses.iter_mut().for_each(|pose| pose.origin *= scale);
        self.poses = poses;
        Ok(())
    }

    /// Finds the points that are at one place, and the bodies that are welded.
    fn join(&mut self, joints: &[Joint]) {
        for joint in joints.iter().filter(|joint| joint.kind == JointKind::Weld) {
            unite(&mut self.welded, joint.bodies);
        }
        let mut places = HashMap::new();
        for (k, point) in self.points.iter().enumerate() {
            let first = *places.entry((point.body, point.position.map(f64::to_bits))).or_insert(k);
            unite(&mut self.shared, [first, k]);
        }
        for joint in joints.iter().filter(|joint| !matches!(joint.kind, JointKind::Slider(_))) {
            unite(&mut self.shared, joint.points);
        }
    }

    /// Adds the joints and links.
    fn draw(&self, joints: &[Joint], sketch: &mut Sketch) -> Result<Places, Error> {
        let count = self.names.len();
        let mut places = Places { joints: vec![None; self.points.len()], links: vec![None; count] };
        for body in (1..count).filter(|&body| self.welded[body] == body) {
            places.links[body] = Some(sketch.add_link(self.names[body].as_str())?);
        }
        let joint_at = |point: usize| {
            let is_here = |joint: &&Joint| joint.points.iter().any(|other| self.shared[*other] == self.shared[point]);
            joints.iter().find(is_here)
        };
        for (k, point) in self.points.iter().enumerate() {
            let (joint, link) = (joint_at(k), places.links[self.welded[point.body]]);
            // Of the ground only what is joined is needed.
            if joint.is_none() && link.is_none() {
                continue;
            }
            let index = match places.joints[self.shared[k]] {
                Some(index) => index,
                None => {
                    let place = self.poses[point.body].place(point.position);
                    sketch.add_joint(joint.map_or(&point.name, |joint| &joint.id).as_str(), [place.x, place.y])?
                }
            };
            (places.joints[k], places.joints[self.shared[k]]) = (Some(index), Some(index));
            match link {
                Some(link) => sketch.attach(link, index),
                None => sketch.joints[index].is_fixed = true,
            }
        }
        Ok(places)
    }
}

/// Adds the sliders, each on the line of its first body, or the other way round if the second is the ground.
fn add_sliders(bodies: &Bodies, joints: &[Joint], places: &Places, sketch: &mut Sketch) -> Result<(), Error> {
    for joint in joints {
        let JointKind::Slider(line) = joint.kind else { continue };
        let direction = bodies.poses[joint.bodies[0]].turn(line);
        let links = joint.bodies.map(|body| places.links[bodies.welded[body]]);
        let (carrier, block, point) = match links {
            [carrier, Some(block)] => (carrier, block, joint.points[1]),
            [Some(block), None] => (None, block, joint.points[0]),
            [None, None] => continue,
        };
        let Some(slider) = places.joints[point] else { continue };
        if carrier == Some(block) || sketch.joints[slider].is_fixed {
            let place = format!("the joint {}", quote(&joint.id));
            return Err(Error::new(place, "it slides on nothing that moves", "join it to two bodies"));
        }
        let line = SliderLine::Direction { direction: [direction.x, direction.y], carrier };
        sketch.sliders.push(Slider { joint: slider, line, block: Some(block) });
    }
    Ok(())
}

impl Joint {
    fn read(id: &str, value: &Value, bodies: &Bodies) -> Result<Joint, Error> {
        let place = format!("the joint {}", quote(id));
        let fields = value.as_object().ok_or_else(|| not_a_table(&place))?;
        let own = [bodies.find(fields, "body_i", &place)?, bodies.find(fields, "body_j", &place)?];
        let points = [
            bodies.find_point(own[0], fields, "point_i", &place)?,
            bodies.find_point(own[1], fields, "point_j", &place)?,
        ];
        if own[0] == own[1] {
            return Err(Error::new(place, "it joins a body to itself", "name two bodies"));
        }
        let kind = match text(fields, "type", &place)? {
            "revolute" => JointKind::Pin,
            "fixed" => JointKind::Weld,
            "prismatic" => {
                let axis = fields.get("axis_local_i").unwrap_or(&Value::Null);
                let [x, y] = position(axis, &format!("{place}, `axis_local_i`"))?;
                let length = coupler_curves::geometry::trig::hypot(x, y);
                if !(length.is_normal() && length.is_finite()) {
                    return Err(Error::new(place, "its axis has no direction", "write one, as in [1, 0]"));
                }
                JointKind::Slider([x / length, y / length])
            }
            other => {
                let message = format!("a joint of the type {}, which a drawing cannot express", quote(other));
                return Err(Error::new(place, message, "make it revolute, prismatic or fixed"));
            }
        };
        Ok(Joint { id: id.to_owned(), kind, bodies: own, points, angle: angle(fields, "delta_theta_0") })
    }
}

impl Driver {
    fn read(id: &str, value: &Value, bodies: &Bodies) -> Result<Driver, Error> {
        let place = format!("the driver {}", quote(id));
        let fields = value.as_object().ok_or_else(|| not_a_table(&place))?;
        let own = [bodies.find(fields, "body_i", &place)?, bodies.find(fields, "body_j", &place)?];
        Ok(Driver { id: id.to_owned(), bodies: own, angle: angle(fields, "theta_0") })
    }
}

/// Makes the first of two sets' elements that of both.
fn unite(first: &mut [usize], [a, b]: [usize; 2]) {
    let (kept, gone) = (first[a].min(first[b]), first[a].max(first[b]));
    first.iter_mut().filter(|other| **other == gone).for_each(|other| *other = kept);
}

/// An angle in radians, 0 if there is none.
fn angle(fields: &Map<String, Value>, key: &str) -> f64 {
    fields.get(key).and_then(Value::as_f64).unwrap_or(0.0)
}

fn text<'j>(fields: &'j Map<String, Value>, key: &str, place: &str) -> Result<&'j str, Error> {
    let value = fields.get(key).and_then(Value::as_str);
    value.ok_or_else(|| Error::new(place, format!("it has no `{key}`"), "add it"))
}

fn table<'j>(object: &'j Map<String, Value>, key: &str) -> Result<&'j Map<String, Value>, Error> {
    let table = object.get(key).and_then(Value::as_object);
    table.ok_or_else(|| Error::new(ORIGIN, format!("there is no table `{key}`"), "add it"))
}

fn check_count(count: usize, max: usize, what: &str) -> Result<(), Error> {
    if count <= max {
        return Ok(());
    }
    let message = format!("it has more than {max} {what}, the most that are read");
    Err(Error::new(ORIGIN, message, "import the part of the linkage that traces the curve"))
}

fn not_a_table(place: &str) -> Error {
    Error::new(place, "expected an object", "write it as { \"body_i\": … }")
}
