//! Indices of cells, in little memory.

use std::ops::Range;

/// The indices of some cells of a family, in an order.
#[derive(Clone, Debug, PartialEq)]
pub enum CellIndices {
    /// Consecutive cells.
    Range(Range<usize>),
    /// These cells.
    Listed(Vec<u32>),
}

impl CellIndices {
    /// The number of cells.
    pub fn len(&self) -> usize {
        match self {
            CellIndices::Range(range) => range.len(),
            CellIndices::Listed(cells) => cells.len(),
        }
    }

    /// The first cells of them, at most this number.
    pub fn first(&self, count: usize) -> CellIndices {
        match self {
            CellIndices::Range(range) => CellIndices::Range(range.start..range.start + count.min(range.len())),
            CellIndices::Listed(cells) => CellIndices::Listed(cells[..count.min(cells.len())].to_vec()),
        }
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The `k`-th cell, from 0; `None` if there is none.
    pub fn get(&self, k: usize) -> Option<usize> {
        match self {
            CellIndices::Range(range) => range.start.checked_add(k).filter(|cell| *cell < range.end),
            CellIndices::Listed(cells) => cells.get(k).map(|&cell| cell as usize),
        }
    }

    /// All cells, in order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.len()).filter_map(|k| self.get(k))
    }
}

impl Default for CellIndices {
    fn default() -> CellIndices {
        CellIndices::Range(0..0)
    }
}
