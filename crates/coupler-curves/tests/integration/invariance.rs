//! What is measured is a property of the curve: it does not depend on where the circuit begins, nor on which way the linkage is
//! turned, and of the mirror image it is the same or the mirror image.
//!
//! A linkage turned by an angle has its input counted from elsewhere, and so its circuit cut elsewhere.

use coupler_curves::geometry::trig;
use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::measure::{self, TracedCurve, Value};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::layouts::{LAYOUTS, Layout, Watt, epicycle, four_bar, piston, scotch_yoke, watt};
use crate::measures::number;

/// The measures of the curves of all circuits, in the order of the circuits.
fn measures(linkage: &Linkage) -> Vec<Vec<Value>> {
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(90)));
    let measured = |circuit| measure::compute_all(&TracedCurve::new(linkage, &motion, circuit, linkage.traced[0]));
    motion.circuits.iter().map(measured).collect()
}

fn value(values: &[Value], name: &str) -> Value {
    values[measure::ALL.iter().position(|m| m.name == name).unwrap_or_else(|| panic!("{name}"))]
}

/// The numbers of cusps, inflections and crunodes.
fn counts(linkage: &Linkage) -> Vec<[f64; 3]> {
    let of_curve = |values: &Vec<Value>| ["cusps", "inflections", "crunodes"].map(|name| number(value(values, name)));
    measures(linkage).iter().map(of_curve).collect()
}

const TURNS: [f64; 9] = [0.0, 1e-7, 17.0, 45.0, 90.0, 123.4, 180.0, 270.0, 359.999_999_9];

/// Cycloids with k cusps, no inflection and, inside the circle, no crossing.
#[test]
#[ignore = "thorough"]
fn cycloids_have_their_cusps_wherever_the_circuit_begins() {
    // The circle, the arm and its ratio: x = radius cos t + arm cos(ratio t + phase) stops where both speeds are equal.
    for (curve, expected) in
        [((2.0, 1.0, -2.0), 3.0), ((3.0, 1.0, -3.0), 4.0), ((2.0, 1.0, 2.0), 1.0), ((3.0, 1.0, 3.0), 2.0)]
    {
        for turn in TURNS {
            for is_mirrored in [false, true] {
                for phase in [0.0, 180.0, 50.0] {
                    let (radius, arm, ratio) = curve;
                    let layout = Layout { turn_deg: turn, is_mirrored, scale: 1.0 };
                    let found = counts(&epicycle(layout, (radius, arm), ratio, phase));
                    assert_eq!(found, [[expected, 0.0, 0.0]], "{curve:?} {layout:?} {phase}");
                }
            }
        }
    }
}

/// Cycloids are symmetrical about the lines through their cusps, whichever way they are turned.
#[test]
fn cycloids_are_symmetrical_about_the_lines_through_their_cusps() {
    for (radius, arm, ratio, cusps) in
        [(2.0, 1.0, -2.0, 3.0), (3.0, 1.0, -3.0, 4.0), (2.0, 1.0, 2.0, 1.0), (3.0, 1.0, 3.0, 2.0)]
    {
        for turn_deg in (0..60).map(|k| 7.3 * f64::from(k)).chain([147.0]) {
            let layout = Layout { turn_deg, is_mirrored: false, scale: 1.0 };
            let values = &measures(&epicycle(layout, (radius, arm), ratio, 180.0))[0];
            let residual = number(value(values, "symmetry_residual"));
            assert!(residual < 1e-9, "{radius} {ratio} {turn_deg}: {residual}");
            // Between the lines through the cusps are others.
            let part = 180.0 / cusps;
            let off = number(value(values, "symmetry_deg")) - turn_deg;
            assert!((off - (off / part).round() * part).abs() < 1e-7, "{radius} {ratio} {turn_deg}: {off}");
        }
    }
}

/// A point of the coupler that is the instant centre at crank angle 0 has a cusp there, and one only.
#[test]
fn a_coupler_curve_has_its_cusp_wherever_the_circuit_begins() {
    let across = -2.5 * 0.96f64.sqrt();
    let expected = counts(&four_bar(Layout::turned(100.0), [4.0, 1.5, 3.0, 3.5], (0.5, across)));
    for is_mirrored in [false, true] {
        for turn in TURNS {
            let layout = Layout { turn_deg: turn, is_mirrored, scale: 1.0 };
            let found = counts(&four_bar(layout, [4.0, 1.5, 3.0, 3.5], (0.5, across)));
            assert_eq!(found.iter().map(|counts| counts[0]).sum::<f64>(), 1.0, "{layout:?} {found:?}");
            // Circuits are in the order of their branches, which the mirror image exchanges.
            let of_branches = if is_mirrored { [1, 0] } else { [0, 1] }.map(|k| expected[k]);
            assert_eq!(found, of_branches, "{layout:?}");
        }
    }
}

