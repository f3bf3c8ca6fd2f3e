//! A condition on the linkages that are searched for.

use coupler_curves::expression::{self, CompiledExpression, Kind};
use coupler_curves::family::Family;
use coupler_curves::measure::parse_condition;
use coupler_curves::template::Template;

/// A condition on linkages in the language of `where`: over the parameters of a linkage and the measures.
#[derive(Clone, Debug)]
pub struct Condition {
    text: String,
    compiled: CompiledExpression,
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
        let names: Vec<String> = template.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let scope = Family::scope(&names, template.is_driven_by_length());
        let compiled = parse_condition(text)?.compile(&scope, Kind::Boolean)?;
        Ok(Condition { text: text.to_owned(), compiled })
    }

    /// The compiled condition, over [`Family::scope`].
    pub(crate) fn compiled(&self) -> &CompiledExpression {
        &self.compiled
    }

    /// The text that it was compiled from.
    pub fn text(&self) -> &str {
        &self.text
    }
}
