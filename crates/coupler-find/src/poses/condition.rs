//! A condition on four-bars, slider-cranks and inverted slider-cranks.

use super::guide::{Form, Guide};
use crate::condition::Condition;
use coupler_curves::expression::{self, CompiledExpression};
use coupler_curves::template::Template;

/// A condition in the language of `where`. It leaves out linkages that do not have its names.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseCondition {
    /// Of each form, where it has a meaning.
    of_forms: [Option<OwnCondition>; Form::ALL.len()],
}

/// A condition on linkages of one kind.
#[derive(Clone, Debug)]
struct OwnCondition {
    whole: Condition,
    /// The parts that all must be true and need no solved linkage.
    of_parameters: Vec<CompiledExpression>,
}

impl PartialEq for OwnCondition {
    fn eq(&self, other: &OwnCondition) -> bool {
        self.whole == other.whole
    }
}

impl OwnCondition {
    fn new(template: &Template, text: &str) -> Result<OwnCondition, expression::Error> {
        let whole = Condition::new(template, text)?;
        // The parameters are the first names of the scope.
        let count = template.parameters.len();
        let needs_parameters = |part: &CompiledExpression| part.slots().iter().all(|slot| *slot < count);
        let of_parameters = whole.compiled().conjuncts().into_iter().filter(needs_parameters).collect();
        Ok(OwnCondition { whole, of_parameters })
    }
}

impl PoseCondition {
    /// Compiles a condition over the parameters of four-bars, of slider-cranks or of inverted ones, and the measures.
    ///
    /// # Errors
    /// It is not a condition over the names of any; the error is that of four-bars.
    pub fn new(text: &str) -> Result<PoseCondition, expression::Error> {
        let compiled = Form::ALL.map(|form| OwnCondition::new(&form.template(), text));
        match compiled {
            [Err(error), Err(_), Err(_)] => Err(error),
            compiled => Ok(PoseCondition { of_forms: compiled.map(Result::ok) }),
        }
    }

    /// Whether it has a meaning for the linkages of a form.
    pub(super) fn is_of(&self, form: Form) -> bool {
        self.of_forms[form as usize].is_some()
    }

    /// The condition on a linkage; `None` if it has other names.
    pub(super) fn of(&self, guide: &Guide) -> Option<&Condition> {
        self.own(guide).map(|own| &own.whole)
    }

    /// Whether the parameters of a linkage satisfy what depends on nothing else.
    pub(super) fn admits(&self, guide: &Guide) -> bool {
        let Some(own) = self.own(guide) else { return false };
        let values = guide.parameters();
        own.of_parameters.iter().all(|part| part.evaluate(|slot| values[slot].1) == 1.0)
    }

    fn own(&self, guide: &Guide) -> Option<&OwnCondition> {
        self.of_forms[guide.form() as usize].as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::{Point, Vector};
    use coupler_curves::linkage::{FourBar, PlacedFourBar};

    #[test]
    fn parameters_are_asked_before_a_linkage_is_solved() {
        let guide = Guide::FourBar(PlacedFourBar {
            pivots: [Point::origin(), Point::new(4.0, 0.0)],
            lengths: FourBar { frame: 4.0, crank: 1.5, coupler: 3.0, rocker: 3.5 },
            coupler_point: Vector::new(2.0, 1.0),
        });
        for (text, expected) in [
            ("frame > 3 and mu_worst_deg > 89", true),
            ("frame > 5 and mu_worst_deg > 0", false),
            ("frame > 5 or mu_worst_deg > 0", true),
            ("offset > 0", false),
            ("frame > offset", false),
            ("across == 1 and turn == 0 and along > x", true),
        ] {
            assert_eq!(PoseCondition::new(text).unwrap().admits(&guide), expected, "{text}");
        }
        assert!(PoseCondition::new("rocker > offset").is_err());
    }
}
