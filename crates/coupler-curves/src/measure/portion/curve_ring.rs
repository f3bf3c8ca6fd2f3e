//! Annuli of portions of a curve, between any two positions of it.

use super::annulus::{AlternatingPoints, Annulus};
use super::longest_near::{Constraint, Constraints, Contacts};
use super::row::Row;
use super::strip::min_max;
use super::touching::{Contact, Levels, PortionPoints};
use crate::geometry::{Point, Vector, cross};

/// The narrowest annulus of a portion of a curve, and how its width changes with the ends.
#[derive(Clone, Copy, Debug)]
pub struct PortionRing {
    /// The centre of its circles.
    pub centre: Point,
    /// The radius halfway between them.
    pub radius: f64,
    /// The difference of their radii.
    pub width: f64,
    /// The derivatives of the width with respect to the positions of the start and of the end.
    pub width_rates: [f64; 2],
    /// Which points touch the circles.
    pub contacts: Contacts,
    /// The widths for other points that nearly touch, and their rates.
    pub others: Constraints,
}

/// The annuli of portions of a row's curve near each other, with a mean radius no greater than a given one.
///
/// The points that the circles touch are found among evenly spaced points, and then moved to where the curve touches.
/// For a small motion of the centre distances from it are linear, and the width is a linear minimax problem: of all
/// groups of four points, or of three if the radius is given, the one that needs the greatest width decides.
#[derive(Clone, Debug)]
pub struct CurveRings<'a> {
    portion: PortionPoints<'a>,
    max_radius: f64,
    contacts: Vec<Contact>,
    alternating: AlternatingPoints,
    /// The spokes about a centre, those about the centre before, and groups of them: kept for their memory.
    spokes: Vec<Spoke>,
    earlier_spokes: Vec<Spoke>,
    groups: Vec<Group>,
}

/// Circles about a centre.
struct Circles(Point);

impl Levels for Circles {
    fn height(&self, point: Point) -> f64 {
        (point - self.0).norm()
    }

    fn height_rates(&self, point: Point, velocity: Vector, acceleration: Vector) -> [f64; 2] {
        let offset = point - self.0;
        let distance = offset.norm();
        let rate = offset.dot(&velocity) / distance;
        [rate, (offset.dot(&acceleration) + velocity.norm_squared() - rate * rate) / distance]
    }
}

/// A point that may touch, seen from the centre: its direction and its distance.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    normal: Vector,
    distance: f64,
    /// The index of the point in the portion.
    index: usize,
}

/// Spokes, as many as determine the annulus, and their multipliers, the sum of whose magnitudes is 1: that of the
/// spokes, each with its multiplier, is zero.
#[derive(Clone, Copy, Debug)]
struct Group {
    spokes: [usize; 4],
    multipliers: [f64; 4],
    /// Half the width that they need, with a sign.
    half: f64,
}

impl<'a> CurveRings<'a> {
    /// For portions about as long as the one between two positions, with about this many points.
    pub fn new(row: &'a Row, ends: [f64; 2], count: usize, max_radius: f64) -> CurveRings<'a> {
        CurveRings {
            portion: PortionPoints::new(row, ends, count),
            max_radius,
            contacts: Vec::new(),
            alternating: AlternatingPoints::folded(row.is_folded()),
            spokes: Vec::new(),
            earlier_spokes: Vec::new(),
            groups: Vec::new(),
        }
    }

    /// The same, with more points of the row, by their indices.
    pub fn with_points(mut self, added: &[i64]) -> CurveRings<'a> {
        self.portion.added.extend_from_slice(added);
        self
    }

