//! What a file of a shard says of itself: which cells of which family of which manifest it has.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::Division;
use super::problem::FileProblem;
use crate::record::Digest;

/// The version of the format of the tables and of this record. In the first, which is read if all curves are there, the best were those with
/// the greatest value.
pub const FORMAT: u32 = 2;

/// What begins the names of the metadata of a Parquet file.
const PREFIX: &str = "coupler_atlas.";

/// The fields whose values are written as they are; those of others are JSON.
const TEXTS: [&str; 5] = ["version", "manifest_sha256", "family", "manifest", "sha256"];

/// The name in the metadata of a Parquet file of its digest.
pub(super) const DIGEST_NAME: &str = "coupler_atlas.sha256";

/// Which of the tables of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TableKind {
    /// `cells`: a row for each curve.
    Cells,
    /// `points`: a row for each sample.
    Points,
}

impl TableKind {
    /// The beginning of the names of its files.
    pub fn name(self) -> &'static str {
        match self {
            TableKind::Cells => "cells",
            TableKind::Points => "points",
        }
    }
}

/// That only the best curves are kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Top {
    /// How many, at most.
    pub count: usize,
    /// The expression that is least for them.
    pub by: String,
}

/// What the numbers of a shard are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// The curves in the tables.
    pub curves: usize,
    /// The curves that `where` excludes, of cells with others.
    pub curves_left_out: usize,
    /// The cells that `where` excludes.
    pub cells_left_out: usize,
    /// The other cells that cannot be assembled.
    pub not_assembled: usize,
    /// Those that can be assembled over a part of the range only.
    pub partly_assembled: usize,
    /// The samples of the curves in the tables.
    pub points: usize,
}

impl Counts {
    /// Adds those of other cells.
    pub fn add(&mut self, other: &Counts) {
        self.curves += other.curves;
        self.curves_left_out += other.curves_left_out;
        self.cells_left_out += other.cells_left_out;
        self.not_assembled += other.not_assembled;
        self.partly_assembled += other.partly_assembled;
        self.points += other.points;
    }
}

/// The record in a file of a shard: the metadata of a Parquet file, or a file of JSON beside a CSV file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShardRecord {
    /// [`FORMAT`].
    pub format: u32,
    /// The version of the program.
    pub version: String,
    /// The digest of what the manifest says of the values in tables, of all families.
    pub manifest_sha256: Digest,
    /// Which table it is.
    pub table: TableKind,
    /// The id of the family.
    pub family: String,
    /// The ids of all families of the manifest.
    pub families: Vec<String>,
    /// Which of the family's cells it has.
    pub division: Division,
    /// The number of its first cell, from 1.
    pub first_cell: usize,
    /// The number of its last cell; one less than the first if it has no cells.
    pub last_cell: usize,
    /// The number of cells of the family.
    pub cell_count: usize,
    /// The columns.
    pub columns: Vec<String>,
    /// That only the best curves are in it.
    pub top: Option<Top>,
    /// Whether there is a table of points.
    pub has_points: bool,
    /// The number of rows.
    pub rows: usize,
    /// What the rows are.
    pub counts: Counts,
    /// The names of the traced joints, in the order of the numbers of traces.
    pub joints: Vec<String>,
    /// The units of columns; those without one are words, counts, ratios, or in the manifest's own unit of length.
    pub units: BTreeMap<String, String>,
    /// A manifest of the family alone, with all that determines a curve whose parameters are known.
    pub manifest: String,
}

impl ShardRecord {
    /// The metadata of a Parquet file.
    pub(super) fn to_metadata(&self) -> Vec<(String, String)> {
        // A record is made of texts, numbers and lists of them, which can always be written as JSON.
        let Ok(Value::Object(fields)) = serde_json::to_value(self) else { return Vec::new() };
        let text = |value: Value| match value {
            Value::String(text) => text,
            value => value.to_string(),
        };
        let is_text = |name: &str| TEXTS.contains(&name);
        let entry = |(name, value): (String, Value)| {
            let value = if is_text(&name) { text(value) } else { value.to_string() };
            (format!("{PREFIX}{name}"), value)
        };
        fields.into_iter().map(entry).collect()
    }

