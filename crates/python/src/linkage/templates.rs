//! Linkages of the catalogue and of manifests by their ids.

use std::path::Path;
use std::sync::Arc;

use coupler_atlas::manifest;
use coupler_curves::catalogue;
use coupler_curves::problem::suggestion;
use coupler_curves::template::Template;
use coupler_find::Mechanism;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error;
use crate::file::read_text;

/// Finds a linkage by its id, of a manifest and of the catalogue; with the text of the manifest if it is of it.
pub fn named_template(py: Python, name: &str, manifest: Option<&Path>) -> PyResult<(Arc<Template>, Option<Arc<str>>)> {
    let Some(path) = manifest else { return Ok((template(name, &[])?, None)) };
    template_in_text(py, name, path, read_text(py, path)?)
}

/// The same of the text of a manifest; the path is for messages.
pub fn template_in_text(
    py: Python,
    name: &str,
    path: &Path,
    text: String,
) -> PyResult<(Arc<Template>, Option<Arc<str>>)> {
    let (own, problems) = manifest::parse_linkages(&text);
    if problems.iter().any(|problem| problem.is_error()) {
        return Err(error::manifest_error(py, path, &text, &problems));
    }
    Ok((template(name, &own)?, own.iter().any(|own| own.id == name).then(|| text.into())))
}

/// The linkage with an id in the text of a manifest that has been read before, or of the catalogue or of answers.
pub fn template_of_text(name: &str, text: Option<&str>) -> PyResult<Arc<Template>> {
    let own = text.map_or(Vec::new(), |text| manifest::parse_linkages(text).0);
    if text.is_none() && name == Mechanism::template().id { Ok(Mechanism::template()) } else { template(name, &own) }
}

/// Finds a linkage by its id, of `own` and of the catalogue.
pub(super) fn template(name: &str, own: &[Arc<Template>]) -> PyResult<Arc<Template>> {
    let known: Vec<&Arc<Template>> = own.iter().chain(catalogue::all()).collect();
    let found = known.iter().find(|template| template.id == name).map(|template| Arc::clone(template));
    found.ok_or_else(|| {
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        PyValueError::new_err(format!("there is no linkage `{name}`: {}", suggestion(name, &ids)))
    })
}
