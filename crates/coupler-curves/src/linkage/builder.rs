use super::{
    AssemblyMode, Error, Joint, JointId, JointKind, LineDirection, Link, Linkage, MAX_DYADS, MotionOptions, Side,
};
use crate::geometry::{Orientation, Point, Vector, left_normal, trig};

/// A body that is known by a joint and a line: what slides on a line, or is slid through.
#[derive(Clone, Copy, Debug)]
struct SlidingBody {
    /// The joint its points are measured from, and another that names the line.
    base: [JointId; 2],
    /// How its points are placed.
    reference: BodyReference,
    /// Its place among the links.
    link: usize,
}

#[derive(Clone, Copy, Debug)]
enum BodyReference {
    /// A link with the foot of its line, which is so far from its pivot; positive where the line's direction is the
    /// foot's turned to the left.
    Foot { foot: JointId, offset: f64 },
    /// It keeps the direction of a line, as of [`JointKind::Aligned`].
    Line { line: [JointId; 2], offset: f64, direction: LineDirection },
}

/// A linkage being put together, joint by joint.
///
/// ```
/// use coupler_curves::linkage::{LinkageBuilder, Side};
/// let mut four_bar = LinkageBuilder::default();
/// let o = four_bar.fixed("O", [0.0, 0.0].into());
/// let c = four_bar.fixed("C", [4.0, 0.0].into());
/// let a = four_bar.crank("A", o, 1.0)?;
/// let b = four_bar.dyad("B", [a, c], [3.0, 3.5], Side::Left)?;
/// let m = four_bar.point("M", [a, b], 1.5, 1.0)?;
/// let linkage = four_bar.build(vec![m], None, Default::default())?;
/// assert_eq!(linkage.links.len(), 4);
/// # Ok::<(), coupler_curves::linkage::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct LinkageBuilder {
    joints: Vec<Joint>,
    links: Vec<Link>,
    sliding_bodies: Vec<SlidingBody>,
    mode: AssemblyMode,
    dyad_count: usize,
}

impl LinkageBuilder {
    /// A fixed joint.
    pub fn fixed(&mut self, name: &str, at: Point) -> JointId {
        let id = self.add_joint(name, JointKind::Fixed(at));
        if self.links.is_empty() {
            self.links.push(Link { joints: Vec::new() });
        }
        self.links[0].joints.push((id, at.coords));
        id
    }

