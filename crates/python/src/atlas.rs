//! Atlases and their families.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use coupler_atlas::import;
use coupler_atlas::manifest::PlannedFamily;
use coupler_curves::problem::suggestion;
use pyo3::exceptions::{PyIndexError, PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator};

use crate::argument::{Index, natural, position, toml_text};
use crate::error::Error;
use crate::file::read_text;
use crate::html;
use crate::linkage::into_object;
use crate::manifest::{Manifest, PickledSource, Source};
use crate::overview;
use crate::page::Page;
use crate::reduce::{Reduced, Remake, reduced};

/// A manifest as an argument: its path, or an atlas that has been read.
pub enum ManifestArgument<'py> {
    Atlas(Bound<'py, Atlas>),
    Path(PathBuf),
}

impl<'py> FromPyObject<'_, 'py> for ManifestArgument<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'_, 'py, PyAny>) -> PyResult<ManifestArgument<'py>> {
        if let Ok(atlas) = object.cast::<Atlas>() {
            return Ok(ManifestArgument::Atlas(atlas.to_owned()));
        }
        object.extract().map(ManifestArgument::Path).map_err(|_| {
            let remedy = if object.cast::<Family>().is_ok() { ", with family=… for one of its families" } else { "" };
            let kind = object.get_type().name().map_or_else(|_| "this".to_owned(), |name| format!("a {name}"));
            PyTypeError::new_err(format!("give the path of a manifest or an Atlas{remedy}, and not {kind}"))
        })
    }
}

impl ManifestArgument<'_> {
    /// What it is parsed from.
    pub fn source(&self, py: Python) -> PyResult<Source> {
        match self {
            ManifestArgument::Atlas(atlas) => Ok(atlas.get().manifest.source()),
            ManifestArgument::Path(path) => Ok(Source::new(path.clone(), read_text(py, path)?.into())),
        }
    }

    /// The manifest, for pages of all its cells.
    pub fn read(&self, py: Python) -> PyResult<Manifest> {
        Manifest::for_pages(py, self.source(py)?)?.warned(py)
    }

    /// The manifest, for tables of all its cells.
    pub fn read_for_tables(&self, py: Python) -> PyResult<Manifest> {
        match self {
            ManifestArgument::Atlas(atlas) => Ok(atlas.get().manifest.clone()),
            ManifestArgument::Path(path) => {
                let source = Source::new(path.clone(), read_text(py, path)?.into());
                Manifest::for_tables(py, source, |family| 0..family.cell_count())
            }
        }
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
        (0..self.manifest.plan.families.len()).map(|index| self.family(index)).collect()
    }

    /// The ids of the families, in order.
    fn keys(&self) -> Vec<&str> {
        self.manifest.plan.families.iter().map(|planned| planned.family.id.as_str()).collect()
    }

    /// The families, in order: ``atlas[id]`` for each id.
    fn values(&self) -> Vec<Family> {
        self.families()
    }

    /// The pairs of an id and its family, in order.
    fn items(&self) -> Vec<(&str, Family)> {
        self.keys().into_iter().zip(self.families()).collect()
    }

    /// The family with an id, or `default` if there is none.
    #[pyo3(signature = (id, default=None, /))]
    fn get(&self, py: Python, id: &str, default: Option<Py<PyAny>>) -> PyResult<Option<Py<PyAny>>> {
        match self.keys().iter().position(|key| *key == id) {
            Some(index) => Ok(Some(Py::new(py, self.family(index))?.into_any())),
            None => Ok(default),
        }
    }

    fn __contains__(&self, id: &Bound<PyAny>) -> bool {
        id.extract::<String>().is_ok_and(|id| self.keys().contains(&id.as_str()))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.keys().into_pyobject(py)?.try_iter()
    }

    fn __len__(&self) -> usize {
        self.manifest.plan.families.len()
    }

    fn __getitem__(&self, id: &str) -> PyResult<Family> {
        let keys = self.keys();
        match keys.iter().position(|key| *key == id) {
            Some(index) => Ok(self.family(index)),
            None => Err(PyKeyError::new_err(format!("there is no family `{id}`: {}", suggestion(id, &keys)))),
        }
    }

    /// Whether the other was read from the same text at the same path, with the same cases in files.
    fn __eq__(&self, other: &Bound<PyAny>) -> bool {
        other.cast::<Atlas>().is_ok_and(|other| self.manifest.is_same(&other.get().manifest))
    }

    fn __hash__(&self) -> u64 {
        self.manifest.hash()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Atlas>(py, self.manifest.source().pickled())
    }

    /// A table of its families, with the first page of each, see [`overview`].
    fn _repr_html_(&self, py: Python) -> PyResult<String> {
        /// The linkages that are tried for a plate of a family, and the pixels across it.
        const PLATE: [usize; 2] = [4, 120];
        overview::html(py, &self.manifest, |index| self.family(index).pictures(py, [1, PLATE[0]], PLATE[1]))
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Atlas {:?}: {}>", self.manifest.plan.title, self.keys().join(", "))
    }
}

