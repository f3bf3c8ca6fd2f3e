//! Links that no dyads place: their poses, rates, limits and circuits, against the same linkages driven so that dyads do, and against
//! Newton's method.

use crate::drawings::random;
use coupler_curves::geometry::{Chebyshev, Point, trig};
use coupler_curves::linkage::{JointId, Linkage, SixBar};
use coupler_curves::linkage_format::parse_templates;
use coupler_curves::measure::{Measure, TracedCurve};
use coupler_curves::motion::{self, JointDerivatives, Motion, Sampler, Sampling};

/// Linkages of one degree of freedom: the number of joints, the frame and the other links by their joints.
struct Kind {
    name: &'static str,
    joints: usize,
    frame: &'static [usize],
    links: &'static [&'static [usize]],
    /// Links on the frame by which no dyads place the others, by pivot and joint.
    inputs: &'static [[usize; 2]],
    /// Angles between two links by which dyads do, or a link on the frame.
    others: &'static [&'static str],
}

const KINDS: [Kind; 5] = [
    Kind {
        name: "Stephenson II",
        joints: 7,
        frame: &[0, 1],
        links: &[&[0, 2], &[2, 3, 4], &[1, 5, 6], &[3, 5], &[4, 6]],
        inputs: &[[0, 2]],
        others: &["{ between = [\"J5 J3\", \"J3 J2\"] }", "{ between = [\"J3 J5\", \"J5 J1\"] }"],
    },
    Kind {
        name: "Stephenson III",
        joints: 7,
        frame: &[0, 1, 2],
        links: &[&[0, 3], &[3, 4], &[1, 5], &[2, 6], &[4, 5, 6]],
        inputs: &[[0, 3]],
        others: &["\"J1 J5\"", "\"J2 J6\""],
    },
    Kind {
        name: "Stephenson I",
        joints: 7,
        frame: &[0, 1],
        links: &[&[0, 2, 3], &[1, 4, 5], &[3, 6], &[6, 5], &[2, 4]],
        inputs: &[],
        others: &["\"J0 J2\""],
    },
    Kind {
        name: "eight-bar of two ternary and two quaternary links",
        joints: 10,
        frame: &[0, 1, 2],
        links: &[&[0, 3], &[3, 4, 5, 6], &[1, 7], &[7, 4], &[2, 8, 9], &[8, 5], &[9, 6]],
        inputs: &[[0, 3]],
        others: &["{ between = [\"J8 J5\", \"J5 J3\"] }"],
    },
    Kind {
        name: "eight-bar with a four-bar and a triad",
        joints: 10,
        frame: &[0, 1, 2],
        links: &[&[0, 3], &[3, 4, 5], &[1, 4, 6], &[5, 7], &[6, 8], &[2, 9], &[7, 8, 9]],
        inputs: &[[0, 3], [1, 4]],
        others: &[],
    },
];

/// A drawing with random coordinates.
struct Drawing {
    positions: Vec<Point>,
    kind: &'static Kind,
}

impl Drawing {
    fn random(kind: &'static Kind, numbers: &mut u64) -> Drawing {
        let positions = (0..kind.joints).map(|_| Point::new(4.0 * random(numbers), 4.0 * random(numbers)));
        Drawing { positions: positions.collect(), kind }
    }

    fn linkage(&self, input: &str, circuits: &str) -> Linkage {
        let list = |joints: &[usize]| {
            let names: Vec<String> = joints.iter().map(|joint| format!("\"J{joint}\"")).collect();
            format!("[{}]", names.join(", "))
        };
        let joints = self.positions.iter().enumerate().map(|(k, at)| format!("J{k} = [{}, {}]", at.x, at.y));
        let links: Vec<String> = self.kind.links.iter().map(|link| list(link)).collect();
        let moving: Vec<usize> = (0..self.kind.joints).filter(|joint| !self.kind.frame.contains(joint)).collect();
        let text = format!(
            "[[linkage]]\nid = \"a\"\ncircuits = \"{circuits}\"\ntrace = {}\n[linkage.drawing]\njoints = {{ {} }}\nframe = {}\nlinks = [{}]\ninput = {input}\n",
            list(&moving),
            joints.collect::<Vec<String>>().join(", "),
            list(self.kind.frame),
            links.join(", ")
        );
        let template = parse_templates(&text).unwrap_or_else(|problems| panic!("{text}: {problems:?}")).remove(0);
        template.linkage(&[]).unwrap()
    }