/// Pin B goes to and fro on its arc: it has the length of twice the swing, no inflections, and the curvature of its circle.
#[test]
#[ignore = "thorough"]
fn a_pin_that_rocks_has_the_length_and_the_curvature_of_its_arc() {
    for bar in [[3.966, 0.609, 1.88, 2.824], [4.0, 1.5, 3.0, 3.5], [4.0, 1.0, 3.0, 3.5], [5.0, 2.0, 4.0, 4.5]] {
        for turn in [0.0, 123.4] {
            for is_mirrored in [false, true] {
                let layout = Layout { turn_deg: turn, is_mirrored, scale: 1.0 };
                let mut linkage = four_bar(layout, bar, (1.0, 0.0));
                linkage.traced[0] = JointId::new(3);
                for values in measures(&linkage) {
                    let get = |name: &str| number(value(&values, name));
                    let expected = 2.0 * bar[3] * get("output_swing_deg").to_radians();
                    assert!(
                        (get("length") / expected - 1.0).abs() < 1e-12,
                        "{bar:?} {layout:?}: {} {expected}",
                        get("length")
                    );
                    assert_eq!(
                        (get("inflections"), get("cusps"), get("crunodes")),
                        (0.0, 0.0, 0.0),
                        "{bar:?} {layout:?}"
                    );
                    assert!(
                        (get("curvature_max") * bar[3] - 1.0).abs() < 1e-8,
                        "{bar:?} {layout:?}: {}",
                        get("curvature_max") * bar[3] - 1.0
                    );
                    assert_eq!(
                        value(&values, "symmetry"),
                        Value::Word("other"),
                        "{bar:?} {layout:?}: {:?}",
                        value(&values, "symmetry_residual")
                    );
                }
            }
        }
    }
}

/// The pin of a piston goes to and fro on its line: the straight portion is one stroke, that for which the crank turns least.
#[test]
fn a_line_that_is_passed_to_and_fro_is_one_stroke() {
    for (crank, rod, offset) in [(1.0, 3.0, 0.0), (1.0, 3.0, 0.7), (1.0, 1.9, -0.8), (2.0, 2.6, 0.25)] {
        // The crank and the rod are in line at the ends of the stroke.
        let limits = [rod + crank, rod - crank].map(|length: f64| trig::asin(offset / length).to_degrees());
        let reach = |length: f64| (length * length - offset * offset).sqrt();
        let stroke = reach(rod + crank) - reach(rod - crank);
        let span = 180.0 - (limits[0] - limits[1]).abs();
        for turn_deg in [0.0, 1e-7, 17.0, 180.0] {
            for is_mirrored in [false, true] {
                let layout = Layout { turn_deg, is_mirrored, scale: 1.0 };
                let linkage = piston(layout, [crank, rod, offset]);
                for values in measures(&linkage) {
                    assert_eq!(value(&values, "curvature_max"), Value::Number(0.0), "{layout:?}");
                    let found = ["straight_length", "straight_input_deg"].map(|name| number(value(&values, name)));
                    assert!((found[0] / stroke - 1.0).abs() < 1e-12, "{layout:?}: {found:?} {stroke}");
                    assert!((found[1] / span - 1.0).abs() < 1e-6, "{layout:?}: {found:?} {span}");
                }
            }
        }
    }
}

/// A path that is straight to the last digit has the circular portion that it has to rounding: of the greatest radius, its length.
#[test]
fn a_line_has_the_same_circular_portion_on_an_axis_and_off_it() {
    let spans = [0.0, 17.0, 30.0].map(|turn_deg| {
        let layout = Layout::turned(turn_deg);
        number(value(&measures(&scotch_yoke(layout))[0], "dwell_input_deg"))
    });
    // The chord between circles of radius 4.001, through its ends, and 3.999, which it touches; it ends where the path returns.
    let chord = 2.0 * (4.001f64 * 4.001 - 3.999 * 3.999).sqrt();
    let expected = 2.0 * trig::acos(1.0 - chord).to_degrees();
    assert!(spans.iter().all(|span| (span / expected - 1.0).abs() < 1e-4), "{spans:?} {expected}");
}

