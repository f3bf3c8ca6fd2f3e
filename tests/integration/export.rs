//! Exported curves: every format is read back and compared with the tables of the atlas.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use coupler_curves::catalogue;
use coupler_curves::geometry::trig;
use tempfile::TempDir;

use crate::support::command::{folder_with, printed, run};
use crate::support::folder::files;

/// Crank pins that trace circles, a rocker pin on an arc, every kind of sampling, a mirrored and rotated family, a
/// length as input, and a title with markup characters.
const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg"]
[[linkage]]
id = "mine"
parameters = { g = { min = 0 } }
trace = ["A", "B", "M"]
circuits = "all"
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["g", 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = [3, 3.5], side = "left" }
M = { point = ["A", "B"], along = 1.5, across = 1 }
[[family]]
id = "evans"
linkage = "evans"
title = "Evans <linkage> & \"co\""
sampling = { step = "2 deg" }
cases = [{ p = 2, a = 2.59 }, { p = 3, a = 4.1 }]
columns = ["vx", "mu_deg"]
straight = { input = "100 deg" }
[[family]]
id = "watt"
linkage = "watt"
sampling = { samples = 100 }
cases = [{ p = 4, r = 2, a = 1 }, { p = 90, r = 2, a = 1 }]
[[family]]
id = "mine"
linkage = "mine"
sampling = { samples = 60, spacing = "smooth" }
cases = [{ g = 4 }, { g = 5 }]
[[family]]
id = "placed"
linkage = "hoeken"
sampling = { step = "5 deg" }
grid = { p = [2], q = [2.5] }
let = { r = 1, a = "q" }
where = "straight_length > 0"
place = { mirror = true, rotate = "30 deg" }
[[family]]
id = "actuator"
linkage = "linear-actuator"
sampling = { step = 0.05 }
cases = [{ g = 2, r = 0.75, e = 0.3 }]
[[family]]
id = "grid"
linkage = "hrones-nelson"
sampling = { step = "10 deg" }
cases = [{ A = 3, B = 3.5, C = 3 }]
"#;

/// A folder with the rendered manifest, and all its curves exported in the given formats to `exported`.
fn export(formats: &str) -> TempDir {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["render", "-q"]);
    printed(folder.path(), &["export", "--format", formats, "-o", "exported"]);
    folder
}

/// The rows of a family's points.csv by curve: cell, trace, circuit.
fn points(folder: &Path, family: &str) -> (String, BTreeMap<[usize; 3], Vec<String>>) {
    let table = fs::read_to_string(folder.join(format!("out/{family}/points.csv"))).unwrap();
    let (header, rows) = table.split_once('\n').unwrap();
    let mut curves: BTreeMap<[usize; 3], Vec<String>> = BTreeMap::new();
    for row in rows.lines() {
        let numbers: Vec<usize> = row.split(',').take(3).map(|field| field.parse().unwrap()).collect();
        curves.entry([numbers[0], numbers[1], numbers[2]]).or_default().push(row.to_owned());
    }
    (header.to_owned(), curves)
}

const FAMILIES: [&str; 6] = ["evans", "watt", "mine", "placed", "actuator", "grid"];

fn file(folder: &Path, family: &str, [cell, trace, circuit]: [usize; 3], ending: &str) -> String {
    fs::read_to_string(folder.join(format!("exported/{family}-{cell}-{trace}-{circuit}{ending}"))).unwrap()
}

/// The x and y of the rows.
fn places(header: &str, rows: &[String]) -> Vec<[f64; 2]> {
    let column = |name: &str| header.split(',').position(|field| field == name).unwrap();
    let [x, y] = ["x", "y"].map(column);
    let place = |row: &String| {
        let fields: Vec<&str> = row.split(',').collect();
        [x, y].map(|k| fields[k].parse().unwrap())
    };
    rows.iter().map(place).collect()
}

