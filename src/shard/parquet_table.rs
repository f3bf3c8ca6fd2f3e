//! Writes a table as a Parquet file.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{ColumnPath, Type};

use super::columns::{ColumnKind, ColumnRows, Rows, TableColumn, Values};

/// A Parquet file that is being written. Its bytes depend on the rows alone, and not on how they arrive.
pub(super) struct ParquetTable<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    /// The rows that are not yet a whole row group.
    pending: Rows,
    /// The types of integer columns with 32 bits.
    kinds: Vec<ColumnKind>,
    /// The number of rows of a row group.
    group_rows: usize,
}

impl<W: Write + Send> ParquetTable<W> {
    /// Begins a file with row groups of this many rows, the last one with fewer.
    pub fn new(file: W, columns: &[TableColumn], group_rows: usize) -> io::Result<ParquetTable<W>> {
        let fields = columns.iter().map(field_type).collect::<Result<Vec<_>, _>>().map_err(into_io)?;
        let schema = Type::group_type_builder("table").with_fields(fields.into_iter().map(Arc::new).collect());
        let schema = Arc::new(schema.build().map_err(into_io)?);
        let writer = SerializedFileWriter::new(file, schema, Arc::new(properties(columns))).map_err(into_io)?;
        let kinds = columns.iter().map(|column| column.kind).collect();
        Ok(ParquetTable { writer, pending: Rows::new(columns), kinds, group_rows })
    }

    /// Appends rows.
    pub fn append(&mut self, rows: Rows) -> io::Result<()> {
        self.pending.append(rows);
        while self.pending.len >= self.group_rows {
            let group = self.pending.split_off_first(self.group_rows);
            self.write_group(group)?;
        }
        Ok(())
    }

    /// Writes the remaining rows and the metadata.
    pub fn finish(mut self, metadata: Vec<(String, String)>) -> io::Result<W> {
        let rest = self.pending.split_off_first(self.group_rows);
        if rest.len > 0 {
            self.write_group(rest)?;
        }
        for (name, value) in metadata {
            self.writer.append_key_value_metadata(KeyValue::new(name, value));
        }
        self.writer.into_inner().map_err(into_io)
    }

    fn write_group(&mut self, rows: Rows) -> io::Result<()> {
        let mut group = self.writer.next_row_group().map_err(into_io)?;
        for (column, kind) in rows.columns.into_iter().zip(&self.kinds) {
            if let Some(writer) = group.next_column().map_err(into_io)? {
                write_column(column, *kind, writer).map_err(into_io)?;
            }
        }
        group.close().map_err(into_io)?;
        Ok(())
    }
}

fn write_column(column: ColumnRows, kind: ColumnKind, mut writer: SerializedColumnWriter) -> Result<(), ParquetError> {
    let levels = (!column.levels.is_empty()).then_some(&column.levels[..]);
    match (column.values, kind) {
        (Values::Integers(values), ColumnKind::Cell) => {
            writer.typed::<Int64Type>().write_batch(&values, levels, None)?;
        }
        (Values::Integers(values), _) => {
            // All but the numbers of cells are small.
            let values: Vec<i32> = values.into_iter().map(|value| value as i32).collect();
            writer.typed::<Int32Type>().write_batch(&values, levels, None)?;
        }
        (Values::Numbers(values), _) => {
            writer.typed::<DoubleType>().write_batch(&values, levels, None)?;
        }
        (Values::Words(words), _) => {
            let words: Vec<ByteArray> = words.into_iter().map(|word| word.into_owned().into_bytes().into()).collect();
            writer.typed::<ByteArrayType>().write_batch(&words, levels, None)?;
        }
    }
    writer.close()
}

fn field_type(column: &TableColumn) -> Result<Type, ParquetError> {
    let physical = match column.kind {
        ColumnKind::Cell => PhysicalType::INT64,
        ColumnKind::Integer => PhysicalType::INT32,
        ColumnKind::Number => PhysicalType::DOUBLE,
        ColumnKind::Word => PhysicalType::BYTE_ARRAY,
    };
    let repetition = if column.is_optional { Repetition::OPTIONAL } else { Repetition::REQUIRED };
    let logical = (column.kind == ColumnKind::Word).then_some(LogicalType::String);
    Type::primitive_type_builder(&column.name, physical).with_repetition(repetition).with_logical_type(logical).build()
}

/// How the columns are written: repetitive ones with a dictionary, numbers of cells as differences, and of other numbers byte
/// by byte, for their first bytes are alike.
fn properties(columns: &[TableColumn]) -> WriterProperties {
    let mut properties = WriterProperties::builder()
        .set_created_by(format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true);
    for column in columns {
        let path = || ColumnPath::from(column.name.as_str());
        properties = properties.set_column_dictionary_enabled(path(), column.is_repetitive);
        match column.kind {
            ColumnKind::Cell => {
                properties = properties.set_column_encoding(path(), Encoding::DELTA_BINARY_PACKED);
            }
            ColumnKind::Number if !column.is_repetitive => {
                properties = properties.set_column_encoding(path(), Encoding::BYTE_STREAM_SPLIT);
            }
            _ => {}
        }
    }
    properties.build()
}

/// The error of the file, if it was one.
pub(super) fn into_io(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(inner) => io::Error::other(inner),
        },
        error => io::Error::other(error),
    }
}
