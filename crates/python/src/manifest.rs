//! Manifests with their texts.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use coupler_atlas::manifest::{self, ParseOutcome, Plan, PlannedFamily};
use coupler_atlas::manifest_files::ManifestFiles;
use coupler_curves::family::Family;
use coupler_curves::problem::suggestion;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;

use crate::error;
use crate::linkage::{Linkage, Recipe};
use crate::task;

/// A manifest with its path and text.
#[derive(Clone)]
pub struct Manifest {
    pub path: PathBuf,
    pub text: Arc<str>,
    pub plan: Arc<Plan>,
}

impl Manifest {
    /// A manifest for tables of some cells, see [`manifest::parse_for_tables`].
    pub fn for_tables(
        py: Python,
        path: PathBuf,
        text: Arc<str>,
        cells: impl Fn(&Family) -> Range<usize> + Send + 'static,
    ) -> PyResult<Manifest> {
        let (own, from) = (text.clone(), path.clone());
        let outcome = task::run_with(py, None, move |_| {
            manifest::parse_for_tables(&own, Some(&ManifestFiles::new(&from)), &cells)
        })?;
        Manifest::from_outcome(py, path, text, outcome)
    }

    pub fn from_outcome(py: Python, path: PathBuf, text: Arc<str>, outcome: ParseOutcome) -> PyResult<Manifest> {
        match outcome.plan {
            Some(plan) => {
                error::warn(py, &path, &text, &outcome.problems)?;
                Ok(Manifest { path, text, plan: Arc::new(plan) })
            }
            None => Err(error::manifest_error(py, &path, &text, &outcome.problems)),
        }
    }

    /// The linkage of a cell by the id of its family and its number, from 1.
    pub fn cell(&self, id: &str, number: usize) -> PyResult<Linkage> {
        let PlannedFamily { family, source, .. } = self.family(Some(id))?;
        let index = family.cell_index(number).map_err(|error| PyIndexError::new_err(error.to_string()))?;
        let (path, text) = (self.path.clone(), self.text.clone());
        let recipe = Recipe::Cell { path, text, family: id.to_owned(), number };
        Ok(Linkage::new(family.with_case(family.case(index)), source.clone(), recipe))
    }

    /// The family with an id, or the only one.
    pub fn family(&self, id: Option<&str>) -> PyResult<&PlannedFamily> {
        let families = &self.plan.families;
        let ids: Vec<&str> = families.iter().map(|planned| planned.family.id.as_str()).collect();
        match (id, &families[..]) {
            (None, [only]) => Ok(only),
            (None, _) => Err(PyValueError::new_err(format!(
                "{} has several families, each with columns of its own: name one, as in family={:?}, of {}",
                self.path.display(),
                ids.first().unwrap_or(&""),
                ids.join(", ")
            ))),
            (Some(id), _) => families
                .iter()
                .find(|planned| planned.family.id == id)
                .ok_or_else(|| PyValueError::new_err(format!("there is no family `{id}`: {}", suggestion(id, &ids)))),
        }
    }

    /// Whether the other has the same text at the same path.
    pub fn is_same(&self, other: &Manifest) -> bool {
        self.path == other.path && self.text == other.text
    }

    /// The same of two that are the same.
    pub fn hash(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (&self.path, &self.text).hash(&mut hasher);
        hasher.finish()
    }

    /// Checks that each id is that of a family.
    pub fn require_families(&self, only: &[String]) -> PyResult<()> {
        only.iter().try_for_each(|id| self.family(Some(id)).map(drop))
    }
}
