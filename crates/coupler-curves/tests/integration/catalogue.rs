//! Each linkage of the catalogue with its published proportions, and the property it is known for.

use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage, MotionOptions};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};

use crate::linkages::{check_motion, third_corner};

/// A linkage of the catalogue with its default proportions.
pub fn default_linkage(id: &str) -> Linkage {
    let template = coupler_curves::catalogue::find(id).unwrap();
    let mut values: Vec<f64> = vec![f64::NAN; template.parameters.len()];
    let index = |name: &str| template.parameters.iter().position(|p| p.name == name).unwrap();
    // Defaults may refer to one another: as many passes as there are parameters settle them.
    for _ in 0..values.len() {
        for (k, parameter) in template.parameters.iter().enumerate() {
            if let Some(default) = &parameter.default {
                values[k] = default.evaluate(|i| values[index(&default.names()[i])]);
            }
        }
    }
    template.linkage(&values).unwrap()
}

/// The first circuit of a linkage, with this many samples.
fn first_circuit(linkage: &Linkage, samples: usize) -> Circuit {
    Motion::solve(linkage, &Sampler::new(Sampling::Samples(samples))).circuits.remove(0)
}

fn joint(linkage: &Linkage, name: &str) -> JointId {
    linkage.find_joint(name).unwrap()
}

/// The least and the greatest of the values.
fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// Peaucellier's line is straight to rounding, including its ends, where all dyads of the inversor are flat at once.
#[test]
fn peaucelliers_line_is_straight_to_its_ends() {
    let template = coupler_curves::catalogue::find("peaucellier-lipkin").unwrap();
    for values in [[2.0, 5.0, 2.0], [1.0, 5.0, 3.5], [1.5, 5.0, 3.0]] {
        let linkage = template.linkage(&values).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(90)));
        let [r, arm, side] = values;
        let line = (arm * arm - side * side) / (2.0 * r);
        let circuit = &motion.circuits[0];
        assert!(circuit.is_closed);
        // Of the other assembly modes, one puts Q on P, and in two the rhombus is collapsed.
        let all = Linkage {
            motion_options: MotionOptions { circuits: CircuitSelection::All, ..linkage.motion_options.clone() },
            ..linkage.clone()
        };
        assert_eq!(Motion::solve(&all, &Sampler::new(Sampling::Samples(90))).circuits.len(), 2);
        for (i, q) in circuit.points(linkage.traced[0]).enumerate() {
            assert!((q.x - line).abs() < 1e-11 * line, "{values:?} at {}: {q} {line}", circuit.inputs[i]);
        }
    }
}

/// Hart's inversor draws a straight line too, perpendicular to the line from O to the crank's pivot.
#[test]
fn harts_line_is_straight() {
    let linkage = default_linkage("hart-inversor");
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(90)));
    // P and Q on either side of O: |OP| |OQ| = part (1 - part) (long^2 - short^2), and P's circle of radius r goes
    // through O.
    let line = 0.25 * (144.0 - 36.0) / (2.0 * 2.0);
    for circuit in &motion.circuits {
        for (i, q) in circuit.points(linkage.traced[0]).enumerate() {
            // At the limit of the first dyad, the joints that depend on it are placed less accurately.
            assert!((q.x + line).abs() < 1e-9 * line, "at {}: {q} {line}", circuit.inputs[i]);
        }
    }
}

/// Hoeken's coupler point moves on a nearly straight line, at nearly constant speed, over half a turn of the crank.
#[test]
fn hoekens_line_is_nearly_straight() {
    let linkage = default_linkage("hoeken");
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(1.0)));
    let foot: Vec<_> = motion.circuits[0].points(linkage.traced[0]).skip(90).take(181).collect();
    let (low, high) = foot.iter().fold((f64::INFINITY, 0.0f64), |(l, h), p| (l.min(p.y), h.max(p.y)));
    let length = (foot[0].x - foot[180].x).abs();
    assert!((high - low) / length < 0.01, "{low} {high} {length}");
    assert!(length > 3.9, "four cranks long: {length}");
}

