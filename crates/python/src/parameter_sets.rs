//! Parameter sets in memory: columns of numbers as the cases of a family, which needs no text for them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use coupler_atlas::manifest;
use coupler_atlas::manifest_files::KnownTable;
use coupler_curves::linkage_format::{quoted, toml_key, toml_number};
use numpy::{PyArrayDescrMethods, PyArrayLike1, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::argument::{is_number, natural};
use crate::arrays;
use crate::arrow::Batch;
use crate::error::ManifestError;
use crate::linkage::{Linkage, Recipe, named_template};
use crate::manifest::Source;

/// What the table of the parameter sets is called in messages.
const TABLE: &str = "parameters";

/// Names with their values or expressions, as TOML.
type Settings = Vec<(String, String)>;

/// What a sweep is asked for in place of a family of a manifest.
pub struct ParameterSets<'py> {
    /// The id of a linkage, or one whose other parameters are kept.
    pub linkage: Bound<'py, PyAny>,
    pub parameters: Option<Bound<'py, PyAny>>,
    pub condition: Option<String>,
    pub samples: Option<i64>,
    pub circuits: Option<String>,
}

impl ParameterSets<'_> {
    /// A manifest of one family with these cases; its linkage may be of the manifest at a path.
    ///
    /// # Errors
    /// There is no such linkage, or what is given are no columns of numbers.
    pub fn source(self, py: Python, manifest: Option<&Path>) -> PyResult<Source> {
        let (id, own_text, kept) = named_linkage(py, &self.linkage, manifest)?;
        let Columns { table, mut settings } = Columns::read(self.parameters.as_ref())?;
        let known: Vec<&String> = table.names.iter().chain(settings.iter().map(|(name, _)| name)).collect();
        let kept: Settings = kept.into_iter().filter(|(name, _)| !known.contains(&name)).collect();
        settings.extend(kept);
        let mut text = format!("atlas.title = {0}\n[[family]]\nid = {0}\nlinkage = {0}\n", quoted(&id));
        let mut add = |key: &str, value: &str| text += &format!("{key} = {value}\n");
        match table.names.is_empty() {
            true => add("cases", "[{}]"),
            false => {
                add("cases", &quoted(TABLE));
                add("limit", &(table.values.len() / table.names.len()).max(1).to_string());
            }
        }
        if !settings.is_empty() {
            let entries: Vec<String> = settings.iter().map(|(name, v)| format!("{} = {v}", toml_key(name))).collect();
            add("let", &format!("{{ {} }}", entries.join(", ")));
        }
        if let Some(condition) = &self.condition {
            add("where", &quoted(condition));
        }
        if let Some(samples) = self.samples {
            add("sampling", &format!("{{ samples = {} }}", natural("samples", samples)?));
        }
        if let Some(circuits) = &self.circuits {
            add("circuits", &quoted(circuits));
        }
        text += &own_text.unwrap_or_default();
        let tables = if table.names.is_empty() { Vec::new() } else { vec![table] };
        Ok(Source { path: PathBuf::from("sweep.toml"), text: text.into(), tables })
    }
}

/// The id of a linkage, its text if it is none of the catalogue, and the values that it keeps, as TOML.
fn named_linkage(
    py: Python,
    linkage: &Bound<PyAny>,
    manifest: Option<&Path>,
) -> PyResult<(String, Option<String>, Settings)> {
    let (id, text, values) = match linkage.cast::<Linkage>() {
        Ok(linkage) => match linkage.get().recipe() {
            Recipe::Linkage { name, manifest, motion, values } if motion.range_deg.is_none() => {
                (name.clone(), manifest.clone(), values.clone())
            }
            _ => {
                let message = "linkage: give the id of a linkage, or one that was made by it: the parameters of a cell, and of one over a range \
                               of its input, are columns like others";
                return Err(PyValueError::new_err(message));
            }
        },
        Err(_) => {
            let Ok(id) = linkage.extract::<String>() else {
                let kind = linkage.get_type().name()?;
                return Err(PyTypeError::new_err(format!(
                    "linkage: give the id of a linkage or a Linkage, not a {kind}"
                )));
            };
            let (template, text) = named_template(py, &id, manifest)?;
            (template.id.clone(), text, Vec::new())
        }
    };
    let own_text = text.and_then(|text| manifest::linkage_text(&text, &id));
    Ok((id, own_text, values.into_iter().map(|(name, value)| (name, toml_number(value))).collect()))
}

/// What is given as parameters.
struct Columns {
    /// Columns of numbers, row by row.
    table: KnownTable,
    /// What is the same in all rows, as TOML: numbers and expressions.
    settings: Settings,
}

