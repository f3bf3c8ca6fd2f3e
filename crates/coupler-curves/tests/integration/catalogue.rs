//! Each linkage of the catalogue with its published proportions, and the property it is known for.

use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage, MotionOptions};
use coupler_curves::motion::{self, Circuit, Motion, Sampler, Sampling};

use crate::linkages::{check_motion, third_corner};
use crate::output::measures;

/// A linkage of the catalogue with its default proportions.
pub fn default_linkage(id: &str) -> Linkage {
    linkage_with(id, &[])
}

/// A linkage of the catalogue with some dimensions given, and defaults for the others.
fn linkage_with(id: &str, given: &[(&str, f64)]) -> Linkage {
    let template = coupler_curves::catalogue::find(id).unwrap();
    let index = |name: &str| template.parameters.iter().position(|p| p.name == name).unwrap();
    let mut values: Vec<f64> = vec![f64::NAN; template.parameters.len()];
    given.iter().for_each(|&(name, value)| values[index(name)] = value);
    // Defaults may refer to one another: as many passes as there are parameters settle them.
    for _ in 0..values.len() {
        for (k, parameter) in template.parameters.iter().enumerate() {
            match &parameter.default {
                Some(default) if given.iter().all(|(name, _)| *name != parameter.name) => {
                    values[k] = default.evaluate(|i| values[index(&default.names()[i])]);
                }
                _ => {}
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

fn square(x: f64) -> f64 {
    x * x
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

/// The crank turns by twice acos(g / r) in Whitworth's return stroke, and by twice acos(r / g) in that of the shaper, whose ram
/// moves as far as the lever's end swings to either side.
#[test]
fn quick_returns_have_their_time_ratios() {
    let ratio = |cos: f64| (180.0 - trig::degrees(trig::acos(cos))) / trig::degrees(trig::acos(cos));
    for (g, r) in [(1.0, 2.0), (0.8, 2.5), (1.5, 1.7)] {
        let value = measures(&linkage_with("whitworth", &[("g", g), ("r", r)]), 0, 12);
        assert!((value("time_ratio") - ratio(g / r)).abs() < 1e-11, "{g} {r}: {}", value("time_ratio"));
        assert!((value("output_stroke") - 3.0).abs() < 1e-12, "{}", value("output_stroke"));
        let value = measures(&linkage_with("shaper", &[("g", r), ("r", g)]), 0, 12);
        assert!((value("time_ratio") - ratio(g / r)).abs() < 1e-11, "{g} {r}: {}", value("time_ratio"));
        assert!((value("output_stroke") - 8.0 * g / r).abs() < 1e-12, "{}", value("output_stroke"));
    }
    assert_eq!(measures(&default_linkage("whitworth"), 0, 12)("time_ratio"), 2.0);
    assert_eq!(measures(&default_linkage("shaper"), 0, 12)("time_ratio"), 2.0);
}

/// With the bar at an angle t, its ends are at (l cos t, 0) and (0, l sin t): from a point of the bar follow the cosine and the sine,
/// and their squares add up to 1.
#[test]
fn the_trammel_draws_ellipses() {
    for [u, v] in [[1.0, 0.0], [2.0, 0.0], [1.2, 0.7], [-1.0, 0.4]] {
        let l = 3.0;
        let linkage = linkage_with("elliptic-trammel", &[("l", l), ("along", u), ("across", v)]);
        let circuit = first_circuit(&linkage, 360);
        assert!(circuit.is_closed);
        let mut quadrants = [false; 4];
        for m in circuit.points(linkage.traced[0]) {
            // M = ((l - u) cos - v sin, u sin - v cos), solved for both.
            let det = (l - u) * u - v * v;
            let [cos, sin] = [(u * m.x + v * m.y) / det, (v * m.x + (l - u) * m.y) / det];
            assert!((cos * cos + sin * sin - 1.0).abs() < 1e-12, "{u} {v}: {m}");
            quadrants[usize::from(cos > 0.0) + 2 * usize::from(sin > 0.0)] = true;
        }
        assert_eq!(quadrants, [true; 4], "the whole ellipse");
    }
}

/// The joints of the start pose of a linkage, moved by an input.
fn pose_at(linkage: &Linkage, input: f64) -> Vec<Point> {
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(12)));
    let pass = &motion.circuits[0].passes[0];
    let low = pass.from.input.value.min(pass.to.input.value);
    motion::pose(linkage, pass, input + 360.0 * ((low - input) / 360.0).ceil())
}

/// The ram is below the upper pivot by both links times the cosine of their angle. From the bottom, the knee moves as the square of
/// the crank's angle, as at the dead centre of a slider-crank, and so the ram as its fourth power.
#[test]
fn the_toggle_press_rises_as_the_fourth_power() {
    for (r, l, x) in [(0.75, 3.0, 5.0), (0.5, 2.0, 4.0)] {
        let linkage = linkage_with("toggle-press", &[("r", r), ("l", l), ("x", x)]);
        let [knee, ram] = ["K", "R"].map(|name| joint(&linkage, name));
        let circuit = first_circuit(&linkage, 72);
        assert!(circuit.is_closed);
        for i in 0..circuit.len() {
            let [knee, ram] = [knee, ram].map(|joint| circuit.positions.point(joint, i));
            assert!((ram.y - 2.0 * l + 2.0 * (l * l - knee.x * knee.x).sqrt()).abs() < 1e-12);
            assert!(ram.x.abs() < 1e-12 && ram.y > -1e-12 && knee.x < 1e-7, "{ram} {knee}");
        }
        // The coupler is as long as from the crank pin to the knee at the bottom.
        let expected = square(0.5 * r * (1.0 + r / (x - r))) / l;
        let fourth_power = square(square(trig::radians(2.0)));
        let rise = 0.5 * (pose_at(&linkage, 2.0)[ram.index()].y + pose_at(&linkage, -2.0)[ram.index()].y);
        assert!((rise / fourth_power / expected - 1.0).abs() < 5e-3, "{} {expected}", rise / fourth_power);
    }
}

/// At the limit of a four-bar whose crank r and coupler a are in line, its rocker s, at an angle mu to the coupler, is from its
/// limit by r (1 + r / a) / (2 s sin(mu)) times the square of the crank's angle. Three of them in series have an eighth power.
#[test]
fn the_dwell_of_the_eight_bar_is_an_eighth_power() {
    let linkage = default_linkage("dwell-eight-bar");
    let [g, s] = ["G", "S"].map(|name| joint(&linkage, name).index());
    let drawn = trig::degrees(trig::atan2(0.6, 0.8));
    let angle = |turn_deg: f64| {
        let pose = pose_at(&linkage, drawn + turn_deg);
        trig::atan2(pose[g].y - pose[s].y, pose[g].x - pose[s].x)
    };
    let of_square = |[r, a, s, sin]: [f64; 4]| r * (1.0 + r / a) / (2.0 * s * sin);
    // The rocker from (4, 0) to (3.2, 2.4), seen from the line through the origin and its end.
    let rocker = 6.4f64.sqrt();
    let sin = (0.8 * 2.4 + 0.6 * 0.8) / rocker;
    let [first, second, third] = [[1.0, 3.0, rocker, sin], [1.5, 2.5, 2.0, 1.0], [2.0, 3.0, 1.5, 1.0]].map(of_square);
    let turn = 4.0f64;
    let moved = 0.5 * (angle(turn).abs() + angle(-turn).abs());
    let expected = third * square(second * square(first * square(trig::radians(turn))));
    assert!((moved / expected - 1.0).abs() < 0.05, "{moved:e} {expected:e}");
    // By samples of an independent evaluation.
    let value = measures(&linkage, 0, 360);
    assert!((value("output_swing_deg") - 11.65588).abs() < 1e-3, "{}", value("output_swing_deg"));
    assert!((value("output_dwell_deg") - 123.79).abs() < 0.05, "{}", value("output_dwell_deg"));
}

/// The bucket by the law of cosines, over the stroke of its cylinder.
#[test]
fn the_excavators_bucket_follows_from_the_law_of_cosines() {
    let linkage = default_linkage("excavator");
    let circuit = first_circuit(&linkage, 100);
    let [h, p, j] = [[-2.2, 0.45], [-0.45, 0.0], [0.0, 0.0]].map(Point::from);
    let [k, l, t] = [[-0.6, 0.6], [0.05, 0.42], [1.15, -0.45]].map(Point::from);
    let mut bucket: Vec<f64> = Vec::new();
    for (i, tooth) in circuit.points(linkage.traced[0]).enumerate() {
        let idler = third_corner(h, p, [circuit.inputs[i], (k - p).norm()], 1.0).0;
        let pin = third_corner(idler, j, [(l - k).norm(), l.coords.norm()], 1.0).0;
        let expected = third_corner(pin, j, [(t - l).norm(), t.coords.norm()], 1.0).0;
        assert!((tooth - expected).norm() < 1e-12, "at {}: {tooth} {expected}", circuit.inputs[i]);
        let angle = trig::degrees(trig::atan2(pin.y, pin.x));
        assert!(bucket.last().is_none_or(|last| angle < *last), "the bucket curls as the cylinder extends");
        bucket.push(angle);
    }
    let [from, to] = [circuit.inputs[0], circuit.inputs[circuit.len() - 1]];
    assert!((from - 1.25).abs() < 1e-12 && (to - 2.25).abs() < 1e-12, "{from} {to}");
    assert!((bucket[0] - bucket[bucket.len() - 1] - 165.556).abs() < 1e-3);
}

/// The jaws keep their direction, and the tips meet at the end of the slider's way.
#[test]
fn the_grippers_jaws_stay_parallel() {
    let linkage = default_linkage("gripper");
    let circuit = first_circuit(&linkage, 100);
    let [c, u, m, n, s] = ["C", "U", "M", "N", "S"].map(|name| joint(&linkage, name));
    for i in 0..circuit.len() {
        let [c, u, m, n, s] = [c, u, m, n, s].map(|joint| circuit.positions.point(joint, i));
        assert!((u - c - Vector::new(0.8, -0.6)).norm() < 1e-11 && (m - c - Vector::new(2.6, -1.0)).norm() < 1e-11);
        assert!((m.x - n.x).abs() < 1e-11 && (m.y + n.y).abs() < 1e-11, "{m} {n}");
        // The arm RD is ahead of RC, of length 2, by acos(0.6).
        let link = (c - Point::new(0.0, 1.0)) * 0.45;
        let arm = Vector::new(0.6 * link.x - 0.8 * link.y, 0.8 * link.x + 0.6 * link.y);
        let expected = arm.x - (7.61 - square(1.0 + arm.y)).sqrt();
        assert!((s.x - expected).abs() < 1e-12 && (s.x + 3.0 - circuit.inputs[i]).abs() < 1e-12, "{s} {expected}");
    }
    let last = circuit.positions.point(m, circuit.len() - 1);
    assert!(last.y.abs() < 1e-12 && (last.x - 4.6).abs() < 1e-12, "{last}");
    assert!(circuit.positions.point(m, 0).y > 1.9);
}

/// The rack moves by the pitch radius times the column's angle, the knuckles follow by the law of cosines, and both sides are mirror
/// images of each other with the angle reversed.
#[test]
fn the_rack_steers_both_wheels() {
    let linkage = default_linkage("rack-steering");
    let circuit = &Motion::solve(&linkage, &Sampler::new(Sampling::Step(5.0))).circuits[0];
    let [left, right] = ["B", "D"].map(|name| joint(&linkage, name));
    assert_eq!((circuit.inputs[0], circuit.inputs[circuit.len() - 1]), (-450.0, 450.0));
    for i in 0..circuit.len() {
        let way = 8.0 * trig::radians(circuit.inputs[i]);
        let [b, d] = [left, right].map(|joint| circuit.positions.point(joint, i));
        let expected = third_corner(Point::new(way + 300.0, -8.0), Point::new(620.0, 150.0), [300.0, 130.0], -1.0).0;
        assert!((d - expected).norm() < 1e-10, "at {}: {d} {expected}", circuit.inputs[i]);
        let opposite = circuit.positions.point(right, circuit.len() - 1 - i);
        assert!((b.x + opposite.x).abs() < 1e-10 && (b.y - opposite.y).abs() < 1e-10, "{b} {opposite}");
    }
    // In curves the inner wheel turns further than the outer one: cot(outer) - cot(inner) is the track over the wheelbase.
    let value = measures(&linkage, 0, 90);
    let ahead = circuit.positions.point(right, 90) - Point::new(620.0, 150.0);
    let straight = trig::degrees(trig::atan2(ahead.y, ahead.x));
    let [inner, outer] = [straight - value("output_min"), value("output_max") - straight];
    assert!((inner - 34.13).abs() < 5e-3 && (outer - 27.82).abs() < 5e-3, "{inner} {outer}");
    let cot = |deg: f64| {
        let (cos, sin) = trig::cos_sin_deg(deg);
        cos / sin
    };
    assert!((1240.0 / (cot(outer) - cot(inner)) - 2952.0).abs() < 1.0);
}

/// Without a range, and with one of ten turns, a rack has no motion; a range with a problem is reported once.
#[test]
fn racks_need_a_range() {
    let text = include_str!("../../src/catalogue/rack-steering.toml");
    let range = "input = { from = \"-450 deg\", to = \"450 deg\" }";
    assert!(text.contains(range));
    for (other, expected) in [
        ("", "the rack `R` does not come back as its pinion turns"),
        ("input = { from = \"0 deg\", to = 450 }", "the unit is missing"),
    ] {
        let problems = coupler_curves::linkage_format::parse_templates(&text.replace(range, other)).unwrap_err();
        assert!(problems.len() == 1 && problems[0].message.starts_with(expected), "{problems:?}");
    }
    let ten_turns = text.replace("450 deg", "1800 deg");
    let template = coupler_curves::linkage_format::parse_templates(&ten_turns).unwrap().remove(0);
    let values = [8.0, 300.0, 300.0, 130.0, 620.0, 150.0];
    let error = template.linkage(&values).unwrap_err().to_string();
    assert!(error.contains("no range of the input of less than 10 turns"), "{error}");
}

/// The second dyad of each form by the law of cosines.
#[test]
fn the_other_six_bars_follow_from_the_law_of_cosines() {
    let (o, c) = (Point::new(0.0, 0.0), Point::new(4.0, 0.0));
    let on = |p: Point, q: Point, [along, across]: [f64; 2]| {
        let unit = (q - p).normalize();
        p + unit * along + Vector::new(-unit.y, unit.x) * across
    };
    for id in ["watt-i-six-bar", "watt-i-six-bar-by-ternary", "stephenson-i-six-bar", "watt-ii-six-bar-by-ternary"] {
        let linkage = default_linkage(id);
        let circuit = first_circuit(&linkage, 90);
        let end = joint(&linkage, if id.starts_with("watt-ii") { "E" } else { "F" });
        assert!(circuit.is_closed);
        for i in 0..circuit.len() {
            let (cos, sin) = trig::cos_sin_deg(circuit.inputs[i]);
            let crank = |r: f64| o + Vector::new(cos, sin) * r;
            let a = crank(1.5);
            let b = third_corner(a, c, [3.5, 3.0], 1.0).0;
            let expected = match id {
                "watt-i-six-bar" => third_corner(on(a, b, [1.75, 2.0]), on(c, b, [3.0, -1.5]), [3.0, 3.5], 1.0),
                "watt-i-six-bar-by-ternary" => {
                    third_corner(on(o, a, [1.0, 0.5]), on(a, b, [1.75, 2.0]), [2.5, 2.5], 1.0)
                }
                "stephenson-i-six-bar" => third_corner(on(o, a, [0.5, -1.0]), on(c, b, [2.5, -1.5]), [4.0, 3.5], 1.0),
                _ => third_corner(on(o, crank(1.0), [-0.5, 1.0]), Point::new(-3.5, -1.0), [4.0, 2.5], -1.0),
            };
            let found = circuit.positions.point(end, i);
            assert!((found - expected.0).norm() < 1e-11, "{id} at {}: {found} {}", circuit.inputs[i], expected.0);
        }
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
