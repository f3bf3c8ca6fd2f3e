//! How the joints of a template are placed.

use super::{InputValue, SideTemplate};
use crate::expression::CompiledExpression;

/// How a joint is placed; other joints are given by their indices in [`super::Template::joints`].
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
        /// The turns of this crank and of the first, both whole.
        ratio: [CompiledExpression; 2],
        /// Its angle when the first crank's is 0.
        phase: InputValue,
    },
    /// On a rack that a pinion on the crank moves along a line.
    Rack {
        /// The pin of the crank.
        crank: usize,
        /// Two joints that the line is parallel to.
        line: [usize; 2],
        /// The distance of the line to the left of them.
        offset: CompiledExpression,
        /// The pitch radius of the pinion; negative where the rack moves against the line.
        radius: CompiledExpression,
        /// The distance from the first joint of the line where the crank's angle is 0.
        start: CompiledExpression,
    },
    /// On a crank driven by a linear actuator, whose length is the input.
    Piston {
        /// The actuator's pivot, and the crank's.
        base: [usize; 2],
        /// The crank's length.
        length: CompiledExpression,
        /// The distance of the actuator's line from its pivot.
        offset: CompiledExpression,
        /// The side of the base at the start.
        side: SideTemplate,
    },
    /// On a slider that is driven along a line, and whose distance from the first of its joints is the input.
    DrivenSlider {
        /// Two joints that the line is parallel to.
        line: [usize; 2],
        /// The distance of the line to the left of them.
        offset: CompiledExpression,
    },
    /// At the common pin of two links.
    Dyad {
        /// The joints the links are connected to.
        base: [usize; 2],
        /// Their lengths.
        lengths: [CompiledExpression; 2],
        /// The side of the base at the start.
        side: SideTemplate,
    },
    /// At the end of a link that slides on a line.
    Slide {
        /// The joint at the link's other end.
        from: usize,
        /// The link's length.
        length: CompiledExpression,
        /// Two joints that the line is parallel to.
        line: [usize; 2],
        /// The distance of the line to the left of them.
        offset: CompiledExpression,
        /// [`Side::Left`](super::Side::Left) is ahead of `from` along the line, [`Side::Right`](super::Side::Right) behind it.
        side: SideTemplate,
    },
    /// At the point where the slot of a yoke, in which a joint slides, meets the yoke's guide.
    Yoke {
        /// The joint that slides in the slot.
        from: usize,
        /// Two joints that the guide is parallel to.
        line: [usize; 2],
        /// The distance of the guide to the left of them.
        offset: CompiledExpression,
        /// The angle from the guide to the slot.
        angle: InputValue,
    },
    /// At the foot of a line that slides through a joint.
    Slot {
        /// The pivot, and the joint that the line slides through.
        base: [usize; 2],
        /// The line's distance from the pivot.
        offset: CompiledExpression,
        /// The side of the base at the start.
        side: SideTemplate,
    },
    /// In a group, whose joints are placed together by the closures of [`super::Template::closures`].
    Grouped {
        /// Its coordinates at the start, in the frame of the fixed joints.
        at: [CompiledExpression; 2],
    },
    /// At the fourth corner of a parallelogram.
    Parallelogram {
        /// The other corners, in order around it.
        corners: [usize; 3],
    },
    /// On a link, by coordinates; ranges make a grid of points, in which `across` changes fastest.
    Point {
        /// Two joints of the link.
        base: [usize; 2],
        /// The distance from the first joint towards the second.
        along: Coordinate,
        /// The distance to the left of that line.
        across: Coordinate,
    },
    /// On a link, by distances from two of its joints.
    Distances {
        /// Two joints of the link.
        base: [usize; 2],
        /// The distances from them.
        distances: [CompiledExpression; 2],
        /// The side of the line from the first joint to the second.
        side: SideTemplate,
    },
}

