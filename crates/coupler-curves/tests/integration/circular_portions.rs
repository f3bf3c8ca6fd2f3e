//! Circular portions are no wider than allowed, and the same of a linkage, its mirror image, and turned and scaled copies.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::measure::{self, TracedCurve};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::layouts::{LAYOUTS, Layout, Watt, watt};

/// The circular portion of a curve, and its greatest and least distance from its centre, by many points.
#[derive(Clone, Copy, Debug)]
struct Portion {
    span: f64,
    allowed: f64,
    width: f64,
}

fn circular_portions(linkage: &Linkage) -> Vec<Portion> {
    const POINTS: usize = 40_000;
    let motion = Motion::solve(linkage, &Sampler::new(Sampling::Samples(90)));
    let portion = |circuit| {
        let curve = TracedCurve::new(linkage, &motion, circuit, linkage.traced[0]);
        let dwell = curve.dwell()?;
        let dense = dwell_points(&curve, dwell, POINTS);
        let [least, most] = dense
            .iter()
            .map(|point| (point - dwell.centre).norm())
            .fold([f64::INFINITY, 0.0f64], |[least, most], r| [least.min(r), most.max(r)]);
        Some(Portion { span: dwell.input_span, allowed: 0.001 * curve.extent(), width: most - least })
    };
    motion.circuits.iter().filter_map(portion).collect()
}

/// Points of a circular portion: of each pass as many, closer towards its ends.
fn dwell_points(curve: &TracedCurve, dwell: &measure::Dwell, count: usize) -> Vec<Point> {
    let mut travelled = 0.0;
    let mut all: Vec<(f64, Point)> = Vec::new();
    for pass in &curve.circuit.passes {
        let [from, to] = [pass.from.input.value, pass.to.input.value];
        let part = |k: usize| (1.0 - trig::cos(std::f64::consts::PI * k as f64 / count as f64)) / 2.0;
        let inputs: Vec<f64> = (0..count).map(|k| from + (to - from) * part(k)).collect();
        let positions = coupler_curves::motion::poses(curve.linkage, pass, &inputs);
        let points = inputs
            .iter()
            .enumerate()
            .map(|(k, input)| (travelled + (input - from).abs(), positions.point(curve.joint, k)));
        all.extend(points);
        travelled += (to - from).abs();
    }
    // Where it begins: of the poses at the first point, the one at the start input.
    let passes = &curve.circuit.passes;
    let off_input = |travel: f64| {
        let mut before = 0.0;
        let pass = passes.iter().find(|pass| {
            before += pass.input_length();
            travel < before
        });
        let pass = pass.unwrap_or(&passes[passes.len() - 1]);
        let input = pass.to.input.value - pass.input_direction() * (before - travel);
        ((input - dwell.start_input + 180.0).rem_euclid(360.0) - 180.0).abs()
    };
    let off = |travel: f64, point: &Point| 0.01 * off_input(travel) + (point - dwell.points[0]).norm() / curve.extent();
    // A path that returns on itself passes it in both directions.
    let onward = dwell.points[1] - dwell.points[0];
    let starts = all.windows(2).filter(|pair| (pair[1].1 - pair[0].1).dot(&onward) > 0.0).map(|pair| pair[0]);
    let start = starts.min_by(|a, b| off(a.0, &a.1).total_cmp(&off(b.0, &b.1))).expect("a start").0;
    let on =
        |travel: f64| if curve.circuit.is_closed { (travel - start).rem_euclid(travelled) } else { travel - start };
    // The start is known to the distance of two points.
    let inside = 0.1..=dwell.input_span - 0.1;
    all.iter().filter(|(travel, _)| inside.contains(&on(*travel))).map(|(_, point)| *point).collect()
}

fn check_widths(portions: &[Portion], name: &dyn std::fmt::Debug) {
    for portion in portions {
        // Next to a limit poses are as exact as the root of rounding.
        assert!(portion.width <= portion.allowed * (1.0 + 2e-4), "{name:?}: {portion:?}");
    }
}

/// The portions of all circuits in a layout, the shortest first: their spans are those of the plain layout.
fn check_layouts(linkage: impl Fn(Layout) -> Linkage, name: &dyn std::fmt::Debug) {
    let sorted = |layout: Layout| {
        let portions = circular_portions(&linkage(layout));
        check_widths(&portions, &(name, layout));
        let mut spans: Vec<f64> = portions.iter().map(|portion| portion.span).collect();
        spans.sort_by(f64::total_cmp);
        spans
    };
    let plain = sorted(Layout::PLAIN);
    for layout in LAYOUTS {
        let found = sorted(layout);
        assert_eq!(found.len(), plain.len());
        for (found, plain) in found.iter().zip(&plain) {
            assert!((found / plain - 1.0).abs() < 1e-4, "{name:?} {layout:?}: {found} {plain}");
        }
    }
}

