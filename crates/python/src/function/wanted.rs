//! The function that is wanted.

use std::path::PathBuf;

use coupler_atlas::find::function::{FORMULA_EXAMPLE, is_formula, parse_formula, read_function};
use coupler_curves::geometry::trig;
use coupler_curves::problem;
use coupler_find::FunctionTarget;
use numpy::ndarray::ArrayView2;
use pyo3::exceptions::{PyFileNotFoundError, PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays;
use crate::file::read_bytes;

/// A function with its name.
pub(super) struct Wanted {
    pub name: String,
    pub target: FunctionTarget,
}

impl Wanted {
    /// Reads a function from a formula, an array or a file. `is_length` says whether the output is a length where the function does not.
    ///
    /// # Errors
    /// It is none of these, or no function.
    pub(super) fn read(py: Python, function: &Bound<PyAny>, radians: bool, is_length: bool) -> PyResult<Wanted> {
        if let Some(array) = arrays::real_rows(function) {
            let target = target_of(array.as_array(), radians, is_length)?;
            return Ok(Wanted { name: "function".to_owned(), target });
        }
        if radians {
            let message = "radians is of arrays: formulas and the columns of files name their units";
            return Err(PyValueError::new_err(message));
        }
        if let Ok(text) = function.extract::<String>()
            && is_formula(&text)
        {
            let target = parse_formula(&text).map_err(|problems| {
                let report = problem::report(&problems, "the function", &text, false);
                PyValueError::new_err(report.trim_end().to_owned())
            })?;
            return Ok(Wanted { name: text.trim().to_owned(), target });
        }
        let Ok(file) = function.extract::<PathBuf>() else {
            let kind = arrays::described(function)?;
            let message = format!(
                "function: give a formula, real numbers of shape (n, 2), or the path of a file, and not {kind}"
            );
            return Err(PyTypeError::new_err(message));
        };
        let shown = file.display().to_string();
        if !file.exists() {
            let forms =
                format!("a table with the columns input,output, or write the function as in {FORMULA_EXAMPLE:?}");
            return Err(PyFileNotFoundError::new_err(format!("cannot find {shown}: name {forms}")));
        }
        let bytes = read_bytes(py, &file)?;
        let (target, _) = read_function(&bytes, is_length).map_err(|problems| {
            let problems: Vec<String> = problems.iter().map(|problem| format!("{shown}: {problem}")).collect();
            PyValueError::new_err(problems.join("\n"))
        })?;
        let name = file.file_name().map_or(shown, |name| name.to_string_lossy().into_owned());
        Ok(Wanted { name, target })
    }
}

/// The function of an array of inputs and outputs.
fn target_of(array: ArrayView2<f64>, radians: bool, is_length: bool) -> PyResult<FunctionTarget> {
    let [rows, columns] = [array.nrows(), array.ncols()];
    if columns != 2 {
        let message = format!(
            "function: an array of inputs and outputs has the shape (n, 2), and this one has ({rows}, {columns})"
        );
        return Err(PyValueError::new_err(message));
    }
    let angle = |value: f64| if radians { trig::degrees(value) } else { value };
    let output = |value: f64| if is_length { value } else { angle(value) };
    let rows: Vec<[f64; 2]> = array.rows().into_iter().map(|row| [angle(row[0]), output(row[1])]).collect();
    FunctionTarget::rows(&rows, is_length).map_err(|problems| {
        let with_row = |problem: &coupler_find::FunctionTargetError| match problem.row() {
            Some(row) => format!("function: row {row}: {problem}"),
            None => format!("function: {problem}"),
        };
        PyValueError::new_err(problems.iter().map(with_row).collect::<Vec<_>>().join("\n"))
    })
}
