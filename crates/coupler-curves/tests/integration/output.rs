//! The motion of the output link, against closed forms of textbook linkages.

use coupler_curves::geometry::{Point, Vector, trig};
use coupler_curves::linkage::{
    CircuitSelection, DwellBand, FourBar, JointId, Linkage, LinkageBuilder, MotionOptions, OutputLink, PlacedFourBar,
    Side,
};
use coupler_curves::measure::{self, TracedCurve, Value, output_limit_poses};
use coupler_curves::motion::{Motion, Sampler, Sampling};

use crate::catalogue::default_linkage;

pub fn all() -> MotionOptions {
    MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }
}

/// The measures of the first traced joint on a circuit, by name; NaN where one does not apply.
pub fn measures(linkage: &Linkage, circuit: usize, samples: usize) -> impl Fn(&str) -> f64 + use<> {
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(samples)));
    let curve = TracedCurve::new(linkage, &motion, &motion.circuits[circuit], linkage.traced[0]);
    let is_tested = |name: &str| OUTPUT_MEASURES.contains(&name) || name.starts_with("mu_");
    let tested = measure::ALL.iter().filter(|measure| is_tested(measure.name));
    let values: Vec<(&str, Value)> = tested.map(|measure| (measure.name, (measure.compute)(&curve))).collect();
    move |name| {
        let (_, value) = values.iter().find(|(known, _)| *known == name).unwrap_or_else(|| panic!("{name}"));
        if let Value::Number(value) = value { *value } else { f64::NAN }
    }
}

pub const OUTPUT_MEASURES: [&str; 13] = [
    "output_min",
    "output_max",
    "output_swing_deg",
    "output_stroke",
    "mu_worst_deg",
    "time_ratio",
    "output_dwell_deg",
    "output_dwell_start_deg",
    "toggles",
    "velocity_ratio_min",
    "velocity_ratio_max",
    "mechanical_advantage_min",
    "mechanical_advantage_max",
];

pub fn four_bar([frame, crank, coupler, rocker]: [f64; 4]) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let c = builder.fixed("C", Point::new(frame, 0.0));
    let a = builder.crank("A", o, crank).unwrap();
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).unwrap();
    builder.build(vec![b], None, all()).unwrap()
}

pub fn slider_crank([crank, coupler, offset]: [f64; 3]) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let x = builder.fixed("X", Point::new(1.0, 0.0));
    let a = builder.crank("A", o, crank).unwrap();
    let b = builder.slide("B", (a, coupler), ([o, x], offset), Side::Left).unwrap();
    builder.build(vec![b], None, all()).unwrap()
}

/// A slot about C on the crank's pin, and a point D of its link.
fn quick_return(crank: f64, frame: f64) -> (LinkageBuilder, [JointId; 3], JointId) {
    let mut builder = LinkageBuilder::default();
    let c = builder.fixed("C", Point::new(0.0, 0.0));
    let x = builder.fixed("X", Point::new(1.0, 0.0));
    let o = builder.fixed("O", Point::new(0.0, frame));
    let a = builder.crank("A", o, crank).unwrap();
    builder.slot("S", [c, a], 0.0, Side::Right).unwrap();
    let d = builder.point("D", [c, a], 1.0, 0.0).unwrap();
    (builder, [c, x, a], d)
}

pub fn acos_deg(cos: f64) -> f64 {
    trig::degrees(trig::acos(cos))
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} {expected}");
}