/// The foot of Jansen's leg against the law of cosines, joint by joint; and its stride and its step.
#[test]
fn jansens_leg_follows_from_the_law_of_cosines() {
    let linkage = default_linkage("jansen");
    let samples = 3600;
    let circuit = first_circuit(&linkage, samples);
    let foot: Vec<Point> = circuit.points(linkage.traced[0]).collect();
    let (o, b) = (Point::new(38.0, 7.8), Point::new(0.0, 0.0));
    for (i, deg) in circuit.inputs.iter().enumerate() {
        let (cos, sin) = trig::cos_sin_deg(*deg);
        let p = o + Vector::new(cos, sin) * 15.0;
        let upper = third_corner(p, b, [50.0, 41.5], -1.0).0;
        let lower = third_corner(p, b, [61.9, 39.3], 1.0).0;
        let back = third_corner(upper, b, [55.8, 40.1], -1.0).0;
        let ankle = third_corner(back, lower, [39.4, 36.7], -1.0).0;
        let expected = third_corner(ankle, lower, [65.7, 49.0], -1.0).0;
        assert!((foot[i] - expected).norm() < 1e-11, "at {deg}: {} {expected}", foot[i]);
    }
    // No stride or step is published for Jansen's lengths; these are from an evaluation in 30 digits. The samples are
    // a tenth of a degree apart, so that an extreme is missed by less than 1e-5.
    let [left, right] = extent(foot.iter().map(|p| p.x));
    let [low, high] = extent(foot.iter().map(|p| p.y));
    assert!((right - left - 67.908_421_691_508).abs() < 1e-4, "{}", right - left);
    assert!((high - low - 22.457_173_584_316).abs() < 1e-4, "{}", high - low);
    // The foot is within 1.0 of the ground for more than two fifths of the turn, over most of the stride.
    let on_ground: Vec<&Point> = foot.iter().filter(|p| p.y < low + 1.0).collect();
    assert!((0.43..0.44).contains(&(on_ground.len() as f64 / samples as f64)));
    let [from, to] = extent(on_ground.iter().map(|p| p.x));
    assert!((to - from - 57.42).abs() < 0.02, "{}", to - from);
}

/// For the proportions of his patent's table 1, Klann gives a stride of 1.000, a step of 52.3 % and a deviation of the
/// straight part of 5.5 % (mechanicalspider.com, "Concept", case Enable001).
#[test]
fn klanns_leg_has_the_published_stride_and_step() {
    let linkage = default_linkage("klann");
    let circuit = first_circuit(&linkage, 3600);
    let foot: Vec<Point> = circuit.points(linkage.traced[0]).collect();
    // The table's pose has the foot at its origin, (-1.599, -0.750) from the crank's pivot.
    assert!((foot[1800] - Point::new(-1.599, -0.75)).norm() < 1e-12, "{}", foot[1800]);
    // The foot is on the ground during the half turn from 0.
    let stride = (foot[0] - foot[1800]).norm();
    let [left, right] = extent(foot.iter().map(|p| p.x));
    let [low, high] = extent(foot.iter().map(|p| p.y));
    let [_, highest_on_the_ground] = extent(foot[300..1800].iter().map(|p| p.y));
    assert!((stride - 1.0).abs() < 5e-4, "{stride}");
    assert!(((high - low) / (right - left) - 0.523).abs() < 5e-4, "{}", (high - low) / (right - left));
    assert!((highest_on_the_ground - low - 0.055).abs() < 5e-4, "{}", highest_on_the_ground - low);
}

