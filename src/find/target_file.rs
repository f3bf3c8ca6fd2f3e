//! Paths in files: tables, JSON, and drawings.

use coupler_curves::geometry::Point;
use serde_json::Value;

use super::svg_outlines;

/// The most points of a path: the time of a search grows with them.
pub const MAX_POINTS: usize = 5000;

/// The most problems of a file that are listed.
const MAX_PROBLEMS: usize = 20;

/// A path.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its points, with y pointing up.
    pub points: Vec<Point>,
    /// Whether it is closed, where the file says so.
    pub is_closed: Option<bool>,
}

impl Outline {
    /// Whether the gap from its last point to its first is at most one and a half times the median distance of neighbours.
    pub fn looks_closed(&self) -> bool {
        const GAP: f64 = 1.5;
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else { return false };
        let mut steps: Vec<f64> = self.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        steps.sort_by(f64::total_cmp);
        let median = match steps.len() {
            0 => 0.0,
            count if count % 2 == 1 => steps[count / 2],
            count => 0.5 * (steps[count / 2 - 1] + steps[count / 2]),
        };
        (last - first).norm() <= GAP * median
    }
}

/// Reads the path in a text: a drawing in SVG, JSON, or a table of points.
///
/// # Errors
/// Every problem, with its line in a table.
pub fn parse_outline(text: &str) -> Result<Outline, Vec<String>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let outline = match text.trim_start().chars().next() {
        Some('<') => svg_outlines::longest_outline(text).map_err(|problem| vec![problem])?,
        Some('{' | '[') => parse_json(text).map_err(|problem| vec![problem])?,
        _ => Outline { points: parse_table(text)?, is_closed: None },
    };
    match outline.points.len() {
        count if count > MAX_POINTS => {
            Err(vec![format!("it has {count} points, and at most {MAX_POINTS} can be searched for: leave some out")])
        }
        _ => Ok(outline),
    }
}

/// Reads a table: a point on each line, x and y, divided by commas, semicolons or blanks; empty lines and what follows `#` are
/// skipped. A first line of names says which columns are x and y.
fn parse_table(text: &str) -> Result<Vec<Point>, Vec<String>> {
    let mut points = Vec::new();
    let mut problems = Vec::new();
    let mut columns: Option<[usize; 2]> = None;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        let fields = fields_of(line);
        let is_name = |field: &String| field.parse::<f64>().is_err() && field.starts_with(char::is_alphabetic);
        if columns.is_none() && fields.iter().all(is_name) {
            columns = name_columns(&fields);
            if columns.is_none() {
                problems.push(format!("line {number}: no columns `x` and `y` among {}", fields.join(", ")));
                return Err(problems);
            }
            continue;
        }
        let [x, y] = *columns.get_or_insert([0, 1]);
        match [x, y].map(|column| fields.get(column)) {
            [Some(x), Some(y)] => match [x, y].map(|field| parse_coordinate(field)) {
                [Ok(x), Ok(y)] => points.push(Point::new(x, y)),
                coordinates => {
                    let errors = coordinates.into_iter().filter_map(Result::err);
                    problems.extend(errors.map(|error| format!("line {number}: {error}")));
                }
            },
            _ => problems.push(format!("line {number}: `{line}` has no two coordinates: write them like 1.5, 2")),
        }
    }
    if problems.len() > MAX_PROBLEMS {
        let more = problems.len() - MAX_PROBLEMS;
        problems.truncate(MAX_PROBLEMS);
        problems.push(format!("and {more} further lines that cannot be read"));
    }
    if problems.is_empty() { Ok(points) } else { Err(problems) }
}

/// The fields of a line. Where semicolons divide them, commas are decimal.
fn fields_of(line: &str) -> Vec<String> {
    let (line, divider) = match line.contains(';') {
        true => (line.replace(',', "."), ';'),
        false => (line.to_owned(), ','),
    };
    let fields: Vec<String> = match line.contains(divider) {
        true => line.split(divider).map(|field| field.trim().to_owned()).collect(),
        false => line.split_whitespace().map(str::to_owned).collect(),
    };
    // A divider at the end of the line.
    match fields.split_last() {
        Some((last, rest)) if last.is_empty() && rest.len() > 1 => rest.to_vec(),
        _ => fields,
    }
}

/// The columns of x and y by their names.
fn name_columns(fields: &[String]) -> Option<[usize; 2]> {
    let column = |name: &str| fields.iter().position(|field| field.trim_matches('"').eq_ignore_ascii_case(name));
    Some([column("x")?, column("y")?])
}

