//! The data that a family's script passes to the page, compared with its tables and pages.

use std::collections::BTreeMap;
use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use coupler_atlas::record::read_drawn_curves;
use serde_json::Value;

use crate::support::folder::Atlas;
use crate::support::table::{Row, numbers, rows};

/// Panels that need two pages, a cell that is not assembled, a rocker, a coupler grid, and charts.
const MANIFEST: &str = r#"[atlas]
title = "</script><b>T</b> & \"quotes\""
output = "out"
[[family]]
id = "evans"
linkage = "evans"
title = "Evans' <i>linkage</i>"
panels = [2, 1]
sampling = { step = "1 deg" }
cases = [{ p = 2, a = 2.5 }, { p = 3, a = 4.0 }, { p = 9, a = 2 }]
[[family]]
id = "watt"
linkage = "watt"
sampling = { samples = 90 }
cases = [{ p = 8, a = 2.5, s = 4, r = 4 }]
[[family]]
id = "grid"
linkage = "hrones-nelson"
layout = "coupler-grid"
sampling = { samples = 72 }
grid = { A = [2.5], B = [2.5, 3], C = [2] }
[[family]]
id = "over"
linkage = "evans"
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4] }
let = { a = "(1 + p)^1.5 / 2" }
layout = "chart"
chart = { x = "p", y = ["length"] }
"#;

/// The statements of a family's script: the function each calls, and its argument, with the points that are in a comment.
fn statements(script: &str) -> Vec<(String, Value)> {
    let statement = |line: &str| {
        let call = line.strip_prefix("couplerAtlas.").unwrap().strip_suffix(");").unwrap();
        let (name, json) = call.split_once('(').unwrap();
        let (json, comment) = json.split_once(",()=>{/*").unwrap_or((json, ""));
        let mut value: Value = serde_json::from_str(json).unwrap();
        if let Some(points) = comment.strip_suffix("*/}") {
            value["points"] = points.into();
        }
        (name.to_owned(), value)
    };
    script.lines().map(statement).collect()
}

/// The bytes of the numbers of a column, or the number that all are equal to.
fn column<const N: usize, T: Clone>(column: &Value, count: usize, read: fn([u8; N]) -> T, all: T) -> Vec<T> {
    let Some(text) = column.as_str() else { return vec![all; count] };
    let numbers: Vec<T> =
        BASE64_STANDARD.decode(text).unwrap().chunks(N).map(|bytes| read(bytes.try_into().unwrap())).collect();
    assert_eq!(numbers.len(), count);
    numbers
}

fn f64s(packed: &Value, count: usize) -> Vec<f64> {
    let all = if packed.is_number() { packed.to_string().parse().unwrap() } else { f64::NAN };
    column(packed, count, f64::from_le_bytes, all)
}

fn all_equal(packed: &Value) -> usize {
    packed.as_u64().map_or(0, |number| number.try_into().unwrap())
}

fn u32s(packed: &Value, count: usize) -> Vec<usize> {
    column(packed, count, |bytes| u32::from_le_bytes(bytes) as usize, all_equal(packed))
}

fn u16s(packed: &Value, count: usize) -> Vec<usize> {
    column(packed, count, |bytes| usize::from(u16::from_le_bytes(bytes)), all_equal(packed))
}

fn u8s(packed: &Value, count: usize) -> Vec<usize> {
    column(packed, count, |[byte]: [u8; 1]| usize::from(byte), all_equal(packed))
}

/// The points of curves from their third differences, of each curve first all x, then all y.
fn points_of(packed: &Value, counts: &[usize]) -> Vec<[i64; 2]> {
    let mut bytes = BASE64_STANDARD.decode(packed.as_str().unwrap()).unwrap().into_iter();
    let mut points = Vec::new();
    for count in counts {
        let [x, y] = [0, 1].map(|_| {
            let mut values: Vec<i64> = Vec::new();
            for k in 0..*count {
                let (mut code, mut shift) = (0, 0);
                loop {
                    let byte = i64::from(bytes.next().unwrap());
                    code += (byte & 127) << shift;
                    shift += 7;
                    if byte < 128 {
                        break;
                    }
                }
                let before = |n: usize| if k == 0 { 0 } else { values[k.saturating_sub(n)] };
                let difference = if code % 2 == 0 { code / 2 } else { -(code + 1) / 2 };
                values.push(3 * (before(1) - before(2)) + before(3) + difference);
            }
            values
        });
        points.extend(x.into_iter().zip(y).map(|(x, y)| [x, y]));
    }
    assert_eq!(bytes.next(), None);
    points
}

