//! Linkages of the catalogue and of manifests.

use std::path::{Path, PathBuf};

use coupler_curves::catalogue;
use coupler_curves::family::ParameterText;
use coupler_curves::template::Template;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::four_bar::into_object;
use super::numeric_linkage::Linkage;
use super::recipe::MotionChoice;
use super::templates::{named_template, template_in_text};
use crate::argument::{natural, toml_text};
use crate::error::LinkageError;

/// Make a linkage of the catalogue, or of a manifest.
///
/// Parameters
/// ----------
/// name : str
///     The id of the linkage; ``linkages()`` lists those of the catalogue.
/// manifest : path, optional
///     A manifest whose linkages can be named, too.
/// text : str or dict, optional
///     The text of such a manifest, or what it says as a dictionary; `[[linkage]]` is enough.
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
///     A `FourBar` if it is the four-bar of the catalogue.
///
/// Raises
/// ------
/// LinkageError
///     A parameter is missing, unknown or out of its range.
/// ValueError
///     There is no such linkage.
#[pyfunction]
#[pyo3(name = "linkage", signature = (name, /, *, manifest=None, text=None, samples=360, circuits=None, **parameters))]
pub fn make_linkage(
    py: Python,
    name: &str,
    manifest: Option<PathBuf>,
    text: Option<Bound<PyAny>>,
    samples: i64,
    circuits: Option<String>,
    parameters: Option<Bound<PyDict>>,
) -> PyResult<Py<PyAny>> {
    let (template, text) = match (manifest, text) {
        (Some(_), Some(_)) => return Err(PyValueError::new_err("manifest and text say the same: give one of them")),
        (None, Some(text)) => template_in_text(py, name, Path::new("text"), toml_text(&text)?)?,
        (manifest, None) => named_template(py, name, manifest.as_deref())?,
    };
    let values = given_values(&template, parameters)?;
    let motion = MotionChoice { circuits, ..MotionChoice::samples(natural("samples", samples)?) };
    into_object(py, Linkage::of_template(template, text, values, motion)?)
}

/// The values that keyword arguments give parameters of a linkage.
///
/// # Errors
/// One is no number, and no expression that has a value.
pub(super) fn given_values(template: &Template, parameters: Option<Bound<PyDict>>) -> PyResult<Vec<(String, f64)>> {
    let mut values = Vec::new();
    for (key, value) in parameters.iter().flatten() {
        let key: String = key.extract()?;
        let given = if let Ok(number) = value.extract::<f64>() {
            (key, number)
        } else if let Ok(text) = value.extract::<String>() {
            let parsed = ParameterText::parse(&format!("{key}={text}"))
                .map_err(|error| PyValueError::new_err(error.to_string()))?;
            parsed.resolve(template).map_err(|error| LinkageError::new_err(format!("{}: {error}", template.id)))?
        } else {
            let kind = value.get_type().name()?;
            return Err(PyTypeError::new_err(format!("{key}: a parameter is a number or an expression, not a {kind}")));
        };
        values.push(given);
    }
    Ok(values)
}

/// The ids of the linkages of the catalogue, in order.
#[pyfunction]
pub fn linkages() -> Vec<String> {
    catalogue::all().iter().map(|template| template.id.clone()).collect()
}