fn parse_coordinate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) => Err(format!("`{text}` is {value}: a coordinate must be finite")),
        Err(_) => Err(format!("`{text}` is not a number")),
    }
}

/// Reads JSON: a list of points, or an object with one as `points`, and perhaps `closed`. A point is a list of x and y, or an object
/// with `x` and `y`.
fn parse_json(text: &str) -> Result<Outline, String> {
    let value: Value = serde_json::from_str(text).map_err(|error| format!("the JSON cannot be read: {error}"))?;
    // What `find --json` and `export --format json` print can be read as well.
    let object = value.get("target").unwrap_or(&value);
    let list = object.get("points").unwrap_or(object);
    let list =
        list.as_array().ok_or("the JSON has no list of points: write [[x, y], …] or {\"points\": [[x, y], …]}")?;
    let is_closed = object.get("closed").and_then(Value::as_bool);
    let coordinate = |value: Option<&Value>| value.and_then(Value::as_f64).filter(|value| value.is_finite());
    let point = |(number, value): (usize, &Value)| {
        let [x, y] = match value {
            Value::Array(_) => [value.get(0), value.get(1)],
            _ => [value.get("x"), value.get("y")],
        };
        match [x, y].map(coordinate) {
            [Some(x), Some(y)] => Ok(Point::new(x, y)),
            _ => Err(format!("point {number} of the JSON is {value}: write [x, y] or {{\"x\": …, \"y\": …}}")),
        }
    };
    Ok(Outline { points: (1..).zip(list).map(point).collect::<Result<_, String>>()?, is_closed })
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::trig;

    fn points(text: &str) -> Vec<[f64; 2]> {
        parse_outline(text).unwrap().points.iter().map(|p| [p.x, p.y]).collect()
    }

    #[test]
    fn tables_and_json_have_the_same_points() {
        let expected = [[1.5, 2.0], [-3.0, 4e-1]];
        for text in [
            "1.5,2\n-3,4e-1\n",
            "# a sketch\n\n  1.5 , 2 # first\r\n-3, 0.4,\r\n",
            "1,5; 2\n-3;0,4",
            "1.5 2 30\n-3\t.4 60",
            "\u{feff}x,y,angle\n1.5,2,0\n-3,0.4,90",
            "cell,y,x\n1,2,1.5\n2,0.4,-3",
            "[[1.5, 2], [-3, 0.4]]",
            " {\"points\": [{\"x\": 1.5, \"y\": 2}, {\"y\": 0.4, \"x\": -3}], \"closed\": true}",
            "{\"target\": {\"points\": [[1.5, 2], [-3, 0.4]]}, \"results\": []}",
        ] {
            assert_eq!(points(text), expected, "{text}");
        }
    }

    #[test]
    fn every_line_that_cannot_be_read_is_named() {
        let problems = |text: &str| parse_outline(text).unwrap_err();
        assert_eq!(
            problems("1,2\nabc,3\n4\n5,NaN\n"),
            [
                "line 2: `abc` is not a number",
                "line 3: `4` has no two coordinates: write them like 1.5, 2",
                "line 4: `NaN` is NaN: a coordinate must be finite",
            ]
        );
        assert_eq!(problems("a,b\n1,2"), ["line 1: no columns `x` and `y` among a, b"]);
        assert_eq!(problems(&"x\n".repeat(50)).len(), 1);
        assert_eq!(problems(&format!("1,2\n{}", "z,1\n".repeat(50))).len(), MAX_PROBLEMS + 1);
        for json in ["{", "{}", "[1, 2]", "[[1, \"2\"]]", "{\"points\": 3}", "[[1, 1e999]]"] {
            assert_eq!(problems(json).len(), 1, "{json}");
        }
        let many = "1,2\n".repeat(MAX_POINTS + 1);
        assert!(problems(&many)[0].contains(&MAX_POINTS.to_string()));
    }

    #[test]
    fn a_path_is_closed_if_its_ends_are_near() {
        let outline = |count: usize| {
            let angle = |k: usize| std::f64::consts::TAU * k as f64 / 20.0;
            let point = |k| Point::new(trig::cos(angle(k)), trig::sin(angle(k)));
            Outline { points: (0..count).map(point).collect(), is_closed: None }
        };
        assert!(outline(20).looks_closed() && outline(21).looks_closed());
        assert!(!outline(18).looks_closed());
        assert!(!Outline { points: Vec::new(), is_closed: None }.looks_closed());
    }
}
