//! Strips of portions of a curve, between any two positions of it.

use super::contact::{Contact, Levels};
use super::longest_near::{Constraint, Constraints, Contacts};
use super::row::Row;
use super::strip::{Strip, min_max, triangle_height};
use super::touching::{PortionPoints, are_touched};
use crate::geometry::{Point, Vector, cross, left_normal};

/// The strip of a portion of a curve, and how it changes with the ends.
#[derive(Clone, Copy, Debug)]
pub struct PortionStrip {
    /// Its width.
    pub width: f64,
    /// Its length.
    pub length: f64,
    /// The derivatives of the width with respect to the positions of the start and of the end.
    pub width_rates: [f64; 2],
    /// The derivatives of the length.
    pub length_rates: [f64; 2],
    /// Which points touch the strip's lines.
    pub contacts: Contacts,
    /// The widths of the strips of other points that nearly touch, and their rates.
    pub others: Constraints,
}

/// The strips of portions of a row's curve near each other.
///
/// The points that the lines of a strip touch are found among evenly spaced points, and then moved to where the curve is
/// parallel to the lines.
#[derive(Clone, Debug)]
pub struct CurveStrips<'a> {
    portion: PortionPoints<'a>,
    /// The points that may touch the strip.
    contacts: Vec<Contact>,
    touched: Vec<Point>,
    /// The points that touch the last strip, with which the next begins.
    touching: [usize; 3],
    /// The strip that the contacts determine, by their numbers.
    latest: Option<Strip>,
}

/// What is outside of the strip of the points that touch by less, relative to its width, is rounding.
const ROUNDING: f64 = 1e-9;
/// By no more are others outside where no strip of points that touch contains all: the points alone would say less.
const OUTSIDE: f64 = 1e-4;

/// Parallel lines in a direction.
struct Lines(Vector);

impl Levels for Lines {
    fn height(&self, point: Point) -> f64 {
        cross(self.0, point.coords)
    }

    fn height_rates(&self, _: Point, velocity: Vector, acceleration: Vector) -> [f64; 2] {
        [cross(self.0, velocity), cross(self.0, acceleration)]
    }
}

