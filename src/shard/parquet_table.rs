//! Writes a table as a Parquet file with its own digest.

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
use super::record::DIGEST_NAME;
use crate::record::RunningDigest;

/// The most bytes of words of a row group, unless it is a single row: what a reader may have in memory at once.
pub(super) const MAX_GROUP_TEXT: usize = 1 << 24;

/// What stands for the digest of a file while that is computed.
pub(super) const NO_DIGEST: [u8; 64] = [b'0'; 64];

/// A file whose end is held back, for it has the digest of the whole file.
struct DigestedFile<W> {
    file: W,
    /// Of what has been written.
    digest: RunningDigest,
    /// The end; `None` until that begins.
    end: Option<Vec<u8>>,
}

impl<W: Write> Write for DigestedFile<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if let Some(end) = &mut self.end {
            return end.write(bytes);
        }
        let written = self.file.write(bytes)?;
        self.digest.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl<W: Write> DigestedFile<W> {
    /// Writes the end, with the digest in place of [`NO_DIGEST`].
    fn finish(mut self) -> io::Result<W> {
        let mut end = self.end.unwrap_or_default();
        self.digest.update(&end);
        let digest = self.digest.finish().to_string();
        if let Some(place) = find_last(&end, &NO_DIGEST) {
            end[place..place + NO_DIGEST.len()].copy_from_slice(digest.as_bytes());
        }
        self.file.write_all(&end)?;
        Ok(self.file)
    }
}

/// The last place of some bytes among others.
pub(super) fn find_last(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).rposition(|window| window == wanted)
}

/// A Parquet file that is being written. Its bytes depend on the rows alone, and not on how they arrive.
pub(super) struct ParquetTable<W: Write + Send> {
    writer: SerializedFileWriter<DigestedFile<W>>,
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
        let file = DigestedFile { file, digest: RunningDigest::default(), end: None };
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

    /// Writes the remaining rows, the metadata and the digest.
    pub fn finish(mut self, metadata: Vec<(String, String)>) -> io::Result<W> {
        let rest = self.pending.split_off_first(self.group_rows);
        if rest.len > 0 {
            self.write_group(rest)?;
        }
        let no_digest = String::from_utf8_lossy(&NO_DIGEST).into_owned();
        for (name, value) in metadata.into_iter().chain([(DIGEST_NAME.to_owned(), no_digest)]) {
            self.writer.append_key_value_metadata(KeyValue::new(name, value));
        }
        self.writer.flush()?;
        self.writer.inner_mut().end = Some(Vec::new());
        self.writer.into_inner().map_err(into_io)?.finish()
    }

    fn write_group(&mut self, mut rows: Rows) -> io::Result<()> {
        if rows.len > 1 && rows.text_bytes() > MAX_GROUP_TEXT {
            let first = rows.split_off_first(rows.len / 2);
            self.write_group(first)?;
            return self.write_group(rows);
        }
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
pub(crate) fn into_io(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(inner) => io::Error::other(inner),
        },
        error => io::Error::other(error),
    }
}
