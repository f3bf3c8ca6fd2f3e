//! Linkages and curves made again from their pickles.

use std::path::PathBuf;

use coupler_curves::family::Family;
use pyo3::prelude::*;
use pyo3::types::{PyAny, PyTuple};

use crate::linkage::{Linkage, into_object, template_of_text};
use crate::manifest::{Manifest, Source};

/// Makes a linkage again that was pickled.
#[pyfunction]
#[pyo3(name = "_linkage")]
pub fn make_linkage_again(
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
            let cells = move |family: &Family| if family.id == own { number.saturating_sub(1)..number } else { 0..0 };
            let manifest = Manifest::for_tables(py, Source::new(path, text.into()), cells)?;
            manifest.cell(&name, number)?
        }
        (Some(path), Some(text), Some(values)) => {
            let manifest = Manifest::for_tables(py, Source::new(path, text.into()), |_| 0..0)?;
            manifest.cell_with(&name, number, values)?
        }
        (_, text, values) => {
            let template = template_of_text(&name, text.as_deref())?;
            Linkage::of_template(template, text.map(Into::into), values.unwrap_or_default(), (number, circuits))?
        }
    };
    into_object(py, linkage)
}

/// Makes a circuit again that was pickled, by the arguments for its linkage and its index.
#[pyfunction]
#[pyo3(name = "_circuit")]
pub fn make_circuit_again<'py>(
    py: Python<'py>,
    arguments: Bound<'py, PyTuple>,
    index: usize,
) -> PyResult<Bound<'py, PyAny>> {
    part_made_again(py, arguments, ("circuits", index))
}

/// Makes a curve again that was pickled, by the arguments for its linkage and its index.
#[pyfunction]
#[pyo3(name = "_curve")]
pub fn make_curve_again<'py>(
    py: Python<'py>,
    arguments: Bound<'py, PyTuple>,
    index: usize,
) -> PyResult<Bound<'py, PyAny>> {
    part_made_again(py, arguments, ("curves", index))
}

/// A part of a linkage that is made again, by the name of the list of such parts and its index there.
fn part_made_again<'py>(
    py: Python<'py>,
    arguments: Bound<'py, PyTuple>,
    (list, index): (&str, usize),
) -> PyResult<Bound<'py, PyAny>> {
    let make = py.import("coupler_atlas._core")?.getattr("_linkage")?;
    make.call1(arguments)?.getattr(list)?.get_item(index)
}