#[test]
fn a_pantograph_scales_its_input_curve() {
    let linkage = default_linkage("pantograph");
    let circuit = first_circuit(&linkage, 90);
    let [f, tracer, pen] = ["F", "T", "P"].map(|name| joint(&linkage, name));
    for i in 0..circuit.len() {
        let [f, tracer, pen] = [f, tracer, pen].map(|joint| circuit.positions.point(joint, i));
        assert!((pen - f - (tracer - f) * 3.0).norm() < 1e-13, "at {}: {pen} {tracer}", circuit.inputs[i]);
    }
}

/// Norton, table P4-4, row c: crank 5 at 45 degrees, coupler 7, link 8, geared crank 4 at -0.5 of the angle, frame 3;
/// open, the coupler is at 17.6 and the link at 64.0 degrees; crossed, at -133.7 and 180.0.
#[test]
fn the_geared_five_bar_matches_nortons_table() {
    let linkage = default_linkage("geared-five-bar");
    let both = Linkage {
        motion_options: MotionOptions { circuits: CircuitSelection::All, ..linkage.motion_options.clone() },
        ..linkage
    };
    let motion = Motion::solve(&both, &Sampler::new(Sampling::Step(45.0)));
    let [a, b, d] = ["A", "B", "D"].map(|name| joint(&both, name));
    for (circuit, [coupler, link]) in motion.circuits.iter().zip([[17.6495, 63.9717], [-133.7434, 179.9344]]) {
        assert!(circuit.is_closed && circuit.len() == 16, "closes after two turns");
        let at = |joint| circuit.positions.point(joint, 1);
        let angle = |v: Vector| trig::degrees(trig::atan2(v.y, v.x));
        assert!((angle(at(b) - at(a)) - coupler).abs() < 1e-4, "{}", angle(at(b) - at(a)));
        assert!((angle(at(b) - at(d)) - link).abs() < 1e-4, "{}", angle(at(b) - at(d)));
    }
}

/// The output swing of both six-bars, and one position of the output pin, against an evaluation in 30 digits of the
/// same proportions.
#[test]
fn the_six_bars_swing_as_evaluated_in_30_digits() {
    for (id, swing, pin) in [
        ("watt-six-bar", 85.635_425_399_8, Point::new(287.202_008_252, 13.592_963_121_6)),
        ("stephenson-six-bar", 65.132_774_263_4, Point::new(280.878_032_239, 84.523_883_775_7)),
    ] {
        let linkage = default_linkage(id);
        let circuit = first_circuit(&linkage, 3600);
        let [e, q] = ["E", "Q"].map(|name| joint(&linkage, name));
        let angle = |i: usize| {
            let arm = circuit.positions.point(e, i) - circuit.positions.point(q, i);
            trig::degrees(trig::atan2(arm.y, arm.x))
        };
        let [low, high] = extent((0..circuit.len()).map(angle));
        // Samples a tenth of a degree apart miss an extreme by less than this.
        assert!((high - low - swing).abs() < 1e-4, "{id}: {}", high - low);
        assert!((circuit.positions.point(e, 600) - pin).norm() < 1e-8, "{id}: {}", circuit.positions.point(e, 600));
    }
}

/// With a slot perpendicular to its line, the yoke moves as the cosine of the crank angle.
#[test]
fn a_scotch_yoke_is_harmonic() {
    let linkage = default_linkage("scotch-yoke");
    let circuit = first_circuit(&linkage, 24);
    for (i, p) in circuit.points(linkage.traced[0]).enumerate() {
        assert!((p - Point::new(2.0 + trig::cos_sin_deg(circuit.inputs[i]).0, 0.0)).norm() < 1e-15);
    }
}

#[test]
fn every_linkage_of_the_catalogue_moves_with_its_defaults() {
    for template in coupler_curves::catalogue::all().iter().filter(|t| t.parameters.iter().all(|p| p.default.is_some()))
    {
        let linkage = default_linkage(&template.id);
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(60)));
        assert!(
            motion.is_assembled() && motion.assembly_error.is_none(),
            "{}: {:?}",
            template.id,
            motion.assembly_error
        );
        check_motion(&linkage, &motion).unwrap();
    }
}
