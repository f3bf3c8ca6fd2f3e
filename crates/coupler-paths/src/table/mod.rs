//! Paths in tables: a point on each line.

mod block;
mod columns;
mod data_set;
mod dialect;
mod function;
mod line;
mod name;
mod number;

use crate::outline::{Outline, ReadOptions, choose, limited};
use block::{Blocks, Row};
use data_set::{DataSet, data_sets, not_a_number};
use dialect::{Dialect, detect};
pub use function::FunctionRows;
use function::function_rows;
use line::{Divider, Line, lines};
use name::ColumnName;

/// The most lines of a table.
const MAX_LINES: usize = 100_000;

/// The most bytes of a line.
const MAX_LINE: usize = 100_000;

/// The most commas, blanks and other dividers of all lines.
const MAX_DIVIDERS: usize = 2_000_000;

/// Reads a table: a point on each line, x and y and perhaps an angle, divided by semicolons, tabs, commas or blanks, in quotes or without;
/// comments are skipped. Lines of names, perhaps with units, say which columns are x, y and angle; without them there are two, or three with
/// the angle. The decimal separator is that with which the lines are numbers. Of several paths one must be chosen.
///
/// # Errors
/// Every line that cannot be read; or why the columns or the path are not known.
pub(crate) fn parse_table(text: &str, options: &ReadOptions) -> Result<Outline, Vec<String>> {
    let (lines, declared) = read_lines(text)?;
    let dialect = detect(&lines, declared);
    check_commas(&lines, dialect)?;
    let Blocks { blocks, others } = Blocks::of(&lines, dialect);
    if !others.is_empty() {
        return Err(unknown_lines(&others, dialect, blocks.iter().flat_map(|block| &block.rows)));
    }
    let sets: Vec<DataSet> = blocks.iter().flat_map(data_sets).collect();
    let ids: Vec<Option<&str>> = sets.iter().map(|set| set.id.as_deref()).collect();
    let index = match (options.outline, sets.len()) {
        (_, 0) => return Ok(Outline::new(Vec::new(), None, None)),
        (Some(chosen), _) => choose([options.outline_option, chosen], &ids, "path").map_err(|problem| vec![problem])?,
        (None, 1) => 0,
        (None, _) => return Err(vec![several(&sets, options)]),
    };
    let mut outline = sets[index].outline(dialect, options)?;
    if sets.len() > 1 {
        let id = ids[index].map_or(String::new(), |id| format!(" `{id}`"));
        let taken = &mut outline.reading.taken;
        *taken = format!("path {}{id} of {}; {taken}", index + 1, sets.len());
    }
    Ok(outline)
}

/// Reads a table of a function: an input and an output on each line, in columns of these names, or two without names.
///
/// # Errors
/// Every line that cannot be read; or why the columns are not known.
pub(crate) fn parse_function_table(text: &str) -> Result<FunctionRows, Vec<String>> {
    let (lines, declared) = read_lines(text)?;
    check_commas(&lines, detect(&lines, declared))?;
    function_rows(&lines, declared)
}

/// The lines of a table, and the divider that it names itself.
///
/// # Errors
/// It is too large.
fn read_lines(text: &str) -> Result<(Vec<Line<'_>>, Option<char>), Vec<String>> {
    let mut lines: Vec<Line> = lines(text).take(MAX_LINES + 1).collect();
    if lines.len() > MAX_LINES {
        return Err(vec![format!("it has more than {MAX_LINES} lines: leave some out")]);
    }
    if let Some(line) = lines.iter().find(|line| line.text.len() > MAX_LINE) {
        return Err(vec![format!(
            "line {}: it has more than {MAX_LINE} bytes: write a point on each line",
            line.number
        )]);
    }
    let dividers = |line: &Line| line.text.bytes().filter(|byte| b",;|\t ".contains(byte)).count();
    if lines.iter().map(dividers).sum::<usize>() > MAX_DIVIDERS {
        return Err(vec![format!("it has more than {MAX_DIVIDERS} fields and blanks: leave some out")]);
    }
    let declared = lines.first().and_then(|line| divider_line(line.text));
    if declared.is_some() {
        lines.remove(0);
    }
    Ok((lines, declared))
}

/// The divider that a first line `sep=;` names, as spreadsheets write it.
fn divider_line(text: &str) -> Option<char> {
    let named = text.trim_matches('"').to_ascii_lowercase();
    let mut divider = named.strip_prefix("sep=")?.chars();
    let first = divider.next().unwrap_or('\t');
    (divider.next().is_none() && !first.is_alphanumeric()).then_some(first)
}

/// Refuses numbers whose commas may be decimal or between groups of three digits: in quotes, and between tabs and blanks.
fn check_commas(lines: &[Line], dialect: Dialect) -> Result<(), Vec<String>> {
    if dialect.style != number::NumberStyle::COMMA || dialect.divider == Divider::Char(';') {
        return Ok(());
    }
    let is_group = |cell: &str| {
        let digits = cell.trim_start_matches(['-', '+', '\u{2212}']);
        let parts = digits.split_once(',');
        parts.is_some_and(|(whole, rest)| rest.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0'))
    };
    let mut example = None;
    for line in lines.iter().filter(|line| !line.is_comment) {
        for cell in line::cells(line.text, dialect.divider) {
            if !cell.contains(',') || number::parse_number(&cell, dialect.style).is_none() {
                continue;
            }
            if !is_group(&cell) {
                return Ok(());
            }
            example.get_or_insert((line.number, cell));
        }
    }
    let Some((number, cell)) = example else { return Ok(()) };
    let [decimal, whole] = [".", ""].map(|point| cell.replace(',', point));
    Err(vec![format!(
        "line {number}: `{cell}` may be {decimal} or {whole}: write numbers with a decimal point, or divide fields by semicolons"
    )])
}

/// What is wrong with lines that are neither names nor points.
fn unknown_lines<'r, 'a: 'r>(
    others: &[Row],
    dialect: Dialect,
    rows: impl Iterator<Item = &'r Row<'a>> + Clone,
) -> Vec<String> {
    let mut problems = Vec::new();
    for Row { line, cells } in others {
        let number = line.number;
        if cells.iter().all(|cell| ColumnName::is_name(cell)) {
            let names = cells.join(", ");
            return vec![format!(
                "line {number}: no columns `x` and `y` among {names}: name them so, as in x,y or X [mm],Y [mm]"
            )];
        }
        let wrong = cells.iter().find(|cell| number::parse_number(cell, dialect.style).is_none());
        problems.push(match wrong.filter(|_| cells.len() > 1) {
            Some(cell) => format!("line {number}: {}", not_a_number(cell, dialect, rows.clone())),
            None => format!("line {number}: `{}` has no two coordinates: write them like 1.5, 2", line.text),
        });
    }
    limited(problems, "lines")
}

/// What to do with several paths.
fn several(sets: &[DataSet], options: &ReadOptions) -> String {
    const SHOWN: usize = 8;
    let described = |(number, set): (usize, &DataSet)| {
        let [first, last] = set.lines();
        let id = set.id.as_ref().map_or(String::new(), |id| format!(" `{id}`"));
        format!("{number}{id} in lines {first} to {last}")
    };
    let shown: Vec<String> = (1..).zip(sets).take(SHOWN).map(described).collect();
    let more = if sets.len() > SHOWN { ", …" } else { "" };
    format!(
        "it has {} paths: {}{more}; choose one, as in {}1, or leave out blank lines within a path",
        sets.len(),
        shown.join(", "),
        options.outline_option
    )
}
