//! The examples in TOML are valid: whole manifests, parts of them, and single values in prose.

use std::path::Path;

use coupler_atlas::manifest::{self, CaseTable, DesignRequest, FileProblem, Files, RowPlaces, WishPlace};
use coupler_atlas::manifest_files::ManifestFiles;
use coupler_curves::problem::report;
use coupler_curves::template::Template;
use coupler_drawing::scene::{FontFamily, Typeface};

use super::text::Block;
use super::{document, documents, root};

/// What the parser finds wrong with a manifest.
fn problems(text: &str) -> String {
    let loaded = manifest::parse_with_files(text, Some(&Tables));
    assert!(loaded.plan.is_some() || !loaded.problems.is_empty());
    report(&loaded.problems, "example", text, false)
}

/// The table of docs/manifest.md under any name.
struct Tables;

impl Files for Tables {
    fn font(&self, _: &str) -> Result<Vec<u8>, String> {
        Ok(Typeface::from(FontFamily::Sans).regular().bytes().to_vec())
    }

    fn cases(&self, _: &str, _: usize, _: &mut dyn FnMut(FileProblem)) -> Option<CaseTable> {
        let page = document("docs/manifest.md");
        let block = page.blocks.iter().find(|block| block.language == "text").unwrap();
        let rows: Vec<Vec<&str>> = block.text.lines().map(|line| line.split(',').collect()).collect();
        let names = rows[0].iter().map(|name| (*name).to_owned()).collect();
        let values = rows[1..].iter().flatten().map(|value| value.parse().unwrap()).collect();
        Some(CaseTable { names, values, count: rows.len() - 1, digest: String::new(), rows: RowPlaces::Numbered })
    }

    fn designs(
        &self,
        template: &Template,
        request: &DesignRequest,
        report: &mut dyn FnMut(WishPlace, FileProblem),
    ) -> Option<CaseTable> {
        ManifestFiles::new(Path::new("")).designs(template, request, report)
    }
}

const ATLAS: &str = "[atlas]\ntitle = \"T\"\n";
const FAMILY: &str = "[[family]]\nid = \"f\"\nlinkage = \"evans\"\ncases = [{ p = 2, a = 2.5 }]\n";
const LINKAGE: &str = "[[linkage]]\nid = \"mine\"\ntrace = [\"M\"]\n";
const JOINTS: &str = "[linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = [4, 0] }\nA = { crank = \"O\", length = 1 }\n\
                      B = { dyad = [\"A\", \"C\"], lengths = [3, 3.5], side = \"left\" }\nM = { point = [\"A\", \"B\"], along = 1 }\n";

#[test]
fn every_block_is_a_manifest_or_a_part_of_one() {
    let mut count = 0;
    for document in documents() {
        let is_manifest = |block: &&Block| block.language == "toml" && !block.text.starts_with(DEPENDENCIES);
        for block in document.blocks.iter().filter(is_manifest) {
            let mut text = block.text.clone();
            if !text.contains("[atlas]") && !text.contains("atlas.title") {
                text = format!("{ATLAS}{text}");
            }
            if !text.contains("[[family]]") {
                text += FAMILY;
            }
            let found = problems(&text);
            assert!(found.is_empty(), "{}:{}: {found}", document.name, block.line);
            count += 1;
        }
    }
    assert!(count >= 4, "only {count} blocks were found");
}

/// How a block begins that is of a reader's `Cargo.toml`.
const DEPENDENCIES: &str = "[dependencies]\n";

/// The libraries that docs/start.md depends on are in the folders of a clone that it names.
#[test]
fn the_libraries_are_where_they_are_said_to_be() {
    let page = document("docs/start.md");
    let block = page.blocks.iter().find(|block| block.text.starts_with(DEPENDENCIES)).unwrap();
    for line in block.text.lines().skip(1) {
        let (name, rest) = line.split_once(" = { path = \"../coupler-atlas/").unwrap();
        let path = rest.strip_suffix("\" }").unwrap();
        let package = std::fs::read_to_string(root().join(path).join("Cargo.toml")).unwrap();
        assert!(package.contains(&format!("name = \"{name}\"\n")), "{path} is not {name}");
        assert!(page.blocks.iter().any(|block| block.text.contains(&name.replace('-', "_"))), "{name} is not used");
    }
}

/// A linkage by its drawing, without its input, and with further links.
fn drawing(links: &str) -> String {
    format!(
        r#"[[linkage]]
id = "mine"
trace = ["B"]
[linkage.drawing]
joints = {{ O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.4, 2.6], S = [7, 0], P = [5, 0], Q = [9, 0] }}
frame = ["O", "C", "P", "Q"{}]
links = [["O", "A"], ["A", "B"], ["B", "C"]{links}]
"#,
        if links.is_empty() { ", \"S\"" } else { "" }
    )
}

