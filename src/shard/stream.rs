//! The rows of a table as they are asked for, without files.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use coupler_curves::family::Family;
use coupler_curves::solve::SolvedCell;

use super::columns::{Rows, TableColumn};
use super::record::TableKind;
use super::swept::{groups, swept_family};
use super::{Division, table};
use crate::output;
use crate::sweep::{self, CellGroups, CellIndices};

/// The rows of a table of a family, with the columns, values and order of the tables that [`super::write_shard`] writes. Cells are solved when
/// their rows are asked for.
#[derive(Clone, Debug)]
pub struct TableStream {
    /// With the measures that the table has.
    family: Arc<Family>,
    table: TableKind,
    columns: Vec<TableColumn>,
    /// The indices of the cells whose rows are still to come.
    rest: Range<usize>,
}

/// The number of rows from which no further cells are added to some that are asked for.
const ENOUGH_ROWS: usize = 1 << 12;

/// The groups of cells that are solved at once, and the most cells of one: the same on every machine, so that the rows come in the same parts.
const GROUPS_AT_ONCE: usize = 32;
const CELLS_OF_GROUP: usize = 16;

impl TableStream {
    /// The table of the cells of a division; `measures` are by name, in place of the family's own, and those that `where` uses are among them
    /// in any case. The table of points has no measures, and only those that `where` uses are computed for it.
    pub fn new(family: &Family, table: TableKind, division: Division, measures: Option<&[String]>) -> TableStream {
        let measures = if table == TableKind::Points { Some(&[][..]) } else { measures };
        let family = Arc::new(swept_family(family, None, measures).into_owned());
        let columns = table::columns(&family, table);
        let rest = sweep::cells_of_division(&family, division);
        TableStream { family, table, columns, rest }
    }

    /// The columns, in order.
    pub fn columns(&self) -> &[TableColumn] {
        &self.columns
    }

    /// The indices of the cells whose rows are still to come, from 0.
    pub fn rest(&self) -> Range<usize> {
        self.rest.clone()
    }

    /// The next rows, some thousands, solved on all threads; `None` at the end. `solved` is called with numbers of cells as they are solved.
    /// Memory is bounded.
    ///
    /// # Errors
    /// `interrupt` is true; the next call begins again with the same rows.
    pub fn next_rows(
        &mut self,
        interrupt: &AtomicBool,
        solved: &mut dyn FnMut(usize),
    ) -> Result<Option<Rows>, output::Error> {
        let mut rows = Rows::new(&self.columns);
        let mut rest = self.rest.clone();
        while rows.len < ENOUGH_ROWS && !rest.is_empty() {
            let size = groups(&self.family, &CellIndices::default(), None).size.min(CELLS_OF_GROUP);
            let cells = rest.start..rest.end.min(rest.start + size * GROUPS_AT_ONCE);
            rest.start = cells.end;
            let cells = CellIndices::Range(cells);
            let make = |_, group: Vec<SolvedCell>| {
                let mut rows = Rows::new(&self.columns);
                for solved in &group {
                    match self.table {
                        TableKind::Cells => rows.append_cell(&self.family, solved),
                        TableKind::Points => rows.append_points(&self.family, solved),
                    }
                }
                (rows, group.len())
            };
            let groups = CellGroups { size, ..groups(&self.family, &cells, None) };
            sweep::process_groups(&self.family, groups, make, |(group, count)| {
                if interrupt.load(Ordering::Relaxed) {
                    return Err(output::Error::Interrupted);
                }
                rows.append(group);
                solved(count);
                Ok(())
            })?;
        }
        let is_end = rest.is_empty() && rows.len == 0;
        self.rest = rest;
        Ok((!is_end).then_some(rows))
    }
}
