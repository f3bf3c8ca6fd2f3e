//! Where a rack meets its pinion, in words.

use super::{JointKindTemplate, Parameter, Side, Template};
use crate::expression::{CompiledExpression, displayed_name};

impl Template {
    /// The side of a pinion's pivot on which it moves its rack along the line: as it turns counter-clockwise with the input, that is the
    /// right of the line. On a link without the pivot the rack has no pitch line.
    pub(super) fn mesh_of_rack(&self, crank: usize, line: [usize; 2], radius: &CompiledExpression) -> String {
        let [right, left] = [Side::Right, Side::Left].map(|side| self.side_as_drawn(side));
        let is_of_length = |parameter: &Parameter| {
            radius.name_or_number().as_deref() == Some(displayed_name(&parameter.name).as_str())
                && parameter.min >= Some(0.0)
        };
        let sides = match radius.constant_value() {
            Some(radius) if radius < 0.0 => left.to_owned(),
            Some(_) => right.to_owned(),
            None if self.parameters.iter().any(is_of_length) => right.to_owned(),
            None => format!("{right}, if negative {left},"),
        };
        match &self.joints[crank].kind {
            JointKindTemplate::Crank { pivot, .. } | JointKindTemplate::Gear { pivot, .. }
                if !self.are_on_a_link(&[*pivot, line[0], line[1]]) =>
            {
                let pivot = displayed_name(&self.joints[*pivot].name);
                format!(", without a pitch line, for {pivot} is not on that link")
            }
            JointKindTemplate::Crank { pivot, .. } | JointKindTemplate::Gear { pivot, .. } => {
                format!(", {sides} of {}", displayed_name(&self.joints[*pivot].name))
            }
            _ => String::new(),
        }
    }

    /// Whether joints are on one link.
    fn are_on_a_link(&self, joints: &[usize]) -> bool {
        self.structure().is_ok_and(|linkage| {
            let ids: Option<Vec<_>> =
                joints.iter().map(|&joint| linkage.find_joint(&self.joints[joint].name)).collect();
            ids.is_some_and(|ids| linkage.links.iter().any(|link| ids.iter().all(|id| link.position(*id).is_some())))
        })
    }
}
