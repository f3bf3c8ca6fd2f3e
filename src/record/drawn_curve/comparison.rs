//! How far samples and what is drawn of their curve are from each other.

use super::DrawnCurve;
use coupler_curves::geometry::{Capsule, CapsuleTree, Point, Vector};

/// What a line may be off its curve, in millimetres: its chords' error and the rounding of its places.
const TOLERANCE_MM: f64 = 0.01;

impl DrawnCurve {
    /// Which of the samples in its dashes is the furthest from what is drawn, counted from 0, and how far it is, in
    /// millimetres of the page; infinitely far where nothing is drawn. `None` where no sample is in a dash.
    ///
    /// The samples are all of the curve in their order, each with its input and its place in the plane; `closed` says
    /// whether the curve goes on from the last to the first. Those that have no place are passed over. A sample at the
    /// very end of a dash (to 1e-9 of the period) counts if the curve goes on from it into the dash.
    ///
    /// It takes a search in a tree of the lines' segments for each sample, cut short where a sample is found to be nearer
    /// than the furthest so far.
    pub fn furthest_sample(&self, samples: impl Iterator<Item = (f64, Point)>, closed: bool) -> Option<(usize, f64)> {
        let segments = self.polylines.iter().flat_map(|line| line.windows(2));
        let drawn = CapsuleTree::new(segments.map(|pair| Capsule { ends: [pair[0], pair[1]], radius: 0.0 }).collect());
        let mut samples = samples.enumerate().peekable();
        let mut before = None;
        let mut furthest: Option<(usize, f64)> = None;
        while let Some((k, (input, place))) = samples.next() {
            // Where a closed curve comes back to its first sample, its input goes on as it did.
            let beyond = before.filter(|_| closed).map(|before| 2.0 * input - before);
            let after = samples.peek().map(|(_, (input, _))| *input).or(beyond);
            let is_drawn = self.is_in_dash(input, [before, after]);
            before = Some(input);
            if is_drawn && place.x.is_finite() && place.y.is_finite() {
                let most = furthest.map_or(f64::NEG_INFINITY, |(_, most)| most);
                let distance = drawn.signed_distance(self.page_from_plane.apply(place), most);
                if distance > most {
                    furthest = Some((k, distance));
                }
            }
        }
        furthest
    }

    /// Whether there is a dash at an input, by the inputs of the samples beside it.
    fn is_in_dash(&self, input: f64, beside: [Option<f64>; 2]) -> bool {
        let [period, drawn] = self.dash;
        let near = 1e-9 * period;
        let phase = input.rem_euclid(period);
        let goes = |sign: f64| beside.iter().flatten().any(|other| (other - input) * sign > 0.0);
        if drawn >= period - near {
            true
        } else if phase <= near || phase >= period - near {
            goes(1.0)
        } else if (phase - drawn).abs() <= near {
            goes(-1.0)
        } else {
            phase < drawn
        }
    }

    /// How far what is drawn strays, at most, from the course of the samples beyond what is allowed to it, in millimetres
    /// of the page. `None` where it does not stray, and where there are fewer than five samples to tell a course by.
    ///
    /// The samples are all of the curve in their order, in the plane; `closed` says whether the curve goes on from the
    /// last to the first. Their course between two of them is the cubic through four; allowed are 0.01 mm and twice what
    /// the cubic may be off by, as estimated from fourth differences. So a detour is found in steps that are small for
    /// the curve; where they are not, at limits of the input for one, more is allowed.
    pub fn max_stray(&self, samples: &[Point], closed: bool) -> Option<f64> {
        let is_place = |p: &&Point| p.x.is_finite() && p.y.is_finite();
        let places: Vec<Point> = samples.iter().filter(is_place).map(|p| self.page_from_plane.apply(*p)).collect();
        let course = CapsuleTree::new(SampleInterpolant::new(&places, closed)?.tubes());
        let segments = self.polylines.iter().flat_map(|line| line.windows(2));
        let strays = segments.flat_map(|pair| points_along(pair[0], pair[1])).fold(0.0, |most: f64, point| {
            // The search ends where no more than the most so far is to be found.
            most.max(course.signed_distance(point, most))
        });
        (strays > 0.0).then_some(strays)
    }
}

/// Places along a segment, its ends among them, a millimetre apart or less; of a long one no more than 64.
fn points_along(a: Point, b: Point) -> impl Iterator<Item = Point> {
    let steps = (b - a).norm().ceil().clamp(2.0, 64.0);
    (0..=steps as u32).map(move |k| a + (b - a) * (f64::from(k) / steps))
}

/// Where a curve goes, told by its samples.
struct SampleInterpolant<'a> {
    samples: &'a [Point],
    is_closed: bool,
    /// The length of the fourth difference of each five samples that follow each other, by the first of them.
    fourth_differences: Vec<f64>,
}

