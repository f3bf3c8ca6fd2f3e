//! Tables of columns, keys, names and defaults are compared with the program.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use super::text::codes;
use super::{document, documents, printed};
use crate::support::command::run;

fn keys(value: &Value) -> BTreeSet<String> {
    value.as_object().unwrap().keys().cloned().collect()
}

/// The first words of lines.
fn first_words(text: &str) -> BTreeSet<String> {
    let words = text.lines().filter(|line| !line.starts_with(' ')).filter_map(|line| line.split_whitespace().next());
    words.map(str::to_owned).collect()
}

/// The code in the first cells of a table.
fn names(file: &str, section: &str, heading: &str) -> BTreeSet<String> {
    let cells = document(file).first_cells(section, heading);
    cells.iter().flat_map(|cell| codes(cell)).collect()
}

/// The names of all properties in a schema.
fn properties(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(object) => {
            for (key, value) in object {
                if key == "properties" {
                    found.extend(keys(value));
                }
                properties(value, found);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| properties(value, found)),
        _ => {}
    }
}

/// A folder with an atlas of one curve.
fn small_atlas() -> TempDir {
    let folder = TempDir::new().unwrap();
    let manifest = "[atlas]\ntitle = \"T\"\noutput = \"output\"\nformats = [\"svg\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
                    sampling = { samples = 9 }\ncases = [{ p = 2, a = 2 }]\n";
    fs::write(folder.path().join("atlas.toml"), manifest).unwrap();
    assert_eq!(run(folder.path(), &["render", "-q"]).0, 0);
    folder
}

#[test]
fn the_keys_of_manifests_are_those_of_the_schema() {
    let mut found = BTreeSet::new();
    properties(&serde_json::from_str(&printed(&["list", "schema"])).unwrap(), &mut found);
    for (file, section) in [
        ("docs/manifest.md", "Parameters"),
        ("docs/manifest.md", "Linkages"),
        ("docs/manifest.md", "Drawings"),
        ("docs/manifest.md", "Families"),
        ("docs/manifest.md", "Designs"),
        ("docs/themes.md", "Themes"),
    ] {
        for name in names(file, section, "key") {
            let name = name.split(' ').next().unwrap();
            assert!(found.contains(name), "{file}: {section} has the key {name}");
        }
    }
    let text: String = ["docs/manifest.md", "docs/themes.md", "docs/check.md", "docs/book.md"]
        .iter()
        .map(|file| fs::read_to_string(super::root().join(file)).unwrap())
        .collect();
    let words: BTreeSet<&str> = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).collect();
    let missing: Vec<_> = found.iter().filter(|key| !words.contains(key.as_str())).collect();
    assert!(missing.is_empty(), "in no document: {missing:?}");
}

#[test]
fn lists_are_those_of_the_program() {
    let quoted = |names: BTreeSet<String>| names.iter().map(|name| name.trim_matches('"').to_owned()).collect();
    let themes: BTreeSet<String> = quoted(names("docs/themes.md", "Themes", "theme"));
    assert_eq!(themes, first_words(&printed(&["list", "themes"])));
    let layouts = document("docs/manifest.md").prose.into_iter().find(|prose| prose.text.starts_with("| `layout` |"));
    let layouts = layouts.unwrap().codes().split_off(1).into_iter().collect();
    assert_eq!(quoted(layouts), first_words(&printed(&["list", "layouts"])));
    // The formats of `export`, in its help and in its usage.
    let formats = names("docs/export.md", "Exporting curves", "format");
    let help = printed(&["export", "-h"]);
    let usage =
        document("docs/commands.md").prose.into_iter().find(|prose| prose.text.starts_with("| `export ")).unwrap();
    let stated = usage.text.split("--format ").nth(1).unwrap().split(']').next().unwrap();
    assert_eq!(stated.split(',').map(str::to_owned).collect::<BTreeSet<_>>(), formats);
    for format in formats {
        assert!(help.contains(&format), "{format}");
    }
    // The conditions on classes.
    let conditions: BTreeSet<String> = document("docs/manifest.md")
        .prose
        .iter()
        .filter(|prose| prose.section == "Conditions")
        .flat_map(|prose| prose.codes())
        .filter(|code| code.starts_with("is_"))
        .collect();
    let measures = first_words(&printed(&["list", "measures"]));
    assert_eq!(conditions, measures.into_iter().filter(|name| name.starts_with("is_")).collect());
}

