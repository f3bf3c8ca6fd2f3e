//! Yokes, racks and gears as parts that can be made.

use coupler_curves::catalogue;
use coupler_curves::exchange::SelectedCurve;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, distance_to_segment};
use coupler_curves::linkage::JointId;
use coupler_curves::linkage_format::parse_templates;
use coupler_curves::parts::{GivenSizes, Part, Parts, Slot};
use coupler_curves::solve::Solver;
use coupler_curves::template::Template;

fn template(joints: &str, traced: &str, input: &str) -> Template {
    let text = format!("[[linkage]]\nid = \"own\"\ntrace = [\"{traced}\"]\n{input}\n[linkage.joints]\n{joints}");
    parse_templates(&text).unwrap().remove(0)
}

/// The parts of a linkage with these joints, and its poses.
fn built(joints: &str, traced: &str, input: &str) -> (Parts, Vec<Vec<Point>>, Vec<String>) {
    let template = template(joints, traced, input);
    let family = Family::single_cell(template.into(), &[], Sampling::Samples(90)).unwrap();
    let solved = Solver::new(&family).solve(0).unwrap();
    let names = solved.linkage.joints.iter().map(|joint| joint.name.clone()).collect();
    let traced: Vec<JointId> = solved.curves.iter().map(|curve| curve.joint).collect();
    let circuit = solved.circuit(&solved.curves[0]);
    let parts = Parts::new((&solved.linkage, circuit), &traced, GivenSizes::default()).unwrap();
    let pose = |sample| solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect();
    (parts, (0..circuit.len()).map(pose).collect(), names)
}

fn part<'p>(parts: &'p Parts, name: &str) -> &'p Part {
    parts.parts.iter().find(|part| part.name == name).unwrap_or_else(|| panic!("{name}: {:?}", parts.parts))
}

const FRAME: &str = "O = { fixed = [0, 0] }\nX = { fixed = [1, 0] }\n";

#[test]
fn a_hole_that_would_be_in_the_slot_of_a_yoke_is_in_a_plate_over_it() {
    for (angle, pinned, at, bridge) in [
        ("90", "Y", [0.0, 0.0], &["Y", "", ""][..]),
        ("90", "D", [0.0, 0.8], &["D", "", ""]),
        ("60", "D", [0.2, 0.3], &["D", "", ""]),
        ("90", "D", [2.5, 0.0], &[]),
    ] {
        let joints = format!(
            "{FRAME}C = {{ fixed = [6, 3] }}\nA = {{ crank = \"O\", length = 1 }}\n\
             Y = {{ yoke = \"A\", line = [\"O\", \"X\"], offset = 0, angle = \"{angle} deg\" }}\n{}\
             B = {{ dyad = [\"{pinned}\", \"C\"], lengths = [4.5, 4.5], side = \"left\" }}\n",
            if pinned == "Y" {
                String::new()
            } else {
                format!("D = {{ point = [\"Y\", \"X\"], along = {}, across = {} }}\n", at[0], at[1])
            }
        );
        let (parts, poses, names) = built(&joints, "B", "");
        let joint = names.iter().position(|name| name == pinned).unwrap();
        let is_there = parts.parts.iter().any(|part| part.name == "bridge Y");
        assert_eq!(is_there, !bridge.is_empty(), "{pinned} at {at:?}");
        let carrier = part(&parts, if is_there { "bridge Y" } else { "yoke Y" });
        let hole = carrier.holes.iter().find(|hole| hole.name == pinned).unwrap();
        for pose in &poses {
            assert!((carrier.plane_from_part(pose).apply(hole.centre) - pose[joint]).norm() < 1e-9);
        }
        // The guide pins of both are the same.
        let pins = |part: &Part| {
            let pose = part.plane_from_part(&poses[7]);
            let pins = part.holes.iter().filter(|hole| hole.name.is_empty());
            pins.map(|hole| pose.apply(hole.centre)).collect::<Vec<_>>()
        };
        let [own, other] = [carrier, part(&parts, "yoke Y")].map(pins);
        assert!(own.len() == 2 && own.iter().zip(&other).all(|(a, b)| (a - b).norm() < 1e-9), "{own:?} {other:?}");
        for part in &parts.parts {
            let clear = |hole: Point, slot: &Slot| {
                distance_to_segment(hole, slot.ends[0], slot.ends[1]) > 1.2 * parts.sizes.hole
            };
            assert!(part.holes.iter().all(|hole| part.slots.iter().all(|slot| clear(hole.centre, slot))));
            assert!(part.notes.is_empty(), "{:?}", part.notes);
        }
    }
}

