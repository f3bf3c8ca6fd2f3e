//! The parts of linkages: their holes and slots against the motion, their outlines, and the files that they are written to.

use std::collections::HashMap;

use coupler_curves::catalogue;
use coupler_curves::exchange::{PartFormat, SelectedCurve};
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, distance_to_segment};
use coupler_curves::linkage::JointId;
use coupler_curves::linkage_format::parse_templates;
use coupler_curves::parts::{GivenSizes, Outline, Part, Parts, PartsError, Sizes, Slot};
use coupler_curves::solve::{SolvedCell, Solver};

/// A linkage of the catalogue, its parameters, and the names of its parts if they are expected.
type Case = (&'static str, &'static [(&'static str, f64)], &'static [&'static str]);

/// Linkages of every kind of part.
const LINKAGES: [Case; 14] = [
    ("four-bar", &FOUR_BAR, &["frame", "OA", "ABM", "CB"]),
    ("watt-six-bar", &[], &[]),
    ("jansen", &[], &[]),
    ("klann", &[], &[]),
    ("slider-crank", &[], &["frame", "OA", "ABM", "block B"]),
    ("inverted-slider-crank", &[], &["frame", "OA", "CM"]),
    ("whitworth", &[], &[]),
    ("shaper", &[], &[]),
    ("scotch-yoke", &[], &["frame", "OA", "yoke Y"]),
    ("elliptic-trammel", &[], &["frame", "ABM", "block A", "block B"]),
    ("peaucellier-lipkin", &[], &["frame", "DP", "OC", "PC", "OE", "PE", "CQ", "EQ"]),
    ("geared-five-bar", &[], &["frame", "OA", "PD", "AB", "DB", "gear P", "gear O"]),
    ("rack-steering", &[], &["frame", "OA", "NB", "KB", "PD", "LD", "rack R", "gear O"]),
    ("gripper", &[], &[]),
];

const FOUR_BAR: [(&str, f64); 6] =
    [("frame", 4.0), ("crank", 1.0), ("coupler", 3.0), ("rocker", 3.5), ("along", 1.5), ("across", 1.0)];

fn solve(id: &str, values: &[(&str, f64)]) -> (Family, SolvedCell) {
    let values: Vec<(String, f64)> = values.iter().map(|(name, value)| (name.to_string(), *value)).collect();
    let family = Family::single_cell(catalogue::find(id).unwrap(), &values, Sampling::Samples(90)).unwrap();
    let solved = Solver::new(&family).solve(0).unwrap();
    (family, solved)
}

/// Calls `check` with the first curve of each linkage and its parts.
fn for_each(check: impl Fn(&str, &SelectedCurve, &Parts)) {
    for (id, values, _) in LINKAGES {
        let (family, solved) = solve(id, values);
        let curves = SelectedCurve::all_from_cell(&family, "", &[], &solved);
        let parts = curves[0].parts(GivenSizes::default()).unwrap();
        check(id, &curves[0], &parts);
    }
}

/// The poses of a curve's circuit.
fn poses(curve: &SelectedCurve) -> Vec<Vec<Point>> {
    let circuit = curve.circuit();
    let pose = |sample| curve.solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect();
    (0..circuit.len()).map(pose).collect()
}

/// The joints of a hole, by its name or the letters of it.
fn joints(curve: &SelectedCurve, name: &str) -> Vec<JointId> {
    if let Some(joint) = curve.solved.linkage.find_joint(name) {
        return vec![joint];
    }
    name.chars().filter_map(|letter| curve.solved.linkage.find_joint(&letter.to_string())).collect()
}

#[test]
fn linkages_have_the_parts_that_they_are_built_from() {
    for (id, values, expected) in LINKAGES {
        let (family, solved) = solve(id, values);
        let parts = SelectedCurve::all_from_cell(&family, "", &[], &solved)[0].parts(GivenSizes::default()).unwrap();
        let names: Vec<&str> = parts.parts.iter().map(|part| part.name.as_str()).collect();
        assert!(expected.is_empty() || names == expected, "{id}: {names:?}");
    }
}

/// A bar that slides through a fixed pivot: the pin of its slot is on the frame.
#[test]
fn the_pivot_of_a_slot_is_a_hole_of_the_frame() {
    let text = "[[linkage]]\nid = \"bar\"\ntrace = [\"M\"]\n[linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = [-30, 0] }\n\
                A = { crank = \"O\", length = 20 }\nB = { slot = [\"A\", \"C\"] }\nM = { point = [\"A\", \"C\"], along = -25 }\n";
    let template = parse_templates(text).unwrap().remove(0);
    let pivot = template.joints.iter().position(|joint| joint.name == "C").unwrap();
    assert_eq!(template.construction(pivot).to_string(), "fixed pivot at (−30, 0)");
    let family = Family::single_cell(template.into(), &[], Sampling::Samples(90)).unwrap();
    let solved = Solver::new(&family).solve(0).unwrap();
    let parts = SelectedCurve::all_from_cell(&family, "", &[], &solved)[0].parts(GivenSizes::default()).unwrap();
    let holes = |part: &Part| part.holes.iter().map(|hole| hole.name.clone()).collect::<Vec<_>>();
    let named: Vec<(&str, Vec<String>)> = parts.parts.iter().map(|part| (part.name.as_str(), holes(part))).collect();
    assert_eq!(named[0], ("frame", vec!["O".to_owned(), "C".to_owned()]), "{named:?}");
}

#[test]
fn parts_that_are_put_together_by_their_holes_move_as_the_linkage_does() {
    for_each(|id, curve, parts| {
        let mut is_traced = false;
        for part in &parts.parts {
            for pose in poses(curve) {
                let plane_from_part = part.plane_from_part(&pose);
                for hole in &part.holes {
                    for joint in joints(curve, &hole.name) {
                        let miss = (plane_from_part.apply(hole.centre) - pose[joint.index()]).norm();
                        assert!(
                            miss < 1e-9 * (1.0 + hole.centre.coords.norm()),
                            "{id}, {}: {} by {miss}",
                            part.name,
                            hole.name
                        );
                        is_traced |= joint == curve.curve().joint;
                    }
                }
            }
        }
        assert!(is_traced, "{id}: no hole is on the curve");
    });
}

#[test]
fn the_first_hole_is_the_origin_and_the_second_on_the_axis() {
    for_each(|id, _, parts| {
        for part in parts.parts.iter().filter(|part| part.holes.len() > 1) {
            assert_eq!(part.holes[0].centre, Point::origin(), "{id}, {}", part.name);
            let second = part.holes[1].centre;
            assert!(second.y == 0.0 && second.x > 0.0, "{id}, {}: {second}", part.name);
        }
    });
}

#[test]
fn slots_are_as_long_as_the_pins_in_them_need() {
    let slots = std::cell::Cell::new(0);
    for_each(|id, curve, parts| {
        for part in &parts.parts {
            slots.set(slots.get() + part.slots.len());
            for slot in &part.slots {
                let room = |pin: JointId, pose: &[Point]| {
                    let p = part.plane_from_part(pose).inverse().apply(pose[pin.index()]);
                    let [a, b] = slot.ends;
                    assert!(distance_to_segment(p, a, b) < 1e-9 * (b - a).norm(), "{id}, {}: {p}", part.name);
                    (p - a).norm().min((p - b).norm())
                };
                // In the slots of blocks are their guide pins.
                let is_guide = parts.parts.iter().any(|part| part.name.ends_with(&format!(" {}", slot.name)));
                for pin in joints(curve, &slot.name).into_iter().filter(|_| !is_guide) {
                    let least = poses(curve).iter().map(|pose| room(pin, pose)).fold(f64::INFINITY, f64::min);
                    assert!(least >= parts.sizes.hole / 2.0 - 1e-9, "{id}, {}: {least}", part.name);
                }
            }
        }
    });
    assert!(slots.get() > 6, "{slots:?}");
}

/// Guide pins of what slides without turning are in the slot of its line in every pose.
#[test]
fn guide_pins_stay_in_their_slots() {
    for id in ["slider-crank", "scotch-yoke", "elliptic-trammel", "rack-steering"] {
        let (family, solved) = solve(id, &[]);
        let curve = &SelectedCurve::all_from_cell(&family, "", &[], &solved)[0];
        let parts = curve.parts(GivenSizes::default()).unwrap();
        let guided: Vec<&Part> =
            parts.parts.iter().filter(|part| part.name.contains(' ') && !part.name.starts_with("gear")).collect();
        assert!(!guided.is_empty(), "{id}");
        for part in guided {
            let joint = part.name.split(' ').nth(1).unwrap();
            let is_own = |slot: &&Slot| slot.name.contains(joint);
            let carrier = parts.parts.iter().find(|part| part.slots.iter().any(|slot| is_own(&slot))).unwrap();
            let pins: Vec<Point> =
                part.holes.iter().filter(|hole| hole.name.is_empty()).map(|hole| hole.centre).collect();
            assert_eq!(pins.len(), 2, "{id}, {}", part.name);
            for pose in poses(curve) {
                let carrier_from_part = carrier.plane_from_part(&pose).inverse().after(&part.plane_from_part(&pose));
                for pin in &pins {
                    let p = carrier_from_part.apply(*pin);
                    let miss = |slot: &Slot| distance_to_segment(p, slot.ends[0], slot.ends[1]);
                    let least = carrier.slots.iter().filter(is_own).map(miss).fold(f64::INFINITY, f64::min);
                    assert!(least < 1e-9 * (1.0 + p.coords.norm()), "{id}, {}: {least}", part.name);
                }
            }
        }
    }
}

#[test]
fn outlines_are_around_all_holes_and_slots() {
    for_each(|id, _, parts| {
        for part in parts.parts.iter().filter(|part| !part.name.starts_with("gear")) {
            let margin = parts.sizes.width / 2.0;
            let centres: Vec<Point> =
                part.holes.iter().map(|hole| hole.centre).chain(part.slots.iter().flat_map(|slot| slot.ends)).collect();
            for (arc, radius) in part.outline.arcs() {
                assert!((radius - margin).abs() < 1e-9 * margin, "{id}, {}: {radius}", part.name);
                assert!(
                    centres.iter().any(|centre| (centre - arc).norm() < 1e-9 * (1.0 + arc.coords.norm())),
                    "{id}, {}",
                    part.name
                );
            }
            let Outline::Path(vertices) = &part.outline else { continue };
            for (k, from) in vertices.iter().enumerate().filter(|(_, vertex)| vertex.bulge == 0.0) {
                let to = vertices[(k + 1) % vertices.len()].at;
                let along = (to - from.at).normalize();
                for centre in &centres {
                    // A convex outline is to the left of each of its lines.
                    let inside = along.x * (centre - from.at).y - along.y * (centre - from.at).x;
                    assert!(inside > margin * (1.0 - 1e-9), "{id}, {}: {centre}", part.name);
                }
            }
        }
    });
}

/// The groups of each entity of a DXF document: the values by their codes, in order.
fn entities(text: &str) -> Vec<(String, HashMap<u16, Vec<String>>)> {
    let lines: Vec<&str> = text.lines().collect();
    let groups = lines.chunks(2).map(|pair| (pair[0].trim().parse::<u16>().unwrap(), pair[1]));
    let of_section =
        groups.skip_while(|group| *group != (2, "ENTITIES")).skip(1).take_while(|group| *group != (0, "ENDSEC"));
    let mut entities: Vec<(String, HashMap<u16, Vec<String>>)> = Vec::new();
    for (code, value) in of_section {
        match entities.last_mut() {
            Some((_, groups)) if code != 0 => groups.entry(code).or_default().push(value.to_owned()),
            _ => entities.push((value.to_owned(), HashMap::new())),
        }
    }
    entities
}

#[test]
fn the_drawing_of_a_part_has_its_holes_and_its_outline_to_the_last_digit() {
    for_each(|id, curve, parts| {
        let files = curve.part_files(parts, PartFormat::Dxf, 1e-4);
        assert_eq!((files.len(), files[0].0.as_str()), (parts.parts.len() + 1, "assembly.dxf"), "{id}");
        for (part, (_, text)) in parts.parts.iter().zip(&files[1..]) {
            let entities = entities(text);
            let number = |groups: &HashMap<u16, Vec<String>>, code: u16| groups[&code][0].parse::<f64>().unwrap();
            let on_layer = |layer: &'static str| entities.iter().filter(move |(_, groups)| groups[&8][0] == layer);
            let holes: Vec<Point> =
                on_layer("HOLES").map(|(_, groups)| Point::new(number(groups, 10), number(groups, 20))).collect();
            assert_eq!(holes, part.holes.iter().map(|hole| hole.centre).collect::<Vec<_>>(), "{id}, {}", part.name);
            assert!(on_layer("HOLES").all(|(_, groups)| number(groups, 40) == parts.sizes.hole / 2.0));
            assert_eq!(on_layer("SLOTS").count(), part.slots.len(), "{id}, {}", part.name);
            let (kind, outline) = entities.iter().find(|(_, groups)| groups[&8][0] == part.name).unwrap();
            match &part.outline {
                Outline::Circle { radius, .. } => assert_eq!((kind.as_str(), number(outline, 40)), ("CIRCLE", *radius)),
                Outline::Path(vertices) => {
                    let read =
                        |code: u16| outline[&code].iter().map(|text| text.parse().unwrap()).collect::<Vec<f64>>();
                    let bulges: Vec<f64> =
                        vertices.iter().map(|vertex| vertex.bulge).filter(|bulge| *bulge != 0.0).collect();
                    assert_eq!((kind.as_str(), read(42)), ("LWPOLYLINE", bulges), "{id}, {}", part.name);
                    let xs: Vec<f64> = vertices.iter().map(|vertex| vertex.at.x + 0.0).collect();
                    assert_eq!(read(10), xs, "{id}, {}", part.name);
                }
            }
        }
    });
}

#[test]
fn sizes_that_make_no_part_are_refused() {
    let (family, solved) = solve("four-bar", &FOUR_BAR);
    let curve = &SelectedCurve::all_from_cell(&family, "", &[], &solved)[0];
    let with = |hole: Option<f64>, width: Option<f64>| curve.parts(GivenSizes { hole, width });
    assert_eq!(with(None, None).unwrap().sizes, Sizes { hole: 0.15, width: 0.3 });
    assert_eq!(with(Some(0.3), Some(0.3)).unwrap_err(), PartsError::HoleTooWide { hole: 0.3, width: 0.3 });
    let overlap = with(Some(1.0), Some(2.0)).unwrap_err();
    assert_eq!(overlap.to_string(), "the holes O and A are 1 apart, and 1 wide");
}

#[test]
fn an_svg_of_parts_has_lines_and_arcs_only() {
    for_each(|id, curve, parts| {
        for (name, text) in curve.part_files(parts, PartFormat::Svg, 1e-4).iter().skip(1) {
            assert!(text.starts_with("<?xml") && text.ends_with("</svg>\n"), "{id}, {name}");
            let holes = text.matches("<circle").count();
            assert!(holes >= 1 || text.contains(" A"), "{id}, {name}");
            assert!(!text.contains("NaN") && !text.contains("inf"), "{id}, {name}");
        }
    });
}

/// The parts of a linkage in a text with all its traced joints.
fn parts_of(family: &Family) -> Parts {
    let solved = Solver::new(family).solve(0).unwrap();
    let traced: Vec<JointId> = solved.curves.iter().map(|curve| curve.joint).collect();
    Parts::new((&solved.linkage, solved.circuit(&solved.curves[0])), &traced, GivenSizes::default()).unwrap()
}

fn hole_names<'p>(parts: &'p Parts, part: &str) -> Vec<&'p str> {
    let part =
        parts.parts.iter().find(|other| other.name == part).unwrap_or_else(|| panic!("{part}: {:?}", parts.parts));
    part.holes.iter().map(|hole| hole.name.as_str()).collect()
}

#[test]
fn each_point_of_a_grid_is_a_hole_with_its_number() {
    let (family, _) = solve("hrones-nelson", &[]);
    let expected = ["P", "R", "M1", "M2", "M3", "M4", "M5", "M6", "M7", "M8", "M9", "M10"];
    assert_eq!(hole_names(&parts_of(&family), "PRM"), expected);
}

/// P is on no other link, but on the line along which the pin A slides.
#[test]
fn a_point_that_only_gives_the_line_of_a_slot_is_no_hole() {
    let linkage = r#"[[linkage]]
id = "arm"
trace = ["M"]
[linkage.drawing]
joints = { O = [0, 0], A = [1, 0], C = [3, 0.5], P = [2, 0], Q = [0.4, 0], M = [5, 1] }
frame = ["O", "C"]
links = [["O", "A"], ["C", "P", "Q", "M"]]
slides = { A = ["P", "Q"] }
input = "O A"
"#;
    let template = parse_templates(linkage).unwrap().remove(0);
    let family = Family::single_cell(template.into(), &[], Sampling::Samples(90)).unwrap();
    let parts = parts_of(&family);
    assert_eq!(hole_names(&parts, "CM"), ["C", "M"]);
    let arm = parts.parts.iter().find(|part| part.name == "CM").unwrap();
    assert_eq!(arm.slots.len(), 1);
}

#[test]
fn an_actuator_is_as_long_as_its_circuit_needs() {
    let actuator = |id: &str| parts_of(&solve(id, &[]).0).actuator;
    let driven = actuator("linear-actuator").unwrap();
    assert_eq!(driven.joints, ["C", "A"]);
    // The frame of 2 and the crank of 1 in line.
    assert!((driven.lengths[0] - 1.0).abs() < 1e-9 && (driven.lengths[1] - 3.0).abs() < 1e-9, "{:?}", driven.lengths);
    assert_eq!(actuator("jansen"), None);
}
