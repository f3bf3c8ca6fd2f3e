//! Linkages of several dyads: their limits are found between samples, and their circuits keep every length.

use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{
    CircuitSelection, CoincidentDyads, DyadId, JointKind, Linkage, LinkageBuilder, MotionOptions, Side,
};
use coupler_curves::motion::{Motion, Pass, Sampler, Sampling};
use proptest::prelude::*;

fn all() -> MotionOptions {
    MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }
}

/// A Watt six-bar: a second dyad on a point of the rocker and a third fixed pivot.
fn six_bar([frame, crank, coupler, rocker, arm, link, output, pivot]: [f64; 8]) -> Option<Linkage> {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [frame, 0.0].into());
    let d = builder.fixed("D", [frame + pivot, 0.5].into());
    let a = builder.crank("A", o, crank).ok()?;
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).ok()?;
    let e = builder.point("E", [c, b], arm, 0.4).ok()?;
    let f = builder.dyad("F", [e, d], [link, output], Side::Left).ok()?;
    builder.build(vec![f], None, all()).ok()
}

fn solve_and_check(linkage: &Linkage, step: f64) -> Result<(), TestCaseError> {
    check_motion(linkage, &Motion::solve(linkage, &Sampler::new(Sampling::Step(step))))
}

/// Checks that every link keeps its length, and every pass begins where the one before it ends.
pub fn check_motion(linkage: &Linkage, motion: &Motion) -> Result<(), TestCaseError> {
    for circuit in &motion.circuits {
        let ends: Vec<f64> =
            circuit.passes.iter().flat_map(|pass| [pass.from.input.value, pass.to.input.value]).collect();
        for i in 0..circuit.len() {
            // Where two dyads have their limits close together, the base of the second moves so fast that no input in
            // double precision flattens it to better than this.
            let tolerance = if ends.contains(&circuit.inputs[i]) { 1e-10 } else { 1e-12 };
            for link in &linkage.links {
                for pair in link.joints.windows(2) {
                    let length = (pair[0].1 - pair[1].1).norm();
                    let found = (circuit.positions.point(pair[0].0, i) - circuit.positions.point(pair[1].0, i)).norm();
                    // Positions are rounded at the size of the linkage, so that a short link loses digits.
                    prop_assert!((found - length).abs() <= tolerance * length.max(0.1), "{found} {length}");
                }
            }
        }
        for k in 0..circuit.passes.len() {
            let next = (k + 1) % circuit.passes.len();
            if next > k || circuit.is_closed {
                let (pass, after) = (&circuit.passes[k], &circuit.passes[next]);
                // The end of a pass and the beginning of the next are one pose.
                let (end, begin) = (pass.to.input, after.from.input);
                prop_assert!((end.cos - begin.cos).abs() < 1e-15 && (end.sin - begin.sin).abs() < 1e-15);
            }
        }
    }
    Ok(())
}

