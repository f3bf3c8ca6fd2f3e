//! The unit of lengths, and the scale of pages.

use std::fs;

use crate::support::command::{folder_with, printed, run};

/// A manifest with a family of two four-bars with lengths of about 100.
fn manifest(atlas: &str, page: &str, family: &str) -> String {
    format!(
        "[atlas]\ntitle = \"T\"\n{atlas}\n[page]\n{page}\n[[family]]\nid = \"f\"\nlinkage = \"four-bar\"\n{family}\n\
         sampling = {{ samples = 24 }}\ncases = [{{ frame = 100, crank = 30, coupler = 80, rocker = 90, along = 40, across = 30 }},\n\
         {{ frame = 200, crank = 30, coupler = 170, rocker = 90, along = 40, across = 30 }}]\n"
    )
}

/// The pages of its family in SVG.
fn pages(manifest: &str) -> Vec<String> {
    let folder = folder_with(manifest);
    printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    let page = |k: usize| fs::read_to_string(folder.path().join(format!("out/f/f-{k:03}.svg")));
    (1..).map_while(|k| page(k).ok()).collect()
}

/// The values of an attribute.
fn values<'s>(svg: &'s str, attribute: &str) -> Vec<&'s str> {
    let value = |rest: &'s str| rest.split('"').next().unwrap();
    svg.split(&format!(" {attribute}=\"")).skip(1).map(value).collect()
}

#[test]
fn a_ratio_is_that_of_lengths_on_paper_to_those_of_the_linkage() {
    for (unit, scale, millimetres) in
        [("mm", "1:1", 1.0), ("mm", "1:2.5", 0.4), ("cm", "1:10", 1.0), ("in", "1:50", 0.508)]
    {
        let atlas = format!("unit = \"{unit}\"");
        // On a grid the curves are not drawn apart, enlarged.
        let family = format!("scale = \"{scale}\"\nlayout = \"coupler-grid\"");
        for svg in pages(&manifest(&atlas, "paper = \"A3\"", &family)) {
            for found in values(&svg, "data-scale") {
                assert!((found.parse::<f64>().unwrap() - millimetres).abs() < 1e-12, "{unit} {scale}: {found}");
            }
            assert!(
                !values(&svg, "data-scale").is_empty() && values(&svg, "data-unit").iter().all(|found| *found == unit)
            );
            let lengths = if unit == "in" { "inches" } else { unit };
            assert!(svg.contains(&format!(">scale {scale}, lengths in {lengths}<")), "{unit} {scale}");
        }
    }
}

#[test]
fn the_unit_of_a_family_is_in_its_files_and_changes_no_number() {
    let with_unit = |atlas: &str, family: &str| {
        let folder = folder_with(&manifest(atlas, "", family));
        printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
        let [run, points, cells] = ["run.json", "f/points.csv", "f/cells.csv"]
            .map(|file| fs::read_to_string(folder.path().join("out").join(file)).unwrap());
        let manifest = folder.path().join("atlas.toml");
        let json =
            printed(folder.path(), &["export", manifest.to_str().unwrap(), "f:1.1.1", "--format", "json", "-o", "-"]);
        (run, json, points, cells)
    };
    let (run, json, points, cells) = with_unit("unit = \"cm\"", "unit = \"m\"");
    assert!(run.contains("\"unit\": \"m\"") && json.contains("\"unit\": \"m\""));
    let (run, json, points_without, cells_without) = with_unit("", "");
    assert!(!run.contains("\"unit\"") && !json.contains("\"unit\""));
    assert!(points == points_without && cells == cells_without);
}

