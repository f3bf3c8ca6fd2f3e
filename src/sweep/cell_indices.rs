//! Indices of cells, in little memory.

/// The indices of some cells of a family, in an order.
#[derive(Clone, Debug, PartialEq)]
pub enum CellIndices {
    /// The first cells, as many as this number.
    First(usize),
    /// These cells.
    Listed(Vec<u32>),
}

impl CellIndices {
    /// The number of cells.
    pub fn len(&self) -> usize {
        match self {
            CellIndices::First(count) => *count,
            CellIndices::Listed(cells) => cells.len(),
        }
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The `k`-th cell, from 0; `None` if there is none.
    pub fn get(&self, k: usize) -> Option<usize> {
        match self {
            CellIndices::First(count) => (k < *count).then_some(k),
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
        CellIndices::First(0)
    }
}
