//! Linkages by their drawings: they pass the pose that is drawn, and keep the lengths of its links.

use coupler_curves::geometry::{Point, Vector, cross, trig};
use coupler_curves::linkage::{Input, Linkage};
use coupler_curves::linkage_format::parse_templates;
use coupler_curves::motion::{self, Motion, Sampler, Sampling};
use coupler_curves::template::{self, Template};

/// What is in a drawing but its coordinates.
struct Kind {
    name: &'static str,
    joints: &'static [&'static str],
    frame: &'static [&'static str],
    input: &'static str,
    links: &'static [&'static [&'static str]],
    slides: &'static [(&'static str, [&'static str; 2])],
}

const KINDS: [Kind; 16] = [
    Kind {
        name: "four-bar",
        joints: &["O", "C", "A", "B", "M"],
        frame: &["O", "C"],
        input: r#""O A""#,
        links: &[&["O", "A"], &["A", "B", "M"], &["B", "C"]],
        slides: &[],
    },
    Kind {
        name: "four-bar, by an angle between moving links",
        joints: &["O", "C", "A", "B", "M"],
        frame: &["O", "C"],
        input: r#"{ between = ["O A", "A B"] }"#,
        links: &[&["O", "A"], &["A", "B", "M"], &["B", "C"]],
        slides: &[],
    },
    Kind {
        name: "four-bar, by a distance",
        joints: &["O", "C", "A", "B", "M"],
        frame: &["O", "C"],
        input: r#"{ distance = ["O", "B"] }"#,
        links: &[&["O", "A"], &["A", "B", "M"], &["B", "C"]],
        slides: &[],
    },
    Kind {
        name: "Watt II",
        joints: &["O", "C", "Q", "A", "B", "D", "M"],
        frame: &["Q", "O", "C"],
        input: r#""O A""#,
        links: &[&["A", "O"], &["B", "A"], &["C", "B", "D"], &["D", "M"], &["M", "Q"]],
        slides: &[],
    },
    Kind {
        name: "Watt I",
        joints: &["O", "C", "A", "B", "D", "E", "M"],
        frame: &["O", "C"],
        input: r#""O A""#,
        links: &[&["D", "M"], &["O", "A"], &["A", "B", "D"], &["C", "B", "E"], &["M", "E"]],
        slides: &[],
    },
    Kind {
        name: "Stephenson III",
        joints: &["O", "C", "Q", "A", "B", "D", "M"],
        frame: &["O", "C", "Q"],
        input: r#""A O""#,
        links: &[&["O", "A"], &["A", "B", "D"], &["B", "C"], &["D", "M"], &["M", "Q"]],
        slides: &[],
    },
    Kind {
        name: "Stephenson I",
        joints: &["O", "C", "A", "E", "B", "F", "M"],
        frame: &["O", "C"],
        input: r#""O E""#,
        links: &[&["O", "A", "E"], &["A", "B"], &["C", "B", "F"], &["E", "M"], &["M", "F"]],
        slides: &[],
    },
    Kind {
        name: "eight-bar, with two links given twice and three at a pin",
        joints: &["O", "C", "Q", "A", "B", "D", "E", "G", "M"],
        frame: &["O", "C", "Q"],
        input: r#""O A""#,
        links: &[
            &["O", "A"],
            &["A", "B", "D"],
            &["A", "D"],
            &["B", "C"],
            &["D", "E"],
            &["E", "Q"],
            &["E", "M"],
            &["M", "G"],
            &["G", "C", "B"],
        ],
        slides: &[],
    },
    Kind {
        name: "slider-crank",
        joints: &["O", "P", "Q", "A", "B", "M"],
        frame: &["O", "P", "Q"],
        input: r#""O A""#,
        links: &[&["O", "A"], &["A", "B", "M"]],
        slides: &[("B", ["P", "Q"])],
    },
    Kind {
        name: "four-bar, by an angle from a line of the frame",
        joints: &["O", "C", "A", "B", "M"],
        frame: &["O", "C"],
        input: r#"{ between = ["C O", "O A"] }"#,
        links: &[&["O", "A"], &["A", "B", "M"], &["B", "C"]],
        slides: &[],
    },
    Kind {
        name: "inverted slider-crank, parallel to a line through its pivot",
        joints: &["O", "C", "A", "P", "M"],
        frame: &["O", "C"],
        input: r#""O A""#,
        links: &[&["O", "A"], &["P", "C", "M"]],
        slides: &[("A", ["P", "C"])],
    },
    Kind {
        name: "slider-crank, by its slider",
        joints: &["O", "P", "Q", "A", "B", "M"],
        frame: &["O", "P", "Q"],
        input: r#"{ slider = "B" }"#,
        links: &[&["O", "A"], &["A", "B", "M"]],
        slides: &[("B", ["P", "Q"])],
    },
    Kind {
        name: "inverted slider-crank, by its slider",
        joints: &["O", "C", "A", "P", "Q", "M"],
        frame: &["O", "C"],
        input: r#"{ slider = "A" }"#,
        links: &[&["O", "A"], &["C", "P", "Q", "M"]],
        slides: &[("A", ["P", "Q"])],
    },
    Kind {
        name: "six-bar, by a slider",
        joints: &["O", "C", "Q", "A", "B", "D", "P", "E", "M"],
        frame: &["O", "C", "Q", "P"],
        input: r#"{ slider = "E" }"#,
        links: &[&["O", "A"], &["A", "B"], &["B", "C", "D"], &["D", "E", "M"]],
        slides: &[("E", ["Q", "P"])],
    },
    Kind {
        name: "inverted slider-crank",
        joints: &["O", "C", "A", "P", "Q", "M"],
        frame: &["O", "C"],
        input: r#""O A""#,
        links: &[&["O", "A"], &["C", "P", "Q", "M"]],
        slides: &[("A", ["P", "Q"])],
    },
    Kind {
        name: "slider on a moving link",
        joints: &["O", "C", "Q", "A", "B", "D", "M"],
        frame: &["O", "C", "Q"],
        input: r#""O A""#,
        links: &[&["O", "A"], &["A", "B", "D"], &["B", "C"], &["Q", "M"]],
        slides: &[("M", ["D", "A"])],
    },
];

/// Random numbers from -1 to 1, by a linear congruential generator.
pub fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn template(kind: &Kind, position: &dyn Fn(usize) -> String) -> Template {
    let joints: Vec<String> =
        kind.joints.iter().enumerate().map(|(k, name)| format!("{name} = {}", position(k))).collect();
    let slides: Vec<String> = kind.slides.iter().map(|(joint, line)| format!("{joint} = {line:?}")).collect();
    let text = format!(
        "[[linkage]]\nid = \"a\"\nparameters = {{ p = {{ default = 0 }} }}\ntrace = [\"M\"]\n[linkage.drawing]\njoints = {{ {} }}\n\
         frame = {:?}\nlinks = {:?}\nslides = {{ {} }}\ninput = {}\n",
        joints.join(", "),
        kind.frame,
        kind.links,
        slides.join(", "),
        kind.input
    );
    parse_templates(&text).unwrap_or_else(|problems| panic!("{}: {problems:?}\n{text}", kind.name)).remove(0)
}

fn solve(linkage: &Linkage) -> Motion {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(180)))
}

