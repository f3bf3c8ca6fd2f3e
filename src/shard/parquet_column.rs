//! Reads a column of a Parquet file, a part of its rows after the other.

use coupler_curves::exchange::append_number;
use parquet::column::reader::ColumnReader;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::reader::RowGroupReader;

use super::parquet_table::MAX_GROUP_TEXT;

/// The most bytes of a column of a row group, uncompressed: twice what the words of one may have, with their lengths.
const MAX_COLUMN_BYTES: i64 = 2 * MAX_GROUP_TEXT as i64;

/// The most bytes of a text. The longest that a sweep writes are reasons, of a few hundred.
const MAX_TEXT_BYTES: usize = 1 << 16;

/// A column of a row group. What is in memory are the pages that are being read.
pub(super) struct ParquetColumn {
    name: String,
    reader: ColumnReader,
}

/// The values of some rows of a column.
pub(super) struct ColumnPart<'a> {
    name: &'a str,
    /// For each row whether it has a value, 1 or 0; empty if all have one.
    levels: Vec<i16>,
    values: PartValues,
}

enum PartValues {
    Integers(Vec<i64>),
    Numbers(Vec<f64>),
    Words(Vec<ByteArray>),
}

impl ParquetColumn {
    /// Opens a column of a row group.
    ///
    /// # Errors
    /// The file cannot be read, or the column has more bytes than a sweep writes.
    pub fn open(group: &dyn RowGroupReader, column: usize) -> Result<ParquetColumn, ParquetError> {
        let metadata = group.metadata().column(column);
        let (name, bytes) = (metadata.column_descr().name().to_owned(), metadata.uncompressed_size());
        if bytes > MAX_COLUMN_BYTES {
            return Err(ParquetError::General(format!(
                "its column `{name}` takes {bytes} bytes, more than the limit of {MAX_COLUMN_BYTES}"
            )));
        }
        Ok(ParquetColumn { name, reader: group.get_column_reader(column)? })
    }

    /// Reads the next rows.
    ///
    /// # Errors
    /// The file cannot be read, has fewer rows, or the column is of another type than a sweep writes.
    pub fn read(&mut self, rows: usize) -> Result<ColumnPart<'_>, ParquetError> {
        let mut levels = Vec::new();
        macro_rules! values {
            ($reader:expr) => {{
                let mut values = Vec::new();
                let (read, ..) = $reader.read_records(rows, Some(&mut levels), None, &mut values)?;
                (read, values)
            }};
        }
        let (read, values) = match &mut self.reader {
            ColumnReader::Int32ColumnReader(reader) => {
                let (read, values): (usize, Vec<i32>) = values!(reader);
                (read, PartValues::Integers(values.into_iter().map(i64::from).collect()))
            }
            ColumnReader::Int64ColumnReader(reader) => {
                let (read, values) = values!(reader);
                (read, PartValues::Integers(values))
            }
            ColumnReader::DoubleColumnReader(reader) => {
                let (read, values) = values!(reader);
                (read, PartValues::Numbers(values))
            }
            ColumnReader::ByteArrayColumnReader(reader) => {
                let (read, values) = values!(reader);
                (read, PartValues::Words(values))
            }
            _ => return Err(ParquetError::General(format!("its column `{}` has another type", self.name))),
        };
        if read != rows {
            return Err(ParquetError::General(format!("its column `{}` lacks {} rows", self.name, rows - read)));
        }
        Ok(ColumnPart { name: &self.name, levels, values })
    }
}