    /// Reads the metadata of a Parquet file.
    ///
    /// # Errors
    /// They have no record of this format.
    pub(super) fn from_metadata<'a>(
        metadata: impl Iterator<Item = (&'a str, Option<&'a str>)>,
    ) -> Result<ShardRecord, FileProblem> {
        let field = |(name, value): (&str, Option<&str>)| {
            let name = name.strip_prefix(PREFIX)?;
            let value = value?;
            let value = match TEXTS.contains(&name) {
                true => Value::String(value.to_owned()),
                false => serde_json::from_str(value).ok()?,
            };
            Some((name.to_owned(), value))
        };
        let fields: Map<String, Value> = metadata.filter_map(field).collect();
        if fields.is_empty() {
            return Err(FileProblem::Foreign("no sweep wrote it".to_owned()));
        }
        if !fields.contains_key("format") {
            return Err(FileProblem::Damaged("it does not state its format".to_owned()));
        }
        ShardRecord::from_value(Value::Object(fields))
    }

    /// Reads a record as JSON.
    ///
    /// # Errors
    /// It is not a record of this format.
    pub(super) fn from_value(value: Value) -> Result<ShardRecord, FileProblem> {
        match value.get("format").and_then(Value::as_u64) {
            Some(format) if format == u64::from(FORMAT) => {}
            Some(1) if value.get("top").is_none_or(Value::is_null) => {}
            Some(1) => {
                let message = "it has the curves for which its expression is greatest, of a version in which these were the best; now they \
                               are those for which it is least: make it again with a minus sign";
                return Err(FileProblem::Foreign(message.to_owned()));
            }
            Some(format) => {
                let message = format!("it has the format {format}, and this version reads {FORMAT}");
                return Err(FileProblem::Foreign(message));
            }
            None => return Err(FileProblem::Foreign("it does not state its format".to_owned())),
        }
        let record: ShardRecord =
            serde_json::from_value(value).map_err(|error| FileProblem::Damaged(format!("its record: {error}")))?;
        let ShardRecord { first_cell, last_cell, cell_count, .. } = record;
        let is_range = (1..=cell_count.saturating_add(1)).contains(&first_cell) && last_cell <= cell_count;
        if !is_range || last_cell + 1 < first_cell {
            return Err(FileProblem::Damaged(format!(
                "it states the cells {first_cell} to {last_cell} of {cell_count}"
            )));
        }
        Ok(record)
    }

    /// Why it is not what a run with another record would write; `None` if it is.
    pub(super) fn difference_from(&self, other: &ShardRecord) -> Option<String> {
        if self.version != other.version {
            return Some(format!("version {} of the program wrote it", self.version));
        }
        if self.manifest_sha256 != other.manifest_sha256 || self.families != other.families {
            return Some("it is from another manifest".to_owned());
        }
        if self.top != other.top {
            return Some(match &self.top {
                Some(Top { count, by }) => format!("it has only the best {count} by `{by}`"),
                None => "it has all curves and not only the best".to_owned(),
            });
        }
        if self.columns != other.columns {
            return Some(format!("it has other columns{}", column_difference(&self.columns, &other.columns)));
        }
        let place = |record: &ShardRecord| {
            let ShardRecord { family, table, division, first_cell, last_cell, cell_count, .. } = record;
            (family.clone(), *table, *division, *first_cell, *last_cell, *cell_count)
        };
        (place(self) != place(other)).then(|| format!("it is another shard: {} of `{}`", self.division, self.family))
    }

    /// Whether the tables with two records have the same rows: the manifests may have different titles and captions.
    pub(super) fn has_same_rows(&self, other: &ShardRecord) -> bool {
        let without_manifest = |record: &ShardRecord| ShardRecord { manifest: String::new(), ..record.clone() };
        without_manifest(self) == without_manifest(other)
    }
}

/// ": `length` and not `area`": how columns differ from others; nothing if only their order does.
pub(super) fn column_difference(columns: &[String], others: &[String]) -> String {
    let missing = |columns: &[String], others: &[String]| {
        let names: Vec<String> =
            columns.iter().filter(|name| !others.contains(name)).map(|name| format!("`{name}`")).collect();
        match names.len() {
            0..=3 => names.join(", "),
            count => format!("{} and {} more", names[..2].join(", "), count - 2),
        }
    };
    match [missing(columns, others), missing(others, columns)].each_ref().map(String::as_str) {
        ["", ""] => String::new(),
        [more, ""] => format!(": {more}"),
        ["", fewer] => format!(": not {fewer}"),
        [more, fewer] => format!(": {more} and not {fewer}"),
    }
}

/// The greatest number of curves that the best may be.
pub const MAX_TOP: usize = 1_000_000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metadata_read_back() {
        let record = ShardRecord {
            format: FORMAT,
            version: "1.2".to_owned(),
            manifest_sha256: Digest::of(b"m"),
            table: TableKind::Points,
            family: "12".to_owned(),
            families: vec!["12".to_owned(), "b".to_owned()],
            division: Division::Shard { index: 3, of: 64 },
            first_cell: 4,
            last_cell: 3,
            cell_count: 7,
            columns: vec!["cell".to_owned()],
            top: Some(Top { count: 5, by: "a * \"b".to_owned() }),
            has_points: true,
            rows: 0,
            counts: Counts { curves: 1, ..Counts::default() },
            joints: vec!["M".to_owned()],
            units: BTreeMap::from([("x".to_owned(), "deg".to_owned())]),
            manifest: "atlas={title=\"T\"}\n".to_owned(),
        };
        let metadata = record.to_metadata();
        let pairs = || metadata.iter().map(|(name, value)| (name.as_str(), Some(value.as_str())));
        assert_eq!(ShardRecord::from_metadata(pairs()), Ok(record));
        assert!(pairs().any(|pair| pair == ("coupler_atlas.family", Some("12"))));
        let without = ShardRecord::from_metadata(pairs().filter(|(name, _)| *name != "coupler_atlas.rows"));
        assert!(matches!(without, Err(FileProblem::Damaged(why)) if why.contains("rows")));
        let foreign = FileProblem::Foreign("no sweep wrote it".to_owned());
        assert_eq!(ShardRecord::from_metadata(std::iter::empty()), Err(foreign));
    }
}
