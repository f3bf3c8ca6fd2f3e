//! The input torque against a load: closed forms, the balance of energy, and brute force by finite differences of poses.

use std::f64::consts::PI;

use coupler_curves::geometry::{Orientation, Vector, trig};
use coupler_curves::linkage::{CircuitSelection, Linkage, Load};
use coupler_curves::measure::{Measure, TracedCurve, Value, compute_columns, find_column, input_torque};
use coupler_curves::motion::{Circuit, JointDerivatives, Motion, Pass, Sampler, Sampling, pose};

use crate::catalogue::default_linkage;
use crate::output::{four_bar, slider_crank};

/// A linkage with a force of a magnitude on a joint, in a direction in degrees or against its motion.
fn loaded(linkage: Linkage, joint: &str, force: f64, direction_deg: Option<f64>) -> Linkage {
    let joint = linkage.find_joint(joint).unwrap_or_else(|| panic!("{joint}"));
    Linkage { load: Some(Load { joint, force, direction_deg }), ..linkage }
}

fn solve(linkage: &Linkage) -> Motion {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(72)))
}

/// The greatest magnitude, the input there, the least and the greatest torque on a circuit.
fn torques(linkage: &Linkage, motion: &Motion, circuit: usize) -> [f64; 4] {
    let curve = TracedCurve::new(linkage, motion, &motion.circuits[circuit], linkage.traced[0]);
    let keys = [Measure::TORQUE_PEAK, Measure::TORQUE_PEAK_DEG, Measure::TORQUE_MIN, Measure::TORQUE_MAX];
    keys.map(|key| curve.measure(key).unwrap_or_else(|| panic!("{} has no value", key.name)))
}

/// The torque at an input of a pass.
fn torque_at(linkage: &Linkage, pass: &Pass, input: f64) -> f64 {
    input_torque(linkage, pass, &JointDerivatives::on_pass(linkage, pass, input)).unwrap()
}

/// Inputs of a pass of a closed circuit with the weights of a quadrature of functions that are smooth around it, also through limits, where
/// the torque is the inverse of the root of the input; the weights are signed, and in radians or units of length.
fn quadrature(linkage: &Linkage, circuit: &Circuit, pass: &Pass, count: usize) -> Vec<(f64, f64)> {
    let (from, to) = (pass.from.input.value, pass.to.input.value);
    let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
    let unit = if linkage.input() == coupler_curves::linkage::Input::Length { 1.0 } else { trig::radians(1.0) };
    let node = |k: usize| {
        let share = (k as f64 + 0.5) / count as f64;
        if circuit.is_full_turn() {
            return (from + 2.0 * half * share, 2.0 * half * unit / count as f64);
        }
        let angle = PI * (share - 0.5);
        (middle + half * trig::sin(angle), half * unit * trig::cos(angle) * PI / count as f64)
    };
    (0..count).map(node).collect()
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1e-3), "{found} {expected}");
}

/// Norton, Design of Machinery, 13.8: the torque of a force F on the piston is F r sin(t) (1 + r cos(t) / sqrt(l^2 - r^2 sin^2(t))).
#[test]
fn a_force_on_a_slider_is_the_textbook_torque() {
    let (crank, coupler, force) = (1.0, 3.0, 250.0);
    let linkage = loaded(slider_crank([crank, coupler, 0.0]), "B", force, Some(0.0));
    let motion = solve(&linkage);
    let torque = |deg: f64| {
        let (sin, cos) = (trig::sin(trig::radians(deg)), trig::cos(trig::radians(deg)));
        force * crank * sin * (1.0 + crank * cos / (coupler * coupler - crank * crank * sin * sin).sqrt())
    };
    let column = find_column("torque").unwrap();
    let circuit = &motion.circuits[0];
    for sample in 0..circuit.len() {
        let found = compute_columns(&[column], &linkage, circuit, linkage.traced[0], sample)[0];
        assert!((found - torque(circuit.inputs[sample])).abs() < 1e-9 * force, "{found}");
    }
    // Golden sections, to where the values differ by less than their rounding.
    let [mut low, mut high] = [0.0, 180.0];
    for _ in 0..200 {
        let [a, b] = [0.382, 0.618].map(|part| low + (high - low) * part);
        if torque(a) > torque(b) { high = b } else { low = a }
    }
    let greatest = torque(low);
    let [peak, at, least, most] = torques(&linkage, &motion, 0);
    near(peak, greatest, 1e-12);
    near(at, low, 1e-6);
    near(most, greatest, 1e-12);
    near(least, -greatest, 1e-12);
    // A force across the line does no work.
    let across = loaded(slider_crank([crank, coupler, 0.2]), "B", force, Some(90.0));
    assert_eq!(torques(&across, &solve(&across), 0), [0.0; 4]);
}

