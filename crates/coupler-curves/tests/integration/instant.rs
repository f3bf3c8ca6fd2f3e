//! The instantaneous geometry of a coupler's motion against closed forms.

use coupler_curves::geometry::{Point, Vector, cross, trig};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::measure::{compute_columns, find_column};
use coupler_curves::motion::{Circuit, InstantaneousMotion, Motion, Sampler, Sampling};
use proptest::prelude::*;

/// Joints: O, C, A, B and a coupler point M.
fn four_bar([frame, crank, coupler, rocker]: [f64; 4], along: f64, across: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let c = builder.fixed("C", Point::new(frame, 0.0));
    let a = builder.crank("A", o, crank).unwrap();
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).unwrap();
    let m = builder.point("M", [a, b], along, across).unwrap();
    let options = MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() };
    builder.build(vec![m], None, options).unwrap()
}

const O: JointId = JointId::new(0);
const C: JointId = JointId::new(1);
const A: JointId = JointId::new(2);
const B: JointId = JointId::new(3);
const M: JointId = JointId::new(4);

fn motion(linkage: &Linkage, samples: usize) -> Motion {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(samples)))
}

fn instant_at(linkage: &Linkage, circuit: &Circuit, sample: usize) -> InstantaneousMotion {
    InstantaneousMotion::from_joint(linkage, &circuit.derivatives(linkage, sample), M).unwrap()
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn the_instantaneous_geometry_agrees_with_the_derivatives(
        lengths in prop::array::uniform4(0.5f64..4.0), (along, across) in (-2.0f64..2.0, -2.0f64..2.0),
    ) {
        let linkage = four_bar(lengths, along, across);
        let columns = ["curvature", "curvature_rate"].map(|name| find_column(name).unwrap());
        for circuit in &motion(&linkage, 24).circuits {
            for sample in 0..circuit.len() {
                let jets = circuit.derivatives(&linkage, sample);
                let (Some(instant), Some(from_link)) =
                    (InstantaneousMotion::from_joint(&linkage, &jets, M), InstantaneousMotion::from_link(&jets, [A, B])) else { continue };
                let p = |joint| circuit.positions.point(joint, sample);
                // Kennedy: the pole is on the lines of crank and rocker.
                let size = (instant.pole - p(O)).norm() + 10.0;
                prop_assert!(cross(p(A) - p(O), instant.pole - p(O)).abs() < 1e-9 * size * size);
                prop_assert!(cross(p(B) - p(C), instant.pole - p(C)).abs() < 1e-9 * size * size);
                // Where the pole is far away, or the input near a limit, both computations lose digits.
                let speed = jets.velocity(B).norm();
                if size > 100.0 || speed > 10.0 {
                    continue;
                }
                let near = |a: f64, b: f64, unit: f64| (a - b).abs() <= 1e-7 * (a.abs() + unit);
                prop_assert!((instant.pole - from_link.pole).norm() < 1e-9 * size);
                prop_assert!((instant.inflection_diameter - from_link.inflection_diameter).norm() < 1e-8 * (instant.inflection_diameter.norm() + size));
                // At the pole a path has a cusp, where the denominator vanishes as the sixth power of the distance.
                for point in [p(A), p(B), p(M)].into_iter().filter(|p| (p - instant.pole).norm() > 0.3) {
                    prop_assert!(near(instant.curvature_rate(point), from_link.curvature_rate(point), 1.0));
                }
                // Pins move on circles, whose curvature does not change.
                let radius = |pin: JointId, pivot: JointId| (p(pin) - p(pivot)).norm();
                for (pin, radius) in [(A, radius(A, O)), (B, radius(B, C))] {
                    if (p(pin) - instant.pole).norm() > 0.1 {
                        prop_assert!(near(instant.curvature(p(pin)).abs(), 1.0 / radius, 0.0));
                        prop_assert!(instant.curvature_rate(p(pin)).abs() < 1e-6);
                    }
                }
                let computed = compute_columns(&columns, &linkage, circuit, M, sample);
                if (p(M) - instant.pole).norm() > 0.1 {
                    prop_assert!(near(instant.curvature(p(M)), computed[0], 1.0), "{} {}", instant.curvature(p(M)), computed[0]);
                    prop_assert!(near(instant.curvature_rate(p(M)), computed[1], 1.0));
                }
                // Points of the inflection circle have no curvature, those of the cubic of stationary curvature a
                // stationary one, and Ball's point both.
                let d = instant.inflection_diameter;
                if d.norm() < 0.05 {
                    continue;
                }
                let middle = instant.pole + d / 2.0;
                for k in 1..8 {
                    let (cos, sin) = trig::cos_sin_deg(45.0 * f64::from(k) + 10.0);
                    let turned = Vector::new(cos * d.x - sin * d.y, sin * d.x + cos * d.y) / 2.0;
                    let point = middle + turned;
                    if (point - instant.pole).norm() > 0.1 * d.norm() {
                        prop_assert!(instant.curvature(point).abs() * d.norm() < 1e-9);
                    }
                    if let Some(point) = instant.cubic_point(turned)
                        && (0.1..100.0).contains(&((point - instant.pole).norm() / d.norm()))
                    {
                        prop_assert!(instant.curvature_rate(point).abs() * d.norm_squared() < 1e-8);
                    }
                }
                if let Some(ball) = instant.ball_point()
                    && (ball - instant.pole).norm() > 0.1 * d.norm()
                {
                    prop_assert!(instant.curvature(ball).abs() * d.norm() < 1e-9);
                    prop_assert!(instant.curvature_rate(ball).abs() * d.norm_squared() < 1e-8);
                }
            }
        }
    }
}

