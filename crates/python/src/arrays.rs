//! NumPy arrays, which take over the memory of what was computed and cannot be written to.

use coupler_curves::geometry::Point;
use numpy::{AllowTypeChange, Element, PyArray1, PyArray2, PyArrayLike2, PyArrayMethods};
use pyo3::prelude::*;

/// A column.
pub fn column<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyArray1<T>> {
    let array = PyArray1::from_vec(py, values);
    // The only borrow of a new array.
    array.readwrite().make_nonwriteable();
    array
}

/// Rows of so many values each, of shape (n, `width`).
pub fn rows<T: Element>(py: Python<'_>, values: Vec<T>, width: usize) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = values.len() / width.max(1);
    column(py, values).reshape([count, width])
}

/// Points, of shape (n, 2).
pub fn points(py: Python<'_>, points: impl Iterator<Item = Point>, count: usize) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let mut values = Vec::with_capacity(2 * count);
    points.for_each(|point| values.extend([point.x, point.y]));
    rows(py, values, 2)
}

/// The rows of an argument, if it is or can be made an array of real numbers of two dimensions.
pub fn real_rows<'py>(value: &Bound<'py, PyAny>) -> Option<PyArrayLike2<'py, f64, AllowTypeChange>> {
    // NumPy would leave out the imaginary parts.
    let is_complex = value.getattr("dtype").and_then(|dtype| dtype.getattr("kind")?.eq("c")).unwrap_or(false);
    if is_complex { None } else { value.extract().ok() }
}

/// What was given in place of an array: "an array of shape (10,) of float64".
pub fn described(value: &Bound<PyAny>) -> PyResult<String> {
    Ok(match value.getattr("shape") {
        Ok(shape) => format!("an array of shape {shape} of {}", value.getattr("dtype")?),
        Err(_) if value.len().is_ok_and(|length| length == 0) => "an empty sequence".to_owned(),
        Err(_) => format!("a {}", value.get_type().name()?),
    })
}
