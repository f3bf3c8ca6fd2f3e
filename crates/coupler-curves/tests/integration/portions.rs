//! Straight and circular portions against closed forms and brute force.

use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{Continuation, Linkage};
use coupler_curves::measure::{StraightCriterion, TracedCurve, Value};
use coupler_curves::motion::{Motion, Sampler, Sampling};

use crate::catalogue::default_linkage;
use crate::measures::{four_bar, measures, number};

/// An arc of angle phi lies in a strip r (1 - cos phi/2) wide over 2 r sin phi/2: their quotient is tan(phi/4) / 2. One
/// that is shorter than a twentieth of the diameter is no portion.
#[test]
fn the_straight_portion_of_a_circle_is_the_arc_in_the_strip() {
    let linkage = four_bar([4.0, 1.25, 3.0, 3.5], (1.0, 1.0));
    assert_eq!(measures(&linkage, 0, 0, 36)("straight_length"), Value::Missing);
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(36)));
    let pin = linkage.traced[0];
    for tolerance in [0.015, 0.03] {
        let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], pin)
            .with_straight_criterion(StraightCriterion::Tolerance(tolerance));
        let angle = 4.0 * trig::atan2(2.0 * tolerance, 1.0);
        let length = 2.5 * trig::sin(angle / 2.0);
        let found = curve.straight().expect("a portion");
        assert!((0.9999..=1.0).contains(&(found.length / length)), "{found:?} {length}");
        assert!(2.0 * found.deviation <= tolerance * found.length, "{found:?}");
        assert!((found.input_span - trig::degrees(angle)).abs() < 1e-3 * trig::degrees(angle), "{found:?}");
    }
}

/// The straightest portion of a given span may begin between the last sample and the first, or just beyond the first.
#[test]
fn a_portion_of_a_given_span_may_begin_near_the_first_sample() {
    let linkage = four_bar([3.211, 2.818, 3.872, 0.787], (1.753, 0.0));
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(120)));
    for circuit in &motion.circuits {
        let portion = |criterion: StraightCriterion| {
            let curve =
                TracedCurve::new(&linkage, &motion, circuit, linkage.traced[2]).with_straight_criterion(criterion);
            curve.straight().cloned().expect("a portion")
        };
        for span in [20.0, 60.0] {
            let by_input = portion(StraightCriterion::Input(span));
            assert!((by_input.input_span - span).abs() < 1e-9, "{by_input:?}");
            let by_length = portion(StraightCriterion::Length(by_input.length));
            // A portion that is as long and straighter may span another input.
            assert!(by_length.deviation <= by_input.deviation * (1.0 + 1e-6), "{by_length:?} {by_input:?}");
        }
    }
}

/// The curves of an Evans linkage are symmetrical, and those of its two circuits mirror images: half turns that begin at
/// t and at 180 - t are equally straight, and the one that begins first is reported.
#[test]
fn of_equally_straight_half_turns_the_first_is_reported() {
    // (8.10): s = (1 + p)^1.5 / 2.
    let arm = 2.75 * 2.75f64.sqrt() / 2.0;
    let linkage = four_bar([1.75, 1.0, arm, arm], (2.0 * arm, 0.0));
    let starts = [0, 1].map(|circuit| number(measures(&linkage, 2, circuit, 36)("straight_half_turn_start_deg")));
    assert!((0.0..90.0).contains(&starts[0]) && (starts[0] - starts[1]).abs() < 1e-3, "{starts:?}");
}

