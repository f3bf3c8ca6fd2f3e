use super::kind::{DrivenLinkage, Driver, LinkageKind};

/// What a designer wants.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirements {
    /// What is to move it; anything if `None`.
    pub input: Option<Driver>,
    /// Whether the curve is to cross itself; as it comes if `None`.
    pub double_point: Option<bool>,
    /// Whether the way back is to take less of a turn than the straight stroke.
    pub quick_return: bool,
    /// The frame over the unit link: the crank of Evans's and Hoeken's linkages, the coupler of the others.
    pub p: Option<f64>,
    /// The length of the straight portion.
    pub length: Option<f64>,
    /// The width of its strip over its length.
    pub tolerance: f64,
    /// The greatest distance two places of its joints may have: over a whole turn where a motor drives, over the straight
    /// stroke where a rocker does.
    pub size: Option<f64>,
    /// The least transmission angle in degrees, over the same motion; an angle over 90 counts as its supplement.
    pub mu_min: f64,
    /// The linkages to choose from.
    pub kinds: Vec<LinkageKind>,
    /// How many are wanted.
    pub max_designs: usize,
}

impl Default for Requirements {
    /// Nothing but a line straight to a thousandth.
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

/// A wish that can be changed.
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

/// The least and the greatest of a tolerance. The first is a thousandth of a millimetre to either side of a line of 100 mm:
/// what is finer the samples of a curve do not tell; above the second nothing is straight.
pub const TOLERANCE_RANGE: [f64; 2] = [2e-5, 0.1];

/// The least and the greatest of `p`.
pub const P_RANGE: [f64; 2] = [1.02, 12.0];

impl Requirements {
    /// What is wrong with them: the wish, and why.
    pub fn errors(&self) -> Vec<(Requirement, String)> {
        let mut found = Vec::new();
        let mut between = |wish, value: f64, [least, most]: [f64; 2], why: &str| {
            if !(least..=most).contains(&value) {
                found.push((wish, format!("{value} is not from {least} to {most}{why}")));
            }
        };
        between(Requirement::Tolerance, self.tolerance, TOLERANCE_RANGE, ", the strip's width over the length");
        let lengths = [(Requirement::Length, self.length), (Requirement::Size, self.size)];
        for (wish, length) in lengths {
            between(wish, length.unwrap_or(1.0), [1e-9, 1e9], "");
        }
        between(
            Requirement::P,
            self.p.unwrap_or(2.0),
            P_RANGE,
            ": the frame is longer than the link it is measured by",
        );
        between(Requirement::MuMin, self.mu_min, [0.0, 89.0], " deg: at 90 nothing moves");
        if let (Some(length), Some(size)) = (self.length, self.size)
            && length >= size
        {
            found.push((Requirement::Size, format!("{size} is not more than the straight length, {length}")));
        }
        if self.kinds.is_empty() {
            found.push((Requirement::Kinds, "no linkage is left to choose from".to_owned()));
        }
        found
    }

    /// The part of the size that the straight length is to be, where both are given.
    pub(super) fn length_to_size(&self) -> Option<f64> {
        Some(self.length? / self.size?)
    }

    /// The arrangements to choose from.
    pub(super) fn driven_linkages(&self) -> impl Iterator<Item = DrivenLinkage> + '_ {
        let is_wanted =
            |a: &DrivenLinkage| self.kinds.contains(&a.kind) && self.input.is_none_or(|input| a.input == input);
        DrivenLinkage::ALL.into_iter().filter(is_wanted)
    }
}
