//! Files of closed curves without their first point at the end are read as closed, and those of arcs as open.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use coupler_curves::catalogue;
use coupler_curves::family::Sampling;
use coupler_curves::geometry::trig;
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::Solver;

use super::read;
use crate::find_linkage::random_curves::{Random, with_defaults};

/// A curve by its input.
type Curve = Box<dyn Fn(f64) -> [f64; 2]>;

/// How a path of a curve is written.
struct Case {
    count: usize,
    /// The part of a turn of the input from the first point to the last; of a closed curve, from the first to the first again.
    part: f64,
    is_closed: bool,
    /// Of a closed curve, whether the first point is written again.
    is_repeated: bool,
    /// The deviation of each coordinate, in parts of the size of the path.
    noise: f64,
}

/// A crank and rocker, or a drag link, by the intersection of two circles.
fn four_bar(random: &mut Random) -> Curve {
    let [frame, crank, coupler, rocker] = loop {
        let lengths = [random.between(0.3, 5.0), 1.0, random.between(0.3, 5.0), random.between(0.3, 5.0)];
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        let is_full_turn = sorted[0] == lengths[0] || sorted[0] == lengths[1];
        if is_full_turn && sorted[0] + sorted[3] < sorted[1] + sorted[2] - 0.02 {
            break lengths;
        }
    };
    let [along, across] = [random.between(-1.0, 2.0), random.between(-1.5, 1.5)];
    Box::new(move |input| {
        let a = [crank * trig::cos(input), crank * trig::sin(input)];
        let to_pivot = [frame - a[0], -a[1]];
        let distance = (to_pivot[0] * to_pivot[0] + to_pivot[1] * to_pivot[1]).sqrt();
        let x = (distance * distance + coupler * coupler - rocker * rocker) / (2.0 * distance);
        let y = (coupler * coupler - x * x).sqrt();
        let unit = to_pivot.map(|value| value / distance);
        let b = [x * unit[0] - y * unit[1], x * unit[1] + y * unit[0]];
        [a[0] + along * b[0] - across * b[1], a[1] + along * b[1] + across * b[0]]
    })
}

/// A point of a planet gear, within or outside its pitch circle.
fn planet_gear(random: &mut Random) -> Curve {
    let ratio = [-4.0, -3.0, -2.0, 2.0, 3.0, 4.0, 5.0][(7.0 * random.number()) as usize];
    let radius = random.between(0.1, 1.5) / f64::abs(ratio);
    let start = random.between(0.0, TAU);
    Box::new(move |input| {
        let turned = ratio * input + start;
        [trig::cos(input) + radius * trig::cos(turned), trig::sin(input) + radius * trig::sin(turned)]
    })
}

/// A file of the curve from a random input on, in a random direction.
fn file(curve: &Curve, case: &Case, random: &mut Random) -> String {
    let (start, direction) = (random.between(0.0, TAU), if random.number() < 0.5 { 1.0 } else { -1.0 });
    let steps = if case.is_closed { case.count } else { case.count - 1 };
    let points = case.count + usize::from(case.is_repeated);
    let point = |k: usize| curve(start + direction * TAU * case.part * k as f64 / steps as f64);
    let mut path: Vec<[f64; 2]> = (0..points).map(point).collect();
    let mean = [0, 1].map(|axis| path.iter().map(|point| point[axis]).sum::<f64>() / points as f64);
    let square = |point: &[f64; 2]| {
        let [x, y] = [point[0] - mean[0], point[1] - mean[1]];
        x * x + y * y
    };
    let size = (path.iter().map(square).sum::<f64>() / points as f64).sqrt();
    // The sum of three even numbers is nearly normal.
    let mut normal = || 2.0 * (random.number() + random.number() + random.number() - 1.5);
    for point in &mut path {
        *point = point.map(|value| value + case.noise * size * normal());
    }
    let mut text = "x,y\n".to_owned();
    for [x, y] in path {
        writeln!(text, "{x:.8},{y:.8}").unwrap();
    }
    text
}

