//! What a linkage was made from: by that it is compared, and made again from a pickle.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyAny, PyTuple};

use super::Linkage;
use super::catalogue::template_of_text;
use super::four_bar::into_object;
use crate::atlas::Manifest;

/// What a linkage was made from.
#[derive(Clone, Debug, PartialEq)]
pub enum Recipe {
    /// The arguments of `linkage`.
    Linkage {
        name: String,
        /// The text of the manifest that has it; `None` for one of the catalogue, and for a four-bar at its place.
        manifest: Option<Arc<str>>,
        samples: usize,
        circuits: Option<String>,
        values: Vec<(String, f64)>,
    },
    /// A cell of an atlas, by the path and the text of its manifest, its family, and its number.
    Cell { path: PathBuf, text: Arc<str>, family: String, number: usize },
    /// A linkage that was found in an atlas: it is equal to itself only.
    Found,
}

/// The arguments of [`make_again`].
type Arguments = (Option<PathBuf>, Option<String>, String, usize, Option<String>, Option<Vec<(String, f64)>>);

impl Recipe {
    /// The arguments from which [`make_again`] makes the same linkage.
    ///
    /// # Errors
    /// It cannot be made from a few texts.
    pub fn arguments(&self) -> PyResult<Arguments> {
        match self {
            Recipe::Linkage { name, manifest, samples, circuits, values } => {
                let text = manifest.as_ref().map(|text| text.to_string());
                Ok((None, text, name.clone(), *samples, circuits.clone(), Some(values.clone())))
            }
            Recipe::Cell { path, text, family, number } => {
                Ok((Some(path.clone()), Some(text.to_string()), family.clone(), *number, None, None))
            }
            Recipe::Found => Err(PyTypeError::new_err(
                "a linkage that was found in an atlas cannot be pickled: take its cell, or keep the manifest that toml() writes",
            )),
        }
    }
}

/// Makes a linkage again that was pickled.
#[pyfunction]
#[pyo3(name = "_linkage")]
pub fn make_again(
    py: Python,
    path: Option<PathBuf>,
    text: Option<String>,
    name: String,
    number: usize,
    circuits: Option<&str>,
    values: Option<Vec<(String, f64)>>,
) -> PyResult<Py<PyAny>> {
    let linkage: Linkage = match (path, text, values) {
        (Some(path), Some(text), None) => {
            let own = name.clone();
            let cells = move |id: &str, _| if id == own { number.saturating_sub(1)..number } else { 0..0 };
            let manifest = Manifest::for_tables(py, path, text.into(), cells)?;
            manifest.cell(&name, number)?
        }
        (_, text, values) => {
            let template = template_of_text(&name, text.as_deref())?;
            Linkage::of_template(template, text.map(Into::into), values.unwrap_or_default(), (number, circuits))?
        }
    };
    into_object(py, linkage)
}

/// Makes a curve again that was pickled, by the arguments for its linkage and its index.
#[pyfunction]
#[pyo3(name = "_curve")]
pub fn curve_again<'py>(py: Python<'py>, arguments: Bound<'py, PyTuple>, index: usize) -> PyResult<Bound<'py, PyAny>> {
    let make = py.import("coupler_atlas._core")?.getattr("_linkage")?;
    make.call1(arguments)?.getattr("curves")?.get_item(index)
}