/// The slider is furthest and nearest where crank and coupler are in line, at a distance of their sum and of their
/// difference from the pivot (Norton, Design of Machinery, §4.6; Uicker, Pennock and Shigley, §2.9).
#[test]
fn slider_cranks_have_closed_forms() {
    for [r, l, e] in [[1.0, 3.0, 0.0], [1.0, 3.0, 0.7], [40.0, 145.0, -25.0], [1.0, 1.5, 0.4999]] {
        let value = measures(&slider_crank([r, l, e]), 0, 7);
        let reach = |sum: f64| (sum * sum - e * e).sqrt();
        near(value("output_max"), reach(l + r), 1e-13);
        near(value("output_min"), reach(l - r), 1e-13);
        near(value("output_stroke"), reach(l + r) - reach(l - r), 1e-13);
        let crank_angle = |sum: f64| trig::degrees(trig::asin(e.abs() / sum));
        let difference = crank_angle(l - r) - crank_angle(l + r);
        near(value("time_ratio"), (180.0 + difference) / (180.0 - difference), 1e-12);
        assert_eq!(value("toggles"), 2.0);
        assert_eq!(value("mechanical_advantage_max"), f64::INFINITY);
        assert!(value("output_swing_deg").is_nan());
        // The complement of the greatest pressure angle. Near 0 the arc cosine magnifies rounding.
        let worst = (r + e.abs()) / l;
        near(value("mu_worst_deg"), acos_deg(worst), 1e-13 / (1.0 - worst * worst).sqrt());
    }
    // In line, the slider is fastest where crank and coupler are nearly at right angles; by brute force.
    let (r, l) = (1.0, 3.0);
    let rate = |deg: f64| {
        let (cos, sin) = trig::cos_sin_deg(deg);
        -r * sin - r * r * sin * cos / (l * l - r * r * sin * sin).sqrt()
    };
    let fastest = (0..3_600_000).map(|k| rate(f64::from(k) / 1e4).abs()).fold(0.0, f64::max);
    let value = measures(&slider_crank([r, l, 0.0]), 0, 7);
    near(value("velocity_ratio_max"), fastest, 1e-11);
    near(value("velocity_ratio_min"), -fastest, 1e-11);
    near(value("mechanical_advantage_min"), 1.0 / fastest, 1e-11);
}

/// The yoke of a Scotch yoke moves as the cosine of the crank angle.
#[test]
fn a_scotch_yoke_is_harmonic() {
    let linkage = default_linkage("scotch-yoke");
    let value = measures(&linkage, 0, 12);
    near(value("output_stroke"), 2.0, 1e-14);
    near(value("output_min"), -1.0, 1e-14);
    near(value("time_ratio"), 1.0, 1e-12);
    near(value("velocity_ratio_max"), 1.0, 1e-13);
    near(value("mechanical_advantage_min"), 1.0, 1e-13);
    assert_eq!((value("toggles"), value("mu_worst_deg")), (2.0, 90.0));
    // Within 0.01 of the stroke of a dead centre: 1 - cos of half the dwell is 0.02.
    near(value("output_dwell_deg"), 2.0 * acos_deg(0.98), 1e-9);
    // A third of the stroke, and a length that is greater than the stroke.
    for (dwell, expected) in [
        (DwellBand::Share(1.0 / 3.0), 2.0 * acos_deg(1.0 / 3.0)),
        (DwellBand::Length(0.5), 2.0 * acos_deg(0.5)),
        (DwellBand::Length(2.5), 360.0),
    ] {
        let value = measures(&Linkage { dwell, ..linkage.clone() }, 0, 12);
        near(value("output_dwell_deg"), expected, 1e-9);
    }
}

/// The second crank turns once, evenly, in two turns of the first: of dwells that are all as long, that at the start counts.
#[test]
fn an_output_that_turns_evenly_dwells_for_a_hundredth_of_its_turn_from_the_start() {
    let linkage = default_linkage("geared-five-bar");
    let value = measures(&linkage, 0, 12);
    near(value("output_dwell_deg"), 7.2, 2e-10);
    assert_eq!(value("output_dwell_start_deg"), 0.0);
    let value = measures(&Linkage { dwell: DwellBand::Angle(5.0), ..linkage }, 0, 12);
    near(value("output_dwell_deg"), 10.0, 2e-10);
}

/// The crank-shaper: the slotted link rocks by twice the angle whose sine is crank to frame (Norton, §3.7).
#[test]
fn the_slotted_link_of_a_crank_shaper_has_closed_forms() {
    let (r, d) = (1.0, 2.5);
    let (builder, [_, _, a], _) = quick_return(r, d);
    let linkage = builder.build(vec![a], None, MotionOptions::default()).unwrap();
    let value = measures(&linkage, 0, 12);
    let half = trig::degrees(trig::asin(r / d));
    near(value("output_swing_deg"), 2.0 * half, 1e-13);
    near(value("output_min"), 90.0 - half, 1e-13);
    near(value("time_ratio"), (180.0 + 2.0 * half) / (180.0 - 2.0 * half), 1e-12);
    // The link is fastest where the crank is on the frame line.
    near(value("velocity_ratio_min"), -r / (d - r), 1e-13);
    near(value("velocity_ratio_max"), r / (d + r), 1e-13);
    assert_eq!((value("toggles"), value("mu_worst_deg")), (2.0, 90.0));
}