/// Whether the path in a file is read as closed, and what is said.
fn reading(text: &str) -> (bool, String) {
    let mut outline = read(text).unwrap();
    (outline.decide_closed(), outline.reading.taken)
}

/// How many of so many random cases are misread, and how many of these are said to be certain.
fn misread(cases: usize, curve: fn(&mut Random) -> Curve, random: &mut Random, case: &Case) -> [usize; 2] {
    let mut wrong = [0; 2];
    for _ in 0..cases {
        let (is_closed, taken) = reading(&file(&curve(random), case, random));
        if is_closed != case.is_closed {
            wrong[0] += 1;
            wrong[1] += usize::from(!taken.contains("not certain"));
        }
    }
    wrong
}

/// The misread cases that are allowed, if there may be so many of 200.
fn allowed(of_200: usize, cases: usize) -> usize {
    (of_200 * cases).div_ceil(200)
}

fn check_closed(cases: usize) {
    let random = &mut Random(7);
    for (count, noise, most) in [
        (24, 0.0, 4),
        (36, 0.0, 2),
        (60, 0.0, 0),
        (100, 0.0, 0),
        (360, 0.0, 0),
        (36, 0.003, 2),
        (72, 0.003, 2),
        (180, 0.01, 4),
    ] {
        for is_repeated in [false, true] {
            let case = Case { count, part: 1.0, is_closed: true, is_repeated, noise };
            for curve in [four_bar, planet_gear] {
                let [wrong, certain] = misread(cases, curve, random, &case);
                assert!(wrong <= allowed(most, cases) && certain == 0, "{count} {noise} {is_repeated}: {wrong}");
            }
        }
    }
}

fn check_arcs(cases: usize) {
    // Of few points that end where the curve is slow or crosses itself, the ends are near.
    let random = &mut Random(8);
    for (count, parts, noise, most) in [
        (24, [0.3, 0.5, 0.8], 0.0, 14),
        (36, [0.3, 0.6, 0.9], 0.0, 14),
        (72, [0.3, 0.8, 0.93], 0.0, 8),
        (180, [0.3, 0.6, 0.95], 0.0, 2),
        (180, [0.3, 0.6, 0.95], 0.01, 4),
        (360, [0.3, 0.6, 0.95], 0.003, 2),
    ] {
        for part in parts {
            let case = Case { count, part, is_closed: false, is_repeated: false, noise };
            for curve in [four_bar, planet_gear] {
                let [wrong, certain] = misread(cases, curve, random, &case);
                assert!(
                    wrong <= allowed(most, cases) && certain <= allowed(most / 2, cases),
                    "{count} {part} {noise}: {wrong} {certain}"
                );
            }
        }
    }
}

#[test]
fn closed_curves_at_equal_steps_of_the_input_are_closed_and_their_arcs_open() {
    check_closed(3);
    check_arcs(3);
}

#[test]
#[ignore = "thorough"]
fn many_closed_curves_are_closed_and_their_arcs_open() {
    check_closed(200);
    check_arcs(200);
}

#[test]
fn drawn_arcs_are_open_and_rings_closed() {
    let random = &mut Random(9);
    for count in [12, 20, 50, 100] {
        for (degrees, least) in [(180.0, 5), (250.0, 8), (300.0, 12), (330.0, 30), (360.0, 5)] {
            // A pen that is slow at both ends, or not.
            for slow in [0.0, 0.5, 0.9] {
                for wide in [0.6, 1.0, 1.5] {
                    let turn = degrees / 360.0 * TAU;
                    let curve: Curve = Box::new(move |input| {
                        let angle = input - slow * trig::sin(TAU * input / turn) * turn / TAU;
                        [trig::cos(angle), wide * trig::sin(angle)]
                    });
                    let is_closed = degrees == 360.0;
                    if count < least {
                        continue;
                    }
                    let mut text = String::new();
                    let steps = if is_closed { count } else { count - 1 };
                    for k in 0..count {
                        let [x, y] =
                            curve(turn * k as f64 / steps as f64).map(|value| value + 0.004 * (random.number() - 0.5));
                        writeln!(text, "{x} {y}").unwrap();
                    }
                    assert_eq!(reading(&text).0, is_closed, "{count} {degrees} {slow} {wide}");
                }
            }
        }
    }
}

