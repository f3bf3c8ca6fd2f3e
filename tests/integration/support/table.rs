//! Tables in CSV.

use std::collections::BTreeMap;

/// A row of a table, by the names of its columns.
pub type Row = BTreeMap<String, String>;

/// The rows of a table.
pub fn rows(text: &str) -> Vec<Row> {
    csv::Reader::from_reader(text.as_bytes()).deserialize().map(Result::unwrap).collect()
}

/// Numbers of a row.
pub fn numbers<const N: usize>(row: &Row, columns: [&str; N]) -> [f64; N] {
    columns.map(|name| row[name].parse().unwrap_or_else(|_| panic!("{name} is {:?}", row[name])))
}
