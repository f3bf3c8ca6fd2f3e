//! The three four-bars that draw one coupler curve.

use super::{
    Assembly, Circuits, Class, Continuation, Error, FourBar, JointId, Link, Linkage, Side, Step, Travel,
    four_bar_tolerance,
};
use crate::geometry::{Point, Vector, cross, times, trig};

/// A four-bar where it stands in the plane, and a point of its coupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedFourBar {
    /// The pivot of the crank, and that of the rocker.
    pub pivots: [Point; 2],
    /// The lengths; the frame's is the distance of the pivots.
    pub lengths: FourBar,
    /// The coupler point: along the coupler from the crank pin towards the rocker pin, and to the left of it.
    pub point: Vector,
}

/// A link of a four-bar that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bar {
    /// The one on the first pivot.
    Crank,
    /// The one between the pins.
    Coupler,
    /// The one on the second pivot.
    Rocker,
}

impl Bar {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Bar::Crank => "crank",
            Bar::Coupler => "coupler",
            Bar::Rocker => "rocker",
        }
    }
}

/// A four-bar that draws the same curve as another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cognate {
    /// The four-bar. Its crank is the link on a pivot that is the shortest of all, where one is: then it turns fully.
    pub four_bar: PlacedFourBar,
    /// Which links of the original its crank, coupler and rocker turn as: each keeps its angle to that one.
    pub turns_as: [Bar; 3],
    /// Where its crank pin is from its crank's pivot, and its rocker pin from its rocker's: so many times a vector of the
    /// original, as a complex number.
    arms: [Vector; 2],
}

/// The two cognates of a four-bar and the pivot they share.
///
/// With A, B the pins, O and C their pivots, M the coupler point and, as complex numbers, lambda = (M - A) / (B - A), the third
/// pivot is Q = O + lambda (C - O): the triangle O C Q is similar to the coupler's, A B M. From
/// M = Q + (1 - lambda) (A - O) + lambda (B - C) follow two further loops:
///
/// - on O and Q: a link on O of lambda (B - A), a coupler of lambda (A - O), a link on Q of lambda (B - C);
/// - on C and Q: a link on C of (lambda - 1) (B - A), a coupler of (1 - lambda) (B - C), a link on Q of (1 - lambda) (A - O).
///
/// So the links turn as those of the original do, in pairs: on O and on C as its coupler, on Q one as its crank and one as its
/// rocker. Each coupler triangle is similar to A B M, and the cognates are of the same kind of chain, Grashof's or not.
///
/// Of a rhombus each link is at rest in one of its three motions, and so no one link drives a cognate through all of the curve.
///
/// # Source
/// S. Roberts, *On three-bar motion in plane space*, Proc. London Math. Soc. 7 (1875); Chebyshev 1878. Natesan 1994 names no
/// cognates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cognates {
    /// The four-bar they are of.
    pub original: PlacedFourBar,
    /// The third pivot, Q.
    pub third_pivot: Point,
    /// The cognate on the crank's pivot and the third, and that on the rocker's pivot and the third.
    pub others: [Cognate; 2],
}

/// Why a linkage has no cognates.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoCognates {
    /// It is no four-bar.
    #[error("it is no four-bar: cognates are known of a crank and one dyad, with points on their links")]
    NoFourBar,
    /// The traced joint is on another link.
    #[error("`{joint}` is no point of its coupler")]
    NotOnCoupler {
        /// The traced joint.
        joint: String,
    },
    /// The coupler point is a pin.
    #[error("its coupler point is the {pin} pin, which goes on a circle: one cognate would have links of no length")]
    OnPin {
        /// Which pin: the crank's or the rocker's.
        pin: &'static str,
    },
}

impl NoCognates {
    /// The remedy.
    pub fn help(&self) -> &'static str {
        match self {
            NoCognates::NoFourBar => "name a linkage whose class `inspect` tells",
            NoCognates::NotOnCoupler { .. } => "trace a point of the link with the crank pin and the rocker pin",
            NoCognates::OnPin { .. } => "take a coupler point off the pins",
        }
    }
}