    /// The pin of a crank about `pivot`.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn crank(&mut self, name: &str, pivot: JointId, length: f64) -> Result<JointId, Error> {
        check_length(name, length)?;
        let id = self.add_joint(name, JointKind::Crank { pivot, length });
        self.add_bar(pivot, id, length);
        Ok(id)
    }

    /// The pin of a second crank about `pivot`, geared to the first: it turns `ratio[0]` times while that turns
    /// `ratio[1]` times, both whole, and stands at `phase_deg` degrees where that stands at 0.
    ///
    /// # Errors
    /// A length that is not positive, a ratio with a 0 in it or out of bounds.
    pub fn gear(
        &mut self,
        name: &str,
        (pivot, length): (JointId, f64),
        ratio: [f64; 2],
        phase_deg: f64,
    ) -> Result<JointId, Error> {
        check_length(name, length)?;
        let is_good = |x: &f64| x.fract() == 0.0 && (1.0..=Error::MAX_GEAR_RATIO as f64).contains(&x.abs());
        if !ratio.iter().all(is_good) {
            return Err(Error::InvalidRatio { joint: name.to_owned(), ratio });
        }
        let [n, d] = ratio.map(|x| x as i64);
        let common = super::gcd(n.unsigned_abs() as u32, d.unsigned_abs() as u32);
        let lowest = i64::from(common) * d.signum();
        let id = self.add_joint(name, JointKind::Gear { pivot, length, ratio: [n / lowest, d / lowest], phase_deg });
        self.add_bar(pivot, id, length);
        Ok(id)
    }

    /// The pin of a crank about `base[1]`, driven by a linear actuator that turns about `base[0]`, or about a point
    /// `offset` beside its line; on a side of `base[0] -> base[1]`.
    ///
    /// # Errors
    /// One joint given twice, a length that is not positive, one dyad too many.
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
        let index = self.add_dyad(name, side)?;
        let id = self.add_joint(name, JointKind::Piston { base, length, offset, index });
        self.add_bar(base[1], id, length);
        // McCarthy's foot is to the right of the line from pivot to pin, so the pivot is to the left of his line.
        self.add_sliding_body([base[0], id], [base[0], id], (-offset, LineDirection::Actuator));
        Ok(id)
    }

    /// The common pin of two links that hang on two joints, on a side of `base[0] -> base[1]`.
    ///
    /// On two joints of one link it is a point of that link, and not two-valued.
    ///
    /// # Errors
    /// One joint given twice, a length that is not positive, one dyad too many.
    pub fn dyad(&mut self, name: &str, base: [JointId; 2], lengths: [f64; 2], side: Side) -> Result<JointId, Error> {
        self.check_distinct(name, base)?;
        for length in lengths {
            check_length(name, length)?;
        }
        if self.common_link(base).is_some() {
            return self.point_at_distances(name, base, lengths, side);
        }
        let index = self.add_dyad(name, side)?;
        let id = self.add_joint(name, JointKind::Dyad { base, lengths, index });
        self.add_bar(base[0], id, lengths[0]);
        self.add_bar(base[1], id, lengths[1]);
        Ok(id)
    }

    /// The fourth corner of a parallelogram, `corners[0] + corners[2] - corners[1]`: the end of a link on the first of them,
    /// parallel to the link with the other two; where the first two are on one link, by a link on the last as well.
    ///
    /// It stays a parallelogram where it lies flat, and so is not two-valued.
    ///
    /// # Errors
    /// One joint given twice, the last two on no common link, neighbours that coincide.
    pub fn parallelogram(&mut self, name: &str, corners: [JointId; 3]) -> Result<JointId, Error> {
        let [first, second, third] = corners;
        self.check_distinct(name, [first, second])?;
        self.check_distinct(name, [first, third])?;
        let (_, from, to) = self.require_common_link(name, [second, third])?;
        let other = match self.common_link([first, second]) {
            Some(_) => Some(self.require_common_link(name, [first, second])?),
            None => None,
        };
        let id = self.add_joint(name, JointKind::Parallelogram { corners });
        self.add_bar(first, id, (to - from).norm());
        if let Some((_, from, to)) = other {
            self.add_bar(third, id, (to - from).norm());
        }
        Ok(id)
    }

    /// The end of a link that hangs on a joint and slides on a line through two others, or `offset` to the left of it;
    /// ahead of the joint the link hangs on, or behind it.
    ///
    /// # Errors
    /// One joint given twice for the line, a length that is not positive, one dyad too many.
    pub fn slide(
        &mut self,
        name: &str,
        (from, length): (JointId, f64),
        (line, offset): ([JointId; 2], f64),
        ahead: Side,
    ) -> Result<JointId, Error> {
        self.check_line(name, line)?;
        check_length(name, length)?;
        let index = self.add_dyad(name, ahead)?;
        let id = self.add_joint(name, JointKind::Slide { from, length, line, offset, index });
        self.add_bar(from, id, length);
        self.add_sliding_body([id, line[1]], line, (0.0, LineDirection::Towards));
        Ok(id)
    }

    /// The point of a guide, along two joints or `offset` to their left, at which the slot of a yoke meets it; the yoke
    /// slides along the guide, and `from` slides in its slot, which is at `angle_deg` to the guide.
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
        let (cos, sin) = trig::cos_sin_deg(angle_deg);
        if sin == 0.0 {
            return Err(Error::SlotParallelToGuide { joint: name.to_owned() });
        }
        let id = self.add_joint(name, JointKind::Yoke { from, line, offset, slot_direction: Vector::new(cos, sin) });
        self.add_sliding_body([id, line[1]], line, (0.0, LineDirection::Towards));
        Ok(id)
    }

    /// The foot, at a distance `offset` from the pivot `base[0]`, of the line that slides through `base[1]`; on a side
    /// of `base[0] -> base[1]`. The pivot and the foot are on one link.
    ///
    /// With no offset the foot is the pivot, and the side says which way the line points. Points of the link that carries
    /// the line are given by [`LinkageBuilder::point`] on the same two joints: along the line, as it points at the start, and to
    /// the left.
    ///
    /// # Errors
    /// One joint given twice, one dyad too many.
    pub fn slot(&mut self, name: &str, base: [JointId; 2], offset: f64, side: Side) -> Result<JointId, Error> {
        self.check_distinct(name, base)?;
        let index = self.add_dyad(name, side)?;
        let id = self.add_joint(name, JointKind::Slot { base, offset, index });
        if offset == 0.0 {
            self.add_sliding_body(base, base, (0.0, LineDirection::BySide(index)));
            self.links[self.sliding_bodies[self.sliding_bodies.len() - 1].link].joints.push((id, Vector::zeros()));
            return Ok(id);
        }
        // With the foot to the right of pivot -> joint, the line points to the left of pivot -> foot.
        let signed = if side == Side::Right { offset } else { -offset };
        self.sliding_bodies.push(SlidingBody {
            base,
            reference: BodyReference::Foot { foot: id, offset: signed },
            link: self.links.len(),
        });
        self.add_bar(base[0], id, offset.abs());
        Ok(id)
    }

    /// A point of the link through two joints: `along` from the first towards the second, `across` to the left.
    ///
    /// Of what slides it is measured from the first joint along the line, as it points at the start, and to its left:
    /// a [`LinkageBuilder::slot`]'s link and an actuator are known by their pivot and the joint they slide through or drive, a
    /// slider's block and a yoke by their joint and the second joint of their line.
    ///
    /// # Errors
    /// One joint given twice, joints on no common link, joints that coincide.
    pub fn point(&mut self, name: &str, base: [JointId; 2], along: f64, across: f64) -> Result<JointId, Error> {
        let mut carriers = self.sliding_bodies.iter().filter(|carrier| carrier.base == base);
        if let Some(carrier) = carriers.next() {
            if carriers.next().is_some() {
                let base = base.map(|j| self.joints[j].name.clone());
                return Err(Error::AmbiguousLink { joint: name.to_owned(), base });
            }
            let SlidingBody { reference: body, link, .. } = *carrier;
            let (step, place) = match body {
                BodyReference::Line { line, offset, direction: line_is } => {
                    // At the start it points towards the joint, whichever side that is.
                    let sense = match line_is {
                        LineDirection::BySide(index) => -f64::from(self.mode.sign(index)),
                        LineDirection::Towards | LineDirection::Actuator => 1.0,
                    };
                    let (from, place) = (base[0], Vector::new(along, across));
                    let [along, across] = [along * sense, across * sense];
                    (JointKind::Aligned { from, line, offset, direction: line_is, along, across }, place)
                }
                BodyReference::Foot { foot, offset } => {
                    let (along, across) = (-across / offset, along / offset);
                    let step = JointKind::Rigid { base: [base[0], foot], along, across };
                    (step, Vector::new(along, across) * offset.abs())
                }
            };
            let id = self.add_joint(name, step);
            self.links[link].joints.push((id, place));
            return Ok(id);
        }
        let (link, from, to) = self.require_common_link(name, base)?;
        let span = (to - from).norm();
        let (along, across) = (along / span, across / span);
        let id = self.add_joint(name, JointKind::Rigid { base, along, across });
        let place = from + (to - from) * along + left_normal(to - from) * across;
        self.links[link].joints.push((id, place));
        Ok(id)
    }

    /// A point of the link through two joints by its distances from them, on a side of the first to the second.
    ///
    /// # Errors
    /// As [`LinkageBuilder::point`], and distances that make no triangle. A flat triangle is one.
    pub fn point_at_distances(
        &mut self,
        name: &str,
        base: [JointId; 2],
        d: [f64; 2],
        side: Side,
    ) -> Result<JointId, Error> {
        let (_, from, to) = self.require_common_link(name, base)?;
        let span = (to - from).norm();
        let along = ((d[0] - d[1]) * (d[0] + d[1]) + span * span) / (2.0 * span);
        let across2 = (d[0] - along) * (d[0] + along);
        // Rounding may leave a flat triangle a few ulps short of closing.
        if across2 < -4.0 * f64::EPSILON * (d[0] * d[0] + d[1] * d[1]) || d.iter().any(|d| d.is_nan() || *d < 0.0) {
            return Err(Error::NoTriangle { joint: name.to_owned(), distances: d, span });
        }
        let across = across2.max(0.0).sqrt();
        self.point(name, base, along, if side == Side::Left { across } else { -across })
    }

    /// The linkage of these joints.
    ///
    /// # Errors
    /// `seen_from` names joints on no common link, or that coincide.
    pub fn build(
        self,
        traced: Vec<JointId>,
        seen_from: Option<[JointId; 2]>,
        travel: MotionOptions,
    ) -> Result<Linkage, Error> {
        if let Some(joints) = seen_from {
            self.require_common_link("seen_from", joints)?;
        }
        let travel = MotionOptions { mode: self.mode, ..travel };
        let placement = Orientation::default();
        Ok(Linkage { joints: self.joints, links: self.links, traced, seen_from, placement, motion_options: travel })
    }

    /// The place of another two-valued joint.
    fn add_dyad(&mut self, name: &str, side: Side) -> Result<usize, Error> {
        if self.dyad_count == MAX_DYADS {
            return Err(Error::TooManyDyads { joint: name.to_owned() });
        }
        let index = self.dyad_count;
        self.dyad_count += 1;
        self.mode = self.mode.with_side(index, side);
        Ok(index)
    }

    fn add_joint(&mut self, name: &str, step: JointKind) -> JointId {
        self.joints.push(Joint { name: name.to_owned(), kind: step });
        self.joints.len() - 1
    }

    fn add_bar(&mut self, from: JointId, to: JointId, length: f64) {
        self.links.push(Link { joints: vec![(from, Vector::zeros()), (to, Vector::new(length, 0.0))] });
    }

    /// A body that keeps the direction of a line.
    fn add_sliding_body(&mut self, base: [JointId; 2], line: [JointId; 2], (offset, line_is): (f64, LineDirection)) {
        self.sliding_bodies.push(SlidingBody {
            base,
            reference: BodyReference::Line { line, offset, direction: line_is },
            link: self.links.len(),
        });
        self.links.push(Link { joints: vec![(base[0], Vector::zeros())] });
    }

    /// Two joints that a line goes through: of one link, they are apart.
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

    fn check_distinct(&self, name: &str, base: [JointId; 2]) -> Result<(), Error> {
        if base[0] == base[1] {
            return Err(Error::RepeatedJoint { joint: name.to_owned(), base: self.joints[base[0]].name.clone() });
        }
        Ok(())
    }

    /// The link that has both joints, which are apart, and where they are on it.
    fn require_common_link(&self, name: &str, base: [JointId; 2]) -> Result<(usize, Vector, Vector), Error> {
        self.check_distinct(name, base)?;
        let names = || base.map(|j| self.joints[j].name.clone());
        match self.common_link(base) {
            None => Err(Error::NoCommonLink { joint: name.to_owned(), base: names() }),
            Some((_, from, to)) if from == to => Err(Error::NoDirection { joint: name.to_owned(), base: names() }),
            Some(found) => Ok(found),
        }
    }

    /// The link that has both joints, and where they are on it.
    fn common_link(&self, [from, to]: [JointId; 2]) -> Option<(usize, Vector, Vector)> {
        self.links.iter().enumerate().find_map(|(k, link)| Some((k, link.position(from)?, link.position(to)?)))
    }
}

