//! Annuli of portions of a curve, between any two positions of it.

use super::annulus::{AlternatingPoints, Annulus};
use super::contact::{Contact, Levels};
use super::longest_near::{Constraint, Constraints, Contacts};
use super::row::Row;
use super::strip::min_max;
use super::touching::{PortionPoints, are_touched};
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
    /// Whether the radius is the greatest that there may be.
    is_bounded: bool,
    /// The annulus that the contacts determine, and the group of spokes that decides.
    latest: Option<(Annulus, Group)>,
    /// The spokes about a centre, those about the centre before, and groups of them: kept for their memory.
    spokes: Vec<Spoke>,
    spokes_before: Vec<Spoke>,
    groups: Vec<Group>,
}

/// The annulus of the points that touch contains all others to this part of its width, where they are found anew, and nothing but
/// rounding is outside where they are those of the portion before.
const OUTSIDE: f64 = 1e-6;
const ROUNDING: f64 = 1e-9;

/// An annulus this much narrower hardly matters; those that are a little narrower yet are kept for portions next to this one.
const NEAR: f64 = 0.8;
const KEPT: f64 = 0.75;

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
            is_bounded: false,
            latest: None,
            spokes: Vec::new(),
            spokes_before: Vec::new(),
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
        self.is_bounded = sampled.radius >= self.max_radius - sampled.width;
        let mut about = sampled;
        let mut found = self.touching_annulus(about);
        for _ in 1..ROUNDS {
            let Some((annulus, _, false)) = found else { break };
            about = annulus;
            found = self.touching_annulus(about);
        }
        let (annulus, group) = match found {
            Some((annulus, group, true)) => (annulus, Some(group)),
            // The points alone show how wide it is.
            other => (sampled, other.map(|(_, group, _)| group)),
        };
        self.latest = group.map(|group| (annulus, group));
        Some(self.described(annulus, group))
    }

    /// The annulus of a portion next to the one before, which most often touches the same points; otherwise they are found anew.
    pub fn next_ring(&mut self, ends: [f64; 2]) -> Option<PortionRing> {
        let Some((annulus, group)) = self.latest.take().and_then(|latest| self.followed(latest, ends)) else {
            return self.ring(ends);
        };
        self.latest = Some((annulus, group));
        Some(self.described(annulus, Some(group)))
    }

    /// The annulus of a portion next to the one before, of which the points that touch are found anew.
    pub fn ring_anew(&mut self, ends: [f64; 2]) -> Option<PortionRing> {
        let latest = self.latest.take();
        if let Some((about, _)) = latest.filter(|_| self.portion.follow(ends, &mut self.contacts))
            && let Some((annulus, group, true)) = self.touching_annulus(about)
        {
            self.latest = Some((annulus, group));
            return Some(self.described(annulus, Some(group)));
        }
        self.ring(ends)
    }

    /// The annulus that touches the points that the one before touches or nearly does, where all others are in it.
    fn followed(&mut self, (latest, group): (Annulus, Group), ends: [f64; 2]) -> Option<(Annulus, Group)> {
        if !self.portion.follow(ends, &mut self.contacts) {
            return None;
        }
        let (annulus, group) = self.annulus_of_contacts(latest, Some(group))?;
        let is_bounded = annulus.radius >= self.max_radius - annulus.width;
        let [low, high] = self.portion.range_with_contacts(&Circles(annulus.centre), &self.contacts)?;
        let contains_others = high - low <= annulus.width * (1.0 + ROUNDING);
        (contains_others && is_bounded == self.is_bounded).then_some((annulus, group))
    }

    /// An annulus with what is known of how it changes.
    fn described(&self, annulus: Annulus, group: Option<Group>) -> PortionRing {
        let mut others = Constraints::default();
        let near = self.groups.iter().filter(|other| 2.0 * other.half.abs() >= NEAR * annulus.width);
        for (other, group) in others.iter_mut().zip(near) {
            *other = Some(Constraint { value: 2.0 * group.half.abs(), rates: self.width_rates(group) });
        }
        let Annulus { centre, radius, width } = annulus;
        let label = |k: usize| self.portion.label(self.spokes[k].index);
        PortionRing {
            centre,
            radius,
            width,
            width_rates: group.map_or([0.0; 2], |group| self.width_rates(&group)),
            contacts: group.map_or(Contacts::default(), |group| group.spokes.map(label)),
            others,
        }
    }

    /// The annulus of the points that touch one about which they are found or nearly do, the group of them that decides, and
    /// whether all other points are in it; `None` if no group decides.
    fn touching_annulus(&mut self, about: Annulus) -> Option<(Annulus, Group, bool)> {
        self.portion.collect_contacts(&Circles(about.centre), &[], &mut self.contacts);
        select_contacts(&mut self.contacts, &about, self.portion.last());
        let (annulus, group) = self.annulus_of_contacts(about, None)?;
        let [low, high] = min_max(&self.portion.points, |p| (p - annulus.centre).norm_squared()).map(f64::sqrt);
        let are_touched = are_touched(&Circles(annulus.centre), &self.contacts);
        Some((annulus, group, are_touched && high - low <= annulus.width * (1.0 + OUTSIDE)))
    }

    /// The annulus that touches the contacts that there are, of which a group is likely to decide.
    fn annulus_of_contacts(&mut self, about: Annulus, likely: Option<Group>) -> Option<(Annulus, Group)> {
        const ROUNDS: usize = 4;
        /// A motion of the centre, relative to the radius, whose square is less than rounding.
        const SMALL: f64 = 1e-8;
        let is_bounded = self.is_bounded;
        let (mut centre, mut radius) = (about.centre, if is_bounded { self.max_radius } else { about.radius });
        let CurveRings { portion, contacts, spokes, spokes_before, groups, .. } = self;
        let mut best = likely;
        for _ in 0..ROUNDS {
            portion.touch(&Circles(centre), contacts);
            std::mem::swap(spokes, spokes_before);
            collect_spokes(contacts, centre, spokes);
            let with_correction = |group: Group| (group, correction(&group, spokes, radius, is_bounded));
            // The group that decided about the centre before most often does so about this one.
            let before = best.and_then(|group| group.about(spokes, radius)).map(with_correction);
            let decides = before.filter(|(group, (motion, change))| {
                let most = group.half.abs() * (1.0 + 1e-12);
                spokes.iter().all(|spoke| (spoke.distance - radius - change - spoke.normal.dot(motion)).abs() <= most)
            });
            let decides = decides.or_else(|| {
                collect_groups(spokes, is_bounded.then_some(radius), groups);
                let widest = groups.iter().copied().max_by(|a, b| a.half.abs().total_cmp(&b.half.abs()));
                widest.map(with_correction)
            });
            let Some((group, (motion, change))) = decides else {
                // The best group is of the spokes before.
                std::mem::swap(spokes, spokes_before);
                break;
            };
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
        groups.retain(|other| other.half.abs() >= KEPT * group.half.abs());
        groups.iter_mut().for_each(|other| *other = other.about(spokes, radius).unwrap_or(*other));
        Some((Annulus { centre, radius, width }, group))
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
        false => annulus.width / 2.0 - (contact.touching_and_height(&circles).1 - annulus.radius).abs(),
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
        let (point, distance) = contact.touching_and_height(&circles);
        Spoke { normal: (point - centre).normalize(), distance, index: contact.index }
    };
    spokes.clear();
    spokes.extend(contacts.iter().map(spoke));
}

