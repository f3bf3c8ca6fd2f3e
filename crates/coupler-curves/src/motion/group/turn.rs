//! The circuit of a full turn of a group that is not proven, and the passes of linkages that differ little: for searches.

use super::equations::Equations;
use super::track::GroupTrack;
use super::turn_poses::Turn;
use crate::linkage::{DyadId, Input, Linkage, Side};
use crate::motion::circuit::UnsampledCircuit;
use crate::motion::input_columns::InputColumns;
use crate::motion::interval::{Interval, Span};
use crate::motion::pass::Pass;

/// The circuit on which the input of a linkage with a group turns fully, once around, from the start pose; `None` if it does not, or the linkage has no
/// group, or a range of the input. It is not proven: where two circuits are very close, a step may lead from one to the other. Its poses are exact to
/// a millionth of the linkage's size, most to far less.
pub fn follow_full_turn(linkage: &Linkage) -> Option<UnsampledCircuit> {
    let group = linkage.group.as_ref().filter(|_| linkage.motion_options.range.is_none())?;
    let Input::Angle { turns: 1 } = linkage.input() else { return None };
    let equations = Equations::new(linkage, group)?;
    let start_input = linkage.motion_options.start.unwrap_or(0.0);
    let origin = equations.start(group, start_input).ok()?;
    let track = Some(GroupTrack::of_turn(Turn::from(equations, origin.state)?));
    let mode = linkage.motion_options.mode.with_side(DyadId::FIRST, Side::Left);
    let turn = Interval { span: Span::FullTurn, mode, track };
    Some(UnsampledCircuit { passes: vec![turn.to_pass(true, linkage.input().period())], is_closed: true })
}

impl Pass {
    /// The same pass of a linkage that differs little, which is followed from this one if it has a group: only a full turn of one can be. `None` if it
    /// cannot, or has another group.
    pub fn of_neighbour(&self, linkage: &Linkage) -> Option<Pass> {
        let Some(group) = &linkage.group else { return Some(self.clone()) };
        let track = self.track.as_ref()?.of_neighbour(Equations::new(linkage, group)?)?;
        Some(Pass { track: Some(track), ..self.clone() })
    }

    /// The same pass, from which the neighbours of a linkage with a group are found sooner at these inputs.
    pub fn based_at(&self, inputs: &InputColumns) -> Pass {
        Pass { track: self.track.as_ref().map(|track| track.based_at(inputs.values())), ..self.clone() }
    }
}
