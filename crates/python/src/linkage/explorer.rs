//! Plates that a reader changes.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::file::save;
use crate::html;
use crate::reduce::{Reduced, Remake, reduced};

/// The plate of a curve as the gallery shows it, with sliders, handles, graphs and exports: one page without a network. A notebook shows it;
/// ``save`` writes it as a file that any browser opens.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Explorer {
    /// The page, as HTML with scripts.
    #[pyo3(get)]
    pub(super) html: String,
}

#[pymethods]
impl Explorer {
    /// Write the page as HTML.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        if path.extension().is_none_or(|suffix| !suffix.eq_ignore_ascii_case("html")) {
            let message = format!("{}: the page is HTML: give a name that ends in .html", path.display());
            return Err(PyValueError::new_err(message));
        }
        save(&path, self.html.as_bytes())
    }

    /// The page in a frame of its own.
    fn _repr_html_(&self) -> String {
        // With `srcdoc` the page would have the address of the notebook, where it cannot say what it shows.
        let address = html::address("text/html;charset=utf-8", &self.html);
        format!(
            "<iframe sandbox=\"allow-scripts allow-downloads\" title=\"a plate to explore\" src=\"{address}\" \
             style=\"border:0;width:100%;height:640px\"></iframe>"
        )
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Explorer, {} bytes of HTML>", self.html.len())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Explorer>(py, &self.html)
    }
}

impl Remake for Explorer {
    type State = String;

    fn remake(py: Python, html: String) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Explorer { html })?.into_any())
    }
}
