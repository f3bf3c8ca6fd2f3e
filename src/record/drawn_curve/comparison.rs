//! Compares a drawn curve with the samples of its curve.

use super::{DrawnCurve, FLATNESS_MM};
use coupler_curves::geometry::{Capsule, CapsuleTree, CubicBezier, Point, Spline, SplineSegment, Vector};

/// How far a drawn curve may be from its curve, in millimetres: the error of its splines and the rounding of their points.
const TOLERANCE_MM: f64 = 0.01;

impl DrawnCurve {
    /// The sample that is furthest from the drawing of its place: its index, and its distance in millimetres of the page,
    /// infinite if nothing is drawn. `None` if no sample is finite.
    ///
    /// Every sample is compared with the hairline, and each in a dash with the dashes, too.
    ///
    /// The samples are all samples of the curve in order, each with its input and its point in the plane; after the
    /// last one, a closed curve continues to the input `after_last`. Samples without finite coordinates are skipped. A
    /// sample at the end of a dash, to 1e-9 of the period and to rounding, counts as in it if the curve continues from it
    /// into the dash.
    ///
    /// Each sample takes a search in a tree of chords, which ends early if the sample is nearer than the furthest so far.
    pub fn furthest_sample(
        &self,
        samples: impl Iterator<Item = (f64, Point)>,
        after_last: Option<f64>,
    ) -> Option<(usize, f64)> {
        let (hairline, dashes) = (chord_tree(&self.hairline), chord_tree(&self.dashes));
        let mut samples = samples.enumerate().peekable();
        let (mut previous, mut travel) = (None, 0.0);
        let mut furthest: Option<(usize, f64)> = None;
        while let Some((k, (input, place))) = samples.next() {
            let next = samples.peek().map(|(_, (input, _))| *input).or(after_last);
            let is_in_dash = self.is_in_dash(input, [previous, next]);
            travel += previous.map_or(0.0, |previous: f64| (input - previous).abs());
            previous = Some(input);
            if !place.x.is_finite() || !place.y.is_finite() {
                continue;
            }
            let on_page = self.page_from_plane.apply(place);
            let dashes = (is_in_dash && self.has_dashes(travel)).then_some(&dashes);
            for tree in [&hairline].into_iter().chain(dashes) {
                let furthest_distance = furthest.map_or(f64::NEG_INFINITY, |(_, furthest_distance)| furthest_distance);
                let distance = tree.signed_distance(on_page, furthest_distance);
                if distance > furthest_distance {
                    furthest = Some((k, distance));
                }
            }
        }
        furthest
    }

    /// Whether a place is in a stretch that is drawn in dashes, and not at its end, where no dash need begin.
    fn has_dashes(&self, travel: f64) -> bool {
        let end = 1e-9 * self.dash[0] + 8.0 * f64::EPSILON * travel;
        let is_inside = |[from, to]: &[f64; 2]| from + end < travel && travel < to - end;
        self.dashed_travel.as_ref().is_none_or(|stretches| stretches.iter().any(is_inside))
    }

    /// The greatest distance, in millimetres of this page, of the end of a dash from the nearest end of a dash of another
    /// drawing of the curve, or of one of that from those of this; infinite if only one has dashes.
    pub fn furthest_dash_end(&self, other: &DrawnCurve) -> f64 {
        let ends = |curve: &DrawnCurve| -> Vec<Point> {
            let on_page = |p: Point| {
                let (scale, origin) = (curve.page_from_plane.scale(), curve.page_from_plane.origin());
                self.page_from_plane.origin() + (p - origin) * (self.page_from_plane.scale() / scale)
            };
            curve.dashes.iter().flat_map(|dash| [dash.start, dash.end()]).map(on_page).collect()
        };
        let (own, others) = (ends(self), ends(other));
        let furthest = |points: &[Point], from: &[Point]| {
            let tree = CapsuleTree::new(from.iter().map(|p| Capsule { ends: [*p, *p], radius: 0.0 }).collect());
            points.iter().fold(0.0f64, |most, point| most.max(tree.signed_distance(*point, most)))
        };
        furthest(&own, &others).max(furthest(&others, &own))
    }

