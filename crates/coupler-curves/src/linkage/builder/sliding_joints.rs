//! Sliding joints: sliders, yokes, slots and actuators, and the links they carry.

use super::sliding_body::{BodyReference, SlidingBody};
use super::{LinkageBuilder, check_length};
use crate::geometry::{Vector, trig};
use crate::linkage::{Error, JointId, JointKind, LineDirection, Link, LinkId, OutputLink, Side};

impl LinkageBuilder {
    /// Adds the pin of a crank about `base[1]`, driven by a linear actuator that turns about `base[0]`; the
    /// actuator's line is `offset` from that pivot, and `side` is the pin's side of `base[0] -> base[1]`.
    ///
    /// # Errors
    /// One joint given twice, a length that is not positive, pivots on no common link, more than
    /// [`MAX_DYADS`](crate::linkage::MAX_DYADS) dyads.
    pub fn piston(
        &mut self,
        name: &str,
        base: [JointId; 2],
        (length, offset): (f64, f64),
        side: Side,
    ) -> Result<JointId, Error> {
        self.check_distinct(name, base)?;
        check_length(name, length)?;
        self.require_common_link(name, base)?;
        let dyad = self.add_dyad(name, side)?;
        let id = self.add_joint(name, JointKind::Piston { base, length, offset, dyad });
        self.add_bar(base[1], id, length);
        // McCarthy's foot is to the right of the line from pivot to pin, so the pivot is to the left of his line.
        let direction = (-offset, LineDirection::Actuator);
        self.add_sliding_body([base[0], id], [base[0], id], direction);
        // The rod has the direction of the cylinder, from the other end.
        self.add_sliding_body([id, base[0]], [base[0], id], direction);
        self.sliding_bodies.last_mut().into_iter().for_each(|rod| rod.is_backward = true);
        Ok(id)
    }

    /// Adds a slider that is driven along the line `offset` to the left of two joints of one link; its distance from the first of them, along the line, is
    /// the input.
    ///
    /// # Errors
    /// One joint given twice for the line, joints that are on no common link.
    pub fn driven_slider(&mut self, name: &str, (line, offset): ([JointId; 2], f64)) -> Result<JointId, Error> {
        self.check_line(name, line)?;
        self.require_common_link(name, line)?;
        let id = self.add_joint(name, JointKind::DrivenSlider { line, offset });
        self.add_slider(id, line);
        Ok(id)
    }

    /// Adds a rack that a pinion on the crank, of a pitch `radius`, moves along the line `offset` to the left of two joints of one link; where
    /// the crank's angle is 0 it is at the distance `start` from the first of them. Of a negative radius it moves against the line.
    ///
    /// # Errors
    /// One joint given twice for the line, joints that are on no common link, a radius of 0.
    pub fn rack(
        &mut self,
        name: &str,
        (line, offset): ([JointId; 2], f64),
        (radius, start): (f64, f64),
    ) -> Result<JointId, Error> {
        self.check_line(name, line)?;
        self.require_common_link(name, line)?;
        if radius == 0.0 {
            return Err(Error::NoPitchRadius { joint: name.to_owned() });
        }
        let id = self.add_joint(name, JointKind::Rack { line, offset, radius, start });
        self.add_slider(id, line);
        Ok(id)
    }

    /// Adds the end of a link from the joint `from`, which slides on the line `offset` to the left of two others;
    /// `ahead` is [`Side::Left`] where it is ahead of `from` along the line, and [`Side::Right`] where it is behind.
    ///
    /// # Errors
    /// One joint given twice for the line, a length that is not positive, more than
    /// [`MAX_DYADS`](crate::linkage::MAX_DYADS) dyads.
    pub fn slide(
        &mut self,
        name: &str,
        (from, length): (JointId, f64),
        (line, offset): ([JointId; 2], f64),
        ahead: Side,
    ) -> Result<JointId, Error> {
        self.check_line(name, line)?;
        check_length(name, length)?;
        self.check_slides(name, from, &line)?;
        let dyad = self.add_dyad(name, ahead)?;
        let id = self.add_joint(name, JointKind::Slide { from, length, line, offset, dyad });
        self.add_bar(from, id, length);
        self.add_slider(id, line);
        Ok(id)
    }

