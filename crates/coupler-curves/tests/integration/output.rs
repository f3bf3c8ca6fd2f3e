//! The motion of the output link, against closed forms of textbook linkages and against brute force.

use coupler_curves::geometry::{Point, cross, trig};
use coupler_curves::linkage::{
    CircuitSelection, JointId, Linkage, LinkageBuilder, MotionOptions, Orientation, OutputLink, Side,
};
use coupler_curves::measure::{self, TracedCurve, Value};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::catalogue::default_linkage;

fn all() -> MotionOptions {
    MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() }
}

/// The measures of the first traced joint on a circuit, by name; NaN where one does not apply.
fn measures(linkage: &Linkage, circuit: usize, samples: usize) -> impl Fn(&str) -> f64 + use<> {
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(samples)));
    let curve = TracedCurve::new(linkage, &motion, &motion.circuits[circuit], linkage.traced[0]);
    let is_tested = |k: usize| {
        let name = measure::ALL[k].name;
        OUTPUT_MEASURES.contains(&name) || name.starts_with("mu_")
    };
    let values = measure::compute_selected(&curve, is_tested);
    move |name| {
        let k = measure::ALL.iter().position(|m| m.name == name).unwrap_or_else(|| panic!("{name}"));
        if let Value::Number(value) = values[k] { value } else { f64::NAN }
    }
}

const OUTPUT_MEASURES: [&str; 13] = [
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

fn four_bar([frame, crank, coupler, rocker]: [f64; 4]) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let c = builder.fixed("C", Point::new(frame, 0.0));
    let a = builder.crank("A", o, crank).unwrap();
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).unwrap();
    builder.build(vec![b], None, all()).unwrap()
}

fn slider_crank([crank, coupler, offset]: [f64; 3]) -> Linkage {
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

fn acos_deg(cos: f64) -> f64 {
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
            assert!(!value(name).is_nan(), "{}: {name}", template.id);
        }
        assert!(value("output_swing_deg").is_nan() != value("output_stroke").is_nan(), "{}", template.id);
        // No linkage of the catalogue has another default, except those that carry further links.
        let default = Linkage { output_link: None, ..linkage.clone() };
        let is_default = default.output() == linkage.output();
        assert!(is_default || template.id == "cognates", "{}: {:?}", template.id, default.output());
    }
}

/// A Stephenson six-bar of form III: a dyad on a coupler point and a third pivot.
fn six_bar([frame, crank, coupler, rocker, along, across, link, output]: [f64; 8], slides: bool) -> Option<Linkage> {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::new(0.0, 0.0));
    let c = builder.fixed("C", Point::new(frame, 0.0));
    let q = builder.fixed("Q", Point::new(0.4 * frame, -1.5));
    let a = builder.crank("A", o, crank).ok()?;
    let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).ok()?;
    let d = builder.point("D", [a, b], along, across).ok()?;
    let e = if slides {
        builder.slide("E", (d, link), ([o, c], 0.3 * output), Side::Left).ok()?
    } else {
        builder.dyad("E", [d, q], [link, output], Side::Right).ok()?
    };
    builder.build(vec![e], None, all()).ok()
}

/// The output's coordinate at each sample of a circuit, continuous, in radians or as a length.
fn coordinates(linkage: &Linkage, circuit: &Circuit) -> Vec<f64> {
    let point = |joint: JointId, i: usize| circuit.positions.point(joint, i);
    match linkage.output().expect("an output") {
        OutputLink::Slider { joint, line: [from, to] } => (0..circuit.len())
            .map(|i| (point(to, i) - point(from, i)).normalize().dot(&(point(joint, i) - point(from, i))))
            .collect(),
        OutputLink::Link([from, to]) => {
            let arm = |i: usize| point(to, i) - point(from, i);
            let mut angles = vec![trig::atan2(arm(0).y, arm(0).x)];
            for i in 1..circuit.len() {
                let turn = trig::atan2(cross(arm(i - 1), arm(i)), arm(i - 1).dot(&arm(i)));
                angles.push(angles[i - 1] + turn);
            }
            angles
        }
        other @ OutputLink::Slot { .. } => panic!("{other:?}"),
    }
}

/// The value at the top of the parabola through three samples.
fn vertex([x0, x1, x2]: [f64; 3], [y0, y1, y2]: [f64; 3]) -> f64 {
    let (d0, d1) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let second = (d1 - d0) / (x2 - x0);
    let slope = d0 + second * (x1 - x0);
    if second == 0.0 { y1 } else { y1 - slope * slope / (4.0 * second) }
}