/// The joint of a dyad by the law of cosines; and by how much its base is within reach, negative if it is not.
pub fn third_corner(p: Point, q: Point, [l0, l1]: [f64; 2], side: f64) -> (Point, f64) {
    let base = q - p;
    let d = base.norm();
    let foot = (d * d + l0 * l0 - l1 * l1) / (2.0 * d);
    let height = side * (l0 * l0 - foot * foot).max(0.0).sqrt();
    let across = Vector::new(-base.y, base.x);
    (p + base * (foot / d) + across * (height / d), (l0 + l1 - d).min(d - (l0 - l1).abs()))
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn six_bars_move_wherever_they_can_be_assembled(lengths in prop::array::uniform8(0.3f64..3.0)) {
        let Some(linkage) = six_bar(lengths) else { return Ok(()) };
        let [frame, crank, coupler, rocker, arm, link, output, pivot] = lengths;
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(8)));
        let (c, d) = (Point::new(frame, 0.0), Point::new(frame + pivot, 0.5));
        for (k, signs) in (0..1440).flat_map(|k| [(1, 1), (1, -1), (-1, 1), (-1, -1)].map(|signs| (k, signs))) {
            let deg = 0.25 * f64::from(k) + 0.1;
            let (cos, sin) = trig::cos_sin_deg(deg);
            let (b, first) = third_corner(Point::new(crank * cos, crank * sin), c, [coupler, rocker], f64::from(signs.0));
            let along = (b - c) / rocker;
            let e = c + along * arm + Vector::new(-along.y, along.x) * 0.4;
            let (_, second) = third_corner(e, d, [link, output], f64::from(signs.1));
            let margin = if first < 0.0 { first } else { first.min(second) };
            // Rounding decides this close to a limit.
            if margin.abs() < 1e-12 {
                continue;
            }
            let covers = |pass: &Pass| {
                let low = pass.from.input.value.min(pass.to.input.value);
                (pass.mode.sign(DyadId::FIRST), pass.mode.sign(DyadId::new(1))) == signs && (deg - low).rem_euclid(360.0) <= pass.input_length()
            };
            let found = motion.circuits.iter().flat_map(|circuit| &circuit.passes).filter(|pass| covers(pass)).count();
            prop_assert_eq!(found, usize::from(margin > 0.0), "at {} with {:?}: {}", deg, signs, margin);
        }
    }

    #[test]
    fn six_bars_keep_their_lengths(lengths in prop::array::uniform8(0.3f64..3.0)) {
        if let Some(linkage) = six_bar(lengths) {
            solve_and_check(&linkage, 3.0)?;
        }
    }
}

/// A crank-rocker, and a second dyad of these lengths to a pivot at (2, 0): it is attached to a coupler point that
/// coincides with the crank pin, so that its limits are found by sampling and yet known in closed form.
fn second_dyad_on_the_crank_pin(lengths: [f64; 2]) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [4.0, 0.0].into());
    let a = builder.crank("A", o, 1.0).unwrap();
    let b = builder.dyad("B", [a, c], [3.0, 3.5], Side::Left).unwrap();
    let p = builder.point("P", [a, b], 0.0, 0.0).unwrap();
    let d = builder.fixed("D", [2.0, 0.0].into());
    let f = builder.dyad("F", [p, d], lengths, Side::Left).unwrap();
    builder.build(vec![f], None, all()).unwrap()
}

#[test]
fn limits_between_samples_are_found_to_the_last_bits() {
    let linkage = second_dyad_on_the_crank_pin([0.9, 1.0]);
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(10.0)));
    // 1 + 4 - 4 cos = 1.9^2
    let limit = trig::degrees(trig::acos((5.0 - 1.9 * 1.9) / 4.0));
    assert_eq!(motion.circuits.len(), 2, "one for each side of the first dyad");
    for circuit in &motion.circuits {
        let reached = circuit.inputs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((reached - limit).abs() < 1e-12, "{reached} {limit}");
        assert!(circuit.is_closed && circuit.passes.len() == 2);
        // The second dyad changes its side at the limit, the first keeps it.
        assert_eq!(circuit.passes[0].mode.sign(DyadId::FIRST), circuit.passes[1].mode.sign(DyadId::FIRST));
        assert_ne!(circuit.passes[0].mode.sign(DyadId::new(1)), circuit.passes[1].mode.sign(DyadId::new(1)));
    }
}

/// The same linkage with its second pivot in a given direction, which may be none that a subdivision of the turn meets.
fn second_dyad_towards(direction_deg: f64, lengths: [f64; 2]) -> Linkage {
    let (cos, sin) = trig::cos_sin_deg(direction_deg);
    let mut linkage = second_dyad_on_the_crank_pin(lengths);
    linkage.joints[5].kind = JointKind::Fixed([2.0 * cos, 2.0 * sin].into());
    linkage
}

