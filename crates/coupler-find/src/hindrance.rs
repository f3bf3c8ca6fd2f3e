//! What of a path keeps the curves of four-bars away from it.

use std::f64::consts::{PI, TAU};

use crate::complex::{Complex, length};
use crate::target::{PathKind, Target};
use coupler_curves::geometry::trig;
use coupler_curves::numerical::equal_parts;

/// What of a path no curve of a four-bar has, or hardly any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hindrance {
    /// It has corners: coupler curves are smooth but for cusps.
    Corners {
        /// How many.
        count: usize,
        /// The angle by which it turns at the sharpest, in degrees.
        sharpest_deg: f64,
    },
    /// A straight line meets it more often than a curve of the sixth degree.
    Meets {
        /// How often.
        count: usize,
    },
    /// It crosses itself more often than a four-bar's curve, which has three double points.
    Crossings {
        /// How often.
        count: usize,
    },
    /// Without crossing itself it winds round more often than a part of a closed curve that comes back to its beginning.
    Spiral {
        /// By how many turns its direction turns.
        turns: f64,
    },
    /// Its ends are apart, and a closed curve is to be met as a whole.
    Open,
}

impl std::fmt::Display for Hindrance {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Hindrance::Corners { count: 1, sharpest_deg } => {
                write!(f, "it has a corner of {sharpest_deg:.0}°, and coupler curves are smooth")
            }
            Hindrance::Corners { count, sharpest_deg } => {
                write!(f, "it has {count} corners of up to {sharpest_deg:.0}°, and coupler curves are smooth")
            }
            Hindrance::Meets { count } => {
                write!(f, "a straight line meets it {count} times, and a four-bar's curve at most {MAX_MEETS} times")
            }
            Hindrance::Crossings { count } => {
                write!(f, "it crosses itself {count} times, and a four-bar's curve at most {MAX_CROSSINGS} times")
            }
            Hindrance::Spiral { turns } => {
                write!(f, "it winds round {turns:.1} times without crossing itself, and coupler curves close")
            }
            Hindrance::Open => write!(f, "its ends are apart: compare it with parts of curves"),
        }
    }
}

/// The points at equal distances that are looked at.
const COUNT: usize = 200;

/// The steps on either side of a point between which its direction turns, 2 % of the length each.
const REACH: usize = 4;

/// The least angle of a corner: a circle turns by 7° within the reach.
const CORNER: f64 = 50.0 * PI / 180.0;

/// A curve of the sixth degree meets a line six times, and a four-bar's, of genus 1, has three double points apart from those at infinity.
const MAX_MEETS: usize = 6;
const MAX_CROSSINGS: usize = 3;

/// What is no further from a line than this part of the size does not cross it.
const BAND: f64 = 0.03;

/// The most turns of a direction that are no spiral.
const MAX_TURNS: f64 = 1.5;

impl Target {
    /// What of the path keeps the curves of four-bars away from it, as far as that is known; a curve is to be met as a whole or in part.
    pub fn hindrances(&self, is_whole: bool) -> Vec<Hindrance> {
        let is_closed = self.kind() == PathKind::Closed;
        let points = even_points(self.normalized(), is_closed);
        let crossings = crossings(&points, is_closed);
        let turned: f64 = inner(&points, is_closed).map(|k| turn(&points, k, REACH)).sum();
        let turns = (turned / (REACH as f64 * TAU)).abs();
        let corners = corners(&points, is_closed);
        let meets = meets(&points, is_closed);
        let sharpest = corners.iter().copied().reduce(f64::max);
        let found = [
            sharpest.map(|angle| Hindrance::Corners { count: corners.len(), sharpest_deg: angle.to_degrees() }),
            (meets > MAX_MEETS).then_some(Hindrance::Meets { count: meets }),
            (crossings > MAX_CROSSINGS).then_some(Hindrance::Crossings { count: crossings }),
            (!is_closed && crossings == 0 && turns > MAX_TURNS).then_some(Hindrance::Spiral { turns }),
            (is_whole && !is_closed).then_some(Hindrance::Open),
        ];
        found.into_iter().flatten().collect()
    }
}