impl<'a> CurveStrips<'a> {
    /// For portions about as long as the one between two positions, with about this many points.
    pub fn new(row: &'a Row, ends: [f64; 2], count: usize) -> CurveStrips<'a> {
        let portion = PortionPoints::new(row, ends, count);
        CurveStrips {
            portion,
            contacts: Vec::new(),
            touched: Vec::new(),
            touching: [0, count / 2, count],
            latest: None,
        }
    }

    /// The strip of the portion between two positions.
    pub fn strip(&mut self, ends: [f64; 2]) -> PortionStrip {
        /// A strip this much narrower than long is straight to rounding.
        const EXACT: f64 = 1e-12;
        /// So often are points that touch found anew, where others stick out of the strip of those found.
        const ROUNDS: usize = 4;
        self.portion.turn_to(ends);
        let last = self.portion.last();
        if self.touching[2] > last || self.touching[0] >= self.touching[1] || self.touching[1] >= self.touching[2] {
            self.touching = [0, last / 2, last];
        }
        let sampled = Strip::of_row(&self.portion.points, &mut self.touching);
        self.latest = None;
        let (mut direction, mut kept) = (sampled.direction, sampled.contacts);
        let rounds = if sampled.width > EXACT * sampled.length { ROUNDS } else { 0 };
        for round in 1..=rounds {
            let (touched, outside) = self.strip_about(direction, kept);
            let permitted = if round < rounds { ROUNDING } else { OUTSIDE };
            if outside <= permitted {
                return self.described_touched(touched);
            }
            (direction, kept) = (touched.direction, touched.contacts.map(|k| self.contacts[k].index));
        }
        // The points alone show how wide it is.
        self.touched.clear();
        self.described(&sampled, sampled.contacts.map(|k| self.portion.points[k]))
    }

    /// The strip of a portion next to the one before, which most often touches the same points; otherwise they are found anew.
    pub fn next_strip(&mut self, ends: [f64; 2]) -> PortionStrip {
        if let Some(latest) = self.latest.take()
            && self.portion.follow(ends, &mut self.contacts)
            && let touched = self.touching_strip(latest.direction, latest.contacts)
            && let Some([low, high]) = self.portion.range_with_contacts(&Lines(touched.direction), &self.contacts)
            && high - low <= touched.width * (1.0 + ROUNDING)
        {
            return self.described_touched(touched);
        }
        self.strip(ends)
    }

    /// The strip of a portion next to the one before, of which the points that touch are found anew.
    pub fn strip_anew(&mut self, ends: [f64; 2]) -> PortionStrip {
        if let Some(latest) = self.latest.take()
            && self.portion.follow(ends, &mut self.contacts)
        {
            let kept = latest.contacts.map(|k| self.contacts[k].index);
            let (touched, outside) = self.strip_about(latest.direction, kept);
            if outside <= ROUNDING {
                return self.described_touched(touched);
            }
        }
        self.strip(ends)
    }

    /// The strip of the points that touch lines near a direction, which are found, points of given indices among them, and by what
    /// part of its width other points are outside.
    fn strip_about(&mut self, direction: Vector, kept: [usize; 3]) -> (Strip, f64) {
        self.portion.collect_contacts(&Lines(direction), &kept, &mut self.contacts);
        let mut three = kept.map(|k| self.contacts.partition_point(|contact| contact.index < k));
        three.sort_unstable();
        let strip = self.touching_strip(direction, three);
        let [low, high] = min_max(&self.portion.points, |p| cross(strip.direction, p.coords));
        let are_touched = are_touched(&Lines(strip.direction), &self.contacts);
        (strip, if are_touched { (high - low) / strip.width - 1.0 } else { f64::INFINITY })
    }

    /// The strip of the points that touch lines near a direction, from three of them, which it passes through.
    fn touching_strip(&mut self, mut direction: Vector, mut three: [usize; 3]) -> Strip {
        const ROUNDS: usize = 6;
        /// The square of a turn by less is less than rounding.
        const TURNED: f64 = 1e-8;
        // The contacts move along the curve, and the strip with them: each time by the square of the time before.
        let mut round = 1;
        loop {
            let lines = Lines(direction);
            self.portion.touch(&lines, &mut self.contacts);
            self.touched.clear();
            self.touched.extend(self.contacts.iter().map(|contact| contact.touching(&lines)));
            let strip = Strip::of_row(&self.touched, &mut three);
            if round == ROUNDS || cross(direction, strip.direction).abs() <= TURNED {
                return strip;
            }
            direction = strip.direction;
            round += 1;
        }
    }

    /// The strip of the points that touch, for the portion and the next.
    fn described_touched(&mut self, touched: Strip) -> PortionStrip {
        self.latest = Some(touched);
        let strip = Strip { contacts: touched.contacts.map(|k| self.contacts[k].index), ..touched };
        self.described(&strip, touched.contacts.map(|k| self.touched[k]))
    }

    /// A strip, which passes through three points, with what is known of how it changes.
    fn described(&self, strip: &Strip, corners: [Point; 3]) -> PortionStrip {
        let last = self.portion.last();
        let points = &self.portion.points;
        let [near, far] = min_max(points, |p| strip.direction.dot(&p.coords));
        let along = [0, last].map(|k| strip.direction.dot(&points[k].coords));
        let velocities = self.portion.end_velocities();
        let length_rate = |k: usize| {
            let rate = strip.direction.dot(&velocities[k]);
            if along[k] == far {
                rate
            } else if along[k] == near {
                -rate
            } else {
                0.0
            }
        };
        let [p, q, r] = strip.contacts.map(|k| self.portion.label(k));
        PortionStrip {
            width: strip.width,
            length: far - near,
            width_rates: triangle_rates(corners, strip.contacts, velocities, last),
            length_rates: [length_rate(0), length_rate(1)],
            contacts: [p, q, r, 0],
            others: self.other_triangles(strip.width, velocities),
        }
    }

    /// The heights of triangles of points that touch the strip or nearly do, and their rates.
    fn other_triangles(&self, width: f64, velocities: [Vector; 2]) -> Constraints {
        /// A strip this much narrower hardly matters.
        const NEAR: f64 = 0.8;
        let mut out = Constraints::default();
        let mut free = out.iter_mut();
        let count = self.touched.len();
        let last = self.portion.last();
        for i in 0..count {
            for j in i + 1..count {
                for k in j + 1..count {
                    let corners = [i, j, k].map(|n| self.touched[n]);
                    let height = triangle_height(corners);
                    // Only the height above the longest side is that of the narrowest strip.
                    let side = corners[2] - corners[0];
                    let foot = side.dot(&(corners[1] - corners[0]));
                    let is_between = (0.0..=side.norm_squared()).contains(&foot);
                    if height >= NEAR * width
                        && is_between
                        && let Some(other) = free.next()
                    {
                        let indices = [i, j, k].map(|n| self.contacts[n].index);
                        let rates = triangle_rates(corners, indices, velocities, last);
                        *other = Some(Constraint { value: height, rates });
                    }
                }
            }
        }
        out
    }
}

/// The derivatives of the height of the second corner of a triangle above the side of the others with respect to the
/// ends of a portion, whose velocities are given. Corners are points of the portion of given indices; `last` is that of
/// its last point. Those between the ends move along the side.
fn triangle_rates([p, q, r]: [Point; 3], indices: [usize; 3], velocities: [Vector; 2], last: usize) -> [f64; 2] {
    let side = r - p;
    let share = side.dot(&(q - p)) / side.norm_squared();
    let normal = left_normal(side) / side.norm() * if cross(side, q - p) > 0.0 { 1.0 } else { -1.0 };
    let weights = [share - 1.0, 1.0, -share];
    [0, last].map(|end| {
        let weight: f64 = (0..3).filter(|&i| indices[i] == end).map(|i| weights[i]).sum();
        weight * normal.dot(&velocities[usize::from(end > 0)])
    })
}
