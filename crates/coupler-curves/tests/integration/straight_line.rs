//! Chapter 8 of the thesis: where the curve crosses its axis, and when it is straight there.

use coupler_curves::catalogue;
use coupler_curves::geometry::{Point, Vector, distance_to_segment, trig};
use coupler_curves::linkage::{FourBar, Sextic, SymmetricalFourBar};
use coupler_curves::motion::{Motion, Sampler, Sampling};

const BOTH: [SymmetricalFourBar; 2] = [SymmetricalFourBar::Evans, SymmetricalFourBar::Chebyshev];

/// Frame lengths from 1.1 to 10 by tenths.
fn frame_lengths() -> impl Iterator<Item = f64> {
    (11..=100).map(|k| f64::from(k) / 10.0)
}

fn sextic(kind: SymmetricalFourBar, [frame, short, long]: [f64; 3]) -> Sextic {
    let (four_bar, point) = kind.four_bar(frame, short, long);
    Sextic::from_four_bar(four_bar, point).unwrap()
}

#[test]
fn forms_are_recognised_by_their_lengths() {
    for kind in BOTH {
        for [frame, short, long] in [[2.0, 1.0, 2.6], [0.1, 0.7, 0.3], [4.0, 2.0, 2.0]] {
            let (four_bar, point) = kind.four_bar(frame, short, long);
            assert_eq!(SymmetricalFourBar::from_four_bar(four_bar, point), Some((kind, [frame, short, long])));
            assert_eq!(SymmetricalFourBar::from_four_bar(four_bar, point + Vector::new(0.0, 0.01)), None);
            let other = FourBar { rocker: four_bar.rocker * 1.01, ..four_bar };
            assert_eq!(SymmetricalFourBar::from_four_bar(other, point), None);
        }
    }
}

/// The conditions (8.10) and (8.19), and at any size (8.8) and (8.16).
#[test]
fn the_conditions_are_those_of_the_thesis() {
    for kind in BOTH {
        for p in frame_lengths() {
            for size in [1.0, 0.37, 12.0] {
                let derived = kind.straight_long_length(p * size, size).unwrap() / size;
                let closed = trig::pow(1.0 + p, 1.5) / 2.0;
                // The sum of 28 terms of the sixth degree, through coefficients of as many digits.
                assert!((derived - closed).abs() <= 2e-13 * closed, "{kind:?} {p} {size}: {derived} {closed}");
            }
        }
        // The figure of the thesis with p = 3: a = 4.
        assert!((kind.straight_long_length(3.0, 1.0).unwrap() - 4.0).abs() < 1e-12);
        assert_eq!(
            [
                kind.straight_long_length(0.0, 1.0),
                kind.straight_long_length(2.0, -1.0),
                kind.straight_long_length(f64::NAN, 1.0)
            ],
            [None; 3]
        );
        assert_eq!(kind.straight_long_length(f64::INFINITY, 1.0), None);
    }
}

/// (8.5) and (8.14): at its axis the curve is level whatever the lengths; and to either side of the condition it is
/// curved, in the senses that (8.7) and the equation after (8.14) give at the crossings.
#[test]
fn the_curve_is_level_at_its_axis_and_straight_at_the_condition() {
    for kind in BOTH {
        for p in frame_lengths() {
            let straight = trig::pow(1.0 + p, 1.5) / 2.0;
            for (factor, sign) in [(0.9, 1.0), (1.0, 0.0), (1.1, -1.0)] {
                let long = straight * factor;
                let Some([slope, second]) = kind.crossing_derivatives(p, 1.0, long) else {
                    assert!(2.0 * long <= 1.0 + p, "{kind:?} {p}");
                    continue;
                };
                assert!(slope.abs() < 1e-10, "{kind:?} {p}: {slope}");
                let expected = if sign == 0.0 { second.abs() < 1e-10 } else { second * sign > 1e-6 };
                assert!(expected, "{kind:?} {p} {factor}: {second}");
            }
        }
    }
}

