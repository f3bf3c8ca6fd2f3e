//! The keywords of searches.

use coupler_find::Effort;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::natural;

/// Keywords that have not been read.
pub struct Unread<'py> {
    function: &'static str,
    keywords: Bound<'py, PyDict>,
}

/// What `outline` names.
#[derive(FromPyObject)]
enum OutlineName {
    /// A number, from 1.
    Number(i64),
    /// An id.
    Id(String),
}

/// A parameter that is not searched, with its value if it has another than its default.
pub type Kept = (String, Option<String>);

impl<'py> Unread<'py> {
    /// The keywords of a call of a function.
    pub fn new(
        py: Python<'py>,
        function: &'static str,
        keywords: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Unread<'py>> {
        let keywords = keywords.map_or_else(|| Ok(PyDict::new(py)), |keywords| keywords.copy())?;
        Ok(Unread { function, keywords })
    }

    /// The value of a keyword, if it is given.
    pub fn take<T: FromPyObjectOwned<'py>>(&self, name: &str) -> PyResult<Option<T>> {
        let Some(value) = self.keywords.get_item(name)? else { return Ok(None) };
        self.keywords.del_item(name)?;
        value.extract::<T>().map(Some).map_err(|error| {
            let (py, error): (_, PyErr) = (value.py(), error.into());
            match error.is_instance_of::<PyTypeError>(py) {
                true => PyTypeError::new_err(format!("{name}: {}", error.value(py))),
                false => error,
            }
        })
    }

    /// The value of a keyword that may be None.
    pub fn take_optional<T>(&self, name: &str) -> PyResult<Option<T>>
    where
        Option<T>: FromPyObjectOwned<'py>,
    {
        Ok(self.take::<Option<T>>(name)?.flatten())
    }

    /// The value of a keyword that is a whole number.
    pub fn take_whole(&self, name: &str) -> PyResult<Option<usize>> {
        self.take::<i64>(name)?.map(|value| natural(name, value)).transpose()
    }

    /// The value of a keyword that is a whole number or None.
    pub fn take_optional_whole(&self, name: &str) -> PyResult<Option<usize>> {
        self.take_optional::<i64>(name)?.map(|value| natural(name, value)).transpose()
    }

    /// How much is tried, if it is said.
    pub fn take_effort(&self) -> PyResult<Option<Effort>> {
        self.take_choice(
            "effort",
            &[("quick", Effort::Quick), ("normal", Effort::Normal), ("thorough", Effort::Thorough)],
        )
    }

    /// What a keyword names, which may be None.
    pub fn take_choice<T: Copy>(&self, name: &str, choices: &[(&str, T)]) -> PyResult<Option<T>> {
        let Some(given) = self.take_optional::<String>(name)? else { return Ok(None) };
        let found = choices.iter().find(|(known, _)| *known == given);
        found.map(|(_, choice)| Some(*choice)).ok_or_else(|| {
            let mut names: Vec<String> = choices.iter().map(|(known, _)| format!("{known:?}")).collect();
            let last = names.pop().unwrap_or_default();
            PyValueError::new_err(format!("{name}={given:?}: give {} or {last}", names.join(", ")))
        })
    }

    /// What of a file with several paths or tables is taken: an id, or a number from 1.
    pub fn take_outline(&self) -> PyResult<Option<String>> {
        Ok(self.take_optional("outline")?.map(|name| match name {
            OutlineName::Number(number) => number.to_string(),
            OutlineName::Id(id) => id,
        }))
    }

    /// Parameters that are not searched: a list of names, or a dictionary of names and values.
    pub fn take_kept(&self, name: &str) -> PyResult<Vec<Kept>> {
        let kept = self.take_optional::<Bound<'py, PyAny>>(name)?;
        kept.map_or(Ok(Vec::new()), |kept| kept_parameters(name, &kept))
    }

    /// All keywords must have been read.
    ///
    /// # Errors
    /// One has not.
    pub fn finish(self) -> PyResult<()> {
        match self.keywords.keys().iter().next() {
            Some(name) => {
                let message = format!("{}() got an unexpected keyword argument '{name}'", self.function);
                Err(PyTypeError::new_err(message))
            }
            None => Ok(()),
        }
    }
}

fn kept_parameters(name: &str, kept: &Bound<PyAny>) -> PyResult<Vec<Kept>> {
    if let Ok(values) = kept.cast::<PyDict>() {
        return values
            .iter()
            .map(|(name, value)| {
                let value = if value.is_none() { None } else { Some(value.str()?.to_string()) };
                Ok((name.extract()?, value))
            })
            .collect();
    }
    // A string is a sequence of its letters.
    let names = kept.extract::<Vec<String>>().ok().filter(|_| kept.extract::<String>().is_err());
    let Some(names) = names else {
        let kind = kept.get_type().name()?;
        let message = format!("{name}: give a list of names or a dict of names and values, and not a {kind}");
        return Err(PyTypeError::new_err(message));
    };
    Ok(names.into_iter().map(|name| (name, None)).collect())
}