    /// Whether there is a dash at an input, given the inputs of the neighbouring samples.
    fn is_in_dash(&self, input: f64, neighbours: [Option<f64>; 2]) -> bool {
        let [period, drawn] = self.dash;
        // The pages are drawn with multiples of the period, as rounded as the input itself.
        let tolerance = 1e-9 * period + 4.0 * f64::EPSILON * input.abs();
        let phase = input.rem_euclid(period);
        let continues = |sign: f64| neighbours.iter().flatten().any(|other| (other - input) * sign > 0.0);
        if drawn >= period - tolerance {
            true
        } else if phase <= tolerance || phase >= period - tolerance {
            continues(1.0)
        } else if (phase - drawn).abs() <= tolerance {
            continues(-1.0)
        } else {
            phase < drawn
        }
    }

    /// The greatest distance of the drawn lines from the curve, in millimetres of the page; `None` if they are within
    /// 0.01 mm of it.
    ///
    /// The samples are all samples of the curve in order, in the plane; `closed` says whether the curve continues from
    /// the last to the first. Where the cubic through four of them is exact enough, a drawn point on it is on the
    /// curve. The distance of any other point is that of `distance_from_curve`, of a point of the page, which may end
    /// its search at a distance that is at most its second argument.
    pub fn max_stray(
        &self,
        samples: &[Point],
        closed: bool,
        distance_from_curve: impl Fn(Point, f64) -> f64,
    ) -> Option<f64> {
        let is_place = |p: &&Point| p.x.is_finite() && p.y.is_finite();
        let places: Vec<Point> = samples.iter().filter(is_place).map(|p| self.page_from_plane.apply(*p)).collect();
        let interpolant = SampleInterpolant::new(&places, closed);
        let tubes = CapsuleTree::new(interpolant.map_or_else(Vec::new, |interpolant| interpolant.tubes()));
        let points = self.hairline.iter().chain(&self.dashes).flat_map(points_along);
        let suspects = points.filter(|point| tubes.signed_distance(*point, 0.0) > 0.0);
        // The search ends early if the distance cannot exceed the greatest so far.
        let most = suspects.fold(TOLERANCE_MM, |most, point| most.max(distance_from_curve(point, most)));
        (most > TOLERANCE_MM).then_some(most)
    }
}

/// The chords of splines.
fn chord_tree(splines: &[Spline]) -> CapsuleTree {
    let chords = |spline: &Spline| -> Vec<Capsule> {
        let points = spline.flatten(FLATNESS_MM);
        points.windows(2).map(|pair| Capsule { ends: [pair[0], pair[1]], radius: 0.0 }).collect()
    };
    CapsuleTree::new(splines.iter().flat_map(chords).collect())
}

/// Points along a spline: the ends of its segments, and some between these, about a millimetre apart at most; a segment
/// longer than 64 mm has 64 steps.
fn points_along(spline: &Spline) -> impl Iterator<Item = Point> {
    /// A cubic may deviate anywhere between its ends.
    const STEPS: [f64; 2] = [2.0, 8.0];
    let along = |(start, segment): (Point, &SplineSegment)| {
        let (cubic, least) = match *segment {
            SplineSegment::Line(end) => {
                (CubicBezier([start, start + (end - start) / 3.0, end + (start - end) / 3.0, end]), STEPS[0])
            }
            SplineSegment::Cubic([b, c, d]) => (CubicBezier([start, b, c, d]), STEPS[1]),
        };
        let CubicBezier([a, b, c, d]) = cubic;
        // No curve is longer than its control polygon.
        let steps = ((b - a).norm() + (c - b).norm() + (d - c).norm()).ceil().clamp(least, 64.0);
        (1..=steps as u32).map(move |k| cubic.point(f64::from(k) / steps))
    };
    std::iter::once(spline.start).chain(spline.segments_with_starts().flat_map(along))
}

/// The curve through samples, by cubic interpolation.
struct SampleInterpolant<'a> {
    samples: &'a [Point],
    is_closed: bool,
    /// The length of the fourth difference of each five consecutive samples, by the first of them.
    fourth_differences: Vec<f64>,
}

