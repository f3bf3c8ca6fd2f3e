//! Sweeps: the cells of a family as a stream of batches that are solved as they are asked for.

use std::sync::{Mutex, PoisonError};

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{RecordBatch, RecordBatchReader};
use arrow_schema::{ArrowError, SchemaRef};
use coupler_atlas::output;
use coupler_atlas::shard::{Division, MAX_SHARDS, Rows, TableColumn, TableKind, TableStream};
use coupler_atlas::sweep::cells_of_division;
use pyo3::exceptions::{PyKeyboardInterrupt, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::arrow::{self, Batch, arrow_error};
use crate::atlas::ManifestArgument;
use crate::error::OutputError;
use crate::html;
use crate::linkage::known_measure;
use crate::manifest::{Manifest, PickledSource, Source};
use crate::parameter_sets::{ParameterSets, without_places};
use crate::reduce::{Reduced, Remake, reduced};
use crate::task;

/// The cells of a family, or a part of them, as a table that is solved as it is read.
///
/// It is read in batches of some thousands of rows with ``batches()``, and as a whole by whatever takes an Arrow stream: ``polars.DataFrame(sweep)``
/// (1.24 or later), ``pyarrow.table(sweep)``, ``pandas.DataFrame.from_arrow(sweep)`` (3.0 or later), a query of DuckDB. Each reading begins anew. Memory is that of a batch or
/// two, however many cells there are. Ctrl-C ends an iteration with KeyboardInterrupt, and a reading by a library with that library's exception,
/// "interrupted".
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Sweep {
    family: String,
    stream: TableStream,
    schema: SchemaRef,
    progress: Option<Py<PyAny>>,
    recipe: Recipe,
}

/// The arguments of `sweep` from which it can be made again, after its manifest; without `progress`.
type Arguments = (String, Option<[i64; 2]>, Option<[i64; 2]>, bool, Option<Vec<String>>);

/// What a sweep was made from.
struct Recipe {
    source: Source,
    arguments: Arguments,
}

/// Makes the batches of a sweep, one after the other.
struct Batches {
    stream: TableStream,
    family: String,
    schema: SchemaRef,
    reporter: Option<Py<PyAny>>,
    cells: usize,
}

impl Batches {
    /// The next batch, solved on other threads.
    fn next(&mut self, py: Python) -> PyResult<Option<RecordBatch>> {
        task::require_threads()?;
        let mut stream = self.stream.clone();
        let (family, cells) = (self.family.clone(), self.cells);
        let reporter = self.reporter.as_ref().map(|reporter| reporter.bind(py).clone());
        let (stream, rows) = task::run_with(py, reporter.as_ref().map(|reporter| reporter.as_any()), move |task| {
            task.begin(&family, cells);
            task.advance(cells - stream.rest().len());
            let rows = stream.next_rows(&task.interrupt, &mut |cells| task.advance(cells));
            (stream, rows)
        })?;
        self.stream = stream;
        let rows: Option<Rows> = rows.map_err(|error: output::Error| OutputError::new_err(error.to_string()))?;
        match rows {
            Some(rows) => Ok(Some(arrow::batch(&self.schema, self.stream.columns(), rows).map_err(arrow_error)?)),
            None => {
                if let Some(reporter) = self.reporter.take() {
                    reporter.bind(py).call_method0("end")?;
                }
                Ok(None)
            }
        }
    }
}

/// Batches for a reader of Arrow data, which may call from any thread.
struct Reader(Batches);

impl Iterator for Reader {
    type Item = Result<RecordBatch, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        Python::attach(|py| {
            self.0.next(py).map_err(|error| {
                // The reader raises an exception of its own with this message.
                let is_interrupt = error.is_instance_of::<PyKeyboardInterrupt>(py);
                ArrowError::ExternalError(if is_interrupt { "interrupted".into() } else { error.to_string().into() })
            })
        })
        .transpose()
    }
}

