//! Files that are read and written.

use std::path::Path;

use coupler_atlas::output;
use pyo3::exceptions::{PyFileNotFoundError, PyValueError};
use pyo3::prelude::*;

use crate::error::OutputError;

/// Reads the text of a file.
pub fn read_text(py: Python, path: &Path) -> PyResult<String> {
    py.detach(|| output::read_text(path)).map_err(|error| unreadable(&error))
}

/// Reads a file in any encoding.
pub fn read_bytes(py: Python, path: &Path) -> PyResult<Vec<u8>> {
    py.detach(|| output::read_bytes(path)).map_err(|error| unreadable(&error))
}

fn unreadable(error: &output::Error) -> PyErr {
    match error {
        output::Error::Read { source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(error.to_string())
        }
        _ => OutputError::new_err(error.to_string()),
    }
}

/// Writes a file.
pub fn save(path: &Path, bytes: &[u8]) -> PyResult<()> {
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
