//! The lengths that a linkage is built from: each is cut or bored once, and can be off by itself.

use super::{ClosureTemplate, Coordinate, Error, JointKindTemplate, Template};
use crate::expression::{CompiledExpression, displayed_name, join_names};
use crate::linkage::Linkage;
use crate::motion::NeighbourLinkages;

/// A length of a linkage. Two links of one parameter have a length each.
#[derive(Clone, Copy, Debug)]
pub struct LinkLength<'t> {
    /// The joint it places, by its index in [`Template::joints`].
    joint: usize,
    /// What it is from there.
    kind: LengthKind,
    expression: &'t CompiledExpression,
}

#[derive(Clone, Copy, Debug)]
enum LengthKind {
    /// The distance from another joint.
    From(usize),
    /// A coordinate, or an offset.
    Of(&'static str),
    /// A coordinate along, or across, the line of two joints of a link that the joint closes.
    On([usize; 2], &'static str),
}

impl Template {
    /// Why a linkage has no [`Template::lengths`].
    pub const NO_LENGTHS: &'static str = "its points are on a grid, so that no length is off by itself";

    /// The lengths of its links, and the coordinates of its fixed pivots from the first one. `None` of a linkage that
    /// has a grid of points.
    pub fn lengths(&self) -> Option<Vec<LinkLength<'_>>> {
        let structure = self.structure().ok()?;
        let is_helper = |name: &str| structure.find_joint(name).is_some_and(|joint| structure.is_helper(joint));
        let mut lengths = Vec::new();
        let mut pivots = 0;
        for (joint, placed) in self.joints.iter().enumerate() {
            let mut add = |kind, expression| lengths.push(LinkLength { joint, kind, expression });
            let from = LengthKind::From;
            let of = LengthKind::Of;
            match &placed.kind {
                JointKindTemplate::Fixed([x, y]) if !is_helper(&placed.name) => {
                    pivots += 1;
                    if pivots > 1 {
                        add(of("x"), x);
                        add(of("y"), y);
                    }
                }
                JointKindTemplate::Crank { pivot, length } | JointKindTemplate::Gear { pivot, length, .. } => {
                    add(from(*pivot), length);
                }
                JointKindTemplate::Piston { base: [_, pivot], length, offset, .. } => {
                    add(from(*pivot), length);
                    add(of("offset"), offset);
                }
                JointKindTemplate::Slide { from: other, length, offset, .. } => {
                    add(from(*other), length);
                    add(of("offset"), offset);
                }
                JointKindTemplate::Slot { base: [pivot, _], offset, .. } => add(from(*pivot), offset),
                JointKindTemplate::Yoke { offset, .. } | JointKindTemplate::DrivenSlider { offset, .. } => {
                    add(of("offset"), offset)
                }
                JointKindTemplate::Rack { offset, radius, .. } => {
                    add(of("offset"), offset);
                    add(of("pitch radius"), radius);
                }
                JointKindTemplate::Dyad { base, lengths, .. }
                | JointKindTemplate::Distances { base, distances: lengths, .. } => {
                    base.iter().zip(lengths).for_each(|(other, length)| add(from(*other), length));
                }
                JointKindTemplate::Point { along, across, .. } => {
                    let (Coordinate::Single(along), Coordinate::Single(across)) = (along, across) else { return None };
                    add(of("along"), along);
                    add(of("across"), across);
                }
                // A joint of a group is at its place at the start; its lengths are those of the closures.
                JointKindTemplate::Fixed(_)
                | JointKindTemplate::Parallelogram { .. }
                | JointKindTemplate::Grouped { .. } => {}
            }
        }
        for closure in &self.closures {
            let mut add =
                |joint: &usize, kind, expression| lengths.push(LinkLength { joint: *joint, kind, expression });
            match closure {
                ClosureTemplate::Bar { joints: [from, joint], length } => add(joint, LengthKind::From(*from), length),
                ClosureTemplate::Hold { joint, base, place: [along, across] } => {
                    add(joint, LengthKind::On(*base, "along"), along);
                    add(joint, LengthKind::On(*base, "across"), across);
                }
                ClosureTemplate::Guide { joint, offset, .. } => add(joint, LengthKind::Of("offset"), offset),
                ClosureTemplate::Drive { .. } | ClosureTemplate::Start { .. } => {}
            }
        }
        Some(lengths)
    }

    /// The name of one of its lengths: "AB", "M along", "D across AB" of a joint that links hold.
    pub fn length_name(&self, length: &LinkLength) -> String {
        let name = self.joints[length.joint].name.as_str();
        match length.kind {
            LengthKind::From(other) => join_names(&[&self.joints[other].name, name]),
            LengthKind::Of(what) => format!("{} {what}", displayed_name(name)),
            LengthKind::On(base, what) => {
                let [from, to] = base.map(|joint| self.joints[joint].name.as_str());
                format!("{} {what} {}", displayed_name(name), join_names(&[from, to]))
            }
        }
    }

    /// The linkages of a parameter set with an error in one length each: a part of the greatest length, as [`NeighbourLinkages::STEP`]. `None` as
    /// [`Template::lengths`], and if one of them cannot be built.
    pub fn neighbours(&self, values: &[f64], part: f64) -> Option<NeighbourLinkages> {
        let lengths = self.lengths()?;
        let own = |length: &LinkLength| length.expression.evaluate(|slot| values[slot]).abs();
        let step = part * lengths.iter().map(own).fold(0.0, f64::max);
        let off = |length: &LinkLength, error: f64| self.linkage_with_errors(values, &[(*length, error)]).ok();
        let pairs =
            lengths.iter().map(|length| Some([off(length, -step)?, off(length, step)?])).collect::<Option<_>>()?;
        let names = lengths.iter().map(|length| self.length_name(length)).collect();
        (step > 0.0).then_some(NeighbourLinkages { pairs, step, names })
    }

    /// The linkage of a parameter set with an error in some of its lengths.
    ///
    /// # Errors
    /// As of [`Template::linkage`].
    pub fn linkage_with_errors(&self, values: &[f64], errors: &[(LinkLength, f64)]) -> Result<Linkage, Error> {
        self.build_with(values, |_, expression| {
            let own = errors.iter().filter(|(length, _)| std::ptr::eq(length.expression, expression));
            expression.evaluate(|slot| values[slot]) + own.map(|(_, error)| error).sum::<f64>()
        })
    }
}