/// A slider that passes a joint of the link on which it slides.
#[test]
fn a_hole_in_the_slot_of_a_link_is_noted() {
    let joints = "O = { fixed = [0, 0] }\nC = { fixed = [4, 0] }\nA = { crank = \"O\", length = 2 }\n\
                  B = { slot = [\"C\", \"A\"] }\nM = { point = [\"C\", \"A\"], along = 4 }\nK = { fixed = [-1, 4] }\n\
                  N = { dyad = [\"M\", \"K\"], lengths = [6, 6], side = \"left\" }\n";
    let (parts, ..) = built(joints, "N", "");
    let notes: Vec<&String> = parts.parts.iter().flat_map(|part| &part.notes).collect();
    assert_eq!(notes, ["the hole M is in the slot A: one plate cannot have both"]);
}

#[test]
fn a_rack_is_as_long_as_its_pinion_rolls_on_it() {
    for (rack, sign) in
        [("radius = 1.5, offset = -1.5", 1.0), ("radius = \"-sqrt(2)\", offset = 3, start = \"1/3\"", -1.0)]
    {
        let joints = format!(
            "{FRAME}A = {{ crank = \"O\", length = 2 }}\nR = {{ rack = \"A\", line = [\"O\", \"X\"], {rack} }}\n\
             M = {{ point = [\"R\", \"X\"], along = 3, across = 0.4 }}\n"
        );
        let (parts, poses, _) = built(&joints, "M", "input = { from = \"-30 deg\", to = \"300 deg\" }");
        let rack = part(&parts, "rack R");
        let line = rack.pitch_line.unwrap();
        let contacts: Vec<f64> = poses
            .iter()
            .map(|pose| {
                let [a, b] = line.ends.map(|end| rack.plane_from_part(pose).apply(end));
                let along = (b - a).normalize();
                let arm = pose[0] - a;
                let distance = along.x * arm.y - along.y * arm.x;
                assert!((distance - sign * line.radius).abs() < 1e-9, "{distance}");
                along.dot(&arm)
            })
            .collect();
        let length = (line.ends[1] - line.ends[0]).norm();
        let [least, most] = [f64::min, f64::max].map(|choose| contacts.iter().copied().reduce(choose).unwrap());
        let margin = parts.sizes.width / 2.0;
        assert!((least - margin).abs() < 1e-9 && (length - most - margin).abs() < 1e-9, "{least} {most} {length}");
        let bounds = rack.outline.bounds();
        assert!(line.ends.iter().all(|end| end.x > bounds.min.x && end.x < bounds.max.x));
    }
    let joints = "O = { fixed = [0, 0] }\nC = { fixed = [5, 1] }\nA = { crank = \"O\", length = 1 }\n\
         B = { dyad = [\"A\", \"C\"], lengths = [4, 3], side = \"left\" }\n\
         R = { rack = \"A\", radius = 0.7, line = [\"A\", \"B\"], offset = -1.2 }\n";
    let input = "input = { from = \"-60 deg\", to = \"60 deg\" }";
    let construction = template(joints, "R", input).construction(4).to_string();
    assert!(construction.contains("without a pitch line, for O is not on that link"), "{construction}");
    let (parts, ..) = built(joints, "R", input);
    let rack = part(&parts, "rack R");
    assert!(rack.pitch_line.is_none() && rack.notes[0].starts_with("no pitch line"), "{:?}", rack.notes);
}