impl SampleInterpolant<'_> {
    /// Chords between two samples.
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

    /// The course in chords, with what is allowed on either side of each.
    fn tubes(&self) -> Vec<Capsule> {
        let intervals = if self.is_closed { self.samples.len() } else { self.samples.len() - 1 };
        (0..intervals).flat_map(|k| self.interval_tubes(k)).collect()
    }

    /// The course from a sample to the next.
    fn interval_tubes(&self, k: usize) -> impl Iterator<Item = Capsule> {
        let count = self.samples.len();
        let (first, before) = if self.is_closed {
            ((k + count - 1) % count, 1)
        } else {
            let first = k.saturating_sub(1).min(count - 4);
            (first, k - first)
        };
        let four = [0, 1, 2, 3].map(|i| self.samples[(first + i) % count]);
        let bend = |i: usize| (four[i].coords - four[i + 1].coords * 2.0 + four[i + 2].coords).norm();
        // The chords' own bend, and the remainder of the cubic, the larger at an end: of t (t-1) (t-2) (t-3) / 24.
        let chords = bend(0).max(bend(1)) / (8 * Self::CHORDS_PER_INTERVAL * Self::CHORDS_PER_INTERVAL) as f64;
        let remainder = if before == 1 { 3.0 / 128.0 } else { 1.0 / 24.0 } * self.max_fourth_difference(k);
        let radius = TOLERANCE_MM + 2.0 * (chords + remainder);
        let at = move |j: usize| interpolate_cubic(four, before as f64 + j as f64 / Self::CHORDS_PER_INTERVAL as f64);
        (0..Self::CHORDS_PER_INTERVAL).map(move |j| Capsule { ends: [at(j), at(j + 1)], radius })
    }

    /// The largest of the fourth differences that reach over an interval.
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
    use super::*;
    use coupler_curves::geometry::{Similarity, trig};

    /// The place of a circle of 20 mm at an angle in degrees.
    fn at(deg: f64) -> Point {
        let (cos, sin) = trig::cos_sin_deg(deg);
        Point::new(20.0 * cos, 20.0 * sin)
    }

    /// So much of the circle in dashes of 3 of 5 degrees, in chords of half a degree, which are off by 0.0002 mm.
    fn circle(dashes: u32) -> DrawnCurve {
        let page_from_plane = Similarity { scale: 1.0, flips_y: true, origin: Point::new(50.0, 40.0) };
        let place = |k: u32, j: u32| page_from_plane.apply(at(f64::from(5 * k) + f64::from(j) / 2.0));
        let lines = (0..dashes).map(|k| (0..=6).map(|j| place(k, j)).collect()).collect();
        let id = "circle".to_owned();
        DrawnCurve { id, cell: 1, trace: 1, circuit: 1, page_from_plane, dash: [5.0, 3.0], polylines: lines }
    }

    /// Samples every `step` degrees, one of them moved outward by half a millimetre.
    fn samples(count: u32, step: f64, moved: Option<u32>) -> impl Iterator<Item = (f64, Point)> {
        let place = move |k: u32| if moved == Some(k) { 1.025 } else { 1.0 };
        (0..count).map(move |k| (f64::from(k) * step, at(f64::from(k) * step) * place(k)))
    }

    #[test]
    fn a_sample_at_the_end_of_a_dash_counts_where_the_curve_goes_into_it() {
        let found = |dashes, count, step, moved, closed| {
            let (k, distance) = circle(dashes).furthest_sample(samples(count, step, moved), closed).unwrap();
            (distance > 0.01).then_some((k, (distance * 100.0).round()))
        };
        assert_eq!(found(72, 72, 5.0, None, true), None);
        for k in [0, 1, 40, 71] {
            assert_eq!(found(72, 72, 5.0, Some(k), true), Some((k as usize, 50.0)));
        }
        // The half ends where a dash would begin.
        assert_eq!(found(36, 37, 5.0, None, false), None);
        assert_eq!(found(36, 37, 5.0, Some(35), false), Some((35, 50.0)));
        assert_eq!(found(36, 37, 5.0, Some(36), false), None);
        // Of samples at every degree, those in gaps are not looked at, those at the ends of dashes are.
        for (k, is_found) in [(2, true), (3, true), (4, false), (5, true)] {
            assert_eq!(found(72, 360, 1.0, Some(k), true).is_some(), is_found, "{k}");
        }
        let empty = circle(0).furthest_sample(samples(72, 5.0, None), true);
        assert_eq!(empty, Some((0, f64::INFINITY)));
    }

    #[test]
    fn a_detour_between_two_samples_is_found() {
        let places: Vec<Point> = samples(72, 5.0, None).map(|(_, place)| place).collect();
        let mut curve = circle(72);
        assert_eq!(curve.max_stray(&places, true), None);
        assert!(curve.max_stray(&places[..4], true).is_none());
        let out = (curve.polylines[9][3] - curve.page_from_plane.origin) / 20.0;
        curve.polylines[9][3] += out * 0.05;
        let strays = curve.max_stray(&places, true).unwrap();
        // All of it but what is allowed: 0.01 mm and hardly more on a circle.
        assert!((0.035..=0.04).contains(&strays), "{strays}");
        // The half has no way back from its last sample to its first, where the rest strays.
        assert!(circle(72).max_stray(&places[..37], false).unwrap() > 10.0);
        assert_eq!(circle(36).max_stray(&places[..37], false), None);
    }
}