    /// How far the lengths of links are missed at any sample, and how far from the drawing the nearest sample is.
    fn errors(&self, linkage: &Linkage, motion: &Motion) -> [f64; 2] {
        let joints: Vec<_> = (0..self.kind.joints).map(|k| linkage.find_joint(&format!("J{k}")).unwrap()).collect();
        let (mut worst, mut nearest) = (0.0f64, f64::INFINITY);
        for circuit in &motion.circuits {
            for sample in 0..circuit.len() {
                let at = |joint: usize| circuit.positions.point(joints[joint], sample);
                for link in self.kind.links.iter().chain([&self.kind.frame]) {
                    for (k, &a) in link.iter().enumerate() {
                        for &b in &link[k + 1..] {
                            let drawn = (self.positions[a] - self.positions[b]).norm();
                            worst = worst.max(((at(a) - at(b)).norm() - drawn).abs());
                        }
                    }
                }
                let distance = (0..joints.len()).map(|k| (at(k) - self.positions[k]).norm()).fold(0.0, f64::max);
                nearest = nearest.min(distance);
            }
        }
        [worst, nearest]
    }
}

fn crank(input: [usize; 2]) -> String {
    format!("\"J{} J{}\"", input[0], input[1])
}

fn solve(linkage: &Linkage) -> Motion {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(90)))
}

/// The areas within the curves of a circuit, and their first moments, with the sign of the area.
fn areas(linkage: &Linkage, motion: &Motion, circuit: usize) -> Vec<f64> {
    let pieces = motion.circuits[circuit].pieces(linkage);
    let of_joint = |&joint: &_| {
        let mut sums = [0.0; 3];
        for piece in 0..pieces.len() {
            let [x, y] = pieces.series(piece, joint);
            // In halves, products have the terms that a series has.
            for (x, y) in x.halves().iter().zip(&y.halves()) {
                let (vy, vx) = (y.derivative().values(), x.derivative().values());
                let (x, y) = (x.values(), y.values());
                let integral = |of: &dyn Fn(usize) -> f64| Chebyshev::from_values(&std::array::from_fn(of)).total();
                sums[0] += integral(&|k| x[k] * vy[k]);
                sums[1] += integral(&|k| x[k] * x[k] * vy[k] / 2.0);
                sums[2] -= integral(&|k| y[k] * y[k] * vx[k] / 2.0);
            }
        }
        let sign = if sums[0].abs() > 1e-6 { sums[0].signum() } else { 0.0 };
        sums.map(|sum| sum * sign)
    };
    linkage.traced.iter().flat_map(of_joint).collect()
}

fn are_equal(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9 * (1.0 + a.abs()))
}