fn check_length(joint: &str, length: f64) -> Result<(), Error> {
    if length > 0.0 && length.is_finite() {
        return Ok(());
    }
    Err(Error::InvalidLength { joint: joint.to_owned(), length })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> (LinkageBuilder, JointId, JointId) {
        let mut assembly = LinkageBuilder::default();
        let o = assembly.fixed("O", Point::new(0.0, 0.0));
        let c = assembly.fixed("C", Point::new(4.0, 0.0));
        (assembly, o, c)
    }

    #[test]
    fn a_dyad_on_one_link_is_a_point_of_it() {
        let (mut assembly, o, c) = frame();
        assembly.dyad("P", [o, c], [3.0, 5.0], Side::Right).unwrap();
        let linkage = assembly.build(vec![], None, MotionOptions::default()).unwrap();
        assert_eq!(linkage.dyad_count(), 0);
        assert_eq!(linkage.links[0].position(2), Some(Vector::new(0.0, -3.0)));
    }

    #[test]
    fn impossible_joints_are_refused() {
        let (mut assembly, o, c) = frame();
        let a = assembly.crank("A", o, 1.0).unwrap();
        assert!(matches!(assembly.crank("X", o, 0.0), Err(Error::InvalidLength { .. })));
        assert!(matches!(assembly.dyad("X", [a, a], [1.0, 1.0], Side::Left), Err(Error::RepeatedJoint { .. })));
        assert!(matches!(assembly.point("X", [a, c], 1.0, 1.0), Err(Error::NoCommonLink { .. })));
        assert!(matches!(
            assembly.point_at_distances("X", [o, c], [1.0, 1.0], Side::Left),
            Err(Error::NoTriangle { .. })
        ));
        assert!(assembly.point_at_distances("X", [o, c], [1.0, 3.0], Side::Left).is_ok(), "a flat triangle");
        assert!(assembly.build(vec![], Some([a, c]), MotionOptions::default()).is_err());
    }
}
