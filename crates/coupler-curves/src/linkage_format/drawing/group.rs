//! Places the joints of a drawing together, where no dyads place them.

use super::placer::{Obstacle, Placer};
use super::{DrawnInput, Slide};
use crate::expression::{CompiledExpression, Function};
use crate::template::{ClosureTemplate, JointKindTemplate};

/// The most joints whose coordinates are unknowns: with so many, a step along the motion is proven in milliseconds.
pub(super) const MAX_GROUPED: usize = 24;

impl Placer<'_, '_> {
    /// Places all joints but those of the input and of the link at rest as one group.
    ///
    /// Of each link two joints are the base, whose distance is an equation; a further joint is a point of the link or,
    /// where it is placed otherwise already, held by two equations.
    ///
    /// # Errors
    /// The input alone holds a link; there are too many joints.
    pub fn place_as_group(&mut self) -> Result<Vec<ClosureTemplate>, Obstacle> {
        let drawing = self.drawing;
        self.place_ground();
        self.place_input()?;
        let mut closures = Vec::new();
        if let DrawnInput::Actuator { joints: [_, joint, _], .. } = drawing.input {
            closures.push(ClosureTemplate::Start { joint, at: self.position_on_ground(joint) });
        }
        if let DrawnInput::Distance { joints } = drawing.input {
            closures.push(ClosureTemplate::Drive { joints });
        }
        // The links with the most joints first: the fewer joints are held.
        let mut links: Vec<usize> = (0..drawing.links.len()).filter(|link| !self.is_link_placed[*link]).collect();
        links.sort_by_key(|link| std::cmp::Reverse(drawing.links[*link].joints.len()));
        for link in links {
            let mut joints = drawing.links[link].joints.clone();
            // Stable: those that are placed come first, in their order.
            joints.sort_by_key(|joint| !self.is_placed(*joint));
            let &[a, b, ref others @ ..] = &joints[..] else { continue };
            for joint in [a, b] {
                if !self.is_placed(joint) {
                    self.kinds[joint] = Some(JointKindTemplate::Grouped { at: self.position_on_ground(joint) });
                }
            }
            closures.push(ClosureTemplate::Bar { joints: [a, b], length: drawing.length(a, b) });
            for &joint in others {
                match (self.is_placed(joint), self.point(joint, [a, b])) {
                    (false, point) => self.kinds[joint] = Some(point),
                    (true, point) => {
                        let place = self.place_on_link(joint, [a, b], point);
                        closures.push(ClosureTemplate::Hold { joint, base: [a, b], place });
                    }
                }
            }
            self.is_link_placed[link] = true;
        }
        let is_grouped = |kind: &&Option<JointKindTemplate>| matches!(kind, Some(JointKindTemplate::Grouped { .. }));
        let grouped = self.kinds.iter().filter(is_grouped).count();
        if grouped > MAX_GROUPED {
            return Err(Obstacle::TooLarge(grouped));
        }
        for (k, &Slide { joint, line: [a, b], .. }) in drawing.slides.iter().enumerate() {
            if !self.is_slide_used[k] {
                let offset: CompiledExpression = drawing.vector(a, b).across(&drawing.vector(a, joint));
                closures.push(ClosureTemplate::Guide { joint, line: [a, b], offset });
                self.is_slide_used[k] = true;
            }
        }
        Ok(closures)
    }

    /// The distances along the line of two joints of a link, and to the left of it, of a third, from how it is placed as a point.
    fn place_on_link(&self, joint: usize, [a, b]: [usize; 2], point: JointKindTemplate) -> [CompiledExpression; 2] {
        let line = self.drawing.vector(a, b);
        let drawn = line.components(&self.drawing.vector(a, joint));
        let JointKindTemplate::Distances { distances: [from_a, from_b], .. } = point else { return drawn };
        let square = |length: &CompiledExpression| length.clone() * length.clone();
        let base = self.drawing.length(a, b);
        let twice = CompiledExpression::constant(2.0) * base.clone();
        let along = (square(&from_a) - square(&from_b) + square(&base)) / twice;
        let across = CompiledExpression::call(Function::Sqrt, [square(&from_a) - square(&along)]);
        // On the side on which it is drawn.
        let [_, side] = drawn;
        let side = side.clone() / CompiledExpression::call(Function::Abs, [side]);
        [along, across * side]
    }
}
