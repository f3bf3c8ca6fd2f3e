//! Linkages in motion.

use std::path::{Path, PathBuf};

use coupler_atlas::output;
use coupler_drawing::plate::PAPER;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::OutputError;

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
}

/// Writes a file.
pub(super) fn save(path: &Path, bytes: &[u8]) -> PyResult<()> {
    output::write_file(path, bytes).map_err(|error| OutputError::new_err(error.to_string()))
}

/// Writes a drawing.
///
/// # Errors
/// The name is that of another format, or the file cannot be written.
pub fn save_svg(path: &Path, svg: &str) -> PyResult<()> {
    if path.extension().is_none_or(|suffix| !suffix.eq_ignore_ascii_case("svg")) {
        let message = "the drawing is SVG: give a name that ends in .svg; the curves of a linkage have other formats";
        return Err(PyValueError::new_err(format!("{}: {message}", path.display())));
    }
    save(path, svg.as_bytes())
}
