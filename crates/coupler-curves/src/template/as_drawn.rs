//! Coordinates, sides and directions of a template as they are on paper: after its orientation.

use super::{Side, Template};
use crate::expression::{CompiledExpression, MathText};
use crate::geometry::Vector;
use crate::text::format_as_written;

impl Template {
    /// What is on this side before the orientation is on this one on paper: a mirror image has the other.
    pub(super) fn side_as_drawn(&self, side: Side) -> &'static str {
        let is_left = (side == Side::Left) == (self.orientation.handedness() > 0.0);
        if is_left { "left" } else { "right" }
    }

    /// The coordinates on paper of a joint at some coordinates. Of a link that moves on paper, only a mirror image changes them; a rotation by
    /// no quarter turns is left to [`Template::input_as_drawn`].
    pub(super) fn position_as_drawn(&self, [x, y]: &[CompiledExpression; 2]) -> [MathText; 2] {
        let y = if self.orientation.handedness() < 0.0 { -y.clone() } else { y.clone() };
        let [x, y] = match self.quarter_turns() {
            Some(1) => [-y, x.clone()],
            Some(2) => [-x.clone(), -y],
            Some(3) => [y, -x.clone()],
            _ => [x.clone(), y],
        };
        [x, y].map(|coordinate| coordinate.simplified_sign().to_dimension_text())
    }

    /// The direction of the crank at input 0, and in which it turns: "from the direction of −x, clockwise".
    ///
    /// Of a linkage that is seen from a moving link, the driving link's angle is measured from the link that it is defined on.
    pub fn input_as_drawn(&self) -> String {
        let turning = self.turning_as_drawn();
        let start = match (self.seen_from, self.quarter_turns()) {
            (Some(_), _) => format!("the x-axis of link {}", self.defined_link()),
            (None, Some(quarters)) => ["x", "y", "−x", "−y"][quarters].to_owned(),
            (None, None) => format!("{}° from x", format_as_written(self.orientation.rotation_deg())),
        };
        format!("from the direction of {start}, {turning}")
    }

    /// The sense on paper in which angles of cranks increase.
    pub(super) fn turning_as_drawn(&self) -> &'static str {
        if self.orientation.handedness() > 0.0 { "counter-clockwise" } else { "clockwise" }
    }

    /// A direction in degrees on paper; as coordinates, before a rotation that is stated apart.
    pub(super) fn direction_as_drawn(&self, deg: f64) -> f64 {
        let rotation = self.orientation.rotation_deg() - self.rotation_before_drawing();
        let deg = self.orientation.handedness() * deg + rotation;
        // As written where that is at most half a turn.
        if deg.abs() <= 180.0 { deg } else { deg - 360.0 * (deg / 360.0).round() }
    }

    /// The rotation that its coordinates in words are before, in degrees; 0 if they are as drawn.
    pub fn rotation_before_drawing(&self) -> f64 {
        let is_stated = self.seen_from.is_none() && self.quarter_turns().is_some();
        if is_stated { 0.0 } else { self.orientation.rotation_deg() }
    }

    /// The quarter turns of its orientation, 0 to 3; `None` for another rotation, and for that of a link on which nothing is fixed on paper.
    fn quarter_turns(&self) -> Option<usize> {
        let axis = self.orientation.transform_vector(Vector::new(1.0, 0.0));
        let turns = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        turns.iter().position(|turn| *turn == [axis.x, axis.y]).filter(|_| self.seen_from.is_none())
    }
}

#[cfg(test)]
mod tests {
    use crate::catalogue;
    use crate::geometry::Orientation;

    #[test]
    fn words_are_of_what_is_drawn() {
        let words = |mirrored: bool, deg: f64| {
            let mut template = (*catalogue::find("jansen").unwrap()).clone();
            template.orientation = Orientation::new(mirrored, deg);
            let joints = ["O", "X"].map(|name| {
                let joint = template.joints.iter().position(|joint| joint.name == name).unwrap();
                template.construction(joint).to_string()
            });
            (joints, template.input_as_drawn(), template.rotation_before_drawing())
        };
        for (mirrored, deg, at, side, input, rotation) in [
            (false, 0.0, "(a, l)", "right", "x, counter-clockwise", 0.0),
            (true, 180.0, "(−a, l)", "left", "−x, clockwise", 0.0),
            (false, 90.0, "(−l, a)", "right", "y, counter-clockwise", 0.0),
            (true, 90.0, "(l, a)", "left", "y, clockwise", 0.0),
            (false, -90.0, "(l, −a)", "right", "−y, counter-clockwise", 0.0),
            (true, 30.0, "(a, −l)", "left", "30° from x, clockwise", 30.0),
        ] {
            let joints = [format!("fixed pivot at {at}"), format!("PX = j, BX = b, {side} of PB")];
            assert_eq!(words(mirrored, deg), (joints, format!("from the direction of {input}"), rotation));
        }
    }
}
