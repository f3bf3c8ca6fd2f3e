//! Paths in JSON.

use coupler_curves::geometry::Point;
use serde_json::Value;

use crate::outline::{Outline, ReadOptions, Reading, limited};

/// Reads JSON: a list of points, or an object with one as `points`, and perhaps `closed`. A point is a list of x and y and perhaps an
/// angle, or an object with `x`, `y` and perhaps `angle`. Also read are what `find --json` and `export --format json` print, and an object
/// with lists of numbers as `x`, `y` and perhaps `angle`.
///
/// # Errors
/// Every point that cannot be read.
pub(crate) fn parse_json(text: &str, options: &ReadOptions) -> Result<Outline, Vec<String>> {
    if let Some(outline) = options.outline {
        return Err(vec![format!(
            "{}{outline}: JSON has only one path; a drawing or a table may have several",
            options.outline_option
        )]);
    }
    let value: Value = serde_json::from_str(text).map_err(|error| vec![format!("the JSON cannot be read: {error}")])?;
    let object = value.get("target").unwrap_or(&value);
    let lists = lists(object);
    let list = lists.as_ref().or(object.get("points")).unwrap_or(object);
    let Some(list) = list.as_array() else {
        let example = "write [[x, y], …] or {\"points\": [[x, y], …]}";
        return Err(vec![format!("the JSON has no list of points: {example}")]);
    };
    let columns = Columns::of(object)?;
    let mut problems = Vec::new();
    let closed = object.get("closed").or(exported_closed(object));
    if let Some(value) = closed.filter(|value| !value.is_boolean()) {
        problems.push(format!("`closed` of the JSON is {value}: write true or false"));
    }
    let coordinate = |value: Option<&Value>| value.and_then(Value::as_f64).filter(|value| value.is_finite());
    let angles = object.get("angles_deg").and_then(Value::as_array).filter(|angles| angles.len() == list.len());
    let angle_of = |(k, value): (usize, &Value)| match angles {
        Some(angles) => angles.get(k).cloned(),
        None if value.is_array() => columns.angle.and_then(|column| value.get(column)).cloned(),
        None => value.get("angle").cloned(),
    };
    let is_timed = list.iter().enumerate().any(|value| angle_of(value).is_some());
    let has_angles = options.is_timed && is_timed;
    let (mut points, mut angles_deg) = (Vec::new(), Vec::new());
    for (k, value) in list.iter().enumerate() {
        let number = k + 1;
        let [x, y] = match value {
            Value::Array(_) => [value.get(columns.x), value.get(columns.y)],
            _ => [value.get("x"), value.get("y")],
        };
        match [x, y].map(coordinate) {
            [Some(x), Some(y)] => points.push(Point::new(x, y)),
            _ => {
                problems.push(format!("point {number} of the JSON is {value}: write [x, y] or {{\"x\": …, \"y\": …}}"));
                continue;
            }
        }
        match coordinate(angle_of((k, value)).as_ref()).filter(|_| has_angles) {
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
    let angles_deg = has_angles.then_some(angles_deg);
    let mut outline = Outline::new(points, angles_deg, closed.and_then(Value::as_bool));
    let angle =
        if has_angles { format!(", and angles of the {}, in degrees", options.angles_of) } else { String::new() };
    let taken = format!("the points of JSON, x and y{angle}");
    outline.reading = Reading { taken, has_unused_angles: is_timed && !options.is_timed };
    Ok(outline)
}

/// Where the numbers of a point that is a list are.
struct Columns {
    x: usize,
    y: usize,
    angle: Option<usize>,
}

impl Columns {
    /// Those that the object names, as an exported curve does.
    ///
    /// # Errors
    /// It names columns without coordinates.
    fn of(object: &Value) -> Result<Columns, Vec<String>> {
        let Some(names) = object.get("columns").and_then(Value::as_array) else {
            return Ok(Columns { x: 0, y: 1, angle: Some(2) });
        };
        let column = |name: &str| names.iter().position(|own| own == name);
        match [column("x"), column("y")] {
            [Some(x), Some(y)] => Ok(Columns { x, y, angle: column("input_deg").or(column("angle")) }),
            _ => Err(vec!["`columns` of the JSON has no x and y".to_owned()]),
        }
    }
}

/// Points from lists of their coordinates, as `x`, `y` and perhaps `angle`.
fn lists(object: &Value) -> Option<Value> {
    let [x, y, angle] = ["x", "y", "angle"].map(|name| object.get(name).and_then(Value::as_array));
    let (x, y) = x.zip(y)?;
    let value = |list: &[Value], k: usize| list.get(k).cloned().unwrap_or(Value::Null);
    let point = |k: usize| {
        let mut point = vec![value(x, k), value(y, k)];
        point.extend(angle.map(|angle| value(angle, k)));
        Value::from(point)
    };
    Some((0..x.len().max(y.len())).map(point).collect())
}

/// Whether the circuit of an exported curve is closed.
fn exported_closed(object: &Value) -> Option<&Value> {
    let circuit = object.get("circuit")?.as_u64()?.checked_sub(1)?;
    object.get("circuits")?.get(circuit as usize)?.get("closed")
}