/// The positions of the joints at the start, by their names.
fn start_pose(linkage: &Linkage) -> Option<Vec<Point>> {
    let start = linkage.motion_options.start.unwrap();
    let motion = solve(linkage);
    motion.circuits.iter().flat_map(|circuit| &circuit.passes).find_map(|pass| {
        let (from, to) = (pass.from.input.value, pass.to.input.value);
        let is_angle = matches!(linkage.input(), Input::Angle { .. });
        let turns = if is_angle { ((from.min(to) - start) / 360.0).ceil() } else { 0.0 };
        let at = start + 360.0 * turns;
        (pass.mode == linkage.motion_options.mode && at <= from.max(to) && at >= from.min(to))
            .then(|| motion::pose(linkage, pass, at))
    })
}

#[test]
fn drawn_linkages_pass_their_drawing_and_keep_their_lengths() {
    let mut state = 48;
    for kind in &KINDS {
        let (mut drawn, mut greatest, mut changed) = (0, 0.0f64, 0.0f64);
        for number in 0..20 {
            let mut positions: Vec<Point> =
                kind.joints.iter().map(|_| Point::new(4.0 * random(&mut state), 4.0 * random(&mut state))).collect();
            let c = usize::from(kind.joints[1] == "C");
            // Some frames are along the x-axis from the origin.
            if number % 2 == 0 {
                positions[0] = Point::origin();
                positions[c] = if c == 1 { Point::new(3.0 + random(&mut state), 0.0) } else { positions[c] };
            }
            // Every second coordinate has a parameter, which is 0.
            let text = |k: usize| match k % 2 {
                0 if k > 1 => format!("[\"{:?} + p\", {:?}]", positions[k].x, positions[k].y),
                _ => format!("[{:?}, {:?}]", positions[k].x, positions[k].y),
            };
            let template = template(kind, &text);
            let linkage = match template.linkage(&[0.0]) {
                Ok(linkage) => linkage,
                Err(template::Error::Flat { .. }) => continue,
                Err(error) => panic!("{}: {error}", kind.name),
            };
            // Near a limit, a drawing is beyond it by rounding.
            let Some(pose) = start_pose(&linkage) else { continue };
            drawn += 1;
            let id = |name: &str| linkage.find_joint(name).unwrap();
            let place = |name: &str| positions[kind.joints.iter().position(|own| *own == name).unwrap()];
            for &name in kind.joints {
                let distance = (pose[id(name).index()] - place(name)).norm();
                greatest = greatest.max(distance);
            }
            // Lengths and distances from lines are those of the drawing all along the motion.
            let motion = solve(&linkage);
            for circuit in &motion.circuits {
                for sample in (0..circuit.len()).step_by(7) {
                    let at = |name: &str| circuit.positions.point(id(name), sample);
                    for link in kind.links {
                        for (k, a) in link.iter().enumerate() {
                            for b in &link[..k] {
                                let length = (place(a) - place(b)).norm();
                                changed = changed.max(((at(a) - at(b)).norm() - length).abs());
                            }
                        }
                    }
                    for (joint, [a, b]) in kind.slides {
                        let off = |at: &dyn Fn(&str) -> Point| cross((at(b) - at(a)).normalize(), at(joint) - at(a));
                        changed = changed.max((off(&at) - off(&place)).abs());
                    }
                }
            }
        }
        assert!(drawn >= 15, "{}: {drawn} of 20", kind.name);
        // The condition of a dyad near its limit is the square root of a rounding.
        assert!(greatest < 1e-9 && changed < 1e-9, "{}: {greatest:e}, {changed:e}", kind.name);
    }
}