impl JointKindTemplate {
    /// The number of joints built from it: several of a grid of points.
    pub fn point_count(&self) -> usize {
        match self {
            JointKindTemplate::Point { along, across, .. } => along.count() * across.count(),
            _ => 1,
        }
    }

    /// The joints it refers to.
    pub fn referenced_joints(&self) -> Vec<usize> {
        match self {
            JointKindTemplate::Fixed(_) | JointKindTemplate::Grouped { .. } => Vec::new(),
            JointKindTemplate::Crank { pivot, .. } => vec![*pivot],
            JointKindTemplate::Gear { crank, pivot, .. } => vec![*crank, *pivot],
            JointKindTemplate::Parallelogram { corners } => corners.to_vec(),
            JointKindTemplate::Slide { from, line, .. }
            | JointKindTemplate::Yoke { from, line, .. }
            | JointKindTemplate::Rack { crank: from, line, .. } => vec![*from, line[0], line[1]],
            JointKindTemplate::Dyad { base, .. }
            | JointKindTemplate::DrivenSlider { line: base, .. }
            | JointKindTemplate::Piston { base, .. }
            | JointKindTemplate::Slot { base, .. }
            | JointKindTemplate::Point { base, .. }
            | JointKindTemplate::Distances { base, .. } => base.to_vec(),
        }
    }

    /// Replaces the indices of joints.
    #[must_use]
    pub fn map_joints(mut self, new_index: impl Fn(usize) -> usize) -> JointKindTemplate {
        match &mut self {
            JointKindTemplate::Fixed(_) | JointKindTemplate::Grouped { .. } => {}
            JointKindTemplate::Crank { pivot, .. } => *pivot = new_index(*pivot),
            JointKindTemplate::Gear { crank, pivot, .. } => (*crank, *pivot) = (new_index(*crank), new_index(*pivot)),
            JointKindTemplate::Parallelogram { corners } => *corners = corners.map(new_index),
            JointKindTemplate::Slide { from, line, .. }
            | JointKindTemplate::Yoke { from, line, .. }
            | JointKindTemplate::Rack { crank: from, line, .. } => {
                (*from, *line) = (new_index(*from), line.map(new_index));
            }
            JointKindTemplate::Dyad { base, .. }
            | JointKindTemplate::DrivenSlider { line: base, .. }
            | JointKindTemplate::Piston { base, .. }
            | JointKindTemplate::Slot { base, .. }
            | JointKindTemplate::Point { base, .. }
            | JointKindTemplate::Distances { base, .. } => *base = base.map(new_index),
        }
        self
    }
}

/// A coordinate on a link.
#[derive(Clone, Debug)]
pub enum Coordinate {
    /// A single value.
    Single(CompiledExpression),
    /// Evenly spaced values, including both ends.
    Range {
        /// The first value.
        from: CompiledExpression,
        /// The last value.
        to: CompiledExpression,
        /// The number of values, at least one.
        count: usize,
    },
}

impl Coordinate {
    /// The number of its values.
    pub fn count(&self) -> usize {
        match self {
            Coordinate::Single(_) => 1,
            Coordinate::Range { count, .. } => *count,
        }
    }

    /// Its value, or the first and the last.
    pub(super) fn ends(&self) -> impl Iterator<Item = &CompiledExpression> {
        let (first, last) = match self {
            Coordinate::Single(value) => (value, None),
            Coordinate::Range { from, to, .. } => (from, Some(to)),
        };
        std::iter::once(first).chain(last)
    }

    /// Its values, with expressions evaluated by `number`.
    pub fn values(&self, number: impl Fn(&CompiledExpression) -> f64) -> Vec<f64> {
        match self {
            Coordinate::Single(value) => vec![number(value)],
            Coordinate::Range { from, to, count } => {
                let (from, to) = (number(from), number(to));
                let fraction = |i: usize| if *count == 1 { 0.0 } else { i as f64 / (*count - 1) as f64 };
                (0..*count).map(|i| from + (to - from) * fraction(i)).collect()
            }
        }
    }
}
