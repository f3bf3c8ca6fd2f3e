//! A linkage in numbers: joints, the steps that place them, the input and the traced points.
//!
//! A planar linkage of one degree of freedom is a list of [`Joint`]s, each placed by a [`JointKind`] from joints before
//! it. The joints that keep their distances form a [`Link`]. How a linkage is to travel (from where, how far, which
//! circuits) is its [`MotionOptions`].

mod assembly_mode;
mod builder;
mod cognate;
mod error;
mod four_bar;
mod outline;
mod position_analysis;
mod sextic;
mod symmetrical_four_bar;

pub use assembly_mode::{AssemblyMode, DyadSet};
pub use builder::LinkageBuilder;
pub use cognate::{Cognate, CognateError, Cognates, MovingLink, PlacedFourBar};
pub use error::Error;
pub(crate) use four_bar::length_tolerance;
pub use four_bar::{FourBar, FourBarClass};
pub use outline::{LinkOutline, is_plate};
pub use position_analysis::InvertedSliderCrank;
pub use sextic::{DoublePoint, DoublePointKind, Sextic};
pub use symmetrical_four_bar::SymmetricalFourBar;

pub use crate::geometry::Orientation;
use crate::geometry::{Point, Vector};

/// The most two-valued joints a linkage may have: [`AssemblyMode`] has a bit for each.
pub const MAX_DYADS: usize = 16;

/// A joint's place in [`Linkage::joints`].
pub type JointId = usize;

/// A linkage in numbers. Lengths are in the manifest's own unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// The joints in the order they are placed: each step refers to earlier joints only.
    pub joints: Vec<Joint>,
    /// The rigid bodies; the first is the one that the fixed joints are on.
    pub links: Vec<Link>,
    /// The joints whose curves are wanted, in the order of the manifest.
    pub traced: Vec<JointId>,
    /// The link whose frame everything is reported in, by its origin and a joint on its x-axis.
    pub seen_from: Option<[JointId; 2]>,
    /// Where the plane it is reported in is laid, after that.
    pub placement: Orientation,
    /// How it is to travel.
    pub motion_options: MotionOptions,
}

/// A named point of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name; points of a grid share one.
    pub name: String,
    /// How it is placed.
    pub kind: JointKind,
}

