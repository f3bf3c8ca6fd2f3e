//! McCarthy's formulas against each other, against the thesis's vector solution, and against the kernels.

use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{
    CircuitSelection, DyadId, FourBar, InvertedSliderCrank, JointId, Linkage, LinkageBuilder, MotionOptions, Side,
};
use coupler_curves::motion::{Circuit, InputPosition, JointDerivatives, Motion, Sampler, Sampling};
use proptest::prelude::*;

fn all() -> MotionOptions {
    MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }
}

/// The absolute difference of two angles, from 0 to pi.
fn angle_difference(a: f64, b: f64) -> f64 {
    let d = a - b;
    trig::atan2(trig::sin(d), trig::cos(d)).abs()
}

fn direction(v: Vector) -> f64 {
    trig::atan2(v.y, v.x)
}

fn four_bar(bar: FourBar) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let c = builder.fixed("C", Point::new(bar.frame, 0.0));
    let a = builder.crank("A", o, bar.crank).unwrap();
    let b = builder.dyad("B", [a, c], [bar.coupler, bar.rocker], Side::Left).unwrap();
    builder.build(vec![b], None, all()).unwrap()
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn all_derivations_of_the_4r_chain_agree(l in prop::array::uniform4(0.3f64..3.0), theta in -3.1f64..3.1) {
        let bar = FourBar { frame: l[0], crank: l[1], coupler: l[2], rocker: l[3] };
        let size: f64 = l.iter().sum();
        // The roots lose digits as the dyad flattens, in proportion to its height, so nearly flat dyads are left out.
        prop_assume!(bar.solvability(theta) > 1e-3 * size * size * size * size);
        let (psi, phi) = (bar.output_angles(theta).unwrap(), bar.coupler_angles(theta).unwrap());
        let (cos, sin) = (trig::cos(theta), trig::sin(theta));
        let (a, c) = (Vector::new(cos, sin) * bar.crank, Vector::new(bar.frame, 0.0));
        for (k, branch) in [1.0, -1.0].into_iter().enumerate() {
            // The thesis's vectors, (9.1) and (9.2): rd from the rocker's pivot to the crank pin.
            let rd = a - c;
            let d = rd.norm();
            let foot = (bar.rocker * bar.rocker - bar.coupler * bar.coupler + d * d) / (2.0 * d);
            let height = branch * (bar.rocker * bar.rocker - foot * foot).sqrt();
            let unit = rd / d;
            let r2 = Vector::new(height * unit.y, -height * unit.x) + unit * (foot - d);
            let b = a + r2;
            prop_assert!(angle_difference(psi[k], direction(b - c)) < 1e-11);
            prop_assert!(angle_difference(theta + phi[k], direction(r2)) < 1e-11);
            prop_assert!(angle_difference(phi[k], bar.coupler_angle(theta, psi[k])) < 1e-11);
            let cosine = (a - b).dot(&(c - b)) / ((a - b).norm() * (c - b).norm());
            prop_assert!((bar.transmission_angle(theta).unwrap() - trig::acos(cosine)).abs() < 1e-11);
        }
    }

    #[test]
    fn the_inverted_slider_crank_follows_mccarthys_formulas(g in 0.3f64..3.0, r in 0.3f64..3.0, e in 0.05f64..2.0) {
        let formulas = InvertedSliderCrank { g, r, e };
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", Point::new(g, 0.0));
        let a = builder.crank("A", o, r).unwrap();
        let b = builder.slot("B", [c, a], e, Side::Right).unwrap();
        let m = builder.point("M", [c, a], 1.0, 0.25).unwrap();
        let linkage = builder.build(vec![m], None, all()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(7.0)));
        prop_assert_eq!(motion.is_assembled(), formulas.crank_range().is_some());
        for circuit in &motion.circuits {
            for i in 0..circuit.len() {
                let at = |j: JointId| circuit.positions.point(j, i);
                let theta = trig::radians(circuit.inputs[i]);
                let cb = at(b) - at(c);
                prop_assert!((cb.norm() - e).abs() < 1e-12);
                prop_assert!(cb.dot(&(at(a) - at(b))).abs() < 1e-12 * (g + r) * (g + r));
                let Some(size) = formulas.slide(theta) else { continue };
                if size < 1e-2 {
                    continue;
                }
                // McCarthy's slide is positive where the foot is right of C -> A.
                let s = -f64::from(circuit.mode_at(i).sign(DyadId::FIRST)) * size;
                prop_assert!(((at(a) - at(b)).norm() - size).abs() < 1e-10);
                prop_assert!(angle_difference(formulas.psi(theta, s), direction(cb)) < 1e-10);
                prop_assert!((formulas.b(s) - (at(a) - at(c)).norm()).abs() < 1e-12);
                prop_assert!((trig::cos(formulas.theta(s).unwrap()) - trig::cos(theta)).abs() < 1e-10);
                // M is on the link of the line: along the line in the sense of McCarthy's s, and to its left.
                let line = Vector::new(-cb.y, cb.x) / e;
                let expected = at(c) + line - cb / e * 0.25;
                prop_assert!((at(m) - expected).norm() < 1e-12);
            }
            if let (Some([least, _]), true) = (formulas.crank_range(), circuit.passes[0].from.flat_dyads.contains(DyadId::FIRST)) {
                let reached = trig::radians(circuit.passes[0].from.input.value);
                prop_assert!((reached.abs() - least).abs() < 1e-7 || (g - r).abs() - e < 1e-12);
            }
        }
    }

    /// The range of psi against (2.45) at many crank angles: nothing is outside, and both ends are reached.
    #[test]
    fn the_output_of_the_inverted_slider_crank_stays_in_its_range(g in 0.3f64..3.0, r in 0.3f64..3.0, e in 0.0f64..4.0) {
        let formulas = InvertedSliderCrank { g, r, e };
        let (Some([low, high]), Some([from, to])) = (formulas.psi_range(), formulas.crank_range()) else {
            prop_assert!(e > g + r);
            return Ok(());
        };
        const STEPS: usize = 4000;
        // Near a limit the slide has a root, and psi changes fast: more angles there.
        let angles = (0..=STEPS).map(|k| {
            let x = k as f64 / STEPS as f64;
            from + (to - from) * x * x
        });
        let turn = 2.0 * std::f64::consts::PI;
        let mut found = Vec::new();
        for theta in angles.flat_map(|theta| [theta, -theta]) {
            let Some(size) = formulas.slide(theta) else { continue };
            // Where both rock, a circuit has slides of both signs; otherwise this is that of the positive ones.
            let slides = if from > 0.0 { vec![size, -size] } else { vec![size] };
            for s in slides {
                let psi = formulas.psi(theta, s);
                let (turns, middle) = (high - low == turn, (low + high) / 2.0);
                let continuous = psi - turn * ((psi - middle) / turn).round();
                prop_assert!(turns || continuous > low - 1e-7 && continuous < high + 1e-7, "{continuous} {low} {high}");
                found.push(continuous);
            }
        }
        found.sort_by(f64::total_cmp);
        prop_assert!(found[0] - low < 2e-2 && high - found[found.len() - 1] < 2e-2, "{:?} {low} {high}", [found[0], found[found.len() - 1]]);
    }

    /// (4.8), and its counterpart: crank, coupler and frame make a triangle with the rocker, and the rocker rests.
    #[test]
    fn the_rocker_reverses_where_crank_and_coupler_are_collinear(l in prop::array::uniform4(0.3f64..3.0)) {
        let bar = FourBar { frame: l[0], crank: l[1], coupler: l[2], rocker: l[3] };
        for (limit, sense) in bar.rocker_limits().into_iter().zip([1.0, -1.0]) {
            let reach = bar.crank + sense * bar.coupler;
            let is_triangle = reach.abs() + bar.rocker > bar.frame && (reach.abs() - bar.rocker).abs() < bar.frame;
            prop_assert_eq!(limit.is_some(), is_triangle);
            let Some(theta) = limit else { continue };
            prop_assert!((0.0..=std::f64::consts::PI).contains(&theta));
            let b = Vector::new(trig::cos(theta), trig::sin(theta)) * reach;
            prop_assert!(((b - Vector::new(bar.frame, 0.0)).norm() - bar.rocker).abs() < 1e-11);
        }
    }

    #[test]
    fn a_slider_stays_on_its_line(crank in 0.2f64..2.0, coupler in 0.2f64..3.0, offset in -2.0f64..2.0, turn in 0.0f64..6.0) {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::new(0.3, -0.2));
        let (cos, sin) = (trig::cos(turn), trig::sin(turn));
        let p = builder.fixed("P", Point::new(0.3, -0.2));
        let q = builder.fixed("Q", Point::new(0.3 + 2.0 * cos, -0.2 + 2.0 * sin));
        let a = builder.crank("A", o, crank).unwrap();
        let b = builder.slide("B", (a, coupler), ([p, q], offset), Side::Left).unwrap();
        let linkage = builder.build(vec![b], None, all()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(5.0)));
        prop_assert_eq!(motion.is_assembled(), offset.abs() < crank + coupler);
        for circuit in &motion.circuits {
            for i in 0..circuit.len() {
                let from_o = circuit.positions.point(b, i) - circuit.positions.point(o, i);
                prop_assert!((cos * from_o.y - sin * from_o.x - offset).abs() < 1e-12);
                let link = (circuit.positions.point(b, i) - circuit.positions.point(a, i)).norm();
                prop_assert!((link - coupler).abs() < 1e-12 * (crank + coupler));
            }
            for k in 0..circuit.passes.len() {
                if circuit.passes[k].to.flat_dyads.contains(DyadId::FIRST) && circuit.is_closed {
                    // At a limit the link is perpendicular to the line.
                    let theta = trig::radians(circuit.passes[k].to.input.value);
                    let distance = offset - crank * trig::sin(theta - turn);
                    prop_assert!((distance.abs() - coupler).abs() < 1e-7);
                }
            }
        }
    }

    /// Rates in closed form against finite differences of high order, away from limits.
    #[test]
    fn rates_match_finite_differences(l in prop::array::uniform4(0.5f64..3.0), at in 0usize..720, kind in 0..3) {
        let linkage = match kind {
            0 => four_bar(FourBar { frame: l[0], crank: l[1], coupler: l[2], rocker: l[3] }),
            1 => {
                let mut builder = LinkageBuilder::default();
                let o = builder.fixed("O", Point::origin());
                let x = builder.fixed("X", Point::new(1.0, 0.4));
                let a = builder.crank("A", o, l[1]).unwrap();
                let b = builder.slide("B", (a, l[2] + 1.0), ([o, x], 0.3), Side::Left).unwrap();
                builder.build(vec![b], None, all()).unwrap()
            }
            _ => {
                let mut builder = LinkageBuilder::default();
                let o = builder.fixed("O", Point::origin());
                let c = builder.fixed("C", Point::new(l[0], 0.0));
                let a = builder.crank("A", o, l[1]).unwrap();
                let b = builder.slot("B", [c, a], 0.2, Side::Right).unwrap();
                let m = builder.point("M", [c, a], l[2], 0.3).unwrap();
                // Seen from the turning link, everything else moves.
                builder.build(vec![m], Some([c, b]), all()).unwrap()
            }
        };
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(0.5)));
        let Some(circuit) = motion.circuits.first() else { return Ok(()) };
        let inside = |i: usize| (0..=8).all(|k| i + k < circuit.len() && circuit.mode_at(i + k) == circuit.mode_at(i));
        prop_assume!(circuit.passes[0].from.flat_dyads.is_empty() && inside(at % circuit.len()));
        let i = at % circuit.len() + 4;
        let jets = JointDerivatives::new(&linkage, InputPosition::from_degrees(circuit.inputs[i]), circuit.mode_at(i));
        let h = trig::radians(0.5);
        for &joint in &linkage.traced {
            prop_assert!((jets.position(joint) - circuit.positions.point(joint, i)).norm() < 1e-12);
            // Where a joint nearly turns back, differences of the eighth order are not accurate enough.
            prop_assume!(jets.jerk(joint).norm() < 30.0);
            for (found, expected) in [
                (jets.velocity(joint), difference(circuit, joint, i, &VELOCITY) / h),
                (jets.acceleration(joint), difference(circuit, joint, i, &ACCELERATION) / (h * h)),
            ] {
                prop_assert!((found - expected).norm() < 1e-6 * (1.0 + found.norm()), "{found} {expected}");
            }
            let jerk = difference(circuit, joint, i, &JERK) / (h * h * h);
            prop_assert!((jets.jerk(joint) - jerk).norm() < 1e-3 * (1.0 + jerk.norm()));
        }
    }
}

