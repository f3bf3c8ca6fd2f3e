//! Linkages in motion.

use std::path::PathBuf;

use coupler_drawing::plate::PAPER;
use pyo3::prelude::*;

use crate::file::save_svg;
use crate::reduce::{Reduced, Remake, reduced};

/// A linkage in motion. A notebook shows it; ``save`` writes it as SVG, which browsers play.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Animation {
    /// The animated plate, as SVG without scripts.
    #[pyo3(get)]
    pub(super) svg: String,
}

#[pymethods]
impl Animation {
    /// Write the animation as SVG.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        save_svg(&path, &self.svg)
    }

    /// The animation in a frame of its own, in which no script runs.
    fn _repr_html_(&self) -> String {
        let page = format!(
            "<!DOCTYPE html><style>body{{margin:0}}svg{{display:block;width:100%;height:auto}}</style>{}",
            self.svg
        );
        let escaped = page.replace('&', "&amp;").replace('"', "&quot;");
        format!(
            "<iframe sandbox title=\"a linkage in motion\" srcdoc=\"{escaped}\" \
             style=\"border:0;width:100%;max-width:800px;aspect-ratio:{}/{}\"></iframe>",
            PAPER.width, PAPER.height
        )
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Animation, {} bytes of SVG>", self.svg.len())
    }
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Animation>(py, &self.svg)
    }
}

impl Remake for Animation {
    type State = String;

    fn remake(py: Python, svg: String) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Animation { svg })?.into_any())
    }
}
