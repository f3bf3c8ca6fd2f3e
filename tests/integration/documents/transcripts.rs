//! The output of commands in the documents is what the commands print.

use tempfile::TempDir;

use super::commands::run_line;
use super::{documents, move_point, put_manifests};

/// The commands and outputs of a block in which commands have a prompt.
fn transcript(block: &str) -> Vec<(&str, Vec<&str>)> {
    let mut found: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in block.lines() {
        match line.strip_prefix("$ ") {
            Some(command) => found.push((command, Vec::new())),
            None => found.last_mut().expect("a transcript begins with a command").1.push(line),
        }
    }
    found
}

/// Whether the lines are those expected, of which `…` stands for any number of lines.
fn is_match(expected: &[&str], lines: &[&str]) -> bool {
    match expected.split_first() {
        None => lines.is_empty(),
        Some((&"…", rest)) => (0..=lines.len()).any(|skipped| is_match(rest, &lines[skipped..])),
        Some((first, rest)) => lines.split_first().is_some_and(|(line, lines)| first == line && is_match(rest, lines)),
    }
}

#[test]
#[ignore = "thorough"]
fn transcripts_are_what_is_printed() {
    let mut count = 0;
    for document in documents() {
        for block in document.blocks.iter().filter(|block| block.text.lines().any(|line| line.starts_with("$ "))) {
            let folder = TempDir::new().unwrap();
            put_manifests(folder.path());
            // docs/check.md: a point has moved by 1e-8.
            let is_moved = document.name == "docs/check.md";
            if is_moved {
                run_line(folder.path(), "coupler-atlas render -q", 0);
                move_point(&folder.path().join("output/evans/points.csv"), "1,1,1,1,57,114,");
            }
            for (command, expected) in transcript(&block.text) {
                assert!(!expected.is_empty(), "{}: {command} prints nothing", document.name);
                // A difference that `check` finds has the exit code 1.
                let printed = run_line(folder.path(), command, i32::from(is_moved));
                let lines: Vec<&str> = printed.lines().collect();
                assert!(
                    is_match(&expected, &lines),
                    "{}:{}: {command} prints\n{printed}\nand not\n{}",
                    document.name,
                    block.line,
                    expected.join("\n")
                );
                count += 1;
            }
        }
    }
    assert!(count >= 4, "only {count} transcripts were found");
}

/// Other blocks than commands, transcripts and TOML, and the tests of them.
#[test]
fn every_block_is_tested() {
    let tested = [
        ("docs/start.md", "rust", "readme.rs"),
        ("docs/architecture.md", "text", "a figure"),
        ("docs/check.md", "yaml", "readme.rs"),
        ("docs/check.md", "sh", "readme.rs"),
        ("docs/import.md", "text", "import/formats.rs"),
        ("docs/manifest.md", "text", "manifests.rs"),
        ("docs/pages.md", "xml", "numbers.rs"),
        ("docs/start.md", "sh", ".ci/workflows"),
        ("docs/python.md", "python", ".ci/python"),
        ("docs/python.md", "sh", ".ci/python builds and installs the wheel"),
        ("docs/scale.md", "sql", ".ci/shards"),
        ("docs/scale.md", "python", ".ci/shards"),
    ];
    for document in documents() {
        for block in &document.blocks {
            let is_command = |line: &str| {
                ["coupler-atlas ", "cargo "].iter().any(|start| line.starts_with(start)) || line.is_empty()
            };
            let is_tested = match &*block.language {
                "" => block.text.starts_with("$ coupler-atlas ") || block.text.lines().all(is_command),
                "toml" => true,
                language => tested.iter().any(|(name, other, _)| *name == document.name && *other == language),
            };
            assert!(is_tested, "{}:{}: no test of this block", document.name, block.line);
        }
    }
}

#[test]
fn abbreviated_outputs_are_matched() {
    let lines = ["a", "b", "c", "d"];
    for expected in
        [&["a", "b", "c", "d"][..], &["a", "…"], &["…", "d"], &["a", "…", "c", "…"], &["a", "b", "…", "c", "d"]]
    {
        assert!(is_match(expected, &lines), "{expected:?}");
    }
    for expected in [&["a", "b", "c"][..], &["a", "…", "c"], &["…", "e", "…"], &["b", "…"], &["a", "c", "…"], &[]]
    {
        assert!(!is_match(expected, &lines), "{expected:?}");
    }
}