impl PlacedFourBar {
    /// The four-bar in a linkage and where it stands in the plane it is reported in, with one of its joints for its coupler
    /// point.
    ///
    /// # Errors
    /// It is no four-bar, or the joint is not on its coupler.
    pub fn of(linkage: &Linkage, joint: JointId) -> Result<PlacedFourBar, NoCognates> {
        let (Some(pins), Some(lengths)) = (FourBar::pins(linkage), FourBar::of(linkage)) else {
            return Err(NoCognates::NoFourBar);
        };
        let [o, a, b, c] = pins;
        let (Some(from), Some(to), Some(place)) = on_link(linkage, [a, b], joint) else {
            let joint = linkage.joints.get(joint).map_or(String::new(), |joint| joint.name.clone());
            return Err(NoCognates::NotOnCoupler { joint });
        };
        let along = (to - from) / lengths.coupler;
        let (m, handedness) = (place - from, linkage.placement.handedness());
        let point = Vector::new(along.dot(&m), cross(along, m) * handedness);
        let place = |joint| linkage.links[0].place(joint).map(Point::from);
        let pivots = match (linkage.seen_from, place(o), place(c)) {
            (None, Some(o), Some(c)) => [o, c],
            // The view has the crank's pivot at its origin and the rocker's on its x-axis.
            _ => [Point::origin(), Point::new(lengths.frame, 0.0)],
        };
        Ok(PlacedFourBar { pivots: pivots.map(|p| linkage.placement.point(p)), lengths, point })
    }

    /// It as a linkage of joints O, C, A, B and M, traced, with the rocker pin on a side of the ray from the crank pin to the
    /// rocker's pivot.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn linkage(&self, side: Side, travel: Travel) -> Result<Linkage, Error> {
        let FourBar { crank, coupler, rocker, .. } = self.lengths;
        let mut assembly = Assembly::default();
        let [o, c] = [("O", self.pivots[0]), ("C", self.pivots[1])].map(|(name, at)| assembly.fixed(name, at));
        let a = assembly.crank("A", o, crank)?;
        let b = assembly.dyad("B", [a, c], [coupler, rocker], side)?;
        let m = assembly.point("M", [a, b], self.point.x, self.point.y)?;
        assembly.finish(vec![m], None, travel)
    }

    /// The same, driven from its other pivot.
    fn reversed(self) -> PlacedFourBar {
        let FourBar { frame, crank, coupler, rocker } = self.lengths;
        PlacedFourBar {
            pivots: [self.pivots[1], self.pivots[0]],
            lengths: FourBar { frame, crank: rocker, coupler, rocker: crank },
            point: Vector::new(coupler - self.point.x, -self.point.y),
        }
    }
}

impl Cognates {
    /// The cognates of a four-bar.
    ///
    /// # Errors
    /// The coupler point is within 1e-12 of the coupler's length of a pin.
    pub fn of(original: PlacedFourBar) -> Result<Cognates, NoCognates> {
        let FourBar { frame: g, crank: r, coupler: h, rocker: s } = original.lengths;
        // From the pins to the coupler point.
        let (u, w) = (original.point, original.point - Vector::new(h, 0.0));
        let (near, far) = (u.norm(), w.norm());
        for (pin, distance) in [("crank", near), ("rocker", far)] {
            if distance <= 1e-12 * h {
                return Err(NoCognates::OnPin { pin });
            }
        }
        let [o, c] = original.pivots;
        let third_pivot = o + times(u / h, c - o);
        let scaled = |by: f64, [crank, coupler, rocker]: [f64; 3]| FourBar {
            frame: by * g,
            crank,
            coupler: by * coupler,
            rocker: by * rocker,
        };
        let (lambda, rest) = (u / h, -w / h);
        // The point is as far from the pin of the first as the crank is long, at minus the angle of lambda.
        let first = Cognate {
            four_bar: PlacedFourBar {
                pivots: [o, third_pivot],
                lengths: scaled(near / h, [near, r, s]),
                point: conjugate(u) * (r / near),
            },
            turns_as: [Bar::Coupler, Bar::Crank, Bar::Rocker],
            arms: [lambda, lambda],
        };
        let second = Cognate {
            four_bar: PlacedFourBar {
                pivots: [c, third_pivot],
                lengths: scaled(far / h, [far, s, r]),
                point: conjugate(-w) * (s / far),
            },
            turns_as: [Bar::Coupler, Bar::Rocker, Bar::Crank],
            arms: [-rest, rest],
        };
        let others = [first, second].map(Cognate::driven);
        Ok(Cognates { original, third_pivot, others })
    }

