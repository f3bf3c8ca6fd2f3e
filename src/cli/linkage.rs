//! A linkage named on the command line, with the values of its parameters.

use std::path::Path;
use std::sync::Arc;

use coupler_atlas::{manifest, output};
use coupler_curves::catalogue;
use coupler_curves::expression::Expression;
use coupler_curves::problem::suggestion;
use coupler_curves::template::Template;

use super::{InputError, source};

/// The linkage of a name: of a manifest's own, if one is given, or of the catalogue.
pub(super) fn find_template(name: &str, manifest: Option<&Path>) -> anyhow::Result<Arc<Template>> {
    let mut known: Vec<Arc<Template>> = Vec::new();
    if let Some(path) = manifest {
        let text = output::read_manifest(path)?;
        let (own, problems) = manifest::parse_linkages(&text);
        source::report_problems(path, &text, &problems);
        known.extend(own);
    }
    known.extend(catalogue::all().iter().cloned());
    let found = known.iter().find(|template| template.id == name).cloned();
    found.ok_or_else(|| {
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        InputError(format!("there is no linkage `{name}`: {}", suggestion(name, &ids))).into()
    })
}

/// `name=value`, the value a number or an expression without names.
pub(super) fn parse_parameter(text: &str) -> Result<(String, f64), InputError> {
    const EXAMPLE: &str = "p=2 or \"a=sqrt(2)\"";
    let none = || InputError(format!("`{text}`: there is no `=`; write it like {EXAMPLE}"));
    let (name, value) = text.split_once('=').ok_or_else(none)?;
    Ok((name.trim().to_owned(), parse_number(value, EXAMPLE)?))
}

/// A number, or an expression without names.
pub(super) fn parse_number(text: &str, example: &str) -> Result<f64, InputError> {
    let wrong = |why: String| InputError(format!("`{text}`: {why}; write it like {example}"));
    let expression = Expression::parse(text).map_err(|error| wrong(error.message))?;
    match expression.names().first() {
        Some(name) => Err(wrong(format!("`{name}` has no value here"))),
        None => Ok(expression.evaluate(|_| f64::NAN)),
    }
}