    /// Adds the point at which the slot of a yoke meets its guide, the line `offset` to the left of two joints.
    ///
    /// The yoke slides along the guide, and `from` slides in its slot, which is at `angle_deg` to the guide.
    ///
    /// # Errors
    /// One joint given twice for the guide, a slot along the guide.
    pub fn yoke(
        &mut self,
        name: &str,
        from: JointId,
        (line, offset): ([JointId; 2], f64),
        angle_deg: f64,
    ) -> Result<JointId, Error> {
        self.check_line(name, line)?;
        self.check_slides(name, from, &line)?;
        let (cos, sin) = trig::cos_sin_deg(angle_deg);
        if sin == 0.0 {
            return Err(Error::SlotParallelToGuide { joint: name.to_owned() });
        }
        let id = self.add_joint(name, JointKind::Yoke { from, line, offset, slot_direction: Vector::new(cos, sin) });
        self.add_slider(id, line);
        Ok(id)
    }

    /// Adds the block of a slider or a yoke, which its joint and either joint of its line identify.
    pub(super) fn add_slider(&mut self, joint: JointId, line: [JointId; 2]) {
        self.add_sliding_body([joint, line[1]], line, (0.0, LineDirection::Towards));
        let block = self.sliding_bodies[self.sliding_bodies.len() - 1];
        self.sliding_bodies.push(SlidingBody { base: [joint, line[0]], is_backward: true, ..block });
    }

    /// Adds the foot, at a distance `offset` from the pivot `base[0]`, of the line that slides through `base[1]`; on
    /// a side of `base[0] -> base[1]`. The pivot and the foot are on one link.
    ///
    /// With no offset the foot is the pivot, and the side gives the direction of the line. Points of the link that
    /// carries the line are added by [`LinkageBuilder::point`] on the same two joints: along the line, in its
    /// direction at the start, and to its left.
    ///
    /// # Errors
    /// One joint given twice, more than [`MAX_DYADS`](crate::linkage::MAX_DYADS) dyads.
    pub fn slot(&mut self, name: &str, base: [JointId; 2], offset: f64, side: Side) -> Result<JointId, Error> {
        self.check_distinct(name, base)?;
        self.check_slides(name, base[0], &base[1..])?;
        let dyad = self.add_dyad(name, side)?;
        let id = self.add_joint(name, JointKind::Slot { base, offset, dyad });
        if offset == 0.0 {
            self.add_sliding_body(base, base, (0.0, LineDirection::BySide(dyad)));
            self.links[self.sliding_bodies[self.sliding_bodies.len() - 1].link].joints.push((id, Vector::zeros()));
            return Ok(id);
        }
        // With the foot to the right of pivot -> joint, the line points to the left of pivot -> foot.
        let signed = if side == Side::Right { offset } else { -offset };
        self.sliding_bodies.push(SlidingBody {
            base,
            reference: BodyReference::Foot { foot: id, offset: signed },
            link: LinkId::new(self.links.len()),
            is_backward: false,
        });
        self.add_bar(base[0], id, offset.abs());
        Ok(id)
    }

    /// Adds a link that keeps the direction of a line.
    pub(super) fn add_sliding_body(
        &mut self,
        base: [JointId; 2],
        line: [JointId; 2],
        (offset, direction): (f64, LineDirection),
    ) {
        self.sliding_bodies.push(SlidingBody {
            base,
            reference: BodyReference::Line { line, offset, direction },
            link: LinkId::new(self.links.len()),
            is_backward: false,
        });
        self.links.push(Link { joints: vec![(base[0], Vector::zeros())] });
    }

