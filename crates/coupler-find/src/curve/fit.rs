//! How a given curve fits a target: where it is placed on it, and its deviation.

use crate::complex::{Complex, dot};
use crate::curve::alignment::Alignment;
use crate::curve::path::CurvePath;
use crate::curve_fit_options::CurveFitOptions;
use crate::deviation::Deviation;
use crate::matching::{match_open_places, match_places};
use crate::query::Query;
use crate::shape::close_portion::{Portion, portions};
use crate::shape::spectrum::{Likeness, Transform};
use crate::target::{PathKind, Target};
use coupler_curves::geometry::{Point, Similarity};

/// How a curve fits a target, in the position, size, direction and reflection in which it is nearest to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveFit {
    /// Where the curve is placed.
    pub placement: Similarity,
    /// How near it is then.
    pub deviation: Deviation,
    /// Where the first and the last point of the target are along the curve, in parts of its length from its first point on. From 0
    /// to 1, and beyond where the target passes the end: of a closed curve into the next round, of an open one on the way back.
    pub ends: [f64; 2],
    /// Whether the target is followed against the order of the curve's points.
    pub is_reversed: bool,
}

/// Fits curves to a target.
///
/// A fit takes 2 to 10 ms, at most some 20, for a hundred points of a target and 180 to 720 of a curve. The curve is the cubic spline
/// through its points by the lengths of chords: of forty random four-bars with a crank that turns fully, 90, 180 and 360 points at equal
/// steps of the crank give E to 7e-5, 3e-5 and 6e-6 of the size in the worst case, a curve with a cusp nearly.
pub struct CurveFitter {
    target: Target,
    /// The greatest length of a curve or of its portion, and that of the target's polyline, in sizes of the target.
    greatest_length: f64,
    polyline_length: f64,
    options: CurveFitOptions,
    /// None if the curves stay where they are.
    query: Option<Query>,
    /// The points with centroid 0 and size 1, forward and backward; all, and some of them.
    points: [Vec<Complex>; 2],
    some_points: [Vec<Complex>; 2],
    transform: Transform,
}

/// Samples of a curve, and their positions.
type Samples<'a> = (&'a [Complex], &'a [f64]);

/// A curve near the target.
#[derive(Clone, Copy)]
struct Start {
    placed: Similarity,
    is_reversed: bool,
    /// Whether the points are matched with an open curve on its way there only.
    is_one_way: bool,
}

/// The samples of a curve, at equal distances: for its shape, of which a circle's chords deviate by 0.000075 of the radius, and to be matched
/// at first; then at least so many of its knots, which are denser where it turns.
pub(crate) const EVEN: usize = 256;
const COARSE: usize = 96;
const FINE: usize = 180;

/// The starts that are tried, and of these those that are refined.
const STARTS: usize = 6;
const REFINED: usize = 3;

/// Those with a sum of squares so many times as great as that of the nearest are not refined, and none after one that is met to rounding.
const PROMISING: f64 = 4.0;
const EXACT: f64 = 1e-10;

impl CurveFitter {
    /// Prepares fits to a target. The angles of a timed one do not count.
    pub fn new(target: &Target, options: CurveFitOptions) -> CurveFitter {
        /// So many points at most decide where a curve is tried.
        const SOME: usize = 50;
        let points = target.normalized();
        let query = (!options.is_fixed).then(|| Query::new(target.kind(), &points));
        let both = |points: Vec<Complex>| [points.clone(), points.into_iter().rev().collect()];
        let some = points.iter().step_by(points.len().div_ceil(SOME)).copied().collect();
        CurveFitter {
            target: target.clone(),
            greatest_length: target.greatest_length(),
            polyline_length: target.polyline_length(),
            options,
            query,
            some_points: both(some),
            points: both(points),
            transform: Transform::new(),
        }
    }

