//! What is wished of a linkage: conditions to be met, and expressions to be as great or as small as possible.

use coupler_curves::expression::{self, Comparison, CompiledExpression, Expression, Kind, Relation};
use coupler_curves::family::Family;
use coupler_curves::measure::{BOOLEANS, Measure, MeasureSet, parse_condition};
use coupler_curves::template::Template;

/// Whether an expression is to be great or small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// As great as possible.
    Greatest,
    /// As small as possible.
    Least,
}

/// A condition that a linkage must meet.
#[derive(Clone, Debug)]
pub struct Wish {
    pub(super) condition: CompiledExpression,
    pub(super) comparison: Option<Comparison>,
    pub(super) measures: MeasureSet,
}

/// An expression that is to be as great or as small as possible.
#[derive(Clone, Debug)]
pub struct Goal {
    /// Its text.
    pub text: String,
    /// What it is to be.
    pub direction: Direction,
    pub(super) expression: CompiledExpression,
    pub(super) measures: MeasureSet,
}

/// All that is wished of a linkage.
#[derive(Clone, Debug)]
pub struct Wishes {
    /// The conditions.
    pub wishes: Vec<Wish>,
    /// The goals; of several, answers are those that no other one exceeds in all.
    pub goals: Vec<Goal>,
    /// The greatest distance of two joints of a link, in the unit of the linkage; may be infinite.
    pub max_link: f64,
}

/// Why wishes cannot be searched for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WishError {
    /// The text of the conditions or of a goal is no expression of the known names.
    #[error("`{text}`: {message}")]
    Expression {
        /// The text.
        text: String,
        /// What is wrong with it.
        message: String,
    },
    /// A measure is not defined for the linkage.
    #[error(
        "`{linkage}` has no `{name}`, which is defined for {subject} only; `coupler-atlas list measures` lists all"
    )]
    Inapplicable {
        /// The linkage.
        linkage: String,
        /// The name.
        name: String,
        /// The linkages that have it.
        subject: &'static str,
    },
    /// Two conditions exclude each other.
    #[error("`{first}` and `{second}` exclude each other; leave one out")]
    Contradiction {
        /// One of them.
        first: String,
        /// The other one.
        second: String,
    },
    /// A condition does not depend on the linkage.
    #[error("`{0}` is the same for all linkages; compare a measure or a parameter")]
    Constant(String),
    /// Neither a condition nor a goal is given.
    #[error("nothing is wished; give a condition or a goal")]
    None,
}

/// What a value without a tolerance may differ from the one that it is to be equal to, relative to the greater one.
pub(super) const RELATIVE_TOLERANCE: f64 = 1e-4;

impl Wishes {
    /// Compiles conditions that are joined by `and`, over the parameters of a linkage and the measures, and goals over the same names.
    ///
    /// # Errors
    /// Every text that is not an expression of these names, and each measure that the linkage has not; conditions that exclude each other;
    /// or that nothing is wished.
    pub fn new(
        template: &Template,
        conditions: Option<&str>,
        goals: &[(Direction, String)],
        max_link: f64,
    ) -> Result<Wishes, Vec<WishError>> {
        let names: Vec<String> = template.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let scope = Family::scope(&names, template.is_driven_by_length());
        let measures_in = |expression: &CompiledExpression| Family::measures_of(expression, names.len());
        let mut errors = Vec::new();
        let mut compile = |text: &str, parsed: Result<Expression, expression::Error>, kind| {
            let expression = parsed.and_then(|expression| Ok((expression.compile(&scope, kind)?, expression)));
            match expression {
                Ok((compiled, expression)) => {
                    let inapplicable =
                        expression.names().iter().filter_map(|name| inapplicable(template, &names, name));
                    errors.extend(inapplicable);
                    Some(compiled)
                }
                Err(error) => {
                    let message = error.message_with_help();
                    errors.push(WishError::Expression { text: text.to_owned(), message });
                    None
                }
            }
        };
        let all = conditions.and_then(|text| compile(text, parse_condition(text), Kind::Boolean));
        let goal = |(direction, text): &(Direction, String)| {
            let expression = compile(text, Expression::parse(text), Kind::Number)?;
            let measures = measures_in(&expression);
            Some(Goal { text: text.clone(), direction: *direction, expression, measures })
        };
        let goals: Vec<Goal> = goals.iter().filter_map(goal).collect();
        let wish = |condition: CompiledExpression| {
            let measures = measures_in(&condition);
            Wish { comparison: condition.comparison(), condition, measures }
        };
        let wishes: Vec<Wish> = all.iter().flat_map(CompiledExpression::conjuncts).map(wish).collect();
        let constant = wishes.iter().filter(|wish| wish.condition.slots().is_empty());
        errors.extend(constant.map(|wish| WishError::Constant(wish.text())));
        errors.extend(contradictions(&wishes));
        if errors.is_empty() && wishes.is_empty() && goals.is_empty() {
            errors.push(WishError::None);
        }
        if errors.is_empty() { Ok(Wishes { wishes, goals, max_link }) } else { Err(errors) }
    }

