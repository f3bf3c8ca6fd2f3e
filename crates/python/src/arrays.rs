//! NumPy arrays, which take over the memory of what was computed and cannot be written to.

use coupler_curves::geometry::Point;
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods};
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
