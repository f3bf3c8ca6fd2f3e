//! Velocity, acceleration and jerk of every kind of joint, against nested dual numbers: numbers that carry their exact
//! derivative, here through independent formulas (circles intersected by the law of cosines, exact rules for sine and
//! cosine).

use coupler_curves::geometry::{Point, Vector, left_normal, trig};
use coupler_curves::linkage::{
    AssemblyMode, CircuitSelection, JointId, JointKind, LineDirection, Linkage, LinkageBuilder, MotionOptions,
    Orientation, Side,
};
use coupler_curves::motion::{InputPosition, JointDerivatives, Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::dual::{Real, Third, orders, variable};

/// The position of every joint by its kind, with the input in radians or as a length.
fn positions(linkage: &Linkage, input: Third, mode: AssemblyMode) -> Vec<[Third; 2]> {
    let n = Third::from_f64;
    let minus = |a: [Third; 2], b: [Third; 2]| [a[0] - b[0], a[1] - b[1]];
    let dot = |a: [Third; 2], b: [Third; 2]| a[0] * b[0] + a[1] * b[1];
    let moved = |p: [Third; 2], u: [Third; 2], along: Third, across: Third| {
        [p[0] + along * u[0] - across * u[1], p[1] + along * u[1] + across * u[0]]
    };
    let unit = |v: [Third; 2]| {
        let length = dot(v, v).sqrt();
        [v[0] / length, v[1] / length]
    };
    // The intersection of circles about p and q, by the angle at p.
    let intersection = |p: [Third; 2], q: [Third; 2], [l0, l1]: [Third; 2], side: f64| {
        let base = minus(q, p);
        let d = dot(base, base).sqrt();
        let cos = (l0 * l0 + d * d - l1 * l1) / (n(2.0) * l0 * d);
        moved(p, unit(base), l0 * cos, n(side) * l0 * (n(1.0) - cos * cos).sqrt())
    };
    let mut at: Vec<[Third; 2]> = Vec::new();
    for joint in &linkage.joints {
        let side = |dyad| f64::from(mode.sign(dyad));
        let place = match joint.kind {
            JointKind::Fixed(p) => [n(p.x), n(p.y)],
            JointKind::Crank { pivot, length } => moved(at[pivot], input.cos_sin(), n(length), n(0.0)),
            JointKind::Gear { pivot, length, ratio: [gear_turns, crank_turns], phase_deg } => {
                let angle = input * n(gear_turns as f64 / crank_turns as f64) + n(trig::radians(phase_deg));
                moved(at[pivot], angle.cos_sin(), n(length), n(0.0))
            }
            JointKind::Piston { base: [p, q], length, offset, dyad } => {
                let reach = (input * input + n(offset * offset)).sqrt();
                intersection(at[p], at[q], [reach, n(length)], side(dyad))
            }
            JointKind::Rack { line: [p, q], offset, radius, start } => {
                moved(at[p], unit(minus(at[q], at[p])), input * n(radius) + n(start), n(offset))
            }
            JointKind::DrivenSlider { line: [p, q], offset } => {
                moved(at[p], unit(minus(at[q], at[p])), input, n(offset))
            }
            JointKind::Dyad { base: [p, q], lengths, dyad } => intersection(at[p], at[q], lengths.map(n), side(dyad)),
            JointKind::Slide { from, length, line: [p, q], offset, dyad } => {
                // Along the line from the foot of the joint to which the link is attached.
                let u = unit(minus(at[q], at[p]));
                let arm = minus(at[from], at[p]);
                let off = n(offset) - (u[0] * arm[1] - u[1] * arm[0]);
                let along = (n(length * length) - off * off).sqrt();
                moved(at[p], u, dot(u, arm) + n(side(dyad)) * along, n(offset))
            }
            JointKind::Slot { base: [p, q], offset, dyad } => {
                // The foot is on Thales' circle over the base, at the offset from the pivot.
                let base = minus(at[q], at[p]);
                let d = dot(base, base).sqrt();
                let cos = n(offset) / d;
                moved(at[p], unit(base), n(offset) * cos, n(side(dyad) * offset) * (n(1.0) - cos * cos).sqrt())
            }
            JointKind::Yoke { from, line: [p, q], offset, slot_direction: slot } => {
                // Cramer's rule for p + t u + offset n = from - w slot.
                let u = unit(minus(at[q], at[p]));
                let w = moved([n(0.0); 2], u, n(slot.x), n(slot.y));
                let start = moved(at[p], u, n(0.0), n(offset));
                let to = minus(at[from], start);
                moved(start, u, (to[0] * w[1] - to[1] * w[0]) / (u[0] * w[1] - u[1] * w[0]), n(0.0))
            }
            JointKind::Aligned { from, line: [p, q], offset, direction: line_is, along, across } => {
                let sense = if let LineDirection::BySide(dyad) = line_is { -side(dyad) } else { 1.0 };
                let [along, across] = [along * sense, across * sense];
                // The base's direction, turned to the right until the line through q passes p at the offset.
                let base = minus(at[q], at[p]);
                let sin = n(offset) / dot(base, base).sqrt();
                let direction = moved([n(0.0); 2], unit(base), (n(1.0) - sin * sin).sqrt(), -sin);
                moved(at[from], direction, n(along), n(across))
            }
            JointKind::Parallelogram { corners: [p, q, r] } => std::array::from_fn(|k| at[p][k] + at[r][k] - at[q][k]),
            JointKind::Rigid { base: [p, q], along, across } => moved(at[p], minus(at[q], at[p]), n(along), n(across)),
            kind => panic!("{kind:?} has no position in dual numbers here"),
        };
        at.push(place);
    }
    at
}

/// A linkage with a joint of every kind but the piston and the driven slider, each attached to moving ones.
fn all_kinds([crank, a, b, offset, phase]: [f64; 5]) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [4.0, 0.5].into());
    let f = builder.fixed("F", [-3.0, 1.0].into());
    let pin = builder.crank("A", o, crank).unwrap();
    let gear = builder.gear("G", (c, 0.5 * crank), [-3.0, 2.0], phase).unwrap();
    let dyad = builder.dyad("B", [pin, gear], [a, b], Side::Left).unwrap();
    let point = builder.point("M", [pin, dyad], 1.2, -0.7).unwrap();
    let slide = builder.slide("S", (point, 7.0), ([f, o], offset), Side::Right).unwrap();
    let block = builder.point("K", [slide, o], 0.3, 0.4).unwrap();
    let slot = builder.slot("T", [f, block], offset, Side::Right).unwrap();
    let carried = builder.point("L", [f, block], 1.0, 0.5).unwrap();
    let yoke = builder.yoke("Y", carried, ([f, pin], 0.25), 70.0).unwrap();
    let arm = builder.point("N", [yoke, pin], 0.6, -0.2).unwrap();
    let plain = builder.slot("U", [c, arm], 0.0, Side::Left).unwrap();
    let end = builder.point("E", [c, arm], 2.0, 0.3).unwrap();
    let corner = builder.parallelogram("R", [o, pin, dyad]).unwrap();
    builder.point("W", [corner, dyad], 0.5, 0.4).unwrap();
    builder.build(vec![slot, plain, end], None, MotionOptions::default()).unwrap()
}