    /// The measures that conditions and goals use.
    pub(super) fn measures(&self) -> MeasureSet {
        let of_wishes = self.wishes.iter().map(|wish| wish.measures);
        of_wishes.chain(self.goals.iter().map(|goal| goal.measures)).fold(MeasureSet::EMPTY, |all, one| all | one)
    }
}

impl Wish {
    /// The condition as it is set in a message.
    pub fn text(&self) -> String {
        self.condition.message_text()
    }

    /// Whether two numbers are to be equal.
    pub(super) fn is_equality(&self) -> bool {
        matches!(&self.comparison, Some(Comparison { relation: Relation::Equal { .. }, .. }))
    }

    /// By how much the condition is not met, with the values of names: of numbers that are to be equal the difference, otherwise positive
    /// where it is not met and negative where it is. Of a condition that is no comparison 1 or -1; NaN where a value is missing.
    pub(super) fn excess(&self, load: impl Fn(usize) -> f64) -> f64 {
        match &self.comparison {
            Some(Comparison { left, right, relation }) => {
                let difference = left.evaluate(&load) - right.evaluate(&load);
                if *relation == Relation::AtLeast { -difference } else { difference }
            }
            None if self.condition.evaluate(load) == 1.0 => -1.0,
            None => 1.0,
        }
    }

    /// Whether it is met; equal numbers are to their tolerance.
    pub(super) fn is_met(&self, load: impl Fn(usize) -> f64) -> bool {
        match &self.comparison {
            Some(Comparison { left, right, relation: Relation::Equal { tolerance: None } }) => {
                let [left, right] = [left, right].map(|side| side.evaluate(&load));
                (left - right).abs() <= RELATIVE_TOLERANCE * left.abs().max(right.abs())
            }
            _ => self.condition.evaluate(load) == 1.0,
        }
    }

    /// The side that depends on the linkage, and whether the other one does not; `None` of a condition that is no comparison.
    pub(super) fn subject(&self) -> Option<&CompiledExpression> {
        let Comparison { left, right, .. } = self.comparison.as_ref()?;
        Some(if left.slots().is_empty() { right } else { left })
    }

    /// The number that the other side is, if it is one.
    pub fn bound(&self) -> Option<f64> {
        let Comparison { left, right, .. } = self.comparison.as_ref()?;
        [left, right].into_iter().find(|side| side.slots().is_empty()).map(|side| side.evaluate(|_| f64::NAN))
    }

