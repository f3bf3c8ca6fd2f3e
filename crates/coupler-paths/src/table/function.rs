//! Functions in tables: an input and an output on each line.

use super::dialect::{Dialect, detect};
use super::line::{Line, cells};
use super::name::{ColumnName, degrees_in};
use super::number::parse_number;
use crate::outline::limited;

/// The rows of a function in a table.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionRows {
    /// Inputs in degrees, and outputs in degrees or as lengths.
    pub rows: Vec<[f64; 2]>,
    /// The number of the line of each row.
    pub lines: Vec<usize>,
    /// Whether the output is a length, where its unit says so or says that it is an angle.
    pub is_length: Option<bool>,
}

/// Where the input and the output are, and in what units.
struct Columns {
    places: [usize; 2],
    /// The degrees in a unit of each, 1 for a length.
    factors: [f64; 2],
    is_length: Option<bool>,
}

/// Reads the lines of a table with the columns `input` and `output`, or with two columns and no names.
///
/// # Errors
/// Every line that cannot be read, or that the columns are others.
pub(super) fn function_rows(lines: &[Line], declared: Option<char>) -> Result<FunctionRows, Vec<String>> {
    let dialect = detect(lines, declared);
    let mut columns = Columns { places: [0, 1], factors: [1.0; 2], is_length: None };
    let mut found = FunctionRows { rows: Vec::new(), lines: Vec::new(), is_length: None };
    let mut problems = Vec::new();
    let mut has_names = false;
    for line in lines.iter().filter(|line| !line.is_comment) {
        let cells = cells(line.text, dialect.divider);
        let is_names =
            cells.iter().all(|cell| ColumnName::is_name(cell) && parse_number(cell, dialect.style).is_none());
        if is_names && found.rows.is_empty() && !has_names {
            columns = named(&cells).map_err(|problem| vec![format!("line {}: {problem}", line.number)])?;
            has_names = true;
            continue;
        }
        match row(&cells, &columns, has_names, dialect) {
            Ok(row) => {
                found.rows.push(row);
                found.lines.push(line.number);
            }
            Err(problem) => problems.push(format!("line {}: {problem}", line.number)),
        }
    }
    found.is_length = columns.is_length;
    if problems.is_empty() { Ok(found) } else { Err(limited(problems, "lines")) }
}

fn named(cells: &[String]) -> Result<Columns, String> {
    let names: Vec<ColumnName> = cells.iter().map(|cell| ColumnName::new(cell)).collect();
    let all = cells.join(", ");
    let column = |word: &str| {
        let places: Vec<usize> = (0..names.len()).filter(|k| names[*k].is(word)).collect();
        match places[..] {
            [place] => Ok(place),
            [] => {
                let is_path = ['x', 'y'].iter().all(|c| names.iter().any(|name| name.coordinate_rank(*c).is_some()));
                let path = if is_path { "; a table of points is searched for without --function" } else { "" };
                Err(format!("no column `{word}` among {all}: name the columns input,output{path}"))
            }
            [..] => Err(format!("there are {} columns `{word}` among {all}: leave one out", places.len())),
        }
    };
    let places = [column("input")?, column("output")?];
    let unit = |k: usize| names[places[k]].unit.as_deref();
    let input = degrees_in(unit(0))?;
    let output = degrees_in(unit(1)).ok();
    let is_length = unit(1).map(|_| output.is_none());
    Ok(Columns { places, factors: [input, output.unwrap_or(1.0)], is_length })
}

fn row(cells: &[String], columns: &Columns, has_names: bool, dialect: Dialect) -> Result<[f64; 2], String> {
    if !has_names && cells.len() > 2 {
        return Err(format!(
            "it has {} columns: name those of the function in a first line, input,output",
            cells.len()
        ));
    }
    let mut row = [0.0; 2];
    for k in 0..2 {
        let name = ["input", "output"][k];
        let cell = cells.get(columns.places[k]).filter(|cell| !cell.is_empty());
        let Some(cell) = cell else { return Err(format!("the {name} is missing")) };
        let value = parse_number(cell, dialect.style).ok_or_else(|| format!("`{cell}` is not a number"))?;
        row[k] = columns.factors[k] * value;
    }
    Ok(row)
}