fn actuator(offset: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let c = builder.fixed("C", [2.0, 0.3].into());
    let o = builder.fixed("O", [0.0, 0.0].into());
    let a = builder.piston("A", [c, o], (1.0, offset), Side::Left).unwrap();
    let p = builder.point("P", [c, a], 0.7, 0.2).unwrap();
    let r = builder.point("R", [a, c], 0.3, -0.1).unwrap();
    builder.build(vec![p, r], None, MotionOptions::default()).unwrap()
}

/// A slider that drives a crank, and a point on its block.
fn driven_slider(offset: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let [p, q] = [("P", 1.0), ("Q", 2.0)].map(|(name, x)| builder.fixed(name, [x, 0.3 * x].into()));
    let o = builder.fixed("O", [0.0, 0.0].into());
    let b = builder.driven_slider("B", ([p, q], offset)).unwrap();
    let a = builder.dyad("A", [o, b], [1.0, 3.0], Side::Left).unwrap();
    let m = builder.point("M", [a, b], 0.7, 0.2).unwrap();
    let k = builder.point("K", [b, q], 0.3, -0.1).unwrap();
    builder.build(vec![m, k], None, MotionOptions::default()).unwrap()
}

/// A rack on a line that turns with the rocker of a four-bar, a dyad on it and a point of it.
fn rack(offset: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let [o, c] = [("O", 0.0), ("C", 4.0)].map(|(name, x)| builder.fixed(name, [x, 0.1 * x].into()));
    let a = builder.crank("A", o, 1.0).unwrap();
    let b = builder.dyad("B", [a, c], [3.0, 3.5], Side::Left).unwrap();
    let r = builder.rack("R", ([c, b], offset), (-0.4, 0.7)).unwrap();
    let e = builder.dyad("E", [o, r], [4.0, 5.0], Side::Right).unwrap();
    let k = builder.point("K", [r, b], 0.3, -0.1).unwrap();
    let range = Some([-500.0, 300.0]);
    builder.build(vec![e, k], None, MotionOptions { range, ..MotionOptions::default() }).unwrap()
}