impl RecordBatchReader for Reader {
    fn schema(&self) -> SchemaRef {
        self.0.schema.clone()
    }
}

/// Iterates over the batches of a sweep.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct SweepIterator(Mutex<Batches>);

#[pymethods]
impl SweepIterator {
    fn __iter__(this: PyRef<Self>) -> PyRef<Self> {
        this
    }

    fn __next__(&self, py: Python) -> PyResult<Option<Batch>> {
        let mut batches = match self.0.try_lock() {
            Ok(batches) => batches,
            Err(std::sync::TryLockError::Poisoned(poisoned)) => PoisonError::into_inner(poisoned),
            Err(std::sync::TryLockError::WouldBlock) => {
                return Err(PyValueError::new_err(
                    "another thread is reading these batches: begin again with sweep.batches()",
                ));
            }
        };
        Ok(batches.next(py)?.map(|inner| Batch { inner }))
    }
}

impl Sweep {
    fn batches(&self, py: Python) -> PyResult<Batches> {
        let argument = self.progress.as_ref().map(|progress| progress.bind(py).clone());
        let reporter = py.import("coupler_atlas._progress")?.getattr("lasting_reporter")?.call1((argument,))?;
        Ok(Batches {
            stream: self.stream.clone(),
            family: self.family.clone(),
            schema: self.schema.clone(),
            reporter: if reporter.is_none() { None } else { Some(reporter.unbind()) },
            cells: self.stream.rest().len(),
        })
    }
}

#[pymethods]
impl Sweep {
    /// The id of the family.
    #[getter]
    fn family(&self) -> &str {
        &self.family
    }

    /// The number of cells; rows are more, for each curve of a cell has its own.
    #[getter]
    fn cell_count(&self) -> usize {
        self.stream.rest().len()
    }

    /// The names of the columns, in order.
    #[getter]
    fn columns(&self) -> Vec<&str> {
        self.stream.columns().iter().map(|column| column.name.as_str()).collect()
    }

    /// The units of the columns that have one, by name: ``deg``, ``rad``.
    #[getter]
    fn units(&self) -> std::collections::BTreeMap<&str, &str> {
        let columns = self.stream.columns().iter().filter(|column| !column.unit.is_empty());
        columns.map(|column| (column.name.as_str(), column.unit)).collect()
    }

    fn __repr__(&self) -> String {
        let (cells, columns) = (self.cell_count(), self.stream.columns().len());
        format!("<coupler_atlas.Sweep of {}: {cells} cells, {columns} columns>", self.family)
    }

    /// An iterator over the table in batches of some thousands of rows, from its beginning.
    #[pyo3(name = "batches")]
    fn python_batches(&self, py: Python) -> PyResult<SweepIterator> {
        Ok(SweepIterator(Mutex::new(self.batches(py)?)))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let Recipe { source, arguments } = &self.recipe;
        reduced::<Sweep>(py, (source.pickled(), arguments.clone()))
    }

    /// The columns, with their types and units.
    fn _repr_html_(&self) -> String {
        let fields = self.schema.fields().iter().zip(self.stream.columns());
        let row = |(field, column): (&std::sync::Arc<arrow_schema::Field>, &TableColumn)| {
            let kind = format!("{:?}", field.data_type()).to_lowercase();
            html::row("td", &[field.name(), &kind, column.unit, if column.is_optional { "may be missing" } else { "" }])
        };
        let rows: String = fields.map(row).collect();
        let head = html::row("th", &["column", "type", "unit", ""]);
        format!("<table><caption>{}</caption>{head}{rows}</table>", html::escaped(&self.__repr__()))
    }

    /// The schema, for readers of Arrow data.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        arrow::schema_capsule(py, &self.schema)
    }

    /// The table from its beginning, for readers of Arrow data. Another schema than the own one is not made.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The protocol leaves it to the producer whether a request is met.
        drop(requested_schema);
        let stream = FFI_ArrowArrayStream::new(Box::new(Reader(self.batches(py)?)));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}

