//! What the parameters of a template are by their use.

use super::{Coordinate, InputValue, JointKindTemplate, ParameterKind, Template};
use crate::expression::CompiledExpression;

impl Template {
    /// What each parameter is by its use: an angle where it is used by itself with a unit, a length where it is the
    /// length of a link or a coordinate, a ratio of a gear.
    pub(crate) fn infer_kinds(&self) -> Vec<ParameterKind> {
        let mut kinds = vec![ParameterKind::Number; self.parameters.len()];
        let mut set = |value: &CompiledExpression, kind: ParameterKind| {
            let name = value.name_or_number();
            let index = self.parameters.iter().position(|parameter| Some(&parameter.name) == name.as_ref());
            // A parameter that is both is what it is first.
            if let Some(known) = index.map(|index| &mut kinds[index]).filter(|known| **known == ParameterKind::Number) {
                *known = kind;
            }
        };
        let input_kind = |input: &InputValue| input.unit.map_or(ParameterKind::Length, ParameterKind::Angle);
        let ends = self.input.iter().flatten().chain(self.arc.iter().flat_map(|(ends, _)| ends));
        for input in self.start.iter().chain(ends) {
            set(&input.value, input_kind(input));
        }
        for joint in &self.joints {
            match &joint.kind {
                JointKindTemplate::Gear { ratio, phase, .. } => {
                    set(&phase.value, input_kind(phase));
                    ratio.iter().for_each(|ratio| set(ratio, ParameterKind::Ratio));
                }
                JointKindTemplate::Yoke { angle, .. } => set(&angle.value, input_kind(angle)),
                _ => {}
            }
            joint.kind.lengths().into_iter().for_each(|length| set(length, ParameterKind::Length));
        }
        kinds
    }
}

impl JointKindTemplate {
    /// The expressions of its lengths and coordinates.
    fn lengths(&self) -> Vec<&CompiledExpression> {
        match self {
            JointKindTemplate::Fixed(position) | JointKindTemplate::Grouped { at: position } => {
                position.iter().collect()
            }
            JointKindTemplate::Crank { length, .. } | JointKindTemplate::Gear { length, .. } => vec![length],
            JointKindTemplate::Piston { length, offset, .. } | JointKindTemplate::Slide { length, offset, .. } => {
                vec![length, offset]
            }
            JointKindTemplate::Rack { offset, radius, start, .. } => vec![radius, start, offset],
            JointKindTemplate::Dyad { lengths, .. } => lengths.iter().collect(),
            JointKindTemplate::Yoke { offset, .. }
            | JointKindTemplate::Slot { offset, .. }
            | JointKindTemplate::DrivenSlider { offset, .. } => vec![offset],
            JointKindTemplate::Distances { distances, .. } => distances.iter().collect(),
            JointKindTemplate::Point { along, across, .. } => {
                [along, across].into_iter().flat_map(Coordinate::ends).collect()
            }
            JointKindTemplate::Parallelogram { .. } => Vec::new(),
        }
    }
}
