//! Looking up and fitting given curves: against brute force, closed forms and by invariance.

use coupler_curves::geometry::{Complex, Point, Similarity, Vector, trig};
use coupler_curves::{FourBar, FourBarClass};
use coupler_find::{CurveFit, CurveFitOptions, CurveFitter, CurveIndex, CurveLookup, PathKind, Target};

/// Even numbers from -1 to 1, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn placement(&mut self, is_mirrored: bool) -> Similarity {
        let angle = 3.1 * self.next();
        let scale = trig::exp(2.0 * self.next());
        Similarity {
            is_mirrored,
            factor: Complex::new(trig::cos(angle), trig::sin(angle)) * scale,
            shift: Complex::new(30.0 * self.next(), 30.0 * self.next()),
        }
    }

    /// The curve of a four-bar whose crank turns fully, at equal steps of it, by the intersection of two circles.
    fn coupler_curve(&mut self, samples: usize) -> Vec<Point> {
        loop {
            let mut length = || 2.2 + 1.5 * self.next();
            let [frame, coupler, rocker] = [length(), length(), length()];
            let [along, across] = [2.0 * self.next(), 2.0 * self.next()];
            let four_bar = FourBar { frame, crank: 1.0, coupler, rocker };
            if four_bar.class() != FourBarClass::CrankRocker {
                continue;
            }
            let at = |k: usize| {
                let angle = trig::radians(360.0 * k as f64 / samples as f64);
                let pin = Point::new(trig::cos(angle), trig::sin(angle));
                let diagonal = Point::new(frame, 0.0) - pin;
                let toward = (diagonal.norm_squared() + coupler * coupler - rocker * rocker) / (2.0 * diagonal.norm());
                let unit = diagonal.normalize();
                let left = Vector::new(-unit.y, unit.x);
                let bar = (unit * toward + left * (coupler * coupler - toward * toward).sqrt()) / coupler;
                pin + bar * along + Vector::new(-bar.y, bar.x) * across
            };
            return (0..samples).map(at).collect();
        }
    }
}

#[track_caller]
fn fit(target: &Target, curve: &[Point], is_closed: bool, options: CurveFitOptions) -> CurveFit {
    CurveFitter::new(target, options).fit(curve, is_closed).expect("it fits")
}

#[track_caller]
fn fit_freely(points: &[Point], kind: PathKind, curve: &[Point], is_closed: bool) -> CurveFit {
    fit(&Target::new(points, kind).unwrap(), curve, is_closed, CurveFitOptions::default())
}

/// Bounds of the deviation of points from a closed polyline of many points, in order within one turn, in the better direction: that of the
/// best order, which may be longer than a turn, and that of one which is not.
fn brute_deviation(points: &[Point], curve: &[Point]) -> [f64; 2] {
    let reversed: Vec<Point> = curve.iter().rev().copied().collect();
    let bounds = [curve, &reversed].map(|curve| {
        let count = curve.len();
        // The least sum of squares with the last point at each place of two rounds, and where its first point is.
        let mut sums = vec![(f64::INFINITY, 0); 2 * count];
        for (k, p) in points.iter().enumerate() {
            let mut best = (f64::INFINITY, 0);
            for (j, sum) in sums.iter_mut().enumerate() {
                best = match k {
                    0 if j < count => (0.0, j),
                    0 => (f64::INFINITY, j),
                    _ if sum.0 < best.0 => *sum,
                    _ => best,
                };
                *sum = (best.0 + (curve[j % count] - p).norm_squared(), best.1);
            }
        }
        let least = |is_counted: &dyn Fn(usize) -> bool| {
            let counted = sums.iter().enumerate().filter(|(j, (_, first))| is_counted(j - first));
            counted.map(|(_, (sum, _))| *sum).fold(f64::INFINITY, f64::min)
        };
        [least(&|_| true), least(&|turn| turn <= count)]
    });
    [0, 1].map(|bound| (bounds[0][bound].min(bounds[1][bound]) / points.len() as f64).sqrt())
}