    /// All three, the original first.
    pub fn all(&self) -> [Cognate; 3] {
        let [first, second] = self.others;
        [Cognate::itself(self.original), first, second]
    }

    /// A linkage with its cognates hung on, by parallelograms and by triangles similar to the coupler's: it moves as
    /// before, and all three carry its coupler point `joint`. The new joints are Q, D, E, F and G, as in the catalogue's
    /// `cognates`; with the links they make. If it is one of a grid of points, the others are taken off their link.
    ///
    /// Returns it with the links of the two cognates.
    ///
    /// # Errors
    /// As [`PlacedFourBar::of`] and [`Cognates::of`].
    pub fn hung(linkage: &Linkage, joint: JointId) -> Result<(Linkage, [Vec<usize>; 2]), NoCognates> {
        let mut drawn = linkage.clone();
        let mut placed = PlacedFourBar::of(linkage, joint)?;
        // In the plane of the joints themselves, before the linkage is mirrored.
        placed.point.y *= linkage.placement.handedness();
        Cognates::of(placed)?;
        let (Some([o, a, b, c]), lambda) = (FourBar::pins(linkage), placed.point / placed.lengths.coupler) else {
            return Err(NoCognates::NoFourBar);
        };
        let rest = Vector::new(1.0, 0.0) - lambda;
        alone(&mut drawn, joint);
        let mut add = |name: &str, step| {
            drawn.joints.push(super::Joint { name: name.to_owned(), step });
            drawn.joints.len() - 1
        };
        let rigid = |base, by: Vector| Step::Rigid { base, along: by.x, across: by.y };
        let q = add("Q", rigid([o, c], lambda));
        let d = add("D", Step::Parallelogram { corners: [o, a, joint] });
        let e = add("E", rigid([d, joint], lambda));
        let f = add("F", Step::Parallelogram { corners: [c, b, joint] });
        let g = add("G", rigid([f, joint], rest));
        let on_frame = drawn.links.iter_mut().find_map(|link| {
            let (from, to) = (link.place(o)?, link.place(c)?);
            Some((from + times(lambda, to - from), link))
        });
        if let Some((place, link)) = on_frame {
            link.joints.push((q, place));
        }
        let FourBar { crank, rocker, coupler, .. } = placed.lengths;
        let (near, far) = (placed.point.norm(), (rest * coupler).norm());
        let mut link = |joints: &[(JointId, Vector)]| {
            drawn.links.push(Link { joints: joints.to_vec() });
            drawn.links.len() - 1
        };
        let zero = Vector::zeros();
        let along = |length: f64| Vector::new(length, 0.0);
        let first = vec![
            link(&[(o, zero), (d, along(near))]),
            link(&[(d, zero), (joint, along(crank)), (e, lambda * crank)]),
            link(&[(q, zero), (e, along(near / coupler * rocker))]),
        ];
        let second = vec![
            link(&[(c, zero), (f, along(far))]),
            link(&[(f, zero), (joint, along(rocker)), (g, rest * rocker)]),
            link(&[(q, zero), (g, along(far / coupler * crank))]),
        ];
        Ok((drawn, [first, second]))
    }
}

impl Cognate {
    /// A four-bar as a cognate of its own.
    fn itself(four_bar: PlacedFourBar) -> Cognate {
        let one = Vector::new(1.0, 0.0);
        Cognate { four_bar, turns_as: [Bar::Crank, Bar::Coupler, Bar::Rocker], arms: [one, one] }
    }

    /// Driven by the shortest link, if that is on a pivot, or, of a kite, by the one that never rests; else by the one that turns as the original's crank; else by that
    /// on the original's pivot.
    fn driven(self) -> Cognate {
        let FourBar { crank, coupler, rocker, frame } = self.four_bar.lengths;
        let tolerance = four_bar_tolerance(crank + coupler + rocker + frame);
        let least = frame.min(coupler) + tolerance;
        // A link as long as the frame rests while the other two, of one length, turn about its pin.
        let rests = |link: f64, other: f64| (link - frame).abs() <= tolerance && (other - coupler).abs() <= tolerance;
        let is_better = if rests(crank, rocker) != rests(rocker, crank) {
            rests(crank, rocker)
        } else if (rocker - crank).abs() > tolerance && rocker.min(crank) <= least {
            rocker < crank
        } else {
            self.turns_as[2] == Bar::Crank
        };
        if !is_better {
            return self;
        }
        let ([first, coupler, last], [crank_arm, rocker_arm]) = (self.turns_as, self.arms);
        Cognate { four_bar: self.four_bar.reversed(), turns_as: [last, coupler, first], arms: [rocker_arm, crank_arm] }
    }