impl Columns {
    fn read(parameters: Option<&Bound<PyAny>>) -> PyResult<Columns> {
        let (mut columns, mut settings) = (Vec::new(), Vec::new());
        for (name, value) in parameters.map_or(Ok(Vec::new()), named_columns)? {
            if let Ok(expression) = value.extract::<String>() {
                settings.push((name, quoted(&expression)));
            } else if is_number(&value) {
                settings.push((name, toml_number(value.extract()?)));
            } else {
                let numbers = numbers(&name, &value)?;
                columns.push((name, numbers));
            }
        }
        let width = columns.len();
        let rows = columns.first().map_or(0, |(_, numbers)| numbers.len());
        if let Some((name, numbers)) = columns.iter().find(|(_, numbers)| numbers.len() != rows) {
            return Err(PyValueError::new_err(format!(
                "parameters: column `{}` has {rows} values, and `{name}` {}: give each as many",
                columns[0].0,
                numbers.len()
            )));
        }
        if width > 0 && rows == 0 {
            return Err(PyValueError::new_err("parameters: the columns are empty: give at least one parameter set"));
        }
        let mut values = vec![0.0; width * rows];
        for (k, (name, numbers)) in columns.iter().enumerate() {
            for (row, value) in numbers.as_array().iter().enumerate() {
                if !value.is_finite() {
                    return Err(wrong_value(name, row, &value.to_string()));
                }
                values[row * width + k] = *value;
            }
        }
        let names = columns.into_iter().map(|(name, _)| name).collect();
        Ok(Columns { table: KnownTable { path: TABLE.to_owned(), names, values: Arc::new(values) }, settings })
    }
}

fn wrong_value(name: &str, row: usize, found: &str) -> PyErr {
    let row = row + 1;
    PyValueError::new_err(format!(
        "parameters: column `{name}`, row {row}, counted from 1: expected a finite number, found {found}"
    ))
}

/// The columns of a dictionary or a table by their names.
fn named_columns<'py>(parameters: &Bound<'py, PyAny>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    // A query of DuckDB has no columns before it is asked for them.
    let fetched = parameters.getattr("fetchnumpy").and_then(|fetch| fetch.call0());
    let parameters = match (parameters.cast::<Batch>(), fetched) {
        (Ok(batch), _) => batch.call_method0("to_dict")?,
        (_, Ok(fetched)) => fetched,
        _ => parameters.clone(),
    };
    if let Ok(columns) = parameters.cast::<PyDict>() {
        return columns.iter().map(|(name, value)| Ok((column_name(&name)?, value))).collect();
    }
    // Of PyArrow; of pandas, Polars and the like; of a structured array.
    let names = ["column_names", "columns"].into_iter().find_map(|name| parameters.getattr(name).ok());
    let names =
        names.or_else(|| parameters.getattr("dtype").ok()?.getattr("names").ok().filter(|names| !names.is_none()));
    let Some(names) = names else {
        return Err(PyTypeError::new_err(format!(
            "parameters: give a dict of arrays by their names, or a table of pandas, Polars or PyArrow, and not {}",
            arrays::described(&parameters)?
        )));
    };
    names.try_iter()?.map(|name| name.and_then(|name| Ok((column_name(&name)?, parameters.get_item(&name)?)))).collect()
}

fn column_name(name: &Bound<PyAny>) -> PyResult<String> {
    let message = || PyTypeError::new_err(format!("parameters: a column is named by a parameter, and not {name}"));
    name.extract().map_err(|_| message())
}

/// A column as numbers, which are those of the array itself where it has numbers of 64 bits.
fn numbers<'py>(name: &str, column: &Bound<'py, PyAny>) -> PyResult<PyArrayLike1<'py, f64, numpy::AllowTypeChange>> {
    let numpy = column.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (column,))?;
    let untyped = array.cast::<PyUntypedArray>()?;
    let wrong = |expected: &str| {
        let found = arrays::described(&array)?;
        Err(PyTypeError::new_err(format!("parameters: column `{name}`: expected {expected}, found {found}")))
    };
    if untyped.ndim() != 1 {
        return wrong("an array of one dimension");
    }
    match untyped.dtype().kind() {
        b'f' | b'i' | b'u' => array.extract(),
        // Texts among numbers, and what is missing.
        b'O' | b'U' => {
            let number = |(row, item): (usize, PyResult<Bound<PyAny>>)| {
                let item = item?;
                item.extract::<f64>()
                    .map_err(|_| wrong_value(name, row, &item.repr().map_or(String::new(), |r| r.to_string())))
            };
            let values: Vec<f64> = numpy
                .call_method1("array", (column, "O"))?
                .try_iter()?
                .enumerate()
                .map(number)
                .collect::<PyResult<_>>()?;
            arrays::column(column.py(), values).into_any().extract()
        }
        _ => wrong("numbers"),
    }
}

/// The error of a manifest that the caller has not written, without its text: an argument is wrong.
pub fn without_places(py: Python, error: PyErr) -> PyErr {
    let messages = || -> PyResult<Vec<String>> {
        let problems = error.value(py).getattr("problems")?;
        let is_error = |problem: &Bound<PyAny>| problem.get_item("is_error").and_then(|value| value.is_truthy());
        let message = |problem: Bound<PyAny>| -> PyResult<Option<String>> {
            let text = |key| problem.get_item(key)?.extract::<Option<String>>();
            let help = text("help")?.map_or(String::new(), |help| format!(" ({help})"));
            Ok(is_error(&problem)?.then_some(text("message")?.unwrap_or_default() + &help))
        };
        let found: Vec<Option<String>> =
            problems.try_iter()?.map(|problem| message(problem?)).collect::<PyResult<_>>()?;
        Ok(found.into_iter().flatten().collect())
    };
    match error.is_instance_of::<ManifestError>(py).then(messages) {
        Some(Ok(messages)) => PyValueError::new_err(messages.join("; ")),
        _ => error,
    }
}
