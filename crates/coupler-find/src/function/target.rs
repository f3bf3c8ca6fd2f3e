//! A wanted function of an input: rows of a table, or a law.

use super::law::Law;
use coupler_curves::geometry::trig;

/// A wanted function: what an output is to be at the inputs of some rows, or over a whole range.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionTarget {
    wanted: Wanted,
    /// The greatest output less the least: radians or a length.
    size: f64,
    /// Whether the output is a length.
    is_length: bool,
}

#[derive(Clone, Debug, PartialEq)]
enum Wanted {
    /// The travels of input and output at each row from the first.
    Rows(Vec<[f64; 2]>),
    Law(Law),
}

/// Why rows are no function to generate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FunctionTargetError {
    /// There are too few rows, or too many.
    #[error(
        "it has {count} rows, and a function has from {} to {}",
        FunctionTarget::MIN_ROWS,
        FunctionTarget::MAX_ROWS
    )]
    Count {
        /// How many.
        count: usize,
    },
    /// A number is not finite.
    #[error("{value} is not a finite number")]
    NotFinite {
        /// The number of the row, from 1.
        row: usize,
        /// The number.
        value: f64,
    },
    /// The input does not go on.
    #[error(
        "the input is {input} after {before}, and {}", if input == before {
            "each input has one output: leave one row out"
        } else {
            "it must rise from row to row, or fall: put the rows in the order of the input"
        }
    )]
    NotMonotonic {
        /// The number of the row, from 1.
        row: usize,
        /// The input there.
        input: f64,
        /// The input at the row before it.
        before: f64,
    },
    /// The input turns by more than a turn.
    #[error("the input turns by {turn_deg}°, and at most 360° can be asked for")]
    MoreThanATurn {
        /// By how much.
        turn_deg: f64,
    },
    /// The output is at rest.
    #[error("the output is {value} in all rows: a constant needs no linkage")]
    Constant {
        /// What it is.
        value: f64,
    },
}

impl FunctionTargetError {
    /// The number of the row that it is about, from 1, if it is about one; its message does not have it.
    pub fn row(&self) -> Option<usize> {
        match self {
            FunctionTargetError::NotFinite { row, .. } | FunctionTargetError::NotMonotonic { row, .. } => Some(*row),
            _ => None,
        }
    }
}

/// In how many equal parts of the input the error of a law is sampled for a fit.
const FITTED_PARTS: usize = 120;

impl FunctionTarget {
    /// The least and the greatest number of rows.
    pub const MIN_ROWS: usize = 3;
    /// See [`FunctionTarget::MIN_ROWS`].
    pub const MAX_ROWS: usize = 5000;

    /// A function of rows: inputs in degrees and outputs in degrees or as lengths, from any zero.
    ///
    /// # Errors
    /// All that is wrong with the rows.
    pub fn rows(rows: &[[f64; 2]], is_length: bool) -> Result<FunctionTarget, Vec<FunctionTargetError>> {
        let count = rows.len();
        let mut problems = Vec::new();
        if !(FunctionTarget::MIN_ROWS..=FunctionTarget::MAX_ROWS).contains(&count) {
            problems.push(FunctionTargetError::Count { count });
        }
        for (number, row) in (1..).zip(rows) {
            let wrong = row.iter().filter(|value| !value.is_finite());
            problems.extend(wrong.map(|value| FunctionTargetError::NotFinite { row: number, value: *value }));
        }
        let rises = rows.first().zip(rows.last()).is_some_and(|(first, last)| last[0] >= first[0]);
        for (k, pair) in rows.windows(2).enumerate() {
            let [before, input] = [pair[0][0], pair[1][0]];
            let goes_on = if rises { input > before } else { input < before };
            if !goes_on && before.is_finite() && input.is_finite() {
                problems.push(FunctionTargetError::NotMonotonic { row: k + 2, input, before });
            }
        }
        let outputs = || rows.iter().map(|row| row[1]);
        let [low, high] = [outputs().fold(f64::INFINITY, f64::min), outputs().fold(f64::NEG_INFINITY, f64::max)];
        if problems.is_empty() {
            let turn_deg = (rows[count - 1][0] - rows[0][0]).abs();
            if turn_deg > 360.0 {
                problems.push(FunctionTargetError::MoreThanATurn { turn_deg });
            }
            if low == high {
                problems.push(FunctionTargetError::Constant { value: low });
            }
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        let output = |value: f64| if is_length { value } else { trig::radians(value) };
        let [first_in, first_out] = rows[0];
        let travels = rows.iter().map(|[x, y]| [trig::radians(x - first_in), output(y - first_out)]).collect();
        Ok(FunctionTarget { wanted: Wanted::Rows(travels), size: output(high - low), is_length })
    }

    /// A function of a law, whose range is of an output that is a length, or an angle.
    pub fn law(law: Law, is_length: bool) -> FunctionTarget {
        let mut target = FunctionTarget { size: 1.0, wanted: Wanted::Law(law), is_length };
        let outputs = || target.samples().into_iter().map(|[_, y]| y);
        target.size = outputs().fold(f64::NEG_INFINITY, f64::max) - outputs().fold(f64::INFINITY, f64::min);
        target
    }

    /// The same function with the output as many times greater.
    pub(super) fn scaled(&self, factor: f64) -> FunctionTarget {
        let wanted = match &self.wanted {
            Wanted::Rows(rows) => Wanted::Rows(rows.iter().map(|[x, y]| [*x, factor * y]).collect()),
            Wanted::Law(law) => Wanted::Law(law.scaled(factor)),
        };
        FunctionTarget { wanted, size: factor * self.size, is_length: self.is_length }
    }

    /// Whether the output is a length.
    pub fn is_length(&self) -> bool {
        self.is_length
    }

    /// The greatest output less the least, in radians or as a length.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The same in degrees or as a length.
    pub(super) fn size_in_units(&self) -> f64 {
        if self.is_length { self.size } else { trig::degrees(self.size) }
    }

    /// The law, if it is one.
    pub fn as_law(&self) -> Option<&Law> {
        match &self.wanted {
            Wanted::Law(law) => Some(law),
            Wanted::Rows(_) => None,
        }
    }

    /// The number of rows, if it has rows.
    pub fn row_count(&self) -> Option<usize> {
        match &self.wanted {
            Wanted::Rows(rows) => Some(rows.len()),
            Wanted::Law(_) => None,
        }
    }

    /// The travel of the input over the whole function, in radians.
    pub fn travel(&self) -> f64 {
        match &self.wanted {
            Wanted::Rows(rows) => rows[rows.len() - 1][0],
            Wanted::Law(law) => law.travel(),
        }
    }

    /// The travels of input and output of all rows, or at equal steps of the input.
    pub fn samples(&self) -> Vec<[f64; 2]> {
        match &self.wanted {
            Wanted::Rows(rows) => rows.clone(),
            Wanted::Law(law) => {
                let travels = (0..=FITTED_PARTS).map(|k| law.travel() * k as f64 / FITTED_PARTS as f64);
                travels.map(|travel| [travel, law.wanted(travel)]).collect()
            }
        }
    }

    /// Precision points: of a law in Chebyshev's spacing, of rows those nearest to it, or all if there are as many.
    pub fn precision_points(&self, count: usize) -> Vec<[f64; 2]> {
        match &self.wanted {
            Wanted::Law(law) => {
                law.chebyshev_travels(count).into_iter().map(|travel| [travel, law.wanted(travel)]).collect()
            }
            Wanted::Rows(rows) => rows[..rows.len().min(count)].to_vec(),
        }
    }
}