#[test]
fn a_curve_in_another_place_is_found_there_to_rounding() {
    let mut random = Random(7);
    for case in 0..40 {
        let curve = random.coupler_curve(360);
        let placement = random.placement(case % 2 == 0);
        let mut points: Vec<Point> = curve.iter().step_by(4).map(|p| placement.apply(*p)).collect();
        points.rotate_left(7 * case % 90);
        if case % 3 == 0 {
            points.reverse();
        }
        let found = fit_freely(&points, PathKind::Closed, &curve, true);
        assert!(found.deviation.rms_relative < 1e-9, "{case}: {found:?}");
        let far = curve.iter().map(|p| (found.placement.apply(*p) - placement.apply(*p)).norm()).fold(0.0, f64::max);
        assert!(far < 1e-8 * placement.scale(), "{case}: {far}");
        assert!(found.deviation.is_in_order && (found.deviation.length_ratio - 1.0).abs() < 0.01, "{case}: {found:?}");
    }
}

/// Points between the samples are on the curve: the spline is known to what its documentation says.
#[test]
fn the_deviation_is_that_of_the_curve_and_not_of_its_samples() {
    for (samples, accuracy) in [(90, 1e-4), (180, 4e-5), (360, 8e-6)] {
        let mut random = Random(3);
        let mut worst = 0.0f64;
        for _ in 0..40 {
            let fine = random.coupler_curve(720);
            let curve: Vec<Point> = fine.iter().step_by(720 / samples).copied().collect();
            let points: Vec<Point> = fine.iter().skip(1).step_by(8).copied().collect();
            worst = worst.max(fit_freely(&points, PathKind::Closed, &curve, true).deviation.rms_relative);
        }
        println!("{samples} samples: {worst:e}");
        assert!(worst < accuracy, "{samples}: {worst}");
    }
}

#[test]
fn a_fit_is_as_near_as_brute_force_finds() {
    assert_fits_are_as_near_as_brute_force_finds(&mut Random(11), 2);
}

#[test]
#[ignore = "thorough"]
fn many_fits_are_as_near_as_brute_force_finds() {
    assert_fits_are_as_near_as_brute_force_finds(&mut Random(13), 10);
}

fn assert_fits_are_as_near_as_brute_force_finds(random: &mut Random, cases: usize) {
    for case in 0..cases {
        let fine = random.coupler_curve(36_000);
        let curve: Vec<Point> = fine.iter().step_by(100).copied().collect();
        let placement = random.placement(case % 2 == 0);
        let noise = 0.03 * placement.scale();
        let points: Vec<Point> = curve
            .iter()
            .step_by(6)
            .map(|p| placement.apply(*p) + Vector::new(random.next(), random.next()) * noise)
            .collect();
        let target = Target::new(&points, PathKind::Closed).unwrap();
        let free = fit(&target, &curve, true, CurveFitOptions::default());
        let placed_in = |placement: &Similarity, step: usize| -> Vec<Point> {
            fine.iter().step_by(step).map(|p| placement.apply(*p)).collect()
        };
        let placed = |placement: &Similarity| placed_in(placement, 10);
        let is_within = |rms: f64, [low, high]: [f64; 2]| low * (1.0 - 5e-5) < rms && rms < high * (1.0 + 5e-5);
        let deviations = brute_deviation(&points, &placed_in(&free.placement, 1));
        assert!(is_within(free.deviation.rms, deviations), "{case}: {} {deviations:?}", free.deviation.rms);
        // No similarity near it is better, nor the one that the points were made with.
        let others = (0..30).map(|_| {
            let mut by = || Complex::new(random.next(), random.next());
            let Similarity { is_mirrored, factor, shift } = free.placement;
            let size = 0.002 * target.size();
            Similarity {
                is_mirrored,
                factor: factor + by() * 0.002 * factor.norm_sqr().sqrt(),
                shift: shift + by() * size,
            }
        });
        let others: Vec<Similarity> = others.chain([placement]).collect();
        for other in others {
            assert!(
                free.deviation.rms <= brute_deviation(&points, &placed(&other))[1] * (1.0 + 1e-4),
                "{case}: {other:?}"
            );
        }
        let fixed_curve: Vec<Point> = curve.iter().map(|p| placement.apply(*p)).collect();
        let fixed = fit(&target, &fixed_curve, true, CurveFitOptions { is_fixed: true, ..CurveFitOptions::default() });
        let deviations = brute_deviation(&points, &placed_in(&placement, 1));
        assert!(is_within(fixed.deviation.rms, deviations), "{case}: {} {deviations:?}", fixed.deviation.rms);
        assert_eq!(fixed.placement, Similarity::IDENTITY);
    }
}

