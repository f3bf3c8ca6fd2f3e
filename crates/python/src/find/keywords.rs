//! The keywords of a search.

use std::path::PathBuf;

use coupler_atlas::find::{Notation, Request, Searched, Several};
use coupler_find::Options;
use numpy::{AllowTypeChange, PyArrayLike1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::atlas::ManifestArgument;
use crate::keywords::{Kept, Unread};
use crate::linkage::NamedLinkage;

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
    keep: Vec<Kept>,
    pivots: Option<[f64; 4]>,
    options: Options,
}

impl<'py> Keywords<'py> {
    /// # Errors
    /// A keyword is unknown, or has a value of another type.
    pub fn from_dict(py: Python<'py>, keywords: Option<&Bound<'py, PyDict>>) -> PyResult<Keywords<'py>> {
        let keywords = Unread::new(py, "find", keywords)?;
        let default = Options::default();
        let options = Options {
            full_turn: keywords.take("full_turn")?.unwrap_or(default.full_turn),
            max_link: keywords.take("max_link")?.unwrap_or(default.max_link),
            most: keywords.take_whole("top")?.unwrap_or(default.most),
            refine: keywords.take("refine")?.unwrap_or(default.refine),
            seed: keywords.take_whole("seed")?.map_or(default.seed, |seed| seed as u64),
            effort: keywords.take_effort()?.unwrap_or(default.effort),
            ..default
        };
        let read = Keywords {
            outline: keywords.take_outline()?,
            closed: keywords.take_optional("closed")?,
            part: keywords.take("part")?.unwrap_or_default(),
            angles: keywords.take_optional("angles")?,
            timed: keywords.take("timed")?.unwrap_or_default(),
            condition: keywords.take_optional("where")?,
            index: keywords.take_optional_whole("index")?,
            atlas: keywords.take_optional("atlas")?,
            fixed: keywords.take("fixed")?.unwrap_or_default(),
            progress: keywords.take_optional("progress")?,
            linkage: keywords.take_optional("linkage")?,
            manifest: keywords.take_optional("manifest")?,
            keep: keywords.take_kept("keep")?,
            pivots: keywords.take_optional("pivots")?,
            options,
        };
        keywords.finish()?;
        Ok(read)
    }

    /// The linkage that they name, if they name one.
    ///
    /// # Errors
    /// There is no such linkage, or what goes with one is given without it, or with an atlas.
    pub fn named_linkage(&self, py: Python) -> PyResult<Option<NamedLinkage>> {
        let wrong = |message: &str| Err(PyValueError::new_err(message.to_owned()));
        match &self.linkage {
            Some(_) if self.atlas.is_some() => wrong("atlas and linkage are two ways to search: give one of them"),
            None if self.manifest.is_some() || !self.keep.is_empty() => {
                wrong("manifest and keep are about a linkage: give linkage=…")
            }
            None => Ok(None),
            Some(_) if self.several().is_some() => match self.keep.is_empty() {
                true => Ok(None),
                false => wrong("keep keeps parameters of one linkage, and linkage names several: leave it out"),
            },
            Some(name) => NamedLinkage::find(py, name, self.manifest.as_deref(), self.keep.clone()).map(Some),
        }
    }

    /// The several linkages that they name, if they do and no manifest has a linkage of this name.
    pub fn several(&self) -> Option<Several> {
        self.linkage.as_deref().filter(|_| self.manifest.is_none()).and_then(Several::named)
    }

    /// What they ask for, of a linkage that they may name.
    pub fn request(&self, linkage: Option<&NamedLinkage>) -> Request<'_> {
        let searched = match linkage {
            Some(linkage) => Searched::Linkage(linkage.searched.clone()),
            None if self.atlas.is_some() => Searched::Atlas,
            None => self.several().map_or(Searched::FourBars, Searched::Several),
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
