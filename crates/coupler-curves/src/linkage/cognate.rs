//! The three four-bars that draw one coupler curve.

use super::{
    CircuitSelection, Continuation, Error, FourBar, FourBarClass, JointId, JointKind, Link, Linkage, LinkageBuilder,
    MotionOptions, Side, length_tolerance,
};
use crate::geometry::{Point, Vector, complex_product, cross, trig};

/// A four-bar where it stands in the plane, and a point of its coupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedFourBar {
    /// The pivot of the crank, and that of the rocker.
    pub pivots: [Point; 2],
    /// The lengths; the frame's is the distance of the pivots.
    pub lengths: FourBar,
    /// The coupler point: along the coupler from the crank pin towards the rocker pin, and to the left of it.
    pub coupler_point: Vector,
}

/// A link of a four-bar that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovingLink {
    /// The one on the first pivot.
    Crank,
    /// The one between the pins.
    Coupler,
    /// The one on the second pivot.
    Rocker,
}

impl MovingLink {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            MovingLink::Crank => "crank",
            MovingLink::Coupler => "coupler",
            MovingLink::Rocker => "rocker",
        }
    }
}

/// A four-bar that draws the same curve as another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cognate {
    /// The four-bar. Its crank is the link on a pivot that is the shortest of all, where one is: then it turns fully.
    pub four_bar: PlacedFourBar,
    /// Which links of the original its crank, coupler and rocker turn as: each keeps its angle to that one.
    pub counterparts: [MovingLink; 3],
    /// Where its crank pin is from its crank's pivot, and its rocker pin from its rocker's: so many times a vector of the
    /// original, as a complex number.
    arm_factors: [Vector; 2],
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
pub enum CognateError {
    /// It is no four-bar.
    #[error("it is no four-bar: cognates are known of a crank and one dyad, with points on their links")]
    NotFourBar,
    /// The traced joint is on another link.
    #[error("`{joint}` is no point of its coupler")]
    NotOnCoupler {
        /// The traced joint.
        joint: String,
    },
    /// The coupler point is a pin.
    #[error("its coupler point is the {pin} pin, which goes on a circle: one cognate would have links of no length")]
    CouplerPointOnPin {
        /// Which pin: the crank's or the rocker's.
        pin: &'static str,
    },
}

impl CognateError {
    /// The remedy.
    pub fn help(&self) -> &'static str {
        match self {
            CognateError::NotFourBar => "name a linkage whose class `inspect` tells",
            CognateError::NotOnCoupler { .. } => "trace a point of the link with the crank pin and the rocker pin",
            CognateError::CouplerPointOnPin { .. } => "take a coupler point off the pins",
        }
    }
}

impl PlacedFourBar {
    /// The four-bar in a linkage and where it stands in the plane it is reported in, with one of its joints for its coupler
    /// point.
    ///
    /// # Errors
    /// It is no four-bar, or the joint is not on its coupler.
    pub fn from_linkage(linkage: &Linkage, joint: JointId) -> Result<PlacedFourBar, CognateError> {
        let (Some(pins), Some(lengths)) = (FourBar::pins(linkage), FourBar::from_linkage(linkage)) else {
            return Err(CognateError::NotFourBar);
        };
        let [o, a, b, c] = pins;
        let (Some(from), Some(to), Some(place)) = positions_on_link(linkage, [a, b], joint) else {
            let joint = linkage.joints.get(joint).map_or(String::new(), |joint| joint.name.clone());
            return Err(CognateError::NotOnCoupler { joint });
        };
        let along = (to - from) / lengths.coupler;
        let (m, handedness) = (place - from, linkage.placement.handedness());
        let point = Vector::new(along.dot(&m), cross(along, m) * handedness);
        let place = |joint| linkage.links[0].position(joint).map(Point::from);
        let pivots = match (linkage.seen_from, place(o), place(c)) {
            (None, Some(o), Some(c)) => [o, c],
            // The view has the crank's pivot at its origin and the rocker's on its x-axis.
            _ => [Point::origin(), Point::new(lengths.frame, 0.0)],
        };
        Ok(PlacedFourBar {
            pivots: pivots.map(|p| linkage.placement.transform_point(p)),
            lengths,
            coupler_point: point,
        })
    }