/// Compares the derivatives at an input with dual numbers, relative to the greatest derivative of each joint.
fn compare(linkage: &Linkage, input: InputPosition, variable: Third, mode: AssemblyMode) -> Result<(), TestCaseError> {
    let jets = JointDerivatives::new(linkage, input, mode);
    let expected = positions(linkage, variable, mode);
    for joint in linkage.joint_ids() {
        let found = [jets.position(joint).coords, jets.velocity(joint), jets.acceleration(joint), jets.jerk(joint)];
        for axis in 0..2 {
            let expected = orders(expected[joint][axis]);
            for order in 0..4 {
                // Both lose digits by the conditioning of the chain, and more with each derivative.
                let size = expected.iter().fold(1.0, |a: f64, b| a.max(b.abs()));
                let off = (found[order][axis] - expected[order]).abs();
                let name = &linkage.joints[joint].name;
                prop_assert!(off <= 1e-9 * size, "{name} order {order}: {} {}", found[order][axis], expected[order]);
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn rates_match_dual_numbers(
        (crank, a, b) in (0.5f64..1.0, 3.0f64..4.0, 2.5f64..4.0),
        (offset, phase, deg) in (0.1f64..0.6, 0.0f64..360.0, 0.0f64..720.0),
    ) {
        let linkage = all_kinds([crank, a, b, offset, phase]);
        compare(&linkage, InputPosition::from_degrees(deg), variable(trig::radians(deg)), linkage.motion_options.mode)?;
        let actuator = actuator(offset);
        let s = 1.3 + deg / 720.0;
        let input = InputPosition { value: s, cos: 0.0, sin: 0.0 };
        compare(&actuator, input, variable(s), actuator.motion_options.mode)?;
        let slider = driven_slider(offset);
        compare(&slider, input, variable(s), slider.motion_options.mode)?;
        let rack = rack(offset);
        compare(&rack, InputPosition::from_degrees(deg), variable(trig::radians(deg)), rack.motion_options.mode)?;
    }

    /// Sampling and derivatives place every joint alike, in every placement, which changes no shape.
    #[test]
    fn samples_and_derivatives_agree_in_every_placement(turn in -360.0f64..360.0, mirrored: bool, offset in 0.1f64..0.6) {
        for linkage in [all_kinds([0.8, 3.5, 3.0, offset, 20.0]), actuator(offset), rack(offset)] {
            let placement = Orientation::new(mirrored, turn);
            let placed = Linkage { placement, ..linkage.clone() };
            let sampler = Sampler::new(Sampling::Samples(20));
            let (plain, placed_motion) = (Motion::solve(&linkage, &sampler), Motion::solve(&placed, &sampler));
            prop_assert!(plain.is_assembled());
            for (before, after) in plain.circuits.iter().zip(&placed_motion.circuits) {
                prop_assert_eq!(&before.inputs, &after.inputs);
                for i in 0..after.len() {
                    let jets = after.derivatives(&placed, i);
                    for joint in placed.joint_ids() {
                        let place = after.positions.point(joint, i);
                        prop_assert!((jets.position(joint) - place).norm() < 1e-11);
                        prop_assert!((placement.transform_point(before.positions.point(joint, i)) - place).norm() < 1e-14 * 16.0);
                    }
                }
            }
        }
    }
}

fn find(linkage: &Linkage, name: &str) -> JointId {
    linkage.find_joint(name).unwrap()
}

/// A Scotch yoke moves as the cosine of its crank angle.
#[test]
fn a_scotch_yoke_moves_as_the_cosine() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let q = builder.fixed("Q", [1.0, 0.0].into());
    let a = builder.crank("A", o, 2.0).unwrap();
    let y = builder.yoke("Y", a, ([o, q], 0.5), 90.0).unwrap();
    let leaning = builder.yoke("Z", a, ([o, q], 0.5), 45.0).unwrap();
    let arm = builder.point("P", [y, q], 3.0, 1.0).unwrap();
    let linkage = builder.build(vec![y, leaning, arm], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(15.0)));
    let circuit = &motion.circuits[0];
    assert!(circuit.is_closed && circuit.len() == 24);
    for i in 0..circuit.len() {
        let (cos, sin) = trig::cos_sin_deg(circuit.inputs[i]);
        assert!((circuit.positions.point(y, i) - Point::new(2.0 * cos, 0.5)).norm() < 1e-15);
        assert!((circuit.positions.point(leaning, i) - Point::new(2.0 * cos - (2.0 * sin - 0.5), 0.5)).norm() < 1e-15);
        assert!((circuit.positions.point(arm, i) - Point::new(2.0 * cos + 3.0, 1.5)).norm() < 1e-14);
    }
}

/// A rack moves by the pitch radius times the crank's angle, over several turns; seen from the rack, a point of the pinion traces a
/// trochoid, and one on the pitch circle a cycloid.
#[test]
fn a_rack_moves_evenly_and_the_pinion_rolls_on_it() {
    for (radius, arm, [from, to]) in [(0.5, 0.5, [0.0, 720.0]), (0.5, 0.8, [-400.0, 90.0]), (-0.7, 1.0, [10.0, 3600.0])]
    {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let x = builder.fixed("X", [2.0, 0.0].into());
        let a = builder.crank("A", o, arm).unwrap();
        // The lowest point of the pinion moves with the rack as the crank turns to the left; of a negative radius, the highest.
        let r = builder.rack("R", ([o, x], -radius), (radius, 0.25)).unwrap();
        let n = builder.point("N", [r, x], 1.0, 0.0).unwrap();
        let options = MotionOptions { range: Some([from, to]), ..MotionOptions::default() };
        let linkage = builder.clone().build(vec![a, r], None, options.clone()).unwrap();
        let seen_from_rack = builder.clone().build(vec![a, r], Some([r, n]), options).unwrap();
        let sampler = Sampler::new(Sampling::Step(10.0));
        let [motion, seen] = [&linkage, &seen_from_rack].map(|linkage| Motion::solve(linkage, &sampler));
        let [circuit, seen] = [&motion.circuits[0], &seen.circuits[0]];
        let ends = [circuit.inputs[0], circuit.inputs[circuit.len() - 1]];
        assert!(!circuit.is_closed && ends == [from, to], "{ends:?}");
        for i in 0..circuit.len() {
            let turn = trig::radians(circuit.inputs[i]);
            let rack = circuit.positions.point(r, i);
            assert!((rack - Point::new(0.25 + radius * turn, -radius)).norm() < 1e-13, "{rack}");
            let jets = circuit.derivatives(&linkage, i);
            assert!((jets.velocity(r) - Vector::new(radius, 0.0)).norm() < 1e-13);
            assert!(jets.acceleration(r).norm() < 1e-13);
            let (cos, sin) = trig::cos_sin_deg(circuit.inputs[i]);
            let trochoid = Point::new(arm * cos - radius * turn - 0.25, arm * sin + radius);
            assert!((seen.positions.point(a, i) - trochoid).norm() < 1e-12, "{}", seen.positions.point(a, i));
            // The point of the pinion that touches the rack is at rest on it.
            if arm == radius && (circuit.inputs[i] + 90.0) % 360.0 == 0.0 {
                assert!(seen.derivatives(&seen_from_rack, i).velocity(a).norm() < 1e-13);
            }
        }
        assert!(builder.build(vec![a], None, MotionOptions::default()).is_err(), "a range is needed");
    }
}

/// A dyad on a rack closes while the rack is within its reach, on either side of its pivot and in another turn each.
#[test]
fn limits_of_a_dyad_on_a_rack_are_found_in_every_turn() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let x = builder.fixed("X", [1.0, 0.0].into());
    let a = builder.crank("A", o, 1.0).unwrap();
    let r = builder.rack("R", ([o, x], 0.0), (0.5, 2.0)).unwrap();
    let b = builder.dyad("B", [o, r], [2.0, 3.0], Side::Left).unwrap();
    let options = |circuits| MotionOptions { range: Some([-1700.0, 1700.0]), circuits, ..MotionOptions::default() };
    let ends = |circuits| {
        let linkage = builder.clone().build(vec![a, b], None, options(circuits)).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(10.0)));
        let mut ends: Vec<[f64; 2]> = Vec::new();
        for circuit in &motion.circuits {
            assert!(circuit.is_closed && circuit.passes.len() == 2);
            let values = |low: fn(f64, f64) -> f64| circuit.inputs.iter().copied().reduce(low).unwrap();
            ends.push([values(f64::min), values(f64::max)]);
        }
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        ends
    };
    let at = |x: f64| trig::degrees((x - 2.0) / 0.5);
    for (circuits, expected) in [
        (CircuitSelection::Start, vec![[at(1.0), at(5.0)]]),
        (CircuitSelection::All, vec![[at(-5.0), at(-1.0)], [at(1.0), at(5.0)]]),
    ] {
        let found = ends(circuits);
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }
}