#[test]
fn what_does_not_fit_is_an_error_whose_remedies_fit() {
    for (atlas, scale) in
        [("unit = \"mm\"", "scale = \"1:1\""), ("", "scale = \"0.8 mm\""), ("unit = \"cm\"", "scale = \"1:8\"")]
    {
        for family in [format!("{scale}\npanels = [2, 1]"), format!("{scale}\nlayout = \"coupler-grid\"")] {
            let text = manifest(atlas, "paper = \"a4\"", &family);
            let folder = folder_with(&text);
            let (code, _, error) = run(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
            assert_eq!(code, 2, "{error}");
            assert_eq!(run(folder.path(), &["validate", "atlas.toml"]).2, error);
            assert!(error.contains("the linkages of `f` do not fit") && error.contains("atlas.toml"), "{error}");
            // `help: write A, B in [page], or C`
            let help = error.lines().find_map(|line| line.split_once("help: write ")).unwrap().1;
            let remedies: Vec<&str> = help.split(", or ").flat_map(|part| part.split(", paper")).collect();
            assert!(!remedies.is_empty());
            assert!(help.contains("scale = \""), "{help}");
            for remedy in help.replace(", or ", "\n").replace(", paper", "\npaper").lines() {
                let text = match remedy.strip_suffix(" in [page]") {
                    Some(keys) => {
                        let keys = keys.replace(", orientation", "\norientation");
                        let paper = if keys.contains("paper") { "" } else { "paper = \"a4\"\n" };
                        manifest(atlas, &format!("{paper}{keys}"), &family)
                    }
                    None if remedy.starts_with("scale") => text.replace(scale, remedy),
                    None => text.replace("panels = [2, 1]", remedy),
                };
                assert!(pages(&text).iter().all(|svg| !svg.contains("reduced")), "{remedy}");
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_found_also_where_there_is_only_a_book() {
    let text = manifest("unit = \"mm\"\nformats = [\"pdf\"]", "paper = \"a4\"", "scale = \"1:1\"\npanels = [2, 1]");
    for book in ["", "[book]\nbinding = \"20 mm\"\n"] {
        let folder = folder_with(&format!("{text}{book}"));
        let error = run(folder.path(), &["validate", "atlas.toml"]).2;
        assert!(error.contains("the linkages of `f` do not fit"), "{error}");
        assert_eq!(run(folder.path(), &["render", "-q", "-o", "out"]).2, error);
    }
}

#[test]
fn a_ratio_needs_a_unit_and_two_numbers() {
    for (atlas, scale, message) in [
        ("", "1:2", "this scale needs the unit of the lengths"),
        ("unit = \"mm\"", "1:", "a scale has a number before the colon, and one after it"),
        ("unit = \"mm\"", "0:1", "a scale has a number before the colon, and one after it"),
        ("unit = \"mm\"", "-1:2", "a scale has a number before the colon, and one after it"),
        ("unit = \"mm\"", "1:1e9", "mm to a unit"),
        ("unit = \"mm\"", "1 / 2", "help: write scale = \"1:2\""),
        ("unit = \"furlong\"", "1:2", "`furlong` is not one of the words allowed here"),
    ] {
        let folder = folder_with(&manifest(atlas, "", &format!("scale = \"{scale}\"")));
        let (code, _, error) = run(folder.path(), &["validate"]);
        assert!(code == 2 && error.contains(message), "{error}");
    }
}

#[test]
fn papers_are_named_in_any_case_and_turned() {
    for (page, [width, height]) in [
        ("paper = \"A4\"", ["297", "210"]),
        ("paper = \"A4\"\norientation = \"portrait\"", ["210", "297"]),
        ("paper = \"A6\"", ["148", "105"]),
        ("paper = \"Letter\"\norientation = \"landscape\"", ["279.4", "215.9"]),
        ("paper = { width = \"100 mm\", height = \"200 mm\" }\norientation = \"landscape\"", ["200", "100"]),
        ("orientation = \"portrait\"", ["279.4", "431.8"]),
    ] {
        for svg in pages(&manifest("", page, "")) {
            let size = [width, height].map(|side| format!("{side}mm"));
            assert_eq!([values(&svg, "width")[0], values(&svg, "height")[0]], size, "{page}");
        }
    }
}
