//! What a family's script hands to the page, read back and held against its tables and pages.

use std::collections::BTreeMap;
use std::fs;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use coupler_atlas::record::read_drawn_curves;
use serde_json::Value;

use crate::folder::Atlas;

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

/// The statements of a family's script: what each calls, and what it hands over.
fn statements(script: &str) -> Vec<(String, Value)> {
    let statement = |line: &str| {
        let call = line.strip_prefix("couplerAtlas.").unwrap().strip_suffix(");").unwrap();
        let (name, json) = call.split_once('(').unwrap();
        (name.to_owned(), serde_json::from_str(json).unwrap())
    };
    script.lines().map(statement).collect()
}

fn bytes(packed: &Value, kind: &str) -> Vec<u8> {
    assert_eq!(packed["type"], kind);
    BASE64_STANDARD.decode(packed["data"].as_str().unwrap()).unwrap()
}

fn f64s(packed: &Value) -> Vec<f64> {
    bytes(packed, "f64").chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
}

fn u32s(packed: &Value) -> Vec<usize> {
    bytes(packed, "u32").chunks(4).map(|b| u32::from_le_bytes(b.try_into().unwrap()) as usize).collect()
}

fn u16s(packed: &Value) -> Vec<usize> {
    bytes(packed, "u16").chunks(2).map(|b| usize::from(u16::from_le_bytes(b.try_into().unwrap()))).collect()
}

/// The rows of a table, by the names of its columns.
fn rows(text: &str) -> Vec<BTreeMap<String, String>> {
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect::<Result<_, _>>().unwrap()
}

/// A family that was rendered: its statements, its rows of `cells.csv`, and the points of each of its curves.
struct Rendered {
    atlas: Atlas,
    id: &'static str,
    statements: Vec<(String, Value)>,
    cells: Vec<BTreeMap<String, String>>,
    points: BTreeMap<[usize; 3], Vec<[f64; 2]>>,
}

fn rendered(id: &'static str) -> Rendered {
    let atlas = Atlas::new(MANIFEST);
    let (code, _, err) = atlas.run(&["--only", id]);
    assert_eq!(code, 0, "{err}");
    let read = |name: &str| fs::read_to_string(atlas.out().join(id).join(name)).unwrap();
    let mut points: BTreeMap<[usize; 3], Vec<[f64; 2]>> = BTreeMap::new();
    for row in rows(&read("points.csv")) {
        let key = ["cell", "trace", "circuit"].map(|name| row[name].parse().unwrap());
        points.entry(key).or_default().push(["x", "y"].map(|name| row[name].parse().unwrap()));
    }
    Rendered { id, statements: statements(&read("gallery.js")), cells: rows(&read("cells.csv")), points, atlas }
}

impl Rendered {
    fn called(&self, name: &str) -> Vec<&Value> {
        self.statements.iter().filter(|(called, _)| called == name).map(|(_, value)| value).collect()
    }
}

