//! Batches of rows as Arrow sees them, by its PyCapsule interface: pandas, Polars, PyArrow and DuckDB read them without copying.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::ffi::{FFI_ArrowArray, FFI_ArrowSchema};
use arrow_array::types::{Float64Type, Int32Type, Int64Type};
use arrow_array::{Array, ArrayRef, PrimitiveArray, RecordBatch, StringArray, StructArray};
use arrow_buffer::{BooleanBuffer, NullBuffer, ScalarBuffer};
use arrow_schema::{ArrowError, DataType, Field, Schema, SchemaRef};
use coupler_atlas::shard::{ColumnKind, ColumnRows, Rows, TableColumn, Values};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::{PyKeyError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyTuple};

use crate::arrays;
use crate::error::Error;
use crate::reduce::{Reduced, Remake, reduced};

/// The exception for an error of Arrow.
pub fn arrow_error(error: ArrowError) -> PyErr {
    Error::new_err(error.to_string())
}

/// The schema of a table: the types are those of its Parquet file, and a field's metadata has the unit of its values, if they have one.
pub fn schema(columns: &[TableColumn]) -> SchemaRef {
    let field = |column: &TableColumn| {
        let kind = match column.kind {
            ColumnKind::Cell => DataType::Int64,
            ColumnKind::Integer => DataType::Int32,
            ColumnKind::Number => DataType::Float64,
            ColumnKind::Word => DataType::Utf8,
        };
        let unit = (!column.unit.is_empty()).then(|| ("unit".to_owned(), column.unit.to_owned()));
        Field::new(&column.name, kind, column.is_optional).with_metadata(HashMap::from_iter(unit))
    };
    Arc::new(Schema::new(columns.iter().map(field).collect::<Vec<_>>()))
}

/// The values of all rows from those that are not missing, and which are.
fn spread<T: Copy + Default>(values: Vec<T>, levels: &[i16]) -> (Vec<T>, Option<NullBuffer>) {
    if levels.is_empty() || values.len() == levels.len() {
        return (values, None);
    }
    let mut present = values.into_iter();
    let all = levels.iter().map(|level| if *level == 1 { present.next().unwrap_or_default() } else { T::default() });
    let all = all.collect();
    (all, Some(NullBuffer::new(BooleanBuffer::from_iter(levels.iter().map(|level| *level == 1)))))
}

fn array(rows: ColumnRows, kind: ColumnKind) -> ArrayRef {
    match (rows.values, kind) {
        (Values::Integers(values), ColumnKind::Cell) => {
            let (values, nulls) = spread(values, &rows.levels);
            Arc::new(PrimitiveArray::<Int64Type>::new(ScalarBuffer::from(values), nulls))
        }
        (Values::Integers(values), _) => {
            // All but the numbers of cells are small.
            let values: Vec<i32> = values.into_iter().map(|value| value as i32).collect();
            let (values, nulls) = spread(values, &rows.levels);
            Arc::new(PrimitiveArray::<Int32Type>::new(ScalarBuffer::from(values), nulls))
        }
        (Values::Numbers(values), _) => {
            let (values, nulls) = spread(values, &rows.levels);
            Arc::new(PrimitiveArray::<Float64Type>::new(ScalarBuffer::from(values), nulls))
        }
        (Values::Words(words), _) if rows.levels.is_empty() => Arc::new(StringArray::from_iter_values(words)),
        (Values::Words(words), _) => {
            let mut present = words.into_iter();
            Arc::new(StringArray::from_iter(
                rows.levels.iter().map(|level| if *level == 1 { present.next() } else { None }),
            ))
        }
    }
}

/// Rows of a table as a batch.
pub fn batch(schema: &SchemaRef, columns: &[TableColumn], rows: Rows) -> Result<RecordBatch, ArrowError> {
    let arrays = rows.columns.into_iter().zip(columns).map(|(rows, column)| array(rows, column.kind)).collect();
    RecordBatch::try_new(schema.clone(), arrays)
}

