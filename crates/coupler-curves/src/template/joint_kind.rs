use super::{InputValue, Side};
use crate::expression::CompiledExpression;

/// How a joint is placed; joints are named by their place in [`super::Template::joints`].
#[derive(Clone, Debug)]
pub enum JointKindTemplate {
    /// At fixed coordinates.
    Fixed([CompiledExpression; 2]),
    /// On a crank.
    Crank {
        /// The pivot.
        pivot: usize,
        /// The length.
        length: CompiledExpression,
    },
    /// On a second crank, geared to the first.
    Gear {
        /// The pin of the first crank.
        crank: usize,
        /// The pivot.
        pivot: usize,
        /// The length.
        length: CompiledExpression,
        /// Its turns to those of the first: whole numbers.
        ratio: [CompiledExpression; 2],
        /// Its angle where the first crank's is 0.
        phase: InputValue,
    },
    /// On a crank driven by a linear actuator, which is the input.
    Piston {
        /// The actuator's pivot, and the crank's.
        base: [usize; 2],
        /// The crank's length.
        length: CompiledExpression,
        /// The distance of the actuator's line from its pivot.
        offset: CompiledExpression,
        /// The side of the base at the start.
        side: Side,
    },
    /// By two links.
    Dyad {
        /// The joints they hang on.
        base: [usize; 2],
        /// Their lengths.
        lengths: [CompiledExpression; 2],
        /// The side of the base at the start.
        side: Side,
    },
    /// By a link that slides on a line.
    Slide {
        /// The joint the link hangs on.
        from: usize,
        /// The link's length.
        length: CompiledExpression,
        /// Two joints the line goes through, or beside.
        line: [usize; 2],
        /// How far the line runs to the left of them.
        offset: CompiledExpression,
        /// Left is ahead along the line, right is behind.
        side: Side,
    },
    /// On the guide of a yoke, where the slot that a joint slides in meets it.
    Yoke {
        /// The joint that slides in the slot.
        from: usize,
        /// Two joints the guide goes through, or beside.
        line: [usize; 2],
        /// How far the guide runs to the left of them.
        offset: CompiledExpression,
        /// From the guide to the slot.
        angle: InputValue,
    },
    /// At the foot of a line that slides through a joint.
    Slot {
        /// The pivot, and the joint the line slides through.
        base: [usize; 2],
        /// The line's distance from the pivot.
        offset: CompiledExpression,
        /// The side of the base at the start.
        side: Side,
    },
    /// At the fourth corner of a parallelogram.
    Parallelogram {
        /// The other corners, in order round it.
        corners: [usize; 3],
    },
    /// On a link, by coordinates; ranges make a grid of points, `across` fastest.
    Point {
        /// Two joints of the link.
        base: [usize; 2],
        /// From the first joint towards the second.
        along: Coordinate,
        /// To the left.
        across: Coordinate,
    },
    /// On a link, by distances.
    Distances {
        /// Two joints of the link.
        base: [usize; 2],
        /// The distances from them.
        distances: [CompiledExpression; 2],
        /// The side of the first to the second.
        side: Side,
    },
}

impl JointKindTemplate {
    /// The joints it refers to.
    pub fn referenced_joints(&self) -> Vec<usize> {
        match self {
            JointKindTemplate::Fixed(_) => Vec::new(),
            JointKindTemplate::Crank { pivot, .. } => vec![*pivot],
            JointKindTemplate::Gear { crank, pivot, .. } => vec![*crank, *pivot],
            JointKindTemplate::Parallelogram { corners } => corners.to_vec(),
            JointKindTemplate::Slide { from, line, .. } | JointKindTemplate::Yoke { from, line, .. } => {
                vec![*from, line[0], line[1]]
            }
            JointKindTemplate::Dyad { base, .. }
            | JointKindTemplate::Piston { base, .. }
            | JointKindTemplate::Slot { base, .. }
            | JointKindTemplate::Point { base, .. }
            | JointKindTemplate::Distances { base, .. } => base.to_vec(),
        }
    }

    /// The same with its joints renamed.
    #[must_use]
    pub fn map_joints(mut self, now: impl Fn(usize) -> usize) -> JointKindTemplate {
        match &mut self {
            JointKindTemplate::Fixed(_) => {}
            JointKindTemplate::Crank { pivot, .. } => *pivot = now(*pivot),
            JointKindTemplate::Gear { crank, pivot, .. } => (*crank, *pivot) = (now(*crank), now(*pivot)),
            JointKindTemplate::Parallelogram { corners } => *corners = corners.map(now),
            JointKindTemplate::Slide { from, line, .. } | JointKindTemplate::Yoke { from, line, .. } => {
                (*from, *line) = (now(*from), line.map(now));
            }
            JointKindTemplate::Dyad { base, .. }
            | JointKindTemplate::Piston { base, .. }
            | JointKindTemplate::Slot { base, .. }
            | JointKindTemplate::Point { base, .. }
            | JointKindTemplate::Distances { base, .. } => *base = base.map(now),
        }
        self
    }
}

/// A coordinate on a link.
#[derive(Clone, Debug)]
pub enum Coordinate {
    /// A single value.
    Single(CompiledExpression),
    /// Evenly spaced values, both ends among them.
    Range {
        /// The first.
        from: CompiledExpression,
        /// The last.
        to: CompiledExpression,
        /// How many, at least one.
        count: usize,
    },
}

impl Coordinate {
    /// How many values it has.
    pub fn count(&self) -> usize {
        match self {
            Coordinate::Single(_) => 1,
            Coordinate::Range { count, .. } => *count,
        }
    }

    /// Its values, each bound expression evaluated by `number`.
    pub fn values(&self, number: impl Fn(&CompiledExpression) -> f64) -> Vec<f64> {
        match self {
            Coordinate::Single(value) => vec![number(value)],
            Coordinate::Range { from, to, count } => {
                let (from, to) = (number(from), number(to));
                let step = |i: usize| if *count == 1 { 0.0 } else { i as f64 / (*count - 1) as f64 };
                (0..*count).map(|i| from + (to - from) * step(i)).collect()
            }
        }
    }
}
