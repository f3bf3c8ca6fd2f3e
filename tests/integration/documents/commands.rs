//! Every command in the documents is run, or is listed here with the reason why not.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::text::{Document, codes};
use super::{copy, document, documents, printed, put_manifests};
use crate::support::command::{COMMANDS, run};

/// Commands with placeholders, shortened or presupposing something else: what is run instead, and with which exit code.
const SUBSTITUTED: [(&str, &[(&str, i32)]); 17] = [
    // There is an `atlas.toml`.
    ("coupler-atlas init", &[("coupler-atlas init new/atlas.toml", 0), ("coupler-atlas init", 2)]),
    ("coupler-atlas check [MANIFEST] --against DIR", &[("coupler-atlas check atlas.toml --against output", 0)]),
    (
        "coupler-atlas COMMAND --help",
        &[
            ("coupler-atlas render --help", 0),
            ("coupler-atlas validate --help", 0),
            ("coupler-atlas check --help", 0),
            ("coupler-atlas inspect --help", 0),
            ("coupler-atlas design --help", 0),
            ("coupler-atlas find --help", 0),
            ("coupler-atlas export --help", 0),
            ("coupler-atlas list --help", 0),
            ("coupler-atlas sweep --help", 0),
            ("coupler-atlas gather --help", 0),
            ("coupler-atlas import --help", 0),
            ("coupler-atlas init --help", 0),
            ("coupler-atlas completions --help", 0),
            ("coupler-atlas man --help", 0),
        ],
    ),
    // No crank-rocker does.
    (
        "coupler-atlas design four-bar --where \"output_swing_deg == 110 and is_crank_rocker and mu_worst_deg >= 50\" --effort quick",
        &[(
            "coupler-atlas design four-bar --where \"output_swing_deg == 110 and is_crank_rocker and mu_worst_deg >= 50\" --effort quick",
            2,
        )],
    ),
    ("coupler-atlas find PATH", &[("coupler-atlas find examples/sketch.svg", 0)]),
    ("coupler-atlas find --json", &[("coupler-atlas find examples/sketch.svg --json", 0)]),
    ("coupler-atlas list linkages NAME", &[("coupler-atlas list linkages evans", 0)]),
    // The other shards are to be made, too.
    (
        "coupler-atlas gather shards --top 100 --by -straight_length --toml best.toml",
        &[
            ("coupler-atlas gather shards --top 100 --by -straight_length", 2),
            ("coupler-atlas sweep atlas.toml --no-points -o whole", 0),
            ("coupler-atlas gather whole --top 100 --by -straight_length --toml best.toml", 0),
        ],
    ),
    (
        "coupler-atlas gather atlas",
        &[
            ("coupler-atlas gather atlas", 2),
            ("coupler-atlas render atlas.toml --shard 0/1 -o one", 0),
            ("coupler-atlas gather one", 0),
        ],
    ),
    // With another commit beside this one: readme.rs.
    ("coupler-atlas render ../before/atlas.toml -o ../before-atlas", &[]),
    ("coupler-atlas check atlas.toml --against ../before-atlas --summary --diff moved", &[]),
    ("coupler-atlas inspect --json", &[("coupler-atlas inspect evans p=2.5 a=3 --json", 0)]),
    ("coupler-atlas inspect --svg -", &[("coupler-atlas inspect evans p=2.5 a=3 --svg -", 0)]),
    ("coupler-atlas export", &[("coupler-atlas export evans:3.1.1", 0)]),
    // Several files need a folder.
    ("coupler-atlas export -o -", &[("coupler-atlas export evans:3.1.1 -o -", 0), ("coupler-atlas export -o -", 2)]),
    ("coupler-atlas export --linkage", &[("coupler-atlas export --linkage evans p=2.5 a=3", 0)]),
    // Every linkage of this atlas is assembled over its whole range, that of `gap.toml` nowhere.
    (
        "coupler-atlas render --strict",
        &[("coupler-atlas render --strict", 0), ("coupler-atlas render gap.toml --strict", 1)],
    ),
];