#[test]
fn a_fit_is_the_same_for_similar_targets_and_curves() {
    let mut random = Random(5);
    for case in 0..40 {
        let curve = random.coupler_curve(180);
        let is_open = case % 4 == 3;
        let kind = [PathKind::Closed, PathKind::Part, PathKind::Open, PathKind::Part][case % 4];
        let range = if kind == PathKind::Closed { 0..180 } else { 20..100 };
        let noise = 0.02;
        let points: Vec<Point> =
            curve[range].iter().step_by(2).map(|p| p + Vector::new(random.next(), random.next()) * noise).collect();
        let curve = if is_open { &curve[..150] } else { &curve[..] };
        let first = fit_freely(&points, kind, curve, !is_open);
        let moved =
            |points: &[Point], placement: &Similarity| points.iter().map(|p| placement.apply(*p)).collect::<Vec<_>>();
        for is_mirrored in [false, true] {
            let [by_target, by_curve] = [random.placement(is_mirrored), random.placement(false)];
            let mut other = moved(&points, &by_target);
            let mut other_curve = moved(curve, &by_curve);
            if kind == PathKind::Closed {
                other.rotate_left(11);
            }
            if !is_open {
                other_curve.rotate_left(37);
            }
            if case % 3 == 0 {
                other.reverse();
            }
            if case % 2 == 0 {
                other_curve.reverse();
            }
            let second = fit_freely(&other, kind, &other_curve, !is_open);
            let difference = (first.deviation.rms_relative - second.deviation.rms_relative).abs();
            assert!(difference < 1e-9, "{case}, {kind:?}: {difference:e}\n{first:?}\n{second:?}");
            assert!(
                (first.deviation.length_ratio - second.deviation.length_ratio).abs() < 1e-6,
                "{case}: {first:?} {second:?}"
            );
            assert_eq!(first.placement.is_mirrored != is_mirrored, second.placement.is_mirrored, "{case}");
        }
    }
}

#[test]
fn a_portion_is_found_with_its_place_on_the_curve() {
    let mut random = Random(23);
    for case in 0..40 {
        let curve = random.coupler_curve(360);
        let placement = random.placement(case % 2 == 0);
        let (from, count) = (3 * case, 90 + 3 * case);
        let mut points: Vec<Point> =
            (from..=from + count).step_by(3).map(|k| placement.apply(curve[k % 360])).collect();
        let is_reversed = case % 3 == 0;
        if is_reversed {
            points.reverse();
        }
        let found = fit_freely(&points, PathKind::Part, &curve, true);
        assert!(found.deviation.rms_relative < 1e-8, "{case}: {found:?}");
        assert_eq!(found.is_reversed, is_reversed, "{case}");
        let length = |range: std::ops::Range<usize>| -> f64 {
            range.map(|k| (curve[(k + 1) % 360] - curve[k % 360]).norm()).sum()
        };
        let whole = length(0..360);
        let mut expected = [length(0..from) / whole, length(0..from + count) / whole];
        if is_reversed {
            expected.reverse();
        }
        let off = expected.iter().zip(found.ends).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-4, "{case}: {expected:?} {found:?}");
        assert!((found.deviation.length_ratio - 1.0).abs() < 1e-2, "{case}: {found:?}");
        // It is too short a portion, if only longer ones count.
        let options = CurveFitOptions { least_portion: 0.95, ..CurveFitOptions::default() };
        let longer = CurveFitter::new(&Target::new(&points, PathKind::Part).unwrap(), options).fit(&curve, true);
        assert!(longer.is_none_or(|longer| longer.deviation.rms_relative > 0.01), "{case}: {longer:?}");
    }
}

