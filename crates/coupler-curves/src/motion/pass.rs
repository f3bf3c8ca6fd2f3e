//! Passes, and the values of the input at which they begin and end.

use super::group::GroupTrack;
use crate::geometry::trig;
use crate::linkage::{AssemblyMode, DyadSet, Input, JointKind, Linkage};

/// A value of the input: an angle with its cosine and sine, which are more exact than the angle at a limit, or a
/// length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputPosition {
    /// The angle in degrees, continuous along a circuit, or the length.
    pub value: f64,
    /// The cosine of the angle; 0 for a length.
    pub cos: f64,
    /// The sine of the angle; 0 for a length.
    pub sin: f64,
}

impl InputPosition {
    /// The input at an angle in degrees.
    pub fn from_degrees(deg: f64) -> InputPosition {
        let (cos, sin) = trig::cos_sin_deg(deg);
        InputPosition { value: deg, cos, sin }
    }

    /// The input at a value: an angle in degrees or a length, whichever a linkage's input is.
    pub fn new(input: Input, value: f64) -> InputPosition {
        match input {
            Input::Angle { .. } => InputPosition::from_degrees(value),
            Input::Length => InputPosition { value, cos: 0.0, sin: 0.0 },
        }
    }
}

/// The beginning or the end of a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassEnd {
    /// The input there.
    pub input: InputPosition,
    /// The dyads that are flat there, at a limit or a change point, and those whose bases vanish; none at the end of a range or a
    /// period.
    pub flat_dyads: DyadSet,
    /// Those of them whose bases vanish there: their joints are placed by continuity along the pass.
    pub vanishing_dyads: DyadSet,
}

/// A part of a circuit on which the input is monotonic and the assembly mode is constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Its beginning.
    pub from: PassEnd,
    /// Its end.
    pub to: PassEnd,
    /// The assembly mode.
    pub mode: AssemblyMode,
    /// The poses of the joints that no dyads place, if there are any.
    pub track: Option<GroupTrack>,
}

/// How a linkage moves before or after an end of a pass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heading {
    pub mode: AssemblyMode,
    /// Whether the input rises.
    pub rises: bool,
}

impl PassEnd {
    /// An end at which no dyad is flat.
    pub fn regular(input: InputPosition) -> PassEnd {
        PassEnd { input, flat_dyads: DyadSet::EMPTY, vanishing_dyads: DyadSet::EMPTY }
    }

    /// Whether the dyad of a joint is extended or folded there. A slider or a slot on a line whose joints coincide is among the
    /// `flat_dyads` for the direction of its line only.
    pub fn is_extended_or_folded(&self, kind: JointKind) -> bool {
        let is_on_line = matches!(kind, JointKind::Slide { .. } | JointKind::Slot { .. });
        let flat = if is_on_line { self.flat_dyads.without(self.vanishing_dyads) } else { self.flat_dyads };
        kind.dyad().is_some_and(|dyad| flat.contains(dyad))
    }

    /// The names of the joints whose dyads are extended or folded there.
    pub fn flat_joints<'a>(&self, linkage: &'a Linkage) -> Vec<&'a str> {
        let flat = linkage.joints.iter().filter(|joint| self.is_extended_or_folded(joint.kind));
        flat.map(|joint| joint.name.as_str()).collect()
    }
}

impl Pass {
    /// Its ends: each with 1 where the pass lies at greater inputs, -1 where it lies at smaller ones.
    pub(super) fn ends(&self) -> [(PassEnd, f64); 2] {
        [(self.from, self.input_direction()), (self.to, -self.input_direction())]
    }

    /// 1 where the input rises, -1 where it falls.
    pub fn input_direction(&self) -> f64 {
        if self.to.input.value >= self.from.input.value { 1.0 } else { -1.0 }
    }

    /// The range of the input, in degrees or in units of length.
    pub fn input_length(&self) -> f64 {
        (self.to.input.value - self.from.input.value).abs()
    }

    /// The least and the greatest input on it.
    pub fn input_range(&self) -> [f64; 2] {
        [self.from.input.value.min(self.to.input.value), self.from.input.value.max(self.to.input.value)]
    }

    pub(super) fn reversed(&self) -> Pass {
        Pass { from: self.to, to: self.from, ..self.clone() }
    }

    pub(super) fn shifted(&self, deg: f64) -> Pass {
        let shift =
            |end: PassEnd| PassEnd { input: InputPosition { value: end.input.value + deg, ..end.input }, ..end };
        let track = self.track.as_ref().map(|track| track.shifted(deg));
        Pass { from: shift(self.from), to: shift(self.to), mode: self.mode, track }
    }
}