    /// It as a linkage of joints O, C, A, B and M, traced, with the rocker pin on a side of the ray from the crank pin to the
    /// rocker's pivot.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn to_linkage(&self, side: Side, travel: MotionOptions) -> Result<Linkage, Error> {
        let FourBar { crank, coupler, rocker, .. } = self.lengths;
        let mut assembly = LinkageBuilder::default();
        let [o, c] = [("O", self.pivots[0]), ("C", self.pivots[1])].map(|(name, at)| assembly.fixed(name, at));
        let a = assembly.crank("A", o, crank)?;
        let b = assembly.dyad("B", [a, c], [coupler, rocker], side)?;
        let m = assembly.point("M", [a, b], self.coupler_point.x, self.coupler_point.y)?;
        assembly.build(vec![m], None, travel)
    }

    /// The same, driven from its other pivot.
    fn reversed(self) -> PlacedFourBar {
        let FourBar { frame, crank, coupler, rocker } = self.lengths;
        PlacedFourBar {
            pivots: [self.pivots[1], self.pivots[0]],
            lengths: FourBar { frame, crank: rocker, coupler, rocker: crank },
            coupler_point: Vector::new(coupler - self.coupler_point.x, -self.coupler_point.y),
        }
    }
}

impl Cognates {
    /// The cognates of a four-bar.
    ///
    /// # Errors
    /// The coupler point is within 1e-12 of the coupler's length of a pin.
    pub fn from_four_bar(original: PlacedFourBar) -> Result<Cognates, CognateError> {
        let FourBar { frame: g, crank: r, coupler: h, rocker: s } = original.lengths;
        // From the pins to the coupler point.
        let (u, w) = (original.coupler_point, original.coupler_point - Vector::new(h, 0.0));
        let (near, far) = (u.norm(), w.norm());
        for (pin, distance) in [("crank", near), ("rocker", far)] {
            if distance <= 1e-12 * h {
                return Err(CognateError::CouplerPointOnPin { pin });
            }
        }
        let [o, c] = original.pivots;
        let third_pivot = o + complex_product(u / h, c - o);
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
                coupler_point: conjugate(u) * (r / near),
            },
            counterparts: [MovingLink::Coupler, MovingLink::Crank, MovingLink::Rocker],
            arm_factors: [lambda, lambda],
        };
        let second = Cognate {
            four_bar: PlacedFourBar {
                pivots: [c, third_pivot],
                lengths: scaled(far / h, [far, s, r]),
                coupler_point: conjugate(-w) * (s / far),
            },
            counterparts: [MovingLink::Coupler, MovingLink::Rocker, MovingLink::Crank],
            arm_factors: [-rest, rest],
        };
        let others = [first, second].map(Cognate::with_best_crank);
        Ok(Cognates { original, third_pivot, others })
    }

    /// All three, the original first.
    pub fn all(&self) -> [Cognate; 3] {
        let [first, second] = self.others;
        [Cognate::from_original(self.original), first, second]
    }

    /// A linkage with its cognates hung on, by parallelograms and by triangles similar to the coupler's: it moves as
    /// before, and all three carry its coupler point `joint`. The new joints are Q, D, E, F and G, as in the catalogue's
    /// `cognates`; with the links they make. If it is one of a grid of points, the others are taken off their link.
    ///
    /// Returns it with the links of the two cognates.
    ///
    /// # Errors
    /// As [`PlacedFourBar::from_linkage`] and [`Cognates::from_four_bar`].
    pub fn assemble(linkage: &Linkage, joint: JointId) -> Result<(Linkage, [Vec<usize>; 2]), CognateError> {
        let mut drawn = linkage.clone();
        let mut placed = PlacedFourBar::from_linkage(linkage, joint)?;
        // In the plane of the joints themselves, before the linkage is mirrored.
        placed.coupler_point.y *= linkage.placement.handedness();
        Cognates::from_four_bar(placed)?;
        let (Some([o, a, b, c]), lambda) = (FourBar::pins(linkage), placed.coupler_point / placed.lengths.coupler)
        else {
            return Err(CognateError::NotFourBar);
        };
        let rest = Vector::new(1.0, 0.0) - lambda;
        isolate_from_grid(&mut drawn, joint);
        let mut add = |name: &str, step| {
            drawn.joints.push(super::Joint { name: name.to_owned(), kind: step });
            drawn.joints.len() - 1
        };
        let rigid = |base, by: Vector| JointKind::Rigid { base, along: by.x, across: by.y };
        let q = add("Q", rigid([o, c], lambda));
        let d = add("D", JointKind::Parallelogram { corners: [o, a, joint] });
        let e = add("E", rigid([d, joint], lambda));
        let f = add("F", JointKind::Parallelogram { corners: [c, b, joint] });
        let g = add("G", rigid([f, joint], rest));
        let on_frame = drawn.links.iter_mut().find_map(|link| {
            let (from, to) = (link.position(o)?, link.position(c)?);
            Some((from + complex_product(lambda, to - from), link))
        });
        if let Some((place, link)) = on_frame {
            link.joints.push((q, place));
        }
        let FourBar { crank, rocker, coupler, .. } = placed.lengths;
        let (near, far) = (placed.coupler_point.norm(), (rest * coupler).norm());
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
    fn from_original(four_bar: PlacedFourBar) -> Cognate {
        let one = Vector::new(1.0, 0.0);
        Cognate {
            four_bar,
            counterparts: [MovingLink::Crank, MovingLink::Coupler, MovingLink::Rocker],
            arm_factors: [one, one],
        }
    }

    /// Driven by the shortest link, if that is on a pivot, or, of a kite, by the one that never rests; else by the one that turns as the original's crank; else by that
    /// on the original's pivot.
    fn with_best_crank(self) -> Cognate {
        let FourBar { crank, coupler, rocker, frame } = self.four_bar.lengths;
        let tolerance = length_tolerance(crank + coupler + rocker + frame);
        let least = frame.min(coupler) + tolerance;
        // A link as long as the frame rests while the other two, of one length, turn about its pin.
        let rests = |link: f64, other: f64| (link - frame).abs() <= tolerance && (other - coupler).abs() <= tolerance;
        let is_better = if rests(crank, rocker) != rests(rocker, crank) {
            rests(crank, rocker)
        } else if (rocker - crank).abs() > tolerance && rocker.min(crank) <= least {
            rocker < crank
        } else {
            self.counterparts[2] == MovingLink::Crank
        };
        if !is_better {
            return self;
        }
        let ([first, coupler, last], [crank_arm, rocker_arm]) = (self.counterparts, self.arm_factors);
        Cognate {
            four_bar: self.four_bar.reversed(),
            counterparts: [last, coupler, first],
            arm_factors: [rocker_arm, crank_arm],
        }
    }

    /// Its crank pin and its rocker pin in a pose of the original, whose crank pivot, crank pin, rocker pin and rocker pivot
    /// are given.
    pub fn pins(&self, [o, a, b, c]: [Point; 4]) -> [Point; 2] {
        let arm = |bar| match bar {
            MovingLink::Crank => a - o,
            MovingLink::Coupler => b - a,
            MovingLink::Rocker => b - c,
        };
        let [first, second] = self.four_bar.pivots;
        let [crank, _, rocker] = self.counterparts;
        [
            first + complex_product(self.arm_factors[0], arm(crank)),
            second + complex_product(self.arm_factors[1], arm(rocker)),
        ]
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
    pub fn to_linkage(
        &self,
        poses: impl IntoIterator<Item = [Point; 4]>,
        travel: &MotionOptions,
    ) -> Result<Linkage, Error> {
        let starts = poses.into_iter().map(|pose| self.input_at_pose(pose)).filter(|start| start.2.is_finite());
        let best = starts.reduce(|best, start| if start.2 > best.2 { start } else { best });
        let is_parted =
            travel.continuation == Continuation::Branch && self.four_bar.lengths.class() == FourBarClass::ChangePoint;
        let circuits = if is_parted { CircuitSelection::All } else { travel.circuits };
        let (start, side) = match best {
            Some((start, side, _)) if circuits == CircuitSelection::Start => (Some(start), side),
            _ => (None, Side::Left),
        };
        self.four_bar.to_linkage(side, MotionOptions { start, circuits, ..MotionOptions::default() })
    }

    /// Its input, in degrees from -180 to 180, and the side of its rocker pin in a pose of the original, as for
    /// [`Cognate::pins`]; and how far from flat its dyad is there: the sine of the transmission angle.
    pub fn input_at_pose(&self, pose: [Point; 4]) -> (f64, Side, f64) {
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
fn isolate_from_grid(linkage: &mut Linkage, joint: JointId) {
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
fn positions_on_link(
    linkage: &Linkage,
    base: [JointId; 2],
    joint: JointId,
) -> (Option<Vector>, Option<Vector>, Option<Vector>) {
    let has = |link: &&Link| base.iter().all(|&pin| link.position(pin).is_some());
    let link = linkage.links.iter().find(has);
    let place = |joint| link.and_then(|link| link.position(joint));
    (place(base[0]), place(base[1]), place(joint))
}