#[test]
fn a_scotch_yoke_is_a_sine() {
    let linkage = loaded(default_linkage("scotch-yoke"), "Y", 40.0, Some(0.0));
    let [peak, at, least, most] = torques(&linkage, &solve(&linkage), 0);
    near(peak, 40.0, 1e-12);
    near(at, 90.0, 1e-7);
    near(least, -40.0, 1e-12);
    near(most, 40.0, 1e-12);
}

/// A force against the motion of the crank's pin is a constant torque, and on any joint its work over a turn is the force times the length.
#[test]
fn a_force_against_the_motion_brakes() {
    let linkage = loaded(four_bar([4.0, 1.0, 3.0, 3.5]), "A", 7.0, None);
    let motion = solve(&linkage);
    let [peak, _, least, most] = torques(&linkage, &motion, 0);
    [peak, least, most].into_iter().for_each(|torque| near(torque, 7.0, 1e-12));
    let linkage = loaded(default_linkage("hoeken"), "M", 7.0, None);
    let motion = solve(&linkage);
    let pass = &motion.circuits[0].passes[0];
    let nodes = quadrature(&linkage, &motion.circuits[0], pass, 2000);
    let work: f64 = nodes.iter().map(|&(input, weight)| weight * torque_at(&linkage, pass, input)).sum();
    let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
    near(work, 7.0 * curve.measure(Measure::LENGTH).unwrap(), 1e-9);
}

/// Linkages of all kinds with a joint that is loaded: dyads, gears, sliders, an actuator, and joints that are placed together.
const LINKAGES: [(&str, &str); 9] = [
    ("rocking four-bar", "B"),
    ("hoeken", "M"),
    ("gripper", "M"),
    ("slider-crank", "M"),
    ("geared-five-bar", "B"),
    ("jansen", "G"),
    ("linear-actuator", "M"),
    ("eight-bar-class-iii", "M"),
    ("stephenson-ii-six-bar", "P"),
];

fn joint_of<'a>(linkage: &'a Linkage, name: &'a str) -> &'a str {
    if linkage.find_joint(name).is_some() { name } else { &linkage.joints[linkage.traced[0]].name }
}

fn with_load(id: &str, joint: &str, direction_deg: Option<f64>) -> Linkage {
    let linkage = if id == "rocking four-bar" { four_bar([3.0, 2.0, 1.5, 2.2]) } else { default_linkage(id) };
    let joint = joint_of(&linkage, joint).to_owned();
    loaded(linkage, &joint, 10.0, direction_deg)
}

#[test]
fn a_force_that_keeps_its_direction_does_no_work_on_a_closed_circuit() {
    for (id, joint) in LINKAGES {
        let linkage = with_load(id, joint, Some(25.0));
        for circuit in solve(&linkage).circuits.iter().filter(|circuit| circuit.is_closed) {
            let [mut work, mut whole] = [0.0; 2];
            for pass in &circuit.passes {
                for (input, weight) in quadrature(&linkage, circuit, pass, 600) {
                    let part = weight * torque_at(&linkage, pass, input);
                    (work, whole) = (work + part, whole + part.abs());
                }
            }
            assert!(work.abs() < 1e-9 * whole, "{id}: {work} of {whole}");
        }
    }
}

