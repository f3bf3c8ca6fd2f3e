//! What is gathered, and what complete shards have.

use csv::StringRecord;

use super::super::record::Counts;
use crate::manifest::Plan;

/// What is gathered.
#[derive(Clone, Debug, Default)]
pub struct GatherOptions {
    /// The ids of the families; all if empty.
    pub only: Vec<String>,
    /// How many of the best curves of all families are found.
    pub top: Option<usize>,
    /// The expression that is least for the best; if `None`, that by which the shards kept theirs, or else the `sort` of each family.
    pub by: Option<String>,
}

/// Complete shards.
#[derive(Debug)]
pub struct Gathered {
    /// The plan of a manifest for each family, as the shards record it: with all that determines a curve whose parameters are
    /// known.
    pub families: Vec<(Plan, FamilyTotals)>,
    /// What a user may want to know, as sentences without an end.
    pub notes: Vec<String>,
    /// The expressions of the best: one, or those by which the families are sorted, in their order; none if no best are asked for.
    pub by: Vec<String>,
    /// The columns of the best.
    pub columns: Vec<String>,
    /// The best curves of each expression, best first; of equal ones the order is that of families, cells, traces and circuits.
    pub best: Vec<BestCurve>,
}

/// The shards of a family.
#[derive(Clone, Debug)]
pub struct FamilyTotals {
    /// The id of the family.
    pub id: String,
    /// The text of the manifest of the family alone.
    pub manifest: String,
    /// The number of its cells.
    pub cells: usize,
    /// The number of shards.
    pub shards: usize,
    /// The number of rows of the tables of cells.
    pub rows: usize,
    /// The sums of their counts.
    pub counts: Counts,
    /// Whether there are tables of points.
    pub has_points: bool,
    /// Whether the shards have the best curves only.
    pub has_best_only: bool,
}

/// One of the best curves.
#[derive(Clone, Debug, PartialEq)]
pub struct BestCurve {
    /// The value of the expression.
    pub key: f64,
    /// The index of its family in [`Gathered::families`].
    pub family: usize,
    /// Its cell, trace and circuit, each from 1.
    pub place: [usize; 3],
    /// The values of the parameters of its linkage.
    pub parameters: Vec<f64>,
    /// The texts of its row in the order of [`Gathered::columns`]; empty where its family lacks a column.
    pub fields: StringRecord,
}
