//! Links lead somewhere, and the files that the documents name exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use super::text::Document;
use super::{documents, root};

/// Files that are named, but not in this repository, and why.
const ABSENT: [(&str, &str); 27] = [
    (".github/workflows/atlas.yml", "docs/check.md: to be written by the reader"),
    (".pre-commit-config.yaml", "docs/check.md: to be written by the reader"),
    ("feeder.toml", "docs/tutorial.md: written by the reader"),
    ("feeder/", "docs/tutorial.md: rendered by the reader"),
    ("curves.toml", "docs/tutorial.md: exported by the reader; `commands.rs` does"),
    ("target/hrones-nelson/index.html", "docs/tutorial.md: rendered by the reader; `commands.rs` does"),
    ("mine.toml", "README.md: written by the reader"),
    ("mine/mine/mine-001.svg", "README.md: rendered by the reader; `commands.rs` does"),
    ("mine/index.html", "README.md: rendered by the reader; `commands.rs` does"),
    ("coupler-atlas-VERSION-TARGET.tar.gz", "docs/releases.md: a file of a release; `.ci/workflows` makes one"),
    ("coupler_atlas-VERSION.tar.gz", "docs/releases.md: a file of a release; `.ci/sdist` makes one"),
    ("ghcr.io/coupler-atlas/coupler-atlas", "docs/releases.md: an image"),
    ("atlas.pdf", "a book, which this atlas does not ask for"),
    (".coupler-atlas.journal", "only there during a run"),
    ("FAMILY/1001-2000/FAMILY-1234.svg", "more pages than any family here has; `ownership.rs` renders such a family"),
    ("FAMILY/cells-00003-of-00064.parquet", "written by the reader; `shards.rs` sweeps"),
    ("FAMILY/points-00003-of-00064.parquet", "written by the reader; `shards.rs` sweeps"),
    ("FAMILY/gallery-table-0001.js", "more data than any family here has"),
    ("FAMILY/gallery-curves-0001.js", "more data than any family here has"),
    ("evans-3-1-1.dxf", "the name of an exported file"),
    ("evans-1-1-2-circuit-2.dxf", "the name of an exported file; `numbers.rs` exports it"),
    // The examples of the recipes in docs/architecture.md, which were not kept.
    ("measure/centroid.rs", "a recipe"),
    ("catalogue/cardan.toml", "a recipe"),
    ("exchange/xyz.rs", "a recipe"),
    ("crates/coupler-drawing/src/render/txt.rs", "a recipe"),
    ("src/cli/units.rs", "a recipe"),
    ("1.2", "docs/export.md: the number of a curve"),
];

/// The paths of all files and folders, from the root, those of folders with a slash at the end.
fn tree(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.path().strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
        if [".git", "target"].contains(&name.as_str()) {
            continue;
        }
        if entry.path().is_dir() {
            tree(&entry.path(), found);
            found.insert(format!("/{name}/"));
        } else {
            found.insert(format!("/{name}"));
        }
    }
}

/// The files of the atlas that its record lists, whether they are there or made by the first command of README.md.
fn recorded() -> BTreeSet<String> {
    let record = fs::read(root().join("output/run.json")).unwrap();
    let record: serde_json::Value = serde_json::from_slice(&record).unwrap();
    let mut paths = BTreeSet::from(["/output/images.json".to_owned()]);
    paths.insert(format!("/output/{}", record["gallery"]["name"].as_str().unwrap()));
    for family in record["families"].as_array().unwrap() {
        let name = |file: &serde_json::Value| file["name"].as_str().unwrap().to_owned();
        let files = family["files"].as_array().unwrap().iter().map(name);
        paths.extend(files.map(|file| format!("/output/{}/{file}", family["id"].as_str().unwrap())));
    }
    paths
}

/// Whether a text is a path: of a folder, or of a file with an extension.
fn is_path(text: &str) -> bool {
    let is_name = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
    let extensions = "rs md toml lock mjs js sh py gz dict html csv json svg png pdf dxf yml yaml txt journal";
    let extension = text.rsplit_once('.').map_or("", |(_, extension)| extension);
    let is_number = text.parse::<f64>().is_ok();
    text.chars().all(is_name)
        && text.len() > 1
        && (text.contains('/') || is_number || extensions.split(' ').any(|other| other == extension))
}