/// The pin of a crank of length 1 is at most 3 from a point two units from its pivot, when it is opposite that point. A
/// dyad between the two that reaches slightly less leaves a gap there; one whose shortest reach is slightly less leaves
/// a window. The width of each is known.
#[test]
fn gaps_and_windows_are_found_down_to_rounding() {
    for half_width_deg in [3.0, 0.05, 1e-3, 1e-4] {
        let half = trig::radians(half_width_deg);
        // 3 - sqrt(5 + 4 cos) without its cancellation: 8 sin^2(half / 2) over the sum of both.
        let shortfall =
            8.0 * trig::sin(half / 2.0) * trig::sin(half / 2.0) / (3.0 + (5.0 + 4.0 * trig::cos(half)).sqrt());
        // The base is rounded, so an edge is known to its rounding over the slope of the base there.
        let edge_deg = trig::degrees(8.0 * f64::EPSILON / (2.0 / 3.0 * half));
        for direction in [0.0, 37.123_456_7, 201.9] {
            let opposite = direction + 180.0;
            let near = |deg: f64, side: f64| {
                let off = (deg - opposite - side * half_width_deg).rem_euclid(360.0);
                off.min(360.0 - off) <= edge_deg
            };
            let gap = second_dyad_towards(direction, [1.5 - shortfall, 1.5]);
            for circuit in Motion::solve(&gap, &Sampler::new(Sampling::Step(10.0))).circuits {
                let (low, high) = (circuit.passes[0].from.input.value, circuit.passes[0].to.input.value);
                assert!(near(low, 1.0) && near(high, -1.0), "gap of {half_width_deg} at {opposite}: {low} to {high}");
            }
            let window = second_dyad_towards(direction, [4.0 - shortfall, 1.0]);
            let motion = Motion::solve(&window, &Sampler::new(Sampling::Step(10.0)));
            assert_eq!(motion.circuits.len(), 2, "window of {half_width_deg} at {opposite}");
            for circuit in motion.circuits {
                let (low, high) = (circuit.passes[0].from.input.value, circuit.passes[0].to.input.value);
                assert!(
                    near(low, -1.0) && near(high, 1.0),
                    "window of {half_width_deg} at {opposite}: {low} to {high}"
                );
            }
        }
    }
}

/// A gap of no width is a change point: a miss within rounding does not interrupt the motion.
#[test]
fn a_gap_within_rounding_is_a_change_point() {
    let touch = second_dyad_towards(37.123_456_7, [1.5, 1.5]);
    let motion = Motion::solve(&touch, &Sampler::new(Sampling::Step(10.0)));
    // Two turns each, as the second dyad changes its side after the first turn.
    let turns: Vec<f64> =
        motion.circuits.iter().map(|c| c.passes.iter().map(|pass| pass.input_length()).sum()).collect();
    assert_eq!(turns, [720.0, 720.0]);
    assert!(motion.circuits.iter().all(|circuit| circuit.is_closed));
}

#[test]
fn limits_do_not_depend_on_the_placement() {
    // The same four-bar on its frame line and turned by 30 degrees about a pivot elsewhere.
    let four_bar = |o: [f64; 2], c: [f64; 2]| {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", o.into());
        let c = builder.fixed("C", c.into());
        let a = builder.crank("A", o, 3.0).unwrap();
        let b = builder.dyad("B", [a, c], [1.0, 3.0], Side::Left).unwrap();
        Motion::solve(&builder.build(vec![b], None, all()).unwrap(), &Sampler::new(Sampling::Samples(40)))
    };
    let (plain, turned) =
        (four_bar([0.0, 0.0], [4.0, 0.0]), four_bar([1.0, 2.0], [1.0 + 4.0 * trig::cos(trig::radians(30.0)), 4.0]));
    assert_eq!(plain.circuits.len(), turned.circuits.len());
    for (plain, turned) in plain.circuits.iter().zip(&turned.circuits) {
        for (a, b) in plain.inputs.iter().zip(&turned.inputs) {
            assert!((a + 30.0 - b).abs() < 1e-12, "{a} {b}");
        }
    }
}