#[test]
fn gears_are_fastened_to_their_cranks() {
    let gears = |crank: &str, own: f64, ratio: i32| {
        let joints = format!(
            "O = {{ fixed = [0, 0] }}\nP = {{ fixed = [4, 0] }}\nA = {{ crank = \"O\", length = {crank} }}\n\
             E = {{ point = [\"O\", \"A\"], along = 0.5, across = 0.9 }}\n\
             G = {{ gear = \"A\", about = \"P\", length = {own}, ratio = [{ratio}, 1] }}\n\
             D = {{ dyad = [\"A\", \"G\"], lengths = [5, 5], side = \"left\" }}\n\
             F = {{ dyad = [\"E\", \"D\"], lengths = [5, 5], side = \"left\" }}\n"
        );
        built(&joints, "F", "").0
    };
    let gear = gears("0.6", 0.5, -2);
    let names: Vec<&str> = part(&gear, "gear O").holes.iter().map(|hole| hole.name.as_str()).collect();
    assert_eq!(names, ["O", "A", "E"], "all that are on it");
    for (own, ratio) in [(1.6, -9), (1.6, 9)] {
        let parts = gears("1.5", own, ratio);
        let (gear, crank) = (part(&parts, "gear P"), part(&parts, "PG"));
        assert!(gear.holes.len() == 2 && gear.notes.is_empty(), "{own} {ratio}: {gear:?}");
        assert!(crank.holes.iter().any(|hole| (hole.centre - gear.holes[1].centre).norm() < 1e-12), "{own} {ratio}");
    }
    let parts = gears("1.5", 0.42, -8);
    assert_eq!(part(&parts, "gear P").notes, ["no room for the hole G at its rim"]);
    let family = Family::single_cell(catalogue::find("rack-steering").unwrap(), &[], Sampling::Samples(90)).unwrap();
    let solved = Solver::new(&family).solve(0).unwrap();
    let curves = SelectedCurve::all_from_cell(&family, "", &[], &solved);
    let parts = curves[0].parts(GivenSizes { hole: Some(6.0), width: None }).unwrap();
    assert_eq!(part(&parts, "gear O").notes, ["no room for a second hole: fasten it to OA"]);
}

/// No sample is at the ends of these slots.
#[test]
fn slots_are_as_long_as_the_motion_and_not_as_its_samples() {
    let way = |joints: &str, traced: &str, name: &str| {
        let (parts, ..) = built(joints, traced, "");
        let part = part(&parts, name);
        assert_eq!(part.slots.len(), 1, "{name}");
        let [from, to] = part.slots[0].ends;
        // Two guide pins in one slot are this far apart.
        let block = parts.parts.iter().filter(|part| part.name.ends_with(" B")).flat_map(|block| &block.holes);
        let pins: Vec<Point> = block.filter(|hole| hole.name.is_empty()).map(|hole| hole.centre).collect();
        (to - from).norm() - parts.sizes.hole - pins.first().map_or(0.0, |pin| (pins[1] - pin).norm())
    };
    let crank = "O = { fixed = [0, 0] }\nA = { crank = \"O\", length = 1.1 }";
    let yoke = "X = { fixed = [1, 0] }\nY = { yoke = \"A\", line = [\"O\", \"X\"], offset = 0, angle = \"90 deg\" }";
    let arm = "C = { fixed = [3, 2] }\nB = { slot = [\"C\", \"A\"] }";
    let slider = "X = { fixed = [1, 0] }\nB = { slide = \"A\", length = 3, line = [\"O\", \"X\"], offset = 0.7, side = \"ahead\" }";
    for (joints, traced, name, expected) in [
        (yoke, "Y", "yoke Y", 2.2),
        (arm, "B", "CB-A", 2.2),
        (slider, "B", "frame", (4.1f64 * 4.1 - 0.49).sqrt() - (1.9f64 * 1.9 - 0.49).sqrt()),
    ] {
        let found = way(&format!("{crank}\n{joints}\n"), traced, name);
        assert!((found - expected).abs() < 1e-12, "{name}: {found} {expected}");
    }
}