/// An actuator's line keeps its offset from its pivot and goes through the pin, and its points keep their positions on
/// it.
#[test]
fn points_of_an_actuator_move_with_its_line() {
    for offset in [0.0, 0.5, -0.4] {
        let linkage = actuator(offset);
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(30)));
        for i in 0..motion.circuits[0].len() {
            let at = |name: &str| motion.circuits[0].positions.point(find(&linkage, name), i);
            let (arm, pin, s) = (at("P") - at("C"), at("A") - at("C"), motion.circuits[0].inputs[i]);
            assert!((arm.norm_squared() - (0.7 * 0.7 + 0.2 * 0.2)).abs() < 1e-14);
            // In the frame of the line the pin is s along, and the offset to the right: McCarthy's beta is atan2(s, e).
            let along = (arm.dot(&pin), arm.x * pin.y - arm.y * pin.x);
            assert!((along.0 - (0.7 * s - 0.2 * offset)).abs() < 1e-12, "{offset}: {along:?}");
            assert!((along.1 - (-0.7 * offset - 0.2 * s)).abs() < 1e-12, "{offset}: {along:?}");
            // A point of the rod is measured from the pin, against the direction of the line.
            let [forward, rod] = [(at("P") - at("C")) * 0.7 - left_normal(at("P") - at("C")) * 0.2, at("R") - at("A")];
            let forward = forward / (0.7 * 0.7 + 0.2 * 0.2);
            let expected = forward * -0.3 + left_normal(forward) * 0.1;
            assert!((rod - expected).norm() < 1e-12, "{offset}: {rod:?} {expected:?}");
        }
    }
}

