//! The points of portions of a curve, and where they touch a line or a circle.

use super::contact::{Contact, Levels, vertex};
use super::row::Row;
use super::strip::min_max;
use crate::geometry::{Point, Vector};

/// Where the curve may touch.
enum Place {
    /// At an end or a corner, by its index.
    At(usize),
    /// At an extreme near a point.
    Near(usize),
    /// At an extreme between an end or a corner, at which the velocity is given, and the point next to it.
    Beside { end: usize, next: usize, velocity: Vector },
}

/// The points of portions of a row's curve near each other: the ends, evenly spaced points between them, and the corners.
#[derive(Clone, Debug)]
pub struct PortionPoints<'a> {
    row: &'a Row,
    /// The distance of the points, as a difference of positions.
    spacing: f64,
    /// The index of the first of `all`: the number of spacings from position 0.
    first: i64,
    all: Vec<Point>,
    /// The points of the portion.
    pub points: Vec<Point>,
    /// Their positions, in units of the spacing.
    positions: Vec<f64>,
    /// Those of the portion before.
    positions_before: Vec<f64>,
    /// The velocities at its ends, in these units.
    velocities: [Vector; 2],
    /// The ends of the portion to which it was turned, and from which they have been moved.
    turned_to: [f64; 2],
    /// Whether the points between the ends are those of the portion before.
    is_same: bool,
    /// Those of its points that are corners, with the velocities before and after each.
    corners: Vec<(usize, [Vector; 2])>,
    /// Points of the row, by their indices, that are points of each portion in which they are, too.
    pub added: Vec<i64>,
    heights: Vec<f64>,
}

