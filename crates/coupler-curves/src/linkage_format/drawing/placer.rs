//! Places the joints of a drawing one after the other: on the driven link, by dyads, and on links that are placed.

use super::{Drawing, DrawnInput, Slide};
use crate::expression::{CompiledExpression, Function};
use crate::template::{Coordinate, JointKindTemplate, SideTemplate};

/// How far from a line, relative to the other joint on it, a joint is still on it.
const ROUNDING: f64 = 1e-9;

/// Why joints cannot be placed.
pub(super) enum Obstacle {
    /// A link, whose joints are all placed without it.
    Redundant(usize),
    /// A joint, which need not be on a line to be placed.
    RedundantSlide(usize),
    /// No joint can be placed from those that are.
    Open,
    /// No dyads place so many joints, more than can be placed together.
    TooLarge(usize),
}

/// A joint that a drawing has not.
pub struct FurtherJoint {
    /// Its name.
    pub name: String,
    /// How it is placed.
    pub kind: JointKindTemplate,
    /// Where it is in the drawing, if that is stated.
    pub drawn: Option<[CompiledExpression; 2]>,
}

/// Places joints from those that are placed.
pub(super) struct Placer<'d, 'v> {
    pub(super) drawing: &'d Drawing<'v>,
    /// How each joint is placed; `None` of those that are not.
    pub kinds: Vec<Option<JointKindTemplate>>,
    pub(super) is_link_placed: Vec<bool>,
    pub(super) is_slide_used: Vec<bool>,
    /// The joints that the drawing has not: feet of perpendiculars from pivots to lines that slide.
    pub further: Vec<FurtherJoint>,
}

impl<'d, 'v> Placer<'d, 'v> {
    pub fn new(drawing: &'d Drawing<'v>) -> Placer<'d, 'v> {
        Placer {
            drawing,
            kinds: vec![None; drawing.names.len()],
            is_link_placed: vec![false; drawing.links.len()],
            is_slide_used: vec![false; drawing.slides.len()],
            further: Vec::new(),
        }
    }

    /// Places all joints.
    ///
    /// # Errors
    /// A joint or a link cannot be placed.
    pub fn place_all(&mut self) -> Result<(), Obstacle> {
        self.place_ground();
        if self.is_driven_within_group() {
            return Err(Obstacle::Open);
        }
        self.place_input()?;
        loop {
            self.check_links()?;
            if !(self.place_dyad()? || self.place_slide()? || self.place_slot()?) {
                break;
            }
        }
        if let Some(slide) = self.is_slide_used.iter().position(|is_used| !is_used) {
            let slide = &self.drawing.slides[slide];
            if self.is_placed(slide.joint) && self.is_link_placed[slide.link] {
                return Err(Obstacle::RedundantSlide(slide.joint));
            }
        }
        if self.kinds.iter().all(Option::is_some) && self.is_link_placed.iter().all(|is_placed| *is_placed) {
            Ok(())
        } else {
            Err(Obstacle::Open)
        }
    }

    /// Whether a joint is placed.
    pub fn is_placed(&self, joint: usize) -> bool {
        self.kinds[joint].is_some()
    }

    /// The joints of the link at rest.
    pub(super) fn place_ground(&mut self) {
        let ground = self.drawing.ground();
        for &joint in &self.drawing.links[ground].joints {
            self.kinds[joint] = Some(JointKindTemplate::Fixed(self.position_on_ground(joint)));
        }
        self.is_link_placed[ground] = true;
    }

    /// The coordinates of a joint in the frame of the link at rest.
    pub(super) fn position_on_ground(&self, joint: usize) -> [CompiledExpression; 2] {
        match self.drawing.input {
            DrawnInput::Crank { from: Some([a, b]), .. } => {
                let (x_axis, own) = (self.drawing.vector(a, b), self.drawing.vector(a, joint));
                x_axis.components(&own)
            }
            _ => self.drawing.coordinates[joint].0.clone(),
        }
    }

    /// Whether the joints of the input are not placed before the others: its links have no joint in common.
    fn is_driven_within_group(&self) -> bool {
        match self.drawing.input {
            DrawnInput::Crank { line: [pivot, _], .. } => !self.is_placed(pivot),
            DrawnInput::Distance { .. } => true,
            DrawnInput::Slider { .. } | DrawnInput::Actuator { .. } => false,
        }
    }

