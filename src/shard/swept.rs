//! What a sweep of a family has: its measures, and what the record of its tables says before any cell is solved.

use std::borrow::Cow;

use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::Family;
use coupler_curves::measure::MeasureSet;

use super::columns::TableColumn;
use super::options::Options;
use super::record::{Counts, FORMAT, ShardRecord, TableKind, Top};
use super::table;
use crate::manifest::{Plan, PlannedFamily};
use crate::record::{Digest, RunningDigest};
use crate::sweep::{CellGroups, CellIndices, cells_of_division};

/// The digest of what a manifest says of the values in tables.
pub(super) fn manifest_digest(plan: &Plan) -> Digest {
    let mut digest = RunningDigest::default();
    for PlannedFamily { family, manifest_inputs, .. } in &plan.families {
        digest.update(format!("{}\n{}\n", family.id, manifest_inputs.table_text()).as_bytes());
    }
    digest.finish()
}

/// A family with the measures that the tables have: those that `by` and `where` use and, of others, the named ones or the family's own.
pub(super) fn swept_family<'f>(
    family: &'f Family,
    by: Option<&CompiledExpression>,
    measures: Option<&[String]>,
) -> Cow<'f, Family> {
    let named =
        |names: &[String]| MeasureSet::of(|measure| measure.names().any(|own| names.iter().any(|name| name == own)));
    let expressions = by.into_iter().chain(&family.filter);
    let measures = expressions
        .fold(measures.map_or(family.measures, named), |set, expression| set | family.measures_in(expression));
    match measures == family.measures {
        true => Cow::Borrowed(family),
        false => Cow::Owned(Family { measures, ..family.clone() }),
    }
}

/// The record of the table of cells before any cell is solved.
pub(super) fn initial_record(
    planned: &PlannedFamily,
    family: &Family,
    (manifest_sha256, families): (Digest, &[String]),
    (options, top): (&Options, Option<Top>),
) -> ShardRecord {
    let cell_count = family.cell_count();
    let range = cells_of_division(&planned.family, options.division);
    let joint = |traced: &usize| family.template.joints[*traced].name.clone();
    ShardRecord {
        format: FORMAT,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        manifest_sha256,
        table: TableKind::Cells,
        family: family.id.clone(),
        families: families.to_vec(),
        division: options.division,
        first_cell: range.start + 1,
        last_cell: range.end,
        cell_count,
        columns: Vec::new(),
        top,
        has_points: options.has_points,
        rows: 0,
        counts: Counts::default(),
        joints: family.template.traced.iter().map(joint).collect(),
        units: Default::default(),
        manifest: planned.excerpt(),
    }
    .with_columns(&table::columns(family, TableKind::Cells))
}

impl ShardRecord {
    /// The same with the names and units of columns.
    pub(super) fn with_columns(self, columns: &[TableColumn]) -> ShardRecord {
        let named = columns.iter().filter(|column| !column.unit.is_empty());
        ShardRecord {
            columns: columns.iter().map(|column| column.name.clone()).collect(),
            units: named.map(|column| (column.name.clone(), column.unit.to_owned())).collect(),
            ..self
        }
    }
}

/// The groups in which cells are solved: as many cells as take a few megabytes.
pub(super) fn groups<'g>(family: &Family, cells: &'g CellIndices, measures: Option<MeasureSet>) -> CellGroups<'g> {
    const GROUP_BYTES: usize = 1 << 22;
    const MOST_CELLS: usize = 64;
    let size = (GROUP_BYTES / family.estimate_cell_bytes().max(1)).clamp(1, MOST_CELLS);
    CellGroups { cells, first_group: 0, size, work_bytes: 0, requested_measures: measures, solve_known: None }
}