/// In docs/measures.md every name is that of a measure, or begins as some do; the output's measures are all there.
#[test]
fn measures_are_those_of_the_program() {
    let measures = first_words(&printed(&["list", "measures"]));
    let described: BTreeSet<String> = ["The curve", "Straight and circular portions", "Measures of the output"]
        .iter()
        .zip(["measure", "columns", "measure"])
        .flat_map(|(section, heading)| names("docs/measures.md", section, heading))
        .collect();
    for name in &described {
        let is_one = match name.strip_suffix('…') {
            Some(start) => measures.iter().any(|measure| measure.starts_with(start)),
            None => measures.contains(name),
        };
        assert!(is_one, "{name}");
    }
    for measure in
        measures.iter().filter(|name| ["output_", "velocity_", "mechanical_"].iter().any(|s| name.starts_with(s)))
    {
        assert!(described.contains(measure), "docs/measures.md lacks {measure}");
    }
    // All other names of measures and columns in code, by their units and prefixes.
    let mut known: BTreeSet<String> = measures;
    known.extend(first_words(&printed(&["list", "columns"])));
    let of_find = ["input_deg", "angle_deg", "angles_deg", "rotation_deg", "line_deg", "mu_worst_poses_deg", "atol"];
    known.extend(of_find.map(str::to_owned));
    known.extend(["input_travel_deg", "error_greatest_input_deg", "error_zeros_input_deg"].map(str::to_owned));
    for document in documents().iter().filter(|document| document.name != "docs/inspect.md") {
        for code in document.prose.iter().flat_map(|prose| prose.codes()) {
            let is_word = code.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
            if is_word && (code.ends_with("_deg") || code.starts_with("straight_") || code.starts_with("mu_")) {
                // Of a linkage driven by an actuator, inputs are lengths.
                let name = code.replace("_length", "_deg");
                assert!(known.contains(&code) || known.contains(&name), "{}: {code}", document.name);
            }
        }
    }
}

#[test]
fn the_json_of_export_has_the_described_keys() {
    let json = printed(&["export", "--linkage", "evans", "p=2.5", "a=3", "--format", "json"]);
    let value: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(names("docs/export.md", "JSON", "key"), keys(&value));
    assert_eq!(value["format"], 1);
    let csv = printed(&["export", "--linkage", "evans", "p=2.5", "a=3", "--format", "csv"]);
    let header = csv.lines().next().unwrap();
    let columns: Vec<&str> =
        value["columns"].as_array().unwrap().iter().map(|column| column.as_str().unwrap()).collect();
    assert_eq!(header[header.find("branch").unwrap()..], columns.join(",") + ",closed");
    let measures: BTreeSet<String> = first_words(&printed(&["list", "measures"]));
    // Conditions, except the one that is also a column, are no measures.
    let is_measure = |name: &String| !name.starts_with("is_") || name == "is_full_turn";
    assert_eq!(keys(&value["measures"]), measures.into_iter().filter(is_measure).collect());
}

#[test]
fn the_dxf_has_the_described_layers() {
    let dxf = printed(&["export", "--linkage", "evans", "p=2.5", "a=3", "--format", "dxf"]);
    let lines: Vec<&str> = dxf.lines().map(str::trim).collect();
    // The code 8 is that of a layer, in pairs of a code and a value.
    let layers = lines.chunks(2).filter(|pair| pair[0] == "8").map(|pair| pair[1].to_owned());
    assert_eq!(names("docs/export.md", "DXF", "layer"), layers.collect());
    assert!(dxf.contains("AC1009"));
}

#[test]
fn the_json_of_validate_has_the_described_keys() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("atlas.toml"), "[atlas]\ntitle = \"T\"\nx = 1\n").unwrap();
    let (code, out, err) = run(folder.path(), &["validate", "--report", "json"]);
    assert_eq!(code, 2, "{err}");
    let report: Value = serde_json::from_str(&out).unwrap();
    let described = names("docs/commands.md", "Problems of a manifest", "key");
    let problem = keys(&report["problems"][0]);
    assert_eq!(described, keys(&report).union(&problem).cloned().collect());
    assert!(report["format"] == 1 && report["families"].is_null());
}

