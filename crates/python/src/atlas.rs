//! Manifests, and the atlases they describe.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use coupler_atlas::manifest::{self, ParseOutcome, Plan, PlannedFamily};
use coupler_atlas::output;
use coupler_curves::problem::suggestion;
use pyo3::exceptions::{PyFileNotFoundError, PyIndexError, PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{self, OutputError};
use crate::linkage::Linkage;
use crate::task;

/// A manifest with its path and text.
#[derive(Clone)]
pub struct Manifest {
    pub path: PathBuf,
    pub text: Arc<str>,
    pub plan: Arc<Plan>,
}

/// A manifest as an argument: its path, or an atlas that has been read.
#[derive(FromPyObject)]
pub enum ManifestArgument<'py> {
    Atlas(Bound<'py, Atlas>),
    Path(PathBuf),
}

impl ManifestArgument<'_> {
    /// Its path and its text.
    pub fn text(&self, py: Python) -> PyResult<(PathBuf, Arc<str>)> {
        match self {
            ManifestArgument::Atlas(atlas) => {
                let Manifest { path, text, .. } = &atlas.get().manifest;
                Ok((path.clone(), text.clone()))
            }
            ManifestArgument::Path(path) => Ok((path.clone(), read_text(py, path)?.into())),
        }
    }

    /// The manifest, for pages of all its cells.
    pub fn read(&self, py: Python) -> PyResult<Manifest> {
        match self {
            ManifestArgument::Atlas(atlas) => Ok(atlas.get().manifest.clone()),
            ManifestArgument::Path(path) => Manifest::read(py, path),
        }
    }
}

/// Reads the text of a file.
pub fn read_text(py: Python, path: &Path) -> PyResult<String> {
    py.detach(|| output::read_text(path)).map_err(|error| match &error {
        output::Error::Read { source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(error.to_string())
        }
        _ => OutputError::new_err(error.to_string()),
    })
}

impl Manifest {
    fn read(py: Python, path: &Path) -> PyResult<Manifest> {
        let text: Arc<str> = read_text(py, path)?.into();
        let (own, from) = (text.clone(), path.to_owned());
        let outcome = task::run_with(py, None, move |_| {
            manifest::parse_with_files(&own, Some(&|name| output::read_font(&from, name)))
        })?;
        Manifest::from_outcome(py, path.to_owned(), text, outcome)
    }

    /// A manifest for tables of some cells, see [`manifest::parse_for_tables`].
    pub fn for_tables(
        py: Python,
        path: PathBuf,
        text: Arc<str>,
        cells: impl Fn(&str, usize) -> Range<usize> + Send + 'static,
    ) -> PyResult<Manifest> {
        let (own, from) = (text.clone(), path.clone());
        let outcome = task::run_with(py, None, move |_| {
            manifest::parse_for_tables(&own, Some(&|name| output::read_font(&from, name)), &cells)
        })?;
        Manifest::from_outcome(py, path, text, outcome)
    }

    fn from_outcome(py: Python, path: PathBuf, text: Arc<str>, outcome: ParseOutcome) -> PyResult<Manifest> {
        match outcome.plan {
            Some(plan) => {
                error::warn(py, &path, &text, &outcome.problems)?;
                Ok(Manifest { path, text, plan: Arc::new(plan) })
            }
            None => Err(error::manifest_error(py, &path, &text, &outcome.problems)),
        }
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

    /// Checks that each id is that of a family.
    pub fn require_families(&self, only: &[String]) -> PyResult<()> {
        only.iter().try_for_each(|id| self.family(Some(id)).map(drop))
    }
}

/// An atlas as its manifest describes it: families of linkages.
///
/// ``atlas["evans"]`` is a family, and ``atlas["evans"][0]`` the linkage of its first cell.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Atlas {
    pub manifest: Manifest,
}

#[pymethods]
impl Atlas {
    /// The title.
    #[getter]
    fn title(&self) -> &str {
        &self.manifest.plan.title
    }

    /// The path of the manifest.
    #[getter]
    fn path(&self) -> PathBuf {
        self.manifest.path.clone()
    }

