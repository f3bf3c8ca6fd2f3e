//! Atlases written to a folder.

use std::path::PathBuf;

use coupler_atlas::output;
use coupler_atlas::record::RunRecord;
use coupler_drawing::render::Format;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::argument;
use crate::atlas::ManifestArgument;
use crate::error::{self, Error, OutputError};
use crate::manifest::Manifest;
use crate::reduce::{Reduced, Remake, reduced};
use crate::task::{self, Task};

/// An atlas that has been rendered.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Rendering {
    /// The folder of the atlas.
    #[pyo3(get)]
    folder: PathBuf,
    run: RunRecord,
    /// The number of pages that were drawn; the others were up to date.
    #[pyo3(get)]
    drawn: usize,
}

#[pymethods]
impl Rendering {
    /// The number of pages of all families.
    #[getter]
    fn pages(&self) -> usize {
        self.run.families.iter().map(|family| family.pages).sum()
    }

    /// The paths of all files of the atlas, in order.
    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        let own = |name: &str| self.folder.join(name);
        let families = self.run.families.iter();
        let of_families =
            families.flat_map(|family| family.files.iter().map(|file| self.folder.join(&family.id).join(&file.name)));
        let book = self.run.book.iter().flat_map(|book| &book.files).map(|file| own(&file.name));
        let gallery = self.run.gallery.iter().chain(&self.run.kernel).map(|file| own(&file.name));
        of_families.chain(book).chain(gallery).collect()
    }

    /// The page that shows the whole atlas in a browser, if there is one.
    #[getter]
    fn gallery(&self) -> Option<PathBuf> {
        self.run.gallery.as_ref().map(|file| self.folder.join(&file.name))
    }

    /// For each family a dictionary of its ``id`` and numbers: ``cells``, ``kept``, ``not_assembled``, ``curves``, ``pages``.
    #[getter]
    fn families<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for family in &self.run.families {
            let item = PyDict::new(py);
            item.set_item("id", &family.id)?;
            item.set_item("cells", family.cells)?;
            item.set_item("kept", family.kept)?;
            item.set_item("not_assembled", family.not_assembled + family.unassembled_left_out)?;
            item.set_item("curves", family.curves)?;
            item.set_item("pages", family.pages)?;
            list.append(item)?;
        }
        Ok(list)
    }

    fn __repr__(&self) -> String {
        let (families, pages) = (self.run.families.len(), self.pages());
        format!(
            "<coupler_atlas.Rendering in {}: families: {families}, pages: {pages}, drawn: {}>",
            self.folder.display(),
            self.drawn
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let run = serde_json::to_string(&self.run).map_err(|error| Error::new_err(error.to_string()))?;
        reduced::<Rendering>(py, (&self.folder, run, self.drawn))
    }
}

impl Remake for Rendering {
    type State = (PathBuf, String, usize);

    fn remake(py: Python, (folder, run, drawn): Self::State) -> PyResult<Py<PyAny>> {
        let run = serde_json::from_str(&run).map_err(|error| Error::new_err(error.to_string()))?;
        Ok(Py::new(py, Rendering { folder, run, drawn })?.into_any())
    }
}

/// Render an atlas: solve its families, and write its pages, tables and gallery.
///
/// Pages that are up to date are kept.
///
/// Parameters
/// ----------
/// manifest : path or Atlas
///     The manifest.
/// output : path, optional
///     The folder to write to; by default that of the manifest.
/// formats : list of str, optional
///     The formats of pages in place of the manifest's: ``svg``, ``png``, ``pdf``.
/// only : list of str, optional
///     The ids of the families to render; the files of others are left as they are.
/// force : bool
///     Draw every page, including those that are up to date.
/// overwrite : bool
///     Replace the atlas of another manifest, and files that no earlier run wrote.
/// repair : bool
///     Rebuild a record that is lost or damaged from the files that are as the manifest makes them; no other file is changed.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// Rendering
///     What is in the folder.
///
/// Raises
/// ------
/// ManifestError
///     The manifest has errors.
/// OutputError
///     The folder cannot be written, or belongs to another manifest.
#[pyfunction]
#[pyo3(signature = (manifest, output=None, *, formats=None, only=None, force=false, overwrite=false, repair=false, progress=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn render(
    py: Python,
    manifest: ManifestArgument,
    output: Option<PathBuf>,
    formats: Option<Vec<String>>,
    only: Option<Vec<String>>,
    force: bool,
    overwrite: bool,
    repair: bool,
    progress: Option<Bound<PyAny>>,
) -> PyResult<Rendering> {
    let manifest = manifest.read(py)?;
    let Manifest { path, text, plan } = manifest.clone();
    let only = argument::only(only)?;
    if repair && !only.is_empty() {
        return Err(PyValueError::new_err("repair is of the whole atlas: leave out only"));
    }
    manifest.require_families(&only)?;
    let formats =
        formats.map(|names| names.iter().map(|name| format(name)).collect::<PyResult<Vec<_>>>()).transpose()?;
    if formats.iter().flatten().any(|format| *format != Format::Svg) && !plan.undrawable.is_empty() {
        return Err(error::manifest_error(py, &path, &text, &plan.undrawable));
    }
    let folder = match output {
        Some(folder) => folder,
        None => output::default_folder(&plan, &path).ok_or_else(|| {
            PyValueError::new_err(format!("{} names no folder to write to: give output=…", path.display()))
        })?,
    };
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
    let to = folder.clone();
    let rendered = task::run(py, progress.as_ref(), move |task: &Task| {
        let interrupt = task.interrupt.clone();
        let options = output::Options { formats, only, force, overwrite, repair, manifest: name, interrupt };
        let mut pages_drawn = 0;
        let run = output::write_atlas(&plan, &to, &options, &mut |event| match event {
            output::Event::Begin { family, pages } => task.begin(family, pages),
            output::Event::Page => task.advance(1),
            output::Event::End { drawn, .. } => pages_drawn += drawn.unwrap_or(0),
            _ => {}
        })?;
        let warnings = output::empty_family_warnings(&plan, Some(&run));
        Ok::<_, output::Error>((run, warnings, pages_drawn))
    })?;
    let (run, warnings, drawn) = rendered.map_err(|error| OutputError::new_err(error.to_string()))?;
    error::warn(py, &path, &text, &warnings)?;
    Ok(Rendering { folder, run, drawn })
}

fn format(name: &str) -> PyResult<Format> {
    let found = Format::ALL.into_iter().find(|format| format.name() == name && format.is_built_in());
    found.ok_or_else(|| {
        let known: Vec<&str> =
            Format::ALL.iter().filter(|format| format.is_built_in()).map(|format| format.name()).collect();
        PyValueError::new_err(format!("formats: unknown format {name:?}: give any of {}", known.join(", ")))
    })
}