impl Atlas {
    fn family(&self, index: usize) -> Family {
        Family { manifest: self.manifest.clone(), index }
    }
}

/// A family of an atlas: a sequence of linkages, one for each cell.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Family {
    manifest: Manifest,
    index: usize,
}

impl Family {
    fn planned(&self) -> &PlannedFamily {
        &self.manifest.plan.families[self.index]
    }

    /// The plates of its first linkages that can be assembled: so many at most, of so many that are tried, so many pixels wide.
    fn pictures(&self, py: Python, [most, tried]: [usize; 2], width: usize) -> PyResult<String> {
        let (mut pictures, mut count) = (String::new(), 0);
        for index in 0..self.__len__().min(tried) {
            if count == most {
                break;
            }
            let linkage = self.linkage_of(py, index)?;
            let svg = linkage.bind(py).call_method0("_repr_svg_")?.extract::<Option<String>>()?;
            if let Some(svg) = svg {
                count += 1;
                pictures += &html::picture(&svg, &linkage.bind(py).repr()?.to_string(), width);
            }
        }
        Ok(pictures)
    }

    fn linkage_of(&self, py: Python, index: usize) -> PyResult<Py<PyAny>> {
        into_object(py, self.manifest.cell(&self.planned().family.id, index + 1)?)
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
        for (name, value) in family.names.iter().zip(family.cell(position(index, family.cell_count(), "cell")?).values)
        {
            values.set_item(name, value)?;
        }
        Ok(values)
    }

    /// The linkage of a cell by its number, which is counted from 1, as in file names, tables and names of curves.
    fn cell(&self, py: Python, number: i64) -> PyResult<Py<PyAny>> {
        let count = self.__len__();
        match usize::try_from(number) {
            Ok(number) if (1..=count).contains(&number) => self.linkage_of(py, number - 1),
            _ => Err(PyIndexError::new_err(format!(
                "`{}` has no cell {number}: its cells are numbered from 1 to {count}",
                self.id()
            ))),
        }
    }

    /// One of its pages by its number, which is counted from 1, as in file names: the bytes that ``render`` writes. Of a family with ``where``,
    /// ``sort``, a coupler grid or charts all cells are solved for it.
    fn page(&self, py: Python, number: i64) -> PyResult<Page> {
        let number = natural("number", number)?;
        Page::new(py, Manifest::for_pages(py, self.manifest.source())?.manifest, self.index, number)
    }

    /// The number of cells, those that `where` leaves out included.
    fn __len__(&self) -> usize {
        self.planned().family.cell_count()
    }

    /// The linkage of a cell by its index, from 0; the number of the cell is one more.
    fn __getitem__<'py>(&self, py: Python<'py>, index: Index<'py>) -> PyResult<Bound<'py, PyAny>> {
        index.of(py, self.__len__(), "cell", |index| self.linkage_of(py, index))
    }

    fn __iter__(this: Bound<Family>) -> Cells {
        let count = this.get().__len__();
        Cells { family: this.unbind(), count, next: AtomicUsize::new(0), is_reversed: false }
    }

    fn __reversed__(this: Bound<Family>) -> Cells {
        Cells { is_reversed: true, ..Family::__iter__(this) }
    }

    /// Whether the other is the same family of the same manifest.
    fn __eq__(&self, other: &Bound<PyAny>) -> bool {
        let other = other.cast::<Family>();
        other.is_ok_and(|other| self.index == other.get().index && self.manifest.is_same(&other.get().manifest))
    }

    fn __hash__(&self) -> u64 {
        self.manifest.hash() ^ self.index as u64
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Family>(py, (Atlas { manifest: self.manifest.clone() }, self.index))
    }

    /// The plates of its first linkages that can be assembled, small.
    fn _repr_html_(&self, py: Python) -> PyResult<String> {
        Ok(format!("<p>{}</p>{}", html::escaped(&self.__repr__()), self.pictures(py, [6, 24], 200)?))
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Family {}: {} cells of {}>", self.id(), self.__len__(), self.linkage())
    }
}

