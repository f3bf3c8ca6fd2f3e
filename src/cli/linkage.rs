//! Linkages and numbers given on the command line.

use std::path::Path;
use std::sync::Arc;

use coupler_atlas::manifest;
use coupler_curves::catalogue;
use coupler_curves::expression::{Error, Expression};
use coupler_curves::problem::suggestion;
use coupler_curves::template::Template;

use super::{InputError, source};

/// The number of samples of a circuit where the command line sets none.
pub(super) const DEFAULT_SAMPLES: u32 = 360;

/// Finds a linkage by name, in a manifest if one is given, then in the catalogue.
///
/// # Errors
/// The manifest cannot be read, or no linkage has this name.
pub(super) fn find_template(name: &str, manifest: Option<&Path>) -> anyhow::Result<Arc<Template>> {
    let mut known: Vec<Arc<Template>> = Vec::new();
    if let Some(path) = manifest {
        let text = source::read_text(path)?;
        let (templates, problems) = manifest::parse_linkages(&text);
        source::report_problems(path, &text, &problems);
        known.extend(templates);
    }
    known.extend(catalogue::all().iter().cloned());
    let template = known.iter().find(|template| template.id == name).cloned();
    template.ok_or_else(|| {
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        InputError(format!("there is no linkage `{name}`: {}", suggestion(name, &ids))).into()
    })
}

/// Reads a number or an expression without names; `example` is shown in the error.
pub(super) fn parse_number(text: &str, example: &str) -> Result<f64, InputError> {
    let error = |error: Error| InputError(format!("`{text}`: {error}; write it like {example}"));
    Expression::evaluate_constant(text).map_err(error)
}