    /// How the curve through points fits the target; `None` if it does not in any place: it has long detours, no
    /// portion of it is like the target, or it has no extent. An open curve is passed there and back.
    pub fn fit(&self, points: &[Point], is_closed: bool) -> Option<CurveFit> {
        let path = CurvePath::new(points, is_closed)?;
        let even = path.even_points(EVEN);
        let [every, positions] = [path.spaced_evenly(COARSE), path.knots(FINE)];
        let points_at = |positions: &[f64]| positions.iter().map(|position| path.point(*position)).collect::<Vec<_>>();
        let (coarse, fine) = (points_at(&every), points_at(&positions));
        let starts = self.starts(&path, &even);
        let mut tried: Vec<(f64, Start)> =
            starts.iter().filter_map(|start| self.tried(start, &path, (&coarse, &every))).collect();
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        let nearest = tried.first()?.0;
        let mut best: Option<CurveFit> = None;
        for (sum, start) in tried.iter().take(REFINED) {
            let is_promising =
                *sum <= PROMISING * nearest && best.is_none_or(|best| best.deviation.rms_relative > EXACT);
            if best.is_some() && !is_promising {
                break;
            }
            let found = self.refined(start, &path, (&fine, &positions));
            best = found.filter(|found| best.is_none_or(|best| found.deviation.rms < best.deviation.rms)).or(best);
        }
        best
    }

    /// Where the curve is like the target. An open curve is passed in both directions anyway, except by an open target on the way there.
    fn starts(&self, path: &CurvePath, samples: &[Complex]) -> Vec<Start> {
        let is_open_target = self.target.kind() != PathKind::Closed;
        match &self.query {
            None => {
                let placed = self.target.placement().inverse().after(&path.placement());
                let start = |(is_reversed, is_one_way)| Start { placed, is_reversed, is_one_way };
                let ways: &[(bool, bool)] = match (path.is_open, is_open_target) {
                    (false, _) => &[(false, false), (true, false)],
                    (true, false) => &[(false, false)],
                    (true, true) => &[(false, true), (true, true), (false, false)],
                };
                ways.iter().copied().map(start).collect()
            }
            Some(Query::Whole(target, target_extent)) => {
                let (spectrum, extent) = self.transform.spectrum(samples);
                let start = |(likeness, is_reversed): (Likeness, bool)| {
                    let placed = likeness.similarity(target_extent, &extent);
                    Start { placed, is_reversed, is_one_way: false }
                };
                let found = self.transform.likenesses(target, &spectrum).into_iter().map(start);
                let may_begin = |start: &Start| {
                    (self.options.may_be_mirrored || !start.placed.is_mirrored) && !(path.is_open && start.is_reversed)
                };
                found.filter(may_begin).take(STARTS).collect()
            }
            Some(Query::Portion(stroke, close_stroke)) => {
                let start = |portion: Portion| Start {
                    placed: portion.placed,
                    is_reversed: portion.is_reversed,
                    is_one_way: path.is_open && portion.ends[1] <= 0.5,
                };
                let curve = (samples, path.is_open);
                portions((stroke, close_stroke), curve, &self.options, STARTS).into_iter().map(start).collect()
            }
        }
    }

    /// A start after some steps with some of the points, with the sum of the squares of the distances.
    fn tried(&self, start: &Start, path: &CurvePath, samples: Samples) -> Option<(f64, Start)> {
        const STEPS: usize = 15;
        let points = &self.some_points[usize::from(start.is_reversed)];
        let alignment = self.aligned(start, path, samples, (points, STEPS))?;
        Some((alignment.sum, Start { placed: alignment.placed, ..*start }))
    }

