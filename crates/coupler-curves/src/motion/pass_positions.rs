//! Positions of all joints at given inputs of a pass.

use std::ops::Range;

use super::input_columns::{InputColumns, InputSlices};
use super::pass::Pass;
use super::pass_ends::{place_at_end, place_near_ends};
use super::positions::{DyadSigns, JointPositions, convert_to_view_frame, place_leading_joints};
use crate::linkage::{DyadSet, Linkage};

/// The positions of all joints at inputs of a pass; at its ends exactly those of the sampled circuit.
pub(super) fn positions_at_inputs(linkage: &Linkage, pass: &Pass, inputs: &InputColumns) -> JointPositions {
    let values = inputs.values();
    let mut out = JointPositions::new(linkage.joints.len(), values.len());
    place_on_pass(linkage, pass, inputs.as_slices(), &mut out, 0..values.len());
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

/// Places every joint at a range of samples of a pass, each with its input, in the frame of the fixed joints.
pub(super) fn place_on_pass(
    linkage: &Linkage,
    pass: &Pass,
    inputs: InputSlices,
    out: &mut JointPositions,
    range: Range<usize>,
) {
    if let Some(track) = &pass.track {
        for (sample, input) in range.clone().zip(inputs.values) {
            track.positions(*input, |(joint, at)| out.set_point(joint, sample, at));
        }
    }
    let signs = DyadSigns::new(pass.mode, DyadSet::EMPTY);
    place_leading_joints(linkage, linkage.joints.len(), inputs, &signs, out, range.clone());
    place_near_ends(linkage, pass, inputs, out, range);
}