#[test]
fn the_same_four_bar_in_both_forms_is_one() {
    let by_drawing = r#"
[[linkage]]
id = "drawn"
parameters = { p = { default = 1 } }
trace = ["M"]
[linkage.drawing]
joints = { O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.6, 4.8], M = ["0.6 + p", 4.8] }
frame = ["O", "C"]
links = [["O", "A"], ["A", "B", "M"], ["B", "C"]]
input = "O A"
"#;
    let by_joints = r#"
[[linkage]]
id = "joints"
parameters = { p = { default = 1 } }
trace = ["M"]
start = "atan2(0.8, 0.6) rad"
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = [4, 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = [5, "hypot(0.4, 4.8)"], side = "left" }
M = { point = ["A", "B"], along = "0.6 * p + 3.2", across = "2.4 - 0.8 * p" }
"#;
    let [drawn, joints] = [by_drawing, by_joints].map(|text| parse_templates(text).unwrap().remove(0));
    for p in [1.0, 0.3, -2.0] {
        let [drawn, joints] = [&drawn, &joints].map(|template| {
            let linkage = template.linkage(&[p]).unwrap();
            let motion = solve(&linkage);
            let points: Vec<Point> = motion.circuits[0].points(linkage.traced[0]).collect();
            points
        });
        assert_eq!(drawn.len(), joints.len());
        let apart = drawn.iter().zip(&joints).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(apart < 1e-13, "{p}: {apart:e}");
    }
}