/// Wheels coupled by parallel rods: all their dyads are flat at one input, and continue together.
#[test]
fn dyads_that_are_flat_together_continue_together() {
    for (g, r) in [(4.0, 1.0), (0.3, 0.1), (1.0, 0.7)] {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let c = builder.fixed("C", [g, 0.0].into());
        let d = builder.fixed("D", [2.0 * g, 0.0].into());
        let a = builder.crank("A", o, r).unwrap();
        let b = builder.dyad("B", [a, c], [g, r], Side::Left).unwrap();
        let e = builder.dyad("E", [b, d], [g, r], Side::Left).unwrap();
        let linkage = builder.build(vec![e], None, all()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(10.0)));
        assert_eq!(motion.circuits.len(), 4, "{g} {r}: parallel or crossed, twice");
        // In the one that starts with both to the left, both rods stay parallel all the way round.
        let circuit = &motion.circuits[0];
        assert!(circuit.is_closed && circuit.len() == 36);
        for i in 0..circuit.len() {
            let crank = circuit.positions.point(a, i) - circuit.positions.point(o, i);
            let wheel = circuit.positions.point(e, i) - circuit.positions.point(d, i);
            assert!((crank - wheel).norm() < 1e-12, "{g} {r} at {}: {crank} {wheel}", circuit.inputs[i]);
        }
    }
}

/// Two dyads of equal reach on one base: both are flat at one input, and either could change sides without the other.
#[test]
fn the_coincident_dyads_that_change_sides_can_be_chosen() {
    let modes = |coincident| -> Vec<[i8; 2]> {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let c = builder.fixed("C", [4.0, 0.0].into());
        let a = builder.crank("A", o, 2.0).unwrap();
        let b = builder.dyad("B", [a, c], [2.0, 2.0], Side::Left).unwrap();
        let d = builder.dyad("D", [a, c], [2.5, 1.5], Side::Right).unwrap();
        let linkage =
            builder.build(vec![b, d], None, MotionOptions { coincident, ..MotionOptions::default() }).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(24)));
        check_motion(&linkage, &motion).unwrap();
        let circuit = &motion.circuits[0];
        assert!(circuit.is_closed);
        circuit.passes.iter().map(|pass| [pass.mode.sign(DyadId::FIRST), pass.mode.sign(DyadId::new(1))]).collect()
    };
    assert_eq!(modes(CoincidentDyads::Together), [[1, -1], [-1, 1]]);
    assert_eq!(modes(CoincidentDyads::First), [[1, -1], [-1, -1]]);
    assert_eq!(modes(CoincidentDyads::Last), [[1, 1], [1, -1]]);
}

#[test]
fn a_geared_circuit_closes_after_several_turns() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let p = builder.fixed("P", [3.0, 0.0].into());
    let a = builder.crank("A", o, 1.0).unwrap();
    let g = builder.gear("G", (p, 0.8), [-4.0, 6.0], 30.0).unwrap();
    let b = builder.dyad("B", [a, g], [3.0, 3.0], Side::Left).unwrap();
    let linkage = builder.build(vec![b], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(10.0)));
    let circuit = &motion.circuits[0];
    // The gear makes two thirds of a turn to each of the crank, so the circuit closes after three.
    assert!(circuit.is_closed);
    assert_eq!((circuit.len(), circuit.passes[0].to.input.value), (108, 1080.0));
    for i in 0..circuit.len() {
        let angle = 30.0 - circuit.inputs[i] * 2.0 / 3.0;
        let (cos, sin) = trig::cos_sin_deg(angle);
        let gear = circuit.positions.point(g, i);
        assert!((gear.x - 3.0 - 0.8 * cos).abs() < 1e-13 && (gear.y - 0.8 * sin).abs() < 1e-13);
        let next = (i + 1) % circuit.len();
        assert!(
            (circuit.positions.point(b, next) - circuit.positions.point(b, i)).norm() < 1.0,
            "no jump where it closes"
        );
    }
}