    /// Its crank pin and its rocker pin in a pose of the original, whose crank pivot, crank pin, rocker pin and rocker pivot
    /// are given.
    pub fn pins(&self, [o, a, b, c]: [Point; 4]) -> [Point; 2] {
        let arm = |bar| match bar {
            Bar::Crank => a - o,
            Bar::Coupler => b - a,
            Bar::Rocker => b - c,
        };
        let [first, second] = self.four_bar.pivots;
        let [crank, _, rocker] = self.turns_as;
        [first + times(self.arms[0], arm(crank)), second + times(self.arms[1], arm(rocker))]
    }

    /// It as a linkage that draws the curve the original draws, of which poses on its first circuit are given as for
    /// [`Cognate::pins`], and how it travels.
    ///
    /// Its start is at that pose in which its dyad is furthest from flat. Its circuits are all, or the one through the start,
    /// as the original's are; where that keeps its branch at change points, which has another meaning for each cognate, they
    /// are all. It goes through its whole range of input: a part of the original's is no one range of a cognate's.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn linkage(&self, poses: impl IntoIterator<Item = [Point; 4]>, travel: &Travel) -> Result<Linkage, Error> {
        let starts = poses.into_iter().map(|pose| self.start(pose)).filter(|start| start.2.is_finite());
        let best = starts.reduce(|best, start| if start.2 > best.2 { start } else { best });
        let is_parted =
            travel.continuation == Continuation::Branch && self.four_bar.lengths.class() == Class::ChangePoint;
        let circuits = if is_parted { Circuits::All } else { travel.circuits };
        let (start, side) = match best {
            Some((start, side, _)) if circuits == Circuits::Start => (Some(start), side),
            _ => (None, Side::Left),
        };
        self.four_bar.linkage(side, Travel { start, circuits, ..Travel::default() })
    }

    /// Its input, in degrees from -180 to 180, and the side of its rocker pin in a pose of the original, as for
    /// [`Cognate::pins`]; and how far from flat its dyad is there: the sine of the transmission angle.
    pub fn start(&self, pose: [Point; 4]) -> (f64, Side, f64) {
        let [a, b] = self.pins(pose);
        let [o, c] = self.four_bar.pivots;
        let FourBar { coupler, rocker, .. } = self.four_bar.lengths;
        let turn = cross(c - b, b - a) / (coupler * rocker);
        let arm = a - o;
        (trig::degrees(trig::atan2(arm.y, arm.x)), if turn > 0.0 { Side::Left } else { Side::Right }, turn.abs())
    }
}

fn conjugate(a: Vector) -> Vector {
    Vector::new(a.x, -a.y)
}

/// Takes the other points of a grid off their link, and gives this one a name of its own.
fn alone(linkage: &mut Linkage, joint: JointId) {
    let name = linkage.joints[joint].name.clone();
    let grid: Vec<JointId> = (0..linkage.joints.len()).filter(|&other| linkage.joints[other].name == name).collect();
    if let ([_, _, ..], Some(place)) = (&grid[..], grid.iter().position(|&other| other == joint)) {
        for link in &mut linkage.links {
            link.joints.retain(|(other, _)| *other == joint || !grid.contains(other));
        }
        linkage.joints[joint].name = format!("{name}{}", place + 1);
    }
}

/// The places of two joints and a third on the link that has the first two.
fn on_link(linkage: &Linkage, base: [JointId; 2], joint: JointId) -> (Option<Vector>, Option<Vector>, Option<Vector>) {
    let has = |link: &&Link| base.iter().all(|&pin| link.place(pin).is_some());
    let link = linkage.links.iter().find(has);
    let place = |joint| link.and_then(|link| link.place(joint));
    (place(base[0]), place(base[1]), place(joint))
}