/// Whitworth's quick return: the slotted link turns fully, and the ram on a line through its pivot at right angles to
/// the frame reverses where the link is along the line (Norton, §3.7).
#[test]
fn whitworths_quick_return_has_closed_forms() {
    let (r, d, l) = (2.0, 1.1, 6.0);
    let (mut builder, [c, x, a], end) = quick_return(r, d);
    let link = builder.clone().build(vec![a], None, MotionOptions::default()).unwrap();
    let value = measures(&link, 0, 12);
    assert_eq!((value("output_swing_deg"), value("toggles")), (360.0, 0.0));
    assert!(value("output_min").is_nan() && value("time_ratio").is_nan());
    near(value("velocity_ratio_max"), r / (r - d), 1e-13);
    near(value("velocity_ratio_min"), r / (r + d), 1e-13);
    near(value("mechanical_advantage_max"), (r + d) / r, 1e-13);
    let ram = builder.slide("R", (end, l), ([c, x], 0.0), Side::Left).unwrap();
    let linkage = builder.build(vec![ram], None, MotionOptions::default()).unwrap();
    assert_eq!(linkage.output(), Some(OutputLink::Slider { joint: ram, line: [c, x] }));
    let value = measures(&linkage, 0, 12);
    near(value("output_stroke"), 2.0, 1e-13);
    let half = acos_deg(d / r);
    near(value("time_ratio"), (180.0 - half) / half, 1e-12);
    near(value("mu_worst_deg"), acos_deg(1.0 / l), 1e-12);
}

/// The rocker's limits are where crank and coupler are in line; the velocity ratio is -1 and 1 to the distances of the
/// pivots from the coupler's line (Norton, §6.6).
#[test]
fn a_crank_rocker_has_closed_forms() {
    for [g, a, h, b] in [[4.0, 1.0, 3.0, 3.5], [2.0, 1.0, 2.5, 2.5], [7.0, 2.0, 9.0, 6.0]] {
        let linkage = four_bar([g, a, h, b]);
        let value = measures(&linkage, 0, 50);
        let psi = |reach: f64| 180.0 - acos_deg((g * g + b * b - reach * reach) / (2.0 * g * b));
        near(value("output_max"), psi(h - a), 1e-12);
        near(value("output_min"), psi(h + a), 1e-12);
        near(value("output_swing_deg"), psi(h - a) - psi(h + a), 1e-12);
        let theta = |reach: f64| acos_deg((g * g + reach * reach - b * b) / (2.0 * g * reach));
        let between = 180.0 + theta(h - a) - theta(h + a);
        near(value("time_ratio"), between.max(360.0 - between) / between.min(360.0 - between), 1e-12);
        assert_eq!(value("toggles"), 2.0);
        near(value("mu_worst_deg"), value("mu_min_deg").min(180.0 - value("mu_max_deg")), 0.0);
    }
    // A drag-link has no toggle position; its angles are those of a parallelogram's cranks where all are parallel.
    let value = measures(&four_bar([1.0, 3.0, 3.5, 4.0]), 0, 50);
    assert_eq!((value("toggles"), value("output_swing_deg")), (0.0, 360.0));
    assert!(value("mechanical_advantage_max").is_finite() && value("velocity_ratio_min") > 0.0);
    let value = measures(&default_linkage("geared-five-bar"), 0, 50);
    near(value("velocity_ratio_min"), -0.5, 1e-14);
    near(value("velocity_ratio_max"), -0.5, 1e-14);
    near(value("mechanical_advantage_max"), 2.0, 1e-14);
}

