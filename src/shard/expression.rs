//! The expression by which curves are the best.

use coupler_curves::expression::{CompiledExpression, Expression, Kind};
use coupler_curves::family::Family;
use coupler_curves::measure;

use super::Error;
use crate::manifest::{Plan, PlannedFamily};

/// The expression in the names of each family of a plan; `None` in one that lacks a name, and in those that are not selected.
///
/// # Errors
/// It is an expression in no selected family.
pub(super) fn compile(
    plan: &Plan,
    is_selected: &dyn Fn(&String) -> bool,
    text: &str,
) -> Result<Vec<Option<CompiledExpression>>, Error> {
    let compile = |planned: &PlannedFamily| -> Result<CompiledExpression, String> {
        let family = &planned.family;
        let scope = Family::scope(&family.names, family.template.is_driven_by_length());
        let compiled = Expression::parse(text).and_then(|parsed| parsed.compile(&scope, Kind::Number));
        let compiled = compiled.map_err(|error| match (used_word(text), error.help.as_str()) {
            (Some(word), _) => format!("`{word}` is a word, and what is greatest must be a number"),
            (None, "") => error.to_string(),
            (None, help) => format!("{error}; {help}"),
        })?;
        let helpers = family.template.parameters.len()..family.names.len();
        match compiled.slots().iter().find(|slot| helpers.contains(slot)) {
            Some(slot) => Err(format!(
                "`{}` is neither a parameter of the linkage nor a measure, and tables do not have it",
                family.names[*slot]
            )),
            None => Ok(compiled),
        }
    };
    let (mut found, mut first_error) = (Vec::new(), None);
    for planned in &plan.families {
        let compiled = is_selected(&planned.family.id).then(|| compile(planned)).transpose();
        found.push(compiled.unwrap_or_else(|message| {
            first_error.get_or_insert(message);
            None
        }));
    }
    match first_error.filter(|_| found.iter().all(Option::is_none)) {
        Some(message) => Err(Error::Expression { text: text.to_owned(), message }),
        None => Ok(found),
    }
}

/// The first name in an expression that is that of a measure whose values are words.
fn used_word(text: &str) -> Option<&str> {
    let mut names = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    names.find(|name| measure::ALL.iter().any(|measure| measure.is_word && measure.name == *name))
}
