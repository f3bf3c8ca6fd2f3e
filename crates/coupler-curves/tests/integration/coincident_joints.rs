//! Joints that coincide at some input, from which another joint is placed: it is in the limit of its positions, and its path is
//! continuous.

use coupler_curves::geometry::{Orientation, Point, Vector, left_normal, trig};
use coupler_curves::linkage::{CircuitSelection, Continuation, JointId, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::measure::{ALL, TracedCurve, Value, compute_all};
use coupler_curves::motion::{Circuit, JointDerivatives, Motion, Sampler, Sampling};

/// The unit vector at an angle in degrees.
fn unit(deg: f64) -> Vector {
    let (cos, sin) = trig::cos_sin_deg(deg);
    Vector::new(cos, sin)
}

/// Two cranks of length 1 on one pivot, the second at `turns` times the angle of the first plus a phase.
struct TwoCranks {
    turns: f64,
    phase_deg: f64,
}

impl TwoCranks {
    fn builder(&self) -> (LinkageBuilder, [JointId; 2]) {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let a = builder.crank("A", o, 1.0).unwrap();
        let g = builder.gear("G", (o, 1.0), [self.turns, 1.0], self.phase_deg).unwrap();
        (builder, [a, g])
    }

    /// The angle of the bisector of the cranks and half the angle between them, in degrees: the pins are
    /// `cos(half) u -+ sin(half) n` with `u` the unit vector of the bisector and `n` its left normal.
    fn angles(&self, deg: f64) -> [f64; 2] {
        [((self.turns + 1.0) * deg + self.phase_deg) / 2.0, ((self.turns - 1.0) * deg + self.phase_deg) / 2.0]
    }

    /// A linkage with the pin of two equal links on the pins of the cranks.
    fn rhombus(&self, length: f64, options: MotionOptions) -> Linkage {
        let (mut builder, pins) = self.builder();
        let h = builder.dyad("H", pins, [length; 2], Side::Left).unwrap();
        builder.build(vec![h], None, options).unwrap()
    }

    /// Where that pin is, on one side or the other of the pivot, and its velocity per radian.
    fn rhombus_pin(&self, length: f64, deg: f64, side: f64) -> [Vector; 2] {
        let [bisector, half] = self.angles(deg);
        let [rate, half_rate] = [(self.turns + 1.0) / 2.0, (self.turns - 1.0) / 2.0];
        let (cos, sin) = trig::cos_sin_deg(half);
        let height = side * (length * length - sin * sin).sqrt();
        let radial = cos + height;
        let radial_rate = -sin * half_rate - sin * cos * half_rate / height;
        let u = unit(bisector);
        [u * radial, u * radial_rate + left_normal(u) * (radial * rate)]
    }
}

/// Phases at which the cranks coincide at input 0, at a sample, between samples, and nearly at one.
const PHASES: [f64; 6] = [0.0, -36.0, -37.3, 180.0, 1e-10, -36.000000001];

fn solve(linkage: &Linkage, sampling: Sampling) -> Motion {
    let motion = Motion::solve(linkage, &Sampler::new(sampling));
    assert!(motion.assembly_error.is_none(), "{:?}", motion.assembly_error);
    motion
}

/// The sides, 1 or -1, on which each sample of a joint is at one of two positions.
fn sides(circuit: &Circuit, joint: JointId, tolerance: f64, expected: impl Fn(f64, f64) -> Vector) -> Vec<f64> {
    let side_at = |i: usize| {
        let place = circuit.positions.point(joint, i).coords;
        let [left, right] = [1.0, -1.0].map(|side| (place - expected(circuit.inputs[i], side)).norm());
        assert!(left.min(right) <= tolerance, "at {}: {place} {left} {right}", circuit.inputs[i]);
        if left < right { 1.0 } else { -1.0 }
    };
    (0..circuit.len()).map(side_at).collect()
}

#[test]
fn a_rhombus_passes_its_folded_pose_as_its_closed_form_says() {
    for turns in [2.0, -2.0, 5.0] {
        for phase_deg in PHASES {
            let cranks = TwoCranks { turns, phase_deg };
            for continuation in [Continuation::Smooth, Continuation::Branch] {
                let linkage = cranks.rhombus(1.5, MotionOptions { continuation, ..MotionOptions::default() });
                let h = linkage.traced[0];
                for sampling in [Sampling::Step(2.0), Sampling::Samples(1000), Sampling::ArcLength(300)] {
                    let motion = solve(&linkage, sampling);
                    let [circuit] = &motion.circuits[..] else { panic!("{} circuits", motion.circuits.len()) };
                    // A turn reverses the bisector where the number of turns is even.
                    let length = circuit.passes.iter().map(|pass| pass.input_length()).sum::<f64>();
                    assert_eq!(length.round(), if turns % 2.0 == 0.0 { 720.0 } else { 360.0 });
                    let sides = sides(circuit, h, 1e-11, |deg, side| cranks.rhombus_pin(1.5, deg, side)[0]);
                    assert!(sides.iter().all(|side| *side == sides[0]), "{turns} {phase_deg}: {sides:?}");
                    for (i, side) in sides.iter().enumerate() {
                        let [place, velocity] = cranks.rhombus_pin(1.5, circuit.inputs[i], *side);
                        let jets = circuit.derivatives(&linkage, i);
                        let error = (jets.velocity(h) - velocity).norm();
                        let distance = trig::cos_sin_deg(cranks.angles(circuit.inputs[i])[1]).1.abs();
                        // Next to the folded pose the base is short, and its direction has lost digits.
                        let allowed = if distance == 0.0 || distance > 1e-6 { 1e-9 / distance.max(1e-2) } else { 10.0 };
                        assert!(error <= allowed, "{turns} {phase_deg} at {}: {error}", circuit.inputs[i]);
                        assert!((jets.position(h).coords - place).norm() <= 1e-6);
                    }
                }
            }
        }
    }
}

/// Short links close near the folded pose only: on both sides of it, and from one limit to the other and back.
#[test]
fn a_rocking_rhombus_passes_its_folded_pose() {
    for phase_deg in PHASES {
        let cranks = TwoCranks { turns: 2.0, phase_deg };
        let linkage = cranks.rhombus(0.6, MotionOptions::default());
        let motion = solve(&linkage, Sampling::Step(0.5));
        let [circuit] = &motion.circuits[..] else { panic!("{} circuits", motion.circuits.len()) };
        let sides = sides(circuit, linkage.traced[0], 1e-7, |deg, side| {
            let [bisector, half] = cranks.angles(deg);
            let (cos, sin) = trig::cos_sin_deg(half);
            unit(bisector) * (cos + side * (0.36 - sin * sin).max(0.0).sqrt())
        });
        let changes = (1..sides.len()).filter(|&i| sides[i] != sides[i - 1]).count();
        assert!(circuit.is_closed && changes <= 2, "{phase_deg}: {changes}");
        assert!(sides.contains(&1.0) && sides.contains(&-1.0));
    }
}

#[test]
fn a_range_that_ends_in_the_folded_pose_has_its_limit() {
    for (turns, phase_deg) in [(2.0, -36.0), (2.0, -37.3), (2.0, 0.0), (4.0, -36.0)] {
        let cranks = TwoCranks { turns, phase_deg };
        let at = -phase_deg / (turns - 1.0);
        for range in [[at - 30.0, at], [at, at + 30.0], [at - 20.0, at + 20.0]] {
            let linkage = cranks.rhombus(1.5, MotionOptions { range: Some(range), ..MotionOptions::default() });
            let motion = solve(&linkage, Sampling::Step(2.0));
            let circuit = &motion.circuits[0];
            assert_eq!([circuit.inputs[0], circuit.inputs[circuit.len() - 1]], range);
            let expected = |deg, side| cranks.rhombus_pin(1.5, deg, side)[0];
            let sides = sides(circuit, linkage.traced[0], 1e-9, expected);
            assert!(sides.iter().all(|side| *side == sides[0]), "{range:?}: {sides:?}");
            for i in [0, circuit.len() - 1] {
                let velocity = cranks.rhombus_pin(1.5, circuit.inputs[i], sides[0])[1];
                let found = circuit.derivatives(&linkage, i).velocity(linkage.traced[0]);
                assert!((found - velocity).norm() < 1e-8, "{range:?}: {found} {velocity}");
            }
        }
    }
}

/// A base that vanishes with its first derivative points to the same side before and after.
#[test]
fn a_base_that_vanishes_twice_keeps_the_side_of_its_pin() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let q = builder.fixed("Q", Point::new(1.0, 0.0));
    let a = builder.crank("A", o, 1.0).unwrap();
    let y = builder.yoke("Y", a, ([o, q], 0.0), 90.0).unwrap();
    let h = builder.dyad("H", [y, q], [1.5, 1.5], Side::Left).unwrap();
    let linkage = builder.build(vec![h], None, MotionOptions::default()).unwrap();
    for sampling in [Sampling::Step(2.0), Sampling::Step(0.37), Sampling::Samples(4001)] {
        let motion = solve(&linkage, sampling);
        let circuit = &motion.circuits[0];
        assert!(circuit.is_full_turn());
        let sides = sides(circuit, h, 1e-10, |deg, side| {
            let half = (1.0 - trig::cos_sin_deg(deg).0) / 2.0;
            Vector::new(1.0 - half, side * (2.25 - half * half).sqrt())
        });
        assert!(sides.iter().all(|side| *side == 1.0), "{sides:?}");
        assert!((0..circuit.len()).all(|i| !circuit.is_corner(i)));
        let jets = circuit.derivatives(&linkage, 0);
        // x = (1 + cos) / 2, and the height is at its greatest.
        assert!((jets.velocity(h)).norm() < 1e-12 && (jets.acceleration(h) - Vector::new(-0.5, 0.0)).norm() < 1e-12);
    }
}