/// Iterates over the linkages of a family.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Cells {
    family: Py<Family>,
    count: usize,
    next: AtomicUsize,
    is_reversed: bool,
}

#[pymethods]
impl Cells {
    fn __iter__(this: PyRef<Self>) -> PyRef<Self> {
        this
    }

    fn __next__(&self, py: Python) -> PyResult<Option<Py<PyAny>>> {
        let next = self.next.fetch_add(1, Ordering::Relaxed);
        if next >= self.count {
            return Ok(None);
        }
        let index = if self.is_reversed { self.count - 1 - next } else { next };
        self.family.get().linkage_of(py, index).map(Some)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let next = self.next.load(Ordering::Relaxed);
        reduced::<Cells>(py, (&self.family, self.count, next, self.is_reversed))
    }
}

/// Read a manifest, or a linkage of another program.
///
/// Parameters
/// ----------
/// manifest : path
///     The manifest, a TOML file. Or an address of PMKS+, an expression of Pyslvs, or a file with one of them, a file of Linkage, pylinkage, LINKS or
///     linkage_sim, or a table of joints, whose linkage is the family ``"imported"``, as ``coupler-atlas import`` prints it.
/// input : str, optional
///     What drives a linkage of another program, in place of what its text says: two joints of a link, as in ``"A, B"``.
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
/// Error
///     What another program has written is wrong, or cannot be drawn.
#[pyfunction]
#[pyo3(signature = (manifest, *, input=None))]
pub fn read(py: Python, manifest: PathBuf, input: Option<&str>) -> PyResult<Atlas> {
    let word = manifest.to_str().filter(|word| import::is_text(word) && !manifest.is_file());
    let text = word.map_or_else(|| read_text(py, &manifest), |word| Ok(word.to_owned()))?;
    let path = word.map_or(manifest.clone(), |_| PathBuf::from("imported.toml"));
    read_source(py, source_of((path, text), word.is_some(), input)?)
}

/// Read a manifest, or a linkage of another program, in memory.
///
/// Parameters
/// ----------
/// manifest : str or dict
///     The text of a manifest, or what it says as a dictionary, as ``tomllib`` reads it; or a text of another program, as of ``read``.
/// path : path, optional
///     Where the manifest would be, which messages name; the files that it names are relative to its folder.
/// input : str, optional
///     What drives a linkage of another program.
///
/// Returns
/// -------
/// Atlas
///     Its families and their linkages. Nothing is solved yet.
///
/// Raises
/// ------
/// ManifestError
///     The manifest has errors.
/// TypeError
///     The dictionary has a value that no manifest has.
#[pyfunction]
#[pyo3(signature = (manifest, *, path=PathBuf::from("manifest.toml"), input=None))]
pub fn parse(py: Python, manifest: Bound<PyAny>, path: PathBuf, input: Option<&str>) -> PyResult<Atlas> {
    read_source(py, source_of((path, toml_text(&manifest)?), false, input)?)
}

/// A manifest of a text at a path, which may be one of another program, and is so where that is known.
fn source_of((path, text): (PathBuf, String), is_foreign: bool, input: Option<&str>) -> PyResult<Source> {
    if is_foreign || import::is_foreign(&text) {
        let drawing = import::read(&text, None, input).map_err(|error| Error::new_err(error.to_string()))?;
        return Ok(Source::new(path.with_extension("toml"), import::manifest_text(&drawing).into()));
    }
    match input {
        Some(_) => Err(PyValueError::new_err(
            "input is for linkages of other programs: a manifest says what drives its linkages",
        )),
        None => Ok(Source::new(path, text.into())),
    }
}

fn read_source(py: Python, source: Source) -> PyResult<Atlas> {
    Ok(Atlas { manifest: Manifest::for_tables(py, source, |family| 0..family.cell_count())? })
}

impl Remake for Atlas {
    type State = PickledSource;

    fn remake(py: Python, source: PickledSource) -> PyResult<Py<PyAny>> {
        let manifest = Manifest::for_tables(py, Source::from_pickle(source), |_| 0..0)?;
        Ok(Py::new(py, Atlas { manifest })?.into_any())
    }
}

impl Remake for Family {
    type State = (Py<Atlas>, usize);

    fn remake(py: Python, (atlas, index): (Py<Atlas>, usize)) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, atlas.get().family(index))?.into_any())
    }
}

impl Remake for Cells {
    type State = (Py<Family>, usize, usize, bool);

    fn remake(py: Python, (family, count, next, is_reversed): Self::State) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Cells { family, count, next: AtomicUsize::new(next), is_reversed })?.into_any())
    }
}
