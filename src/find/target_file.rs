//! Paths in files: tables, JSON, and drawings.

use coupler_curves::geometry::Point;
use serde_json::Value;

use super::outline::{Outline, limited};
use super::point_table::parse_table;
use super::svg_outlines;

/// The most points of a path: the time of a search grows with them.
pub const MAX_POINTS: usize = 5000;

/// Reads the path in a text: a drawing in SVG, JSON, or a table of points; and the angles of its points if it is timed.
///
/// # Errors
/// Every problem, with its line in a table.
pub fn parse_outline(text: &str, is_timed: bool) -> Result<Outline, Vec<String>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let outline = match text.trim_start().chars().next() {
        Some('<') => svg_outlines::longest_outline(text).map_err(|problem| vec![problem])?,
        Some('{' | '[') => parse_json(text, is_timed)?,
        _ => parse_table(text, is_timed)?,
    };
    match outline.points.len() {
        count if count > MAX_POINTS => {
            Err(vec![format!("it has {count} points, and at most {MAX_POINTS} can be searched for: leave some out")])
        }
        _ => Ok(outline),
    }
}

/// Reads JSON: a list of points, or an object with one as `points`, and perhaps `closed`. A point is a list of x and y and perhaps an
/// angle, or an object with `x`, `y` and perhaps `angle`.
fn parse_json(text: &str, is_timed: bool) -> Result<Outline, Vec<String>> {
    let value: Value = serde_json::from_str(text).map_err(|error| vec![format!("the JSON cannot be read: {error}")])?;
    // What `find --json` and `export --format json` print can be read as well.
    let object = value.get("target").unwrap_or(&value);
    let list = object.get("points").unwrap_or(object);
    let Some(list) = list.as_array() else {
        let example = "write [[x, y], …] or {\"points\": [[x, y], …]}";
        return Err(vec![format!("the JSON has no list of points: {example}")]);
    };
    let mut problems = Vec::new();
    let closed = object.get("closed");
    if let Some(value) = closed.filter(|value| !value.is_boolean()) {
        problems.push(format!("`closed` of the JSON is {value}: write true or false"));
    }
    let coordinate = |value: Option<&Value>| value.and_then(Value::as_f64).filter(|value| value.is_finite());
    let angle_of = |value: &'_ Value| if value.is_array() { value.get(2) } else { value.get("angle") }.cloned();
    let has_angles = is_timed && list.iter().any(|value| angle_of(value).is_some());
    let (mut points, mut angles_deg) = (Vec::new(), Vec::new());
    for (number, value) in (1..).zip(list) {
        let [x, y] = match value {
            Value::Array(_) => [value.get(0), value.get(1)],
            _ => [value.get("x"), value.get("y")],
        };
        match [x, y].map(coordinate) {
            [Some(x), Some(y)] => points.push(Point::new(x, y)),
            _ => {
                problems.push(format!("point {number} of the JSON is {value}: write [x, y] or {{\"x\": …, \"y\": …}}"));
                continue;
            }
        }
        match coordinate(angle_of(value).as_ref()) {
            Some(angle) => angles_deg.push(angle),
            None if has_angles => {
                let example = "write [x, y, angle] or {\"x\": …, \"y\": …, \"angle\": …}";
                problems.push(format!("point {number} of the JSON is {value}, without an angle: {example}"));
            }
            None => {}
        }
    }
    if !problems.is_empty() {
        return Err(limited(problems, "points"));
    }
    let is_closed = closed.and_then(Value::as_bool);
    Ok(Outline { points, angles_deg: has_angles.then_some(angles_deg), is_closed })
}

#[cfg(test)]
mod tests {
    use super::super::outline::MAX_PROBLEMS;
    use super::*;
    use coupler_curves::geometry::trig;

    fn points(text: &str) -> Vec<[f64; 2]> {
        parse_outline(text, false).unwrap().points.iter().map(|p| [p.x, p.y]).collect()
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
    fn angles_are_read_where_they_are_asked_for() {
        let angles = |text: &str| parse_outline(text, true).map(|outline| outline.angles_deg);
        for text in [
            "1,2,30\n3,4,-45.5",
            "angle;y;x\n30;2;1\n-45,5;4;3",
            "[[1, 2, 30], [3, 4, -45.5]]",
            "[{\"x\": 1, \"y\": 2, \"angle\": 30}, [3, 4, -45.5]]",
        ] {
            assert_eq!(angles(text), Ok(Some(vec![30.0, -45.5])), "{text}");
            assert_eq!(parse_outline(text, false).unwrap().angles_deg, None);
        }
        assert_eq!(angles("1,2\n3,4"), Ok(None));
        assert_eq!(angles("[[1, 2], [3, 4]]"), Ok(None));
        let problems = |text: &str| angles(text).unwrap_err();
        assert_eq!(problems("1,2,30\n3,4"), ["line 2: `3,4` has no angle, as the others have"]);
        assert_eq!(problems("1,2,30\n3,4,x"), ["line 2: `x` is not a number"]);
        assert!(problems("[[1, 2, 30], [3, 4]]")[0].starts_with("point 2 of the JSON is [3,4], without an angle"));
    }

    #[test]
    fn every_line_that_cannot_be_read_is_named() {
        let problems = |text: &str| parse_outline(text, false).unwrap_err();
        assert_eq!(
            problems("1,2\nabc,3\n4\n5,NaN\n"),
            [
                "line 2: `abc` is not a number",
                "line 3: `4` has no two coordinates: write them like 1.5, 2",
                "line 4: `NaN` is NaN: a coordinate must be finite",
            ]
        );
        assert_eq!(
            problems("a,b\n1,2"),
            ["line 1: no columns `x` and `y` among a, b: name them so, as in x,y or X [mm],Y [mm]"]
        );
        assert_eq!(problems(&"x\n".repeat(50)).len(), 1);
        assert_eq!(problems(&format!("1,2\n{}", "z,1\n".repeat(50))).len(), MAX_PROBLEMS + 1);
        for json in ["{", "{}", "[1]", "[[1, \"2\"]]", "{\"points\": 3}", "[[1, 1e999]]"] {
            assert_eq!(problems(json).len(), 1, "{json}");
        }
        assert_eq!(problems("{\"points\": [[0, 0], [\"a\", 1], [null, 3]], \"closed\": 3}").len(), 3);
        let many = "1,2\n".repeat(MAX_POINTS + 1);
        assert!(problems(&many)[0].contains(&MAX_POINTS.to_string()));
    }

    #[test]
    fn a_path_is_closed_if_its_ends_are_near() {
        let outline = |count: usize| {
            let angle = |k: usize| std::f64::consts::TAU * k as f64 / 20.0;
            let point = |k| Point::new(trig::cos(angle(k)), trig::sin(angle(k)));
            Outline { points: (0..count).map(point).collect(), angles_deg: None, is_closed: None }
        };
        assert!(outline(20).looks_closed() && outline(21).looks_closed());
        assert!(!outline(18).looks_closed());
        assert!(!Outline { points: Vec::new(), angles_deg: None, is_closed: None }.looks_closed());
    }
}