/// Commands that are not run, each with the reason.
const NOT_RUN: [(&str, &str); 20] = [
    ("coupler-atlas render --watch --open", "it runs until it is interrupted: watching.rs"),
    ("cargo test", "this is it"),
    ("cargo build --release", "builds the program, which has been built"),
    ("cargo bench", "takes minutes"),
    ("cargo bench --bench find", "takes minutes"),
    ("cargo bench --bench found", "takes minutes"),
    ("cargo bench --bench unseen", "takes minutes"),
    ("cargo install --locked --path .", "builds the program, which has been built"),
    (
        "cargo tree -p PACKAGE -e normal --prefix none | sed 's/ (\\*)$//' | sort -u | wc -l",
        "needs a shell; `architecture.rs` counts the same",
    ),
    ("cargo install", "what pre-commit does"),
    ("cargo binstall coupler-atlas", "needs a release; `.ci/workflows` compares the address with the archive"),
    ("cargo check --workspace", "needs Python's crates; `.ci/oldest-compiler` runs it"),
    ("cargo check", "builds what `.ci/fuzz` builds"),
    ("cargo deny", "`.ci/run` runs it where it is installed"),
    ("cargo yank", "withdraws a version"),
    ("cargo publish", "publishes; `.ci/packages` makes the packages"),
    ("cargo publish --workspace --locked", "publishes; `.ci/packages` makes the packages"),
    (".ci/packages test", "takes minutes; `.github/workflows/ci.yml` does"),
    (".ci/kernel update", "needs the target wasm32-unknown-unknown"),
    ("node benches/gallery.mjs BEFORE AFTER", "needs Node.js and Chromium"),
];

/// Files that the documents say commands have written.
const WRITTEN: [(&str, &[&str]); 7] = [
    ("README.md", &["output/index.html", "mine/index.html", "mine/mine/mine-001.svg", "found/index.html"]),
    ("docs/check.md", &["report.xml"]),
    ("docs/export.md", &["evans.dxf", "curves/evans-3-1-1.svg", "curves/watt-14-1-1.csv"]),
    ("docs/manifest.md", &["coupler-atlas.schema.json"]),
    (
        "docs/start.md",
        &["output/index.html", "target/hrones-nelson/atlas.pdf", "target/hrones-nelson/hrones-nelson/points.csv"],
    ),
    ("docs/scale.md", &["shards/evans/cells-00003-of-00064.parquet", "best/index.html", "one/run.json"]),
    (
        "docs/tutorial.md",
        &[
            "target/hrones-nelson/index.html",
            "curve-94/hrones-nelson-94-49-1.dxf",
            "curve-94/curves.toml",
            "feeder/index.html",
        ],
    ),
];

/// A text as a command, if it is one, with the program by its name.
fn command(text: &str) -> Option<String> {
    let text = text.split(" #").next().unwrap().trim();
    let text =
        text.strip_prefix("$ ").or(text.strip_prefix("- run: ")).or(text.strip_prefix("entry: ")).unwrap_or(text);
    if let Some(arguments) = text.strip_prefix("cargo run --release -- ") {
        return Some(format!("coupler-atlas {arguments}"));
    }
    let mut words = text.split(' ');
    let (first, second) = (words.next().unwrap(), words.next()?);
    match first {
        "coupler-atlas" | "cargo" | "node" => Some(text.to_owned()),
        // A key of a manifest.
        _ if second == "=" => None,
        // A statement of Python.
        "import" if second.chars().all(|c| c.is_alphanumeric() || c == '_') || text.contains(" as ") => None,
        _ if COMMANDS.contains(&first) => Some(format!("coupler-atlas {text}")),
        _ if first.starts_with(".ci/") || first.starts_with("benches/") => Some(text.to_owned()),
        _ => None,
    }
}

/// The commands of a document with the numbers of their lines, and its usage lines in tables of commands.
pub fn commands(document: &Document) -> (Vec<(usize, String)>, Vec<String>) {
    let (mut found, mut usages) = (Vec::new(), Vec::new());
    for block in &document.blocks {
        let lines = block.text.lines().enumerate();
        found.extend(lines.clone().filter_map(|(k, line)| Some((block.line + k, command(line.trim_start())?))));
        // Comments of a manifest.
        let comments = lines.filter(|(_, line)| line.contains("`coupler-atlas "));
        found.extend(comments.flat_map(|(k, line)| codes(line).into_iter().map(move |code| (block.line + k, code))));
    }
    for prose in &document.prose {
        let is_usage = prose.table.as_ref().is_some_and(|table| table.starts_with("| command |"));
        let usage = if is_usage { codes(&prose.first_cell()) } else { Vec::new() };
        let codes = prose.codes().into_iter().filter(|code| !usage.contains(code));
        found.extend(codes.filter_map(|code| Some((prose.line, command(&code)?))));
        usages.extend(usage);
    }
    found.sort();
    (found, usages)
}

/// The words of a command line, of which those in quotes may contain blanks, and the file for its output.
fn words(line: &str) -> (Vec<String>, Option<String>) {
    let mut words = vec![String::new()];
    let mut is_quoted = false;
    for c in line.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            ' ' if !is_quoted => words.push(String::new()),
            _ => words.last_mut().unwrap().push(c),
        }
    }
    let output = words.iter().position(|word| word == ">").map(|at| words.split_off(at)[1].clone());
    (words, output)
}

