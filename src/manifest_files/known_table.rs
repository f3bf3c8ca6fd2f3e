//! Tables of cases that have been read or found before.

use std::io;
use std::sync::Arc;

use super::case_rows::CaseRows;
use crate::manifest::{Plan, PlannedFamily};
use coupler_curves::family::ParameterSpace;

/// A table of cases that has been read or found before: a manifest may be parsed again without it, where there is no such file, or another,
/// and without the search.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownTable {
    /// Its path, as the manifest has it, or what the answers of a search are called.
    pub path: String,
    /// The names of its columns, at least one.
    pub names: Vec<String>,
    /// The values, row by row.
    pub values: Arc<Vec<f64>>,
}

impl KnownTable {
    /// The tables that the families of a manifest have their cases from.
    pub fn of_plan(plan: &Plan) -> Vec<KnownTable> {
        let table = |PlannedFamily { family, case_file, .. }: &PlannedFamily| match (&family.space, case_file) {
            (ParameterSpace::Table { slots, values }, Some(file)) => {
                let names = slots.iter().map(|slot| family.names[*slot].clone()).collect();
                Some(KnownTable { path: file.path.clone(), names, values: Arc::clone(values) })
            }
            _ => None,
        };
        plan.families.iter().filter_map(table).collect()
    }

    /// Passes on its rows.
    pub(super) fn read(&self, rows: &mut CaseRows) -> io::Result<()> {
        rows.set_names(self.names.clone());
        for row in self.values.chunks_exact(self.names.len().max(1)) {
            match rows.is_next_kept() {
                true => rows.push(row, 0)?,
                false => rows.skip(1),
            }
        }
        Ok(())
    }
}