/// Manifests with a place, marked by `@`, for an example.
fn places() -> Vec<String> {
    let grid = "[[family]]\nid = \"f\"\nlinkage = \"evans\"\nlet = { a = \"(1 + p)^1.5 / 2\" }\n";
    let chart = "layout = \"chart\"\ngrid = { p = [2, 3], k = [1.5, 2] }\n";
    let mine = "[[family]]\nid = \"m\"\nlinkage = \"mine\"\ncases = [{}]\n";
    let geared = "[[family]]\nid = \"g\"\nlinkage = \"geared-five-bar\"\n";
    vec![
        format!("{ATLAS}[page]\n@\n{FAMILY}"),
        format!("{ATLAS}{FAMILY}[book]\n@\n"),
        format!("{ATLAS}{FAMILY}@\n"),
        format!("{ATLAS}[[family]]\nid = \"f\"\nlinkage = \"evans\"\n@\n"),
        format!("{ATLAS}{grid}grid = {{ p = @ }}\n"),
        format!("{ATLAS}{grid}grid = {{ k = @, p = 2 }}\n"),
        format!("{ATLAS}{grid}{chart}@\n"),
        format!("{ATLAS}{grid}grid = {{ p = 2 }}\nposes = [[0, 0, 0]]\n@\n"),
        format!("{ATLAS}{grid}grid = {{ p = [2, 3] }}\nchart = {{ x = \"p\", y = [\"straight_length\"] }}\n@\n"),
        format!("{ATLAS}{grid}{chart}chart = {{ x = \"p\", y = [\"straight_length\"], @ }}\n"),
        format!("{ATLAS}{grid}{chart}chart = {{ x = \"straight_deviation\", y = [\"mu_min_deg\"], @ }}\n"),
        format!("{ATLAS}{grid}{chart}chart = {{ x = \"input_deg\", y = [\"speed\"], @ }}\n"),
        format!("{ATLAS}{grid}grid = {{ p = [2, 3] }}\n@\n"),
        format!("{ATLAS}{geared}grid = {{ @ }}\n"),
        format!("{ATLAS}{mine}{LINKAGE}@\n{JOINTS}"),
        format!("{ATLAS}{mine}{}@\n", drawing("")),
        format!("{ATLAS}{mine}{}input = \"O A\"\n@\n", drawing("")),
        format!("{ATLAS}{mine}{}input = \"O A\"\n@\n", drawing(", [\"B\", \"S\"]")),
        format!("{ATLAS}{mine}{}slides = {{ S = [\"P\", \"Q\"] }}\n@\n", drawing(", [\"B\", \"S\"]")),
        format!("{ATLAS}{}{LINKAGE}{JOINTS}", mine.replace("cases = [{}]", "@")),
        format!(
            "{ATLAS}[[family]]\nid = \"h\"\nlinkage = \"h\"\n@\ngrid = {{ A = 2.5, B = 3, C = 3 }}\n{}",
            grid_of_points()
        ),
    ]
}

/// The linkage of the atlas of Hrones and Nelson, whose points lie on a grid.
fn grid_of_points() -> String {
    let text = include_str!("../../../examples/hrones-nelson.toml");
    let linkage = &text[text.find("[[linkage]]").unwrap()..];
    linkage.replace("fifty-points", "h")
}

/// Examples that are not TOML by themselves: kinds of joints, which `readme.rs` builds, and names of keys without values.
const NOT_EXAMPLES: [&str; 4] =
    ["parameters = { … }", "input = { from, to }", "arc = { from, to, branch }", "{ slot = [\"C\", \"A\"] }"];

#[test]
fn examples_in_prose_are_valid() {
    let places = places();
    let (mut count, mut left_out) = (0, Vec::new());
    for document in documents() {
        for prose in &document.prose {
            for code in prose.codes() {
                let is_setting = code
                    .split_once(" = ")
                    .is_some_and(|(key, _)| key.chars().all(|c| c.is_ascii_lowercase() || c == '_'));
                let is_table = code.starts_with("{ ");
                let is_joint = prose.table.as_ref().is_some_and(|table| table.starts_with("| joint |"));
                if !(is_setting || is_table) || is_joint {
                    continue;
                }
                if NOT_EXAMPLES.contains(&code.as_str()) {
                    left_out.push(code);
                    continue;
                }
                let found: Vec<String> = places.iter().map(|place| problems(&place.replace('@', &code))).collect();
                let least = found.iter().min_by_key(|found| found.len()).unwrap();
                assert!(least.is_empty(), "{}:{}: {code}: {}", document.name, prose.line, found.concat());
                count += 1;
            }
        }
    }
    assert!(count >= 20, "only {count} examples were found");
    left_out.sort();
    let mut listed = NOT_EXAMPLES;
    listed.sort();
    assert_eq!(left_out, listed);
}
