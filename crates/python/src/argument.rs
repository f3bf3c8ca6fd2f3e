//! Arguments of Python.

use pyo3::BoundObject;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PySlice;

/// A number that is 0 or more.
///
/// # Errors
/// It is less.
pub fn natural(name: &str, value: i64) -> PyResult<usize> {
    usize::try_from(value)
        .map_err(|_| PyValueError::new_err(format!("{name}={value}: give a whole number that is not negative")))
}

/// The ids of the families that a call is for; none for all.
///
/// # Errors
/// A list without ids, which would be taken for all.
pub fn only(ids: Option<Vec<String>>) -> PyResult<Vec<String>> {
    match ids {
        Some(ids) if ids.is_empty() => {
            Err(PyValueError::new_err("only=[] names no family: name some, or leave it out for all"))
        }
        ids => Ok(ids.unwrap_or_default()),
    }
}

/// The text of a manifest: a text as it is, or what a dictionary says.
pub fn toml_text(value: &Bound<PyAny>) -> PyResult<String> {
    match value.extract::<String>() {
        Ok(text) => Ok(text),
        Err(_) => value.py().import("coupler_atlas._toml")?.getattr("document")?.call1((value,))?.extract(),
    }
}

/// Whether an argument is a single number, and no array or sequence of one.
pub fn is_number(value: &Bound<PyAny>) -> bool {
    let has_dimensions = value.getattr("ndim").and_then(|count| count.gt(0)).unwrap_or(false);
    !has_dimensions && value.len().is_err() && value.extract::<f64>().is_ok()
}

/// An index into a sequence, or a slice of it.
#[derive(FromPyObject)]
pub enum Index<'py> {
    /// From 0; from the end if it is negative.
    At(isize),
    /// As in `sequence[1:3]`.
    Slice(Bound<'py, PySlice>),
}

impl<'py> Index<'py> {
    /// The item of a sequence of so many at the index, or the list of those of the slice.
    ///
    /// # Errors
    /// There is none at the index; `what` says what there is.
    pub fn of<T: IntoPyObject<'py>>(
        self,
        py: Python<'py>,
        count: usize,
        what: &str,
        item: impl Fn(usize) -> PyResult<T>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let into_any = |index: usize| -> PyResult<Bound<'py, PyAny>> {
            item(index)?.into_pyobject(py).map(|item| item.into_any().into_bound()).map_err(Into::into)
        };
        match self {
            Index::At(index) => into_any(position(index, count, what)?),
            Index::Slice(slice) => {
                let indices = slice.indices(isize::try_from(count)?)?;
                let places = (0..indices.slicelength).map(|k| indices.start + k as isize * indices.step);
                let items: Vec<Bound<'py, PyAny>> =
                    places.map(|place| into_any(place.unsigned_abs())).collect::<PyResult<_>>()?;
                Ok(items.into_pyobject(py)?.into_any())
            }
        }
    }
}

/// The place of an index in a sequence of so many.
///
/// # Errors
/// There is none; `what` says what there is.
pub fn position(index: isize, count: usize, what: &str) -> PyResult<usize> {
    let from_start = if index < 0 { index + count as isize } else { index };
    let place = usize::try_from(from_start).ok().filter(|place| *place < count);
    place.ok_or_else(|| PyIndexError::new_err(format!("there is no {what} of index {index}: there are {count}")))
}