/// An arc is passed there and back; the whole arc is a part of its length 1, and a closed path of it twice as long.
#[test]
fn an_open_curve_is_passed_there_and_back() {
    let at = |degrees: f64| {
        Point::new(
            trig::exp(0.01 * degrees) * trig::cos(trig::radians(degrees)),
            2.0 * trig::sin(trig::radians(degrees)),
        )
    };
    let arc: Vec<Point> = (0..=150).map(|k| at(f64::from(k))).collect();
    let there_and_back: Vec<Point> = (3..=148).chain((3..148).rev()).map(|k| at(f64::from(k)) * 3.0).collect();
    let moved: Vec<Point> = there_and_back.iter().map(|p| Point::new(5.0 - p.y, p.x)).collect();
    let found = fit_freely(&moved, PathKind::Part, &arc, false);
    assert!(found.deviation.rms_relative < 0.01, "{found:?}");
    let whole: Vec<Point> = (0..=150).chain((1..150).rev()).map(|k| at(f64::from(k)) * 3.0).collect();
    let found = fit_freely(&whole, PathKind::Closed, &arc, false);
    assert!(found.deviation.rms_relative < 1e-9 && (found.deviation.length_ratio - 1.0).abs() < 1e-3, "{found:?}");
    let part: Vec<Point> = (30..=90).rev().map(|k| at(f64::from(k)) * 0.5).collect();
    let found = fit_freely(&part, PathKind::Part, &arc, false);
    assert!(found.deviation.rms_relative < 1e-6 && found.is_reversed, "{found:?}");
    assert!(found.ends.iter().all(|end| (0.0..=1.0).contains(end)) && found.ends[0] > found.ends[1], "{found:?}");
}

/// Every portion of a line that is passed there and back is like every other one; one that is long enough is found.
#[test]
fn a_straight_portion_fits_a_line() {
    let line: Vec<Point> =
        (0..120).map(|k| Point::new(20.0, 3.0 * trig::cos(trig::radians(3.0 * f64::from(k))))).collect();
    let mut random = Random(7);
    for (from, length) in [(-3.0, 1.0), (-2.9, 2.0), (-1.0, 1.3), (0.0, 3.0), (-2.0, 4.9), (2.9, -2.0), (1.2, -4.0)] {
        let placement = random.placement(length < 1.5);
        let at = |k: i32| placement.apply(Point::new(20.0, from + length * f64::from(k) / 79.0));
        let points: Vec<Point> = (0..80).map(at).collect();
        for kind in [PathKind::Open, PathKind::Part] {
            for least_portion in [0.05, 0.15, 0.3] {
                let options = CurveFitOptions { least_portion, ..CurveFitOptions::default() };
                let found = fit(&Target::new(&points, kind).unwrap(), &line, true, options);
                assert!(found.deviation.rms_relative < 1e-9, "{from} {length} {kind:?} {least_portion}: {found:?}");
            }
        }
    }
}

#[test]
fn a_mirror_image_counts_only_if_it_may() {
    let curve = Random(2).coupler_curve(360);
    let points: Vec<Point> = curve.iter().step_by(5).map(|p| Point::new(-p.x, p.y)).collect();
    let target = Target::new(&points, PathKind::Closed).unwrap();
    let options = CurveFitOptions { may_be_mirrored: false, ..CurveFitOptions::default() };
    let only_turned = CurveFitter::new(&target, options).fit(&curve, true);
    assert!(only_turned.is_none_or(|found| found.deviation.rms_relative > 1e-3 && !found.placement.is_mirrored));
    let found = fit(&target, &curve, true, CurveFitOptions::default());
    assert!(found.deviation.rms_relative < 1e-10 && found.placement.is_mirrored, "{found:?}");
}

#[test]
#[ignore = "thorough"]
fn curves_are_looked_up_in_steps() {
    let mut random = Random(31);
    let curves: Vec<Vec<Point>> = (0..3000).map(|_| random.coupler_curve(90)).collect();
    let mut index = CurveIndex::new();
    curves.iter().for_each(|curve| index.push(curve, true));
    // Curves that are none.
    index.push(&[], true);
    index.push(&[Point::new(1.0, 1.0); 9], true);
    index.push(&[Point::new(0.0, f64::NAN), Point::new(1.0, 0.0), Point::new(2.0, 0.0)], false);
    assert_eq!(CurveIndex::BYTES_PER_CURVE, 60);
    let options = CurveFitOptions::default();
    let (mut found_whole, mut found_part) = (0, 0);
    for case in 0..50 {
        let number = 59 * case;
        let placement = random.placement(case % 2 == 0);
        let points: Vec<Point> = curves[number].iter().map(|p| placement.apply(*p)).collect();
        for kind in [PathKind::Closed, PathKind::Part] {
            let points = if kind == PathKind::Closed { &points[..] } else { &points[..50] };
            let target = Target::new(points, kind).unwrap();
            let mut lookup = CurveLookup::new(&target, options, 20);
            (0..index.len()).step_by(177).for_each(|from| lookup.compare(&index, from..from + 177));
            let mut at_once = CurveLookup::new(&target, options, 20);
            at_once.compare(&index, 0..usize::MAX);
            assert!(lookup.found().eq(at_once.found()));
            assert!(lookup.found().count() <= lookup.most() && lookup.found().all(|(_, number)| number < 3000));
            // Of many portions that are about as near, those are wanted that are nearest.
            let closely = |number: usize| Some((lookup.likeness(&curves[number], true)?, number));
            let mut found: Vec<(f64, usize)> = lookup.found().filter_map(|(_, number)| closely(number)).collect();
            found.sort_by(|a, b| b.0.total_cmp(&a.0));
            found.truncate(20);
            let own = found.iter().find(|(_, other)| *other == number);
            // The polygon of the target is shorter than its curve where that is bent.
            let greatest = if kind == PathKind::Closed { 1.0 } else { 0.0 };
            assert!(own.is_none_or(|(likeness, _)| (greatest - likeness).abs() < 2e-3), "{case}: {own:?}");
            *(if kind == PathKind::Closed { &mut found_whole } else { &mut found_part }) += usize::from(own.is_some());
        }
    }
    println!("{found_whole} and {found_part} of 50");
    assert!(found_whole == 50 && found_part >= 48, "{found_whole} {found_part}");
}

