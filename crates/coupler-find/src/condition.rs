//! A condition on the linkages that are searched for.

use coupler_curves::expression::{self, CompiledExpression, Kind};
use coupler_curves::family::Family;
use coupler_curves::measure::parse_condition;
use coupler_curves::template::Template;

/// A condition on linkages in the language of `where`: over the parameters of a linkage and the measures.
#[derive(Clone, Debug)]
pub struct Condition {
    text: String,
    /// As it is compiled for each linkage, by its id; at least one.
    compiled: Vec<(String, CompiledExpression)>,
}

impl PartialEq for Condition {
    fn eq(&self, other: &Condition) -> bool {
        self.text == other.text
    }
}

impl Condition {
    /// Compiles a condition over the parameters of a linkage, of four-bars [`crate::Mechanism::template`], and the measures.
    ///
    /// # Errors
    /// It is not an expression of the known names, or not a condition.
    pub fn new(template: &Template, text: &str) -> Result<Condition, expression::Error> {
        Condition::of_any([template], text)
    }

    /// The same over several linkages, those of them that have what it names. Others do not meet it.
    ///
    /// # Errors
    /// It applies to none of them: what is wrong with it for the first.
    pub fn of_any<'t>(
        templates: impl IntoIterator<Item = &'t Template>,
        text: &str,
    ) -> Result<Condition, expression::Error> {
        let parsed = parse_condition(text)?;
        let compile = |template: &Template| {
            let names: Vec<String> = template.parameters.iter().map(|parameter| parameter.name.clone()).collect();
            let scope = Family::scope(&names, template.is_driven_by_length());
            Ok((template.id.clone(), parsed.compile(&scope, Kind::Boolean)?))
        };
        let mut compiled = Vec::new();
        let mut errors = Vec::new();
        for template in templates {
            match compile(template) {
                Ok(found) => compiled.push(found),
                Err(error) => errors.push(error),
            }
        }
        match errors.into_iter().next() {
            Some(error) if compiled.is_empty() => Err(error),
            _ => Ok(Condition { text: text.to_owned(), compiled }),
        }
    }

    /// The compiled condition on the linkage, or on the first of several, over [`Family::scope`].
    pub(crate) fn compiled(&self) -> &CompiledExpression {
        &self.compiled[0].1
    }

    /// That on a linkage, by its id; `None` if it does not apply to it.
    pub(crate) fn on(&self, id: &str) -> Option<&CompiledExpression> {
        self.compiled.iter().find(|(own, _)| own == id).map(|(_, compiled)| compiled)
    }

    /// The text that it was compiled from.
    pub fn text(&self) -> &str {
        &self.text
    }
}