/// The pin of a crank as long as the frame passes the pivot of the line that slides through it: the line turns half as fast as the
/// crank.
#[test]
fn a_line_turns_on_as_its_pin_passes_its_pivot() {
    for pivot_deg in [0.0, 36.0, 37.3, 180.0, -1e-10] {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", Point::from(unit(pivot_deg)));
        let a = builder.crank("A", o, 1.0).unwrap();
        builder.slot("B", [c, a], 0.0, Side::Right).unwrap();
        let p = builder.point("P", [c, a], 2.0, 1.0).unwrap();
        let linkage = builder.build(vec![p], None, MotionOptions::default()).unwrap();
        let motion = solve(&linkage, Sampling::Step(2.0));
        let circuit = &motion.circuits[0];
        let expected = |deg: f64, side: f64| {
            let line = left_normal(unit((deg + pivot_deg) / 2.0)) * side;
            unit(pivot_deg) + line * 2.0 + left_normal(line)
        };
        let sides = sides(circuit, p, 1e-9, expected);
        assert!(sides.iter().all(|side| *side == sides[0]), "{pivot_deg}: {sides:?}");
        assert_eq!(circuit.passes.iter().map(|pass| pass.input_length()).sum::<f64>().round(), 720.0);
    }
}

/// A slider on the line through two joints that pass each other: through them the line turns on.
#[test]
fn a_slider_moves_on_where_the_joints_of_its_line_coincide() {
    let from = Vector::new(0.2, 0.1);
    for phase_deg in PHASES {
        let cranks = TwoCranks { turns: 2.0, phase_deg };
        let linkage = |offset: f64| {
            let (mut builder, pins) = cranks.builder();
            let k = builder.fixed("K", Point::from(from));
            let f = builder.slide("F", (k, 3.0), (pins, offset), Side::Left).unwrap();
            builder.build(vec![f], None, MotionOptions::default()).unwrap()
        };
        let centred = linkage(0.0);
        let motion = solve(&centred, Sampling::Step(2.0));
        let circuit = &motion.circuits[0];
        let sides = sides(circuit, centred.traced[0], 1e-9, |deg, side| {
            // The line is perpendicular to the bisector.
            let [bisector, half] = cranks.angles(deg);
            let across = unit(bisector) * (trig::cos_sin_deg(half).0 - unit(bisector).dot(&from));
            from + across + left_normal(unit(bisector)) * (side * (9.0 - across.norm_squared()).sqrt())
        });
        assert!(sides.iter().all(|side| *side == sides[0]), "{phase_deg}: {sides:?}");
        assert_eq!(circuit.passes.iter().map(|pass| pass.input_length()).sum::<f64>().round(), 720.0);
        // Its link is never at right angles to the line.
        assert!(circuit.passes.iter().any(|pass| !pass.to.flat_dyads.is_empty()));
        assert!(circuit.passes.iter().all(|pass| pass.to.flat_joints(&centred).is_empty()));
        // A line beside the two joints would be on their other side afterwards.
        let motion = Motion::solve(&linkage(0.5), &Sampler::new(Sampling::Step(2.0)));
        let message = motion.assembly_error.unwrap().to_string();
        assert!(message.contains("A and G coincide there, and F would jump"), "{message}");
        assert!(!motion.circuits[0].is_closed);
    }
}