/// The likeness of a curve does not depend on its place, size and direction, nor on where its points begin, and that of a mirror image only if
/// it is excluded.
#[test]
fn likeness_is_the_same_for_similar_curves() {
    /// Of the deviations in sizes: points at equal distances from another first one are others.
    const TOLERANCE: f64 = 0.002;
    let mut random = Random(41);
    for case in 0..20 {
        let curve = random.coupler_curve(360);
        let points: Vec<Point> = random.coupler_curve(360)[20..140].to_vec();
        let target = Target::new(&points, PathKind::Part).unwrap();
        let lookup = CurveLookup::new(&target, CurveFitOptions::default(), 1);
        let only_turned = CurveFitOptions { may_be_mirrored: false, ..CurveFitOptions::default() };
        let unmirrored = CurveLookup::new(&target, only_turned, 1);
        let deviation =
            |lookup: &CurveLookup, curve: &[Point]| lookup.likeness(curve, true).map(|value| (-value).sqrt());
        let first = deviation(&lookup, &curve).unwrap();
        let mut nearest = f64::INFINITY;
        for is_mirrored in [false, true] {
            let placement = random.placement(is_mirrored);
            let mut other: Vec<Point> = curve.iter().map(|p| placement.apply(*p)).collect();
            other.rotate_left(45);
            let second = deviation(&lookup, &other).unwrap();
            assert!((first - second).abs() < TOLERANCE, "{case}: {first} {second}");
            let turned = deviation(&unmirrored, &other).unwrap_or(f64::INFINITY);
            assert!(turned > second - TOLERANCE, "{case}: {turned} {second}");
            nearest = nearest.min(turned);
        }
        assert!((nearest - first).abs() < TOLERANCE, "{case}: {first} {nearest}");
    }
}

#[test]
fn what_is_no_curve_fits_nothing() {
    let points: Vec<Point> = (0..40).map(|k| Point::new(trig::cos(0.1 * f64::from(k)), f64::from(k))).collect();
    for is_fixed in [false, true] {
        for kind in [PathKind::Closed, PathKind::Open, PathKind::Part] {
            let options = CurveFitOptions { is_fixed, ..CurveFitOptions::default() };
            let fitter = CurveFitter::new(&Target::new(&points, kind).unwrap(), options);
            let at = Point::new(1.0, 2.0);
            let none: [&[Point]; 5] = [
                &[],
                &[at],
                &[at; 40],
                &[at, Point::new(f64::NAN, 0.0), at],
                &[at, Point::new(f64::INFINITY, 0.0), Point::new(0.0, 0.0)],
            ];
            for curve in none {
                assert!(fitter.fit(curve, true).is_none() && fitter.fit(curve, false).is_none());
            }
            // Few points, and some that are far apart or nearly the same, are curves.
            let odd = [at, Point::new(1.0, 2.0 + 1e-15), Point::new(1e9, -1e9), Point::new(1e9, -1e9 + 1e-7), at];
            for count in 2..=5 {
                for is_closed in [false, true] {
                    let found = fitter.fit(&odd[..count], is_closed);
                    assert!(found.is_none_or(|found| found.deviation.rms.is_finite()), "{found:?}");
                }
            }
        }
    }
}
