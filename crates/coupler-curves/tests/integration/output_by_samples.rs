//! The motion of the output link, against brute force.

use coupler_curves::geometry::{Point, cross, trig};
use coupler_curves::linkage::{JointId, Linkage, LinkageBuilder, Orientation, OutputLink, Side};
use coupler_curves::motion::{Circuit, Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::output::{OUTPUT_MEASURES, acos_deg, all, four_bar, measures, slider_crank};

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
    #[ignore = "thorough"]
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
    #[ignore = "thorough"]
    fn sliders_agree_with_brute_force((crank, coupler, offset) in (0.3f64..3.0, 0.3f64..3.0, -2.0f64..2.0)) {
        check_by_samples(&slider_crank([crank, coupler, offset]))?;
    }

    #[test]
    #[ignore = "thorough"]
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
