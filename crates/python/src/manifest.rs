//! Manifests with their texts.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use coupler_atlas::manifest::{self, ParseOutcome, Plan, PlannedFamily};
use coupler_atlas::manifest_files::{KnownTable, ManifestFiles};
use coupler_curves::family::Family;
use coupler_curves::problem::{Problem, suggestion};
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

/// What a manifest is parsed from: its path, its text, and the tables of cases that have been read before.
#[derive(Clone)]
pub struct Source {
    pub path: PathBuf,
    pub text: Arc<str>,
    pub tables: Vec<KnownTable>,
}

/// A [`Source`] in a pickle: its path and text, and of each table the path, the names of its columns, and the bytes of its values.
pub type PickledSource = (PathBuf, String, Vec<(String, Vec<String>, Vec<u8>)>);

impl Source {
    /// One whose tables are to be read.
    pub fn new(path: PathBuf, text: Arc<str>) -> Source {
        Source { path, text, tables: Vec::new() }
    }

    /// That of a pickle.
    pub fn from_pickle((path, text, tables): PickledSource) -> Source {
        let value = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_le_bytes);
        let table = |(path, names, bytes): (String, Vec<String>, Vec<u8>)| {
            let values = Arc::new(bytes.chunks_exact(size_of::<f64>()).map(value).collect());
            KnownTable { path, names, values }
        };
        Source { path, text: text.into(), tables: tables.into_iter().map(table).collect() }
    }

    /// It in a pickle.
    pub fn pickled(&self) -> PickledSource {
        let bytes = |table: &KnownTable| table.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let tables = self.tables.iter().map(|table| (table.path.clone(), table.names.clone(), bytes(table)));
        (self.path.clone(), self.text.to_string(), tables.collect())
    }

    /// What reads the files that the manifest names.
    pub fn files(&self) -> ManifestFiles {
        ManifestFiles::new(&self.path).with_tables(self.tables.clone())
    }
}

/// A manifest that can be used, and what is to be warned of.
pub struct ReadManifest {
    pub manifest: Manifest,
    pub problems: Vec<Problem>,
}

impl ReadManifest {
    /// The manifest, after its warnings.
    pub fn warned(self, py: Python) -> PyResult<Manifest> {
        let ReadManifest { manifest, problems } = self;
        error::warn(py, &manifest.path, &manifest.text, &problems)?;
        Ok(manifest)
    }
}

impl Manifest {
    /// A manifest for tables of some cells, see [`manifest::parse_for_tables`].
    pub fn for_tables(
        py: Python,
        source: Source,
        cells: impl Fn(&Family) -> Range<usize> + Send + 'static,
    ) -> PyResult<Manifest> {
        let Source { path, text, .. } = source.clone();
        let outcome =
            task::run_with(py, None, move |_| manifest::parse_for_tables(&source.text, Some(&source.files()), &cells))?;
        Manifest::from_outcome(py, path, text, outcome)?.warned(py)
    }

    /// A manifest for pages of all its cells.
    pub fn for_pages(py: Python, source: Source) -> PyResult<ReadManifest> {
        let Source { path, text, .. } = source.clone();
        let outcome =
            task::run_with(py, None, move |_| manifest::parse_with_files(&source.text, Some(&source.files())))?;
        Manifest::from_outcome(py, path, text, outcome)
    }

    fn from_outcome(py: Python, path: PathBuf, text: Arc<str>, outcome: ParseOutcome) -> PyResult<ReadManifest> {
        let ParseOutcome { plan, problems } = outcome;
        match plan {
            Some(plan) => Ok(ReadManifest { manifest: Manifest { path, text, plan: Arc::new(plan) }, problems }),
            None => Err(error::manifest_error(py, &path, &text, &problems)),
        }
    }

    /// What it was parsed from.
    pub fn source(&self) -> Source {
        Source { path: self.path.clone(), text: self.text.clone(), tables: KnownTable::of_plan(&self.plan) }
    }

    /// The linkage of a cell by the id of its family and its number, from 1.
    pub fn cell(&self, id: &str, number: usize) -> PyResult<Linkage> {
        let planned = self.family(Some(id))?;
        let PlannedFamily { family, source, .. } = planned;
        let index = family.cell_index(number).map_err(|error| PyIndexError::new_err(error.to_string()))?;
        let case = family.case(index);
        // A linkage is made again without the tables of all others.
        let has_tables = self.plan.families.iter().any(|planned| planned.case_file.is_some());
        let values = || case.iter().map(|(slot, value)| (family.names[*slot].clone(), *value)).collect();
        let (text, values) = match has_tables {
            true => (planned.excerpt().into(), Some(values())),
            false => (self.text.clone(), None),
        };
        let recipe = Recipe::Cell { path: self.path.clone(), text, family: id.to_owned(), number, values };
        Ok(Linkage::new(family.with_case(case), source.clone(), recipe))
    }

    /// A cell of a family with these values, and a number that it has in another manifest.
    pub fn cell_with(&self, id: &str, number: usize, values: Vec<(String, f64)>) -> PyResult<Linkage> {
        let PlannedFamily { family, source, .. } = self.family(Some(id))?;
        let slot = |name: &str| family.names.iter().position(|own| own == name);
        let case = values.iter().filter_map(|(name, value)| Some((slot(name)?, *value))).collect();
        let (path, text) = (self.path.clone(), self.text.clone());
        let recipe = Recipe::Cell { path, text, family: id.to_owned(), number, values: Some(values) };
        Ok(Linkage::new(family.with_case(case), source.clone(), recipe))
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

    /// Whether the other has the same text at the same path, and the same cases in files.
    pub fn is_same(&self, other: &Manifest) -> bool {
        let case_files = |manifest: &Manifest| -> Vec<_> {
            manifest.plan.families.iter().map(|planned| planned.case_file.clone()).collect()
        };
        self.path == other.path && self.text == other.text && case_files(self) == case_files(other)
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