    /// The subject's text and its bounds, if the other side is a number.
    fn bounds(&self) -> Option<(String, [f64; 2])> {
        let Comparison { left, right, relation } = self.comparison.as_ref()?;
        let number = |side: &CompiledExpression| side.slots().is_empty().then(|| side.evaluate(|_| f64::NAN));
        let (subject, bound, is_swapped) = match (number(left), number(right)) {
            (None, Some(bound)) => (left, bound, false),
            (Some(bound), None) => (right, bound, true),
            _ => return None,
        };
        let bounds = match relation {
            Relation::Equal { tolerance } => {
                let tolerance = tolerance
                    .as_ref()
                    .map_or(RELATIVE_TOLERANCE * bound.abs(), |tolerance| tolerance.evaluate(|_| f64::NAN));
                [bound - tolerance, bound + tolerance]
            }
            Relation::AtLeast if !is_swapped => [bound, f64::INFINITY],
            Relation::AtMost if is_swapped => [bound, f64::INFINITY],
            _ => [f64::NEG_INFINITY, bound],
        };
        Some((subject.message_text(), bounds))
    }
}

/// The error of a name that is a measure which a linkage has not.
fn inapplicable(template: &Template, own: &[String], name: &str) -> Option<WishError> {
    if own.iter().any(|parameter| parameter == name) {
        return None;
    }
    let boolean = BOOLEANS.iter().find(|boolean| boolean.name == name);
    let subject = Measure::find(boolean.map_or(name, |boolean| boolean.measure))?.subject;
    let structure = template.structure().ok()?;
    (!subject.includes(&structure)).then(|| WishError::Inapplicable {
        linkage: template.id.clone(),
        name: name.to_owned(),
        subject: subject.description(),
    })
}

/// The pairs of bounds of the same number between which there is nothing.
fn contradictions(wishes: &[Wish]) -> Vec<WishError> {
    let bounds: Vec<(&Wish, String, [f64; 2])> =
        wishes.iter().filter_map(|wish| wish.bounds().map(|(subject, bounds)| (wish, subject, bounds))).collect();
    let pairs = bounds.iter().enumerate().flat_map(|(k, one)| bounds[k + 1..].iter().map(move |other| (one, other)));
    let excluding = pairs.filter(|((_, subject, [low, high]), (_, other, [from, to]))| {
        subject == other && low.max(*from) > high.min(*to)
    });
    excluding
        .map(|((first, ..), (second, ..))| WishError::Contradiction { first: first.text(), second: second.text() })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::catalogue;

    fn messages(linkage: &str, conditions: &str, goals: &[&str]) -> Vec<String> {
        let template = catalogue::find(linkage).unwrap();
        let goals: Vec<_> = goals.iter().map(|goal| (Direction::Greatest, (*goal).to_owned())).collect();
        let conditions = Some(conditions).filter(|text| !text.is_empty());
        match Wishes::new(&template, conditions, &goals, f64::INFINITY) {
            Ok(_) => Vec::new(),
            Err(errors) => errors.iter().map(ToString::to_string).collect(),
        }
    }

    #[test]
    fn all_that_is_wrong_is_said_at_once() {
        let found = messages("slider-crank", "class == 2 and mu_wurst_deg > 3", &["six_bar", "output_swing_deg"]);
        assert_eq!(found.len(), 3, "{found:?}");
        let found = messages("slider-crank", "output_swing_deg > 3 and is_crank_rocker", &[]);
        assert!(found[0].starts_with("`slider-crank` has no `output_swing_deg`, which is defined for "), "{found:?}");
        assert_eq!(found.len(), 2);
        assert_eq!(messages("four-bar", "", &[]), ["nothing is wished; give a condition or a goal"]);
        assert_eq!(messages("four-bar", "1 < 2 and mu_worst_deg > 3", &[]).len(), 1);
    }

    #[test]
    fn bounds_that_exclude_each_other_are_named() {
        for (conditions, count) in [
            ("mu_worst_deg >= 50 and mu_worst_deg <= 40", 1),
            ("50 <= mu_worst_deg and mu_worst_deg == 40 +- 5", 1),
            ("50 <= mu_worst_deg and mu_worst_deg == 45 +- 5", 0),
            ("2 * frame > 50 and frame < 1", 0),
            ("time_ratio == 1.2 and time_ratio == 1.3 and time_ratio > 1", 1),
        ] {
            assert_eq!(
                messages("hrones-nelson", &conditions.replace("frame", "area"), &[]).len(),
                count,
                "{conditions}"
            );
        }
    }
}