/// Compares the measures of a linkage with those of many samples. Returns the toggle positions.
fn check_by_samples(linkage: &Linkage) -> Result<usize, TestCaseError> {
    const SAMPLES: usize = 20_000;
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::DenseAtLimits(SAMPLES)));
    let mut toggles = 0;
    for (k, circuit) in motion.circuits.iter().enumerate() {
        let value = measures(linkage, k, 24);
        let (n, y) = (circuit.len(), coordinates(linkage, circuit));
        let change = {
            let last = y[n - 1];
            let arm = coordinates_after(linkage, circuit, last);
            if circuit.is_closed { arm - y[0] } else { 0.0 }
        };
        let turns = circuit.is_closed && change.abs() > 1.0;
        let at = |i: isize| y[i.rem_euclid(n as isize) as usize] + change * i.div_euclid(n as isize) as f64;
        // The parameter in which samples are even is the sample's number, on a pass.
        let is_inside = |i: usize| circuit.is_closed || (1..n - 1).contains(&i);
        let (mut found, mut is_clear) = (0, true);
        let size = y.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
        let travel = size[1] - size[0];
        let mut extremes = size;
        for i in (0..n).filter(|&i| is_inside(i)) {
            let i = i as isize;
            let values = [at(i - 1), at(i), at(i + 1)];
            if (values[1] - values[0] > 0.0) != (values[2] - values[1] > 0.0) {
                found += 1;
                let top = vertex([-1.0, 0.0, 1.0], values);
                extremes = [extremes[0].min(top), extremes[1].max(top)];
                // Near an extreme that hardly stands out, rounding and corners decide.
                let bend = (values[0] - 2.0 * values[1] + values[2]).abs();
                is_clear &= bend > 1e-12 * travel.max(1e-3);
            }
        }
        if !is_clear || travel < 1e-6 {
            continue;
        }
        prop_assert_eq!(value("toggles"), found as f64, "circuit {}", k);
        toggles += found;
        let scale = if linkage.output().expect("an output").is_slider() { 1.0 } else { 180.0 / std::f64::consts::PI };
        let travel = if turns { std::f64::consts::TAU } else { extremes[1] - extremes[0] };
        let reported = if scale == 1.0 { value("output_stroke") } else { value("output_swing_deg") };
        // Where a pass is short, few samples are on it, and an extreme may stand out between them.
        let steps = (1..n).map(|i| (y[i] - y[i - 1]).abs()).fold(0.0, f64::max);
        let sampled = if turns { travel } else { size[1] - size[0] };
        let is_near =
            reported >= sampled * scale * (1.0 - 1e-9) && reported <= (travel * (1.0 + 1e-6) + 0.1 * steps) * scale;
        prop_assert!(is_near, "{} {}", reported, travel * scale);
        if !turns {
            let middle = (value("output_min") + value("output_max")) / 2.0;
            let error = middle - (extremes[0] + extremes[1]) / 2.0 * scale;
            let error = if scale == 1.0 { error } else { error - 360.0 * (error / 360.0).round() };
            prop_assert!(
                error.abs() < (1e-6 * travel + 0.1 * steps) * scale && (scale == 1.0 || middle.abs() <= 180.0 + 1e-9),
                "{error}"
            );
        }
        check_dwell(circuit, &y, change, (turns, &value))?;
        check_ratios(linkage, circuit, &value)?;
    }
    Ok(toggles)
}

/// The output's coordinate where a closed circuit is back at its first sample.
fn coordinates_after(linkage: &Linkage, circuit: &Circuit, last: f64) -> f64 {
    let y = coordinates(linkage, circuit)[0];
    if linkage.output().expect("an output").is_slider() {
        return y;
    }
    let turn = std::f64::consts::TAU;
    y + turn * ((last - y) / turn).round()
}

