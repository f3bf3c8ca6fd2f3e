//! What is measured is a property of the curve: it does not depend on where the circuit begins, nor on which way the linkage is
//! turned, and of the mirror image it is the same or the mirror image.
//!
//! A linkage turned by an angle has its input counted from elsewhere, and so its circuit cut elsewhere.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{CircuitSelection, JointId, Linkage, LinkageBuilder, MotionOptions, Side};
use coupler_curves::measure::{self, TracedCurve, Value};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use proptest::prelude::*;

use crate::measures::number;

/// How a linkage is laid on the plane.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    turn_deg: f64,
    is_mirrored: bool,
    scale: f64,
}

impl Layout {
    pub const PLAIN: Layout = Layout { turn_deg: 0.0, is_mirrored: false, scale: 1.0 };

    fn turned(turn_deg: f64) -> Layout {
        Layout { turn_deg, ..Layout::PLAIN }
    }

    const MIRRORED: Layout = Layout { is_mirrored: true, ..Layout::PLAIN };

    fn sign(self) -> f64 {
        if self.is_mirrored { -1.0 } else { 1.0 }
    }

    fn point(self, x: f64, y: f64) -> Point {
        let (cos, sin) = trig::cos_sin_deg(self.turn_deg);
        let (x, y) = (self.scale * x, self.scale * self.sign() * y);
        Point::new(cos * x - sin * y, sin * x + cos * y)
    }

    fn length(self, length: f64) -> f64 {
        self.scale * length
    }

    fn across(self, across: f64) -> f64 {
        self.scale * self.sign() * across
    }

    fn side(self) -> Side {
        if self.is_mirrored { Side::Right } else { Side::Left }
    }
}

/// A linkage with one traced point, in a layout.
fn finish(builder: LinkageBuilder, traced: JointId) -> Linkage {
    let options = MotionOptions { circuits: CircuitSelection::All, ..MotionOptions::default() };
    builder.build(vec![traced], None, options).unwrap()
}

/// A four-bar and a point of its coupler.
fn four_bar(layout: Layout, [frame, crank, coupler, rocker]: [f64; 4], (along, across): (f64, f64)) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let c = builder.fixed("C", layout.point(frame, 0.0));
    let a = builder.crank("A", o, layout.length(crank)).unwrap();
    let lengths = [coupler, rocker].map(|length| layout.length(length));
    let b = builder.dyad("B", [a, c], lengths, layout.side()).unwrap();
    let m = builder.point("M", [a, b], layout.length(along), layout.across(across)).unwrap();
    finish(builder, m)
}

/// A point of a planet gear: the sum of a circle and one that is passed `ratio` times in a turn.
fn epicycle(layout: Layout, (radius, arm): (f64, f64), ratio: f64, phase_deg: f64) -> Linkage {
    let mut builder = LinkageBuilder::default();
    let o = builder.fixed("O", Point::origin());
    let a = builder.crank("A", o, layout.length(radius)).unwrap();
    let phase = layout.sign() * phase_deg + (1.0 - ratio) * layout.turn_deg;
    let m = builder.gear("M", (a, layout.length(arm)), [ratio, 1.0], phase).unwrap();
    finish(builder, m)
}

/// Dimensions of a Watt linkage: C, O A, A B, C B, D on the first link of the loop, G on the second, D E, G E, and M on D E.
#[derive(Clone, Copy, Debug)]
pub struct Watt {
    frame: f64,
    crank: f64,
    loop_lengths: [f64; 2],
    d: [f64; 2],
    second: [f64; 2],
    g: [f64; 2],
    m: [f64; 2],
}

impl Watt {
    /// Watt I: D on the crank's link, G on the coupler.
    fn first(self, layout: Layout) -> Linkage {
        let (mut builder, [o, _, a, b]) = self.first_loop(layout);
        let d = builder.point("D", [o, a], layout.length(self.d[0]), layout.across(self.d[1])).unwrap();
        let g = builder.point("G", [a, b], layout.length(self.g[0]), layout.across(self.g[1])).unwrap();
        self.second_loop(layout, builder, d, g)
    }