/// A schema as a capsule.
pub fn schema_capsule<'py>(py: Python<'py>, schema: &Schema) -> PyResult<Bound<'py, PyCapsule>> {
    let schema = FFI_ArrowSchema::try_from(schema).map_err(arrow_error)?;
    PyCapsule::new_with_value(py, schema, c"arrow_schema")
}

/// Some rows of a table.
///
/// A batch is read by whatever takes Arrow data: ``pyarrow.record_batch(batch)``, ``polars.DataFrame(batch)``. A column is also a NumPy array,
/// ``batch["x"]``.
#[pyclass(frozen, module = "coupler_atlas")]
pub struct Batch {
    pub inner: RecordBatch,
}

#[pymethods]
impl Batch {
    /// The names of the columns, in order.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.inner.schema().fields().iter().map(|field| field.name().clone()).collect()
    }

    /// The number of rows.
    fn __len__(&self) -> usize {
        self.inner.num_rows()
    }

    fn __repr__(&self) -> String {
        format!("<coupler_atlas.Batch of {} rows and {} columns>", self.inner.num_rows(), self.inner.num_columns())
    }

    /// The values of a column: an array of float64, of which missing ones are NaN, of int64 or of int32, or a list of words, of which
    /// missing ones are None. Integers of a column in which some may be missing are floats.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let Some(column) = self.inner.column_by_name(name) else {
            return Err(PyKeyError::new_err(format!(
                "there is no column `{name}`: there are {}",
                self.columns().join(", ")
            )));
        };
        let is_optional = self.inner.schema().field_with_name(name).is_ok_and(|field| field.is_nullable());
        let column = column.as_any();
        fn numbers<'py, T: Copy>(
            py: Python<'py>,
            values: &[T],
            nulls: Option<&NullBuffer>,
            to: fn(T) -> f64,
        ) -> Bound<'py, PyAny> {
            let is_null = |k: usize| nulls.is_some_and(|nulls| nulls.is_null(k));
            let number = |(k, value): (usize, &T)| if is_null(k) { f64::NAN } else { to(*value) };
            arrays::column(py, values.iter().enumerate().map(number).collect()).into_any()
        }
        if let Some(column) = column.downcast_ref::<PrimitiveArray<Float64Type>>() {
            return Ok(numbers(py, column.values(), column.nulls(), |value| value));
        }
        // The type depends on the column, and not on whether there is a gap among these rows.
        if let Some(column) = column.downcast_ref::<PrimitiveArray<Int64Type>>() {
            return Ok(match is_optional {
                false => arrays::column(py, column.values().to_vec()).into_any(),
                true => numbers(py, column.values(), column.nulls(), |value| value as f64),
            });
        }
        if let Some(column) = column.downcast_ref::<PrimitiveArray<Int32Type>>() {
            return Ok(match is_optional {
                false => arrays::column(py, column.values().to_vec()).into_any(),
                true => numbers(py, column.values(), column.nulls(), f64::from),
            });
        }
        match column.downcast_ref::<StringArray>() {
            Some(column) => Ok(column.iter().collect::<Vec<_>>().into_pyobject(py)?.into_any()),
            None => Err(PyTypeError::new_err(format!("the column `{name}` has a type without an array"))),
        }
    }

    /// The columns by name, as ``batch[name]`` gives them.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for name in self.columns() {
            columns.set_item(&name, self.__getitem__(py, &name)?)?;
        }
        Ok(columns)
    }

    /// The schema, for readers of Arrow data.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        schema_capsule(py, &self.inner.schema())
    }

    /// The rows, for readers of Arrow data. Another schema than the own one is not made.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_array__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        // The protocol leaves it to the producer whether a request is met.
        drop(requested_schema);
        let data = StructArray::from(self.inner.clone()).into_data();
        let array = PyCapsule::new_with_value(py, FFI_ArrowArray::new(&data), c"arrow_array")?;
        (schema_capsule(py, &self.inner.schema())?, array).into_pyobject(py)
    }
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let columns = self.inner.schema();
        let columns = columns.fields().iter().zip(self.inner.columns());
        let pickled =
            columns.map(|(field, column)| PickledColumn::new(py, field, column)).collect::<PyResult<Vec<_>>>();
        reduced::<Batch>(py, pickled?)
    }
}

