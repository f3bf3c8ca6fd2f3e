//! Linkages and numbers given on the command line.

use std::path::Path;
use std::sync::Arc;

use crate::manifest;
use coupler_curves::catalogue;
use coupler_curves::family::{CellError, ParameterError, ParameterErrors};
use coupler_curves::problem::suggestion;
use coupler_curves::template::{Parameter, Template};

use super::{Failure, source};

/// The number of samples of a circuit where the command line sets none.
pub(super) const DEFAULT_SAMPLES: u32 = 360;

/// Finds a linkage by name, in a manifest if one is given, then in the catalogue.
///
/// # Errors
/// The manifest cannot be read, or no linkage has this name.
pub(super) fn find_template(name: &str, manifest: Option<&Path>) -> Result<Arc<Template>, Failure> {
    let mut known: Vec<Arc<Template>> = Vec::new();
    let mut error_count = 0;
    if let Some(path) = manifest {
        let text = source::read_text(path)?;
        let (templates, problems) = manifest::parse_linkages(&text);
        source::report_problems(path, &text, &problems);
        error_count = problems.iter().filter(|problem| problem.is_error()).count();
        known.extend(templates);
    }
    known.extend(catalogue::all().iter().cloned());
    let template = known.iter().find(|template| template.id == name).cloned();
    template.ok_or_else(|| {
        // The linkage may be in what could not be read.
        if let (Some(path), true) = (manifest, error_count > 0) {
            return source::problems_error(path, error_count);
        }
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        Failure::input(format!("there is no linkage `{name}`: {}", suggestion(name, &ids)))
    })
}

/// The text of a linkage, if it is of a manifest and none of the catalogue.
///
/// # Errors
/// The manifest cannot be read.
pub(super) fn own_text(manifest: Option<&Path>, template: &Template) -> Result<Option<String>, Failure> {
    match (manifest, catalogue::find(&template.id)) {
        (Some(path), None) => Ok(manifest::linkage_text(&source::read_text(path)?, &template.id)),
        _ => Ok(None),
    }
}

/// Errors in the parameters of a linkage, each with what to write where a value is missing.
pub(super) fn parameter_errors(template: &Template, errors: &ParameterErrors) -> Vec<String> {
    let message = |error: &ParameterError| match error {
        ParameterError::Cell(CellError::Missing(name)) => {
            let parameter = template.parameters.iter().find(|parameter| parameter.name == *name);
            let example = parameter.map_or(1.0, Parameter::starting_value);
            format!("{}: {error}: add it, as in {name}={example}", template.id)
        }
        error => format!("{}: {error}", template.id),
    };
    errors.iter().map(message).collect()
}