/// The joints of an eight-bar with a rhombus, whose pin H is at one point at the change point of its four-bar from either side.
fn eight_bar(layout: Orientation, scale: f64, frame_deg: f64, continuation: Continuation) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let q2 = builder.fixed("Q2", Point::origin());
    let q4 = builder.fixed("Q4", Point::from(unit(frame_deg) * (6.0 * scale)));
    let b = builder.crank("B", q2, 3.0 * scale).unwrap();
    let c = builder.dyad("C", [b, q4], [7.0 * scale, 4.0 * scale], Side::Left).unwrap();
    let e = builder.point("E", [q4, c], -4.0 * scale, 0.0).unwrap();
    let f = builder.slide("F", (e, 8.5 * scale), ([q2, q4], 0.0), Side::Left).unwrap();
    let m = builder.point("M", [q4, c], -2.0 * scale, 0.0).unwrap();
    let n = builder.point("N", [e, f], 2.0 * scale, 0.0).unwrap();
    let h = builder.dyad("H", [m, n], [2.0 * scale; 2], Side::Left).unwrap();
    let options = MotionOptions { continuation, start: Some(frame_deg + 180.0), ..MotionOptions::default() };
    Linkage { placement: layout, ..builder.build(vec![h, f], None, options).unwrap() }
}

