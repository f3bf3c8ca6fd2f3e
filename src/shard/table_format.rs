//! The formats of the tables of a shard.

/// The format of the tables of a shard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum TableFormat {
    /// Parquet, with typed columns.
    #[default]
    Parquet,
    /// Comma-separated values, as `cells.csv` and `points.csv` have them, with a record beside each.
    Csv,
}

impl TableFormat {
    /// Every format.
    pub const ALL: [TableFormat; 2] = [TableFormat::Parquet, TableFormat::Csv];

    /// Its name, and the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            TableFormat::Parquet => "parquet",
            TableFormat::Csv => "csv",
        }
    }
}