    /// The families, in order.
    #[getter]
    fn families(&self) -> Vec<Family> {
        (0..self.manifest.plan.families.len()).map(|index| Family { plan: self.manifest.plan.clone(), index }).collect()
    }

    /// The ids of the families, in order.
    fn keys(&self) -> Vec<&str> {
        self.manifest.plan.families.iter().map(|planned| planned.family.id.as_str()).collect()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.keys().into_pyobject(py)?.call_method0("__iter__")
    }

    fn __len__(&self) -> usize {
        self.manifest.plan.families.len()
    }

    fn __getitem__(&self, id: &str) -> PyResult<Family> {
        let keys = self.keys();
        match keys.iter().position(|key| *key == id) {
            Some(index) => Ok(Family { plan: self.manifest.plan.clone(), index }),
            None => Err(PyKeyError::new_err(format!("there is no family `{id}`: {}", suggestion(id, &keys)))),
        }
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Atlas {:?}: {}>", self.manifest.plan.title, self.keys().join(", "))
    }
}

/// A family of an atlas: a sequence of linkages, one for each cell.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Family {
    plan: Arc<Plan>,
    index: usize,
}

impl Family {
    fn planned(&self) -> &PlannedFamily {
        &self.plan.families[self.index]
    }
}

#[pymethods]
impl Family {
    /// The id.
    #[getter]
    fn id(&self) -> &str {
        &self.planned().family.id
    }

    /// The title.
    #[getter]
    fn title(&self) -> &str {
        &self.planned().family.title
    }

    /// The id of its linkage.
    #[getter]
    fn linkage(&self) -> &str {
        &self.planned().family.template.id
    }

    /// The names of the parameters of the linkage, and of the helpers of the family after them.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.planned().family.names.iter().map(String::as_str).collect()
    }

    /// The values of the names in a cell, by its index from 0.
    fn values<'py>(&self, py: Python<'py>, index: isize) -> PyResult<Bound<'py, PyDict>> {
        let family = &self.planned().family;
        let values = PyDict::new(py);
        for (name, value) in family.names.iter().zip(family.cell(self.cell_index(index)?).values) {
            values.set_item(name, value)?;
        }
        Ok(values)
    }

    /// The linkage of a cell by its number, which is counted from 1, as in file names, tables and names of curves.
    fn cell(&self, number: isize) -> PyResult<Linkage> {
        match number {
            1.. => self.__getitem__(number - 1),
            _ => Err(PyIndexError::new_err(format!(
                "{number} is the number of no cell: they are numbered from 1 to {}",
                self.__len__()
            ))),
        }
    }

    /// The number of cells, those that `where` leaves out included.
    fn __len__(&self) -> usize {
        self.planned().family.cell_count()
    }

    /// The linkage of a cell by its index, from 0; the number of the cell is one more.
    fn __getitem__(&self, index: isize) -> PyResult<Linkage> {
        let PlannedFamily { family, source, .. } = self.planned();
        let index = self.cell_index(index)?;
        Ok(Linkage::new(family.with_case(family.case(index)), source.clone(), Some(index + 1)))
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Family {}: {} cells of {}>", self.id(), self.__len__(), self.linkage())
    }
}

impl Family {
    fn cell_index(&self, index: isize) -> PyResult<usize> {
        let count = self.__len__();
        let from_start = if index < 0 { index + count as isize } else { index };
        usize::try_from(from_start).ok().filter(|index| *index < count).ok_or_else(|| {
            PyIndexError::new_err(format!("`{}` has no cell of index {index}: it has {count} cells", self.id()))
        })
    }
}

/// Read a manifest.
///
/// Parameters
/// ----------
/// manifest : path
///     The manifest, a TOML file.
///
/// Returns
/// -------
/// Atlas
///     Its families and their linkages. Nothing is solved yet.
///
/// Raises
/// ------
/// ManifestError
///     The manifest has errors; the message has each with its place, and `problems` as data.
/// FileNotFoundError
///     There is no such file.
#[pyfunction]
pub fn read(py: Python, manifest: PathBuf) -> PyResult<Atlas> {
    Ok(Atlas { manifest: Manifest::read(py, &manifest)? })
}