/// Points of a slider's block keep their positions relative to it, towards either joint of its line.
#[test]
fn points_of_a_block_move_with_it() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let x = builder.fixed("X", [2.0, 0.0].into());
    let a = builder.crank("A", o, 1.0).unwrap();
    let b = builder.slide("B", (a, 3.0), ([o, x], 0.5), Side::Left).unwrap();
    let [ahead, behind] = [("P", x), ("Q", o)].map(|(name, end)| builder.point(name, [b, end], 0.3, 0.2).unwrap());
    let linkage = builder.build(vec![ahead, behind], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
    for i in 0..motion.circuits[0].len() {
        let at = |joint| motion.circuits[0].positions.point(joint, i);
        assert!((at(ahead) - at(b) - Vector::new(0.3, 0.2)).norm() < 1e-14);
        assert!((at(behind) - at(b) - Vector::new(-0.3, -0.2)).norm() < 1e-14);
    }
}

/// The block through which a slot's link slides keeps the direction of that link: its points are as by a parallelogram.
#[test]
fn points_of_a_slots_block_keep_its_direction() {
    for (offset, side) in [(0.0, Side::Right), (0.4, Side::Right), (0.4, Side::Left)] {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let c = builder.fixed("C", [2.0, 0.3].into());
        let a = builder.crank("A", o, 1.0).unwrap();
        builder.slot("B", [c, a], offset, side).unwrap();
        let arm = builder.point("P", [c, a], 0.7, -0.2).unwrap();
        let block = builder.point("K", [a, c], -0.7, 0.2).unwrap();
        let linkage = builder.build(vec![arm, block], None, MotionOptions::default()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
        let circuit = &motion.circuits[0];
        for i in 0..circuit.len() {
            let at = |joint| circuit.positions.point(joint, i);
            let (on_arm, on_block) = (at(arm) - at(c), at(block) - at(a));
            assert!((on_arm - on_block).norm() < 1e-13, "{offset}: {on_arm:?} {on_block:?}");
            let jets = circuit.derivatives(&linkage, i);
            let difference = jets.velocity(block) - jets.velocity(a) - jets.velocity(arm);
            assert!(difference.norm() < 1e-12, "{offset}: {difference:?}");
        }
    }
}

/// The slide, its angles and their rates are McCarthy's for slots without offset, and for actuators, too.
#[test]
fn columns_cover_slots_without_offset_and_actuators() {
    use coupler_curves::measure::{compute_columns, find_column};
    let columns = ["s", "b", "beta_deg", "psi_deg", "psi_ratio"].map(|name| find_column(name).unwrap());
    let (g, r) = (2.0, 1.0);
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let c = builder.fixed("C", [g, 0.0].into());
    let a = builder.crank("A", o, r).unwrap();
    let b = builder.slot("B", [c, a], 0.0, Side::Right).unwrap();
    let linkage = builder.build(vec![b], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(30.0)));
    for i in 0..motion.circuits[0].len() {
        let [s, length, beta, psi, ratio] =
            compute_columns(&columns, &linkage, &motion.circuits[0], b, i).try_into().unwrap();
        let (cos, sin) = trig::cos_sin_deg(motion.circuits[0].inputs[i]);
        let arm = Vector::new(r * cos - g, r * sin);
        assert!((s - arm.norm()).abs() < 1e-14 && (length - s).abs() < 1e-14 && beta == 90.0);
        let angle = trig::degrees(trig::atan2(arm.y, arm.x)) - 90.0;
        assert!((psi - angle).abs() < 1e-12 || (psi - angle).abs() > 359.0, "{psi} {angle}");
        let turning = (arm.x * r * cos + arm.y * r * sin) / arm.norm_squared();
        assert!((ratio - turning).abs() < 1e-14);
    }
    // Driven by the slide instead, the same angles belong to the same slides.
    let linkage = actuator(0.3);
    let a = find(&linkage, "A");
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
    for i in 0..motion.circuits[0].len() {
        let circuit = &motion.circuits[0];
        let [s, length, beta, _, _]: [f64; 5] = compute_columns(&columns, &linkage, circuit, a, i).try_into().unwrap();
        assert!(s == circuit.inputs[i] && (length - (s * s + 0.09).sqrt()).abs() < 1e-13);
        assert!((beta - trig::degrees(trig::atan2(s, 0.3))).abs() < 1e-12);
    }
}