/// Near the condition of Chebyshev's linkage for six points on a line, the strip over 120 degrees of input touches three
/// points between the ends, so that other portions are as narrow: the longest of them is reported.
#[test]
fn of_equally_narrow_portions_the_longest_is_reported() {
    const SAMPLES: usize = 2880;
    let chebyshev = coupler_curves::catalogue::find("chebyshev").expect("in the catalogue");
    for p in [2.44675, 2.447, 2.45025] {
        let arm = (1.0 + p) * f64::sqrt(1.0 + p) / 2.0;
        let linkage = chebyshev.linkage(&[p, arm, arm, 1.0, 0.5]).expect("a linkage");
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(SAMPLES)));
        let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0])
            .with_straight_criterion(StraightCriterion::Input(120.0));
        let found = curve.straight().expect("a portion");
        let points: Vec<Point> = motion.circuits[0].points(linkage.traced[0]).collect();
        // The portions that begin every three degrees: the extents across and along its narrowest strip.
        for from in (0..SAMPLES).step_by(24) {
            let part: Vec<Point> = (from..=from + SAMPLES / 3).map(|k| points[k % SAMPLES]).collect();
            let chord = part[part.len() - 1] - part[0];
            let extents = |turn: f64| {
                let (cos, sin) = (trig::cos(turn), trig::sin(turn));
                let along = [cos * chord.x - sin * chord.y, sin * chord.x + cos * chord.y].map(|c| c / chord.norm());
                let extent = |[a, b]: [f64; 2]| {
                    let heights = part.iter().map(|p| a * p.x + b * p.y);
                    heights.clone().fold(f64::NEG_INFINITY, f64::max) - heights.fold(f64::INFINITY, f64::min)
                };
                [extent([-along[1], along[0]]), extent(along)]
            };
            let (mut low, mut high) = (-0.02, 0.02);
            while high - low > 1e-9 {
                let thirds = [low + (high - low) / 3.0, high - (high - low) / 3.0];
                match extents(thirds[0])[0] < extents(thirds[1])[0] {
                    true => high = thirds[1],
                    false => low = thirds[0],
                }
            }
            let [width, length] = extents(low);
            // Between two of these points the curve is up to 2e-5 of the width further out.
            assert!(width >= 2.0 * found.deviation * (1.0 - 2e-5), "{p} {from}: {width}");
            if width <= 2.0 * found.deviation {
                assert!(length <= found.length * (1.0 + 1e-6), "{p} {from}: {length}");
            }
        }
        assert!((found.length - 2.0523).abs() < 1e-4, "{p}: {}", found.length);
    }
}

/// Next to a change point of Hart's inversor rounding is magnified so much that the measures are not exact.
#[test]
fn a_curve_that_is_not_known_exactly_is_reported() {
    let hart = coupler_curves::catalogue::find("hart-inversor").expect("in the catalogue");
    let too_close = |long: f64| {
        let linkage =
            hart.linkage(&[long, 10.852373624034469, 0.5752880445312264, 2.268663715672395]).expect("a linkage");
        measures(&linkage, 0, 0, 36)("too_close")
    };
    assert_eq!(too_close(10.85237362444646), Value::Word("positions"));
    assert_eq!(too_close(12.0), Value::Missing);
}

/// Peaucellier's line is straight from end to end, and spans the input from limit to limit.
#[test]
fn a_straight_line_is_straight_from_end_to_end() {
    let linkage = default_linkage("peaucellier-lipkin");
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(120)));
    let limit = motion.circuits[0].passes[0].to.input.value;
    let ends = motion.circuits[0].points(linkage.traced[0]).map(|p| p.y.abs()).fold(0.0, f64::max);
    let value = measures(&linkage, 0, 0, 120);
    assert!((number(value("straight_length")) - 2.0 * ends).abs() < 1e-9);
    assert!(number(value("straight_deviation")) < 1e-12);
    assert_eq!([number(value("inflections")), number(value("curvature_max"))], [0.0; 2]);
    assert!((number(value("straight_input_deg")) - 2.0 * limit).abs() < 1e-6, "{:?}", value("straight_input_deg"));
}