/// The dwell is as long as the longest between samples, but for the distance of two samples.
fn check_dwell(
    circuit: &Circuit,
    y: &[f64],
    change: f64,
    (turns, value): (bool, &impl Fn(&str) -> f64),
) -> Result<(), TestCaseError> {
    let n = y.len();
    let laps = if circuit.is_closed { 2 * n } else { n };
    let at = |i: usize| y[i % n] + change * (i / n) as f64;
    let travel = y.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
    let band = 0.01 * if turns { std::f64::consts::TAU } else { travel[1] - travel[0] };
    let after = circuit.input_after_last().unwrap_or(circuit.inputs[n - 1]);
    let step = |i: usize| match i % n {
        i if i + 1 < n => (circuit.inputs[i + 1] - circuit.inputs[i]).abs(),
        i => (after - circuit.inputs[i]).abs(),
    };
    let (mut longest, mut span, mut start) = (0.0f64, 0.0, 0);
    let mut steps: f64 = 0.0;
    for end in 0..laps {
        let fits = |start: usize, end: usize| {
            (start..=end).fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], i| [l.min(at(i)), h.max(at(i))])
        };
        if end > 0 {
            span += step(end - 1);
            steps = steps.max(step(end - 1));
        }
        while {
            let [low, high] = fits(start, end);
            high - low > band
        } {
            span -= step(start);
            start += 1;
        }
        longest = longest.max(span);
    }
    let found = value("output_dwell_deg");
    prop_assert!(found >= longest * (1.0 - 1e-9) && found <= longest + 2.0 * steps, "{} {}", found, longest);
    Ok(())
}

/// Velocity ratios are between the extremes, and reach them.
fn check_ratios(linkage: &Linkage, circuit: &Circuit, value: &impl Fn(&str) -> f64) -> Result<(), TestCaseError> {
    let rate = |i: usize| {
        let derivatives = circuit.derivatives(linkage, i);
        let arm = |from: JointId, to: JointId| derivatives.position(to) - derivatives.position(from);
        let arm_rate = |from: JointId, to: JointId| derivatives.velocity(to) - derivatives.velocity(from);
        match linkage.output().expect("an output") {
            OutputLink::Slider { joint, line: [from, to] } => arm(from, to).normalize().dot(&arm_rate(from, joint)),
            OutputLink::Link([from, to]) => cross(arm(from, to), arm_rate(from, to)) / arm(from, to).norm_squared(),
            other @ OutputLink::Slot { .. } => panic!("{other:?}"),
        }
    };
    let rates: Vec<f64> = (0..circuit.len()).step_by(10).map(rate).filter(|rate| rate.is_finite()).collect();
    let [low, high] = rates.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
    let (least, greatest) = (value("velocity_ratio_min"), value("velocity_ratio_max"));
    // Next to a change point the derivatives of single samples have few exact digits.
    let rounding = 1e-5 * (1.0 + low.abs().max(high.abs()));
    prop_assert!(least <= low + rounding && greatest >= high - rounding, "{least} {low} {greatest} {high}");
    if least.is_finite() {
        prop_assert!(low - least <= 1e-2 * (high - low), "{least} {low}");
    }
    if greatest.is_finite() {
        prop_assert!(greatest - high <= 1e-2 * (high - low), "{greatest} {high}");
    }
    let most = least.abs().max(greatest.abs());
    prop_assert_eq!(value("mechanical_advantage_min"), 1.0 / most);
    if value("toggles") > 0.0 {
        prop_assert_eq!(value("mechanical_advantage_max"), f64::INFINITY);
    }
    Ok(())
}

