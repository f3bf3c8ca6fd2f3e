//! The keywords of a search.

use std::path::PathBuf;

use coupler_atlas::find::{Notation, Request, Searched, SearchedLinkage};
use coupler_atlas::manifest;
use coupler_find::{Effort, Options};
use numpy::{AllowTypeChange, PyArrayLike1};
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::natural;
use crate::atlas::ManifestArgument;
use crate::linkage::named_template;

/// The keywords of `find`, as they are given or with their defaults.
pub(super) struct Keywords<'py> {
    pub outline: Option<String>,
    pub closed: Option<bool>,
    pub part: bool,
    pub angles: Option<PyArrayLike1<'py, f64, AllowTypeChange>>,
    pub timed: bool,
    pub condition: Option<String>,
    pub index: Option<usize>,
    pub atlas: Option<ManifestArgument<'py>>,
    pub fixed: bool,
    pub progress: Option<Bound<'py, PyAny>>,
    linkage: Option<String>,
    manifest: Option<PathBuf>,
    keep: Option<Bound<'py, PyAny>>,
    pivots: Option<[f64; 4]>,
    options: Options,
}

/// The linkage that the keywords name, with its text if it is of a manifest.
pub(super) struct NamedLinkage {
    searched: SearchedLinkage,
    pub own_text: Option<String>,
}

/// What `outline` names.
#[derive(FromPyObject)]
enum OutlineName {
    /// A number, from 1.
    Number(i64),
    /// An id.
    Id(String),
}

/// Keywords that have not been read.
struct Unread<'py>(Bound<'py, PyDict>);

impl<'py> Unread<'py> {
    /// The value of a keyword, if it is given.
    fn take<T: FromPyObjectOwned<'py>>(&self, name: &str) -> PyResult<Option<T>> {
        let Some(value) = self.0.get_item(name)? else { return Ok(None) };
        self.0.del_item(name)?;
        value.extract::<T>().map(Some).map_err(|error| {
            let (py, error): (_, PyErr) = (value.py(), error.into());
            match error.is_instance_of::<PyTypeError>(py) {
                true => PyTypeError::new_err(format!("{name}: {}", error.value(py))),
                false => error,
            }
        })
    }

    /// The value of a keyword that may be None.
    fn take_optional<T>(&self, name: &str) -> PyResult<Option<T>>
    where
        Option<T>: FromPyObjectOwned<'py>,
    {
        Ok(self.take::<Option<T>>(name)?.flatten())
    }
}

impl<'py> Keywords<'py> {
    /// # Errors
    /// A keyword is unknown, or has a value of another type.
    pub fn from_dict(py: Python<'py>, keywords: Option<&Bound<'py, PyDict>>) -> PyResult<Keywords<'py>> {
        let keywords = Unread(keywords.map_or_else(|| Ok(PyDict::new(py)), |keywords| keywords.copy())?);
        let default = Options::default();
        let whole = |name: &str, value: Option<i64>| value.map(|value| natural(name, value)).transpose();
        let effort: Option<String> = keywords.take("effort")?;
        let options = Options {
            full_turn: keywords.take("full_turn")?.unwrap_or(default.full_turn),
            max_link: keywords.take("max_link")?.unwrap_or(default.max_link),
            most: whole("top", keywords.take("top")?)?.unwrap_or(default.most),
            refine: keywords.take("refine")?.unwrap_or(default.refine),
            seed: whole("seed", keywords.take("seed")?)?.map_or(default.seed, |seed| seed as u64),
            effort: effort.map_or(Ok(default.effort), |name| effort_of(&name))?,
            ..default
        };
        let outline = keywords.take_optional("outline")?.map(|name| match name {
            OutlineName::Number(number) => number.to_string(),
            OutlineName::Id(id) => id,
        });
        let read = Keywords {
            outline,
            closed: keywords.take_optional("closed")?,
            part: keywords.take("part")?.unwrap_or_default(),
            angles: keywords.take_optional("angles")?,
            timed: keywords.take("timed")?.unwrap_or_default(),
            condition: keywords.take_optional("where")?,
            index: whole("index", keywords.take_optional("index")?)?,
            atlas: keywords.take_optional("atlas")?,
            fixed: keywords.take("fixed")?.unwrap_or_default(),
            progress: keywords.take_optional("progress")?,
            linkage: keywords.take_optional("linkage")?,
            manifest: keywords.take_optional("manifest")?,
            keep: keywords.take_optional("keep")?,
            pivots: keywords.take_optional("pivots")?,
            options,
        };
        match keywords.0.keys().iter().next() {
            Some(name) => {
                let message = format!("find() got an unexpected keyword argument '{name}'");
                Err(PyTypeError::new_err(message))
            }
            None => Ok(read),
        }
    }

    /// The linkage that they name, if they name one.
    ///
    /// # Errors
    /// There is no such linkage, or what goes with one is given without it, or with an atlas.
    pub fn named_linkage(&self, py: Python) -> PyResult<Option<NamedLinkage>> {
        let wrong = |message: &str| Err(PyValueError::new_err(message.to_owned()));
        match &self.linkage {
            Some(_) if self.atlas.is_some() => wrong("atlas and linkage are two ways to search: give one of them"),
            None if self.manifest.is_some() || self.keep.is_some() => {
                wrong("manifest and keep are about a linkage: give linkage=…")
            }
            None => Ok(None),
            Some(name) => {
                let (template, text) = named_template(py, name, self.manifest.as_deref())?;
                let kept = self.keep.as_ref().map(kept_parameters).transpose()?.unwrap_or_default();
                let own_text = text.and_then(|text| manifest::linkage_text(&text, name));
                Ok(Some(NamedLinkage { searched: SearchedLinkage { template, kept }, own_text }))
            }
        }
    }

    /// What they ask for, of a linkage that they may name.
    pub fn request(&self, linkage: Option<&NamedLinkage>) -> Request<'_> {
        let searched = match linkage {
            Some(linkage) => Searched::Linkage(linkage.searched.clone()),
            None if self.atlas.is_some() => Searched::Atlas,
            None => Searched::FourBars,
        };
        Request {
            notation: Notation::Python,
            searched,
            is_timed: self.timed || self.angles.is_some(),
            is_fixed: self.fixed,
            index: self.index,
            pivots: self.pivots,
            condition: self.condition.as_deref(),
            options: self.options.clone(),
        }
    }
}

fn effort_of(name: &str) -> PyResult<Effort> {
    match name {
        "quick" => Ok(Effort::Quick),
        "normal" => Ok(Effort::Normal),
        "thorough" => Ok(Effort::Thorough),
        other => {
            let message = format!("effort={other:?}: give \"quick\", \"normal\" or \"thorough\"");
            Err(PyValueError::new_err(message))
        }
    }
}

/// The parameters that are not searched, each with its value if it has another than its default.
fn kept_parameters(keep: &Bound<PyAny>) -> PyResult<Vec<(String, Option<String>)>> {
    if let Ok(values) = keep.cast::<PyDict>() {
        return values
            .iter()
            .map(|(name, value)| {
                let value = if value.is_none() { None } else { Some(value.str()?.to_string()) };
                Ok((name.extract()?, value))
            })
            .collect();
    }
    // A string is a sequence of its letters.
    let names = keep.extract::<Vec<String>>().ok().filter(|_| keep.extract::<String>().is_err());
    let Some(names) = names else {
        let kind = keep.get_type().name()?;
        let message = format!("keep: give a list of names or a dict of names and values, and not a {kind}");
        return Err(PyTypeError::new_err(message));
    };
    Ok(names.into_iter().map(|name| (name, None)).collect())
}
