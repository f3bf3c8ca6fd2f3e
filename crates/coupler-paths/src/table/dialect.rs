//! What divides the cells of a table, and how its numbers are written.

use super::line::{Divider, Line, cells};
use super::name::ColumnName;
use super::number::{NumberStyle, is_missing, parse_number};

/// The form of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dialect {
    pub divider: Divider,
    pub style: NumberStyle,
}

/// The lines in which the form of a table is looked for: others that differ are found when they are read.
const LINES: usize = 400;

/// The form in which most lines are numbers: of several that are alike, the first of semicolons, tabs, commas, vertical bars and blanks, and of decimal
/// points and commas. `declared` is the divider that the file names itself.
pub(super) fn detect(lines: &[Line], declared: Option<char>) -> Dialect {
    let sample: Vec<&str> = lines.iter().filter(|line| !line.is_comment).map(|line| line.text).take(LINES).collect();
    let dividers = match declared {
        Some(divider) => vec![Divider::Char(divider)],
        None => {
            let mut dividers: Vec<Divider> = [';', '\t', ',', '|'].map(Divider::Char).to_vec();
            dividers.extend([Divider::Blanks, Divider::AnyBlanks]);
            dividers
        }
    };
    // Without numbers the names tell what divides them.
    let names_coordinates = |divider: &&Divider| {
        let names: Vec<ColumnName> = sample
            .first()
            .map_or(Vec::new(), |line| cells(line, **divider).iter().map(|cell| ColumnName::new(cell)).collect());
        ['x', 'y'].iter().all(|letter| names.iter().any(|name| name.coordinate_rank(*letter).is_some()))
            && names.len() > 1
    };
    let divider = *dividers.iter().find(names_coordinates).unwrap_or(&dividers[0]);
    let mut best = (Dialect { divider, style: NumberStyle::POINT }, [0, 0, 0]);
    for divider in dividers {
        let rows: Vec<Vec<String>> = sample.iter().map(|line| cells(line, divider)).collect();
        for style in styles(&rows) {
            let score = score(&rows, style);
            if score > best.1 {
                best = (Dialect { divider, style }, score);
            }
        }
    }
    best.0
}

/// How many rows have nothing but numbers, how many have two of them, and how many cells are numbers.
fn score(rows: &[Vec<String>], style: NumberStyle) -> [usize; 3] {
    let mut score = [0, 0, 0];
    for row in rows {
        let numbers = row.iter().filter(|cell| parse_number(cell, style).is_some()).count();
        let others = row.iter().filter(|cell| !is_missing(cell)).count() - present(row, style);
        score[0] += usize::from(numbers >= 2 && others == 0);
        score[1] += usize::from(numbers >= 2);
        score[2] += numbers;
    }
    score
}

/// The number of the cells that are numbers and not missing.
fn present(row: &[String], style: NumberStyle) -> usize {
    row.iter().filter(|cell| !is_missing(cell) && parse_number(cell, style).is_some()).count()
}

/// The ways in which numbers may be written in some rows; groups of three digits are known by a cell with both separators or with several groups.
fn styles(rows: &[Vec<String>]) -> Vec<NumberStyle> {
    let mut styles = vec![NumberStyle::POINT, NumberStyle::COMMA];
    let is_number = |cell: &str, style| parse_number(cell, style).is_some();
    for (grouped, plain) in
        [(NumberStyle::GROUPED_POINT, NumberStyle::COMMA), (NumberStyle::GROUPED_COMMA, NumberStyle::POINT)]
    {
        let is_evidence =
            |cell: &String| is_number(cell, grouped) && !is_number(cell, plain) && cell.contains(plain.decimal);
        if rows.iter().flatten().any(is_evidence) {
            styles.push(grouped);
        }
    }
    styles
}

#[cfg(test)]
mod tests {
    use super::super::line::lines;
    use super::*;

    #[test]
    fn the_form_is_that_in_which_the_lines_are_numbers() {
        let (point, comma) = (NumberStyle::POINT, NumberStyle::COMMA);
        for (text, divider, style) in [
            ("1,2\n3,4", Divider::Char(','), point),
            ("1,5;2\n-3;0,4", Divider::Char(';'), comma),
            ("1,5 2,5\n3,5 200,5", Divider::Blanks, comma),
            ("1,500 200,500\n1,5 2,5", Divider::Blanks, comma),
            ("\"0,5863\", \"2,0236\"\n\"1\", \"2,5\"", Divider::Char(','), comma),
            ("0:00:00:00 1,5 2,5", Divider::Blanks, comma),
            ("x;y\n1.234,5;2\n1.000;3,5", Divider::Char(';'), NumberStyle::GROUPED_COMMA),
            ("\"1,234.5\",\"2,000.25\"", Divider::Char(','), NumberStyle::GROUPED_POINT),
            ("1.5\u{a0}2.5", Divider::AnyBlanks, point),
            ("1\t2,5", Divider::Char('\t'), comma),
            ("1, 2\n3, 4", Divider::Char(','), point),
        ] {
            let lines: Vec<Line> = lines(text).collect();
            assert_eq!(detect(&lines, None), Dialect { divider, style }, "{text}");
        }
    }
}
