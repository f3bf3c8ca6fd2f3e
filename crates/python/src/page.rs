//! Pages of atlases in memory.

use std::path::PathBuf;

use coupler_atlas::output::{self, ComposedPage};
use coupler_drawing::render::PageFormat;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{self, OutputError};
use crate::file::save;
use crate::linkage::into_text;
use crate::manifest::{Manifest, PickledSource, Source};
use crate::reduce::{Reduced, Remake, reduced};
use crate::task;

/// A page of a family in memory, with the bytes of the file that ``render`` writes. A notebook shows it.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Page {
    manifest: Manifest,
    index: usize,
    page: ComposedPage,
}

impl Page {
    /// A page by the index of its family and its number, from 1. The manifest has been parsed for pages.
    pub fn new(py: Python, manifest: Manifest, index: usize, number: usize) -> PyResult<Page> {
        match composed(py, &manifest, index, number)? {
            Ok(page) => Ok(Page { manifest, index, page }),
            Err(error @ output::Error::NoSuchPage { .. }) => Err(PyIndexError::new_err(error.to_string())),
            Err(error) => Err(OutputError::new_err(error.to_string())),
        }
    }

    fn bytes(&self, py: Python, format: PageFormat) -> PyResult<Vec<u8>> {
        let Manifest { path, text, plan } = &self.manifest;
        if format != PageFormat::Svg && !plan.undrawable.is_empty() {
            return Err(error::manifest_error(py, path, text, &plan.undrawable));
        }
        let bytes = py.detach(|| self.page.render(plan, format));
        bytes.map_err(|error| OutputError::new_err(error.to_string()))
    }
}

/// Composes a page by the index of its family and its number, from 1, or says why there is none.
///
/// # Errors
/// Ctrl-C.
pub fn composed(
    py: Python,
    manifest: &Manifest,
    index: usize,
    number: usize,
) -> PyResult<Result<ComposedPage, output::Error>> {
    let plan = manifest.plan.clone();
    task::run_with(py, None, move |task| ComposedPage::new(&plan, &plan.families[index], number, &task.interrupt))
}

#[pymethods]
impl Page {
    /// The id of its family.
    #[getter]
    fn family(&self) -> &str {
        &self.manifest.plan.families[self.index].family.id
    }

    /// Its number, from 1.
    #[getter]
    fn number(&self) -> usize {
        self.page.number
    }

    /// The number of pages of its family.
    #[getter]
    fn count(&self) -> usize {
        self.page.count
    }

    /// The page as SVG.
    fn svg(&self, py: Python) -> PyResult<String> {
        self.bytes(py, PageFormat::Svg).map(into_text)
    }

    /// The page as PNG, with the `dpi` of the manifest.
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.bytes(py, PageFormat::Png)?))
    }

    /// Write the page to a file, as ``.svg`` or ``.png``, which its name says.
    fn save(&self, py: Python, path: PathBuf) -> PyResult<()> {
        let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_lowercase()).unwrap_or_default();
        let format = PageFormat::ALL.into_iter().find(|format| format.name() == suffix).ok_or_else(|| {
            PyValueError::new_err(format!("{}: give a name that ends in .svg or .png", path.display()))
        })?;
        save(&path, &self.bytes(py, format)?)
    }

    /// What a notebook shows.
    fn _repr_svg_(&self, py: Python) -> PyResult<String> {
        self.svg(py)
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Page {} of {} of {}>", self.number(), self.count(), self.family())
    }

    /// Whether the other is the same page of the same manifest.
    fn __eq__(&self, other: &Bound<PyAny>) -> bool {
        let is_same = |other: &Page| {
            (self.index, self.page.number) == (other.index, other.page.number) && self.manifest.is_same(&other.manifest)
        };
        other.cast::<Page>().is_ok_and(|other| is_same(other.get()))
    }

    fn __hash__(&self) -> u64 {
        self.manifest.hash() ^ self.index as u64 ^ (self.page.number as u64).rotate_left(32)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Page>(py, (self.manifest.source().pickled(), self.index, self.page.number))
    }
}

impl Remake for Page {
    type State = (PickledSource, usize, usize);

    fn remake(py: Python, (source, index, number): Self::State) -> PyResult<Py<PyAny>> {
        let manifest = Manifest::for_pages(py, Source::from_pickle(source))?.manifest;
        Ok(Py::new(py, Page::new(py, manifest, index, number)?)?.into_any())
    }
}
