//! Numbers in the documents that the program computes.

use std::collections::BTreeSet;
use std::fs;

use tempfile::TempDir;

use super::commands::run_line;
use super::{document, root};
use crate::support::command::run;
use crate::support::plan::plan;
use crate::support::table::{Row, rows};

fn text(name: &str) -> String {
    let text = fs::read_to_string(root().join(name)).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn assert_states(name: &str, statement: &str) {
    assert!(text(name).contains(statement), "{name} does not state: {statement}");
}

/// The figures of the thesis are four families of atlas.toml; the others are rounded down.
#[test]
fn this_atlas_has_the_stated_size() {
    let plan = plan(&fs::read_to_string(root().join("atlas.toml")).unwrap());
    let count = |is_counted: &dyn Fn(&str) -> bool| -> usize {
        plan.families.iter().map(|planned| &planned.family).filter(|f| is_counted(&f.id)).map(|f| f.cell_count()).sum()
    };
    let is_figure = |id: &str| ["evans", "chebyshev", "watt", "roberts"].contains(&id);
    let (figures, others) = (count(&is_figure), count(&|id| !is_figure(id)));
    let statement = format!("the {figures} figures of Natesan's thesis and {} more linkages", others / 100 * 100);
    assert_states("README.md", &statement);
    assert_states("docs/verification.md", &format!("Every sample of the {figures} figures"));
}

/// The manifest of README.md, and its page.
#[test]
fn the_four_bar_of_the_readme_is_a_page() {
    let readme = document("README.md");
    let [block] = readme.blocks.iter().filter(|block| block.language == "toml").collect::<Vec<_>>()[..] else {
        panic!("one manifest")
    };
    assert_eq!(block.text.lines().count(), 5);
    assert_states("README.md", "## A four-bar in five lines");
    let plan = plan(&block.text);
    assert_eq!(plan.families[0].family.cell_count(), 6);
    assert_states("README.md", "six of them make a page");
    let lines = fs::read_to_string(root().join("README.md")).unwrap().lines().count();
    assert!(lines <= 60, "{lines} lines are more than one screen");
}

/// The order of its cells if they are sorted, and which of them have no straight portion.
#[test]
fn the_sorted_panels_are_as_described() {
    let readme = document("README.md");
    let block = readme.blocks.iter().find(|block| block.language == "toml").unwrap();
    let folder = crate::support::command::folder_with(&format!("{}sort = \"-straight_length\"\n", block.text));
    crate::support::command::printed(folder.path(), &["render", "-q", "--format", "svg", "-o", "out"]);
    let page = fs::read_to_string(folder.path().join("out/mine/mine-001.svg")).unwrap();
    let mut cells: Vec<&str> =
        page.split("class=\"curve\" data-cell=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    cells.dedup();
    assert_states("docs/reading.md", &format!("has the cells {}, of which the last three have no", cells.join(", ")));
    let table = fs::read_to_string(folder.path().join("out/mine/cells.csv")).unwrap();
    let rows = rows(&table);
    let straight = rows.iter().filter(|row| !row["straight_length"].is_empty());
    let straight: BTreeSet<String> = straight.map(|row| row["cell"].clone()).collect();
    assert_eq!(straight, cells[..3].iter().map(|cell| (*cell).to_owned()).collect());
}

/// The first result of the tutorial's search by numbers.
#[test]
fn the_search_of_the_tutorial_finds_the_stated_curve() {
    let folder = TempDir::new().unwrap();
    let example = fs::read_to_string(root().join("examples/hrones-nelson.toml")).unwrap();
    let condition = "where = \"(is_crank_rocker or is_change_point) and mu_worst_deg >= 40 and straight_length > 1.9\"\n\
                     measures = [\"straight_length\", \"straight_input_deg\"]\nsort = \"-straight_length\"";
    let search = example
        .replace("where = \"is_crank_rocker or is_change_point\"", condition)
        .replace("layout = \"coupler-grid\"", "")
        .replace("scale = \"20 mm\"", "")
        .replace("../target/hrones-nelson", "found");
    fs::write(folder.path().join("search.toml"), search).unwrap();
    assert_eq!(run(folder.path(), &["render", "search.toml", "-q"]).0, 0);
    let cells = fs::read_to_string(folder.path().join("found/hrones-nelson/cells.csv")).unwrap();
    let rows = rows(&cells);
    let number = |row: &Row, name: &str| row[name].parse::<f64>().unwrap_or(0.0);
    let length = |row: &Row| number(row, "straight_length");
    let best = rows.iter().max_by(|a, b| length(a).total_cmp(&length(b))).unwrap();
    let statement = format!(
        "The first result is cell {}, trace {}: A = {}, B = {}, C = {}, straight over {:.3} crank lengths and {:.1}°",
        best["cell"],
        best["trace"],
        best["A"],
        best["B"],
        best["C"],
        length(best),
        number(best, "straight_input_deg")
    );
    assert_states("docs/tutorial.md", &statement);
}

/// The files of a circuit that the atlas does not contain, and the size of the gallery's kernel.
#[test]
fn the_gallery_is_as_described() {
    let folder = TempDir::new().unwrap();
    super::put_manifests(folder.path());
    let name = "evans:1.1.1?circuit=2";
    let file = "evans-1-1-2-circuit-2.dxf";
    run_line(folder.path(), &format!("coupler-atlas export {name} --format dxf,csv -o curves/"), 0);
    assert!(folder.path().join("curves").join(file).is_file());
    assert_states(
        "docs/gallery.md",
        &format!("the second is `{name}`, also for the program, and its drawing `{file}`"),
    );
    let kernel = coupler_atlas::gallery::kernel_script().len();
    assert_states("docs/gallery.md", &format!("`kernel.js` {:.1} MB", kernel as f64 / 1e6));
}

/// The example of docs/pages.md is the group of a curve on the first page, shortened.
#[test]
fn the_example_of_a_page_is_on_it() {
    let page = fs::read_to_string(root().join("output/evans/evans-001.svg")).unwrap();
    let example = &document("docs/pages.md").blocks[0].text;
    let plain = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = plain(&page);
    let mut rest = &page[..];
    for part in plain(example).split('…').map(str::trim) {
        let at = rest.find(part).unwrap_or_else(|| panic!("{part} is not on the page"));
        rest = &rest[at + part.len()..];
    }
}

/// Statements with the value of a constant in place of `@`.
const CONSTANTS: [(&str, &str, &str, &str); 30] = [
    (
        "manifest",
        "| cells of a family | @, or its `limit` |",
        "coupler-curves/src/family/parameter_space.rs",
        "MAX_CELLS",
    ),
    (
        "manifest",
        "`limit` | the greatest number of cells; default: @ |",
        "coupler-curves/src/family/parameter_space.rs",
        "MAX_CELLS",
    ),
    ("manifest", "| cells of all families, to be drawn | @ |", "coupler-manifest/src/cells.rs", "MAX_DRAWN_CELLS"),
    (
        "manifest",
        "| cells of a family for [`sweep`](scale.md) | @, if",
        "coupler-manifest/src/parameter_sets.rs",
        "MAX_LIMIT",
    ),
    ("scale", "draws atlases of up to @ cells", "coupler-manifest/src/cells.rs", "MAX_DRAWN_CELLS"),
    ("scale", "up to @ in a family (`limit`)", "coupler-manifest/src/parameter_sets.rs", "MAX_LIMIT"),
    (
        "manifest",
        "| 8 MiB, and @ values, tables and lists |",
        "coupler-manifest/src/document.rs",
        "MAX_MANIFEST_VALUES",
    ),
    ("manifest", "traced points of each | @ |", "coupler-manifest/src/cells.rs", "MAX_CHECKED_VALUES"),
    ("manifest", "| a table of cases | @ MB, and", "../src/manifest_files/case_rows.rs", "MAX_TABLE_BYTES"),
    ("manifest", "MB, and @ values |", "../src/manifest_files/case_rows.rs", "MAX_VALUES"),
    ("manifest", "| names of all families | @ |", "coupler-manifest/src/cells.rs", "MAX_NAMES"),
    ("manifest", "| files of pages of all families | @ |", "coupler-manifest/src/cells.rs", "MAX_PAGE_FILES"),
    ("manifest", "| cells in a book | @ |", "coupler-manifest/src/cells.rs", "MAX_BOOK_CELLS"),
    ("manifest", "samples, joints and curves | @ MB |", "coupler-curves/src/motion/limits.rs", "MAX_CIRCUIT_BYTES"),
    ("manifest", "would take more than @ MB, because", "coupler-curves/src/motion/limits.rs", "MAX_CIRCUIT_BYTES"),
    ("manifest", "| samples of a circuit | @ |", "coupler-curves/src/motion/limits.rs", "MAX_SAMPLES"),
    (
        "manifest",
        "| points in one grid of a joint | @ |",
        "coupler-curves/src/linkage_format/joint_values.rs",
        "MAX_GRID_POINTS",
    ),
    ("manifest", "| dyads of a linkage | @ |", "coupler-curves/src/linkage/assembly_mode.rs", "MAX_DYADS"),
    ("manifest", "with `circuits = \"all\"` | @ |", "coupler-curves/src/motion/limits.rs", "MAX_ASSEMBLY_MODES"),
    ("manifest", "if its pages would take more than @ MB", "../src/output/book/mod.rs", "MAX_VOLUME_BYTES"),
    (
        "manifest",
        "Of more than @ problems in a manifest",
        "coupler-curves/src/linkage_format/toml_parser.rs",
        "MAX_PROBLEMS",
    ),
    ("output", "more than @ are in subfolders of @,", "../src/pipeline/mod.rs", "PAGES_PER_FOLDER"),
    ("check", "of a family with more than @, the worst of them", "../src/check/mod.rs", "MAX_FINDINGS"),
    ("check", "up to @ of the worst", "../src/cli/check/overlays.rs", "MAX_CURVES"),
    ("gallery", "A piece has at most @ MB", "../src/gallery/pieces.rs", "MAX_PIECE_BYTES"),
    ("gallery", "up to @ MB of data, everything", "../src/gallery/pieces.rs", "MAX_SINGLE_FILE_BYTES"),
    ("gallery", "up to @ points of each curve", "../src/gallery/family_script.rs", "MAX_POINTS"),
    (
        "manifest",
        "format = @ # version of the manifest language",
        "coupler-manifest/src/format_version.rs",
        "FORMAT_VERSION",
    ),
    ("measures", "polynomials of degree # in a parameter", "coupler-curves/src/geometry/chebyshev.rs", "TERMS"),
    ("check", "an object with `format` (@)", "../src/cli/check/json.rs", "FORMAT"),
];

/// A number with a comma before each group of three digits.
fn grouped(number: usize) -> String {
    match number {
        0..1000 => number.to_string(),
        _ => format!("{},{:03}", grouped(number / 1000), number % 1000),
    }
}

#[test]
fn limits_are_those_of_the_sources() {
    for (name, statement, file, constant) in CONSTANTS {
        let source = fs::read_to_string(root().join("crates").join(file)).unwrap();
        let value = source.split(&format!("const {constant}: ")).nth(1).unwrap_or_else(|| panic!("{file}: {constant}"));
        let value = value.split('=').nth(1).unwrap().split(';').next().unwrap().trim().replace('_', "");
        let value: usize = value.parse().unwrap();
        let stated = if statement.contains("@ MB") { (value / 1_000_000).to_string() } else { grouped(value) };
        // A polynomial has a term more than its degree.
        let statement = statement.replace('@', &stated).replace("degree #", &format!("degree {}", value - 1));
        assert_states(&format!("docs/{name}.md"), &statement);
    }
    let mebibytes = coupler_atlas::manifest::MAX_MANIFEST_BYTES >> 20;
    assert_states("docs/manifest.md", &format!("| the length of a manifest | {mebibytes} MiB,"));
}