/// Sweep a family of a manifest, or parameter sets in memory: a table with a row for each curve, solved as it is read.
///
/// The columns, their types and the rows are those of the tables that ``coupler-atlas sweep`` writes as Parquet. docs/output.md describes them.
///
/// Parameters
/// ----------
/// manifest : path or Atlas, optional
///     The manifest. With `linkage` it is the path of one whose linkages can be named, too.
/// linkage : str or Linkage, optional
///     The id of a linkage for parameter sets of one's own; or a linkage that was made by its parameters, which are kept where `parameters` has no others.
/// parameters : dict or table, optional
///     The parameter sets, with `linkage`: a dictionary of arrays, or a table of pandas, Polars, PyArrow or DuckDB, or a structured array. A column is
///     named by a parameter of the linkage, or by another name for `where` and expressions. In a dictionary a number holds for all sets, and so
///     does an expression, ``{"crank": cranks, "coupler": "3 * crank"}``.
/// where : str, optional
///     The condition for rows, with `linkage`.
/// samples : int, optional
///     How many points a curve has, with `linkage`; by default one for every two degrees, as in manifests.
/// circuits : {"start", "all"}, optional
///     Only the circuit through the start pose, or all, with `linkage`; by default what the linkage says.
/// family : str, optional
///     The id of the family; needed if the manifest has several, for each has columns of its own.
/// shard : (int, int), optional
///     Only the i-th of n parts of the cells with about equal work, i from 0 to n - 1, as (3, 64).
/// cells : (int, int), optional
///     Only the cells with these numbers and those between, counted from 1, as (1, 1000).
/// points : bool
///     The table of points, with a row for each sample of each curve, in place of that of curves.
/// measures : list of str, optional
///     The measures of the table in place of the manifest's; those that `where` uses are there in any case.
/// progress : bool or callable, optional
///     None shows a bar in notebooks and terminals, True always, False never; a function is called with (done, total, name).
///
/// Returns
/// -------
/// Sweep
///     Nothing is solved yet.
///
/// Raises
/// ------
/// ManifestError
///     The manifest has errors.
/// ValueError
///     There is no such family, part or measure, or a value of the parameters is wrong.
#[pyfunction]
#[pyo3(signature = (manifest=None, *, linkage=None, parameters=None, r#where=None, samples=None, circuits=None, family=None, shard=None, cells=None,
                    points=false, measures=None, progress=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub fn sweep<'py>(
    py: Python<'py>,
    manifest: Option<ManifestArgument<'py>>,
    linkage: Option<Bound<'py, PyAny>>,
    parameters: Option<Bound<'py, PyAny>>,
    r#where: Option<String>,
    samples: Option<i64>,
    circuits: Option<String>,
    family: Option<String>,
    shard: Option<[i64; 2]>,
    cells: Option<[i64; 2]>,
    points: bool,
    measures: Option<Vec<String>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Sweep> {
    measures.iter().flatten().try_for_each(|name| known_measure("measures", name))?;
    // Whether it can be shown is found out when it is read.
    py.import("coupler_atlas._progress")?.getattr("reporter")?.call1((&progress,))?;
    let of_linkage = [
        ("parameters", parameters.is_some()),
        ("where", r#where.is_some()),
        ("samples", samples.is_some()),
        ("circuits", circuits.is_some()),
    ];
    let sweep = match (manifest, linkage) {
        (manifest, Some(linkage)) => {
            let path = match &manifest {
                None => None,
                Some(ManifestArgument::Path(path)) => Some(path.as_path()),
                Some(ManifestArgument::Atlas(_)) => {
                    let message = "linkage: give the path of the manifest that has it in place of an Atlas";
                    return Err(PyValueError::new_err(message));
                }
            };
            let sets = ParameterSets { linkage, parameters, condition: r#where, samples, circuits };
            make_sweep(py, sets.source(py, path)?, family, (shard, cells), points, measures)
                .map_err(|error| without_places(py, error))?
        }
        (None, None) => {
            let message = "give a manifest, or linkage=… with parameters=…";
            return Err(PyTypeError::new_err(message));
        }
        (Some(manifest), None) => {
            if let Some((name, _)) = of_linkage.into_iter().find(|(_, is_given)| *is_given) {
                return Err(PyValueError::new_err(format!("{name} is for linkage=…: a manifest has its own")));
            }
            make_sweep(py, manifest.source(py)?, family, (shard, cells), points, measures)?
        }
    };
    Ok(Sweep { progress, ..sweep })
}

impl Remake for Sweep {
    type State = (PickledSource, Arguments);

    fn remake(py: Python, (source, arguments): Self::State) -> PyResult<Py<PyAny>> {
        let (family, shard, cells, points, measures) = arguments;
        let source = Source::from_pickle(source);
        Ok(Py::new(py, make_sweep(py, source, Some(family), (shard, cells), points, measures)?)?.into_any())
    }
}

fn make_sweep(
    py: Python,
    source: Source,
    family: Option<String>,
    (shard, cells): (Option<[i64; 2]>, Option<[i64; 2]>),
    points: bool,
    measures: Option<Vec<String>>,
) -> PyResult<Sweep> {
    let division = division(shard, cells)?;
    let wanted = family.clone();
    let manifest = Manifest::for_tables(py, source, move |family| match &wanted {
        Some(wanted) if *wanted != family.id => 0..0,
        _ => cells_of_division(family, division),
    })?;
    let planned = manifest.family(family.as_deref())?;
    let own = &planned.family;
    if let Division::Cells { first, last } = division
        && last > own.cell_count()
    {
        let count = own.cell_count();
        let message = format!(
            "cells=({first}, {last}): `{}` has no cell {last}: its cells are numbered from 1 to {count}",
            own.id
        );
        return Err(PyValueError::new_err(message));
    }
    let table = if points { TableKind::Points } else { TableKind::Cells };
    // Where the work of a shard is, is found by cells that are solved.
    let stream = py.detach(|| TableStream::new(own, table, division, measures.as_deref()));
    let schema = arrow::schema(stream.columns());
    let recipe = Recipe { source: manifest.source(), arguments: (own.id.clone(), shard, cells, points, measures) };
    Ok(Sweep { family: own.id.clone(), stream, schema, progress: None, recipe })
}

fn division(shard: Option<[i64; 2]>, cells: Option<[i64; 2]>) -> PyResult<Division> {
    let wrong = |message: String| Err(PyValueError::new_err(message));
    let given = |[a, b]: [i64; 2]| [usize::try_from(a).ok(), usize::try_from(b).ok()];
    match (shard, cells) {
        (Some(_), Some(_)) => wrong("shard and cells are two ways to choose cells: give one of them".to_owned()),
        (None, None) => Ok(Division::WHOLE),
        (Some(shard), None) => match (given(shard), shard) {
            ([Some(index), Some(of)], _) if index < of && of <= MAX_SHARDS => Ok(Division::Shard { index, of }),
            ([_, Some(of @ 1..=MAX_SHARDS)], [index, _]) => wrong(format!(
                "shard=({index}, {of}): shards are numbered from 0: give (0, {of}) to ({}, {of})",
                of - 1
            )),
            (_, [index, of]) => wrong(format!("shard=({index}, {of}): the number of shards is from 1 to {MAX_SHARDS}")),
        },
        (None, Some(cells)) => match (given(cells), cells) {
            ([Some(first @ 1..), Some(last)], _) if first <= last => Ok(Division::Cells { first, last }),
            (_, [first, last]) => wrong(format!(
                "cells=({first}, {last}): give the numbers of the first and the last cell, counted from 1, as in (1, 1000)"
            )),
        },
    }
}