/// The torques by differences of poses at a thousand inputs of each pass, denser towards its ends.
fn sampled_torques(linkage: &Linkage, circuit: &Circuit) -> Vec<(f64, f64)> {
    const COUNT: usize = 1000;
    let load = linkage.load.unwrap();
    let force = load.direction_deg.map(|deg| {
        let (cos, sin) = trig::cos_sin_deg(deg);
        linkage.placement.transform_vector(Vector::new(cos, sin)) * load.force
    });
    let is_length = linkage.input() == coupler_curves::linkage::Input::Length;
    let mut found = Vec::new();
    for pass in &circuit.passes {
        let [low, high] = pass.input_range();
        for k in 1..COUNT {
            let share = (1.0 - trig::cos(PI * k as f64 / COUNT as f64)) / 2.0;
            let input = low + (high - low) * share;
            let step = (high - low) * 1e-3 * share.min(1.0 - share).min(1e-3);
            let [before, after] = [input - step, input + step].map(|input| pose(linkage, pass, input)[load.joint]);
            let velocity = (after - before) / (2.0 * if is_length { step } else { trig::radians(step) });
            let torque = match force {
                Some(force) => -force.dot(&velocity),
                None => load.force * velocity.norm() * pass.input_direction(),
            };
            found.push((input, torque));
        }
    }
    found
}

#[test]
fn extremes_are_those_of_a_thousand_poses() {
    for (id, joint) in LINKAGES {
        for direction_deg in [None, Some(25.0), Some(-90.0)] {
            let linkage = with_load(id, joint, direction_deg);
            let motion = solve(&linkage);
            for (k, circuit) in motion.circuits.iter().enumerate() {
                let [peak, at, least, most] = torques(&linkage, &motion, k);
                let samples = sampled_torques(&linkage, circuit);
                let of = |pick: fn(f64, f64) -> f64, from| samples.iter().map(|(_, torque)| *torque).fold(from, pick);
                let (low, high) = (of(f64::min, f64::INFINITY), of(f64::max, f64::NEG_INFINITY));
                let scale = low.abs().max(high.abs());
                let name = format!("{id} {direction_deg:?} {k}: {least} {low}, {most} {high}");
                assert!(least <= low + 1e-5 * scale && most >= high - 1e-5 * scale, "{name}");
                assert_eq!(peak, least.abs().max(most.abs()), "{name}");
                // Where no limit is passed they are reached.
                if least.is_finite() {
                    assert!(low - least <= 5e-3 * (high - low).max(1e-3 * scale), "{name}");
                }
                if most.is_finite() {
                    assert!(most - high <= 5e-3 * (high - low).max(1e-3 * scale), "{name}");
                }
                if peak.is_finite() {
                    let period = linkage.input().period();
                    let passes = circuit.passes.iter();
                    let found = passes.filter_map(|pass| {
                        let [low, high] = pass.input_range();
                        let input = if circuit.is_full_turn() { low + (at - low).rem_euclid(period) } else { at };
                        (input >= low - 1e-9 && input <= high + 1e-9)
                            .then(|| torque_at(&linkage, pass, input.clamp(low, high)).abs())
                    });
                    let greatest = found.fold(0.0, f64::max);
                    assert!((greatest - peak).abs() <= 1e-8 * peak, "{name}: {greatest} at {at}, not {peak}");
                } else {
                    assert!(circuit.limit_count() > 0, "{name}");
                }
            }
        }
    }
}

/// At a limit where the crank and the coupler are in line the rocker's pin moves on, and the crank's pin does not.
#[test]
fn torques_at_limits_are_infinite_where_the_joint_passes() {
    let rocking = [3.0, 2.0, 1.5, 2.2];
    let passing = loaded(four_bar(rocking), "B", 1.0, Some(40.0));
    let motion = solve(&passing);
    assert!(motion.circuits[0].limit_count() > 0);
    let [peak, at, least, most] = torques(&passing, &motion, 0);
    assert_eq!([peak, least, most], [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY]);
    let limits = motion.circuits[0].passes.iter().flat_map(|pass| pass.input_range());
    assert!(limits.into_iter().any(|limit| (limit - at).abs() < 1e-9), "{at}");
    let resting = loaded(four_bar(rocking), "A", 1.0, Some(90.0));
    let [peak, _, least, most] = torques(&resting, &solve(&resting), 0);
    // The crank of 2 rocks through 0.
    near(peak, 2.0, 1e-12);
    near(least, -2.0, 1e-12);
    assert!(most < 2.0, "{most}");
    let against = loaded(four_bar(rocking), "A", 1.0, None);
    let [_, _, least, most] = torques(&against, &solve(&against), 0);
    near(least, -2.0, 1e-9);
    near(most, 2.0, 1e-9);
}