fn measure(linkage: &Linkage, motion: &Motion, name: &str) -> f64 {
    let values = compute_all(&TracedCurve::new(linkage, motion, &motion.circuits[0], linkage.traced[0]));
    let at = ALL.iter().position(|measure| measure.name == name).unwrap();
    let Value::Number(value) = values[at] else { panic!("{name}: {:?}", values[at]) };
    value
}

#[test]
fn an_eight_bar_with_a_rhombus_has_no_gap_and_no_jump() {
    let plain = Orientation::default();
    let layouts = [
        (plain, 1.0, 0.0),
        (plain, 1.0, 36.0),
        (plain, 1.0, 37.3),
        (plain, 1.0, 180.0),
        (plain, 1e-3, 211.7),
        (plain, 1e3, -90.0),
        (Orientation::new(true, 25.0), 1.0, 0.0),
        (Orientation::new(true, 25.0), 7.0, 101.0),
    ];
    let length_of = |continuation, (layout, scale, frame_deg)| {
        let linkage = eight_bar(layout, scale, frame_deg, continuation);
        let motion = solve(&linkage, Sampling::Samples(7200));
        let [circuit] = &motion.circuits[..] else { panic!("{} circuits", motion.circuits.len()) };
        let h = linkage.traced[0];
        let length = measure(&linkage, &motion, "length") / scale;
        let points: Vec<Point> = circuit.points(h).collect();
        let chords = (0..points.len()).map(|i| (points[(i + 1) % points.len()] - points[i]).norm() / scale);
        assert!(circuit.is_closed && chords.clone().all(|chord| chord < 0.05), "{frame_deg} {continuation:?}");
        assert!((chords.sum::<f64>() - length).abs() < 1e-4 * length);
        // At the change point, where the four-bar is on the frame's line.
        let limit = layout.transform_vector(unit(frame_deg) * (6.0 * scale));
        assert!(circuit.passes.iter().all(|pass| !pass.from.vanishing_dyads.union(pass.to.vanishing_dyads).is_empty()));
        for pass in &circuit.passes {
            for end in [pass.from, pass.to].into_iter().filter(|end| !end.vanishing_dyads.is_empty()) {
                let at = coupler_curves::motion::pose(&linkage, pass, end.input.value)[h].coords;
                assert!((at - limit).norm() < 1e-12 * scale, "{frame_deg} at {}: {at}", end.input.value);
                let jets = JointDerivatives::on_pass(&linkage, pass, end.input.value);
                assert!(jets.velocity(h).norm().is_finite() && jets.jerk(h).norm().is_finite());
            }
        }
        length
    };
    let smooth = length_of(Continuation::Smooth, layouts[0]);
    for layout in layouts {
        // The other branch is the mirror image.
        let [both, one] =
            [Continuation::Smooth, Continuation::Branch].map(|continuation| length_of(continuation, layout));
        assert!((both - 2.0 * one).abs() < 1e-9 && (both - smooth).abs() < 1e-9, "{layout:?}: {both} {one}");
    }
}

