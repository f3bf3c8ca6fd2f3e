//! The side of a joint that has two places.

use super::Side;
use crate::expression::CompiledExpression;

/// The side on which a joint is at the start.
#[derive(Clone, Debug, PartialEq)]
pub enum SideTemplate {
    /// This one.
    Given(Side),
    /// That of a drawn pose, by the sine of the angle between the two lines through the joint, or the cosine of that to a line on which it slides:
    /// [`Side::Left`] where it is positive, [`Side::Right`] where it is negative.
    Drawn(CompiledExpression),
}

impl SideTemplate {
    /// In a drawing in which a joint is flatter than this its side is a matter of rounding.
    const FLAT: f64 = 1e-9;

    /// The side, if it is the same for all parameters.
    pub(super) fn constant(&self) -> Option<Side> {
        match self {
            SideTemplate::Drawn(sine) if sine.constant_value().is_none() => None,
            side => side.evaluate(|sine| sine.evaluate(|_| f64::NAN)),
        }
    }

    /// The side, with expressions evaluated by `number`; `None` if the joint is flat, where its side is not known.
    pub(crate) fn evaluate(&self, number: impl FnOnce(&CompiledExpression) -> f64) -> Option<Side> {
        match self {
            SideTemplate::Given(side) => Some(*side),
            SideTemplate::Drawn(sine) => match number(sine) {
                sine if sine > SideTemplate::FLAT => Some(Side::Left),
                sine if sine < -SideTemplate::FLAT => Some(Side::Right),
                _ => None,
            },
        }
    }
}

impl From<Side> for SideTemplate {
    fn from(side: Side) -> SideTemplate {
        SideTemplate::Given(side)
    }
}
