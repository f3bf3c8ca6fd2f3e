//! Solved cells that are kept from the tables of a family to its sorted pages.

use std::collections::HashMap;

use coupler_curves::motion::estimate_bytes;
use coupler_curves::solve::SolvedCell;

/// The most memory for cells that are kept, in bytes; cells beyond it are solved again.
const MAX_KEPT_BYTES: usize = 64_000_000;

/// Solved cells by their indices, as many as there is memory for.
#[derive(Debug, Default)]
pub struct KeptCells {
    cells: HashMap<usize, SolvedCell>,
    bytes: usize,
}

impl KeptCells {
    /// Keeps cells while there is memory for them.
    pub fn extend(&mut self, solved: Vec<SolvedCell>) {
        for solved in solved {
            self.bytes = self.bytes.saturating_add(cell_bytes(&solved));
            if self.bytes <= MAX_KEPT_BYTES {
                self.cells.insert(solved.cell.number - 1, solved);
            }
        }
    }

    /// A cell by its index, which is no longer kept; `None` if it has to be solved.
    pub fn take(&mut self, cell: usize) -> Option<SolvedCell> {
        self.cells.remove(&cell)
    }
}

/// The memory that a solved cell takes, in bytes, by the numbers of samples that it has.
fn cell_bytes(solved: &SolvedCell) -> usize {
    estimate_bytes(&solved.linkage, solved.motion.circuits.iter().map(|circuit| circuit.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest;
    use coupler_curves::solve::Solver;

    /// Of a linkage driven by a length, the number of samples is known only when it is solved.
    #[test]
    fn cells_are_kept_up_to_the_limit_of_memory() {
        let plan = manifest::parse(concat!(
            "[atlas]\ntitle = \"t\"\n[[family]]\nid = \"f\"\ntitle = \"F\"\nlinkage = \"linear-actuator\"\n",
            "cases = [{ r = 1 }]\nsampling = { step = 5e-5 }\n",
        ));
        let plan = plan.plan.unwrap();
        let family = &plan.families[0].family;
        let solved = || Solver::new(family).solve(0).unwrap();
        let bytes = cell_bytes(&solved());
        assert!(bytes > 40_000 * 16, "{bytes}");
        let mut kept = KeptCells::default();
        let fit = MAX_KEPT_BYTES / bytes;
        for number in 1..=fit + 2 {
            let mut solved = solved();
            solved.cell.number = number;
            kept.extend(vec![solved]);
        }
        assert_eq!((0..fit + 2).filter(|&k| kept.take(k).is_some()).count(), fit);
        assert!(kept.take(0).is_none(), "a cell is taken once");
    }
}