/// A slider on a fixed line has unbounded rates along it at its limit, and none across.
#[test]
fn rates_at_a_limit_are_bounded_across_a_fixed_line() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", [0.0, 0.0].into());
    let q = builder.fixed("Q", [1.0, 0.0].into());
    let a = builder.crank("A", o, 2.0).unwrap();
    let b = builder.slide("B", (a, 1.0), ([o, q], 0.0), Side::Left).unwrap();
    let linkage = builder.build(vec![b], None, MotionOptions::default()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(10)));
    let jets = motion.circuits[0].derivatives(&linkage, 0);
    assert_eq!(jets.velocity(b), Vector::new(f64::INFINITY, 0.0));
    assert_eq!(jets.jerk(b), Vector::new(f64::INFINITY, 0.0));
}

/// Through a change point the motion continues smoothly, and so do its rates: for wheels on parallel rods, whose dyads
/// are all flat at once, and for Cardan's trammel, whose crank and link are equally long.
#[test]
fn rates_are_smooth_through_change_points() {
    let mut wheels = LinkageBuilder::default();
    let o = wheels.fixed("O", [0.0, 0.0].into());
    let c = wheels.fixed("C", [3.0, 0.0].into());
    let d = wheels.fixed("D", [5.0, 0.0].into());
    let a = wheels.crank("A", o, 1.0).unwrap();
    let b = wheels.dyad("B", [a, c], [3.0, 1.0], Side::Left).unwrap();
    let e = wheels.dyad("E", [b, d], [2.0, 1.0], Side::Left).unwrap();
    // The first of their circuits keeps the rods parallel.
    let all = MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() };
    let wheels = wheels.build(vec![b, e], None, all).unwrap();
    let mut trammel = LinkageBuilder::default();
    let o = trammel.fixed("O", [0.0, 0.0].into());
    let q = trammel.fixed("Q", [1.0, 0.0].into());
    let pin = trammel.crank("A", o, 1.0).unwrap();
    let slide = trammel.slide("B", (pin, 1.0), ([o, q], 0.0), Side::Right).unwrap();
    let trammel = trammel.build(vec![slide], None, MotionOptions::default()).unwrap();
    let mut change_points = 0;
    for (linkage, joints) in [(&wheels, vec![a, b, e]), (&trammel, vec![slide])] {
        let motion = Motion::solve(linkage, &Sampler::new(Sampling::Step(15.0)));
        for i in 0..motion.circuits[0].len() {
            let circuit = &motion.circuits[0];
            let jets = circuit.derivatives(linkage, i);
            let (cos, sin) = trig::cos_sin_deg(circuit.inputs[i]);
            change_points += usize::from(circuit.passes.iter().any(|pass| pass.to.input.value == circuit.inputs[i]));
            for &joint in &joints {
                let found = [jets.velocity(joint), jets.acceleration(joint), jets.jerk(joint)];
                let slides = joint == slide && linkage.joints.len() == 4;
                // The trammel's slider is at rest on one half of its circuit, and moves as twice the cosine on the
                // other.
                let size = if slides { jets.position(joint).x / if cos.abs() > 1e-9 { cos } else { 1.0 } } else { 1.0 };
                if slides && cos.abs() < 1e-9 {
                    assert!(found[0].x.abs() < 1e-12 || (found[0].x.abs() - 2.0).abs() < 1e-12, "{}", found[0]);
                    continue;
                }
                let expected = if slides {
                    [-sin, -cos, sin].map(|rate| Vector::new(size * rate, 0.0))
                } else {
                    [Vector::new(-sin, cos), Vector::new(-cos, -sin), Vector::new(sin, -cos)]
                };
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found - expected).norm() < 1e-9, "at {}: {found} {expected}", circuit.inputs[i]);
                }
            }
        }
    }
    assert!(change_points >= 3, "only {change_points} change points were sampled");
}