#[test]
fn cells_and_measures_are_those_of_the_table_to_the_last_bit() {
    for id in ["evans", "watt", "grid", "over"] {
        let family = rendered(id);
        let names: Vec<&str> =
            family.called("begin")[0]["names"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
        let mut rows = family.cells.iter();
        for chunk in family.called("cells") {
            let (numbers, values) = (u32s(&chunk["number"]), f64s(&chunk["values"]));
            let curves = &chunk["curves"];
            let (of, traces, circuits) = (u32s(&curves["cell"]), u16s(&curves["trace"]), u16s(&curves["circuit"]));
            for (k, number) in numbers.iter().enumerate() {
                let own: Vec<usize> = (0..of.len()).filter(|&curve| of[curve] == k).collect();
                let status = bytes(&chunk["status"], "u8")[k];
                for at in if own.is_empty() { vec![None] } else { own.into_iter().map(Some).collect() } {
                    let row = rows.next().unwrap();
                    assert_eq!(row["cell"], number.to_string());
                    assert_eq!(row["status"], ["ok", "partial", "none"][usize::from(status)]);
                    assert_eq!(row["reason"], chunk["reason"][k].as_str().unwrap());
                    for (slot, name) in names.iter().enumerate() {
                        assert_eq!(row[*name].parse::<f64>().unwrap(), values[k * names.len() + slot], "{name}");
                    }
                    let Some(at) = at else { continue };
                    assert_eq!([&row["trace"], &row["circuit"]], [&traces[at].to_string(), &circuits[at].to_string()]);
                    for (name, column) in curves["measures"].as_object().unwrap() {
                        let (told, value) = (&row[name], f64s(column)[at]);
                        assert!(
                            told.parse() == Ok(value) || (told.is_empty() && value.is_nan()),
                            "{name}: {told}, {value}"
                        );
                    }
                    for (name, words) in curves["words"].as_object().unwrap() {
                        let code = usize::from(bytes(&words["codes"], "u8")[at]);
                        assert_eq!(row[name], words["values"].get(code).and_then(Value::as_str).unwrap_or_default());
                    }
                }
            }
        }
        assert!(rows.next().is_none());
        assert_eq!(family.called("end").len(), 1);
    }
}

#[test]
fn points_are_samples_to_a_65535th_of_the_extent() {
    for id in ["evans", "watt", "grid"] {
        let family = rendered(id);
        let mut seen = 0;
        for chunk in family.called("cells") {
            let curves = &chunk["curves"];
            let (numbers, of) = (u32s(&chunk["number"]), u32s(&curves["cell"]));
            let (traces, circuits, counts) = (u16s(&curves["trace"]), u16s(&curves["circuit"]), u16s(&curves["count"]));
            let (boxes, points) = (f64s(&curves["box"]), u16s(&curves["points"]));
            let mut at = 0;
            for curve in 0..of.len() {
                let samples = &family.points[&[numbers[of[curve]], traces[curve], circuits[curve]]];
                let [x0, y0, x1, y1] = [0, 1, 2, 3].map(|k| boxes[4 * curve + k]);
                // Half a step either way, and the rounding of the sum.
                let near = |a: f64, b: f64, size: f64| (a - b).abs() <= size * (0.5 / 65535.0 + 1e-12);
                let mut next = 0;
                for k in at..at + counts[curve] {
                    let place = |part: usize, from: f64, to: f64| from + (to - from) * part as f64 / 65535.0;
                    let [x, y] = [place(points[2 * k], x0, x1), place(points[2 * k + 1], y0, y1)];
                    // In the order of the samples.
                    let found = samples[next..].iter().position(|p| near(p[0], x, x1 - x0) && near(p[1], y, y1 - y0));
                    next += found.unwrap_or_else(|| panic!("{id}: no sample at {x}, {y}")) + 1;
                }
                assert!(counts[curve] == samples.len().min(128), "{id}: {} of {}", counts[curve], samples.len());
                at += counts[curve];
                seen += 1;
            }
        }
        assert_eq!(seen, family.points.len());
    }
}

#[test]
fn pages_say_where_their_curves_are() {
    for id in ["evans", "watt", "grid"] {
        let family = rendered(id);
        let pages = family.called("page");
        for (page, told) in (1..).zip(&pages) {
            assert_eq!(told["page"], page);
            let svg = fs::read(family.atlas.out().join(family.id).join(format!("{id}-{page:03}.svg"))).unwrap();
            let mut drawn = read_drawn_curves(&svg).unwrap().into_iter();
            for view in told["views"].as_array().unwrap() {
                for curve in view["curves"].as_array().unwrap() {
                    let is = drawn.next().unwrap();
                    let number = |value: &Value| value.as_f64().unwrap();
                    let at = is.page_from_plane;
                    let told =
                        [&view["cell"], &curve[0], &curve[1], &view["scale"], &view["origin"][0], &view["origin"][1]];
                    let is = [is.cell as f64, is.trace as f64, is.circuit as f64, at.scale, at.origin.x, at.origin.y];
                    assert_eq!(told.map(number), is);
                }
            }
            assert!(drawn.next().is_none());
        }
    }
    assert_eq!(rendered("evans").called("page").len(), 2);
    let charts = rendered("over");
    assert_eq!(charts.called("page")[0]["views"], serde_json::json!([]));
}

#[test]
fn text_of_the_manifest_ends_no_script() {
    let family = rendered("evans");
    assert_eq!(family.called("begin")[0]["title"], "Evans' <i>linkage</i>");
}
