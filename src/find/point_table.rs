//! Paths in tables: a point on each line.

use coupler_curves::geometry::Point;
use csv::{ReaderBuilder, StringRecord, Trim};

use super::outline::{Outline, limited};

/// The columns of a table.
#[derive(Clone, Copy)]
struct Columns {
    x: usize,
    y: usize,
    angle: Option<usize>,
}

/// Reads a table: a point on each line, x and y and perhaps an angle, divided by commas, semicolons, tabs or blanks, in quotes or
/// without; empty lines and what follows `#` are skipped. A first line of names, perhaps with units, says which columns are x, y and
/// angle. A comma that divides no fields is decimal.
///
/// # Errors
/// Every line that cannot be read.
pub(super) fn parse_table(text: &str, is_timed: bool) -> Result<Outline, Vec<String>> {
    let mut points = Vec::new();
    let mut angles_deg = Vec::new();
    let mut problems = Vec::new();
    let mut columns: Option<Columns> = None;
    let has_tabs = lines(text).all(|(_, line)| line.contains('\t'));
    let is_with_point = |field: &String| field.contains('.') && field.parse::<f64>().is_ok();
    let has_points = lines(text).any(|(_, line)| fields_of(line, has_tabs).iter().any(is_with_point));
    // With columns without names there are a point and an angle.
    let mut most_fields = 3;
    for (number, line) in lines(text) {
        let fields = fields_of(line, has_tabs);
        // A column without a name may be one of numbers of lines.
        let is_name = |field: &String| {
            field.is_empty() || field.parse::<f64>().is_err() && field.starts_with(char::is_alphabetic)
        };
        if columns.is_none() && fields.iter().all(is_name) {
            columns = name_columns(&fields);
            if columns.is_none() {
                let names = fields.join(", ");
                problems.push(format!(
                    "line {number}: no columns `x` and `y` among {names}: name them so, as in x,y or X [mm],Y [mm]"
                ));
                return Err(problems);
            }
            most_fields = fields.len();
            continue;
        }
        if fields.len() > most_fields {
            let hint = match line.contains(',') && !line.contains(';') && !has_tabs {
                true => ": write decimals with a point, or divide fields by semicolons",
                false => "",
            };
            problems.push(format!("line {number}: `{line}` has {} fields, and not {most_fields}{hint}", fields.len()));
            continue;
        }
        if let Some(field) = fields.iter().find(|field| has_points && field.contains(',')) {
            problems.push(format!(
                "line {number}: `{field}` has a comma where other numbers have a decimal point: write it with a point, or without the comma"
            ));
            continue;
        }
        let angle = (fields.len() > 2).then_some(2);
        let Columns { x, y, angle } = *columns.get_or_insert(Columns { x: 0, y: 1, angle });
        if let Some(column) = angle.filter(|_| is_timed) {
            match fields.get(column).map(|field| parse_number(field, "an angle")) {
                Some(Ok(angle)) => angles_deg.push(angle),
                Some(Err(error)) => problems.push(format!("line {number}: {error}")),
                None => problems.push(format!("line {number}: `{line}` has no angle, as the others have")),
            }
        }
        match [x, y].map(|column| fields.get(column)) {
            [Some(x), Some(y)] => match [x, y].map(|field| parse_number(field, "a coordinate")) {
                [Ok(x), Ok(y)] => points.push(Point::new(x, y)),
                coordinates => {
                    let errors = coordinates.into_iter().filter_map(Result::err);
                    problems.extend(errors.map(|error| format!("line {number}: {error}")));
                }
            },
            _ => problems.push(format!("line {number}: `{line}` has no two coordinates: write them like 1.5, 2")),
        }
    }
    if !problems.is_empty() {
        return Err(limited(problems, "lines"));
    }
    let angles_deg = (!angles_deg.is_empty()).then_some(angles_deg);
    Ok(Outline { points, angles_deg, is_closed: None })
}