/// A torque is a force times a length, the same in a mirrored or turned linkage and with other samples.
#[test]
fn torques_are_invariant() {
    for direction_deg in [None, Some(-70.0)] {
        let lengths = [4.0, 1.0, 3.0, 3.5];
        let plain = loaded(four_bar(lengths), "B", 3.0, direction_deg);
        let before = torques(&plain, &solve(&plain), 0);
        let larger = loaded(four_bar(lengths.map(|length| 2.5 * length)), "B", 3.0, direction_deg);
        let placed = Linkage { placement: Orientation::new(true, 31.0), ..larger };
        let motion = Motion::solve(&placed, &Sampler::new(Sampling::Samples(997)));
        let after = torques(&placed, &motion, 0);
        for (k, factor) in [2.5, 1.0, 2.5, 2.5].into_iter().enumerate() {
            near(after[k], factor * before[k], 1e-9);
        }
        let finer = Motion::solve(&plain, &Sampler::new(Sampling::Samples(5000)));
        assert_eq!(torques(&plain, &finer, 0), before);
    }
}

#[test]
fn without_a_load_there_is_no_torque() {
    let linkage = default_linkage("hoeken");
    let motion = solve(&linkage);
    let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
    assert_eq!((Measure::TORQUE_PEAK.compute)(&curve), Value::Missing);
    let column = find_column("torque").unwrap();
    assert!(compute_columns(&[column], &linkage, &motion.circuits[0], linkage.traced[0], 3)[0].is_nan());
    assert_eq!(linkage.motion_options.circuits, CircuitSelection::Start);
}

/// Q of an inversor moves along a straight line: a force across it needs no torque, at samples next to limits and in between.
#[test]
fn a_force_across_a_straight_line_needs_no_torque() {
    for (id, direction) in [("peaucellier-lipkin", 0.0), ("peaucellier-lipkin", 180.0), ("hart-inversor", 0.0)] {
        let linkage = loaded(default_linkage(id), "Q", 1000.0, Some(direction));
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::DenseAtLimits(1440)));
        let column = find_column("torque").unwrap();
        for (k, circuit) in motion.circuits.iter().enumerate() {
            let all =
                (0..circuit.len()).map(|k| compute_columns(&[column], &linkage, circuit, linkage.traced[0], k)[0]);
            // At a limit itself, the joint passes it along the line.
            let most = all.filter(|torque| torque.is_finite()).fold(0.0f64, |most, torque| most.max(torque.abs()));
            assert_eq!(most, 0.0, "{id}");
            let [peak, _, least, greatest] = torques(&linkage, &motion, k);
            assert_eq!([peak, least, greatest], [0.0; 3], "{id}");
        }
    }
}

/// The pin P of the inversor's crank, of length r, reaches the angle t from the line of both pivots where OP = 2 r cos(t / 2) is arm - side.
#[test]
fn the_torque_at_a_limit_is_as_exact_as_elsewhere() {
    let linkage = loaded(default_linkage("peaucellier-lipkin"), "P", 1000.0, Some(0.0));
    let motion = solve(&linkage);
    // r = 5, arm = 15 and side = 6: the cosine of half the angle is 0.9.
    let expected = 1000.0 * 5.0 * 2.0 * 0.9 * (1.0f64 - 0.81).sqrt();
    let [peak, _, least, greatest] = torques(&linkage, &motion, 0);
    near(peak, expected, 1e-12);
    near(least, -expected, 1e-12);
    near(greatest, expected, 1e-12);
}