proptest! {
    #![proptest_config(crate::random())]

    #[test]
    fn four_bars_agree_with_brute_force(
        lengths in prop::array::uniform4(prop_oneof![0.3f64..3.0, (1u8..7).prop_map(|k| f64::from(k) / 2.0)]),
    ) {
        check_by_samples(&four_bar(lengths))?;
    }

    /// A four-bar is in a toggle position where crank and coupler are in line: with the rocker and the frame, their sum
    /// or their difference form a triangle on either side of the frame. However near to a change point, each is found
    /// once on one of the circuits.
    #[test]
    fn the_toggle_positions_of_four_bars_are_triangles(
        lengths in prop::array::uniform3(0.3f64..3.0), excess in prop_oneof![-1.0f64..1.0, -1e-3f64..1e-3, -1e-7f64..1e-7],
        order in Just([0usize, 1, 2, 3]).prop_shuffle(),
    ) {
        let [x, y, z] = lengths;
        // The longest and the shortest are nearly as long as the others together.
        let all = [x, y, z, x + y - z + excess];
        prop_assume!(all[3] > 0.1 && excess.abs() > 1e-9);
        let [g, a, h, b] = [0, 1, 2, 3].map(|k: usize| all[order[k]]);
        let is_triangle = |side: f64| side < g + b && side > (g - b).abs();
        let expected = [h + a, (h - a).abs()].into_iter().filter(|side| is_triangle(*side)).count() * 2;
        let linkage = four_bar([g, a, h, b]);
        let circuits = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(8))).circuits.len();
        let found: f64 = (0..circuits).map(|circuit| measures(&linkage, circuit, 8)("toggles")).sum();
        prop_assert_eq!(found, expected as f64, "{:?}", [g, a, h, b]);
        // The limits of the output are among the angles of these triangles.
        let psi = |reach: f64| 180.0 - acos_deg((g * g + b * b - reach * reach) / (2.0 * g * b));
        let candidates: Vec<f64> = [h + a, (h - a).abs()].into_iter().filter(|side| is_triangle(*side))
            .flat_map(|side| [psi(side), -psi(side)]).collect();
        for circuit in 0..circuits {
            let value = measures(&linkage, circuit, 8);
            for name in ["output_min", "output_max"] {
                let limit = value(name);
                let error = |angle: &f64| { let off = limit - angle; (off - 360.0 * (off / 360.0).round()).abs() };
                let error_of = candidates.iter().map(error).fold(f64::INFINITY, f64::min);
                // An arc cosine near its ends has half of the digits.
                prop_assert!(limit.is_nan() || error_of < 1e-7, "{}: {} {:?} {:?}", name, limit, candidates, [g, a, h, b]);
            }
        }
    }

    #[test]
    fn sliders_agree_with_brute_force((crank, coupler, offset) in (0.3f64..3.0, 0.3f64..3.0, -2.0f64..2.0)) {
        check_by_samples(&slider_crank([crank, coupler, offset]))?;
    }

    #[test]
    fn six_bars_agree_with_brute_force(lengths in prop::array::uniform8(0.3f64..3.0), slides in any::<bool>()) {
        if let Some(linkage) = six_bar(lengths, slides) {
            check_by_samples(&linkage)?;
        }
    }

    /// The output does not depend on samples, size or placement, and turns in the opposite sense in the mirror image.
    #[test]
    fn outputs_are_invariant(
        lengths in prop::array::uniform8(0.3f64..3.0), slides in any::<bool>(), scale in 0.01f64..100.0,
        (samples, mirrored, turn) in (8usize..500, any::<bool>(), 0.0f64..360.0),
    ) {
        let scaled = |k: usize| lengths[k] * scale;
        let (Some(plain), Some(bigger)) = (six_bar(lengths, slides), six_bar(std::array::from_fn(scaled), slides)) else {
            return Ok(());
        };
        // The third pivot is not scaled: only the linkage without it is.
        let bigger = if slides { bigger } else { plain.clone() };
        let scale = if slides { scale } else { 1.0 };
        let placed = Linkage { placement: Orientation::new(mirrored, turn), ..bigger };
        let count = Motion::solve(&plain, &Sampler::new(Sampling::Samples(8))).circuits.len();
        for circuit in 0..count {
            let (before, after) = (measures(&plain, circuit, 8), measures(&placed, circuit, samples));
            for name in OUTPUT_MEASURES {
                let (a, b) = (before(name), after(name));
                let power = match name {
                    "output_stroke" | "velocity_ratio_min" | "velocity_ratio_max" if slides => scale,
                    "output_min" | "output_max" if slides => scale,
                    "mechanical_advantage_min" | "mechanical_advantage_max" if slides => 1.0 / scale,
                    // Of two equally long dwells rounding decides which is found.
                    "output_dwell_start_deg" => continue,
                    _ => 1.0,
                };
                let is_same = (a.is_nan() && b.is_nan()) || a * power == b
                    || (a * power - b).abs() <= 1e-8 * (a * power).abs().max(scale.min(1.0));
                prop_assert!(is_same, "{}: {} {} {}", name, a, power, b);
            }
        }
    }
}

/// A six-bar with limits 8e-7 degrees apart, next to which values are rounded to few digits, and a four-bar with a
/// change point: extremes elsewhere on their circuits are as exact as others.
#[test]
fn extremes_are_exact_next_to_close_limits_and_change_points() {
    let lengths = [
        1.945_680_304_813_748_3,
        1.888_468_190_460_201,
        1.317_127_439_010_725_5,
        1.416_554_479_397_217_1,
        1.660_107_444_457_817,
        2.764_569_612_544_278,
        1.028_443_425_572_580_3,
        2.685_413_747_229_613,
    ];
    check_by_samples(&six_bar(lengths, true).unwrap()).unwrap();
    check_by_samples(&four_bar([1.0, 1.5, 3.0, 2.5])).unwrap();
}