/// The lines that are not empty with their numbers, without white space at their ends and what follows `#`.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..)
        .zip(text.lines())
        .map(|(number, line)| (number, line.split('#').next().unwrap_or_default().trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// The fields of a line, without quotes; `has_tabs` says that tabs divide those of all lines that have no semicolon.
fn fields_of(line: &str, has_tabs: bool) -> Vec<String> {
    let divider = match line {
        line if line.contains(';') => b';',
        _ if has_tabs => b'\t',
        line if line.contains(',') => b',',
        _ => return line.split_whitespace().map(|field| unquoted(field).to_owned()).collect(),
    };
    let mut reader = ReaderBuilder::new();
    reader.delimiter(divider).has_headers(false).flexible(true).trim(Trim::All).buffer_capacity(line.len() + 1);
    let mut record = StringRecord::new();
    // A line of text can always be read.
    let _ = reader.from_reader(line.as_bytes()).read_record(&mut record);
    let fields: Vec<String> = record.iter().map(|field| unquoted(field).to_owned()).collect();
    // A divider at the end of the line.
    match fields.split_last() {
        Some((last, rest)) if last.is_empty() && rest.len() > 1 => rest.to_vec(),
        _ => fields,
    }
}

/// A field without the quotes that a blank before them, or a divider that is none, has left.
fn unquoted(field: &str) -> &str {
    field.trim_matches('"').trim()
}

/// The columns of x, y and the angle by their names, in capital letters or not, and with a unit in brackets or without.
fn name_columns(fields: &[String]) -> Option<Columns> {
    let bare = |field: &String| field.split(['[', '(']).next().unwrap_or_default().trim().to_ascii_lowercase();
    let names: Vec<String> = fields.iter().map(bare).collect();
    let column = |name: &str| names.iter().position(|own| own == name);
    Some(Columns { x: column("x")?, y: column("y")?, angle: column("angle") })
}

/// Reads a number; a comma in it is decimal.
fn parse_number(text: &str, what: &str) -> Result<f64, String> {
    match text.replacen(',', ".", 1).parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) => Err(format!("`{text}` is {value}: {what} must be finite")),
        Err(_) => Err(format!("`{text}` is not a number")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Vec<[f64; 2]> {
        let outline = parse_table(text, false).unwrap_or_else(|problems| panic!("{text}: {problems:?}"));
        outline.points.iter().map(|p| [p.x, p.y]).collect()
    }

    #[test]
    fn columns_may_have_units_capitals_and_quotes() {
        for head in
            ["X,Y", "X [mm],Y [mm]", "\"x\",\"y\"", "x (mm);y (mm)", "\"X [mm]\"\t\"Y [mm]\"", "\"X\"; \"Y (mm)\";"]
        {
            let divider = head.chars().find(|c| matches!(c, ',' | ';' | '\t')).unwrap();
            let text = format!("{head}\n1.5{divider}2\n-3{divider}4\n");
            assert_eq!(points(&text), [[1.5, 2.0], [-3.0, 4.0]], "{head}");
        }
        assert_eq!(points(",t [s],Y,X\n0,0.1,2,1.5\n1,0.2,4,-3\n"), [[1.5, 2.0], [-3.0, 4.0]]);
        let timed = parse_table("Angle [deg],x,y\n30,1,2\n60,3,4", true).unwrap();
        assert_eq!(timed.angles_deg, Some(vec![30.0, 60.0]));
    }

    #[test]
    fn quotes_and_decimal_commas_are_read() {
        for text in [
            "\"x\",\"y\"\n\"1.5\",\"2\"\n\"-3\",\"0.4\"",
            "\"1,5\";\"2\"\n\"-3\";\"0,4\"",
            "1,5;2\n-3;0,4",
            "x\ty\n1,5\t2\n-3\t0,4",
            "\"1,5\",\"2\"\n\"-3\",\"0,4\"",
            "\"1.5\" \"2\"\n-3 0.4",
            " \"1.5\" , \"2\" # first\r\n-3, 0.4\r\n",
        ] {
            assert_eq!(points(text), [[1.5, 2.0], [-3.0, 0.4]], "{text}");
        }
        let problems = parse_table("\"1\",\"1,234,5\"\n\"15,2", false).unwrap_err();
        let wrong =
            ["line 1: `1,234,5` is not a number", "line 2: `\"15,2` has no two coordinates: write them like 1.5, 2"];
        assert_eq!(problems, wrong);
    }

    #[test]
    fn commas_that_may_be_decimal_or_not_are_errors() {
        let problem = |text: &str| parse_table(text, false).unwrap_err().swap_remove(0);
        for text in ["x,y\n13,000,20,000\n", "# no names\n\n13,000,20,000\n"] {
            assert!(problem(text).ends_with("write decimals with a point, or divide fields by semicolons"), "{text}");
        }
        assert!(problem("1,130;20.000\n2;3").contains("`1,130` has a comma where other numbers have a decimal point"));
        assert_eq!(points("x;y\n1,130;20\n2;3"), [[1.13, 20.0], [2.0, 3.0]]);
    }
}