    /// The annulus of the portion between two positions; `None` if it is straight.
    pub fn ring(&mut self, ends: [f64; 2]) -> Option<PortionRing> {
        /// So often are points that touch found anew, where others stick out of the annulus of those found.
        const ROUNDS: usize = 4;
        self.portion.turn_to(ends);
        let points = &self.portion.points;
        if points.len() < 4 {
            return None;
        }
        let sampled = self.alternating.narrowest_annulus_within(points, f64::INFINITY, self.max_radius)?;
        let is_bounded = sampled.radius >= self.max_radius - sampled.width;
        let mut about = sampled;
        let mut found = self.touching_annulus(about, is_bounded);
        for _ in 1..ROUNDS {
            let Some((annulus, _, false)) = found else { break };
            about = annulus;
            found = self.touching_annulus(about, is_bounded);
        }
        let (annulus, group) = match found {
            Some((annulus, group, true)) => (annulus, Some(group)),
            // The points alone show how wide it is.
            other => (sampled, other.map(|(_, group, _)| group)),
        };
        let mut others = Constraints::default();
        let near = self.groups.iter().filter(|other| 2.0 * other.half.abs() >= 0.8 * annulus.width);
        for (other, group) in others.iter_mut().zip(near) {
            *other = Some(Constraint { value: 2.0 * group.half.abs(), rates: self.width_rates(group) });
        }
        let Annulus { centre, radius, width } = annulus;
        let label = |k: usize| self.portion.label(self.spokes[k].index);
        Some(PortionRing {
            centre,
            radius,
            width,
            width_rates: group.map_or([0.0; 2], |group| self.width_rates(&group)),
            contacts: group.map_or(Contacts::default(), |group| group.spokes.map(label)),
            others,
        })
    }

    /// The annulus of the points that touch one about which they are found or nearly do, the group of them that decides, and
    /// whether all other points are in it; `None` if no group decides.
    fn touching_annulus(&mut self, about: Annulus, is_bounded: bool) -> Option<(Annulus, Group, bool)> {
        const ROUNDS: usize = 3;
        /// A motion of the centre, relative to the radius, whose square is less than rounding.
        const SMALL: f64 = 1e-8;
        /// The annulus of the points that touch contains all others to this part of its width.
        const MOVED: f64 = 1e-6;
        let (mut centre, mut radius) = (about.centre, if is_bounded { self.max_radius } else { about.radius });
        self.portion.collect_contacts(&Circles(centre), &[], &mut self.contacts);
        select_contacts(&mut self.contacts, &about, self.portion.last());
        let CurveRings { contacts, spokes, earlier_spokes, groups, .. } = self;
        let mut best: Option<Group> = None;
        groups.clear();
        for _ in 0..ROUNDS {
            std::mem::swap(spokes, earlier_spokes);
            collect_spokes(contacts, centre, spokes);
            groups.clear();
            if is_bounded {
                collect_groups_of_three(spokes, radius, groups);
            } else {
                collect_groups_of_four(spokes, groups);
            }
            let Some(group) = groups.iter().copied().max_by(|a, b| a.half.abs().total_cmp(&b.half.abs())) else {
                // The best group is of the spokes before.
                std::mem::swap(spokes, earlier_spokes);
                break;
            };
            let (motion, change) = correction(&group, spokes, radius, is_bounded);
            best = Some(group);
            let is_small = motion.norm() <= 0.5 * radius;
            if !is_small {
                break;
            }
            centre += motion;
            radius += change;
            if motion.norm() <= SMALL * radius {
                break;
            }
        }
        let group = best?;
        let width = 2.0 * group.half.abs();
        let [low, high] = min_max(&self.portion.points, |p| (p - centre).norm_squared()).map(f64::sqrt);
        Some((Annulus { centre, radius, width }, group, high - low <= width * (1.0 + MOVED)))
    }

    /// The derivatives of the width that a group of the spokes needs with respect to the ends.
    fn width_rates(&self, group: &Group) -> [f64; 2] {
        let velocities = self.portion.end_velocities();
        [(0, velocities[0]), (self.portion.last(), velocities[1])].map(|(end, velocity)| {
            let spoke = |i: usize| self.spokes[group.spokes[i]];
            let at_end = (0..4).filter(|&i| group.multipliers[i] != 0.0 && spoke(i).index == end);
            let rate: f64 = at_end.map(|i| group.multipliers[i] * spoke(i).normal.dot(&velocity)).sum();
            2.0 * rate * group.half.signum()
        })
    }
}

