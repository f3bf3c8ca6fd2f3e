//! A condition on four-bars and slider-cranks.

use super::guide::{Guide, PlacedSliderCrank};
use crate::condition::Condition;
use crate::four_bar::mechanism::Mechanism;
use coupler_curves::expression;

/// A condition in the language of `where`. It leaves out linkages that do not have its names.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseCondition {
    four_bar: Option<Condition>,
    slider_crank: Option<Condition>,
}

impl PoseCondition {
    /// Compiles a condition over the parameters of four-bars or of slider-cranks, and the measures.
    ///
    /// # Errors
    /// It is not a condition over the names of either; the error is that of four-bars.
    pub fn new(text: &str) -> Result<PoseCondition, expression::Error> {
        let slider_crank = Condition::new(&PlacedSliderCrank::template(), text).ok();
        match Condition::new(&Mechanism::template(), text) {
            Ok(four_bar) => Ok(PoseCondition { four_bar: Some(four_bar), slider_crank }),
            Err(error) if slider_crank.is_none() => Err(error),
            Err(_) => Ok(PoseCondition { four_bar: None, slider_crank }),
        }
    }

    /// Whether it has a meaning for slider-cranks, or else for four-bars.
    pub(super) fn is_of(&self, is_slider_crank: bool) -> bool {
        if is_slider_crank { self.slider_crank.is_some() } else { self.four_bar.is_some() }
    }

    /// The condition on a linkage; `None` if it has other names.
    pub(super) fn of(&self, guide: &Guide) -> Option<&Condition> {
        match guide {
            Guide::FourBar(_) => self.four_bar.as_ref(),
            Guide::SliderCrank(_) => self.slider_crank.as_ref(),
        }
    }
}