    /// Adds a point of a sliding body: along its line, in the line's direction at the start, and to the left of it; or in
    /// the opposite direction.
    pub(super) fn add_point_on_sliding_body(
        &mut self,
        name: &str,
        body: SlidingBody,
        [along, across]: [f64; 2],
    ) -> JointId {
        let SlidingBody { base, reference, link, is_backward } = body;
        let turn = if is_backward { -1.0 } else { 1.0 };
        let [along, across] = [along * turn, across * turn];
        let (kind, position) = match reference {
            BodyReference::Line { line, offset, direction } => {
                // At the start the line points towards the joint, on either side.
                let sense = match direction {
                    LineDirection::BySide(dyad) => -f64::from(self.mode.sign(dyad)),
                    LineDirection::Towards | LineDirection::Actuator => 1.0,
                };
                let (from, position) = (base[0], Vector::new(along, across));
                let [along, across] = [along * sense, across * sense];
                (JointKind::Aligned { from, line, offset, direction, along, across }, position)
            }
            BodyReference::Foot { foot, offset } => {
                let (along, across) = (-across / offset, along / offset);
                let kind = JointKind::Rigid { base: [base[0], foot], along, across };
                (kind, Vector::new(along, across) * offset.abs())
            }
            BodyReference::Block { line, offset } => {
                let (along, across) = (-across * offset.signum(), along * offset.signum());
                let direction = LineDirection::Towards;
                let kind = JointKind::Aligned { from: base[0], line, offset: 0.0, direction, along, across };
                (kind, Vector::new(along, across))
            }
        };
        let id = self.add_joint(name, kind);
        self.links[link].joints.push((id, position));
        id
    }

    /// Adds the block on the joint `base[0]`, through which a slot's line slides that has its pivot at `base[1]`. It is a link of its own
    /// only where it has points. Nothing is added where there is no such slot.
    pub(super) fn add_block(&mut self, base: [JointId; 2]) {
        let slot = self.joints.iter().enumerate().find_map(|(foot, joint)| match joint.kind {
            JointKind::Slot { base: [pivot, through], dyad, .. } if [through, pivot] == base => Some((foot, dyad)),
            _ => None,
        });
        let Some((foot, dyad)) = slot else { return };
        let line = self.sliding_bodies.iter().find(|body| body.base == [base[1], base[0]]).map(|body| body.reference);
        let reference = match line {
            Some(BodyReference::Foot { offset, .. }) => {
                BodyReference::Block { line: [base[1], JointId::new(foot)], offset }
            }
            _ => BodyReference::Line { line: [base[1], base[0]], offset: 0.0, direction: LineDirection::BySide(dyad) },
        };
        let link = LinkId::new(self.links.len());
        self.sliding_bodies.push(SlidingBody { base, reference, link, is_backward: true });
        self.links.push(Link { joints: vec![(base[0], Vector::zeros())] });
    }

    /// The output link that is the sliding body of two joints; `None` if there is none, or it is an actuator.
    pub(super) fn output_of_sliding_body(&self, base: [JointId; 2]) -> Option<OutputLink> {
        let body = self.sliding_bodies.iter().find(|body| body.base == base)?;
        match body.reference {
            BodyReference::Foot { foot, .. } => Some(OutputLink::Link([base[0], foot])),
            BodyReference::Line { direction: LineDirection::BySide(_), .. } if body.is_backward => None,
            BodyReference::Line { direction: LineDirection::BySide(dyad), .. } => Some(OutputLink::Slot { base, dyad }),
            BodyReference::Line { line, direction: LineDirection::Towards, .. } => {
                Some(OutputLink::Slider { joint: base[0], line })
            }
            BodyReference::Line { direction: LineDirection::Actuator, .. } | BodyReference::Block { .. } => None,
        }
    }

    /// Checks that a joint that holds what slides is not on the link with the line, or with the joint on it: nothing would move, and two joints would name
    /// two links.
    fn check_slides(&self, name: &str, held_by: JointId, on: &[JointId]) -> Result<(), Error> {
        let is_on = |link: &Link, joint: JointId| link.position(joint).is_some();
        let is_fast = |link: &Link| is_on(link, held_by) && on.iter().all(|&joint| is_on(link, joint));
        if self.links.iter().any(is_fast) {
            let base = self.joints[held_by].name.clone();
            return Err(Error::NothingSlides { joint: name.to_owned(), base });
        }
        Ok(())
    }

    /// Checks that two joints can define a line: they are different, and on one link they do not coincide.
    fn check_line(&self, name: &str, line: [JointId; 2]) -> Result<(), Error> {
        self.check_distinct(name, line)?;
        match self.common_link(line) {
            Some((_, from, to)) if from == to => {
                let base = line.map(|j| self.joints[j].name.clone());
                Err(Error::NoDirection { joint: name.to_owned(), base })
            }
            _ => Ok(()),
        }
    }
}