impl SampleInterpolant<'_> {
    /// The number of chords between two samples.
    const CHORDS_PER_INTERVAL: usize = 8;

    fn new(places: &[Point], closed: bool) -> Option<SampleInterpolant<'_>> {
        let count = places.len();
        if count < 5 {
            return None;
        }
        let windows = if closed { count } else { count - 4 };
        let fourth = |k: usize| {
            let weighted = [1.0, -4.0, 6.0, -4.0, 1.0].into_iter().enumerate();
            let sum: Vector = weighted.map(|(i, weight)| places[(k + i) % count].coords * weight).sum();
            sum.norm()
        };
        Some(SampleInterpolant {
            samples: places,
            is_closed: closed,
            fourth_differences: (0..windows).map(fourth).collect(),
        })
    }

    /// The interpolant in chords, each with the tolerance as its radius; without those that are not exact enough.
    fn tubes(&self) -> Vec<Capsule> {
        let intervals = if self.is_closed { self.samples.len() } else { self.samples.len() - 1 };
        (0..intervals).filter_map(|k| self.interval_tubes(k)).flatten().collect()
    }

    /// The chords from a sample to the next; `None` if they may be too far from the curve.
    fn interval_tubes(&self, k: usize) -> Option<impl Iterator<Item = Capsule>> {
        /// The greatest error of the chords, in millimetres. It is estimated, not bounded, and so is not a reason to
        /// report a point; and it is small enough that no greater detour is missed.
        const MAX_ERROR_MM: f64 = 0.25 * TOLERANCE_MM;
        let count = self.samples.len();
        let (first, before) = if self.is_closed {
            ((k + count - 1) % count, 1)
        } else {
            let first = k.saturating_sub(1).min(count - 4);
            (first, k - first)
        };
        let four = [0, 1, 2, 3].map(|i| self.samples[(first + i) % count]);
        let second_difference = |i: usize| (four[i].coords - four[i + 1].coords * 2.0 + four[i + 2].coords).norm();
        // The error of the chords, and the remainder of the cubic, t (t-1) (t-2) (t-3) / 24, which is larger at an end.
        let chords = second_difference(0).max(second_difference(1))
            / (8 * Self::CHORDS_PER_INTERVAL * Self::CHORDS_PER_INTERVAL) as f64;
        let remainder = if before == 1 { 3.0 / 128.0 } else { 1.0 / 24.0 } * self.max_fourth_difference(k);
        let point =
            move |j: usize| interpolate_cubic(four, before as f64 + j as f64 / Self::CHORDS_PER_INTERVAL as f64);
        let tube = move |j: usize| Capsule { ends: [point(j), point(j + 1)], radius: TOLERANCE_MM };
        (chords + remainder <= MAX_ERROR_MM).then(|| (0..Self::CHORDS_PER_INTERVAL).map(tube))
    }

    /// The largest of the fourth differences that span an interval.
    fn max_fourth_difference(&self, k: usize) -> f64 {
        let windows = self.fourth_differences.len();
        let window = |back: usize| {
            if self.is_closed { (k + windows - back) % windows } else { k.saturating_sub(back).min(windows - 1) }
        };
        (0..4).map(|back| self.fourth_differences[window(back)]).fold(0.0, f64::max)
    }
}