#[test]
fn named_files_exist() {
    let mut paths = recorded();
    tree(root(), &mut paths);
    let (mut count, mut absent) = (0, BTreeSet::new());
    for document in documents() {
        for prose in &document.prose {
            for code in prose.codes().into_iter().filter(|code| is_path(code)) {
                // A numeric value of a table or of prose.
                if code.parse::<f64>().is_ok() && !ABSENT.iter().any(|(name, _)| *name == code) {
                    continue;
                }
                if ABSENT.iter().any(|(name, _)| *name == code) {
                    absent.insert(code);
                    continue;
                }
                let name = format!("/{}", code.replace("FAMILY", "evans").trim_end_matches('/'));
                let is_there = paths.iter().any(|path| {
                    path.ends_with(&name) || path.strip_suffix('/').is_some_and(|path| path.ends_with(&name))
                });
                assert!(is_there, "{}:{}: there is no {code}", document.name, prose.line);
                // Where a name begins with a folder of the root, it is a whole path.
                let top = format!("/{}/", name[1..].split('/').next().unwrap());
                assert!(
                    !name[1..].contains('/')
                        || !paths.contains(&top)
                        || root().join(&name[1..]).exists()
                        || paths.contains(&name),
                    "{}:{}: there is no {code}",
                    document.name,
                    prose.line
                );
                count += 1;
            }
        }
    }
    assert!(count > 100, "only {count} files were found");
    let listed: BTreeSet<String> = ABSENT.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(absent, listed);
}

/// The texts and targets of links and pictures.
fn links(text: &str) -> Vec<&str> {
    text.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()).collect()
}

/// The name by which a heading is linked to.
fn anchor(heading: &str) -> String {
    let heading = heading.to_lowercase().replace(' ', "-");
    heading.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
}

#[test]
fn links_lead_somewhere() {
    let mut all = documents();
    for name in ["CHANGELOG.md", "CONTRIBUTING.md"] {
        all.push(Document::parse(name.into(), &fs::read_to_string(root().join(name)).unwrap()));
    }
    let mut linked = BTreeSet::new();
    for document in &all {
        for prose in &document.prose {
            for target in links(&prose.text).into_iter().filter(|target| !target.starts_with("https://")) {
                let (path, heading) = target.split_once('#').unwrap_or((target, ""));
                let path = if path.is_empty() { &document.name["docs/".len()..] } else { path };
                let whole = root().join(&document.name).parent().unwrap().join(path);
                assert!(whole.exists(), "{}:{}: there is no {path}", document.name, prose.line);
                if !heading.is_empty() {
                    let page = Document::parse(path.into(), &fs::read_to_string(&whole).unwrap());
                    let is_there = page.prose.iter().any(|prose| anchor(&prose.section) == heading);
                    assert!(is_there, "{}:{}: there is no section {target}", document.name, prose.line);
                }
                linked.insert(path.rsplit('/').next().unwrap().to_owned());
            }
        }
    }
    // Every document can be reached.
    for document in &all {
        let name = document.name.rsplit('/').next().unwrap();
        assert!(linked.contains(name) || name == "README.md", "nothing leads to {name}");
    }
}

/// The contents have every page of docs once, in the order in which each leads to the next.
#[test]
fn the_contents_are_in_reading_order() {
    let contents = fs::read_to_string(root().join("docs/README.md")).unwrap();
    let items: Vec<(&str, &str)> = contents
        .lines()
        .filter_map(|line| line.strip_prefix("- [")?.split_once("]("))
        .map(|(title, rest)| (title, rest.split(')').next().unwrap()))
        .collect();
    let pages = documents().into_iter().filter_map(|document| Some(document.name.strip_prefix("docs/")?.to_owned()));
    let mut listed: Vec<&str> = items.iter().map(|(_, path)| *path).chain(["README.md"]).collect();
    listed.sort_unstable();
    assert_eq!(listed, pages.collect::<Vec<_>>());
    for (k, (title, path)) in items.iter().enumerate() {
        let page = fs::read_to_string(root().join("docs").join(path)).unwrap();
        assert_eq!(page.lines().next(), Some(&*format!("# {title}")), "{path}");
        let next = items.get(k + 1).map_or(String::new(), |(title, path)| format!(" · next: [{title}]({path})"));
        assert_eq!(page.lines().last(), Some(&*format!("[Contents](README.md){next}")), "{path}");
    }
}
