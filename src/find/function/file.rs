//! The function in a file.

use coupler_find::{FunctionTarget, FunctionTargetError};

use coupler_paths::{FunctionRows, parse_function};

/// A function that has been read, and its first row, in degrees or as a length.
pub type ReadFunction = (FunctionTarget, Option<[f64; 2]>);

/// Reads a function: a table with the columns `input` and `output`. `is_length` says whether the output is a length where the table does not.
///
/// # Errors
/// Every problem, with its line where it has one.
pub fn read_function(bytes: &[u8], is_length: bool) -> Result<ReadFunction, Vec<String>> {
    let FunctionRows { rows, lines, is_length: own } = parse_function(bytes)?;
    let target = FunctionTarget::rows(&rows, own.unwrap_or(is_length)).map_err(|problems| {
        let with_line = |problem: &FunctionTargetError| {
            let line = problem.row().and_then(|row| lines.get(row - 1));
            line.map_or(problem.to_string(), |line| format!("line {line}: {problem}"))
        };
        problems.iter().map(with_line).collect::<Vec<_>>()
    })?;
    Ok((target, rows.first().copied()))
}