/// The cubic through four points at 0, 1, 2 and 3.
fn interpolate_cubic(four: [Point; 4], t: f64) -> Point {
    let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
    let weights = [b * c * d / -6.0, a * c * d / 2.0, a * b * d / -2.0, a * b * c / 6.0];
    let sum: Vector = four.iter().zip(weights).map(|(p, weight)| p.coords * weight).sum();
    Point::from(sum)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use coupler_curves::geometry::{Similarity, trig};

    /// The point of a circle of radius 20 at an angle in degrees.
    fn at(deg: f64) -> Point {
        let (cos, sin) = trig::cos_sin_deg(deg);
        Point::new(20.0 * cos, 20.0 * sin)
    }

    /// The first dashes of the circle, 3 of every 5 degrees, in chords of half a degree, which deviate by 0.0002 mm.
    fn circle(dashes: u32) -> DrawnCurve {
        let page_from_plane = Similarity::with_y_down(1.0, Point::new(50.0, 40.0));
        let line = |from: u32, halves: u32| {
            let place = |j: u32| page_from_plane.apply(at(f64::from(from) + f64::from(j) / 2.0));
            Spline { start: place(0), segments: (1..=halves).map(|j| SplineSegment::Line(place(j))).collect() }
        };
        let dashes = (0..dashes).map(|k| line(5 * k, 6)).collect();
        DrawnCurve {
            id: "circle".to_owned(),
            cell: 1,
            trace: 1,
            circuit: 1,
            page_from_plane,
            dash: [5.0, 3.0],
            dashed_travel: None,
            hairline: vec![line(0, 720)],
            dashes,
        }
    }

    /// Samples every `step` degrees, one of them moved outward by half a millimetre.
    fn samples(count: u32, step: f64, moved: Option<u32>) -> impl Iterator<Item = (f64, Point)> {
        let place = move |k: u32| if moved == Some(k) { 1.025 } else { 1.0 };
        (0..count).map(move |k| (f64::from(k) * step, at(f64::from(k) * step) * place(k)))
    }

    #[test]
    fn a_sample_at_the_end_of_a_dash_counts_if_the_curve_continues_into_it() {
        let found = |dashes, count, step, moved, closed: bool| {
            let after_last = closed.then_some(360.0);
            let (k, distance) = circle(dashes).furthest_sample(samples(count, step, moved), after_last).unwrap();
            (distance > 0.01).then_some((k, (distance * 100.0).round()))
        };
        assert_eq!(found(72, 72, 5.0, None, true), None);
        for k in [0, 1, 40, 71] {
            assert_eq!(found(72, 72, 5.0, Some(k), true), Some((k as usize, 50.0)));
        }
        // Half of the circle ends where a dash would begin.
        assert_eq!(found(36, 37, 5.0, None, false), None);
        assert_eq!(found(36, 37, 5.0, Some(35), false), Some((35, 50.0)));
        // There it is compared with the hairline only.
        assert_eq!(found(36, 37, 5.0, Some(36), false), Some((36, 50.0)));
        // Samples in gaps are compared with the hairline, and not with the dashes.
        for k in 2..6 {
            assert!(found(72, 360, 1.0, Some(k), true).is_some(), "{k}");
        }
        let [mut undashed, mut bare] = [circle(72), circle(72)];
        undashed.dashes.remove(1);
        bare.hairline.clear();
        let distance = |curve: &DrawnCurve, k: u32| {
            let sample = samples(360, 1.0, None).skip(k as usize).take(2);
            curve.furthest_sample(sample, Some(360.0)).unwrap().1 > 0.01
        };
        assert_eq!([3, 4, 5, 6, 8].map(|k| distance(&undashed, k)), [false, true, true, true, false]);
        assert!(distance(&bare, 3));
        let empty = circle(0).furthest_sample(samples(72, 5.0, None), Some(360.0));
        assert_eq!(empty, Some((0, f64::INFINITY)));
    }

    #[test]
    fn after_a_limit_at_the_beginning_of_a_dash_the_curve_does_not_continue_into_it() {
        // The input goes from 1 to 5 degrees and back: no dash begins at 5.
        let ends = || [1.0, 5.0].map(|input| (input, at(input))).into_iter();
        let distance = |after_last| circle(1).furthest_sample(ends(), after_last).unwrap().1;
        assert!(distance(Some(1.0)) < 0.01);
        assert!(distance(Some(9.0)) > 0.5);
    }

    #[test]
    fn a_detour_between_two_samples_is_found() {
        // Of 72 samples, the cubics are exact enough; of 4, there are none.
        for (count, step, queries) in [(72, 5.0, 3), (4, 90.0, 3_000)] {
            let places: Vec<Point> = samples(count, step, None).map(|(_, place)| place).collect();
            let mut curve = circle(72);
            let asked = Cell::new(0);
            let distance_from_curve = |p: Point, _| {
                asked.set(asked.get() + 1);
                ((p - curve.page_from_plane.origin()).norm() - 20.0).abs()
            };
            assert_eq!(curve.max_stray(&places, true, distance_from_curve), None);
            assert_eq!(asked.get() > 0, count == 4);
            let page_from_plane = curve.page_from_plane;
            let SplineSegment::Line(end) = &mut curve.dashes[9].segments[2] else { panic!("a line") };
            *end += (*end - page_from_plane.origin()) / 20.0 * 0.05;
            let stray = curve.max_stray(&places, true, distance_from_curve).unwrap();
            assert!((stray - 0.05).abs() < 1e-9, "{stray}");
            assert!(asked.get() <= 2 * queries, "{}", asked.get());
        }
    }

    #[test]
    fn an_open_curve_does_not_continue_from_its_last_sample_to_its_first() {
        let places: Vec<Point> = samples(37, 5.0, None).map(|(_, place)| place).collect();
        // The curve is a half circle: its rest is a detour.
        let distance_from_half = |p: Point, _| {
            let from_centre = p - Point::new(50.0, 40.0);
            let from_ends = [30.0, 70.0].map(|x| (p - Point::new(x, 40.0)).norm());
            if from_centre.y <= 0.0 { (from_centre.norm() - 20.0).abs() } else { from_ends[0].min(from_ends[1]) }
        };
        assert!(circle(72).max_stray(&places, false, distance_from_half).unwrap() > 10.0);
        let mut half = circle(36);
        half.hairline[0].segments.truncate(360);
        assert_eq!(half.max_stray(&places, false, distance_from_half), None);
    }
}