/// Central differences of the eighth order for the first and second derivative, of the sixth for the third.
const VELOCITY: [f64; 9] = [1.0 / 280.0, -4.0 / 105.0, 0.2, -0.8, 0.0, 0.8, -0.2, 4.0 / 105.0, -1.0 / 280.0];
const ACCELERATION: [f64; 9] =
    [-1.0 / 560.0, 8.0 / 315.0, -0.2, 1.6, -205.0 / 72.0, 1.6, -0.2, 8.0 / 315.0, -1.0 / 560.0];
const JERK: [f64; 9] =
    [-7.0 / 240.0, 0.3, -169.0 / 120.0, 61.0 / 30.0, 0.0, -61.0 / 30.0, 169.0 / 120.0, -0.3, 7.0 / 240.0];

/// The central difference of a joint's positions about a sample.
fn difference(circuit: &Circuit, joint: JointId, i: usize, weights: &[f64; 9]) -> Vector {
    (0..9).map(|k| circuit.positions.point(joint, i + k - 4).coords * weights[k]).sum()
}

/// The regimes of the inverted slider-crank in closed form.
#[test]
fn the_inverted_slider_cranks_output_rocks_or_turns() {
    let range = |g, r, e| InvertedSliderCrank { g, r, e }.psi_range().map(|range| range.map(trig::degrees));
    let near = |found: Option<[f64; 2]>, expected: [f64; 2]| {
        found.is_some_and(|found| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12 * (1.0 + b.abs())))
    };
    // Without offset the line is a tangent of the crank's circle: sin 30 = 1 / 2 to either side of the normal.
    assert!(near(range(2.0, 1.0, 0.0), [60.0, 120.0]));
    assert!(near(range(1.0, 2.0, 0.0), [-180.0, 180.0]), "Whitworth's quick return");
    // g cos psi + e = 1 and -1: cosines of 1 / 4 and -3 / 4.
    let [low, high] = [0.25, -0.75].map(|cosine| trig::degrees(trig::acos(cosine)));
    assert!(near(range(2.0, 1.0, 0.5), [low, high]));
    // Both rock: the line reaches the crank's circle only up to cosine (1 - 1.5) / 2.
    let low = trig::degrees(trig::acos(-0.25));
    assert!(near(range(2.0, 1.0, 1.5), [low, 360.0 - low]));
    assert_eq!(range(2.0, 1.0, 3.5), None);
    let linkage = crate::catalogue::default_linkage("inverted-slider-crank");
    assert_eq!(InvertedSliderCrank::from_linkage(&linkage), Some(InvertedSliderCrank { g: 2.0, r: 1.0, e: 0.5 }));
    assert_eq!(InvertedSliderCrank::from_linkage(&crate::catalogue::default_linkage("klann")), None);
}