#[test]
fn an_actuator_drives_its_crank_from_limit_to_limit_and_back() {
    use coupler_curves::linkage::InvertedSliderCrank;
    let (g, r) = (2.0, 1.0);
    for e in [0.0, 0.5, 1.5] {
        let mut builder = LinkageBuilder::default();
        let c = builder.fixed("C", [g, 0.0].into());
        let o = builder.fixed("O", [0.0, 0.0].into());
        let a = builder.piston("A", [c, o], (r, e), Side::Left).unwrap();
        let linkage = builder.build(vec![a], None, all()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(60)));
        let formulas = InvertedSliderCrank { g, r, e };
        let [least, greatest] = formulas.slide_range().unwrap();
        for circuit in &motion.circuits {
            let low = circuit.inputs.iter().copied().fold(f64::INFINITY, f64::min);
            let high = circuit.inputs.iter().copied().fold(0.0, f64::max);
            assert!((low - least).abs() < 1e-12 && (high - greatest).abs() < 1e-12, "{e}: {low} {high}");
            // With a larger offset the actuator can shorten to zero, where the circuit ends.
            assert_eq!(circuit.is_closed, e < g - r);
            for i in 0..circuit.len() {
                let theta = formulas.theta(circuit.inputs[i]).unwrap();
                let position = circuit.positions.point(a, i);
                assert!((position.x - r * trig::cos(theta)).abs() < 1e-12, "{e} {i}: {position} {theta}");
                assert!((position.coords.norm() - r).abs() < 1e-12, "{e} {i}: {position}");
            }
        }
        assert!(motion.is_assembled());
    }
}

/// Dyads on the coupler of a kite, whose base vanishes during the motion, have no limits themselves.
#[test]
fn dyads_on_the_coupler_of_a_kite_continue_with_it() {
    for direction in [0.0, 57.3] {
        let (cos, sin) = trig::cos_sin_deg(direction);
        let turned = |x: f64, y: f64| Point::new(cos * x - sin * y, sin * x + cos * y);
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", turned(0.0, 0.0));
        let c = builder.fixed("C", turned(2.0, 0.0));
        let e = builder.fixed("E", turned(4.0, 1.0));
        let q = builder.fixed("Q", turned(5.0, 1.0));
        let a = builder.crank("A", o, 2.0).unwrap();
        let b = builder.dyad("B", [a, c], [3.0, 3.0], Side::Left).unwrap();
        let m = builder.point("M", [a, b], 1.0, 0.5).unwrap();
        let d = builder.dyad("D", [m, e], [6.0, 5.0], Side::Left).unwrap();
        let s = builder.slide("S", (m, 9.0), ([e, q], 0.0), Side::Left).unwrap();
        let linkage = builder.build(vec![d, s], None, all()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(2.0)));
        check_motion(&linkage, &motion).unwrap();
        assert_eq!(motion.circuits.len(), 4, "each side of the two dyads that never lie flat");
        for circuit in &motion.circuits {
            let length: f64 = circuit.passes.iter().map(|pass| pass.input_length()).sum();
            assert!(circuit.is_closed && (length - 720.0).abs() < 1e-9, "{length}");
            for i in 0..circuit.len() {
                let next = (i + 1) % circuit.len();
                for joint in [d, s] {
                    let moved = circuit.positions.point(joint, next) - circuit.positions.point(joint, i);
                    assert!(moved.norm() < 1.0, "from {}: {moved}", circuit.inputs[i]);
                }
            }
        }
    }
}