/// A column of a batch in a pickle.
#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub struct PickledColumn {
    name: String,
    unit: Option<String>,
    is_optional: bool,
    /// An array, with any value where one is missing, or a list of words.
    values: Py<PyAny>,
    /// For each row of an array 1, or 0 where its value is missing; none if none is.
    present: Option<Vec<u8>>,
}

impl PickledColumn {
    fn new(py: Python, field: &Field, column: &ArrayRef) -> PyResult<PickledColumn> {
        let any = column.as_any();
        let values = if let Some(column) = any.downcast_ref::<PrimitiveArray<Float64Type>>() {
            arrays::column(py, column.values().to_vec()).into_any()
        } else if let Some(column) = any.downcast_ref::<PrimitiveArray<Int64Type>>() {
            arrays::column(py, column.values().to_vec()).into_any()
        } else if let Some(column) = any.downcast_ref::<PrimitiveArray<Int32Type>>() {
            arrays::column(py, column.values().to_vec()).into_any()
        } else if let Some(column) = any.downcast_ref::<StringArray>() {
            column.iter().collect::<Vec<_>>().into_pyobject(py)?.into_any()
        } else {
            return Err(PyTypeError::new_err(format!("the column `{}` has a type without an array", field.name())));
        };
        Ok(PickledColumn {
            name: field.name().clone(),
            unit: field.metadata().get("unit").cloned(),
            is_optional: field.is_nullable(),
            values: values.unbind(),
            present: column.nulls().map(|nulls| nulls.iter().map(u8::from).collect()),
        })
    }

    fn column(self, py: Python) -> PyResult<(Field, ArrayRef)> {
        let values = self.values.bind(py);
        let nulls = self.present.map(|present| NullBuffer::new(present.iter().map(|one| *one != 0).collect()));
        let column: ArrayRef = if let Ok(numbers) = values.extract::<PyReadonlyArray1<f64>>() {
            Arc::new(PrimitiveArray::<Float64Type>::new(ScalarBuffer::from(numbers.as_slice()?.to_vec()), nulls))
        } else if let Ok(numbers) = values.extract::<PyReadonlyArray1<i64>>() {
            Arc::new(PrimitiveArray::<Int64Type>::new(ScalarBuffer::from(numbers.as_slice()?.to_vec()), nulls))
        } else if let Ok(numbers) = values.extract::<PyReadonlyArray1<i32>>() {
            Arc::new(PrimitiveArray::<Int32Type>::new(ScalarBuffer::from(numbers.as_slice()?.to_vec()), nulls))
        } else {
            Arc::new(StringArray::from(values.extract::<Vec<Option<String>>>()?))
        };
        let unit = self.unit.map(|unit| ("unit".to_owned(), unit));
        let field = Field::new(self.name, column.data_type().clone(), self.is_optional);
        Ok((field.with_metadata(HashMap::from_iter(unit)), column))
    }
}

impl Remake for Batch {
    type State = Vec<PickledColumn>;

    fn remake(py: Python, columns: Vec<PickledColumn>) -> PyResult<Py<PyAny>> {
        let columns: Vec<(Field, ArrayRef)> =
            columns.into_iter().map(|column| column.column(py)).collect::<PyResult<_>>()?;
        let (fields, columns): (Vec<Field>, Vec<ArrayRef>) = columns.into_iter().unzip();
        let inner = RecordBatch::try_new(Arc::new(Schema::new(fields)), columns).map_err(arrow_error)?;
        Ok(Py::new(py, Batch { inner })?.into_any())
    }
}