#[test]
fn rates_at_a_limit_are_unbounded() {
    let linkage = four_bar(FourBar { frame: 4.0, crank: 2.0, coupler: 2.0, rocker: 2.0 });
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(60)));
    let pass = motion.circuits[0].passes[0].clone();
    let jets = JointDerivatives::on_pass(&linkage, &pass, pass.to.input.value);
    assert!(jets.velocity(JointId::new(2)).norm().is_finite(), "the crank keeps turning");
    assert_eq!(jets.velocity(JointId::new(3)), Vector::new(f64::INFINITY, f64::INFINITY));
}

#[test]
fn columns_are_mccarthys_angles() {
    use coupler_curves::measure::{compute_columns, find_column};
    let bar = FourBar { frame: 4.0, crank: 1.0, coupler: 3.0, rocker: 3.5 };
    let linkage = four_bar(bar);
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(5.0)));
    let names = ["psi_deg", "phi_deg", "mu_deg", "solvability", "speed", "psi_ratio", "s"];
    let columns = names.map(|name| find_column(name).unwrap());
    for (k, circuit) in motion.circuits.iter().enumerate() {
        for i in 0..circuit.len() {
            let theta = trig::radians(circuit.inputs[i]);
            let values = compute_columns(&columns, &linkage, circuit, JointId::new(3), i);
            let psi = bar.output_angles(theta).unwrap()[k];
            assert!(angle_difference(trig::radians(values[0]), psi) < 1e-12);
            assert!(angle_difference(trig::radians(values[1]), bar.coupler_angle(theta, psi)) < 1e-12);
            assert!(angle_difference(trig::radians(values[2]), bar.transmission_angle(theta).unwrap()) < 1e-12);
            assert!((values[3] - bar.solvability(theta)).abs() < 1e-9);
            assert!((values[4] - values[5].abs() * bar.rocker).abs() < 1e-12, "B circles C");
            assert!(values[6].is_nan(), "there is no slide");
        }
    }
}