#[test]
fn tables_have_the_rows_of_points_csv() {
    let folder = export("csv");
    let mut expected = Vec::new();
    for family in FAMILIES {
        let (header, curves) = points(folder.path(), family);
        for (&[cell, trace, circuit], rows) in &curves {
            let table = file(folder.path(), family, [cell, trace, circuit], ".csv");
            let (own_header, own_rows) = table.split_once('\n').unwrap();
            assert_eq!(own_header, format!("{header},closed"));
            let plain: Vec<&str> = own_rows.lines().map(|row| row.rsplit_once(',').unwrap().0).collect();
            assert_eq!(plain, *rows);
            assert!(own_rows.lines().all(|row| row.ends_with(",1")), "all of them are closed");
            expected.push(format!("{family}-{cell}-{trace}-{circuit}.csv"));
        }
    }
    assert_eq!(expected.len(), 27, "two cells of six curves, ten points of a grid and five more");
    expected.sort();
    assert_eq!(files(&folder.path().join("exported")), expected, "every curve and nothing else");
}

/// An entity of a drawing: its kind and its groups by code; for a polyline also the positions of its vertices.
struct Entity {
    kind: String,
    groups: BTreeMap<i32, String>,
    vertices: Vec<[f64; 2]>,
}

impl Entity {
    fn number(&self, code: i32) -> f64 {
        self.groups[&code].parse().unwrap()
    }
}

/// A DXF drawing.
struct Drawing {
    version: String,
    layers: Vec<String>,
    extent: [f64; 4],
    entities: Vec<Entity>,
}

/// Parses a DXF drawing and asserts that its structure is valid.
fn drawing(text: &str) -> Drawing {
    assert!(text.is_ascii() && text.ends_with('\n'));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len() % 2, 0, "pairs of lines");
    let pairs: Vec<(i32, &str)> = lines.chunks(2).map(|pair| (pair[0].trim().parse().unwrap(), pair[1])).collect();
    let pairs: Vec<(i32, &str)> = pairs.into_iter().filter(|(code, _)| *code != 999).collect();
    assert_eq!(*pairs.last().unwrap(), (0, "EOF"));
    let mut sections: Vec<(&str, Vec<(i32, &str)>)> = Vec::new();
    let mut open = false;
    for (k, pair) in pairs.iter().enumerate() {
        match *pair {
            (0, "SECTION") => {
                assert!(!open);
                open = true;
                sections.push((pairs[k + 1].1, Vec::new()));
            }
            (0, "ENDSEC") => open = false,
            (0, "EOF") => assert!(!open && k + 1 == pairs.len()),
            pair => {
                assert!(open, "{pair:?} is outside all sections");
                sections.last_mut().unwrap().1.push(pair);
            }
        }
    }
    let names: Vec<&str> = sections.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["HEADER", "TABLES", "BLOCKS", "ENTITIES"]);
    let header = &sections[0].1;
    let variable = |name: &str, code: i32| {
        let at = header.iter().position(|pair| *pair == (9, name)).unwrap();
        header[at..].iter().find(|(c, _)| *c == code).unwrap().1
    };
    let extent = [("$EXTMIN", 10), ("$EXTMIN", 20), ("$EXTMAX", 10), ("$EXTMAX", 20)];
    let tables = &sections[1].1;
    let mut layers = Vec::new();
    for (k, pair) in tables.iter().enumerate() {
        if *pair == (0, "LAYER") {
            layers.push(tables[k + 1].1.to_owned());
        }
    }
    let mut entities: Vec<Entity> = Vec::new();
    let mut parts: Vec<Entity> = Vec::new();
    for &(code, value) in &sections[3].1[1..] {
        if code == 0 {
            parts.push(Entity { kind: value.to_owned(), groups: BTreeMap::new(), vertices: Vec::new() });
        } else {
            assert!(
                parts.last_mut().unwrap().groups.insert(code, value.to_owned()).is_none(),
                "group {code} is repeated"
            );
        }
    }
    let mut in_polyline = false;
    for part in parts {
        assert!(layers.contains(&part.groups[&8]), "layer {}", part.groups[&8]);
        match part.kind.as_str() {
            "VERTEX" => {
                assert!(in_polyline);
                let at = [part.number(10), part.number(20)];
                entities.last_mut().unwrap().vertices.push(at);
            }
            "SEQEND" => {
                assert!(in_polyline);
                in_polyline = false;
            }
            _ => {
                assert!(!in_polyline);
                in_polyline = part.kind == "POLYLINE";
                assert!(!in_polyline || part.groups[&66] == "1");
                entities.push(part);
            }
        }
    }
    Drawing {
        version: variable("$ACADVER", 1).to_owned(),
        layers,
        extent: extent.map(|(name, code)| variable(name, code).parse().unwrap()),
        entities,
    }
}