    pub(super) fn place_input(&mut self) -> Result<(), Obstacle> {
        let drawing = self.drawing;
        let (link, line) = match drawing.input {
            DrawnInput::Slider { slide, .. } => {
                let Slide { joint, line: [a, b], .. } = drawing.slides[slide];
                let offset = drawing.vector(a, b).across(&drawing.vector(a, joint));
                self.kinds[joint] = Some(JointKindTemplate::DrivenSlider { line: [a, b], offset });
                self.is_slide_used[slide] = true;
                return Ok(());
            }
            DrawnInput::Distance { .. } => return Ok(()),
            DrawnInput::Crank { link, line: [pivot, joint], .. } => {
                if !self.is_placed(pivot) {
                    self.kinds[pivot] = Some(JointKindTemplate::Grouped { at: self.position_on_ground(pivot) });
                }
                self.kinds[joint] = Some(JointKindTemplate::Crank { pivot, length: drawing.length(pivot, joint) });
                (link, [pivot, joint])
            }
            DrawnInput::Actuator { link, joints: [from, joint, pivot], .. } => {
                self.kinds[joint] = Some(JointKindTemplate::Piston {
                    base: [from, pivot],
                    length: drawing.length(pivot, joint),
                    offset: CompiledExpression::constant(0.0),
                    side: self.side_of(joint, [from, pivot]),
                });
                (link, [pivot, joint])
            }
        };
        self.place_link(link, line)
    }

    /// The side of a line on which a joint is.
    fn side_of(&self, joint: usize, [a, b]: [usize; 2]) -> SideTemplate {
        let (first, second) = (self.drawing.vector(a, joint), self.drawing.vector(b, joint));
        // The angle at the joint is that between the links there.
        SideTemplate::Drawn(first.sine(&second))
    }

    /// Places the other joints of a link on which two are placed.
    fn place_link(&mut self, link: usize, base: [usize; 2]) -> Result<(), Obstacle> {
        self.is_link_placed[link] = true;
        let drawing = self.drawing;
        for &joint in drawing.links[link].joints.iter().filter(|joint| !base.contains(joint)) {
            if self.is_placed(joint) {
                return Err(Obstacle::Redundant(link));
            }
            self.kinds[joint] = Some(self.point(joint, base));
        }
        Ok(())
    }

    /// A point of a link, by coordinates on it, or by the distances that are given.
    pub(super) fn point(&self, joint: usize, base: [usize; 2]) -> JointKindTemplate {
        let drawing = self.drawing;
        let [a, b] = base;
        let is_given = |[p, q]: [usize; 2]| drawing.given_length(p, q).is_some();
        if [[a, b], [a, joint], [b, joint]].into_iter().any(is_given) {
            let distances = base.map(|other| drawing.length(other, joint));
            return JointKindTemplate::Distances { base, distances, side: self.side_of(joint, base) };
        }
        let (line, own) = (drawing.vector(a, b), drawing.vector(a, joint));
        let [along, across] = line.components(&own).map(Coordinate::Single);
        JointKindTemplate::Point { base, along, across }
    }

    /// Checks that no link is held by more joints than place it.
    fn check_links(&self) -> Result<(), Obstacle> {
        let placed =
            |link: &usize| self.drawing.links[*link].joints.iter().filter(|joint| self.is_placed(**joint)).count();
        let redundant = (0..self.drawing.links.len()).find(|link| !self.is_link_placed[*link] && placed(link) > 1);
        redundant.map_or(Ok(()), |link| Err(Obstacle::Redundant(link)))
    }

    /// The links that are not placed but for one joint, each with this joint.
    fn held_links(&self) -> impl Iterator<Item = (usize, usize)> {
        let links = self.drawing.links.iter().enumerate().filter(|(link, _)| !self.is_link_placed[*link]);
        links.filter_map(|(link, own)| {
            let mut placed = own.joints.iter().copied().filter(|joint| self.is_placed(*joint));
            Some((link, placed.next()?)).filter(|_| placed.next().is_none())
        })
    }