/// Points at equal distances along a polyline: of a closed one round it, of an open one with both ends.
fn even_points(mut points: Vec<Complex>, is_closed: bool) -> Vec<Complex> {
    if is_closed {
        points.push(points[0]);
    }
    let lengths: Vec<f64> = points.windows(2).map(|pair| length(pair[1] - pair[0])).collect();
    let places = equal_parts(&lengths, if is_closed { COUNT } else { COUNT - 1 });
    let at = |segment: usize, fraction: f64| points[segment] + (points[segment + 1] - points[segment]) * fraction;
    places.iter().take(COUNT).map(|place| at(place.segment, place.fraction)).collect()
}

/// The angle by which the direction turns at a point, between the chords to it and from it, of so many steps each.
fn turn(points: &[Complex], k: usize, reach: usize) -> f64 {
    let count = points.len();
    let [before, after] = [points[(k + count - reach) % count], points[(k + reach) % count]];
    let [to, from] = [points[k] - before, after - points[k]];
    trig::atan2(to.re * from.im - to.im * from.re, to.re * from.re + to.im * from.im)
}

/// The points around which there are steps enough: all of a closed path.
fn inner(points: &[Complex], is_closed: bool) -> std::ops::Range<usize> {
    if is_closed { 0..points.len() } else { 2 * REACH..points.len() - 2 * REACH }
}

/// The angles of the corners: where the direction turns most within the reach, and hardly more within twice the reach, as on a curve it would.
fn corners(points: &[Complex], is_closed: bool) -> Vec<f64> {
    const SHARP: f64 = 0.8;
    let count = points.len();
    let angle = |k: usize| turn(points, k, REACH).abs();
    let is_corner = |k: &usize| {
        let own = angle(*k);
        // Of two that are alike the first.
        let is_greatest =
            (1..=REACH).all(|step| angle((k + count - step) % count) < own && angle((k + step) % count) <= own);
        own >= CORNER && own >= SHARP * turn(points, *k, 2 * REACH).abs() && is_greatest
    };
    inner(points, is_closed).filter(is_corner).map(angle).collect()
}

/// How often a straight line meets the path at most, of lines in some directions and at some distances.
fn meets(points: &[Complex], is_closed: bool) -> usize {
    const DIRECTIONS: usize = 36;
    const LEVELS: usize = 48;
    let directions = (0..DIRECTIONS).map(|k| PI * k as f64 / DIRECTIONS as f64);
    let most = directions.map(|angle| {
        let (x, y) = (trig::cos(angle), trig::sin(angle));
        let heights: Vec<f64> = points.iter().map(|z| x * z.re + y * z.im).collect();
        let [low, high] = [
            heights.iter().copied().fold(f64::INFINITY, f64::min),
            heights.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ];
        let levels = (1..LEVELS).map(|k| low + (high - low) * k as f64 / LEVELS as f64);
        let meets = levels.map(|level| {
            let sides: Vec<bool> =
                heights.iter().filter(|height| (*height - level).abs() > BAND).map(|height| *height > level).collect();
            let inner = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
            inner + usize::from(is_closed && sides.first() != sides.last())
        });
        meets.max().unwrap_or(0)
    });
    most.max().unwrap_or(0)
}

/// How often the path crosses itself; crossings that are nearer to each other than the reach are one.
fn crossings(points: &[Complex], is_closed: bool) -> usize {
    let count = points.len();
    let segments = if is_closed { count } else { count - 1 };
    let cross = |a: Complex, b: Complex| a.re * b.im - a.im * b.re;
    let mut found: Vec<Complex> = Vec::new();
    for i in 0..segments {
        let (a, b) = (points[i], points[(i + 1) % count]);
        for k in i + 2..segments {
            let (c, d) = (points[k], points[(k + 1) % count]);
            let is_between = |p: Complex, q: Complex, r: Complex, s: Complex| {
                (cross(q - p, r - p) > 0.0) != (cross(q - p, s - p) > 0.0)
            };
            let near = REACH as f64 * length(b - a);
            let is_next = is_closed && (k + 1) % count == i;
            if !is_next
                && is_between(a, b, c, d)
                && is_between(c, d, a, b)
                && found.iter().all(|p| length(*p - a) > near)
            {
                found.push(a);
            }
        }
    }
    found.len()
}