/// Whatever drives a linkage, its circuit is the same: curves by a group and by dyads have the same areas.
#[test]
fn a_circuit_is_that_of_the_same_linkage_driven_elsewhere() {
    let mut numbers = 7u64;
    let mut compared = 0;
    for kind in &KINDS {
        for _ in 0..4 {
            let drawing = Drawing::random(kind, &mut numbers);
            for &input in kind.inputs {
                let linkage = drawing.linkage(&crank(input), "start");
                assert!(linkage.group.is_some(), "{}", kind.name);
                let motion = solve(&linkage);
                assert!(motion.is_assembled(), "{}: {:?}", kind.name, motion.assembly_error);
                let [worst, _] = drawing.errors(&linkage, &motion);
                assert!(worst < 1e-11, "{}: {worst:e}", kind.name);
                for other in kind.others {
                    let other = drawing.linkage(other, "start");
                    assert!(other.group.is_none(), "{}", kind.name);
                    let by_dyads = solve(&other);
                    let expected = areas(&other, &by_dyads, 0);
                    let found = areas(&linkage, &motion, 0);
                    assert!(are_equal(&found, &expected), "{}: {found:?} {expected:?}", kind.name);
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 20);
}

/// All circuits of a linkage, whatever drives it.
#[test]
fn all_circuits_are_found() {
    let mut numbers = 11u64;
    let mut counts = Vec::new();
    for kind in &KINDS[..4] {
        for _ in 0..3 {
            let drawing = Drawing::random(kind, &mut numbers);
            for &input in kind.inputs {
                let linkage = drawing.linkage(&crank(input), "all");
                let other = drawing.linkage(kind.others[0], "all");
                let sorted = |linkage: &Linkage| {
                    let motion = solve(linkage);
                    assert!(motion.is_assembled(), "{}: {:?}", kind.name, motion.assembly_error);
                    let circuits = 0..motion.circuits.len();
                    let mut all: Vec<Vec<f64>> = circuits.map(|circuit| areas(linkage, &motion, circuit)).collect();
                    all.sort_by(|a, b| a.iter().sum::<f64>().total_cmp(&b.iter().sum()));
                    all
                };
                let (found, expected) = (sorted(&linkage), sorted(&other));
                assert_eq!(found.len(), expected.len(), "{}", kind.name);
                assert!(found.iter().zip(&expected).all(|(a, b)| are_equal(a, b)), "{}", kind.name);
                counts.push(found.len());
            }
        }
    }
    assert!(counts.iter().any(|count| *count > 2), "{counts:?}");
}

/// By continuation from a system with known solutions, all poses at the start are found: all circuits that pass that input.
#[test]
fn all_circuits_at_the_start_are_found_without_another_input() {
    let mut numbers = 23u64;
    let mut counts = Vec::new();
    for kind in &KINDS {
        for _ in 0..2 {
            let drawing = Drawing::random(kind, &mut numbers);
            for &input in kind.inputs {
                let mut linkage = drawing.linkage(&crank(input), "all");
                let start = linkage.motion_options.start.unwrap();
                let at_start = |motion: &Motion| {
                    let passes = motion.circuits.iter().flat_map(|circuit| &circuit.passes);
                    let is_there = |pass: &&motion::Pass| {
                        let [low, high] = pass.input_range();
                        low + (start - low).rem_euclid(360.0) <= high
                    };
                    passes.filter(is_there).count()
                };
                let other = linkage.driven_elsewhere.take();
                let motion = solve(&linkage);
                assert!(motion.is_assembled(), "{}: {:?}", kind.name, motion.assembly_error);
                let [worst, _] = drawing.errors(&linkage, &motion);
                assert!(worst < 1e-11, "{}: {worst:e}", kind.name);
                // Modes are added and lost in pairs.
                let modes = at_start(&motion);
                assert!(modes.is_multiple_of(2), "{}: {modes}", kind.name);
                assert!(kind.links.len() > 5 || modes <= 6, "{}: {modes}", kind.name);
                counts.push(modes);
                if other.is_some() {
                    linkage.driven_elsewhere = other;
                    assert_eq!(at_start(&solve(&linkage)), modes, "{}", kind.name);
                }
            }
        }
    }
    assert!(counts.iter().any(|count| *count >= 4), "{counts:?}");
}

/// Velocity, acceleration and jerk are the derivatives of positions, by differences of eighth order.
#[test]
fn rates_are_the_derivatives_of_poses() {
    /// Of the first derivative, for values on one side.
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    const STEP: f64 = 0.004;
    let mut numbers = 3u64;
    let mut checked = 0;
    for kind in &KINDS {
        for &input in kind.inputs {
            let drawing = Drawing::random(kind, &mut numbers);
            let linkage = drawing.linkage(&crank(input), "start");
            let motion = solve(&linkage);
            let pass = &motion.circuits[0].passes[0];
            let [low, high] = pass.input_range();
            for share in [0.3, 0.5, 0.8] {
                let at = low + (high - low) * share;
                let exact = |by: f64| JointDerivatives::on_pass(&linkage, pass, at + trig::degrees(by));
                let rates = exact(0.0);
                for joint in linkage.joint_ids() {
                    let difference = |of: &dyn Fn(&JointDerivatives) -> coupler_curves::geometry::Vector| {
                        let pair = |k: usize| {
                            let by = STEP * (k + 1) as f64 / 4.0;
                            (of(&exact(by)) - of(&exact(-by))) * WEIGHTS[k]
                        };
                        (pair(0) + pair(1) + pair(2) + pair(3)) / (STEP / 4.0)
                    };
                    let expected = [
                        difference(&|rates| rates.position(joint).coords),
                        difference(&|rates| rates.velocity(joint)),
                        difference(&|rates| rates.acceleration(joint)),
                    ];
                    let found = [rates.velocity(joint), rates.acceleration(joint), rates.jerk(joint)];
                    for (found, expected) in found.iter().zip(&expected) {
                        // Next to a limit differences have fewer digits.
                        if expected.norm() < 1e3 {
                            assert!(
                                (found - expected).norm() < 1e-6 * (1.0 + expected.norm()),
                                "{}: {found} {expected} at {at} of {low} to {high}",
                                kind.name
                            );
                            checked += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(checked > 200, "{checked}");
}

/// On a range of the input the motion is that part of the circuit, and ends there.
#[test]
fn a_range_is_a_part_of_the_circuit() {
    let drawing = Drawing::random(&KINDS[1], &mut 5u64);
    let mut linkage = drawing.linkage("\"J0 J3\"", "start");
    let whole = solve(&linkage);
    let start = linkage.motion_options.start.unwrap();
    let [from, to] = [start - 2.0, start + 3.0];
    linkage.motion_options.range = Some([from, to]);
    let part = solve(&linkage);
    assert_eq!(part.assembly_error, None);
    let [circuit] = &part.circuits[..] else { panic!("{} circuits", part.circuits.len()) };
    assert!(!circuit.is_closed);
    let ends = [circuit.inputs[0], circuit.inputs[circuit.len() - 1]];
    assert_eq!([ends[0].min(ends[1]), ends[0].max(ends[1])], [from, to]);
    let pose_at_start = motion::pose(&linkage, &circuit.passes[0], start);
    let is_drawn = |k: usize| {
        (pose_at_start[linkage.find_joint(&format!("J{k}")).unwrap().index()] - drawing.positions[k]).norm() < 1e-11
    };
    assert!((0..drawing.kind.joints).all(is_drawn));
    assert!(whole.circuits[0].len() >= circuit.len());
}

/// The kinds of six-bars are recognised, though no dyads place them.
#[test]
fn six_bars_are_named() {
    let mut numbers = 1u64;
    for (kind, expected) in [(&KINDS[0], SixBar::StephensonII), (&KINDS[1], SixBar::StephensonIII)] {
        let linkage = Drawing::random(kind, &mut numbers).linkage(&crank(kind.inputs[0]), "start");
        let chain = coupler_curves::linkage::KinematicChain::from_linkage(&linkage).unwrap();
        assert_eq!(chain.six_bar(), Some(expected));
    }
}

/// A linkage by the text of its drawing.
fn drawn(drawing: &str) -> Linkage {
    let text = format!("[[linkage]]\nid = \"a\"\ntrace = [\"D\"]\n[linkage.drawing]\n{drawing}");
    parse_templates(&text).unwrap_or_else(|problems| panic!("{problems:?}")).remove(0).linkage(&[]).unwrap()
}

/// A four-bar that is all but a parallelogram, driven at its coupler: where it is flat, the other circuit is a millionth of its size away, and steps that
/// are not proven leave for it.
#[test]
fn no_step_leaves_for_a_circuit_that_is_near() {
    for difference in [1e-6, -1e-6, 1e-9] {
        let drawing = |input: &str| {
            drawn(&format!(
                "joints = {{ O = [2, -3], P = [0, 0], Q = [4, 0], A = [2, -2], E = [0.8, 0.6], F = [{}, 0.6], D = [2.5, 1] }}\n\
                 frame = [\"O\", \"P\", \"Q\"]\n\
                 links = [[\"O\", \"A\"], [\"A\", \"D\"], [\"P\", \"E\"], [\"Q\", \"F\"], [\"D\", \"E\", \"F\"]]\n\
                 input = \"{input}\"\n",
                4.8 + difference
            ))
        };
        let (by_crank, by_dyads) = (drawing("O A"), drawing("P E"));
        assert!(by_crank.group.is_some() && by_dyads.group.is_none());
        let (found, expected) = (solve(&by_crank), solve(&by_dyads));
        let [a, b] = [(&by_crank, &found), (&by_dyads, &expected)].map(|(linkage, motion)| areas(linkage, motion, 0));
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-6), "{difference:e}: {a:?} {b:?}");
    }
}

/// Through a change point the motion goes on smoothly, as it does by dyads: a parallelogram where it is flat, driven at its coupler, and an antiparallelogram.
#[test]
fn change_points_are_passed() {
    for (e, f) in [([0.8, 0.6], [4.8, 0.6]), ([0.8, 0.6], [4.528301886792453, -0.8490566037735848])] {
        let drawing = |input: &str| {
            drawn(&format!(
                "joints = {{ O = [2, -3], P = [0, 0], Q = [4, 0], A = [2, -2], E = {e:?}, F = {f:?}, D = [2.5, 1] }}\n\
                 frame = [\"O\", \"P\", \"Q\"]\n\
                 links = [[\"O\", \"A\"], [\"A\", \"D\"], [\"P\", \"E\"], [\"Q\", \"F\"], [\"D\", \"E\", \"F\"]]\n\
                 input = \"{input}\"\n"
            ))
        };
        let (by_crank, by_dyads) = (drawing("O A"), drawing("P E"));
        let (found, expected) = (solve(&by_crank), solve(&by_dyads));
        assert!(found.is_assembled(), "{:?}", found.assembly_error);
        let circuit = &found.circuits[0];
        let changes: Vec<_> = (0..circuit.passes.len()).filter(|&k| !circuit.reverses_after(k)).collect();
        assert!(!changes.is_empty());
        // The rates there are those of both passes.
        for k in changes {
            let (pass, next) = (&circuit.passes[k], &circuit.passes[(k + 1) % circuit.passes.len()]);
            let at = |pass: &motion::Pass, input: f64| JointDerivatives::on_pass(&by_crank, pass, input);
            let (before, after) = (at(pass, pass.to.input.value), at(next, next.from.input.value));
            for joint in by_crank.joint_ids() {
                let apart = (before.position(joint) - after.position(joint)).norm();
                assert!(apart < 1e-9, "{apart:e}");
                let (v, w) = (before.velocity(joint), after.velocity(joint));
                assert!((v - w).norm() < 1e-6 * (1.0 + v.norm()), "{v} {w}");
                let (v, w) = (before.acceleration(joint), after.acceleration(joint));
                assert!((v - w).norm() < 1e-5 * (1.0 + v.norm()), "{v} {w}");
            }
        }
        let [a, b] = [(&by_crank, &found), (&by_dyads, &expected)].map(|(linkage, motion)| areas(linkage, motion, 0));
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
    }
}

/// What does not close, does not move, or moves in more than one way is said.
#[test]
fn what_is_wrong_with_a_group_is_said() {
    const TRIAD: &str = "joints = { O = [0, 0], P = [3, -1], Q = [4.5, 0.5], A = [0.3, 0.4], D = [1.6, 1.8], E = [2.7, 1.1], F = [3.4, 2.3] }\n\
        frame = [\"O\", \"P\", \"Q\"]\n\
        links = [[\"O\", \"A\"], [\"A\", \"D\"], [\"P\", \"E\"], [\"Q\", \"F\"], [\"D\", \"E\", \"F\"]]\n\
        input = \"O A\"\n";
    let error =
        |drawing: &str| solve(&drawn(drawing)).assembly_error.map(|error| error.to_string()).unwrap_or_default();
    assert_eq!(error(TRIAD), "");
    // Lengths that are nearly those of the drawing are closed by Newton's method.
    assert_eq!(error(&format!("{TRIAD}lengths = {{ \"A D\" = 2 }}\n")), "");
    let linkage = drawn(&format!("{TRIAD}lengths = {{ \"A D\" = 2, \"D F\" = 1.8 }}\n"));
    let motion = solve(&linkage);
    let at = |name: &str| motion.circuits[0].positions.point(linkage.find_joint(name).unwrap(), 10);
    assert!(((at("A") - at("D")).norm() - 2.0).abs() < 1e-12 && ((at("D") - at("F")).norm() - 1.8).abs() < 1e-12);
    let open = error(&format!("{TRIAD}lengths = {{ \"A D\" = 9 }}\n"));
    assert!(open.contains("do not close at the start") && open.contains("a length misses by"), "{open}");
    // A parallelogram that is drawn where it is flat moves in two ways from there.
    let flat = "joints = { O = [2, -3], P = [0, 0], Q = [4, 0], A = [2, -2], E = [1, 0], F = [5, 0], D = [2.5, 1] }\n\
        frame = [\"O\", \"P\", \"Q\"]\n\
        links = [[\"O\", \"A\"], [\"A\", \"D\"], [\"P\", \"E\"], [\"Q\", \"F\"], [\"D\", \"E\", \"F\"]]\n\
        input = \"O A\"\n";
    let crossing = error(flat);
    assert!(crossing.contains("its links can move in more than one way"), "{crossing}");
    // The driven link slides on a line of the frame through its pivot, and cannot turn.
    let held = "joints = { O = [2, 4], B = [-2, -4], Q = [2, -1], A = [3, 3], D = [-2, 1.5], E = [0, -1], S = [1, 0.5] }\n\
        frame = [\"O\", \"B\", \"Q\"]\n\
        links = [[\"A\", \"D\", \"O\"], [\"S\", \"Q\"], [\"E\", \"Q\"]]\n\
        slides = { E = [\"D\", \"A\"], S = [\"Q\", \"O\"] }\n\
        input = { between = [\"B Q\", \"Q S\"] }\n";
    let stuck = error(held);
    assert!(stuck.contains("its input cannot move: S is held in place"), "{stuck}");
}

/// Any two links and any two joints may be driven, whether the links have a joint in common or not: the circuit is the same.
#[test]
fn links_without_a_common_joint_are_driven() {
    let drawing = |input: &str| {
        drawn(&format!(
            "joints = {{ O = [0, 0], C = [4, 0], Q = [7, 1], A = [0.6, 0.8], B = [3.4, 2.6], D = [2.5, 3.4], E = [5, 4], M = [1.2, -0.3], N = [4, 5] }}\n\
             frame = [\"O\", \"C\", \"Q\"]\n\
             links = [[\"O\", \"A\", \"M\"], [\"A\", \"B\", \"D\"], [\"B\", \"C\"], [\"D\", \"E\", \"N\"], [\"E\", \"Q\"]]\n\
             input = {input}\n"
        ))
    };
    let by_crank = drawing("\"O A\"");
    let expected = areas(&by_crank, &solve(&by_crank), 0);
    for input in [
        "{ between = [\"O A\", \"C B\"] }",
        "{ between = [\"A B\", \"Q E\"] }",
        "{ between = [\"C O\", \"D E\"] }",
        "{ distance = [\"O\", \"D\"] }",
        "{ distance = [\"A\", \"E\"] }",
        "{ distance = [\"B\", \"Q\"] }",
        "{ distance = [\"C\", \"E\"] }",
        "{ distance = [\"M\", \"E\"] }",
        "{ distance = [\"N\", \"M\"] }",
    ] {
        let linkage = drawing(input);
        // M is on no link that has a joint in common with one of E or N.
        assert_eq!(linkage.driven_distance().is_some(), input.contains("distance") && input.contains('M'), "{input}");
        let motion = solve(&linkage);
        assert!(motion.is_assembled(), "{input}: {:?}", motion.assembly_error);
        assert!(are_equal(&areas(&linkage, &motion, 0), &expected), "{input}");
        // The input is what it says, at every sample.
        let circuit = &motion.circuits[0];
        let names: Vec<&str> = input.split('"').skip(1).step_by(2).collect();
        for sample in 0..circuit.len() {
            let at = |name: &str| circuit.positions.point(linkage.find_joint(name).unwrap(), sample);
            let own = match names[..] {
                [a, b] if a.len() == 1 => (at(b) - at(a)).norm(),
                [first, second] => {
                    let line = |names: &str| at(&names[2..]) - at(&names[..1]);
                    let (u, v) = (line(first), line(second));
                    trig::degrees(trig::atan2(u.x * v.y - u.y * v.x, u.dot(&v)))
                }
                _ => panic!("{names:?}"),
            };
            let off = own - circuit.inputs[sample];
            let off = if input.contains("between") { off - 360.0 * (off / 360.0).round() } else { off };
            assert!(off.abs() < 1e-9, "{input}: {off:e}");
        }
    }
}

/// A distance that drives a drawing is its only input, and nothing is geared to it.
#[test]
fn a_second_input_beside_a_driven_distance_is_named() {
    for (joint, words) in [
        ("{ crank = \"C\", length = 1 }", "a second input in addition to the distance that drives the drawing"),
        ("{ gear = \"A\", about = \"C\", length = 1, ratio = [1, 2] }", "which is not a crank"),
    ] {
        let text = format!(
            "[[linkage]]\nid = \"a\"\ntrace = [\"B\", \"X\"]\n[linkage.drawing]\n\
             joints = {{ O = [0, 0], C = [4, 0], Q = [7, 1], A = [0.6, 0.8], B = [3.4, 2.6], D = [2.5, 3.4], E = [5, 4], M = [1.2, -0.3] }}\n\
             frame = [\"O\", \"C\", \"Q\"]\n\
             links = [[\"O\", \"A\", \"M\"], [\"A\", \"B\", \"D\"], [\"B\", \"C\"], [\"D\", \"E\"], [\"E\", \"Q\"]]\n\
             input = {{ distance = [\"M\", \"E\"] }}\n[linkage.joints]\nX = {joint}\n"
        );
        let problems = parse_templates(&text).expect_err(joint);
        assert!(problems.iter().any(|problem| problem.message.contains(words)), "{problems:?}");
    }
}

/// The joints of a group's loops and of its output are kept where a computation leaves out other points.
#[test]
fn points_that_close_loops_are_kept() {
    let linkage = drawn(
        "joints = { O = [0, 0], P = [3, -1], Q = [5, 0], R = [6, 1], A = [0.3, 0.4], D = [1.6, 1.8], E = [2.7, 1.1], F = [3.8, 1.5] }\n\
         frame = [\"O\", \"P\", \"Q\", \"R\"]\n\
         links = [[\"O\", \"A\"], [\"A\", \"D\"], [\"P\", \"E\"], [\"D\", \"E\", \"F\"]]\n\
         slides = { F = [\"Q\", \"R\"] }\n\
         input = \"O A\"\n",
    );
    let last = JointId::new(linkage.joints.len() - 1);
    assert_eq!(linkage.joints[last].name, "F");
    let (single, _) = linkage.with_one_point(linkage.traced[0]);
    assert_eq!(single.output(), linkage.output());
    assert_eq!(single.slider_line(last), linkage.slider_line(last));
    let motion = solve(&linkage);
    let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
    let value = |name: &str| Measure::find(name).map(|measure| (measure.compute)(&curve));
    assert!(value("time_ratio").is_some() && value("output_stroke").is_some());
}