/// A turning block whose crank is as long as the frame: its line turns half as fast as the crank, through the pivot.
#[test]
fn a_slot_without_offset_continues_through_its_pivot() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [1.0, 0.0].into());
    let a = builder.crank("A", o, 1.0).unwrap();
    builder.slot("B", [c, a], 0.0, Side::Right).unwrap();
    let m = builder.point("M", [c, a], 2.0, 0.3).unwrap();
    let linkage = builder.build(vec![m], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(10.0)));
    let circuit = &motion.circuits[0];
    assert!(circuit.is_closed && circuit.len() == 72, "{}", circuit.len());
    // At the start, half a turn in, the line points from C to A. Circuits begin on branch 1, which is a turn earlier.
    let at_start = |k: &usize| circuit.inputs[*k] == 540.0 && circuit.mode_at(*k).sign(DyadId::FIRST) == -1;
    let start = (0..circuit.len()).find(at_start).unwrap();
    for i in 0..circuit.len() {
        let (cos, sin) = trig::cos_sin_deg(180.0 + (circuit.inputs[i] - circuit.inputs[start]) / 2.0);
        let expected = Point::new(1.0 + 2.0 * cos - 0.3 * sin, 2.0 * sin + 0.3 * cos);
        let found = circuit.positions.point(m, i);
        assert!((found - expected).norm() < 1e-12, "at {}: {found} {expected}", circuit.inputs[i]);
    }
}

/// An actuator of any size has its limits, and its points have their positions even where its length is zero.
#[test]
fn actuators_move_alike_at_every_size() {
    for scale in [1e-13, 1e-6, 1.0, 1e9] {
        let mut builder = LinkageBuilder::default();
        let c = builder.fixed("C", [3.0 * scale, 0.0].into());
        let o = builder.fixed("O", [0.0, 0.0].into());
        let a = builder.piston("A", [c, o], (scale, 0.0), Side::Left).unwrap();
        let linkage = builder.build(vec![a], None, MotionOptions::default()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(5)));
        let pass = &motion.circuits[0].passes[0];
        assert!(
            (pass.from.input.value / scale - 2.0).abs() < 1e-12 && (pass.to.input.value / scale - 4.0).abs() < 1e-12
        );
        check_motion(&linkage, &motion).unwrap();
    }
    let mut builder = LinkageBuilder::default();
    let c = builder.fixed("C", [1.7493, -0.0615].into());
    let o = builder.fixed("O", [0.0, 0.0].into());
    let a = builder.piston("A", [c, o], (2.1108, 0.4292), Side::Left).unwrap();
    let m = builder.point("M", [c, a], -1.8888, 0.7281).unwrap();
    let linkage = builder.build(vec![m], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(9)));
    let circuit = &motion.circuits[0];
    let at_zero = circuit.inputs.iter().position(|s| *s == 0.0).unwrap();
    // From an evaluation in 40 digits.
    let expected = Point::new(0.002_994_337_146_540, -1.085_273_208_228_237);
    assert!((circuit.positions.point(m, at_zero) - expected).norm() < 1e-11, "{}", circuit.positions.point(m, at_zero));
    let jets = circuit.derivatives(&linkage, at_zero);
    assert!((jets.velocity(m) - Vector::new(-2.385_31, 4.068_75)).norm() < 1e-5, "{}", jets.velocity(m));
    assert!((jets.acceleration(m) - Vector::new(-0.3137, 22.263)).norm() < 1e-3, "{}", jets.acceleration(m));
}

/// A slot through the foot of another slot, which reaches its pin at the limit: there the line has the direction in
/// which the foot arrives.
#[test]
fn a_slot_on_a_foot_keeps_its_direction_at_the_limit() {
    use coupler_curves::motion::pose;
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [2.0771, -0.2512].into());
    let a = builder.crank("A", o, 1.9228).unwrap();
    let foot = builder.slot("B", [a, c], 0.3218, Side::Left).unwrap();
    builder.slot("D", [foot, c], 0.0, Side::Right).unwrap();
    let p = builder.point("P", [foot, c], 1.0913, -0.6834).unwrap();
    let linkage = builder.build(vec![p], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(10.0)));
    for pass in &motion.circuits[0].passes {
        for (end, inwards) in [(pass.from, pass.input_direction()), (pass.to, -pass.input_direction())] {
            let at = |input: f64| pose(&linkage, pass, input)[p];
            // It arrives as the root of the input: over the last 1e-10 degrees it moves by some 1e-5.
            let off = (at(end.input.value) - at(end.input.value + inwards * 1e-10)).norm();
            assert!(off < 1e-4, "at {}: {off}", end.input.value);
        }
    }
}