/// The moving centrode rolls on the fixed one: per radian of coupler rotation both poles move by the inflection
/// circle's diameter.
#[test]
fn centrodes_roll_on_each_other() {
    let linkage = four_bar([4.0, 1.0, 3.0, 3.5], 1.0, 1.0);
    let motion = motion(&linkage, 3600);
    let circuit = &motion.circuits[0];
    for sample in (1..3599).step_by(50) {
        let [before, here, after] = [sample - 1, sample, sample + 1].map(|k| instant_at(&linkage, circuit, k));
        let angle = |k: usize| {
            let arm = circuit.positions.point(B, k) - circuit.positions.point(A, k);
            trig::atan2(arm.y, arm.x)
        };
        // Central differences, whose error goes with the square of the step of a tenth of a degree.
        let turned = angle(sample + 1) - angle(sample - 1);
        let fixed = (after.pole - before.pole) / turned;
        let moving = (after.moving_pole - before.moving_pole) / turned;
        let size = here.pole_tangent().norm();
        if turned.abs() > 1e-5 && size < 50.0 {
            assert!((fixed + here.pole_tangent()).norm() < 1e-3 * (size + 1.0), "{fixed} {}", here.pole_tangent());
            assert!((moving.norm() - size).abs() < 1e-3 * (size + 1.0), "{} {size}", moving.norm());
        }
    }
}

/// The centrodes of an antiparallelogram with its short links opposite are two equal ellipses, with the pivots and the
/// pins for foci, and the long link for major axis (Reuleaux, The Kinematics of Machinery, section 22).
#[test]
fn the_centrodes_of_an_antiparallelogram_are_ellipses() {
    let linkage = four_bar([1.0, 2.0, 1.0, 2.0], 0.5, 0.0);
    let mut seen = 0;
    for circuit in &motion(&linkage, 90).circuits {
        for sample in 0..circuit.len() {
            let p = |joint| circuit.positions.point(joint, sample);
            let is_parallel = (p(A) - p(O) - (p(B) - p(C))).norm() < 1e-6;
            if is_parallel || cross(p(A) - p(O), p(B) - p(C)).abs() < 1e-3 {
                continue;
            }
            let instant = instant_at(&linkage, circuit, sample);
            assert!(((instant.pole - p(O)).norm() + (instant.pole - p(C)).norm() - 2.0).abs() < 1e-10);
            assert!(((instant.pole - p(A)).norm() + (instant.pole - p(B)).norm() - 2.0).abs() < 1e-10);
            seen += 1;
        }
    }
    assert!(seen > 60);
}

/// At a limit crank pin, coupler and rocker lie on one line: the coupler turns about the pin, which is at rest.
#[test]
fn at_a_limit_the_coupler_turns_about_the_crank_pin() {
    let linkage = four_bar([4.0, 2.0, 2.0, 2.0], 1.0, 0.7);
    let motion = motion(&linkage, 40);
    let circuit = &motion.circuits[0];
    let limit = (0..circuit.len()).find(|&k| circuit.inputs[k] == circuit.passes[0].to.input.value).unwrap();
    let instant = instant_at(&linkage, circuit, limit);
    assert!((instant.pole - circuit.positions.point(A, limit)).norm() < 1e-9);
    let names = ["pole_x", "pole_y", "moving_pole_x", "moving_pole_y", "inflection_x", "inflection_y"];
    let computed = compute_columns(&names.map(|name| find_column(name).unwrap()), &linkage, circuit, M, limit);
    let pole = circuit.positions.point(A, limit);
    assert!((computed[0] - pole.x).abs() < 1e-9 && (computed[1] - pole.y).abs() < 1e-9);
    assert!(Vector::new(computed[2], computed[3]).norm() < 1e-9 && computed[4].is_finite() && computed[5].is_finite());
}