impl Group {
    /// The group of four spokes, whose multipliers are those of the affine dependency of their directions, or of three of which the
    /// last is given twice, about a circle: those of the linear dependency. `None` if they vanish.
    fn of(spokes: &[Spoke], members: [usize; 4], radius: f64) -> Option<Group> {
        let [a, b, c, d] = members.map(|k| spokes[k].normal);
        let (multipliers, radius) = if members[2] == members[3] {
            ([cross(b, c), cross(c, a), cross(a, b), 0.0], radius)
        } else {
            let area = |p: Vector, q: Vector, r: Vector| cross(q - p, r - p);
            ([area(b, c, d), -area(a, c, d), area(a, b, d), -area(a, b, c)], spokes[members[0]].distance)
        };
        let sum: f64 = multipliers.iter().map(|multiplier| multiplier.abs()).sum();
        let multipliers = multipliers.map(|multiplier| multiplier / sum);
        let half = (0..4).map(|i| multipliers[i] * (spokes[members[i]].distance - radius)).sum::<f64>();
        half.is_finite().then_some(Group { spokes: members, multipliers, half })
    }

    /// The same group of spokes about another centre.
    fn about(&self, spokes: &[Spoke], radius: f64) -> Option<Group> {
        Group::of(spokes, self.spokes, radius)
    }
}

/// Replaces `groups` with all of four spokes, or of three about a circle of a given radius.
fn collect_groups(spokes: &[Spoke], given_radius: Option<f64>, groups: &mut Vec<Group>) {
    groups.clear();
    let count = spokes.len();
    for i in 0..count {
        for j in i + 1..count {
            for k in j + 1..count {
                match given_radius {
                    Some(radius) => groups.extend(Group::of(spokes, [i, j, k, k], radius)),
                    None => groups.extend((k + 1..count).filter_map(|l| Group::of(spokes, [i, j, k, l], 0.0))),
                }
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