    /// Watt II: D on the rocker, and a second pivot for G.
    fn second(self, layout: Layout) -> Linkage {
        let (mut builder, [_, c, _, b]) = self.first_loop(layout);
        let d = builder.point("D", [c, b], layout.length(self.d[0]), layout.across(self.d[1])).unwrap();
        let q = builder.fixed("Q", layout.point(self.g[0], self.g[1]));
        self.second_loop(layout, builder, d, q)
    }

    fn first_loop(self, layout: Layout) -> (LinkageBuilder, [JointId; 4]) {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let c = builder.fixed("C", layout.point(self.frame, 0.0));
        let a = builder.crank("A", o, layout.length(self.crank)).unwrap();
        let lengths = self.loop_lengths.map(|length| layout.length(length));
        let b = builder.dyad("B", [a, c], lengths, layout.side()).unwrap();
        (builder, [o, c, a, b])
    }

    fn second_loop(self, layout: Layout, mut builder: LinkageBuilder, d: JointId, g: JointId) -> Linkage {
        let e = builder.dyad("E", [d, g], self.second.map(|length| layout.length(length)), layout.side()).unwrap();
        let m = builder.point("M", [d, e], layout.length(self.m[0]), layout.across(self.m[1])).unwrap();
        if builder.set_output_link([g, e]).is_err() {
            builder.set_output_link([d, e]).unwrap();
        }
        finish(builder, m)
    }
}

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
fn a_pin_that_rocks_has_the_length_and_the_curvature_of_its_arc() {
    for bar in [[3.966, 0.609, 1.88, 2.824], [4.0, 1.5, 3.0, 3.5], [4.0, 1.0, 3.0, 3.5], [5.0, 2.0, 4.0, 4.5]] {
        for turn in [0.0, 45.0, 123.4] {
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
                let mut builder = LinkageBuilder::default();
                let o = builder.fixed("O", Point::origin());
                let guide = [0.0, 1.0].map(|x| layout.point(x, offset));
                let guide = [builder.fixed("G", guide[0]), builder.fixed("H", guide[1])];
                let a = builder.crank("A", o, crank).unwrap();
                let p = builder.slide("P", (a, rod), (guide, 0.0), Side::Left).unwrap();
                let linkage = finish(builder, p);
                for values in measures(&linkage) {
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
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::origin());
        let x = builder.fixed("X", layout.point(1.0, 0.0));
        let a = builder.crank("A", o, 1.0).unwrap();
        let y = builder.yoke("Y", a, ([o, x], 0.0), 90.0).unwrap();
        number(value(&measures(&finish(builder, y))[0], "dwell_input_deg"))
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

/// A random Watt linkage, of lengths between 0.2 and 5 frames.
fn watt() -> impl Strategy<Value = Watt> {
    let length = || 0.2..5.0;
    let offset = || -3.0..3.0;
    let lengths = (length(), [length(), length()], [length(), length()]);
    (lengths, [offset(), offset()], [offset(), offset()], [offset(), offset()])
        .prop_map(|((crank, loop_lengths, second), d, g, m)| Watt { frame: 1.0, crank, loop_lengths, d, second, g, m })
}

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
    let start = all.iter().min_by(|a, b| off(a.0, &a.1).total_cmp(&off(b.0, &b.1))).expect("a start").0;
    let on =
        |travel: f64| if curve.circuit.is_closed { (travel - start).rem_euclid(travelled) } else { travel - start };
    // The start is known to the distance of two points.
    let inside = 0.1..=dwell.input_span - 0.1;
    all.iter().filter(|(travel, _)| inside.contains(&on(*travel))).map(|(_, point)| *point).collect()
}

/// The layouts in which a linkage has the same portions.
const LAYOUTS: [Layout; 5] = [
    Layout::PLAIN,
    Layout::MIRRORED,
    Layout { turn_deg: 77.0, is_mirrored: false, scale: 1.0 },
    Layout { turn_deg: 213.0, is_mirrored: true, scale: 1.0 },
    Layout { turn_deg: 0.0, is_mirrored: false, scale: 8.0 },
];

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

    /// Half of them are driven by a rocker, whose curves go back along themselves.
    #[test]
    #[ignore = "thorough"]
    fn circular_portions_of_random_watt_linkages_are_no_wider_than_allowed(watt in watt(), is_first in any::<bool>()) {
        let linkage = if is_first { watt.first(Layout::PLAIN) } else { watt.second(Layout::MIRRORED) };
        check_widths(&circular_portions(&linkage), &(watt, is_first));
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
