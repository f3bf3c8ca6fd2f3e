//! Linkages of the catalogue and of manifests.

use std::path::PathBuf;
use std::sync::Arc;

use coupler_atlas::manifest;
use coupler_curves::catalogue;
use coupler_curves::family::ParameterText;
use coupler_curves::problem::suggestion;
use coupler_curves::template::{CircuitSelection, Template};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::Linkage;
use crate::atlas::read_text;
use crate::error::{self, LinkageError};

/// Finds a linkage by its id, of `own` and of the catalogue.
pub(super) fn template(name: &str, own: &[Arc<Template>]) -> PyResult<Arc<Template>> {
    let known: Vec<&Arc<Template>> = own.iter().chain(catalogue::all()).collect();
    let found = known.iter().find(|template| template.id == name).map(|template| Arc::clone(template));
    found.ok_or_else(|| {
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        PyValueError::new_err(format!("there is no linkage `{name}`: {}", suggestion(name, &ids)))
    })
}

/// Make a linkage of the catalogue, or of a manifest.
///
/// Parameters
/// ----------
/// name : str
///     The id of the linkage; ``linkages()`` lists those of the catalogue.
/// manifest : path, optional
///     A manifest whose linkages can be named, too.
/// samples : int
///     How many points a curve has.
/// circuits : {"start", "all"}, optional
///     Only the circuit through the start pose, or all; by default what the linkage says.
/// **parameters : float or str
///     Its parameters: numbers, or expressions with units, as in ``phase="30 deg"``.
///
/// Returns
/// -------
/// Linkage
///
/// Raises
/// ------
/// LinkageError
///     A parameter is missing, unknown or out of its range.
/// ValueError
///     There is no such linkage.
#[pyfunction]
#[pyo3(name = "linkage", signature = (name, /, *, manifest=None, samples=360, circuits=None, **parameters))]
pub fn make_linkage(
    py: Python,
    name: &str,
    manifest: Option<PathBuf>,
    samples: usize,
    circuits: Option<&str>,
    parameters: Option<Bound<PyDict>>,
) -> PyResult<Linkage> {
    let mut own = Vec::new();
    if let Some(path) = manifest {
        let text = read_text(py, &path)?;
        let (templates, problems) = manifest::parse_linkages(&text);
        if problems.iter().any(|problem| problem.is_error()) {
            return Err(error::manifest_error(py, &path, &text, &problems));
        }
        own = templates;
    }
    let mut template = template(name, &own)?;
    match circuits {
        None => {}
        Some("start") => Arc::make_mut(&mut template).circuits = CircuitSelection::Start,
        Some("all") => Arc::make_mut(&mut template).circuits = CircuitSelection::All,
        Some(other) => return Err(PyValueError::new_err(format!("circuits={other:?}: give \"start\" or \"all\""))),
    }
    let mut values = Vec::new();
    for (key, value) in parameters.iter().flatten() {
        let key: String = key.extract()?;
        let given = if let Ok(number) = value.extract::<f64>() {
            (key, number)
        } else if let Ok(text) = value.extract::<String>() {
            let parsed = ParameterText::parse(&format!("{key}={text}"))
                .map_err(|error| PyValueError::new_err(error.to_string()))?;
            parsed.resolve(&template).map_err(|error| LinkageError::new_err(format!("{name}: {error}")))?
        } else {
            let kind = value.get_type().name()?;
            return Err(PyTypeError::new_err(format!("{key}: a parameter is a number or an expression, not a {kind}")));
        };
        values.push(given);
    }
    Linkage::of_template(template, &values, samples)
}

/// The ids of the linkages of the catalogue, in order.
#[pyfunction]
pub fn linkages() -> Vec<String> {
    catalogue::all().iter().map(|template| template.id.clone()).collect()
}
