//! Building a linkage joint by joint.

mod group;
mod sliding_body;
mod sliding_joints;

use sliding_body::SlidingBody;

use super::planar_linkage::gcd;
use super::{
    AssemblyMode, DwellBand, DyadId, Error, Group, Joint, JointId, JointKind, Link, LinkId, Linkage, MAX_DYADS,
    MotionOptions, OutputLink, Side,
};
use crate::geometry::{Orientation, Point, Vector, left_normal};

/// Builds a linkage joint by joint.
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
    group: Option<Group>,
    output_link: Option<OutputLink>,
}

impl LinkageBuilder {
    /// Adds a fixed joint.
    pub fn fixed(&mut self, name: &str, position: Point) -> JointId {
        let id = self.add_joint(name, JointKind::Fixed(position));
        if self.links.is_empty() {
            self.links.push(Link { joints: Vec::new() });
        }
        self.links[0].joints.push((id, position.coords));
        id
    }

    /// Adds the pin of a crank about `pivot`.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn crank(&mut self, name: &str, pivot: JointId, length: f64) -> Result<JointId, Error> {
        check_length(name, length)?;
        let id = self.add_joint(name, JointKind::Crank { pivot, length });
        self.add_bar(pivot, id, length);
        Ok(id)
    }

    /// Adds the pin of a second crank about `pivot`, geared to the first: it turns `ratio[0]` times while the first
    /// turns `ratio[1]` times, both whole, and its angle is `phase_deg` when the first crank's is 0.
    ///
    /// # Errors
    /// A length that is not positive, a ratio with a 0 in it, or above [`Error::MAX_GEAR_RATIO`] in lowest terms.
    pub fn gear(
        &mut self,
        name: &str,
        (pivot, length): (JointId, f64),
        ratio: [f64; 2],
        phase_deg: f64,
    ) -> Result<JointId, Error> {
        check_length(name, length)?;
        let invalid = || Error::InvalidRatio { joint: name.to_owned(), ratio };
        if !ratio.iter().all(|x| x.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&x.abs())) {
            return Err(invalid());
        }
        let [n, d] = ratio.map(|x| x as i64);
        let common = gcd(n.unsigned_abs() as u32, d.unsigned_abs() as u32);
        let divisor = i64::from(common) * d.signum();
        let ratio = [n / divisor, d / divisor];
        if ratio.iter().any(|turns| turns.unsigned_abs() > Error::MAX_GEAR_RATIO) {
            return Err(invalid());
        }
        let id = self.add_joint(name, JointKind::Gear { pivot, length, ratio, phase_deg });
        self.add_bar(pivot, id, length);
        Ok(id)
    }

    /// Adds the common pin of two links, each connected to one joint of `base`, on a side of `base[0] -> base[1]`.
    ///
    /// If both joints are on one link, the pin becomes a point of that link, and no dyad is added.
    ///
    /// # Errors
    /// One joint given twice, a length that is not positive, more than [`MAX_DYADS`] dyads.
    pub fn dyad(&mut self, name: &str, base: [JointId; 2], lengths: [f64; 2], side: Side) -> Result<JointId, Error> {
        self.check_distinct(name, base)?;
        for length in lengths {
            check_length(name, length)?;
        }
        if self.common_link(base).is_some() {
            return self.point_at_distances(name, base, lengths, side);
        }
        let dyad = self.add_dyad(name, side)?;
        let id = self.add_joint(name, JointKind::Dyad { base, lengths, dyad });
        self.add_bar(base[0], id, lengths[0]);
        self.add_bar(base[1], id, lengths[1]);
        Ok(id)
    }

    /// Adds the fourth corner of a parallelogram, `corners[0] + corners[2] - corners[1]`: the end of a link on the
    /// first corner, parallel to the link with the other two. If the first two are on one link, a second link joins
    /// the last corner to the new one.
    ///
    /// It remains a parallelogram through its flat positions, and so is not a dyad.
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

    /// Adds a point of the link through two joints: `along` from the first towards the second, `across` to the left.
    ///
    /// On a sliding link it is measured from the first joint along the line, in the line's direction at the start,
    /// and to its left. A [`LinkageBuilder::slot`]'s link and an actuator are identified by their pivot and the joint
    /// they slide through or drive, the block through which a slot's link slides and the rod by the same joints in the other order; a
    /// slider's block and a yoke by their joint and a joint of their line, towards the first of which points are measured against the line's direction.
    ///
    /// # Errors
    /// One joint given twice, joints on no common link, joints that coincide.
    pub fn point(&mut self, name: &str, base: [JointId; 2], along: f64, across: f64) -> Result<JointId, Error> {
        if self.sliding_bodies.iter().all(|body| body.base != base) {
            self.add_block(base);
        }
        let mut bodies = self.sliding_bodies.iter().filter(|body| body.base == base);
        if let Some(body) = bodies.next() {
            if bodies.next().is_some() {
                let base = base.map(|j| self.joints[j].name.clone());
                return Err(Error::AmbiguousLink { joint: name.to_owned(), base });
            }
            let body = *body;
            return Ok(self.add_point_on_sliding_body(name, body, [along, across]));
        }
        let (link, from, to) = self.require_common_link(name, base)?;
        let span = (to - from).norm();
        let (along, across) = (along / span, across / span);
        let id = self.add_joint(name, JointKind::Rigid { base, along, across });
        self.links[link].joints.push((id, point_on_link([from, to], along, across)));
        Ok(id)
    }

    /// Adds a point of the link through two joints by its distances from them, on a side of the first -> the second.
    ///
    /// # Errors
    /// As [`LinkageBuilder::point`], and distances that do not form a triangle. A flat triangle is accepted.
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
        let across_squared = (d[0] - along) * (d[0] + along);
        // Rounding may leave a flat triangle a few ulps short of closing.
        let tolerance = 4.0 * f64::EPSILON * (d[0] * d[0] + d[1] * d[1]);
        if across_squared < -tolerance || d.iter().any(|d| d.is_nan() || *d < 0.0) {
            return Err(Error::NoTriangle { joint: name.to_owned(), distances: d, span });
        }
        let across = across_squared.max(0.0).sqrt();
        self.point(name, base, along, if side == Side::Left { across } else { -across })
    }

    /// States the output link by two of its joints, from which its angle is measured; the link of a slot, a slider's
    /// block and a yoke are identified as by [`LinkageBuilder::point`].
    ///
    /// # Errors
    /// One joint given twice, joints on no common link, joints that coincide.
    pub fn set_output_link(&mut self, joints: [JointId; 2]) -> Result<(), Error> {
        let output = match self.output_of_sliding_body(joints) {
            Some(output) => output,
            None => {
                self.require_common_link("output_link", joints)?;
                OutputLink::Link(joints)
            }
        };
        self.output_link = Some(output);
        Ok(())
    }

    /// States that the output link is the slider, the yoke or the rack of a joint.
    ///
    /// # Errors
    /// The joint was added neither by [`LinkageBuilder::slide`] nor by [`LinkageBuilder::yoke`] or [`LinkageBuilder::rack`].
    pub fn set_output_slider(&mut self, joint: JointId) -> Result<(), Error> {
        let (JointKind::Slide { line, .. } | JointKind::Yoke { line, .. } | JointKind::Rack { line, .. }) =
            self.joints[joint].kind
        else {
            return Err(Error::NotASlider { joint: self.joints[joint].name.clone() });
        };
        self.output_link = Some(OutputLink::Slider { joint, line });
        Ok(())
    }

    /// The linkage of these joints. The assembly mode at the start is that of the sides given to the joints, whatever
    /// `options` contains.
    ///
    /// # Errors
    /// `seen_from` names joints on no common link, or joints that coincide; the output link is the ground; a rack, and no range of the
    /// input or one of [`Error::MAX_RACK_TURNS`].
    pub fn build(
        self,
        traced: Vec<JointId>,
        seen_from: Option<[JointId; 2]>,
        options: MotionOptions,
    ) -> Result<Linkage, Error> {
        if let Some(joints) = seen_from {
            self.require_common_link("seen_from", joints)?;
        }
        let motion_options = MotionOptions { mode: self.mode, ..options };
        let placement = Orientation::default();
        let (joints, links, output_link) = (self.joints, self.links, self.output_link);
        let linkage = Linkage {
            joints,
            links,
            group: self.group,
            driven_elsewhere: None,
            traced,
            seen_from,
            output_link,
            load: None,
            tolerance: None,
            dwell: DwellBand::default(),
            chains: Vec::new(),
            placement,
            motion_options,
        };
        let is_rack = |joint: &&Joint| matches!(joint.kind, JointKind::Rack { .. });
        if let Some(rack) = linkage.joints.iter().find(is_rack) {
            let range = linkage.motion_options.range;
            if range.is_none_or(|[from, to]| to - from >= linkage.input().period()) {
                return Err(Error::RackWithoutRange { joint: rack.name.clone() });
            }
        }
        match output_link {
            Some(OutputLink::Link(pair)) if pair.iter().all(|&joint| linkage.ground().position(joint).is_some()) => {
                Err(Error::OutputAtRest { base: pair.map(|joint| linkage.joints[joint].name.clone()) })
            }
            _ => Ok(linkage),
        }
    }

    /// The index of a new dyad.
    fn add_dyad(&mut self, name: &str, side: Side) -> Result<DyadId, Error> {
        if self.dyad_count == MAX_DYADS {
            return Err(Error::TooManyDyads { joint: name.to_owned() });
        }
        let dyad = DyadId::new(self.dyad_count);
        self.dyad_count += 1;
        self.mode = self.mode.with_side(dyad, side);
        Ok(dyad)
    }

    fn add_joint(&mut self, name: &str, kind: JointKind) -> JointId {
        self.joints.push(Joint { name: name.to_owned(), kind });
        JointId::new(self.joints.len() - 1)
    }

    fn add_bar(&mut self, from: JointId, to: JointId, length: f64) {
        self.links.push(Link { joints: vec![(from, Vector::zeros()), (to, Vector::new(length, 0.0))] });
    }

    fn check_distinct(&self, name: &str, base: [JointId; 2]) -> Result<(), Error> {
        if base[0] == base[1] {
            return Err(Error::RepeatedJoint { joint: name.to_owned(), base: self.joints[base[0]].name.clone() });
        }
        Ok(())
    }

    /// The link with both joints, which must not coincide, and their positions on it.
    fn require_common_link(&self, name: &str, base: [JointId; 2]) -> Result<(LinkId, Vector, Vector), Error> {
        self.check_distinct(name, base)?;
        let names = || base.map(|j| self.joints[j].name.clone());
        match self.common_link(base) {
            None => Err(Error::NoCommonLink { joint: name.to_owned(), base: names() }),
            Some((_, from, to)) if from == to => Err(Error::NoDirection { joint: name.to_owned(), base: names() }),
            Some(link) => Ok(link),
        }
    }

    /// The link with both joints, and their positions on it.
    fn common_link(&self, [from, to]: [JointId; 2]) -> Option<(LinkId, Vector, Vector)> {
        self.links
            .iter()
            .enumerate()
            .find_map(|(k, link)| Some((LinkId::new(k), link.position(from)?, link.position(to)?)))
    }
}

