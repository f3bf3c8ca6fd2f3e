//! The expression by which curves are the best: as in `sort`, the least value comes first.

use coupler_curves::expression::{CompiledExpression, Expression, Kind};
use coupler_curves::family::Family;
use coupler_curves::measure::{self, Measure, MeasureSet};

use super::Error;
use super::direction::has_worst_first;
use crate::manifest::{Plan, PlannedFamily};

/// By what the curves of a family are the best.
#[derive(Clone, Debug)]
pub(super) struct Criterion {
    /// The expression as it is written.
    pub text: String,
    /// It in the names of the family; `None` if the family lacks one of them, so that it has no best.
    pub expression: Option<CompiledExpression>,
}

/// The criterion of each family of a plan, in their order: `by`, or else its own `sort`; `None` for those that are not selected.
///
/// # Errors
/// `by` is an expression in no selected family, or [`check_direction`] refuses it; without it, a selected family has no `sort` that tables
/// have the names of.
pub(super) fn criteria(
    plan: &Plan,
    is_selected: &dyn Fn(&String) -> bool,
    by: Option<&str>,
) -> Result<Vec<Option<Criterion>>, Error> {
    let selected = plan.families.iter().map(|planned| is_selected(&planned.family.id).then_some(planned));
    let Some(by) = by.map(str::trim) else {
        return selected.map(|planned| planned.map(own_criterion).transpose()).collect();
    };
    check_direction(by)?;
    let (mut found, mut first_error) = (Vec::new(), None);
    for planned in selected {
        let compiled =
            planned.map(|planned| compile(planned, by).map_err(|error| first_error.get_or_insert(error)).ok());
        found.push(compiled.map(|expression| Criterion { text: by.to_owned(), expression }));
    }
    match first_error.filter(|_| found.iter().flatten().all(|criterion| criterion.expression.is_none())) {
        Some(message) => Err(Error::by(by, message)),
        None => Ok(found),
    }
}

/// The criterion of a family by its own `sort`.
///
/// # Errors
/// It has none, or tables lack a name in it.
pub(super) fn own_criterion(planned: &PlannedFamily) -> Result<Criterion, Error> {
    let id = &planned.family.id;
    let error = |message| Error::Expression { origin: format!("`{id}`"), message };
    let Some(text) = &planned.sort else {
        let message = "it has no `sort`: say with --by what is least for the best curves, as in --by -straight_length for the greatest \
                       straight_length";
        return Err(error(message.to_owned()));
    };
    let compiled = compile(planned, text);
    let expression = compiled
        .map_err(|message| error(format!("its `sort`, `{text}`: {message}; give --by in names that tables have")))?;
    Ok(Criterion { text: text.clone(), expression: Some(expression) })
}

/// An expression in the names of a family.
///
/// # Errors
/// It is none, or tables lack a name in it, as a clause.
pub(super) fn compile(planned: &PlannedFamily, text: &str) -> Result<CompiledExpression, String> {
    let family = &planned.family;
    let scope = Family::scope(&family.names, family.template.is_driven_by_length());
    let compiled = Expression::parse(text).and_then(|parsed| parsed.compile(&scope, Kind::Number));
    let compiled = compiled.map_err(|error| match used_word(text) {
        Some(word) => format!("`{word}` is a word, and what is least must be a number"),
        None => error.message_with_help(),
    })?;
    let helpers = family.template.parameters.len()..family.names.len();
    match compiled.slots().iter().find(|slot| helpers.contains(slot)) {
        Some(slot) => Err(format!(
            "`{}` is neither a parameter of the linkage nor a measure, and tables do not have it",
            family.names[*slot]
        )),
        None => Ok(compiled),
    }
}

/// Checks that an expression that grows with a measure of which more is better begins with a sign: it would have the worst first, where
/// earlier versions had the best.
///
/// # Errors
/// It does not.
pub(super) fn check_direction(by: &str) -> Result<(), Error> {
    if !has_worst_first(by) {
        return Ok(());
    }
    let with_sign = |sign: char| match Measure::find(by) {
        Some(_) => format!("--by {sign}{by}"),
        None => format!("--by \"{sign}({by})\""),
    };
    let [minus, plus] = ['-', '+'].map(with_sign);
    let message = format!(
        "it runs as `sort` now, the least value first: write `{minus}` for the greatest, or `{plus}` for the least"
    );
    Err(Error::by(by, message))
}

/// Whether an expression has one value for all joints that are traced on a circuit.
pub(super) fn is_of_circuits(family: &Family, expression: &CompiledExpression) -> bool {
    (family.measures_in(expression) & MeasureSet::OF_PATHS).is_empty()
}

/// The first name in an expression that is that of a measure whose values are words.
fn used_word(text: &str) -> Option<&str> {
    let mut names = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    names.find(|name| measure::ALL.iter().any(|measure| measure.is_word && measure.name == *name))
}
