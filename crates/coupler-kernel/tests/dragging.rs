//! Joints are moved to places by dimensions, in every family of the repository's atlas.

use std::path::Path;

use coupler_curves::geometry::trig;
use coupler_drawing::render::Format;
use coupler_kernel::Kernel;
use coupler_manifest::{Plan, PlannedFamily, parse_for_formats};
use serde_json::{Value, json};

/// The plan of a manifest at the root of the repository.
fn plan(name: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    parse_for_formats(&std::fs::read_to_string(path).unwrap(), &Format::ALL, None).plan.unwrap()
}

/// A plate of the page: a curve of a family with changes.
struct Plate {
    kernel: Kernel,
    curve: Value,
    study: Value,
    /// The sides of its dyads on the pass that is shown.
    sides: Value,
    input: f64,
}

impl Plate {
    /// The plate of the first curve of a family.
    fn open(planned: &PlannedFamily) -> Plate {
        let mut kernel = Kernel::default();
        let family = ask(&mut kernel, &json!({ "method": "open_family", "manifest": planned.excerpt() }));
        let own = &planned.family;
        let cell = own.cell(0);
        let values: Vec<(&str, f64)> =
            own.space.slots_of(0).map(|slot| (own.names[slot].as_str(), cell.values[slot])).collect();
        let curve = json!({
            "family": family["family"], "cell": cell.number, "curve": [1, 1], "values": values, "changes": [],
        });
        let mut plate = Plate { kernel, curve, study: Value::Null, sides: Value::Null, input: 0.0 };
        plate.change(&[]);
        let pass = plate.passes()[0].clone();
        plate.sides = pass["sides"].clone();
        let [from, to] = ["from", "to"].map(|end| pass[end].as_f64().unwrap());
        plate.input = from + 0.41 * (to - from);
        plate
    }

    /// Makes the changes of the curve these; whether it exists.
    fn change(&mut self, changes: &[(String, f64)]) -> bool {
        self.curve["changes"] = json!(changes);
        let open = json!({ "method": "open_study", "curve": self.curve, "shown": null, "is_rough": true });
        self.study = ask(&mut self.kernel, &open);
        self.study.get("study").is_some()
    }

    fn passes(&self) -> &[Value] {
        let shown = self.study["shown"].as_u64().unwrap() as usize;
        self.study["circuits"][shown]["passes"].as_array().unwrap()
    }

    /// The index of the pass with the input on the sides of the beginning: with other dimensions it may be another, or none.
    fn pass(&self) -> Option<usize> {
        self.passes().iter().position(|pass| {
            let [from, to] = ["from", "to"].map(|end| pass[end].as_f64().unwrap());
            pass["sides"] == self.sides && (self.input - from) * (self.input - to) <= 0.0
        })
    }

    fn handle(&self) -> usize {
        self.study["study"].as_u64().unwrap() as usize
    }

    fn size(&self) -> f64 {
        let [x0, y0, x1, y1] = [0, 1, 2, 3].map(|k| self.study["box"][k].as_f64().unwrap());
        trig::hypot(x1 - x0, y1 - y0)
    }

    /// The place of a joint, if the linkage has the pose; the traced one, if it is a moved point of a grid, is another joint then.
    fn place(&self, joint: u64, is_traced: bool) -> Option<[f64; 2]> {
        let joint = if is_traced { self.study["joint"].as_u64().unwrap() } else { joint };
        Some(self.kernel.joint_position(self.handle(), joint as usize, self.pass()?, self.input))
    }

    fn drag(&mut self, joint: u64, to: [f64; 2], unlocked: &[String]) -> Dragged {
        let pass = self.pass();
        let answer = ask(
            &mut self.kernel,
            &json!({
                "method": "drag", "study": self.study["study"], "joint": joint, "to": to.map(|at| at.to_string()),
                "pass": pass, "input": self.input.to_string(), "unlocked": unlocked,
            }),
        );
        assert_eq!(answer["is_held"], true, "{answer}");
        let change = |pair: &Value| (pair[0].as_str().unwrap().to_owned(), pair[1].as_f64().unwrap());
        let changes = answer["changes"].as_array().unwrap().iter().map(change).collect();
        Dragged { changes, distance: answer["distance"].as_f64().unwrap() }
    }
}

struct Dragged {
    changes: Vec<(String, f64)>,
    distance: f64,
}

fn ask(kernel: &mut Kernel, request: &Value) -> Value {
    let answer: Value = serde_json::from_str(&kernel.call(&request.to_string()).json).unwrap();
    assert!(answer.get("error").is_none(), "{request}: {answer}");
    answer
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    trig::hypot(a[0] - b[0], a[1] - b[1])
}

/// The handles of a plate: the joint, the names that move it, and whether it is the traced one.
fn handles(plate: &mut Plate) -> Vec<(u64, Vec<String>, bool)> {
    let answer = ask(&mut plate.kernel, &json!({ "method": "handles", "study": plate.study["study"] }));
    let traced = plate.study["joint"].as_u64().unwrap();
    let handle = |one: &Value| {
        let joint = one["joint"].as_u64().unwrap();
        let names = one["names"].as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect();
        (joint, names, joint == traced)
    };
    answer["handles"].as_array().unwrap().iter().map(handle).collect()
}

