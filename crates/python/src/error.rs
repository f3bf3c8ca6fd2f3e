//! The exceptions of the module. Their messages are those of the program, without colours.

use std::path::Path;

use coupler_curves::problem::{self, Problem};
use coupler_curves::text::pluralize;
use pyo3::exceptions::{PyException, PyUserWarning};
use pyo3::prelude::*;
use pyo3::types::PyList;

pyo3::create_exception!(
    coupler_atlas,
    Error,
    PyException,
    "An error of coupler-atlas; its message is what the program prints."
);
pyo3::create_exception!(
    coupler_atlas,
    ManifestError,
    Error,
    "A manifest with errors: `file` is its path, and `problems` has a dictionary for each problem, with `message`, `help`, `line`, `column` \
     and `is_error`."
);
pyo3::create_exception!(
    coupler_atlas,
    LinkageError,
    Error,
    "A linkage with these parameters cannot be built, or not assembled."
);
pyo3::create_exception!(
    coupler_atlas,
    OutputError,
    Error,
    "A file or a folder cannot be read or written, or is not to be replaced."
);
pyo3::create_exception!(
    coupler_atlas,
    ManifestWarning,
    PyUserWarning,
    "A warning about a manifest that can be used all the same."
);

/// Adds the exceptions to the module.
pub fn add_to(module: &Bound<PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("Error", py.get_type::<Error>())?;
    module.add("ManifestError", py.get_type::<ManifestError>())?;
    module.add("LinkageError", py.get_type::<LinkageError>())?;
    module.add("OutputError", py.get_type::<OutputError>())?;
    module.add("ManifestWarning", py.get_type::<ManifestWarning>())
}

/// The exception for a manifest with problems, all of which its message reports with their places.
pub fn manifest_error(py: Python, path: &Path, text: &str, problems: &[Problem]) -> PyErr {
    let name = path.display().to_string();
    let count = problems.iter().filter(|problem| problem.is_error()).count();
    let report = problem::report(problems, &name, text, false);
    let error = ManifestError::new_err(format!("{name}: {}\n{}", pluralize(count, "problem"), report.trim_end()));
    // The attributes are in addition to the message.
    let _ = set_attributes(py, &error, &name, text, problems);
    error
}

fn set_attributes(py: Python, error: &PyErr, name: &str, text: &str, problems: &[Problem]) -> PyResult<()> {
    let list = PyList::empty(py);
    for problem in problems {
        let before = text.get(..problem.span.start.min(text.len())).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let item = pyo3::types::PyDict::new(py);
        item.set_item("message", &problem.message)?;
        item.set_item("help", &problem.help)?;
        item.set_item("line", before.matches('\n').count() + 1)?;
        item.set_item("column", before[line_start..].chars().count() + 1)?;
        item.set_item("is_error", problem.is_error())?;
        list.append(item)?;
    }
    let value = error.value(py);
    value.setattr("file", name)?;
    value.setattr("problems", list)
}

/// Warns of problems of a manifest that are no errors.
pub fn warn(py: Python, path: &Path, text: &str, problems: &[Problem]) -> PyResult<()> {
    for problem in problems.iter().filter(|problem| !problem.is_error()) {
        let report = problem::report(std::slice::from_ref(problem), &path.display().to_string(), text, false);
        let message = std::ffi::CString::new(report.trim_end().replace('\0', "")).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<ManifestWarning>(), &message, 1)?;
    }
    Ok(())
}