/// The rocker of a Watt II linkage passes the limit of its second loop twice in a turn.
#[test]
fn the_time_ratio_is_that_of_the_strokes_from_limit_to_limit() {
    let watt = Watt {
        frame: 0.9188,
        crank: 0.6161,
        loop_lengths: [0.9143, 1.0644],
        d: [0.2931, 0.5587],
        g: [3.4243, 0.0541],
        second: [2.4078, 3.4764],
        m: [-0.3604, -1.391],
    };
    let ratios = |layout: Layout| -> Vec<f64> {
        measures(&watt.second(layout)).iter().map(|values| number(value(values, "time_ratio"))).collect()
    };
    let plain = ratios(Layout::PLAIN);
    // Evaluated apart from this program.
    assert!((plain[2] - 2.4419).abs() < 5e-5, "{plain:?}");
    for layout in [Layout::MIRRORED, Layout::turned(33.0), Layout { scale: 1e3, ..Layout::turned(200.0) }] {
        let mut found = ratios(layout);
        if layout.is_mirrored {
            found.reverse();
        }
        for (found, expected) in found.iter().zip(&plain) {
            assert!((found / expected - 1.0).abs() < 1e-11, "{layout:?}: {found} {expected}");
        }
    }
}

proptest! {
    #![proptest_config(crate::random())]

    /// The sign of an area is that of the way round: upward with the input where it gains, and otherwise, as for every circuit with an
    /// even number of passes that rises and falls as much, upward on branch 1. So it changes in a mirror image, and not with a turn.
    #[test]
    fn areas_have_the_sign_of_the_motion(watt in watt(), is_first in any::<bool>()) {
        let areas = |layout: Layout| {
            let linkage = if is_first { watt.first(layout) } else { watt.second(layout) };
            let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(36)));
            let area = |circuit| {
                let curve = TracedCurve::new(&linkage, &motion, circuit, linkage.traced[0]);
                let passes = &curve.circuit.passes;
                let gain: f64 = passes.iter().map(|pass| pass.input_direction() * pass.input_length()).sum();
                let sign = if layout.is_mirrored && gain.abs() < 1.0 { -1.0 } else { 1.0 };
                match (measure::Measure::find("area").unwrap().compute)(&curve) {
                    Value::Number(area) => Some(sign * area / (curve.extent() * curve.extent())),
                    _ => None,
                }
            };
            let mut areas: Vec<f64> = motion.circuits.iter().filter_map(area).collect();
            areas.sort_by(f64::total_cmp);
            areas
        };
        let plain = areas(Layout::PLAIN);
        for layout in [Layout::MIRRORED, Layout::turned(123.4), Layout { turn_deg: 301.0, ..Layout::MIRRORED }] {
            let found = areas(layout);
            prop_assert_eq!(found.len(), plain.len());
            for (found, plain) in found.iter().zip(&plain) {
                prop_assert!((found - plain).abs() < 1e-6, "{:?}: {} {}", layout, found, plain);
            }
        }
    }
}

proptest! {
    #![proptest_config(proptest::test_runner::Config { cases: 64, ..crate::random() })]

    #[test]
    #[ignore = "thorough"]
    fn random_watt_linkages_have_the_same_counts_and_lengths_in_all_layouts(watt in watt(), is_first in any::<bool>()) {
        // Of all circuits, the least first, which need not be those of the same circuit.
        let sorted = |layout: Layout, name: &str| {
            let linkage = if is_first { watt.first(layout) } else { watt.second(layout) };
            let missing = |value| if let Value::Number(value) = value { value } else { -1.0 };
            let mut sizes: Vec<f64> =
                measures(&linkage).iter().map(|values| missing(value(values, name))).collect();
            sizes.sort_by(f64::total_cmp);
            sizes
        };
        for name in ["cusps", "inflections", "crunodes", "length", "straight_length"] {
            let plain = sorted(Layout::PLAIN, name);
            for layout in LAYOUTS.iter().filter(|layout| layout.scale == 1.0) {
                let found = sorted(*layout, name);
                prop_assert_eq!(found.len(), plain.len());
                for (found, plain) in found.iter().zip(&plain) {
                    prop_assert!((found - plain).abs() <= 1e-6 * plain.abs(), "{} {:?}: {} {}", name, layout, found, plain);
                }
            }
        }
    }
}