/// The longest straight portion against every portion from sample to sample.
#[test]
fn no_straight_portion_is_longer_than_the_one_found() {
    for (id, samples) in [("hoeken", 180), ("jansen", 180), ("klann", 360)] {
        let linkage = default_linkage(id);
        let value = measures(&linkage, 0, 0, samples);
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(samples)));
        let points: Vec<Point> = motion.circuits[0].points(linkage.traced[0]).collect();
        // Every portion from sample to sample, with its strip in directions about that of its chord.
        let mut longest: f64 = 0.0;
        for from in 0..samples {
            for span in 3..samples / 2 {
                let part: Vec<Point> = (from..=from + span).map(|k| points[k % samples]).collect();
                let chord = part[span] - part[0];
                let strip = |turn: f64| {
                    let (cos, sin) = (trig::cos(turn), trig::sin(turn));
                    let along =
                        [cos * chord.x - sin * chord.y, sin * chord.x + cos * chord.y].map(|c| c / chord.norm());
                    let extent = |coordinate: &dyn Fn(&Point) -> f64| {
                        part.iter()
                            .map(coordinate)
                            .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)])
                    };
                    let width = extent(&|p| along[0] * p.y - along[1] * p.x);
                    let length = extent(&|p| along[0] * p.x + along[1] * p.y);
                    (width[1] - width[0], length[1] - length[0])
                };
                // The best strip is within a few widths' slope of the chord.
                let best = (-20..=20).map(|k| strip(f64::from(k) * 1e-4)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                if best.0 <= 0.001 * best.1 {
                    longest = longest.max(best.1);
                }
                if strip(0.0).0 > 0.02 * chord.norm() {
                    break;
                }
            }
        }
        let found = number(value("straight_length"));
        // With its ends between samples the portion is longer by less than two spacings.
        assert!(found >= longest * 0.999 && found < 1.2 * longest, "{id}: {found} {longest}");
        assert!(number(value("straight_deviation")) <= 0.000_51 * found, "{id}");
    }
}

/// The pins move on circles: the crank pin all the way round, the rocker pin back and forth on its arc.
#[test]
fn pins_dwell_during_the_whole_turn() {
    let linkage = four_bar([4.0, 1.25, 3.0, 3.5], (1.0, 1.0));
    for (trace, radius, centre) in [(0, 1.25, [0.0, 0.0]), (1, 3.5, [4.0, 0.0])] {
        let value = measures(&linkage, trace, 0, 120);
        let found = ["dwell_input_deg", "dwell_radius", "dwell_x", "dwell_y"].map(|name| number(value(name)));
        for (found, expected) in found.into_iter().zip([360.0, radius, centre[0], centre[1]]) {
            // Where the rocker turns back, the samples of its pin are not those of a smooth curve.
            let near = if trace == 0 { 1e-9 } else { 1e-5 };
            assert!((found - expected).abs() < near, "{trace}: {found} {expected}");
        }
        assert!(number(value("dwell_deviation")) < 1e-5, "{:?}", value("dwell_deviation"));
    }
}

/// A change-point linkage whose motion keeps its branch, so that the curve has a corner.
fn with_corner(lengths: [f64; 4], point: (f64, f64)) -> Linkage {
    let mut linkage = four_bar(lengths, point);
    linkage.motion_options.continuation = Continuation::Branch;
    linkage.traced.drain(..2);
    linkage
}

/// A corner between two samples bounds a straight portion: one that goes on beyond it must contain it.
#[test]
fn a_straight_portion_contains_the_corner_that_it_passes() {
    let linkage = with_corner([3.5, 1.0, 4.0, 1.5], (0.0, -1.25));
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(72)));
    let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
    let found = curve.straight().expect("a portion");
    let dense = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(14_400)));
    let circuit = &dense.circuits[0];
    let is_passed = |input: f64| (input - found.start_input).rem_euclid(360.0) <= found.input_span;
    let samples = circuit.inputs.iter().zip(circuit.points(linkage.traced[0]));
    let passed: Vec<Point> = samples.filter(|(input, _)| is_passed(**input)).map(|(_, point)| point).collect();
    let along = found.points[found.points.len() - 1] - found.points[0];
    // The strip is the narrowest of those in nearly the same direction.
    let width = |turn: i32| {
        let turned = along + nalgebra::Vector2::new(-along.y, along.x) * (1e-6 * f64::from(turn));
        let normal = nalgebra::Vector2::new(-turned.y, turned.x).normalize();
        let heights = passed.iter().map(|point| normal.dot(&point.coords));
        let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
        high - low
    };
    let width = (-2000..=2000).map(width).fold(f64::INFINITY, f64::min);
    assert!(passed.len() > 100 && width <= 0.001 * found.length * 1.001, "{width} {found:?}");
}

