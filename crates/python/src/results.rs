//! What searches return: a sequence of answers, with their records, a manifest and a drawing.

use std::path::PathBuf;

use pyo3::PyClass;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyTuple};

use crate::argument::Index;
use crate::error::Error;
use crate::file::save_svg;
use crate::linkage::into_text;

/// The answers of a search, the best first: a sequence.
#[pyclass(frozen, subclass, module = "coupler_atlas")]
pub struct Results(ResultsRecord);

/// What is recorded of a search.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct ResultsRecord {
    answers: Py<PyTuple>,
    /// The JSON of the answers.
    records: String,
    manifest: String,
    /// A page, as SVG; none if there is nothing to draw.
    drawing: Option<String>,
}

/// What is shown of a search.
pub struct Shown {
    /// The records of the answers, as JSON.
    pub records: serde_json::Result<String>,
    /// A manifest that renders them.
    pub manifest: String,
    /// A page, as SVG; none if there is nothing to draw.
    pub drawing: Option<Vec<u8>>,
}

impl Results {
    pub fn new<T: PyClass>(py: Python, answers: &[Py<T>], shown: Shown) -> PyResult<Results> {
        Ok(Results(ResultsRecord {
            answers: PyTuple::new(py, answers)?.unbind(),
            records: shown.records.map_err(|error| Error::new_err(error.to_string()))?,
            manifest: shown.manifest,
            drawing: shown.drawing.map(into_text),
        }))
    }

    /// Those of a pickle.
    pub fn recorded(record: ResultsRecord) -> Results {
        Results(record)
    }

    /// What a pickle has of them.
    pub fn record(&self) -> &ResultsRecord {
        &self.0
    }

    /// The number of answers.
    pub fn count(&self, py: Python) -> usize {
        self.0.answers.bind(py).len()
    }

    /// The best answer.
    pub fn first<'py, T: PyClass>(&self, py: Python<'py>) -> Option<Bound<'py, T>> {
        self.0.answers.bind(py).get_item(0).ok()?.cast_into().ok()
    }
}

/// Records as dictionaries.
pub fn from_json<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}

#[pymethods]
impl Results {
    /// The answers as dictionaries, as the command prints them with ``--json``: ``pandas.json_normalize(found.records())`` and
    /// ``pyarrow.Table.from_pylist(found.records())`` are tables of them.
    fn records<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_json(py, &self.0.records)
    }

    /// A manifest that renders the linkages, as TOML.
    fn toml(&self) -> &str {
        &self.0.manifest
    }

    /// A page with what was searched for and the best answers, as SVG.
    fn svg(&self) -> PyResult<&str> {
        self.0.drawing.as_deref().ok_or_else(|| PyValueError::new_err("there is nothing to draw: no linkage was found"))
    }

    /// Write that page to a file, as SVG.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        save_svg(&path, self.svg()?)
    }

    /// The page that a notebook shows; nothing if there is nothing to draw.
    fn _repr_svg_(&self) -> Option<&str> {
        self.0.drawing.as_deref()
    }

    fn __len__(&self, py: Python) -> usize {
        self.count(py)
    }

    fn __getitem__<'py>(&self, py: Python<'py>, index: Index<'py>) -> PyResult<Bound<'py, PyAny>> {
        let answers = self.0.answers.bind(py);
        index.of(py, answers.len(), "answer", |index| answers.get_item(index))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.0.answers.bind(py).try_iter()
    }

    fn __reversed__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyTuple::new(py, self.0.answers.bind(py).iter().rev())?.try_iter()
    }
}