    /// Places the common joint of two links, each of which has one joint that is placed.
    fn place_dyad(&mut self) -> Result<bool, Obstacle> {
        let drawing = self.drawing;
        let mut held = vec![None; drawing.links.len()];
        self.held_links().for_each(|(link, by)| held[link] = Some(by));
        for joint in (0..self.kinds.len()).filter(|joint| !self.is_placed(*joint)) {
            let mut at_joint = drawing.links_at[joint].iter().filter_map(|&link| Some((link, held[link]?)));
            let Some((first, a)) = at_joint.next() else { continue };
            let Some((second, b)) = at_joint.find(|(_, other)| *other != a) else { continue };
            let lengths = [a, b].map(|other| drawing.length(other, joint));
            let side = self.side_of(joint, [a, b]);
            self.kinds[joint] = Some(JointKindTemplate::Dyad { base: [a, b], lengths, side });
            self.place_link(first, [a, joint])?;
            self.place_link(second, [b, joint])?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Places a joint that slides on a line of a link that is placed.
    fn place_slide(&mut self) -> Result<bool, Obstacle> {
        let drawing = self.drawing;
        for (k, slide) in drawing.slides.iter().enumerate() {
            let joint = slide.joint;
            let is_free = !self.is_slide_used[k] && !self.is_placed(joint);
            let held = self.held_links().find(|(link, _)| drawing.links_at[joint].contains(link));
            let Some((link, from)) = held.filter(|_| is_free && self.is_link_placed[slide.link]) else { continue };
            let [a, b] = slide.line;
            let line = drawing.vector(a, b);
            let own = drawing.vector(from, joint);
            self.kinds[joint] = Some(JointKindTemplate::Slide {
                from,
                length: drawing.length(from, joint),
                line: slide.line,
                offset: line.across(&drawing.vector(a, joint)),
                // The cosine of the angle between the link and the line.
                side: SideTemplate::Drawn(line.along(&own) / own.length()),
            });
            self.is_slide_used[k] = true;
            self.place_link(link, [from, joint])?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Places a link with a line that slides through a joint that is placed.
    fn place_slot(&mut self) -> Result<bool, Obstacle> {
        let drawing = self.drawing;
        for (k, slide) in drawing.slides.iter().enumerate() {
            let through = slide.joint;
            let held = self.held_links().find(|(link, _)| *link == slide.link);
            let is_free = !self.is_slide_used[k] && self.is_placed(through);
            let Some((link, pivot)) = held.filter(|(_, pivot)| is_free && *pivot != through) else { continue };
            self.place_sliding_link(link, pivot, (through, slide.line));
            self.is_slide_used[k] = true;
            self.is_link_placed[link] = true;
            return Ok(true);
        }
        Ok(false)
    }

    /// Adds a joint that the drawing has not, and returns its index; primes are added to its name if another joint has it.
    pub fn add_further(
        &mut self,
        mut name: String,
        kind: JointKindTemplate,
        drawn: Option<[CompiledExpression; 2]>,
    ) -> usize {
        let names = &self.drawing.names;
        while names.contains(&name.as_str()) || self.further.iter().any(|other| other.name == name) {
            name.push('\'');
        }
        self.further.push(FurtherJoint { name, kind, drawn });
        names.len() + self.further.len() - 1
    }

    fn place_sliding_link(&mut self, link: usize, pivot: usize, (through, line): (usize, [usize; 2])) {
        let drawing = self.drawing;
        let [a, b] = line;
        let direction = drawing.vector(a, b);
        let to_joint = drawing.vector(pivot, through);
        // From the foot to the joint, in the direction of the line.
        let ahead = direction.along(&to_joint);
        // A line that is drawn through the pivot may miss it by rounding.
        let rounding = to_joint.length() * CompiledExpression::constant(ROUNDING);
        let offset = direction.across(&to_joint).or_zero_within(rounding);
        let kind = JointKindTemplate::Slot {
            base: [pivot, through],
            // The foot is to the left of the line to the joint if the line passes the pivot on the right and the joint is ahead, and if neither is so.
            side: SideTemplate::Drawn(ahead.clone() * offset.clone() / to_joint.dot(&to_joint)),
            offset: CompiledExpression::call(Function::Abs, [offset]),
        };
        self.add_further(format!("{}'", drawing.names[pivot]), kind, None);
        // Points of the link are measured in the direction from the foot to the joint.
        let sign = ahead.clone() / CompiledExpression::call(Function::Abs, [ahead]);
        for &joint in drawing.links[link].joints.iter().filter(|joint| **joint != pivot) {
            let own = drawing.vector(pivot, joint);
            let [along, across] = direction.components(&own).map(|value| Coordinate::Single(value * sign.clone()));
            self.kinds[joint] = Some(JointKindTemplate::Point { base: [pivot, through], along, across });
        }
    }
}