/// The longest circular portion against every portion from sample to sample, by circles whose centres are searched for
/// the narrowest ring.
#[test]
fn no_circular_portion_spans_more_than_the_one_found() {
    let ring = |points: &[Point], centre: Point| {
        let radii = points.iter().map(|p| (p - centre).norm());
        let [low, high] = radii.fold([f64::INFINITY, 0.0f64], |[low, high], r| [low.min(r), high.max(r)]);
        high - low
    };
    let of_catalogue = ["hoeken", "jansen", "hrones-nelson"].map(|id| (id, default_linkage(id)));
    let with_corner = [
        ("a corner", with_corner([1.5, 1.0, 4.0, 3.5], (4.0, 0.25))),
        ("another corner", with_corner([2.0, 1.0, 1.5, 2.5], (0.75, 0.25))),
    ];
    for (id, linkage) in of_catalogue.into_iter().chain(with_corner) {
        let samples = 90;
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(samples)));
        let curve = TracedCurve::new(&linkage, &motion, &motion.circuits[0], linkage.traced[0]);
        let dwell = curve.dwell().expect("a dwell");
        let points: Vec<Point> = motion.circuits[0].points(linkage.traced[0]).collect();
        let extent = points.iter().flat_map(|a| points.iter().map(move |b| (a - b).norm())).fold(0.0, f64::max);
        let length = number(measures(&linkage, 0, 0, samples)("length"));
        // The portion has the deviation it reports, but for the curve between its points, and is no wider than is
        // allowed.
        let (width, reported) = (ring(&dwell.points, dwell.centre), 2.0 * dwell.deviation);
        assert!((0.995 * reported..=reported * (1.0 + 1e-9)).contains(&width), "{id}: {width} {reported}");
        assert!(dwell.deviation <= 0.000_505 * extent, "{id}: {} {extent}", dwell.deviation);
        // No portion one sample longer fits: a pattern search for its narrowest ring ends above the limit.
        let span = (dwell.input_span / 360.0 * samples as f64).floor() as usize + 1;
        for from in 0..samples {
            let part: Vec<Point> = (from..=from + span).map(|k| points[k % samples]).collect();
            let circle = {
                // The search starts from the circle through the ends and the middle.
                let [a, b, c] = [part[0], part[span / 2], part[span]];
                let (u, v) = (b - a, c - a);
                let d = 2.0 * (u.x * v.y - u.y * v.x);
                let (uu, vv) = (u.norm_squared(), v.norm_squared());
                a + nalgebra::Vector2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / d
            };
            let (mut centre, mut step) = (circle, extent * 0.1);
            while step > 1e-7 * extent {
                let around = (0..16).map(|k| {
                    let (cos, sin) = trig::cos_sin_deg(22.5 * f64::from(k));
                    centre + nalgebra::Vector2::new(cos, sin) * step
                });
                let best = around.min_by(|a, b| ring(&part, *a).total_cmp(&ring(&part, *b))).unwrap();
                if ring(&part, best) < ring(&part, centre) { centre = best } else { step /= 2.0 }
            }
            let radius = (part[0] - centre).norm();
            let is_straight = radius > length;
            assert!(is_straight || ring(&part, centre) > 0.001 * extent * 0.999, "{id} from {from}: {span} samples");
        }
    }
}