fn count_of(number: &Value) -> usize {
    usize::try_from(number.as_u64().unwrap()).unwrap()
}

/// The cells and curves of a statement `cells`: their numbers, and for each curve the index of its cell.
struct Rows {
    numbers: Vec<usize>,
    owners: Vec<usize>,
    traces: Vec<usize>,
    circuits: Vec<usize>,
}

fn rows_of(chunk: &Value) -> Rows {
    let count = count_of(&chunk["count"]);
    // A number is the first of a run.
    let numbers = match chunk["number"].as_u64() {
        Some(first) => (0..count).map(|k| k + usize::try_from(first).unwrap()).collect(),
        None => u32s(&chunk["number"], count),
    };
    let each = u16s(&chunk["curves"], count);
    let owners: Vec<usize> = each.iter().enumerate().flat_map(|(k, curves)| vec![k; *curves]).collect();
    let [traces, circuits] = ["trace", "circuit"].map(|name| u16s(&chunk[name], owners.len()));
    Rows { numbers, owners, traces, circuits }
}

/// A text of the k-th cell of a statement `curves`, which has none if all are empty.
fn text<'v>(chunk: &'v Value, name: &str, k: usize) -> &'v str {
    chunk[name].get(k).map_or("", |text| text.as_str().unwrap())
}

/// A rendered family: the statements of its script, its rows of `cells.csv`, and the points of each curve.
struct Rendered {
    atlas: Atlas,
    id: &'static str,
    statements: Vec<(String, Value)>,
    cells: Vec<Row>,
    points: BTreeMap<[usize; 3], Vec<[f64; 2]>>,
}

fn rendered(id: &'static str) -> Rendered {
    let atlas = Atlas::rendered(MANIFEST, &["--only", id]);
    let read = |name: &str| atlas.read(&format!("{id}/{name}"));
    let mut points: BTreeMap<[usize; 3], Vec<[f64; 2]>> = BTreeMap::new();
    for row in rows(&read("points.csv")) {
        let key = ["cell", "trace", "circuit"].map(|name| row[name].parse().unwrap());
        points.entry(key).or_default().push(numbers(&row, ["x", "y"]));
    }
    Rendered { id, statements: statements(&read("gallery.js")), cells: rows(&read("cells.csv")), points, atlas }
}

impl Rendered {
    /// The arguments of all calls of a function.
    fn calls(&self, name: &str) -> Vec<&Value> {
        self.statements.iter().filter(|(function, _)| function == name).map(|(_, value)| value).collect()
    }
}

#[test]
fn cells_and_measures_are_those_of_the_table_to_the_last_bit() {
    for id in ["evans", "watt", "grid", "over"] {
        let family = rendered(id);
        let head = family.calls("begin")[0];
        let listed = |name: &str| head[name].as_array().unwrap().iter().map(|name| name.as_str().unwrap());
        let names: Vec<&str> = listed("names").collect();
        let mut rows = family.cells.iter();
        for (chunk, outlines) in family.calls("cells").into_iter().zip(family.calls("curves")) {
            let Rows { numbers, owners, traces, circuits } = rows_of(chunk);
            let columns = chunk["values"].as_array().unwrap();
            let values: Vec<Vec<f64>> = columns.iter().map(|column| f64s(column, numbers.len())).collect();
            let statuses = u8s(&chunk["status"], numbers.len());
            assert_eq!([count_of(&outlines["cells"]), count_of(&outlines["curves"])], [numbers.len(), owners.len()]);
            for (name, column) in outlines["rows"].as_object().unwrap() {
                assert_eq!(column, &chunk[name], "{name}: the points have the same rows as the table");
            }
            assert_eq!(outlines["rows"].as_object().unwrap().len(), 5);
            for (k, number) in numbers.iter().enumerate() {
                let of_cell: Vec<usize> = (0..owners.len()).filter(|&curve| owners[curve] == k).collect();
                for curve in if of_cell.is_empty() { vec![None] } else { of_cell.into_iter().map(Some).collect() } {
                    let row = rows.next().unwrap();
                    assert_eq!(row["cell"], number.to_string());
                    assert_eq!(row["status"], ["ok", "partial", "none"][statuses[k]]);
                    assert_eq!(row["reason"], text(outlines, "reason", k));
                    for (name, column) in names.iter().zip(&values) {
                        assert_eq!(row[*name].parse::<f64>().unwrap(), column[k], "{name}");
                    }
                    let Some(curve) = curve else { continue };
                    let [trace, circuit] = [&traces, &circuits].map(|numbers| numbers[curve].to_string());
                    assert_eq!([&row["trace"], &row["circuit"]], [&trace, &circuit]);
                    for (name, column) in listed("measures").zip(chunk["measures"].as_array().unwrap()) {
                        let (field, value) = (&row[name], f64s(column, owners.len())[curve]);
                        assert!(
                            field.parse() == Ok(value) || (field.is_empty() && value.is_nan()),
                            "{name}: {field}, {value}"
                        );
                    }
                    for (name, words) in listed("words").zip(chunk["words"].as_array().unwrap()) {
                        let code = u8s(&words["codes"], owners.len())[curve];
                        assert_eq!(row[name], words["values"].get(code).and_then(Value::as_str).unwrap_or_default());
                    }
                }
            }
        }
        assert!(rows.next().is_none());
        assert_eq!(family.calls("end").len(), 1);
    }
}