/// The distance of a point p from the segment ab.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let length2 = dx * dx + dy * dy;
    let t = if length2 > 0.0 { ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2 } else { 0.0 };
    let t = t.clamp(0.0, 1.0);
    trig::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy)
}

/// The larger side of the bounding box.
fn extent(places: &[[f64; 2]]) -> f64 {
    let side = |k: usize| {
        let values = || places.iter().map(|place| place[k]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    side(0).max(side(1))
}

/// The greatest distance of the samples of a curve from its entity, relative to the curve's extent.
fn deviation(curve: &Entity, places: &[[f64; 2]]) -> f64 {
    let centre = [curve.number(10), curve.number(20)];
    let distance_of = |p: &[f64; 2]| match curve.kind.as_str() {
        "POLYLINE" => {
            let vertices = &curve.vertices;
            let chords = vertices.windows(2).map(|pair| [pair[0], pair[1]]);
            let closing = [*vertices.last().unwrap(), vertices[0]];
            let closing = (curve.groups[&70] == "1").then_some(closing);
            chords.chain(closing).map(|[a, b]| distance(*p, a, b)).fold(f64::INFINITY, f64::min)
        }
        "CIRCLE" | "ARC" => {
            if curve.kind == "ARC" {
                let deg = trig::degrees(trig::atan2(p[1] - centre[1], p[0] - centre[0]));
                let [begin, end] = [50, 51].map(|code| curve.number(code));
                let span = (end - begin).rem_euclid(360.0);
                // Angles are written to nine decimals, and both ends are rounded.
                assert!((deg - begin + 1e-8).rem_euclid(360.0) <= span + 2e-8, "{deg} is not in {begin} to {end}");
            }
            (trig::hypot(p[0] - centre[0], p[1] - centre[1]) - curve.number(40)).abs()
        }
        kind => panic!("a curve is drawn as {kind}"),
    };
    places.iter().map(distance_of).fold(0.0, f64::max) / extent(places)
}

#[test]
fn dxf_curves_are_within_the_chord_tolerance() {
    let folder = export("dxf");
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    for family in FAMILIES {
        let (header, curves) = points(folder.path(), family);
        for (&numbers, rows) in &curves {
            let drawing = drawing(&file(folder.path(), family, numbers, ".dxf"));
            assert_eq!(drawing.version, "AC1009");
            assert_eq!(drawing.layers, ["0", "CURVE", "LINKAGE", "JOINTS", "PIVOTS"]);
            let on_layer =
                |layer: &'static str| drawing.entities.iter().filter(move |entity| entity.groups[&8] == layer);
            let [curve] = on_layer("CURVE").collect::<Vec<_>>()[..] else { panic!("one curve") };
            let places = places(&header, rows);
            // The chord tolerance; a circle is accurate to 1e-9 of its radius, and a rocker's radius is a few extents.
            let tolerance = if curve.kind == "POLYLINE" { 1e-4 } else { 1e-8 };
            let deviation = deviation(curve, &places);
            assert!(deviation <= tolerance, "{family} {numbers:?}: {deviation}");
            for [x, y] in places {
                let [x0, y0, x1, y1] = drawing.extent;
                let slack = 1e-3 * (x1 - x0);
                assert!(
                    x > x0 - slack && x < x1 + slack && y > y0 - slack && y < y1 + slack || curve.kind != "POLYLINE"
                );
            }
            *kinds.entry(curve.kind.clone()).or_default() += 1;
            assert!(on_layer("LINKAGE").all(|entity| entity.kind == "LINE"), "{family}");
            assert!(on_layer("LINKAGE").count() >= 2, "{family}");
            assert!(on_layer("PIVOTS").chain(on_layer("JOINTS")).all(|entity| entity.kind == "POINT"));
            assert!(on_layer("PIVOTS").count() >= 1 && on_layer("JOINTS").count() >= 1);
        }
    }
    // The crank pins and the rocker pins of two cells with two circuits each, and the crank of the actuator.
    assert!(kinds["CIRCLE"] >= 4 && kinds["ARC"] >= 4 && kinds["POLYLINE"] >= 15, "{kinds:?}");
    let [pin, rocker] = [1, 2].map(|trace| drawing(&file(folder.path(), "mine", [1, trace, 1], ".dxf")));
    let curve = |drawing: &Drawing| {
        let curve = drawing.entities.iter().find(|entity| entity.groups[&8] == "CURVE").unwrap();
        (curve.kind.clone(), [10, 20, 40].map(|code| curve.number(code)))
    };
    assert_eq!(curve(&pin), ("CIRCLE".to_owned(), [0.0, 0.0, 1.0]));
    assert_eq!(curve(&rocker), ("ARC".to_owned(), [4.0, 0.0, 3.5]), "to the last digit");
}

#[test]
fn lines_are_the_links_in_one_pose_and_the_chord_tolerance_can_be_set() {
    let folder = export("csv");
    let text = printed(folder.path(), &["export", "evans:1.1.1", "--format", "dxf", "--chord", "1e-7"]);
    let drawing = drawing(&text);
    let length =
        |entity: &Entity| trig::hypot(entity.number(11) - entity.number(10), entity.number(21) - entity.number(20));
    let mut lengths: Vec<f64> = drawing.entities.iter().filter(|entity| entity.kind == "LINE").map(length).collect();
    lengths.sort_by(f64::total_cmp);
    // The crank, the rocker, and the coupler from the crank pin to the rocker pin and on to the coupler point.
    for (length, expected) in lengths.iter().zip([1.0, 2.59, 2.59, 2.59]) {
        assert!((length - expected).abs() < 1e-12, "{lengths:?}");
    }
    assert_eq!(lengths.len(), 4);
    let (header, curves) = points(folder.path(), "evans");
    let [curve] = drawing.entities.iter().filter(|entity| entity.kind == "POLYLINE").collect::<Vec<_>>()[..] else {
        panic!("one curve")
    };
    assert_eq!(curve.groups[&70], "1", "closed");
    assert_ne!(curve.vertices.first(), curve.vertices.last(), "the first point is not repeated");
    let deviation = deviation(curve, &places(&header, &curves[&[1, 1, 1]]));
    assert!(deviation <= 1e-7 && deviation > 1e-9, "{deviation}");
}

#[test]
fn json_has_the_same_numbers_as_the_tables() {
    let folder = export("json");
    let mut compared = 0;
    for family in FAMILIES {
        let (header, curves) = points(folder.path(), family);
        let cells = fs::read_to_string(folder.path().join(format!("out/{family}/cells.csv"))).unwrap();
        let mut table = csv::Reader::from_reader(cells.as_bytes());
        let names = table.headers().unwrap().clone();
        let records: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        for (&numbers, rows) in &curves {
            let value: serde_json::Value =
                serde_json::from_str(&file(folder.path(), family, numbers, ".json")).unwrap();
            assert_eq!(value["format"], 1);
            let [cell, trace, circuit] = numbers;
            assert_eq!(value["curve"], format!("{family}:{cell}.{trace}.{circuit}"));
            let columns: Vec<&str> =
                value["columns"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
            assert_eq!(columns, header.split(',').skip(3).collect::<Vec<_>>());
            let points = value["points"].as_array().unwrap();
            assert_eq!(points.len(), rows.len());
            for (row, point) in rows.iter().zip(points) {
                for (field, number) in row.split(',').skip(3).zip(point.as_array().unwrap()) {
                    assert_eq!(
                        field.parse::<f64>().ok().filter(|value| value.is_finite()),
                        number.as_f64(),
                        "{family}: {row}"
                    );
                }
            }
            let record = records.iter().find(|record| {
                let fields: Vec<&str> = record.iter().take(3).collect();
                fields == numbers.map(|number| number.to_string()).iter().map(String::as_str).collect::<Vec<_>>()
            });
            for (name, field) in names.iter().zip(record.unwrap()).skip(3) {
                let entry = value["parameters"].get(name).or(value["measures"].get(name)).unwrap_or(&value[name]);
                let is_same = match (field.parse::<f64>(), entry.as_str()) {
                    (Ok(number), _) if number.is_finite() => entry.as_f64() == Some(number),
                    (_, Some(word)) => word == field,
                    _ => entry.is_null() && matches!(field, "" | "inf" | "-inf"),
                };
                assert!(is_same, "{family} {numbers:?}: {name} is {entry}, not {field}");
                compared += 1;
            }
            let circuits = value["circuits"].as_array().unwrap();
            assert!(circuits.len() >= circuit && circuits[circuit - 1]["closed"].is_boolean());
        }
    }
    assert!(compared > 900, "{compared}");
}

#[test]
fn json_of_every_linkage_reads_back_with_a_side_for_each_dyad() {
    let folder = tempfile::tempdir().unwrap();
    let mut manifest = "[atlas]\ntitle = \"T\"\n".to_owned();
    for template in catalogue::all() {
        let page = printed(folder.path(), &["list", "linkages", &template.id]);
        manifest.push_str(page.split_once("a family to start from\n").unwrap().1);
    }
    fs::write(folder.path().join("atlas.toml"), &manifest).unwrap();
    printed(folder.path(), &["export", "--format", "json", "-o", "exported"]);
    let mut linkages = BTreeMap::new();
    for entry in fs::read_dir(folder.path().join("exported")).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let value: serde_json::Value =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let columns = value["columns"].as_array().unwrap();
        let further = columns.iter().filter(|name| name.as_str().unwrap().starts_with("branch_")).count();
        let branches = value["circuits"][0]["passes"][0]["branches"].as_array().unwrap();
        assert!(further == 0 || branches.len() == further + 1, "{}: {branches:?}", path.display());
        linkages.insert(value["linkage"].as_str().unwrap().to_owned(), further);
    }
    assert_eq!(linkages.len(), catalogue::all().len());
    assert!(linkages.values().filter(|further| **further > 0).count() >= 15, "{linkages:?}");
}

#[test]
fn a_fragment_of_a_manifest_draws_the_same_curves() {
    let folder = export("toml,csv");
    let fragment = fs::read_to_string(folder.path().join("exported/curves.toml")).unwrap();
    // The fragment needs the linkage that the atlas defines.
    let linkage = &MANIFEST[MANIFEST.find("[[linkage]]").unwrap()..MANIFEST.find("[[family]]").unwrap()];
    assert!(fragment.contains("# The [[linkage]] `mine` is the atlas's own"), "{fragment}");
    let manifest = format!("[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"svg\"]\n{linkage}\n{fragment}");
    let again = folder_with(&manifest);
    printed(again.path(), &["validate"]);
    printed(again.path(), &["render", "-q"]);
    for (family, linkage) in
        FAMILIES.into_iter().zip(["evans", "watt", "mine", "hoeken", "linear-actuator", "hrones-nelson"])
    {
        let (header, curves) = points(folder.path(), family);
        let (new_header, new) = points(again.path(), &format!("{linkage}-exported"));
        assert_eq!(header, new_header, "{manifest}");
        // The second cell of `watt` is not assembled and has no curve to export.
        assert_eq!(curves, new, "{family}");
    }
    // Curves of one linkage with the same settings are in one family.
    let merged = printed(folder.path(), &["export", "evans:2", "evans:1.1.1", "evans:2.1.1", "--format", "toml"]);
    assert_eq!(merged.matches("[[family]]").count(), 1);
    assert_eq!(merged.matches("    { p = ").count(), 2, "a cell is written once: {merged}");
    assert!(merged.contains("title = \"Evans <linkage> & \\\"co\\\"\""), "{merged}");
}

#[test]
fn plates_are_well_formed_and_animated_on_request() {
    let folder = export("svg,moving-svg,png");
    let mut pictures = 0;
    for family in FAMILIES {
        for numbers in points(folder.path(), family).1.into_keys() {
            let still = file(folder.path(), family, numbers, ".svg");
            let moving = file(folder.path(), family, numbers, "-moving.svg");
            for (svg, is_animated) in [(&still, false), (&moving, true)] {
                let document = roxmltree::Document::parse(svg).unwrap();
                assert_eq!(document.root_element().attribute("width"), Some("200mm"));
                assert_eq!(document.descendants().any(|node| node.has_tag_name("animate")), is_animated);
                let curves = document.descendants().filter(|node| node.attribute("class") == Some("curve"));
                assert_eq!(curves.count(), 1, "exactly one curve");
                pictures += 1;
            }
            let [cell, trace, circuit] = numbers;
            let png = fs::read(folder.path().join(format!("exported/{family}-{cell}-{trace}-{circuit}.png"))).unwrap();
            let image = image::load_from_memory(&png).unwrap();
            assert_eq!((image.width(), image.height()), (787, 591), "200 by 150 mm at 100 to the inch");
        }
    }
    assert_eq!(pictures, 2 * 27);
}

#[test]
fn a_linkage_is_exported_like_a_cell_of_a_family() {
    let folder = export("csv");
    let from_family = file(folder.path(), "watt", [1, 1, 1], ".csv");
    let arguments = ["export", "--linkage", "watt", "p=4", "r=1+1", "a=1", "--samples", "100", "--format", "csv"];
    assert_eq!(printed(folder.path(), &arguments), from_family);
    let from_manifest =
        ["export", "--linkage", "mine", "--manifest", "atlas.toml", "g=4", "2.1", "--format", "csv", "-o", "one.csv"];
    assert_eq!(printed(folder.path(), &from_manifest), "");
    assert!(fs::read_to_string(folder.path().join("one.csv")).unwrap().contains("\n1,2,1,1,0,"));
    // Sampled by steps of the input.
    let step = ["export", "--linkage", "evans", "p=2", "a=2.59", "--step", "2", "--format", "csv"];
    let stepped = printed(folder.path(), &step);
    assert_eq!(stepped.lines().count(), 181);
    assert!(stepped.lines().nth(1).unwrap().starts_with("1,1,1,1,0,0,2,5.08"), "{stepped}");
}

#[test]
fn parameters_and_coupler_points_can_be_changed() {
    let folder = export("csv");
    let csv = |name: &str| printed(folder.path(), &["export", name, "--format", "csv"]);
    let rows = |text: &str| -> Vec<String> {
        text.lines().skip(1).map(|row| row.splitn(4, ',').nth(3).unwrap().to_owned()).collect()
    };
    assert_eq!(rows(&csv("evans:1.1.1?p=3&a=2+2.1")), rows(&file(folder.path(), "evans", [2, 1, 1], ".csv")));
    assert!(csv("evans:1.1.1?p=3&a=4.1").contains("\n1,1,1,1,0,"), "the cell keeps its number");
    // A value derived from a changed parameter changes too: `a` follows `q`.
    let derived = csv("placed:1.1.1?q=3");
    assert_eq!(rows(&derived), rows(&csv("placed:1.1.1?a=3")));
    // A coupler point at the crank pin traces the crank's circle; so does a point of a grid.
    for name in ["evans:1.1.1?M.along=0", "grid:1.7.1?M.along=0&M.across=0"] {
        let drawing = drawing(&printed(folder.path(), &["export", name, "--format", "dxf"]));
        let curve = drawing.entities.iter().find(|entity| entity.groups[&8] == "CURVE").unwrap();
        assert_eq!((curve.kind.as_str(), curve.number(40)), ("CIRCLE", 1.0), "{name}");
    }
    assert!(csv("grid:1.7.1?M.along=0").contains("\n1,7,1,1,0,"));
    printed(folder.path(), &["export", "evans:1?p=2.5", "evans:1", "--format", "dxf", "-o", "both"]);
    assert_eq!(files(&folder.path().join("both")), ["evans-1-1-1-p-2.5.dxf", "evans-1-1-1.dxf"]);
}

#[test]
fn a_circuit_beside_those_of_the_family_can_be_named() {
    let folder = export("csv");
    let named = printed(folder.path(), &["export", "evans:1.1.1?circuit=2", "--format", "csv"]);
    let own = printed(folder.path(), &["export", "evans:1.1.1?circuit=1", "--format", "csv"]);
    assert_eq!(own, file(folder.path(), "evans", [1, 1, 1], ".csv"));
    // The second circuit of a crank-rocker is the first in the other assembly mode.
    assert!(named.contains("\n1,1,2,-1,0,"), "{named}");
    assert_eq!(named.lines().count(), own.lines().count());
}

#[test]
fn all_wrong_arguments_are_reported_and_nothing_is_written() {
    let folder = folder_with(MANIFEST);
    fs::write(folder.path().join("a-file"), "mine").unwrap();
    let before = files(folder.path());
    let cases: [(&[&str], &[&str]); 21] = [
        (&["evan:1.1.1"], &["there is no family `evan`: did you mean `evans`?"]),
        (
            &["evans:9", "evans:1.x", "wat"],
            &[
                "there is no evans:9: its cells are numbered from 1 to 2",
                "`evans:1.x`: a curve is named FAMILY:CELL.TRACE.CIRCUIT",
                "there is no family `wat`",
            ],
        ),
        (
            &["evans:1.1.2", "mine:1.4.1"],
            &[
                "there is no evans:1.1.2: the cell's only curve is evans:1.1.1",
                "there is no mine:1.4.1: its cell has 6 curves, mine:1.1.1 to mine:1.3.2",
            ],
        ),
        (&["watt:2"], &["watt:2: it is not assembled: B cannot be placed"]),
        (&["watt:2.1.1"], &["there is no watt:2.1.1: it is not assembled"]),
        (&["evans:1.1.1?q=2"], &["evans: there is no `q`"]),
        (&["evans:1.1.1?circuit=0.5"], &["evans: `circuit` is 0.5, not the number of a circuit, 1 or more"]),
        (&["evans:1.1.1?circuit=3"], &["there is no evans:1.1.3: its cell has 2 curves, evans:1.1.1 to evans:1.1.2"]),
        (&["evans:1.1.1?p=-2"], &["evans:1: `p` is -2, and must be more than 0"]),
        (&["evans?p=2"], &["only the parameters of a single cell can be replaced"]),
        (&["evans:1.1.1?M.up=2"], &["there is no `M.up`: it can be `M.along` or `M.across`"]),
        (&["evans"], &["there are 2 files to write: name a folder for them with -o"]),
        (&["evans", "-o", "a-file"], &["a-file is a file, and there are 2 to write"]),
        (
            &["evans", "--format", "csv", "-o", "z.csv"],
            &["z.csv is the name of one file, and there are 2 to write: name a folder with -o"],
        ),
        (&["evans:1", "--format", "svg,csv", "-o", "new/Z.SVG"], &["Z.SVG is the name of one file"]),
        (&["evans:1", "--format", "dwg"], &["unknown format `dwg`"]),
        (&["evans:1", "--chord", "0"], &["expected a number from 1e-9 to 0.1"]),
        (&["--only", "evan"], &["there is no family `evan`"]),
        (&["--linkage", "evan", "p=2"], &["there is no linkage `evan`: did you mean `evans`?"]),
        (&["--linkage", "evans", "p=2", "z=1", "q"], &["`q`: there is no `=`", "unknown parameter `z`"]),
        (
            &["--linkage", "evans", "p=2", "a=2.59", "7.1"],
            &["there is no evans:1.7.1: the cell's only curve is evans:1.1.1"],
        ),
    ];
    for (arguments, messages) in cases {
        let (code, out, err) = run(folder.path(), &[&["export"], arguments].concat());
        assert_eq!((code, out.len()), (2, 0), "{arguments:?}: {err}");
        for message in messages {
            assert!(err.contains(message), "{arguments:?}: {err}");
        }
        assert_eq!(files(folder.path()), before, "{arguments:?}");
    }
}

#[test]
fn a_single_result_is_written_to_standard_output_a_file_or_a_folder() {
    let folder = export("csv");
    let table = printed(folder.path(), &["export", "atlas.toml", "evans:1", "--format", "csv"]);
    assert_eq!(table, file(folder.path(), "evans", [1, 1, 1], ".csv"));
    printed(folder.path(), &["export", "evans:1.1.1", "--format", "csv,csv", "-o", "one"]);
    assert_eq!(fs::read_to_string(folder.path().join("one")).unwrap(), table);
    let summary = printed(folder.path(), &["export", "evans:1.1.1", "--format", "csv", "-o", "new/"]);
    assert_eq!(summary, "1 file written to new/\n");
    assert_eq!(files(&folder.path().join("new")), ["evans-1-1-1.csv"]);
    // A folder may be named like a file, if it exists or its name ends in a slash.
    for path in ["z.csv/", "z.csv"] {
        printed(folder.path(), &["export", "evans", "--format", "csv", "-o", path]);
        assert_eq!(files(&folder.path().join("z.csv")), ["evans-1-1-1.csv", "evans-2-1-1.csv"]);
    }
    let (code, _, err) = run(folder.path(), &["export", "--only", "watt", "--format", "csv", "-o", "watts/"]);
    assert_eq!((code, files(&folder.path().join("watts"))), (0, vec!["watt-1-1-1.csv".to_owned()]));
    assert!(err.contains("warning: watt:2: not assembled"), "{err}");
}

/// Special files such as /dev/null are not replaced; the test uses a socket.
#[cfg(unix)]
#[test]
fn special_files_are_left_unchanged() {
    use std::os::unix::fs::FileTypeExt;
    let folder = TempDir::new().unwrap();
    let _socket = std::os::unix::net::UnixListener::bind(folder.path().join("socket")).unwrap();
    let arguments = ["export", "--linkage", "evans", "p=2", "a=2.59", "--format", "csv", "-o", "socket"];
    let (code, _, err) = run(folder.path(), &arguments);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("socket is neither a file nor a folder: name one with -o, or leave -o out"), "{err}");
    assert!(fs::metadata(folder.path().join("socket")).unwrap().file_type().is_socket());
}

#[test]
fn a_plate_is_a_page_of_pdf() {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["export", "evans:1.1.1", "--format", "pdf", "-o", "plate.pdf"]);
    let pdf = crate::book::reader::Pdf::read(&fs::read(folder.path().join("plate.pdf")).unwrap());
    assert_eq!(pdf.pages().len(), 1);
    assert!(!pdf.fonts().is_empty());
}