    /// A curve on points that are matched with it in order, after some steps.
    fn aligned<'a>(
        &self,
        start: &Start,
        path: &'a CurvePath,
        (samples, at): Samples,
        (points, steps): (&'a [Complex], usize),
    ) -> Option<Alignment<'a>> {
        let legs =
            if start.is_one_way { at.iter().take_while(|at| **at <= 0.5 * path.period()).count() } else { at.len() };
        let matched = matched(start, &samples[..legs], points)?;
        let position = |k: usize| at[k % at.len()] + path.period() * (k / at.len()) as f64;
        let near = matched.iter().map(|(k, part)| position(*k) + part * (position(k + 1) - position(*k)));
        let mut alignment = Alignment::new(path, points, start.placed, near)?;
        if !self.options.is_fixed {
            alignment.refine(steps);
        }
        Some(alignment)
    }

    /// The fit near a start; `None` if it is not valid.
    fn refined(&self, start: &Start, path: &CurvePath, samples: Samples) -> Option<CurveFit> {
        const ROUNDS: usize = 3;
        const STEPS: usize = 60;
        let points = &self.points[usize::from(start.is_reversed)];
        let mut start = *start;
        let mut best: Option<Alignment> = None;
        for _ in 0..ROUNDS {
            let alignment = self.aligned(&start, path, samples, (points, STEPS))?;
            if best.as_ref().is_some_and(|best| alignment.sum >= best.sum) {
                break;
            }
            start.placed = alignment.placed;
            best = Some(alignment);
            if self.options.is_fixed {
                break;
            }
        }
        self.fit_of(&start, path, &best?)
    }

    /// The fit of an alignment.
    fn fit_of(&self, start: &Start, path: &CurvePath, alignment: &Alignment) -> Option<CurveFit> {
        let (size, scale) = (self.target.size(), start.placed.scale());
        let [first, last] = alignment.ends().map(|position| path.length_at(position));
        let own_length = scale
            * match self.target.kind() {
                PathKind::Closed => path.length(),
                PathKind::Open | PathKind::Part => last - first,
            };
        // An open curve is half as long as the closed one.
        let legs = if path.is_open { 2.0 } else { 1.0 };
        let [first, last] = [first, last].map(|at| at * legs / path.length());
        /// Points on a straight portion are matched with places that differ from those of their lengths by rounding.
        const ROUNDING: f64 = 1e-6;
        let is_portion = self.target.kind() != PathKind::Closed && !self.options.is_fixed;
        let is_valid =
            own_length <= self.greatest_length && !(is_portion && last - first < self.options.least_portion - ROUNDING);
        if !is_valid {
            return None;
        }
        let rms_relative = (alignment.sum / self.points[0].len() as f64).sqrt();
        let placement = match self.options.is_fixed {
            true => Similarity::IDENTITY,
            false => self.target.placement().after(&start.placed).after(&path.placement().inverse()),
        };
        let round = legs * (first / legs).floor();
        let [first, last] = [first - round, last - round];
        // What is passed on the way back only is passed against the order of the points.
        let (ends, is_reversed) = match (path.is_open && first >= 1.0, start.is_reversed) {
            (true, _) => ([2.0 - first, 2.0 - last], true),
            (_, true) => ([last, first], true),
            _ => ([first, last], false),
        };
        Some(CurveFit {
            placement,
            deviation: Deviation {
                rms: size * rms_relative,
                rms_relative,
                greatest: size * alignment.greatest(),
                is_in_order: alignment.is_in_order(),
                length_ratio: own_length / self.polyline_length,
            },
            ends,
            is_reversed,
        })
    }
}

/// The chords from sample to sample that are matched with points in order: each by the number of the chord, of the first or the second
/// round, and the part of it.
fn matched(start: &Start, samples: &[Complex], points: &[Complex]) -> Option<Vec<(usize, f64)>> {
    let placed: Vec<Complex> = samples.iter().map(|z| start.placed.image(*z)).collect();
    let chord = |j: usize| placed[(j + 1) % placed.len()] - placed[j];
    let count = if start.is_one_way { placed.len() - 1 } else { placed.len() };
    let chords: Vec<(Complex, f64)> =
        (0..count).map(|j| (chord(j), 1.0 / chord(j).norm_sqr().max(f64::MIN_POSITIVE))).collect();
    let part = |k: usize, j: usize| {
        let (chord, scale) = chords[j];
        (dot(points[k] - placed[j], chord) * scale).clamp(0.0, 1.0)
    };
    let square = |k: usize, j: usize| (placed[j] + chords[j].0 * part(k, j) - points[k]).norm_sqr();
    /// The first point has two or three places near it, and neighbouring chords may be as near.
    const MOST_STARTS: usize = 4;
    let (_, path) = match start.is_one_way {
        true => match_open_places(points.len(), count, square)?,
        false => match_places((points.len(), MOST_STARTS), count, square)?,
    };
    Some((0..).zip(path).map(|(k, j)| (j, part(k, j % count))).collect())
}
