//! Cognates: the three four-bars that trace the same coupler curve.

mod assembly;
mod error;
mod placed_four_bar;

pub use error::CognateError;
pub use placed_four_bar::PlacedFourBar;

use crate::geometry::{Point, Vector, complex_product, cross, trig};
use crate::linkage::{
    CircuitSelection, Continuation, Error, FourBar, FourBarClass, Linkage, MotionOptions, Side, length_tolerance,
};

/// A moving link of a four-bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovingLink {
    /// The link on the first pivot.
    Crank,
    /// The link between the pins.
    Coupler,
    /// The link on the second pivot.
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

/// A four-bar that traces the same coupler curve as another, the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cognate {
    /// The four-bar. If one of its links on a pivot is the shortest link, that one is the crank.
    pub four_bar: PlacedFourBar,
    /// The links of the original that its crank, coupler and rocker rotate with, each at a constant angle.
    pub counterparts: [MovingLink; 3],
    /// The vectors from the crank's pivot to the crank pin and from the rocker's pivot to the rocker pin, each
    /// divided, as a complex number, by that of its counterpart.
    arm_factors: [Vector; 2],
}

/// The two cognates of a four-bar and the pivot they share.
///
/// With A, B the pins, O and C their pivots, M the coupler point and, as complex numbers, lambda = (M - A) / (B - A),
/// the third pivot is Q = O + lambda (C - O): the triangle O C Q is similar to the coupler's, A B M. From
/// M = Q + (1 - lambda) (A - O) + lambda (B - C) follow two further loops:
///
/// - on O and Q: a link on O of lambda (B - A), a coupler of lambda (A - O), a link on Q of lambda (B - C);
/// - on C and Q: a link on C of (lambda - 1) (B - A), a coupler of (1 - lambda) (B - C), a link on Q of
///   (1 - lambda) (A - O).
///
/// So the links rotate with those of the original in pairs: the links on O and on C with its coupler, those on Q with
/// its crank and its rocker. Each coupler triangle is similar to A B M, and a cognate meets Grashof's condition if
/// the original does.
///
/// In a rhombus each link is at rest in one of its three motions, so no single link drives a cognate through the
/// whole curve.
///
/// # Source
/// S. Roberts, *On three-bar motion in plane space*, Proc. London Math. Soc. 7 (1875); Chebyshev 1878. Natesan 1994
/// does not mention cognates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cognates {
    /// The original four-bar.
    pub original: PlacedFourBar,
    /// The third pivot, Q.
    pub third_pivot: Point,
    /// The cognate on the crank's pivot and the third pivot, and that on the rocker's pivot and the third.
    pub others: [Cognate; 2],
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
        // In the first cognate the distance of point and crank pin is the original's crank length, at minus lambda's
        // angle.
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
}

impl Cognate {
    /// The original as a cognate of itself.
    fn from_original(four_bar: PlacedFourBar) -> Cognate {
        let one = Vector::new(1.0, 0.0);
        Cognate {
            four_bar,
            counterparts: [MovingLink::Crank, MovingLink::Coupler, MovingLink::Rocker],
            arm_factors: [one, one],
        }
    }

    /// The cognate with its crank and rocker exchanged where the other makes the better crank: the shortest link, if
    /// that is on a pivot; in a kite the link that is never at rest; else the one that rotates with the original's
    /// crank; else the one on the original's pivot.
    fn with_best_crank(self) -> Cognate {
        let FourBar { crank, coupler, rocker, frame } = self.four_bar.lengths;
        let tolerance = length_tolerance(crank + coupler + rocker + frame);
        let least = frame.min(coupler) + tolerance;
        // A link as long as the frame is at rest while the other two, of equal length, turn about its pin.
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

    /// Its crank pin and its rocker pin in a pose of the original, given by the original's crank pivot, crank pin,
    /// rocker pin and rocker pivot.
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

    /// The cognate as a linkage that traces the same curve as the original; `poses` are those of the original's first
    /// circuit, as in [`Cognate::pins`], and `options` the original's.
    ///
    /// The motion starts at the pose in which the cognate's dyad is furthest from flat. The circuits are selected as
    /// in the original; but where that keeps its branch at change points, which means something else for each
    /// cognate, all circuits are solved. The input range is always the whole one: a part of the original's range is
    /// not a single range of a cognate's input.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn to_linkage(
        &self,
        poses: impl IntoIterator<Item = [Point; 4]>,
        options: &MotionOptions,
    ) -> Result<Linkage, Error> {
        let starts = poses.into_iter().map(|pose| self.input_at_pose(pose)).filter(|start| start.2.is_finite());
        let best = starts.reduce(|best, start| if start.2 > best.2 { start } else { best });
        let keeps_branch =
            options.continuation == Continuation::Branch && self.four_bar.lengths.class() == FourBarClass::ChangePoint;
        let circuits = if keeps_branch { CircuitSelection::All } else { options.circuits };
        let (start, side) = match best {
            Some((start, side, _)) if circuits == CircuitSelection::Start => (Some(start), side),
            _ => (None, Side::Left),
        };
        self.four_bar.to_linkage(side, MotionOptions { start, circuits, ..MotionOptions::default() })
    }

    /// Its input, in degrees from -180 to 180, the side of its rocker pin, and the sine of its transmission angle, in
    /// a pose of the original as in [`Cognate::pins`].
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