/// A kite with frame and crank 2, coupler and rocker 1: the rocker's pin is on the bisector of frame and crank. Where
/// they coincide, the velocity ratio is half of the pin's distance from O over that from C, 3/2 or -1/2.
#[test]
fn the_velocity_ratio_of_a_kite_is_finite_at_its_change_points() {
    let linkage = four_bar([2.0, 2.0, 1.0, 1.0]);
    let circuits = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(8))).circuits.len();
    let values: Vec<_> = (0..circuits).map(|circuit| measures(&linkage, circuit, 8)).collect();
    for value in &values {
        assert_eq!((value("velocity_ratio_min"), value("velocity_ratio_max")), (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!((value("toggles"), value("mechanical_advantage_min")), (0.0, 0.0));
        near(value("mechanical_advantage_max"), 2.0, 1e-9);
    }
    assert!(!values.is_empty());
}

/// The crank of an actuator: its limits are where it and the actuator are in line.
#[test]
fn an_actuator_swings_its_crank_between_limits() {
    let linkage = default_linkage("linear-actuator");
    let value = measures(&linkage, 0, 50);
    near(value("output_swing_deg"), 360.0, 1e-12);
    assert_eq!((value("toggles"), value("mu_worst_deg")), (0.0, 0.0));
    assert_eq!((value("mechanical_advantage_min"), value("velocity_ratio_max")), (0.0, f64::INFINITY));
}

/// A coupler link has an output that can be stated; without it there is none.
#[test]
fn a_crank_alone_has_no_output() {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let a = builder.crank("A", o, 1.0).unwrap();
    let linkage = builder.build(vec![a], None, all()).unwrap();
    let value = measures(&linkage, 0, 12);
    assert!(OUTPUT_MEASURES.iter().all(|name| value(name).is_nan()));
}

/// At the limits of a crank-rocker's output, crank and coupler are in line: the pin of the rocker is at the sum and at the
/// difference of their lengths from the crank's pivot.
#[test]
fn the_output_is_at_its_limits_where_crank_and_coupler_are_in_line() {
    let four_bar = FourBar { frame: 4.0, crank: 1.0, coupler: 3.0, rocker: 3.5 };
    let pivots = [Point::new(0.0, 0.0), Point::new(4.0, 0.0)];
    let placed = PlacedFourBar { pivots, lengths: four_bar, coupler_point: Vector::new(1.0, 1.0) };
    let linkage = placed.to_linkage(Side::Left, all()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
    let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
    let poses = output_limit_poses(&curve).unwrap();
    let [o, _, b, _] = FourBar::pins(&linkage).unwrap();
    let mut reaches = poses.map(|pose| (pose[b] - pose[o]).norm());
    reaches.sort_by(f64::total_cmp);
    // A distance at rest changes with the square of an error of the input.
    assert!((reaches[0] - 2.0).abs() < 1e-14 && (reaches[1] - 4.0).abs() < 1e-14, "{reaches:?}");
    let pivots = [Point::new(0.0, 0.0), Point::new(1.0, 0.0)];
    let turning = PlacedFourBar { pivots, lengths: FourBar { frame: 1.0, crank: 3.0, ..four_bar }, ..placed };
    let linkage = turning.to_linkage(Side::Left, all()).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
    let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
    assert!(output_limit_poses(&curve).is_none());
}

/// Every linkage of the catalogue states its output link, and has all measures of it.
#[test]
fn every_linkage_of_the_catalogue_states_its_output() {
    for template in coupler_curves::catalogue::all() {
        assert!(template.output_link.is_some(), "{}", template.id);
        if template.parameters.iter().any(|parameter| parameter.default.is_none()) {
            continue;
        }
        let linkage = default_linkage(&template.id);
        let value = measures(&linkage, 0, 60);
        for name in ["output_dwell_deg", "toggles", "velocity_ratio_max", "mechanical_advantage_min", "mu_worst_deg"] {
            // Of several links that drive the output together, none has a transmission angle.
            if linkage.group.is_some() && name == "mu_worst_deg" {
                continue;
            }
            assert!(!value(name).is_nan(), "{}: {name}", template.id);
        }
        assert!(value("output_swing_deg").is_nan() != value("output_stroke").is_nan(), "{}", template.id);
        // No linkage of the catalogue has another default, except those that carry further links.
        let default = Linkage { output_link: None, ..linkage.clone() };
        let is_default = default.output() == linkage.output();
        assert!(is_default || template.id == "cognates", "{}: {:?}", template.id, default.output());
    }
}