#[test]
fn the_input_is_the_angle_or_the_distance_that_is_named() {
    let four_bar = |input: &str| {
        let text = format!(
            r#"
[[linkage]]
id = "a"
trace = ["M"]
[linkage.drawing]
joints = {{ O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.4, 2.6], M = [2.5, 3.4] }}
frame = ["O", "C"]
links = [["O", "A"], ["A", "B", "M"], ["B", "C"]]
input = {input}
"#
        );
        parse_templates(&text).unwrap().remove(0).linkage(&[]).unwrap()
    };
    let angle = |u: Vector, v: Vector| trig::degrees(trig::atan2(cross(u, v), u.dot(&v)));
    for (input, measured) in [
        ("\"O A\"", [["O", "C"], ["O", "A"]]),
        ("\"C B\"", [["O", "C"], ["C", "B"]]),
        ("{ between = [\"O A\", \"A B\"] }", [["O", "A"], ["A", "B"]]),
        ("{ between = [\"M A\", \"C B\"] }", [["M", "A"], ["B", "C"]]),
    ] {
        let linkage = four_bar(input);
        let motion = solve(&linkage);
        let circuit = &motion.circuits[0];
        for sample in 0..circuit.len() {
            let at = |name: &str| circuit.positions.point(linkage.find_joint(name).unwrap(), sample);
            let [u, v] = measured.map(|[a, b]| at(b) - at(a));
            let off = (angle(u, v) - circuit.inputs[sample]).rem_euclid(360.0);
            assert!(off.min(360.0 - off) < 1e-9, "{input}: {off}");
            assert_eq!(at("O"), Point::origin());
            assert!((at("C") - Point::new(4.0, 0.0)).norm() < 1e-12);
        }
    }
    // The way of a slider from the first joint of its line, which may be negative.
    let text = r#"
[[linkage]]
id = "a"
trace = ["M"]
[linkage.drawing]
joints = { O = [0, 0], A = [0.6, 0.8], B = [3.4, 1.6], M = [2.5, 3.4], P = [3, 1], Q = [4, 1.5] }
frame = ["O", "P", "Q"]
links = [["O", "A"], ["A", "B", "M"]]
slides = { B = ["P", "Q"] }
input = { slider = "B" }
"#;
    let linkage = parse_templates(text).unwrap().remove(0).linkage(&[]).unwrap();
    let motion = solve(&linkage);
    let circuit = &motion.circuits[0];
    let along = Vector::new(1.0, 0.5).normalize();
    let [mut least, mut greatest] = [f64::INFINITY, f64::NEG_INFINITY];
    for sample in 0..circuit.len() {
        let at = |name: &str| circuit.positions.point(linkage.find_joint(name).unwrap(), sample);
        let way = along.dot(&(at("B") - Point::new(3.0, 1.0)));
        assert!((way - circuit.inputs[sample]).abs() < 1e-12);
        [least, greatest] = [least.min(way), greatest.max(way)];
    }
    // Both dead points of the crank and coupler: the slider is as far from O as they are long, together and one less the other.
    let coupler = trig::hypot(2.8, 0.8);
    let foot = along.dot(&Vector::new(3.0, 1.0));
    // The line goes through the place of B.
    let line = cross(along, Vector::new(3.4, 1.6));
    let reach = |length: f64| (length * length - line * line).sqrt() - foot;
    assert!((least - reach(coupler - 1.0)).abs() < 1e-9 && (greatest - reach(coupler + 1.0)).abs() < 1e-9);
    let linkage = four_bar("{ distance = [\"B\", \"O\"] }");
    let motion = solve(&linkage);
    let circuit = &motion.circuits[0];
    for sample in 0..circuit.len() {
        let at = |name: &str| circuit.positions.point(linkage.find_joint(name).unwrap(), sample);
        assert!(((at("B") - at("O")).norm() - circuit.inputs[sample]).abs() < 1e-12);
    }
}