impl<'a> PortionPoints<'a> {
    /// For portions about as long as the one between two positions, with about this many points.
    pub fn new(row: &'a Row, [from, to]: [f64; 2], count: usize) -> PortionPoints<'a> {
        /// The least spacing for which the points of the row are used: they need not be computed.
        const FINE: f64 = 0.25;
        let spacing = (to - from) / count as f64;
        PortionPoints {
            row,
            spacing: if spacing >= FINE { spacing.floor().max(1.0) } else { spacing },
            first: 0,
            all: Vec::new(),
            points: Vec::with_capacity(2 * count),
            positions: Vec::with_capacity(2 * count),
            positions_before: Vec::new(),
            velocities: [Vector::zeros(); 2],
            turned_to: [f64::NAN; 2],
            is_same: false,
            corners: Vec::new(),
            added: Vec::new(),
            heights: Vec::with_capacity(2 * count),
        }
    }

    /// Turns to the portion between two positions.
    pub fn turn_to(&mut self, ends: [f64; 2]) {
        let [from, to] = ends.map(|position| position / self.spacing);
        let begin = (from + TOO_CLOSE).ceil() as i64;
        let end = ((to - TOO_CLOSE).floor() as i64 + 1).max(begin);
        self.prepare([begin, end]);
        self.turned_to = ends;
        self.positions.clear();
        self.positions.push(from);
        self.positions.extend((begin..end).map(|k| k as f64));
        self.positions.push(to);
        let [begin, end] = [begin, end].map(|k| (k - self.first) as usize);
        self.points.clear();
        self.points.push(Point::origin());
        self.points.extend_from_slice(&self.all[begin..end]);
        self.points.push(Point::origin());
        self.move_ends(ends);
        let [low, high] = [ends[0] + TOO_CLOSE * self.spacing, ends[1] - TOO_CLOSE * self.spacing];
        for k in 0..self.added.len() {
            if (low..high).contains(&(self.added[k] as f64)) {
                self.insert(self.added[k]);
            }
        }
        self.insert_corners(ends);
    }

    /// Turns to a portion near that of some contacts, which become the same points of it; not if one of these is not in it.
    pub fn follow(&mut self, ends: [f64; 2], contacts: &mut [Contact]) -> bool {
        let last_before = self.last();
        self.is_same = (0..2).all(|k| (ends[k] - self.turned_to[k]).abs() < TOO_CLOSE * self.spacing);
        if self.is_same {
            self.move_ends(ends);
        } else {
            std::mem::swap(&mut self.positions, &mut self.positions_before);
            self.turn_to(ends);
            for contact in contacts.iter_mut() {
                contact.index = match contact.index {
                    0 => 0,
                    k if k == last_before => self.last(),
                    k => match self.positions.binary_search_by(|p| p.total_cmp(&self.positions_before[k])) {
                        Ok(k) if (1..self.last()).contains(&k) => k,
                        _ => return false,
                    },
                };
            }
        }
        let ends = [0, self.last()].map(|k| self.positions[k]);
        contacts.iter_mut().all(|contact| {
            if contact.index == 0 || contact.index == self.last() {
                (contact.at, contact.point) = (self.positions[contact.index], self.points[contact.index]);
            }
            contact.at >= ends[0] && contact.at <= ends[1]
        })
    }

    /// Moves contacts along the curve to where it touches one of the levels; one that would leave the portion stays where it is.
    pub fn touch(&self, levels: &dyn Levels, contacts: &mut [Contact]) {
        /// What a parabola neglects is less than 1e-10 of the width of what is touched four times.
        const NEAR: f64 = 0.005;
        let ends = [0, self.last()].map(|k| self.positions[k]);
        for contact in contacts.iter_mut().filter(|contact| !contact.is_within(NEAR, levels)) {
            let Contact { index, at, point, rates } = *contact;
            if let Some(rates) = rates {
                let bounds = [(ends[0] - at).max(-1.0), (ends[1] - at).min(1.0)];
                let (moved, step) = self.extreme(levels, index, at, point, rates, bounds);
                let has_left = step <= ends[0] - at || step >= ends[1] - at;
                *contact = if has_left { Contact { rates: None, ..*contact } } else { moved };
            }
        }
    }

    /// Moves the ends of the portion.
    fn move_ends(&mut self, ends: [f64; 2]) {
        let last = self.last();
        for (k, (index, end)) in [0, last].into_iter().zip(ends).enumerate() {
            let (point, velocity) = self.row.point_and_velocity_at(end);
            (self.points[index], self.positions[index]) = (point, end / self.spacing);
            self.velocities[k] = velocity * self.spacing;
        }
    }

    /// Puts the corners between two positions among the points.
    fn insert_corners(&mut self, ends: [f64; 2]) {
        self.corners.clear();
        for corner in self.row.bends_between(ends) {
            let index = self.insert(corner);
            let velocities = self.row.velocities_at_corner(corner).map(|velocity| velocity * self.spacing);
            self.corners.push((index, velocities));
        }
    }

    /// Puts a point of the row among the points, in place of those that are too close to it; its index among them.
    fn insert(&mut self, nth: i64) -> usize {
        let position = nth as f64 / self.spacing;
        // The ends stay.
        let last = self.positions.len() - 1;
        let inner = &self.positions[1..last];
        let first = 1 + inner.partition_point(|other| *other < position - TOO_CLOSE);
        let after = 1 + inner.partition_point(|other| *other <= position + TOO_CLOSE);
        self.positions.splice(first..after, [position]);
        self.points.splice(first..after, [self.row.nth_point(nth)]);
        first
    }

    /// Makes sure that there are the points from one index to before another.
    fn prepare(&mut self, [from, to]: [i64; 2]) {
        /// So many points more, for the portions that come next.
        const MARGIN: i64 = 4;
        let between = |row: &Row, from: i64, to: i64| match self.spacing {
            spacing if spacing >= 1.0 => (from..=to).map(|k| row.nth_point(k * spacing as i64)).collect(),
            spacing => row.points_between([from, to].map(|k| k as f64 * spacing), (to - from) as usize),
        };
        if self.all.is_empty() {
            self.first = from - MARGIN;
            self.all = between(self.row, self.first, to + MARGIN);
        }
        if from < self.first {
            let before = between(self.row, from - MARGIN, self.first);
            self.all.splice(..1, before);
            self.first = from - MARGIN;
        }
        let last = self.first + self.all.len() as i64 - 1;
        if to > last {
            let after = between(self.row, last, to + MARGIN);
            self.all.extend_from_slice(&after[1..]);
        }
    }

    /// The index of the last point of the portion.
    pub fn last(&self) -> usize {
        self.points.len() - 1
    }

    /// The derivatives of the start and of the end with respect to their positions in the row.
    pub fn end_velocities(&self) -> [Vector; 2] {
        self.velocities.map(|velocity| velocity / self.spacing)
    }

    /// A number of a point of the portion that a similar portion has, too: the least for the start and the greatest for
    /// the end.
    pub fn label(&self, index: usize) -> i64 {
        match index {
            0 => i64::MIN,
            k if k == self.last() => i64::MAX,
            k => self.positions[k] as i64,
        }
    }

    /// Collects the ends, the points near which the curve touches the outer ones of the levels of the portion, or nearly
    /// does, and those of given indices, in the order of their indices.
    pub fn collect_contacts(&mut self, levels: &dyn Levels, kept: &[usize], contacts: &mut Vec<Contact>) {
        /// An extreme is higher than the points next to it by less than this part of the range.
        const NEAR: f64 = 0.05;
        contacts.clear();
        self.find_places(levels, NEAR, kept, |points, place| {
            contacts.push(match place {
                Place::At(index) => points.fixed(index),
                Place::Near(index) => points.extreme_near(levels, index),
                Place::Beside { end, next, velocity } => points.extreme_beside(levels, end, velocity, next),
            });
        });
    }

    /// The least and the greatest height of the points of a portion to which contacts were followed; `None` if the curve may touch the
    /// levels of these where there is no contact.
    pub fn range_with_contacts(&mut self, levels: &dyn Levels, contacts: &[Contact]) -> Option<[f64; 2]> {
        /// No extreme of a portion that is touched a few times is higher than the points next to it by more of the range.
        const NEAR: f64 = 0.02;
        if !are_touched(levels, contacts) {
            return None;
        }
        if self.is_same {
            levels.collect_heights(&self.points, &mut self.heights);
            return Some(min_max(&self.heights, |height| *height));
        }
        let mut have_contacts = true;
        let range = self.find_places(levels, NEAR, &[], |points, place| {
            let around = match place {
                Place::At(index) => [index; 2],
                Place::Near(index) => [index - 1, index + 1],
                Place::Beside { end, next, .. } => [end.min(next), end.max(next)],
            };
            let [from, to] = around.map(|index| points.positions[index]);
            have_contacts &= contacts.iter().any(|contact| (from..=to).contains(&contact.at));
        });
        have_contacts.then_some(range)
    }

    /// Finds the places, in their order, at which the curve may touch the outer ones of the levels of the portion, to a part of the
    /// range of heights, and the points of given indices; the least and the greatest height.
    fn find_places(
        &mut self,
        levels: &dyn Levels,
        part: f64,
        kept: &[usize],
        mut found: impl FnMut(&PortionPoints, Place),
    ) -> [f64; 2] {
        let mut heights = std::mem::take(&mut self.heights);
        levels.collect_heights(&self.points, &mut heights);
        let last = self.last();
        let [low, high] = min_max(&heights, |height| *height);
        let near = part * (high - low);
        let is_near = |k: usize| heights[k] >= high - near || heights[k] <= low + near;
        let is_extreme = |k: usize| (heights[k] - heights[k - 1]) * (heights[k + 1] - heights[k]) <= 0.0;
        // The extreme between an end or a corner and the point next to it, if neither is it.
        let beside = |end: usize, next: usize, velocity: Vector| {
            let may_be = next != 0 && next != last && is_near(end) && !is_extreme(next) && !self.is_corner(next);
            (may_be && self.turns_beside(levels, end, velocity, next)).then_some(Place::Beside { end, next, velocity })
        };
        let mut find = |place: Option<Place>| place.into_iter().for_each(|place| found(self, place));
        find(Some(Place::At(0)));
        find(beside(0, 1, self.velocities[0]));
        let mut corners = self.corners.iter().peekable();
        for k in 1..last {
            let corner = corners.next_if(|(corner, _)| *corner == k);
            let may_touch = is_near(k) && (corner.is_some() || is_extreme(k));
            if !may_touch && !kept.contains(&k) {
                continue;
            }
            match corner {
                Some((_, [before, after])) => {
                    find(beside(k, k - 1, *before));
                    find(Some(Place::At(k)));
                    find(beside(k, k + 1, *after));
                }
                None => find(Some(Place::Near(k))),
            }
        }
        find(beside(last, last.max(1) - 1, self.velocities[1]));
        find(Some(Place::At(last)));
        self.heights = heights;
        [low, high]
    }

    /// An end or a corner.
    fn fixed(&self, index: usize) -> Contact {
        Contact { index, at: self.positions[index], point: self.points[index], rates: None }
    }

    fn is_corner(&self, index: usize) -> bool {
        self.corners.iter().any(|(corner, _)| *corner == index)
    }

    /// The extreme near a point, which is no corner, that the parabola through the point and its neighbours has.
    fn extreme_near(&self, levels: &dyn Levels, k: usize) -> Contact {
        let (points, positions) = (&self.points, &self.positions);
        let [before, after] = [k, k + 1].map(|k| positions[k] - positions[k - 1]);
        let slopes = [(points[k] - points[k - 1]) / before, (points[k + 1] - points[k]) / after];
        let acceleration = (slopes[1] - slopes[0]) * (2.0 / (before + after));
        let velocity = (slopes[0] * after + slopes[1] * before) / (before + after);
        let (contact, step) =
            self.extreme(levels, k, positions[k], points[k], [velocity, acceleration], [-before, after]);
        // Beyond a corner the curve is another.
        let is_beyond = (step <= -before && self.is_corner(k - 1)) || (step >= after && self.is_corner(k + 1));
        if is_beyond { self.fixed(k) } else { contact }
    }

    /// Whether there is an extreme between an end or a corner, at which the velocity is given, and the point next to it.
    fn turns_beside(&self, levels: &dyn Levels, end: usize, velocity: Vector, next: usize) -> bool {
        let (points, slope) = (&self.points, self.slope(end, next));
        let rate = |point: Point, velocity: Vector| levels.height_rates(point, velocity, Vector::zeros())[0];
        // From where it stops the curve goes in the direction of its acceleration.
        let leaving = if is_stopped(velocity, slope) { slope } else { velocity };
        rate(points[end], leaving) * rate(points[next], slope * 2.0 - velocity) < 0.0
    }

    /// The extreme there.
    fn extreme_beside(&self, levels: &dyn Levels, end: usize, velocity: Vector, next: usize) -> Contact {
        let gap = self.positions[next] - self.positions[end];
        let slope = self.slope(end, next);
        let (from, at, point, rates) = if is_stopped(velocity, slope) {
            let at = self.positions[end] + gap / 2.0;
            (gap / 2.0, at, self.row.point_at(at * self.spacing), [slope, slope * (2.0 / gap)])
        } else {
            (0.0, self.positions[end], self.points[end], [velocity, (slope - velocity) * (2.0 / gap)])
        };
        self.extreme(levels, next, at, point, rates, [gap.min(0.0) - from, gap.max(0.0) - from]).0
    }

    /// The mean velocity between two points.
    fn slope(&self, from: usize, to: usize) -> Vector {
        (self.points[to] - self.points[from]) / (self.positions[to] - self.positions[from])
    }

    /// The extreme height near that of the parabola with a velocity and an acceleration at a position, by Newton's
    /// method, to where the curve is as good as a parabola; and how far from the position it is, between two bounds.
    fn extreme(
        &self,
        levels: &dyn Levels,
        index: usize,
        at: f64,
        point: Point,
        [velocity, acceleration]: [Vector; 2],
        [least, most]: [f64; 2],
    ) -> (Contact, f64) {
        const ROUNDS: usize = 6;
        const SMALL: f64 = 1e-3;
        let mut step = vertex(levels, point, velocity, acceleration).clamp(least, most);
        let mut round = 1;
        loop {
            let (point, [velocity, acceleration]) = self.row.point_and_rates_at((at + step) * self.spacing);
            let rates = [velocity * self.spacing, acceleration * (self.spacing * self.spacing)];
            let next = (step + vertex(levels, point, rates[0], rates[1])).clamp(least, most);
            if (next - step).abs() < SMALL || round == ROUNDS {
                return (Contact { index, at: at + step, point, rates: Some(rates) }, step);
            }
            step = next;
            round += 1;
        }
    }
}

/// Whether contacts are where the curve touches the levels, or so near that it is as good as a parabola up to there.
pub fn are_touched(levels: &dyn Levels, contacts: &[Contact]) -> bool {
    contacts.iter().all(|contact| contact.is_within(CLOSE, levels))
}

/// The part of the distance of two points over which the curve is as good as a parabola.
const CLOSE: f64 = 0.02;

/// Whether the curve stops at a point from where it goes on at a mean velocity.
fn is_stopped(velocity: Vector, mean: Vector) -> bool {
    /// A velocity that is less than this part of the mean is none.
    const STOPPED: f64 = 1e-3;
    velocity.norm() < STOPPED * mean.norm()
}

/// A point closer to an end or a corner than this part of the spacing says nothing that these do not.
const TOO_CLOSE: f64 = 0.3;
