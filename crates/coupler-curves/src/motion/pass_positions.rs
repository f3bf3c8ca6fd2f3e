//! Positions of all joints at given inputs of a pass.

use super::input_columns::InputColumns;
use super::pass::Pass;
use super::pass_ends::{place_at_end, place_near_ends};
use super::positions::{DyadSigns, JointPositions, convert_to_view_frame, place_leading_joints};
use crate::linkage::{DyadSet, Linkage};

/// The positions of all joints at inputs of a pass; at its ends exactly those of the sampled circuit.
pub(super) fn positions_at_inputs(linkage: &Linkage, pass: &Pass, inputs: &InputColumns) -> JointPositions {
    let values = inputs.values();
    let mut out = JointPositions::new(linkage.joints.len(), values.len());
    let signs = DyadSigns::new(pass.mode, DyadSet::EMPTY);
    place_leading_joints(linkage, linkage.joints.len(), inputs.as_slices(), &signs, &mut out, 0..values.len());
    place_near_ends(linkage, pass, inputs.as_slices(), &mut out, 0..values.len());
    for (i, &value) in values.iter().enumerate() {
        for (end, begins) in [(pass.from, true), (pass.to, false)] {
            if value == end.input.value && !end.flat_dyads.is_empty() {
                place_at_end(linkage, pass, begins, &mut out, i);
            }
        }
    }
    convert_to_view_frame(linkage, &mut out);
    out
}
