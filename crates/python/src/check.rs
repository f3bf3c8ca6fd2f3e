//! Atlases compared with a fresh run.

use std::collections::BTreeMap;
use std::path::PathBuf;

use coupler_atlas::check;
use coupler_atlas::cli;
use coupler_atlas::manifest::{PartialTolerances, tolerated_names};
use coupler_curves::problem::suggestion;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::argument;
use crate::atlas::ManifestArgument;
use crate::error::{Error, OutputError};
use crate::manifest::Manifest;
use crate::reduce::{Reduced, Remake, reduced};
use crate::results::from_json;
use crate::task::{self, Task};

/// The result of a check. It is true if nothing differs; as text it is the report of the program.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Report(ReportRecord);

/// What is recorded of a check.
#[derive(FromPyObject, IntoPyObjectRef)]
#[pyo3(from_item_all)]
pub struct ReportRecord {
    has_differences: bool,
    families: usize,
    curves: usize,
    pages: usize,
    left_out: BTreeMap<String, usize>,
    counts: BTreeMap<String, usize>,
    /// The JSON of the findings, and how many there are.
    findings: String,
    finding_count: usize,
    /// The report of the program.
    text: String,
}

impl ReportRecord {
    fn new(report: &check::Report) -> serde_json::Result<ReportRecord> {
        let check::LeftOut { images, volumes, gallery_files } = report.left_out;
        let left_out = [("images", images), ("volumes", volumes), ("gallery_files", gallery_files)];
        Ok(ReportRecord {
            has_differences: report.has_differences(),
            families: report.families,
            curves: report.curves,
            pages: report.pages,
            left_out: left_out.into_iter().map(|(name, count)| (name.to_owned(), count)).collect(),
            counts: report.counts.iter().map(|(kind, count)| ((*kind).to_owned(), *count)).collect(),
            findings: serde_json::to_string(&report.findings)?,
            finding_count: report.findings.len(),
            text: cli::check_report(report),
        })
    }
}

impl Remake for Report {
    type State = ReportRecord;

    fn remake(py: Python, record: ReportRecord) -> PyResult<Py<PyAny>> {
        Ok(Py::new(py, Report(record))?.into_any())
    }
}

#[pymethods]
impl Report {
    /// Whether anything differs from the record.
    #[getter]
    fn has_differences(&self) -> bool {
        self.0.has_differences
    }

    /// The number of families that were compared.
    #[getter]
    fn families(&self) -> usize {
        self.0.families
    }

    /// The number of curves that were compared.
    #[getter]
    fn curves(&self) -> usize {
        self.0.curves
    }

    /// The number of pages that were compared.
    #[getter]
    fn pages(&self) -> usize {
        self.0.pages
    }

    /// The numbers of images, volumes of the book and files of the gallery that were not compared, because the folder has none of them.
    #[getter]
    fn left_out(&self) -> BTreeMap<String, usize> {
        self.0.left_out.clone()
    }

    /// The number of findings of each kind.
    #[getter]
    fn counts(&self) -> BTreeMap<String, usize> {
        self.0.counts.clone()
    }

    /// The findings, the worst first, each a dictionary: which curve, where, and by how much it has changed. docs/check.md describes the keys.
    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_json(py, &self.0.findings)
    }

    fn __bool__(&self) -> bool {
        !self.0.has_differences
    }

    fn __len__(&self) -> usize {
        self.0.finding_count
    }

    fn __str__(&self) -> &str {
        &self.0.text
    }

    fn __repr__(&self) -> String {
        let ReportRecord { families, curves, pages, counts, .. } = &self.0;
        let found: usize = counts.values().sum();
        format!("<coupler_atlas.Report: families: {families}, curves: {curves}, pages: {pages}, findings: {found}>")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Report>(py, &self.0)
    }
}

/// Check an atlas: run its manifest again in memory, and compare the result with what is recorded in a folder.
///
/// Parameters
/// ----------
/// manifest : path or Atlas
///     The manifest.
/// against : path
///     The folder of the recorded atlas.
/// only : list of str, optional
///     The ids of the families to check.
/// atol, rtol : float, optional
///     The tolerances of coordinates, in the unit of the lengths and relative to the curve's extent; by default those of the manifest.
/// measure_rtol : float, optional
///     The relative tolerance of measures.
/// measures : dict, optional
///     The relative tolerances of single measures or columns, by their names.
/// ignore : list of str, optional
///     Measures and columns that are not compared.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// Report
///     True if nothing differs.
///
/// Raises
/// ------
/// OutputError
///     The record cannot be read, or a run is writing to the folder.
#[pyfunction]
#[pyo3(name = "check", signature = (manifest, against, *, only=None, atol=None, rtol=None, measure_rtol=None, measures=None, ignore=None, progress=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn check_atlas(
    py: Python,
    manifest: ManifestArgument,
    against: PathBuf,
    only: Option<Vec<String>>,
    atol: Option<f64>,
    rtol: Option<f64>,
    measure_rtol: Option<f64>,
    measures: Option<BTreeMap<String, f64>>,
    ignore: Option<Vec<String>>,
    progress: Option<Bound<PyAny>>,
) -> PyResult<Report> {
    let mut by_name = measures.unwrap_or_default();
    let single = by_name.iter().map(|(name, value)| (name.as_str(), Some(*value)));
    for (name, value) in [("atol", atol), ("rtol", rtol), ("measure_rtol", measure_rtol)].into_iter().chain(single) {
        if let Some(value) = value.filter(|value| value.is_nan() || *value < 0.0) {
            return Err(PyValueError::new_err(format!("{name}={value}: a tolerance is 0 or more")));
        }
    }
    by_name.extend(ignore.into_iter().flatten().map(|name| (name, f64::INFINITY)));
    let known = tolerated_names();
    if let Some(name) = by_name.keys().find(|name| !known.contains(&name.as_str())) {
        let help = suggestion(name, &known);
        return Err(PyValueError::new_err(format!("there is no measure or column `{name}`: {help}")));
    }
    let manifest = manifest.read(py)?;
    let only = argument::only(only)?;
    manifest.require_families(&only)?;
    let Manifest { plan, .. } = manifest;
    let result = task::run(py, progress.as_ref(), move |task: &Task| {
        let tolerances = PartialTolerances { atol, rtol, measure_rtol, by_name };
        let options = check::Options { only, tolerances, interrupt: task.interrupt.clone() };
        check::check_atlas(&plan, &against, &options, &mut |event| match event {
            check::Event::Begin { family, pages } => task.begin(family, pages),
            check::Event::Page => task.advance(1),
            check::Event::End => {}
        })
    })?;
    let report = result.map_err(|error| OutputError::new_err(error.to_string()))?;
    ReportRecord::new(&report).map(Report).map_err(|error| Error::new_err(error.to_string()))
}