/// Where a path has a corner at the coincidence, a pin between two equal links has no limit, and the motion ends.
#[test]
fn the_motion_ends_where_a_joint_would_jump() {
    let linkage = |continuation| {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", Point::new(3.0, 0.0));
        // The four-bar is stretched at input 180, and M is beside its line there.
        let x = builder.fixed("X", Point::new(0.0, 1.0));
        let a = builder.crank("A", o, 1.0).unwrap();
        let b = builder.dyad("B", [a, c], [2.0, 2.0], Side::Left).unwrap();
        let m = builder.point("M", [a, b], 1.0, 1.0).unwrap();
        let h = builder.dyad("H", [m, x], [4.0, 4.0], Side::Left).unwrap();
        let all = CircuitSelection::Start;
        builder.build(vec![h], None, MotionOptions { continuation, circuits: all, ..MotionOptions::default() }).unwrap()
    };
    let h = linkage(Continuation::Smooth).traced[0];
    let smooth = solve(&linkage(Continuation::Smooth), Sampling::Step(0.05));
    let branch = Motion::solve(&linkage(Continuation::Branch), &Sampler::new(Sampling::Step(0.05)));
    let message = branch.assembly_error.as_ref().unwrap().to_string();
    assert_eq!(message, "the motion ends at an input of 180: M and X coincide there, and H would jump");
    assert!(smooth.circuits[0].is_closed && !branch.circuits[0].is_closed);
    for motion in [&smooth, &branch] {
        let points: Vec<Point> = motion.circuits[0].points(h).collect();
        assert!(points.windows(2).all(|pair| (pair[1] - pair[0]).norm() < 0.05));
    }
}

/// At the limit of a rocker the crank's pin is at rest, and a point of the coupler moves at right angles to the line from that pin.
#[test]
fn joints_that_coincide_at_a_limit_of_the_input_give_the_direction_of_the_path() {
    for (frame_deg, mirror) in [(0.0, 1.0), (36.0, 1.0), (71.3, -1.0)] {
        let limit_deg = trig::degrees(trig::acos(0.25)) * mirror;
        let placed = |v: Vector| unit(frame_deg) * v.x + left_normal(unit(frame_deg)) * v.y;
        let [pin, pivot] = [unit(limit_deg) * 2.0, Vector::new(4.0, 0.0)];
        let along = (pivot - pin) / 4.0;
        let arm = along + left_normal(along) * 0.5;
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", Point::from(placed(pivot)));
        let x = builder.fixed("X", Point::from(placed(pin + arm)));
        let a = builder.crank("A", o, 2.0).unwrap();
        let b = builder.dyad("B", [a, c], [2.0, 2.0], Side::Left).unwrap();
        let m = builder.point("M", [a, b], 1.0, 0.5).unwrap();
        let h = builder.dyad("H", [m, x], [3.0, 3.0], Side::Right).unwrap();
        let linkage = builder.build(vec![h], None, MotionOptions::default()).unwrap();
        let motion = solve(&linkage, Sampling::DenseAtLimits(2000));
        let [circuit] = &motion.circuits[..] else { panic!("{} circuits", motion.circuits.len()) };
        let points: Vec<Point> = circuit.points(h).collect();
        let jumps = (0..points.len()).map(|i| (points[(i + 1) % points.len()] - points[i]).norm());
        assert!(circuit.is_closed && jumps.fold(0.0, f64::max) < 0.1);
        // The path of M returns to X from the other side, and H with it after two rounds.
        let distance = |i: usize| (circuit.positions.point(m, i) - circuit.positions.point(x, i)).norm();
        let limits: Vec<usize> = (0..circuit.len()).filter(|&i| distance(i) < 1e-12).collect();
        assert_eq!(limits.len(), 2, "{frame_deg}: {limits:?}");
        let expected = [1.0, -1.0].map(|side| placed(pin + arm + arm.normalize() * (3.0 * side)));
        for at in limits {
            let error = expected.map(|place| (points[at].coords - place).norm());
            assert!(error[0].min(error[1]) < 1e-7, "{frame_deg}: {error:?}");
        }
    }
}
