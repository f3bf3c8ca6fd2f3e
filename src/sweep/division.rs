//! Which of the cells, or of the pages, of a family a shard has.

use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

/// A part of the cells, or of the pages, of each family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Division {
    /// One of several parts that are equally large but for one cell.
    Shard {
        /// Its index, from 0.
        index: usize,
        /// The number of parts, at least 1.
        of: usize,
    },
    /// The cells with some numbers, from 1.
    Cells {
        /// The first.
        first: usize,
        /// The last, not less than the first.
        last: usize,
    },
}

/// The most shards of a family.
pub const MAX_SHARDS: usize = 1_000_000;

impl Division {
    /// All cells.
    pub const WHOLE: Division = Division::Shard { index: 0, of: 1 };

    /// The indices of its cells in a family with this number of cells. It takes no time, however many cells there are.
    pub fn range(self, cell_count: usize) -> Range<usize> {
        match self {
            Division::Shard { index, of } => {
                // The product has more than 64 bits.
                let start = |index: usize| (index as u128 * cell_count as u128 / of.max(1) as u128) as usize;
                start(index).min(cell_count)..start(index + 1).min(cell_count)
            }
            Division::Cells { first, last } => first.saturating_sub(1).min(cell_count)..last.min(cell_count),
        }
    }

    /// The part for the k-th family, from 0, of many with few pages, so that the shards are equally large all the same: the
    /// indices are shifted by k. Each family is divided into the same parts.
    pub fn shifted(self, k: usize) -> Division {
        match self {
            Division::Shard { index, of } => Division::Shard { index: (index + k) % of.max(1), of },
            Division::Cells { .. } => self,
        }
    }

    /// The end of the names of its files, whose order is that of the cells: `00003-of-00064`, or `0001-2000` for cells of a family
    /// with this number of cells.
    pub fn label(self, cell_count: usize) -> String {
        match self {
            Division::Shard { index, of } => {
                let width = of.saturating_sub(1).to_string().len().max(5);
                format!("{index:0width$}-of-{of:0width$}")
            }
            Division::Cells { first, last } => {
                let width = cell_count.to_string().len();
                format!("{first:0width$}-{last:0width$}")
            }
        }
    }
}

/// As options of `sweep` give it: `--shard 3/64`.
impl fmt::Display for Division {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Division::Shard { index, of } => write!(f, "--shard {index}/{of}"),
            Division::Cells { first, last } => write!(f, "--cells {first}..{last}"),
        }
    }
}

/// The most ranges that a message names.
pub const MAX_RANGES: usize = 20;

/// Increasing numbers in words: "3, 5 to 7".
pub fn number_ranges(numbers: &[usize]) -> String {
    let runs: Vec<&[usize]> = numbers.chunk_by(|a, b| a + 1 == *b).collect();
    let words = runs.iter().take(MAX_RANGES).map(|run| match run {
        [only] => only.to_string(),
        [first, .., last] => format!("{first} to {last}"),
        [] => String::new(),
    });
    let mut words: Vec<String> = words.collect();
    let more: usize = runs.iter().skip(MAX_RANGES).map(|run| run.len()).sum();
    if more > 0 {
        words.push(format!("and {more} more"));
    }
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_named_in_ranges() {
        assert_eq!(number_ranges(&[3, 5, 6, 7, 9, 10]), "3, 5 to 7, 9 to 10");
        assert_eq!(number_ranges(&[]), "");
        let many: Vec<usize> = (0..60).step_by(2).collect();
        assert!(number_ranges(&many).ends_with(", 36, 38, and 10 more"));
    }

    #[test]
    fn shards_are_consecutive_and_equally_large() {
        for count in [0, 1, 2, 7, 64, 1000, 4_000_000_000] {
            for of in [1, 2, 3, 7, 64, 999_983] {
                let ranges = (0..of).map(|index| Division::Shard { index, of }.range(count));
                let mut next = 0;
                for range in ranges {
                    assert_eq!(range.start, next);
                    assert!((count / of..=count.div_ceil(of)).contains(&range.len()), "{range:?} of {count}");
                    next = range.end;
                }
                assert_eq!(next, count);
            }
        }
        // Ten families of one page in five shards.
        let pages =
            |index| (0..10).map(move |k| Division::Shard { index, of: 5 }.shifted(k).range(1).len()).sum::<usize>();
        assert!((0..5).all(|index| pages(index) == 2));
        assert_eq!(Division::Cells { first: 3, last: 5 }.range(10), 2..5);
        assert_eq!(Division::Cells { first: 3, last: 50 }.range(10), 2..10);
        assert_eq!(Division::Cells { first: 3, last: 5 }.label(1000), "0003-0005");
        assert_eq!(Division::Shard { index: 3, of: 64 }.label(1000), "00003-of-00064");
        // Names are in the order of shards.
        assert_eq!(Division::Shard { index: 99_999, of: 100_000 }.label(1000), "99999-of-100000");
        assert_eq!(Division::Shard { index: 99_999, of: 150_000 }.label(1000), "099999-of-150000");
        assert_eq!(Division::Shard { index: 100_000, of: 150_000 }.label(1000), "100000-of-150000");
    }
}