/// A point by its position along the line of two, and to the left of it, in units of their distance.
fn point_on_link([from, to]: [Vector; 2], along: f64, across: f64) -> Vector {
    from + (to - from) * along + left_normal(to - from) * across
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
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::new(0.0, 0.0));
        let c = builder.fixed("C", Point::new(4.0, 0.0));
        (builder, o, c)
    }

    #[test]
    fn a_dyad_on_one_link_becomes_a_point_of_it() {
        let (mut builder, o, c) = frame();
        builder.dyad("P", [o, c], [3.0, 5.0], Side::Right).unwrap();
        let linkage = builder.build(vec![], None, MotionOptions::default()).unwrap();
        assert_eq!(linkage.dyad_count(), 0);
        assert_eq!(linkage.links[0].position(JointId::new(2)), Some(Vector::new(0.0, -3.0)));
    }

    #[test]
    fn impossible_joints_are_errors() {
        let (mut builder, o, c) = frame();
        let a = builder.crank("A", o, 1.0).unwrap();
        assert!(matches!(builder.crank("X", o, 0.0), Err(Error::InvalidLength { .. })));
        assert!(matches!(builder.dyad("X", [a, a], [1.0, 1.0], Side::Left), Err(Error::RepeatedJoint { .. })));
        assert!(matches!(builder.point("X", [a, c], 1.0, 1.0), Err(Error::NoCommonLink { .. })));
        assert!(matches!(
            builder.point_at_distances("X", [o, c], [1.0, 1.0], Side::Left),
            Err(Error::NoTriangle { .. })
        ));
        assert!(builder.point_at_distances("X", [o, c], [1.0, 3.0], Side::Left).is_ok(), "a flat triangle");
        assert!(builder.build(vec![], Some([a, c]), MotionOptions::default()).is_err());
    }
}
