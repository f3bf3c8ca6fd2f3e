//! How objects are pickled and copied, all in one way: as the name of their class and what they are made again from. That is the inputs that
//! define an object, or what was recorded where making it from these would be a search.

use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;
use pyo3::{BoundObject, PyClass};

/// An object that is made again from a state.
pub trait Remake: PyClass {
    /// What it is made again from.
    type State: for<'py> FromPyObjectOwned<'py>;

    /// Makes it again.
    ///
    /// # Errors
    /// The state is of another version, for which what it is made from is wrong.
    fn remake(py: Python, state: Self::State) -> PyResult<Py<PyAny>>;
}

/// What `__reduce__` returns: a function, and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, (&'static str, Bound<'py, PyAny>));

/// An object of a class as what pickles have of it.
pub fn reduced<'py, T: Remake>(py: Python<'py>, state: impl IntoPyObject<'py>) -> PyResult<Reduced<'py>> {
    let state = state.into_pyobject(py).map_err(Into::into)?.into_any().into_bound();
    Ok((py.import("coupler_atlas._core")?.getattr("_remake")?, (T::NAME, state)))
}

/// An object of a class made again from a state in a pickle.
pub fn remade<T: Remake>(state: &Bound<PyAny>) -> PyResult<Py<PyAny>> {
    let own = state.extract::<T::State>().map_err(Into::into)?;
    T::remake(state.py(), own)
}