/// How a joint is placed from joints before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// At a fixed place.
    Fixed(Point),
    /// On a crank that turns about `pivot`; its angle is the linkage's input.
    Crank {
        /// The crank's pivot.
        pivot: JointId,
        /// Its length, positive.
        length: f64,
    },
    /// On a second crank, geared to the first: it turns `ratio[0]` times while that turns `ratio[1]` times.
    Gear {
        /// The crank's pivot.
        pivot: JointId,
        /// Its length, positive.
        length: f64,
        /// Turns of this crank to turns of the first, in lowest terms, the second positive.
        ratio: [i64; 2],
        /// Its angle, in degrees, where the first crank's is 0.
        phase_deg: f64,
    },
    /// On a crank that a linear actuator drives; the actuator's length s is the linkage's input (McCarthy 2.43).
    Piston {
        /// The actuator's pivot, and the crank's.
        base: [JointId; 2],
        /// The crank's length, positive.
        length: f64,
        /// The actuator's line is this far from its pivot.
        offset: f64,
        /// Its place among the two-valued joints: its bit in [`AssemblyMode`].
        index: usize,
    },
    /// At the third corner of a triangle of two links on two joints (the RRR dyad).
    Dyad {
        /// The joints the links hang on.
        base: [JointId; 2],
        /// Their lengths, positive.
        lengths: [f64; 2],
        /// Its place among the two-valued joints, counted from 0: its bit in [`AssemblyMode`].
        index: usize,
    },
    /// At the end of a link whose other end slides on a line: on the line itself (the RRP dyad).
    Slide {
        /// The joint the link hangs on.
        from: JointId,
        /// The link's length, positive.
        length: f64,
        /// Two joints that the line goes through, or runs beside.
        line: [JointId; 2],
        /// How far the line runs to the left of the two.
        offset: f64,
        /// Its place among the two-valued joints: its bit in [`AssemblyMode`], 1 ahead of the link's hanging joint.
        index: usize,
    },
    /// At the foot of the line that slides through a joint (the RPR dyad, McCarthy's inverted slider-crank): square
    /// to the line from `base[1]`, at a distance `offset` from `base[0]`. Without offset the foot is the pivot, and the side
    /// says which way the line points: to the right of it from the pivot towards the joint.
    Slot {
        /// The pivot of the link that carries the line, and the joint it slides through.
        base: [JointId; 2],
        /// The line's distance from the pivot; negative on the other side.
        offset: f64,
        /// Its place among the two-valued joints: its bit in [`AssemblyMode`].
        index: usize,
    },
    /// On the guide of a yoke that slides along a line, its slot through a joint at an angle to the guide (the RPP
    /// dyad): where the slot's line meets the guide.
    Yoke {
        /// The joint that slides in the slot.
        from: JointId,
        /// Two joints that the guide goes through, or runs beside.
        line: [JointId; 2],
        /// How far the guide runs to the left of the two.
        offset: f64,
        /// The slot's direction in the guide's frame, a unit vector with y other than 0.
        slot_direction: Vector,
    },
    /// On a body that keeps the direction of a line: so far along it and to the left of it from a joint.
    Aligned {
        /// The joint of the body it is measured from.
        from: JointId,
        /// A joint on the line, or beside it, and one that the line goes through.
        line: [JointId; 2],
        /// How far the line runs to the left of the first of them; no further than they are apart.
        offset: f64,
        /// What says how far along the line the second of them is.
        direction: LineDirection,
        /// Along the line.
        along: f64,
        /// To the left of the line.
        across: f64,
    },
    /// At the fourth corner of a parallelogram: `corners[0] + corners[2] - corners[1]`.
    Parallelogram {
        /// The other corners, in order round it; the last two are on one link.
        corners: [JointId; 3],
    },
    /// On a link: `base[0] + along (base[1] - base[0]) + across n`, with `n` that vector turned to the left.
    Rigid {
        /// Two joints of the link.
        base: [JointId; 2],
        /// Along the line of the two, in parts of their distance.
        along: f64,
        /// To the left of that line, in parts of their distance.
        across: f64,
    },
}

/// How a line through a joint, beside another, is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineDirection {
    /// It points from the one to the other.
    Towards,
    /// It does so on the right side of a two-valued joint, a slot without offset, and away on the left.
    BySide(usize),
    /// The one is as far along it from the other as the input says: an actuator's.
    Actuator,
}

impl JointKind {
    /// The place of a two-valued joint among them; `None` for a joint with one place.
    pub fn dyad_index(&self) -> Option<usize> {
        match *self {
            JointKind::Dyad { index, .. }
            | JointKind::Slide { index, .. }
            | JointKind::Slot { index, .. }
            | JointKind::Piston { index, .. } => Some(index),
            JointKind::Fixed(_)
            | JointKind::Crank { .. }
            | JointKind::Gear { .. }
            | JointKind::Yoke { .. }
            | JointKind::Parallelogram { .. }
            | JointKind::Aligned { .. }
            | JointKind::Rigid { .. } => None,
        }
    }
}

/// A rigid body: joints that keep their distances.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Its joints, each with its place in the link's own frame.
    pub joints: Vec<(JointId, Vector)>,
}

impl Link {
    /// Where a joint is in the link's own frame.
    pub fn position(&self, joint: JointId) -> Option<Vector> {
        self.joints.iter().find(|(j, _)| *j == joint).map(|&(_, place)| place)
    }
}

/// The side of a line: left of A -> B is the side of the positive normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side of the positive normal, +1.
    Left,
    /// The other, -1.
    Right,
}

/// How a linkage is to travel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionOptions {
    /// The sides of the dyads at the start.
    pub mode: AssemblyMode,
    /// The input at the start, in degrees or as a length; by default the middle of the first assemblable range from 0 upward.
    pub start: Option<f64>,
    /// The input to stay within, from and to, in degrees or as lengths; by default all there is.
    pub range: Option<[f64; 2]>,
    /// Which circuits are wanted.
    pub circuits: CircuitSelection,
    /// What happens at a change point.
    pub continuation: Continuation,
    /// Which dyads change their sides where several lie flat at one input.
    pub coincident: CoincidentDyads,
    /// The part of the curve that a source's figure shows; the rest is drawn lighter.
    pub figure_arc: Option<BranchArc>,
}