/// The problems of a drawing that is changed: a text in it, and what is in its place.
fn problems(change: [&str; 2]) -> Vec<String> {
    const TEXT: &str = r#"
[[linkage]]
id = "a"
trace = ["M"]
[linkage.drawing]
joints = { O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.4, 2.6], M = [2.5, 3.4] }
frame = ["O", "C"]
links = [["O", "A"], ["A", "B", "M"], ["B", "C"]]
input = "O A"
"#;
    assert!(TEXT.contains(change[0]), "{change:?}");
    let changed = TEXT.replacen(change[0], change[1], 1);
    let problems = parse_templates(&changed).expect_err(change[1]);
    problems.iter().map(|problem| format!("{}: {}", problem.message, problem.help)).collect()
}

#[test]
fn what_cannot_be_placed_is_named() {
    for (change, words) in [
        (["[\"B\", \"C\"]]", "[\"B\", \"X\"]]"], "unknown joint `X`"),
        (["[\"B\", \"C\"]]", "[\"B\"]]"], "a link has two joints or more"),
        (["[\"B\", \"C\"]]", "[\"B\", \"B\"]]"], "`B` is named twice"),
        (
            [", [\"B\", \"C\"]]", "]"],
            "the drawing has 2 degrees of freedom, where one is driven: 3 · (3 links - 1) - 2 · 2 pins = 2",
        ),
        (["[\"B\", \"C\"]]", "[\"B\", \"C\"], [\"M\", \"C\"]]"], "the link M-C is one too many"),
        (["\"O A\"", "\"A B\""], "`A B` is not a link that turns about a fixed joint"),
        (["\"O A\"", "\"O B\""], "no link has both `O` and `B`"),
        (["\"O A\"", "\"OA\""], "`OA` does not name two joints"),
        (["\"O A\"", "{ between = [\"A B\", \"A M\"] }"], "both lines are on one link"),
        (["\"O A\"", "{ between = [\"O A\", \"B M\"] }"], "the line does not begin at `A`"),
        (
            ["\"O A\"", "{ distance = [\"A\", \"B\"] }"],
            "`A` and `B` are on one link, and their distance does not change",
        ),
        (["\"O A\"", "{ }"], "the input is not said"),
        (["[0.6, 0.8]", "[0.6]"], "expected two values"),
        (["[0.6, 0.8]", "[\"q\", 0.8]"], "unknown name `q`"),
        (["frame = [\"O\", \"C\"]", "frame = []"], "the frame has no joint"),
        (["M = [2.5, 3.4]", "M = [2.5, 3.4], X = [1, 1]"], "the joint `X` is in no link"),
        (
            ["input = \"O A\"", "input = \"O A\"\nslides = { A = [\"B\", \"M\"] }"],
            "`A` slides on a line of its own link",
        ),
        (["trace", "start = \"0 deg\"\ntrace"], "the drawing is the start of the motion"),
        (
            ["input = \"O A\"", "input = \"O A\"\n[linkage.joints]\nM = { point = [\"A\", \"B\"] }"],
            "the joint `M` is in the drawing",
        ),
    ] {
        let found = problems(change);
        assert!(found.iter().any(|problem| problem.contains(words)), "{change:?}: {found:?}");
    }
}

/// Large drawings are refused, or placed, at once and in little memory.
#[test]
fn the_size_of_a_drawing_is_limited() {
    let drawing = |joints: usize, links: usize, coordinate: &str| {
        let points: Vec<String> = (0..joints).map(|k| format!("J{k} = [{k}, {}]", k * k)).collect();
        let names: Vec<String> = (0..joints).map(|k| format!("\"J{k}\"")).collect();
        let chain: Vec<String> = (0..links).map(|k| format!("[\"O\", \"J{}\"]", k % joints)).collect();
        let text = format!(
            "[[linkage]]\nid = \"a\"\ntrace = [\"J1\"]\n[linkage.drawing]\njoints = {{ O = [{coordinate}, 0], {} }}\nframe = [\"O\"]\n\
             links = [[\"O\", {}], {}]\ninput = \"O J1\"\n",
            points.join(", "),
            names.join(", "),
            chain.join(", ")
        );
        parse_templates(&text)
    };
    let long = format!("\"{}\"", vec!["1"; 60].join(" + "));
    for (joints, links, coordinate, words) in [
        (1001, 1, "0", "at most 1000 are possible"),
        (3000, 3000, "0", "at most 100 are possible"),
        (10, 1, long.as_str(), "at most 100 are possible"),
    ] {
        let problems = drawing(joints, links, coordinate).expect_err(words);
        assert!(problems.iter().any(|problem| problem.message.contains(words)), "{problems:?}");
    }
    let template = drawing(999, 99, "0.5").unwrap().remove(0);
    assert_eq!(template.joints.len(), 1000);
}