#[test]
fn circular_portions_of_watt_linkages_are_no_wider_than_allowed() {
    let watt = Watt {
        frame: 1.0089,
        crank: 3.4104,
        loop_lengths: [2.4556, 1.0878],
        d: [2.0615, 1.7023],
        g: [0.2279, 0.8308],
        second: [3.9876, 4.9827],
        m: [2.8442, -0.5708],
    };
    check_layouts(|layout| watt.first(layout), &"Watt I");
}

/// Dimensions of Watt linkages: O A; A B and C B; D; D E and G E; G; M.
type WattDimensions = (f64, [f64; 2], [f64; 2], [f64; 2], [f64; 2], [f64; 2]);

/// Of Watt I and of Watt II, among them some whose curves go back along themselves, so that the points that touch a circle do so twice,
/// and some with points of contact that move far as the circle moves a little.
#[test]
fn circular_portions_of_watt_linkages_are_the_same_in_all_layouts() {
    let dimensions: [(bool, WattDimensions); 5] = [
        (false, (0.4212, [3.1499, 3.8765], [2.0703, 1.3143], [4.7443, 2.6959], [-2.5336, 2.1257], [-1.8199, -0.4299])),
        (false, (0.5607, [3.7088, 2.9952], [-2.9296, 0.696], [1.4757, 1.1983], [0.9983, 1.8631], [2.5187, -0.6588])),
        (false, (3.5504, [1.0897, 3.9588], [-1.697, 0.802], [4.6205, 3.5682], [0.5697, 0.2886], [1.8401, 1.8903])),
        (true, (4.1889, [2.1057, 4.1223], [2.3959, 2.5633], [3.9288, 1.6368], [-2.774, 1.9197], [2.0948, 1.2019])),
        (true, (4.0689, [3.4016, 0.8191], [2.6001, -2.3356], [3.3453, 2.6955], [0.9, 0.5385], [0.7131, -1.059])),
    ];
    for (is_first, (crank, loop_lengths, d, second, g, m)) in dimensions {
        let watt = Watt { frame: 1.0, crank, loop_lengths, d, second, g, m };
        check_layouts(|layout| if is_first { watt.first(layout) } else { watt.second(layout) }, &watt);
    }
}

/// Pins and points of the first loop of Watt linkages that return on their paths, so that a few of the polynomials begin within rounding
/// of where they stop.
#[test]
fn circular_portions_of_paths_that_return_are_the_same_in_all_layouts() {
    let [b, g] = [3, 5].map(JointId::new);
    let dimensions: [(bool, JointId, WattDimensions); 4] = [
        (false, b, (1.767, [4.9753, 2.398], [1.8744, 2.8331], [0.4555, 4.3141], [-1.8988, 1.5217], [1.9881, -0.0343])),
        (
            false,
            b,
            (4.7252, [2.3107, 4.9057], [-0.8545, -2.3452], [0.3573, 3.2034], [-2.2647, -2.0449], [1.4156, 2.3381]),
        ),
        (
            true,
            g,
            (0.6336, [3.4276, 2.0948], [-0.4675, 2.7604], [3.5043, 1.6809], [-2.2322, 1.1587], [1.7466, -1.0594]),
        ),
        (true, g, (1.4165, [1.8885, 1.0767], [0.4513, 2.9541], [1.5999, 1.6985], [2.1764, 1.4867], [-2.0234, -1.5846])),
    ];
    for (is_first, traced, (crank, loop_lengths, d, second, g, m)) in dimensions {
        let watt = Watt { frame: 1.0, crank, loop_lengths, d, second, g, m };
        let linkage = |layout| Linkage {
            traced: vec![traced],
            ..if is_first { watt.first(layout) } else { watt.second(layout) }
        };
        check_layouts(linkage, &(watt, traced));
    }
}

proptest! {
    #![proptest_config(crate::random())]

    /// Half of them are driven by a rocker, whose curves go back along themselves.
    #[test]
    #[ignore = "thorough"]
    fn circular_portions_of_random_watt_linkages_are_no_wider_than_allowed(watt in watt(), is_first in any::<bool>()) {
        let linkage = if is_first { watt.first(Layout::PLAIN) } else { watt.second(Layout::MIRRORED) };
        check_widths(&circular_portions(&linkage), &(watt, is_first));
    }
}
