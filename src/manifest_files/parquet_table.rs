//! Reads a table of cases as Parquet.

use std::fs::File;
use std::io;

use parquet::basic::{ConvertedType, Type};
use parquet::column::reader::ColumnReader;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, RowGroupReader};
use parquet::file::serialized_reader::SerializedFileReader;
use parquet::schema::types::ColumnDescriptor;

use super::case_rows::{CaseRows, MAX_TABLE_BYTES};
use crate::shard::into_io;

/// Reads a table; what is wrong in it is reported.
///
/// # Errors
/// The system fails to read it, it is no Parquet file, or it is too large.
pub(super) fn read(file: File, rows: &mut CaseRows) -> io::Result<()> {
    let reader = SerializedFileReader::new(file).map_err(into_io)?;
    let metadata = reader.metadata().file_metadata();
    let columns = metadata.schema_descr().columns();
    if columns.is_empty() {
        rows.problem("", "it has no columns", "give it a column for each parameter");
        return Ok(());
    }
    rows.set_names(columns.iter().map(|column| column.path().string()).collect());
    let mut has_numbers = true;
    for (k, column) in columns.iter().enumerate().filter(|(_, column)| !is_number(column)) {
        let message = match column.max_rep_level() {
            0 => format!("expected numbers, found values of the type {}", column.physical_type()),
            _ => "expected numbers, found lists".to_owned(),
        };
        let place = rows.column(k);
        rows.problem(&place, &message, "store the column as DOUBLE");
        has_numbers = false;
    }
    let counts = (0..reader.num_row_groups()).map(|group| row_count(reader.metadata().row_group(group).num_rows()));
    let count = counts.fold(0, usize::saturating_add);
    if !has_numbers || !rows.can_keep(count)? {
        rows.skip(count);
        return Ok(());
    }
    for group in 0..reader.num_row_groups() {
        read_group(&*reader.get_row_group(group).map_err(into_io)?, rows)?;
    }
    Ok(())
}

fn row_count(count: i64) -> usize {
    usize::try_from(count).unwrap_or(0)
}

/// Whether the values of a column are numbers, and not dates or times, for example, that are stored as numbers.
fn is_number(column: &ColumnDescriptor) -> bool {
    use ConvertedType::{INT_8, INT_16, INT_32, INT_64, NONE};
    let is_stored_as_number = matches!(column.physical_type(), Type::DOUBLE | Type::FLOAT | Type::INT32 | Type::INT64);
    let is_meant_as_number = match column.converted_type() {
        INT_8 | INT_16 | INT_32 | INT_64 => true,
        NONE => column.logical_type_ref().is_none(),
        _ => false,
    };
    is_stored_as_number && is_meant_as_number && column.max_rep_level() == 0
}

/// Reads the rows of a group.
fn read_group(group: &dyn RowGroupReader, rows: &mut CaseRows) -> io::Result<()> {
    let count = row_count(group.metadata().num_rows());
    let columns = (0..rows.width()).map(|column| read_column(group, column, count).map_err(into_io));
    let columns = columns.collect::<io::Result<Vec<Vec<f64>>>>()?;
    let mut values = vec![f64::NAN; columns.len()];
    for k in 0..count {
        values.iter_mut().zip(&columns).for_each(|(value, column)| *value = column[k]);
        let number = rows.next_number();
        for (column, value) in values.iter().enumerate().filter(|(_, value)| !value.is_finite()) {
            let found = if value.is_nan() { String::new() } else { value.to_string() };
            rows.report_value((number, column), &found);
        }
        rows.push(&values, number)?;
    }
    Ok(())
}

/// The numbers of a column of a group; NaN where there is none.
fn read_column(group: &dyn RowGroupReader, column: usize, count: usize) -> Result<Vec<f64>, ParquetError> {
    let metadata = group.metadata().column(column);
    let (name, bytes) = (metadata.column_descr().name(), metadata.uncompressed_size());
    if !u64::try_from(bytes).is_ok_and(|bytes| bytes <= MAX_TABLE_BYTES) {
        let message = format!("its column `{name}` takes {bytes} bytes, more than the limit of {MAX_TABLE_BYTES}");
        return Err(ParquetError::General(message));
    }
    let mut levels = Vec::new();
    macro_rules! numbers {
        ($reader:expr, $convert:expr) => {{
            let mut values = Vec::new();
            let (read, ..) = $reader.read_records(count, Some(&mut levels), None, &mut values)?;
            (read, values.into_iter().map($convert).collect())
        }};
    }
    let (read, numbers): (usize, Vec<f64>) = match &mut group.get_column_reader(column)? {
        ColumnReader::DoubleColumnReader(reader) => numbers!(reader, |value: f64| value),
        ColumnReader::FloatColumnReader(reader) => numbers!(reader, f64::from),
        ColumnReader::Int32ColumnReader(reader) => numbers!(reader, f64::from),
        ColumnReader::Int64ColumnReader(reader) => numbers!(reader, |value: i64| value as f64),
        _ => return Err(ParquetError::General(format!("its column `{name}` has another type than it states"))),
    };
    let present = metadata.column_descr().max_def_level();
    let mut rest = numbers.into_iter();
    let mut next = |is_present: bool| if is_present { rest.next().unwrap_or(f64::NAN) } else { f64::NAN };
    let all: Vec<f64> = match present {
        0 => (0..read).map(|_| next(true)).collect(),
        _ => levels.iter().map(|level| next(*level == present)).collect(),
    };
    match all.len() == count {
        true => Ok(all),
        false => {
            Err(ParquetError::General(format!("its column `{name}` lacks {} rows", count.saturating_sub(all.len()))))
        }
    }
}