/// Which circuits are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CircuitSelection {
    /// The one through the start pose.
    #[default]
    Start,
    /// Every one.
    All,
}

/// What happens at a change point, where a dyad lies flat and both branches meet without a limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Continuation {
    /// The joints move on smoothly, and so onto the other branch; a circuit may then take two turns.
    #[default]
    Smooth,
    /// The branch is kept, and the joints turn a corner.
    Branch,
}

/// Which dyads change their sides where several come to lie flat at one input, and could change them one without the
/// others. A dyad whose base vanishes there changes its side in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoincidentDyads {
    /// All of them.
    #[default]
    Together,
    /// The one that is placed first.
    First,
    /// The one that is placed last.
    Last,
}

/// Part of one branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchArc {
    /// From and to, in degrees of input.
    pub input_deg: [f64; 2],
    /// The side of the first dyad, 1 or -1.
    pub branch: i8,
}

/// What drives a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The angle of a crank, in degrees; after so many turns every joint is where it was.
    Angle {
        /// Turns to a period.
        turns: u32,
    },
    /// The length of a linear actuator.
    Length,
}

impl Input {
    /// How far the input goes until every joint is where it was, in degrees. A length never comes round: its period is
    /// beyond all lengths.
    pub fn period(self) -> f64 {
        match self {
            Input::Angle { turns } => 360.0 * f64::from(turns),
            Input::Length => f64::MAX / 8.0,
        }
    }
}

impl Linkage {
    /// What drives it.
    pub fn input(&self) -> Input {
        let mut turns = 1;
        for joint in &self.joints {
            match joint.kind {
                JointKind::Piston { .. } => return Input::Length,
                JointKind::Gear { ratio: [_, of], .. } => {
                    // Several gears come round together after the least common multiple.
                    let of = of.unsigned_abs() as u32;
                    turns = turns / gcd(turns, of) * of;
                }
                _ => {}
            }
        }
        Input::Angle { turns }
    }

    /// The linkage without the points at its end that nothing stands on, but for a joint, and that joint's place in it: what
    /// is asked of one point of a grid need not place the others. The joints before those points keep their places.
    pub fn with_one_point(&self, joint: JointId) -> (Linkage, JointId) {
        let mut first = self.joints.len();
        let mut base_of_all = self.seen_from.map_or(0, |[origin, end]| origin.max(end));
        while let Some(JointKind::Rigid { base: [p, q], .. }) = first.checked_sub(1).map(|last| self.joints[last].kind)
        {
            base_of_all = base_of_all.max(p).max(q);
            if base_of_all >= first - 1 {
                break;
            }
            first -= 1;
        }
        let kept: Vec<JointId> = (0..first).chain((joint >= first).then_some(joint)).collect();
        let place = |old: JointId| kept.iter().position(|&kept| kept == old);
        let link = |link: &Link| Link {
            joints: link.joints.iter().filter_map(|&(joint, at)| Some((place(joint)?, at))).collect(),
        };
        let linkage = Linkage {
            joints: kept.iter().map(|&joint| self.joints[joint].clone()).collect(),
            links: self.links.iter().map(link).collect(),
            traced: place(joint).into_iter().collect(),
            seen_from: self.seen_from,
            placement: self.placement,
            motion_options: self.motion_options.clone(),
        };
        (linkage, joint.min(first))
    }

    /// How many two-valued joints there are.
    pub fn dyad_count(&self) -> usize {
        self.joints.iter().filter(|joint| joint.kind.dyad_index().is_some()).count()
    }

    /// The link that is at rest for the observer: the one seen from, or the one the fixed joints are on.
    pub fn ground(&self) -> &Link {
        let seen =
            |link: &&Link| self.seen_from.is_some_and(|joints| joints.iter().all(|&j| link.position(j).is_some()));
        self.links.iter().find(seen).unwrap_or(&self.links[0])
    }
}

/// The greatest common divisor of two numbers that are not zero.
fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