/// A bar whose line is drawn through its pivot keeps its distance from the pivot: none, or that of a line parallel to it.
#[test]
fn a_line_that_is_drawn_through_a_pivot_passes_it() {
    for (p, c) in [("[5, 0]", "[2, 0]"), ("[\"2 + 3 * h\", 0]", "[2, 0]"), ("[-0.1, 1.2]", "[2, 0]")] {
        let text = format!(
            r#"
[[linkage]]
id = "a"
parameters = {{ h = {{ default = 1 }} }}
trace = ["M"]
[linkage.drawing]
joints = {{ O = [0, 0], C = {c}, A = [0.6, 0.8], P = {p}, M = [-1, 3] }}
frame = ["O", "C"]
links = [["O", "A"], ["C", "P", "M"]]
slides = {{ A = ["C", "P"] }}
input = "O A"
"#
        );
        let linkage = parse_templates(&text).unwrap().remove(0).linkage(&[1.0]).unwrap();
        let motion = solve(&linkage);
        let at =
            |name: &str, sample: usize| motion.circuits[0].positions.point(linkage.find_joint(name).unwrap(), sample);
        let foot = |sample: usize| (at("C'", sample) - at("C", sample)).norm();
        // In the first two drawings A is off the line of C and P, and slides on one parallel to it.
        let expected = if p.starts_with("[-") { 0.05 } else { 0.8 };
        assert!((0..motion.circuits[0].len()).all(|sample| (foot(sample) - foot(0)).abs() < 1e-12), "{p}");
        assert!((foot(0) - expected).abs() < 0.06, "{p}: {}", foot(0));
    }
}

/// What is held by two joints of one link does not slide on it.
#[test]
fn what_cannot_slide_is_named() {
    for slides in ["A = [\"C\", \"P\"]", "P = [\"A\", \"O\"]"] {
        let text = format!(
            r#"
[[linkage]]
id = "a"
trace = ["P"]
[linkage.drawing]
joints = {{ O = [0, 0], C = [0.1, 0.2], A = [0.6, 0.8], P = [3, 1] }}
frame = ["O"]
links = [["O", "A", "C"], ["C", "P"]]
slides = {{ {slides} }}
input = "O A"
"#
        );
        let problems = parse_templates(&text).expect_err(slides);
        assert!(problems.iter().any(|problem| problem.message.contains("cannot slide: `C`")), "{problems:?}");
    }
}

#[test]
fn lengths_that_are_given_are_those_of_the_linkage() {
    let text = r#"
[[linkage]]
id = "a"
parameters = { k = { default = 3.3 } }
trace = ["M", "N"]
[linkage.drawing]
joints = { O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.4, 2.6], M = [2.5, 3.4], D = [4, 6], E = [7, 5], N = [5, 8] }
frame = ["O", "C", "E"]
links = [["O", "A"], ["A", "B", "M"], ["B", "C"], ["M", "D"], ["D", "E", "N"]]
input = "O A"
lengths = { "A B" = "k", "M B" = 1.25 }
[linkage.joints]
G = { point = ["A", "B"], along = 1, across = { from = 0, to = 1, count = 3 } }
"#;
    let template =
        parse_templates(&text.replace("trace = [\"M\", \"N\"]", "trace = [\"M\", \"N\", \"G\"]")).unwrap().remove(0);
    for k in [3.3, 3.1] {
        let linkage = template.linkage(&[k]).unwrap();
        let motion = solve(&linkage);
        let circuit = &motion.circuits[0];
        assert_eq!(linkage.traced.len(), 5);
        for sample in 0..circuit.len() {
            let at = |name: &str| circuit.positions.point(linkage.find_joint(name).unwrap(), sample);
            for (a, b, length) in
                [("A", "B", k), ("M", "B", 1.25), ("A", "M", trig::hypot(1.9, 2.6)), ("D", "N", trig::hypot(1.0, 2.0))]
            {
                assert!(((at(a) - at(b)).norm() - length).abs() < 1e-12, "{a}{b}");
            }
        }
    }
}

