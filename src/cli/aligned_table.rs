//! Tables whose columns are aligned, for people.

/// Rows with a number and cells whose columns are aligned: words left, numbers right. A caller may put lines of its own between them.
pub(super) struct AlignedTable {
    rank_width: usize,
    /// For each column, its width in characters and whether it has words.
    columns: Vec<(usize, bool)>,
}

impl AlignedTable {
    /// The widths for a heading, with whether each column has words, and some rows, whose numbers have at most so many digits.
    pub fn new<'r>(rank_width: usize, head: &[(&str, bool)], rows: impl Iterator<Item = &'r [String]>) -> AlignedTable {
        let mut columns: Vec<(usize, bool)> =
            head.iter().map(|(name, has_words)| (name.chars().count(), *has_words)).collect();
        for row in rows {
            for ((width, _), cell) in columns.iter_mut().zip(row) {
                *width = (*width).max(cell.chars().count());
            }
        }
        AlignedTable { rank_width, columns }
    }

    /// The line of a row.
    pub fn line<T: AsRef<str>>(&self, rank: &str, cells: impl IntoIterator<Item = T>) -> String {
        let mut line = format!("{rank:>0$}", self.rank_width);
        for (cell, (width, has_words)) in cells.into_iter().zip(&self.columns) {
            let cell = cell.as_ref();
            let pad = " ".repeat(width.saturating_sub(cell.chars().count()));
            line += &if *has_words { format!("  {cell}{pad}") } else { format!("  {pad}{cell}") };
        }
        format!("{}\n", line.trim_end())
    }
}