impl ColumnPart<'_> {
    /// For each row the index of its value, if it has one.
    fn indices(&self) -> Vec<Option<usize>> {
        let count = match &self.values {
            PartValues::Integers(values) => values.len(),
            PartValues::Numbers(values) => values.len(),
            PartValues::Words(values) => values.len(),
        };
        if self.levels.is_empty() {
            return (0..count).map(Some).collect();
        }
        let mut values = 0..count;
        self.levels.iter().map(|level| if *level == 0 { None } else { values.next() }).collect()
    }

    /// The numbers of all rows; NaN where there is none.
    pub fn numbers(&self) -> Vec<f64> {
        let number = |index: usize| match &self.values {
            PartValues::Integers(values) => values[index] as f64,
            PartValues::Numbers(values) => values[index],
            PartValues::Words(_) => f64::NAN,
        };
        self.indices().into_iter().map(|index| index.map_or(f64::NAN, number)).collect()
    }

    /// The texts of some rows by their indices in this part, made one by one; empty where there is no value. An error, as a clause, is
    /// a text that is longer than a sweep writes it.
    pub fn texts(&self, rows: &[usize]) -> impl Iterator<Item = Result<String, String>> {
        let indices = self.indices();
        let text = move |index: usize| match &self.values {
            PartValues::Integers(values) => Ok(values[index].to_string()),
            PartValues::Numbers(values) => {
                let mut digits = Vec::new();
                append_number(values[index], &mut digits);
                Ok(String::from_utf8(digits).unwrap_or_default())
            }
            PartValues::Words(values) => match values[index].data() {
                bytes if bytes.len() > MAX_TEXT_BYTES => Err(format!(
                    "a text of its column `{}` has {} bytes, more than the limit of {MAX_TEXT_BYTES}",
                    self.name,
                    bytes.len()
                )),
                bytes => Ok(String::from_utf8_lossy(bytes).into_owned()),
            },
        };
        rows.iter().map(move |row| indices.get(*row).copied().flatten().map_or(Ok(String::new()), text))
    }
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use parquet::file::reader::FileReader;
    use parquet::file::serialized_reader::SerializedFileReader;

    use super::*;
    use crate::shard::columns::{ColumnKind, Rows, TableColumn, Values};
    use crate::shard::parquet_table::ParquetTable;

    /// A file with one column of texts.
    fn file_of(texts: &[String]) -> File {
        let columns = [TableColumn {
            name: "reason".to_owned(),
            kind: ColumnKind::Word,
            is_optional: false,
            is_repetitive: true,
            unit: "",
        }];
        let mut rows = Rows::new(&columns);
        rows.len = texts.len();
        rows.columns[0].values = Values::Words(texts.iter().map(|text| text.clone().into()).collect());
        let file = tempfile::tempfile().unwrap();
        let mut table = ParquetTable::new(file, &columns, 1 << 16).unwrap();
        table.append(rows).unwrap();
        table.finish(Vec::new()).unwrap()
    }

    #[test]
    fn only_the_texts_that_are_asked_for_are_read() {
        let mut texts: Vec<String> = (0..5000).map(|k| format!("reason {k}")).collect();
        texts[7] = "x".repeat(MAX_TEXT_BYTES + 1);
        let reader = SerializedFileReader::new(file_of(&texts)).unwrap();
        let group = reader.get_row_group(0).unwrap();
        let mut column = ParquetColumn::open(&*group, 0).unwrap();
        let first = column.read(4096).unwrap();
        let texts = |part: &ColumnPart, rows: &[usize]| part.texts(rows).collect::<Result<Vec<_>, _>>();
        assert_eq!(texts(&first, &[6, 8]).unwrap(), ["reason 6", "reason 8"]);
        assert_eq!(
            texts(&first, &[6, 7]).unwrap_err(),
            "a text of its column `reason` has 65537 bytes, more than the limit of 65536"
        );
        assert_eq!(texts(&column.read(904).unwrap(), &[0, 903]).unwrap(), ["reason 4096", "reason 4999"]);
        assert!(column.read(1).is_err_and(|error| error.to_string().contains("`reason` lacks 1 rows")));
    }

    /// A group has no more text than can be read again, however long the words are.
    #[test]
    fn row_groups_are_as_short_as_their_texts_are_long() {
        let texts: Vec<String> = (0..1000).map(|k| format!("{k:06}").repeat(10_000)).collect();
        let reader = SerializedFileReader::new(file_of(&texts)).unwrap();
        assert!(reader.num_row_groups() >= 4);
        let mut read = Vec::new();
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group).unwrap();
            let rows = group.metadata().num_rows() as usize;
            assert!(rows * 60_000 <= MAX_GROUP_TEXT);
            let mut column = ParquetColumn::open(&*group, 0).unwrap();
            let part = column.read(rows).unwrap();
            read.extend(part.texts(&(0..rows).collect::<Vec<_>>()).map(Result::unwrap));
        }
        assert_eq!(read, texts);
    }

    #[test]
    fn a_column_of_more_bytes_than_a_sweep_writes_is_refused() {
        let reader = SerializedFileReader::new(file_of(&[format!("{:07}", 3).repeat(6_000_000)])).unwrap();
        let group = reader.get_row_group(0).unwrap();
        let error = ParquetColumn::open(&*group, 0).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains("its column `reason` takes 42") && error.ends_with("the limit of 33554432"), "{error}");
    }
}