#[test]
fn points_are_samples_to_a_65535th_of_the_extent() {
    for id in ["evans", "watt", "grid"] {
        let family = rendered(id);
        let mut compared = 0;
        for (chunk, outlines) in family.calls("cells").into_iter().zip(family.calls("curves")) {
            let Rows { numbers, owners, traces, circuits } = rows_of(chunk);
            let counts = u16s(&outlines["count"], owners.len());
            let boxes: Vec<Vec<f64>> =
                outlines["box"].as_array().unwrap().iter().map(|side| f64s(side, owners.len())).collect();
            let points = points_of(&outlines["points"], &counts);
            let mut first = 0;
            for curve in 0..owners.len() {
                let samples = &family.points[&[numbers[owners[curve]], traces[curve], circuits[curve]]];
                let [x0, y0, x1, y1] = [0, 1, 2, 3].map(|k| boxes[k][curve]);
                // Half a step either way, and the rounding of the sum.
                let near = |a: f64, b: f64, size: f64| (a - b).abs() <= size * (0.5 / 65535.0 + 1e-12);
                let mut next = 0;
                for point in &points[first..first + counts[curve]] {
                    let unpack = |step: i64, from: f64, to: f64| from + (to - from) * step as f64 / 65535.0;
                    let [x, y] = [unpack(point[0], x0, x1), unpack(point[1], y0, y1)];
                    // In the order of the samples.
                    let found = samples[next..].iter().position(|p| near(p[0], x, x1 - x0) && near(p[1], y, y1 - y0));
                    next += found.unwrap_or_else(|| panic!("{id}: no sample at {x}, {y}")) + 1;
                }
                assert!(counts[curve] == samples.len().min(128), "{id}: {} of {}", counts[curve], samples.len());
                first += counts[curve];
                compared += 1;
            }
        }
        assert_eq!(compared, family.points.len());
    }
}

#[test]
fn pages_say_where_their_curves_are() {
    for id in ["evans", "watt", "grid"] {
        let family = rendered(id);
        let pages = family.calls("page");
        for (page, data) in (1..).zip(&pages) {
            assert_eq!(data["page"], page);
            let svg = fs::read(family.atlas.out().join(family.id).join(format!("{id}-{page:03}.svg"))).unwrap();
            let mut drawn = read_drawn_curves(&svg).unwrap().into_iter();
            for view in data["views"].as_array().unwrap() {
                for curve in view["curves"].as_array().unwrap().chunks(2) {
                    let drawn = drawn.next().unwrap();
                    let number = |value: &Value| value.as_f64().unwrap();
                    let values =
                        [&view["cell"], &curve[0], &curve[1], &view["scale"], &view["origin"][0], &view["origin"][1]];
                    let [cell, trace, circuit] = [drawn.cell, drawn.trace, drawn.circuit].map(|number| number as f64);
                    let view = drawn.page_from_plane;
                    assert_eq!(
                        values.map(number),
                        [cell, trace, circuit, view.scale(), view.origin().x, view.origin().y]
                    );
                }
            }
            assert!(drawn.next().is_none());
        }
    }
    assert_eq!(rendered("evans").calls("page").len(), 2);
    let charts = rendered("over");
    assert_eq!(charts.calls("page")[0]["views"], serde_json::json!([]));
}

#[test]
fn text_of_the_manifest_cannot_end_the_script() {
    let family = rendered("evans");
    assert_eq!(family.calls("begin")[0]["title"], "Evans' <i>linkage</i>");
}