/// The value of a name on a plate.
fn value(plate: &Plate, name: &str) -> f64 {
    match name.split_once('.') {
        Some((_, way)) => plate.study["point"][way]["value"].as_f64().unwrap(),
        None => plate.study["values"][name].as_f64().unwrap(),
    }
}

#[test]
fn a_joint_goes_where_other_dimensions_put_it() {
    // Of both signs, and never alike.
    let mut shares = (1..).map(|k| (f64::from(k) * 0.618_033_988_749_895).fract() - 0.5);
    let plan = plan("atlas.toml");
    let mut reached = 0;
    for planned in &plan.families {
        let mut plate = Plate::open(planned);
        for (joint, names, is_traced) in handles(&mut plate) {
            let own = plate.place(joint, is_traced).unwrap();
            let still = plate.drag(joint, own, &names);
            assert!(still.changes.is_empty() && still.distance == 0.0, "{}: {joint}", planned.family.id);
            // Where it is with other values of those that move it.
            let changes: Vec<(String, f64)> = names
                .iter()
                .map(|name| (name.clone(), value(&plate, name) * (1.0 + 0.04 * shares.next().unwrap())))
                .collect();
            let to = if plate.change(&changes) { plate.place(joint, is_traced) } else { None };
            assert!(plate.change(&[]));
            let Some(to) = to.filter(|to| to[0].is_finite() && distance(*to, own) < 0.2 * plate.size()) else {
                continue;
            };
            let size = plate.size();
            let found = plate.drag(joint, to, &names);
            // What is left is told, and what the changes say is there.
            assert!(plate.change(&found.changes), "{}: {joint}: {:?}", planned.family.id, found.changes);
            let at = plate.place(joint, is_traced).unwrap();
            assert!((distance(at, to) - found.distance).abs() < 1e-9 * size, "{}: {joint}", planned.family.id);
            assert!(
                found.distance < 1e-9 * size,
                "{}: {joint} {names:?}: {}",
                planned.family.id,
                found.distance / size
            );
            reached += 1;
            assert!(plate.change(&[]));
        }
    }
    assert!(reached > 100, "{reached}");
}

#[test]
fn what_cannot_be_reached_is_neared_as_far_as_it_goes() {
    for planned in &plan("atlas.toml").families {
        let mut plate = Plate::open(planned);
        for (joint, names, is_traced) in handles(&mut plate) {
            // One dimension moves a joint along a line or a curve.
            let one = &names[..1];
            let own = plate.place(joint, is_traced).unwrap();
            let to = [own[0] + 0.05 * plate.size(), own[1] + 0.04 * plate.size()];
            let found = plate.drag(joint, to, one);
            assert!(found.distance <= distance(own, to), "{}: {joint}", planned.family.id);
            assert!(found.changes.iter().all(|(name, _)| one.contains(name)), "{:?}", found.changes);
            let there = if plate.change(&found.changes) { plate.place(joint, is_traced) } else { None };
            if let Some(near) = there {
                assert!(
                    (distance(near, to) - found.distance).abs() < 1e-9 * plate.size(),
                    "{}: {joint}",
                    planned.family.id
                );
            }
            assert!(plate.change(&[]));
        }
    }
}

#[test]
fn a_value_at_its_bound_is_dragged_back() {
    const GREATEST: f64 = 1.0;
    const LESS: f64 = 0.97;
    // With this crank and input it can be assembled at both.
    let part = |value: f64| [("part".to_owned(), value), ("r".to_owned(), 4.0)];
    let atlas = plan("atlas.toml");
    let planned = atlas.families.iter().find(|planned| planned.family.id == "hart-inversor").unwrap();
    let mut plate = Plate::open(planned);
    assert!(plate.change(&part(LESS)));
    plate.input = 30.0;
    plate.sides = plate.passes()[0]["sides"].clone();
    let all = handles(&mut plate);
    let places: Vec<[f64; 2]> =
        all.iter().map(|(joint, _, is_traced)| plate.place(*joint, *is_traced).unwrap()).collect();
    assert!(plate.change(&part(GREATEST)));
    let moved: Vec<(u64, Vec<String>, bool)> =
        handles(&mut plate).into_iter().filter(|(_, names, _)| names.iter().any(|name| name == "part")).collect();
    assert!(!moved.is_empty());
    for (joint, _, is_traced) in moved {
        assert!(plate.change(&part(GREATEST)));
        let number = all.iter().position(|(other, ..)| *other == joint).unwrap();
        let found = plate.drag(joint, places[number], &["part".to_owned()]);
        assert!(found.distance < 1e-9 * plate.size(), "{joint}: {}", found.distance);
        assert!((found.changes[0].1 - LESS).abs() < 1e-9, "{:?}", found.changes);
        assert!(plate.change(&part(found.changes[0].1)) && plate.place(joint, is_traced).is_some());
    }
}
