//! README.md and docs/*.md: their commands are run, their transcripts, examples, tables and numbers compared with the
//! program, and the files that they name exist.

mod commands;
mod files;
mod four_bar;
mod linkages;
mod manifests;
mod numbers;
mod tables;
mod text;
mod transcripts;

use std::fs;
use std::path::{Path, PathBuf};

use text::Document;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// README.md and all of docs.
fn documents() -> Vec<Document> {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    paths.push(root().join("README.md"));
    paths.sort();
    assert!(paths.len() > 10);
    let name = |path: &Path| path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
    paths.iter().map(|path| Document::parse(name(path), &fs::read_to_string(path).unwrap())).collect()
}

fn document(name: &str) -> Document {
    documents().into_iter().find(|document| document.name == name).unwrap()
}

/// What a command that succeeds prints.
fn printed(arguments: &[&str]) -> String {
    crate::support::command::printed(root(), arguments)
}

/// Copies what is below a folder.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let copied = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy(&entry.path(), &copied),
            false => drop(fs::copy(entry.path(), copied).unwrap()),
        }
    }
}

/// Puts into a folder what the documents presuppose: the manifests of this repository. Those of the examples keep a
/// few linkages, which are the cells that they are among all.
fn put_manifests(folder: &Path) {
    fs::copy(root().join("atlas.toml"), folder.join("atlas.toml")).unwrap();
    copy(&root().join("examples"), &folder.join("examples"));
    for name in ["examples/hrones-nelson.toml", "examples/hrones-nelson-fine.toml"] {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        let condition = "where = \"is_crank_rocker or is_change_point\"";
        assert_eq!(text.matches(condition).count(), 1, "{name}");
        let fewer = "where = \"(is_crank_rocker or is_change_point) and A == 2.5 and B == 3\"";
        fs::write(folder.join(name), text.replace(condition, fewer)).unwrap();
    }
}

/// Moves the point in the row of a table that begins with a text by 1e-8.
fn move_point(table: &Path, start: &str) {
    let text = fs::read_to_string(table).unwrap();
    let row = text.lines().find(|line| line.starts_with(start)).unwrap();
    let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
    cells[6] = (cells[6].parse::<f64>().unwrap() + 1e-8).to_string();
    fs::write(table, text.replacen(row, &cells.join(","), 1)).unwrap();
}
