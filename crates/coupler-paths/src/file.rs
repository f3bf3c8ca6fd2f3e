//! Paths in files: tables, JSON, and drawings.

use crate::outline::{Outline, ReadOptions};
use crate::table::FunctionRows;
use crate::{dxf, encoding, json, svg, table};

/// The most points of a path: the time of a search grows with them.
pub const MAX_POINTS: usize = 5000;

/// Reads the path in a file: a drawing in SVG or DXF, or a piece of SVG, as one copies it; JSON, or a table of points; and the angles of its points if it is timed. What was taken
/// is in [`Outline::reading`].
///
/// # Errors
/// Every problem, with its line where it has one.
pub fn parse_outline(bytes: &[u8], options: &ReadOptions) -> Result<Outline, Vec<String>> {
    let text = encoding::decode(bytes).map_err(|problem| vec![problem])?;
    let outline = match text.trim_start().chars().next() {
        Some('<') => svg::parse_svg(&text, options).map_err(|problem| vec![problem])?,
        Some('{' | '[') => json::parse_json(&text, options)?,
        _ if svg::is_path_data(&text) => svg::parse_path_data(&text, options).map_err(|problem| vec![problem])?,
        _ if dxf::is_dxf(&text) => dxf::parse_dxf(&text, options).map_err(|problem| vec![problem])?,
        _ => table::parse_table(&text, options)?,
    };
    match outline.points.len() {
        count if count > MAX_POINTS => {
            Err(vec![format!("it has {count} points, and at most {MAX_POINTS} can be searched for: leave some out")])
        }
        _ => Ok(outline),
    }
}

/// Reads the function in a file: a table with the columns `input` and `output`, whose rows are at most as many as the points of a path.
///
/// # Errors
/// Every problem, with its line where it has one.
pub fn parse_function(bytes: &[u8]) -> Result<FunctionRows, Vec<String>> {
    const FORM: &str = "a function is a table with the columns input,output";
    let text = encoding::decode(bytes).map_err(|_| vec![format!("it is no text: {FORM}")])?;
    let form = match text.trim_start().chars().next() {
        Some('<') => "SVG",
        Some('{' | '[') => "JSON",
        _ if dxf::is_dxf(&text) => "DXF",
        _ => return table::parse_function_table(&text),
    };
    Err(vec![format!("it is {form}: {FORM}")])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::MAX_PROBLEMS;

    fn parse(text: &str, is_timed: bool) -> Result<Outline, Vec<String>> {
        parse_outline(text.as_bytes(), &ReadOptions { is_timed, ..ReadOptions::default() })
    }

    fn points(text: &str) -> Vec<[f64; 2]> {
        let outline = parse(text, false).unwrap_or_else(|problems| panic!("{text}: {problems:?}"));
        outline.points.iter().map(|p| [p.x, p.y]).collect()
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
            "{\"columns\": [\"branch\", \"x\", \"y\"], \"points\": [[1, 1.5, 2], [-1, -3, 0.4]]}",
            "{\"x\": [1.5, -3], \"y\": [2, 0.4]}",
        ] {
            assert_eq!(points(text), expected, "{text}");
        }
    }

    #[test]
    fn angles_are_read_where_they_are_asked_for() {
        let angles = |text: &str| parse(text, true).map(|outline| outline.angles_deg);
        for text in [
            "1,2,30\n3,4,-45.5",
            "angle;y;x\n30;2;1\n-45,5;4;3",
            "[[1, 2, 30], [3, 4, -45.5]]",
            "[{\"x\": 1, \"y\": 2, \"angle\": 30}, [3, 4, -45.5]]",
            "{\"columns\": [\"input_deg\", \"x\", \"y\"], \"points\": [[30, 1, 2], [-45.5, 3, 4]]}",
        ] {
            assert_eq!(angles(text), Ok(Some(vec![30.0, -45.5])), "{text}");
            assert_eq!(parse(text, false).unwrap().angles_deg, None);
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
        let problems = |text: &str| parse(text, false).unwrap_err();
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
        assert!(problems(&"1,2\n".repeat(2_000_000))[0].contains("more than 100000 lines"));
    }
}