/// Runs a command in a folder, and returns what it prints.
pub fn run_line(folder: &Path, line: &str, code: i32) -> String {
    let (words, file) = words(line);
    assert_eq!(words[0], "coupler-atlas", "{line} is neither listed nor a command of this program");
    let arguments: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let (ended, out, err) = run(folder, &arguments);
    assert_eq!(ended, code, "{line}: {out}{err}");
    if let Some(file) = file {
        fs::write(folder.join(file), &out).unwrap();
    }
    out
}

/// Runs the commands of each document one after another, in a folder with the manifests and the atlas of this repository.
#[test]
#[ignore = "thorough"]
fn every_command_is_run() {
    let atlas = TempDir::new().unwrap();
    put_manifests(atlas.path());
    let gap = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"w\"\nlinkage = \"watt\"\ncases = [{ p = 9, r = 1, a = 1 }]\n";
    fs::write(atlas.path().join("gap.toml"), gap).unwrap();
    run_line(atlas.path(), "coupler-atlas render -q", 0);
    let (substituted, not_run) = (BTreeMap::from(SUBSTITUTED), BTreeMap::from(NOT_RUN));
    let mut listed = BTreeSet::new();
    let mut count = 0;
    for document in documents() {
        let (commands, _) = commands(&document);
        let folder = TempDir::new().unwrap();
        if !commands.is_empty() {
            copy(atlas.path(), folder.path());
        }
        for block in document.blocks.iter().filter(|block| block.text.contains("title = \"A feeder's slide\"")) {
            fs::write(folder.path().join("feeder.toml"), &block.text).unwrap();
        }
        for block in document.blocks.iter().filter(|block| block.text.contains("title = \"My four-bars\"")) {
            fs::write(folder.path().join("mine.toml"), &block.text).unwrap();
        }
        for (line, command) in commands {
            println!("{}:{line}: {command}", document.name);
            let instead = [(command.as_str(), 0)];
            let run = substituted.get(command.as_str()).copied().unwrap_or(&instead);
            if run != instead || not_run.contains_key(command.as_str()) {
                listed.insert(command.clone());
            }
            if !not_run.contains_key(command.as_str()) {
                run.iter().for_each(|(line, code)| drop(run_line(folder.path(), line, *code)));
                count += 1;
            }
        }
        for file in WRITTEN.iter().filter(|(name, _)| *name == document.name).flat_map(|(_, files)| *files) {
            assert!(folder.path().join(file).is_file(), "{}: {file} has not been written", document.name);
        }
    }
    assert!(count > 30, "only {count} commands were found");
    let stale: Vec<_> = substituted.keys().chain(not_run.keys()).filter(|name| !listed.contains(**name)).collect();
    assert!(stale.is_empty(), "listed, but in no document: {stale:?}");
}

/// The options in a text, long and short.
fn options(text: &str) -> BTreeSet<String> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    words.filter(|word| word.starts_with('-') && word.len() > 1).map(str::to_owned).collect()
}

#[test]
fn usage_lines_have_the_options_of_the_help() {
    let help = printed(&["--help"]);
    let help = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = help.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names: BTreeSet<&str> = names.filter(|name| !name.is_empty()).collect();
    assert_eq!(names, BTreeSet::from(COMMANDS));
    let (_, usages) = commands(&document("docs/commands.md"));
    let described: BTreeSet<&str> = usages.iter().map(|usage| usage.split(' ').next().unwrap()).collect();
    assert_eq!(described, names);
    for usage in usages {
        let command = usage.split(' ').next().unwrap();
        // The only command with a command of its own.
        let own = Some("straight-line").filter(|own| usage.starts_with(&format!("design {own}")));
        let help = printed(&[&[command], own.as_slice(), &["--help"]].concat());
        let entries = help.lines().map(str::trim_start).filter(|line| line.starts_with('-') && !line.starts_with("- "));
        // Each option as it may be written: `-o` or `--output`.
        let entries: Vec<BTreeSet<String>> = entries.map(|line| options(line.split("  ").next().unwrap())).collect();
        let written = options(&usage);
        for option in &written {
            assert!(entries.iter().any(|entry| entry.contains(option)), "{command} has no option {option}");
        }
        let is_general = |entry: &BTreeSet<String>| entry.contains("--help") || entry.contains("--color");
        for entry in entries.iter().filter(|entry| !is_general(entry)) {
            assert!(entry.intersection(&written).next().is_some(), "{command} lacks {entry:?}");
        }
        if command == "list" {
            let topics = help.lines().filter_map(|line| line.trim_start().strip_prefix("- ")?.split(':').next());
            let documented = usage.split(|c: char| !c.is_ascii_lowercase()).skip(1).filter(|word| !word.is_empty());
            let documented: BTreeSet<&str> = documented.filter(|word| *word != "manifest").collect();
            assert_eq!(documented, topics.collect(), "{usage}");
        }
    }
}