/// (8.8) and (8.16) with their factors: the second derivative by x of (8.1) and (8.11) at the nearer crossing.
#[test]
fn the_second_derivatives_are_those_of_the_thesis() {
    for (p, short, long) in [(2.0, 1.0, 2.6), (3.0, 0.7, 3.1), (5.0, 1.3, 8.0), (1.5, 1.0, 1.4)] {
        for kind in BOTH {
            let [_, crossing] = kind.axis_crossings(p, short, long);
            let [xx, _, _] = sextic(kind, [p, short, long]).second_derivatives(crossing.unwrap());
            let (sum, l2) = (p + short, long * long);
            let cubic = sum * sum * sum - 4.0 * l2 * short;
            // Evans in (8.8): p, r = short, a = long. Chebyshev in (8.16): 2 a = short, r = long, and (8.11) leads with
            // 4.
            let expected = match kind {
                SymmetricalFourBar::Evans => 8.0 * p * cubic,
                SymmetricalFourBar::Chebyshev => 2.0 * p * cubic / 4.0,
            };
            assert!((xx - expected).abs() <= 1e-11 * (long * long * l2 + xx.abs()), "{kind:?}: {xx} {expected}");
        }
    }
}

/// (8.3) and (8.12): the crossings satisfy the sextic, and are all its points on the axis but the double point on the
/// frame (8.2).
#[test]
fn crossings_are_where_the_curve_meets_its_axis() {
    for kind in BOTH {
        for p in frame_lengths() {
            // Below, at and above the condition.
            for factor in [0.97, 1.0, 1.2] {
                let lengths = [p, 1.0, factor * trig::pow(1.0 + p, 1.5) / 2.0];
                let sextic = sextic(kind, lengths);
                let crossings = kind.axis_crossings(p, 1.0, lengths[2]);
                let axis = Point::new(kind.axis_x(p), 0.0);
                let intersections = sextic.line_intersections(axis, Vector::new(0.0, 1.0));
                let above: Vec<&Point> = intersections.iter().filter(|q| q.y > 1e-4).collect();
                assert_eq!(above.len(), crossings.iter().flatten().count(), "{kind:?} {p}: {intersections:?}");
                for crossing in crossings.into_iter().flatten() {
                    let [value, terms] = sextic.evaluate(crossing);
                    assert!(value.abs() <= 1e-13 * terms, "{kind:?} {p}: {value} of {terms}");
                    // Through coefficients of the sixth degree in lengths up to forty.
                    let near = above.iter().map(|q| (*q - crossing).norm()).fold(f64::INFINITY, f64::min);
                    assert!(near < 1e-9 * crossing.y, "{kind:?} {p}: {near}");
                }
            }
        }
    }
}

#[test]
fn the_linkages_pass_through_the_crossings() {
    for p in [1.5, 2.0, 3.0, 6.0, 10.0] {
        let long = trig::pow(1.0 + p, 1.5) / 2.0;
        for kind in BOTH {
            let (id, values) = match kind {
                // p, r, a, s, k and p, r, s, a.
                SymmetricalFourBar::Evans => ("evans", vec![p, 1.0, long, long, 2.0]),
                SymmetricalFourBar::Chebyshev => ("chebyshev", vec![p, long, long, 1.0, 0.5]),
            };
            let linkage = catalogue::find(id).unwrap().linkage(&values).unwrap();
            let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(0.1)));
            let path: Vec<Point> = motion.circuits[0].points(linkage.traced[0]).collect();
            for crossing in kind.axis_crossings(p, 1.0, long).into_iter().flatten() {
                let chords = path.windows(2).map(|pair| distance_to_segment(crossing, pair[0], pair[1]));
                // With a crank of 1 and steps of a tenth of a degree, a chord is off by 1e-6 at most.
                let near = chords.fold(f64::INFINITY, f64::min);
                assert!(near < 1e-6, "{id} {p}: {near}");
            }
        }
    }
}