/// Drops contacts at one place, as of a path that goes back along itself, and of too many those that are furthest from touching the
/// annulus of the points; never the ends, which move.
fn select_contacts(contacts: &mut Vec<Contact>, annulus: &Annulus, last: usize) {
    /// No more points than this touch, or nearly do.
    const MOST: usize = 9;
    /// The distance of contacts at one place, relative to the radius.
    const SAME: f64 = 1e-6;
    if contacts.len() <= MOST {
        return;
    }
    let circles = Circles(annulus.centre);
    let is_end = |contact: &Contact| contact.index == 0 || contact.index == last;
    let mut places: Vec<Point> = Vec::new();
    contacts.retain(|contact| {
        let place = contact.touching(&circles);
        let is_new = places.iter().all(|other| (place - other).norm() > SAME * annulus.radius);
        places.extend((is_new && !is_end(contact)).then_some(place));
        is_new || is_end(contact)
    });
    let inside = |contact: &Contact| match is_end(contact) {
        true => f64::NEG_INFINITY,
        false => annulus.width / 2.0 - (contact.height(&circles) - annulus.radius).abs(),
    };
    while contacts.len() > MOST {
        let depths = contacts.iter().map(inside).enumerate();
        let Some((deepest, _)) = depths.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        contacts.remove(deepest);
    }
}

/// Replaces `spokes` with those of contacts.
fn collect_spokes(contacts: &[Contact], centre: Point, spokes: &mut Vec<Spoke>) {
    let circles = Circles(centre);
    let spoke = |contact: &Contact| {
        let normal = (contact.touching(&circles) - centre).normalize();
        Spoke { normal, distance: contact.height(&circles), index: contact.index }
    };
    spokes.clear();
    spokes.extend(contacts.iter().map(spoke));
}

/// A group with its multipliers, which need not be normalised; `None` if they vanish.
fn group(spokes: &[Spoke], members: [usize; 4], multipliers: [f64; 4], radius: f64) -> Option<Group> {
    let sum: f64 = multipliers.iter().map(|multiplier| multiplier.abs()).sum();
    let multipliers = multipliers.map(|multiplier| multiplier / sum);
    let half = (0..4).map(|i| multipliers[i] * (spokes[members[i]].distance - radius)).sum::<f64>();
    half.is_finite().then_some(Group { spokes: members, multipliers, half })
}

/// Adds all groups of four spokes: their multipliers are those of the affine dependency of the directions.
fn collect_groups_of_four(spokes: &[Spoke], groups: &mut Vec<Group>) {
    let count = spokes.len();
    for i in 0..count {
        for j in i + 1..count {
            for k in j + 1..count {
                for l in k + 1..count {
                    let area = |a: usize, b: usize, c: usize| {
                        cross(spokes[b].normal - spokes[a].normal, spokes[c].normal - spokes[a].normal)
                    };
                    let multipliers = [area(j, k, l), -area(i, k, l), area(i, j, l), -area(i, j, k)];
                    groups.extend(group(spokes, [i, j, k, l], multipliers, spokes[i].distance));
                }
            }
        }
    }
}

/// Adds all groups of three spokes: their multipliers are those of the linear dependency of the directions.
fn collect_groups_of_three(spokes: &[Spoke], radius: f64, groups: &mut Vec<Group>) {
    let count = spokes.len();
    for i in 0..count {
        for j in i + 1..count {
            for k in j + 1..count {
                let [a, b, c] = [i, j, k].map(|n| spokes[n].normal);
                groups.extend(group(spokes, [i, j, k, k], [cross(b, c), cross(c, a), cross(a, b), 0.0], radius));
            }
        }
    }
}

/// The motion of the centre and the change of the radius with which the spokes of a group are equally far from the
/// circle halfway, on the sides of their multipliers.
fn correction(group: &Group, spokes: &[Spoke], radius: f64, is_bounded: bool) -> (Vector, f64) {
    let row = |i: usize| {
        let spoke = spokes[group.spokes[i]];
        (spoke.normal, spoke.distance - radius - group.half * group.multipliers[i].signum())
    };
    // The motion m and the change r satisfy n.m + r = h for each spoke.
    let solve =
        |(a, d): (Vector, f64), (b, e): (Vector, f64)| Vector::new(d * b.y - e * a.y, e * a.x - d * b.x) / cross(a, b);
    if is_bounded {
        let pairs = [(0, 1), (1, 2), (0, 2)];
        let widest = pairs
            .into_iter()
            .max_by(|&(a, b), &(c, d)| cross(row(a).0, row(b).0).abs().total_cmp(&cross(row(c).0, row(d).0).abs()));
        let (i, j) = widest.unwrap_or((0, 1));
        return (solve(row(i), row(j)), 0.0);
    }
    let difference = |i: usize, j: usize| (row(j).0 - row(i).0, row(j).1 - row(i).1);
    let motion = solve(difference(0, 2), difference(1, 3));
    (motion, row(0).1 - row(0).0.dot(&motion))
}