/// A bar on a crank pin, or on a slider, which slides through a pivot of the frame: its points are at a fixed distance from the circle, or
/// the line, along lines through the pivot.
#[test]
fn bars_that_slide_through_a_pivot_draw_conchoids() {
    // Limaçons of Pascal: from the pivot, on the circle of radius 1, at a distance of 2 cos + m; with m = 2 the cardioid.
    let drawn = |m: f64| {
        format!(
            r#"
[[linkage]]
id = "a"
trace = ["M"]
[linkage.drawing]
joints = {{ O = [0, 0], C = [-1, 0], A = [0, 1], M = ["{m} / sqrt(2)", "1 + {m} / sqrt(2)"] }}
frame = ["O", "C"]
links = [["O", "A"], ["A", "M"]]
slides = {{ C = ["A", "M"] }}
input = "O A"
"#
        )
    };
    // The same bar joint by joint, by its own pivot, and as the block on the pin through which a bar at the pivot slides.
    let by_joints = |slot: &str, m: f64| {
        format!(
            r#"
[[linkage]]
id = "a"
trace = ["M"]
[linkage.joints]
O = {{ fixed = [0, 0] }}
C = {{ fixed = [-1, 0] }}
A = {{ crank = "O", length = 1 }}
B = {{ slot = {slot} }}
M = {{ point = ["A", "C"], along = {:?} }}
"#,
            -m
        )
    };
    for m in [0.5, 1.0, 2.0, 3.0] {
        for text in [drawn(m), by_joints("[\"A\", \"C\"]", m), by_joints("[\"C\", \"A\"]", m)] {
            let linkage = parse_templates(&text).unwrap().remove(0).linkage(&[]).unwrap();
            let motion = solve(&linkage);
            assert_eq!(motion.circuits.len(), 1);
            for point in motion.circuits[0].points(linkage.traced[0]) {
                let arm = point - Point::new(-1.0, 0.0);
                let square = arm.norm_squared();
                // (r^2 - 2 x)^2 = m^2 r^2, which the pivot, too, is on.
                let on_circle = square - 2.0 * arm.x;
                let residual = on_circle * on_circle - m * m * square;
                assert!(residual.abs() < 1e-11, "{m}: {point}, {residual:e}\n{text}");
            }
        }
    }
    // The conchoid of Nicomedes: from the pivot, at a distance of h / sin + d.
    for (h, d) in [(1.0, 0.5), (1.0, 1.0), (0.5, 2.0), (1.0, -1.5)] {
        let text = format!(
            r#"
[[linkage]]
id = "a"
trace = ["M"]
input = {{ from = -4, to = 4 }}
[linkage.drawing]
joints = {{ O = [0, 0], P = [0, {h}], Q = [1, {h}], A = [{h}, {h}], M = ["{h} + {d} / sqrt(2)", "{h} + {d} / sqrt(2)"] }}
frame = ["O", "P", "Q"]
links = [["A", "M"]]
slides = {{ A = ["P", "Q"], O = ["A", "M"] }}
input = {{ slider = "A" }}
"#
        );
        let linkage = parse_templates(&text).unwrap().remove(0).linkage(&[]).unwrap();
        let circuit = &solve(&linkage).circuits[0];
        for (i, point) in circuit.points(linkage.traced[0]).enumerate() {
            let bar = Vector::new(circuit.inputs[i], h);
            let expected = Point::origin() + bar * (1.0 + d / bar.norm());
            assert!((point - expected).norm() < 1e-12, "{h} {d}: {point} {expected}");
        }
    }
}