#[test]
fn the_tolerances_of_check_are_the_defaults() {
    let help = printed(&["check", "--help"]).split_whitespace().collect::<Vec<_>>().join(" ");
    let rows = document("docs/check.md").prose.into_iter().filter(|prose| prose.section == "Tolerances");
    let rows: Vec<String> = rows.filter(|prose| prose.table.is_some()).map(|prose| prose.text).collect();
    assert_eq!(rows.len(), 5);
    for row in &rows[2..] {
        let cells: Vec<&str> = row.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        let entry = help.split(&format!("{} <", cells[1])).nth(1).unwrap();
        let default = entry.split("[default: the manifest's, or ").nth(1).unwrap().split(']').next().unwrap();
        assert_eq!(default, cells[3], "{row}");
        assert_eq!(cells[2], cells[1].trim_start_matches('-').replace('-', "_"));
    }
}

/// The measures of `cells.csv`, and the attributes of a curve on a page.
#[test]
fn tables_have_the_described_columns() {
    let folder = small_atlas();
    let cells = fs::read_to_string(folder.path().join("output/e/cells.csv")).unwrap();
    let header: Vec<&str> = cells.lines().next().unwrap().split(',').collect();
    let measures = first_words(&printed(&["list", "measures"]));
    let at = header.iter().position(|column| *column == "reason").unwrap() + 1;
    let columns: BTreeSet<String> = header[at..header.len() - 2].iter().map(|column| (*column).to_owned()).collect();
    // README.md and docs/measures.md: measures are columns of `cells.csv`; docs/manifest.md: `is_full_turn` is one, too.
    let is_column = |name: &String| !name.starts_with("is_") || name == "is_full_turn";
    assert_eq!(columns, measures.into_iter().filter(is_column).collect());
    // docs/pages.md: the attributes of a group.
    let page = fs::read_to_string(folder.path().join("output/e/e-001.svg")).unwrap();
    let group = page.split("<g ").find(|part| part.contains("id=\"e-1-1-1\"")).unwrap().split('>').next().unwrap();
    let attributes = group.split('"').step_by(2).map(|name| name.trim().trim_end_matches('=').to_owned());
    let mut described = names("docs/pages.md", "Pages as SVG", "attribute");
    described.insert("class".into());
    // No part of this curve is traced again.
    assert!(described.remove("data-drawn"));
    assert_eq!(attributes.filter(|name| !name.is_empty()).collect::<BTreeSet<_>>(), described);
}

/// docs/check.md has every kind of finding, and the keys of the report.
#[test]
fn the_findings_of_check_are_described() {
    let source = fs::read_to_string(super::root().join("src/check/finding/kind.rs")).unwrap();
    let kinds = source.split(" => \"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned());
    assert_eq!(names("docs/check.md", "Findings", "kind"), kinds.collect());
    let folder = small_atlas();
    super::move_point(&folder.path().join("output/e/points.csv"), "1,1,1,1,4,");
    let (code, out, err) = run(folder.path(), &["check", "--against", "output", "--report", "json"]);
    assert_eq!(code, 1, "{out}{err}");
    let report: Value = serde_json::from_str(&out).unwrap();
    let page = document("docs/check.md");
    let item = page.prose.iter().find(|prose| prose.text.starts_with("- `json`")).unwrap();
    let described: BTreeSet<String> = item.codes().into_iter().collect();
    let finding = report["findings"].as_array().unwrap().iter().find(|finding| finding["file"].is_null()).unwrap();
    for key in keys(&report) {
        assert!(described.contains(&key), "{key}: {}", item.text);
    }
    let row = page.prose.iter().find(|prose| prose.text.starts_with("| `moved` |")).unwrap();
    let values: BTreeSet<String> = row.codes().into_iter().chain(described).chain(["apart".to_owned()]).collect();
    for key in keys(finding) {
        assert!(values.contains(&key), "{finding}: {key}");
    }
}