#[test]
fn what_is_not_certain_is_said_to_be_so() {
    // A regular polygon without its last corner: the gap is two steps, and the chord of two is shorter.
    let polygon = |count: usize, corners: usize| {
        let mut text = String::new();
        for k in 0..count {
            let angle = TAU * k as f64 / corners as f64;
            writeln!(text, "{} {}", trig::cos(angle), trig::sin(angle)).unwrap();
        }
        reading(&text)
    };
    for corners in [12, 40, 100] {
        assert_eq!(
            polygon(corners, corners),
            (true, "x is column 1, y column 2; closed, for its ends are near".to_owned())
        );
        let (is_closed, taken) = polygon(corners - 1, corners);
        assert!(
            !is_closed
                && taken.ends_with(
                    "open, for its ends are apart, which is not certain: it may be closed and lack the last step"
                ),
            "{taken}"
        );
        assert!(polygon(corners / 2, corners).1.ends_with("open, for its ends are apart"));
    }
}

#[test]
fn the_reading_does_not_depend_on_unit_or_place() {
    let random = &mut Random(10);
    for _ in 0..40 {
        let case = Case { count: 30, part: 1.0, is_closed: true, is_repeated: false, noise: 0.01 };
        let text = file(&four_bar(random), &case, random);
        let points = read(&text).unwrap().points;
        let expected = reading(&text);
        for scale in [1e-300, 1e-12, 3.0, 1e300] {
            let mut scaled = "x,y\n".to_owned();
            for point in &points {
                writeln!(scaled, "{:e},{:e}", scale * point.x, -scale * point.y).unwrap();
            }
            assert_eq!(reading(&scaled), expected, "{scale}");
        }
    }
    for text in
        ["1 2", "1 2\n1 2", "1 2\n3 4", "1 2\n3 4\n1 2", "1e308 0\n-1e308 0\n0 1e308", "1 1\n1 1\n1 1\n1 1\n2 2"]
    {
        reading(text);
    }
}

/// Linkages of the catalogue with their default dimensions, by which the rule was not made.
#[test]
#[ignore = "thorough"]
fn curves_of_the_catalogue_are_closed_and_their_arcs_open() {
    let mut wrong = [0; 2];
    let mut cases = [0; 2];
    for template in catalogue::all() {
        for count in [24, 36, 72, 180, 360] {
            let family = with_defaults(template, Sampling::Samples(count));
            let Some(solved) = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0) else {
                continue;
            };
            for curve in &solved.curves {
                let circuit = solved.circuit(curve);
                if !circuit.is_full_turn() {
                    continue;
                }
                let points: Vec<_> = circuit.points(curve.joint).collect();
                for start in (0..points.len()).step_by(points.len() / 12) {
                    let path = |length: usize| {
                        let mut text = "x,y\n".to_owned();
                        for point in points.iter().cycle().skip(start).take(length) {
                            writeln!(text, "{},{}", point.x, point.y).unwrap();
                        }
                        reading(&text).0
                    };
                    cases[0] += 1;
                    wrong[0] += usize::from(!path(points.len()));
                    for part in [0.3, 0.6, 0.85, 0.95] {
                        let length = (part * points.len() as f64) as usize;
                        if points.len() - length >= 3 {
                            cases[1] += 1;
                            wrong[1] += usize::from(path(length));
                        }
                    }
                }
            }
        }
    }
    assert!(cases[0] > 1000 && 100 * wrong[0] <= cases[0] && 25 * wrong[1] <= cases[1], "{wrong:?} of {cases:?}");
}
