//! The requirements of a design, and their checks.

use super::kind::{DrivenLinkage, Driver, LinkageKind, P_RANGE};

/// The requirements of a designer.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirements {
    /// The driver; any if `None`.
    pub input: Option<Driver>,
    /// Whether the curve must cross itself, or must not; either if `None`.
    pub double_point: Option<bool>,
    /// Whether the return must take less of a turn than the straight stroke.
    pub quick_return: bool,
    /// The frame over the unit link: the crank of Evans's and Hoeken's linkages, the coupler of the others.
    pub p: Option<f64>,
    /// The length of the straight portion.
    pub length: Option<f64>,
    /// The width of its strip over its length.
    pub tolerance: f64,
    /// The greatest distance between any two positions of its joints: over a whole turn if a motor drives, over the
    /// straight stroke if a rocker does.
    pub size: Option<f64>,
    /// The least transmission angle in degrees, over the same motion; of an angle over 90 the supplement counts.
    pub mu_min: f64,
    /// The linkages to choose from.
    pub kinds: Vec<LinkageKind>,
    /// The greatest number of designs.
    pub max_designs: usize,
}

impl Default for Requirements {
    /// A line straight to a thousandth of its length, a transmission angle of 20° at least, and up to five designs.
    fn default() -> Requirements {
        Requirements {
            input: None,
            double_point: None,
            quick_return: false,
            p: None,
            length: None,
            tolerance: 0.001,
            size: None,
            mu_min: 20.0,
            kinds: LinkageKind::ALL.to_vec(),
            max_designs: 5,
        }
    }
}

/// A requirement that can be relaxed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Requirement {
    /// [`Requirements::input`].
    Input,
    /// [`Requirements::double_point`].
    DoublePoint,
    /// [`Requirements::quick_return`].
    QuickReturn,
    /// [`Requirements::p`].
    P,
    /// [`Requirements::length`].
    Length,
    /// [`Requirements::tolerance`].
    Tolerance,
    /// [`Requirements::size`].
    Size,
    /// [`Requirements::mu_min`].
    MuMin,
    /// [`Requirements::kinds`].
    Kinds,
}

/// The least and the greatest tolerance. The least is a thousandth of a millimetre to either side of a line of 100 mm;
/// the samples of a curve do not resolve less. Above the greatest a curve cannot be called straight.
pub const TOLERANCE_RANGE: [f64; 2] = [2e-5, 0.1];

impl Requirements {
    /// The invalid requirements, each with a message.
    pub fn errors(&self) -> Vec<(Requirement, String)> {
        let mut errors = Vec::new();
        let mut check_range = |requirement, value: f64, [least, most]: [f64; 2], explanation: &str| {
            if !(least..=most).contains(&value) {
                errors.push((requirement, format!("{value} is not from {least} to {most}{explanation}")));
            }
        };
        check_range(Requirement::Tolerance, self.tolerance, TOLERANCE_RANGE, ", the strip's width over the length");
        let lengths = [(Requirement::Length, self.length), (Requirement::Size, self.size)];
        for (requirement, length) in lengths {
            check_range(requirement, length.unwrap_or(1.0), [1e-9, 1e9], "");
        }
        check_range(Requirement::P, self.p.unwrap_or(2.0), P_RANGE, ": the frame is longer than the unit link");
        check_range(Requirement::MuMin, self.mu_min, [0.0, 89.0], " deg: at 90 the linkage cannot move");
        if let (Some(length), Some(size)) = (self.length, self.size)
            && length >= size
        {
            errors.push((Requirement::Size, format!("{size} is not greater than the straight length, {length}")));
        }
        if self.kinds.is_empty() {
            errors.push((Requirement::Kinds, "no linkage is selected".to_owned()));
        }
        errors
    }

    /// The ratio of straight length to size, if both are given.
    pub(super) fn length_to_size(&self) -> Option<f64> {
        Some(self.length? / self.size?)
    }

    /// The linkages and drivers to choose from.
    pub(super) fn driven_linkages(&self) -> impl Iterator<Item = DrivenLinkage> + '_ {
        let is_allowed =
            |a: &DrivenLinkage| self.kinds.contains(&a.kind) && self.input.is_none_or(|input| a.input == input);
        DrivenLinkage::ALL.into_iter().filter(is_allowed)
    }
}
