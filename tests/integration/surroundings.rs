//! The same manifest produces the same bytes with any number of threads, and in any folder, language, time zone and
//! terminal.

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

use tempfile::TempDir;

use crate::support::command::PROGRAM;
use crate::support::folder::tree;

/// Every format and layout, with numbers that some languages write differently and a cell that is not assembled.
const MANIFEST: &str = r#"[atlas]
title = "Ångström’s Atlas"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = { width = "150 mm", height = "110 mm" }
dpi = 40
[[family]]
id = "evans"
linkage = "evans"
panels = [2, 1]
sampling = { step = "5 deg" }
grid = { p = [2.5, 3, 4, 90], k = [1, 2] }
let = { a = "2.25" }
sort = "-length"
[[family]]
id = "points"
linkage = "hrones-nelson"
layout = "coupler-grid"
sampling = { samples = 40 }
cases = [{ A = 2.5, B = 3, C = 2 }]
[[family]]
id = "over"
linkage = "evans"
sampling = { step = "5 deg" }
grid = { p = { from = 2, to = 4, step = 0.1 } }
let = { a = "(1 + p)^1.5 / 2" }
layout = "chart"
chart = { x = "p", y = ["length"] }
[[family]]
id = "poses"
linkage = "four-bar"
layout = "poses"
poses = [[1, 2, 0], [1.5, 2.25, 10], [0.5, 2.5, 20], [0, 2, 24.5]]
sampling = { step = "5 deg" }
cases = [{ frame = 4, crank = 1.5, coupler = 3, rocker = 3.5, along = 1.5, across = 1 }]
"#;

/// The messages and files of a run in a subfolder, with a umask and environment variables.
fn render(subfolder: &str, mask: &str, jobs: &str, variables: &[(&str, &str)]) -> (Vec<u8>, BTreeMap<String, Vec<u8>>) {
    let folder = TempDir::new().unwrap();
    let subfolder = folder.path().join(subfolder);
    fs::create_dir_all(&subfolder).unwrap();
    fs::write(subfolder.join("atlas.toml"), MANIFEST).unwrap();
    let output = program(mask).current_dir(&subfolder).envs(variables.iter().copied()).args(["--jobs", jobs]).output();
    let output = output.unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    ([output.stdout, output.stderr].concat(), tree(&subfolder.join("out")))
}

#[cfg(unix)]
fn program(mask: &str) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", &format!("umask {mask}; exec \"$0\" render \"$@\""), PROGRAM]);
    command
}

#[cfg(not(unix))]
fn program(_mask: &str) -> Command {
    let mut command = Command::new(PROGRAM);
    command.arg("render");
    command
}

/// A subfolder, a umask, a number of threads and environment variables.
type Surroundings<'a> = (&'a str, &'a str, &'a str, &'a [(&'a str, &'a str)]);

/// Panics unless the output in some surroundings is the same as without any.
fn assert_same_output(surroundings: &[Surroundings]) {
    let first = render("", "022", "1", &[]);
    let kind = |kind: &str| first.1.keys().filter(|name| name.ends_with(kind)).count();
    assert_eq!(["svg", "png", "pdf", "csv", "json"].map(kind), [7, 7, 1, 8, 2]);
    for (subfolder, mask, jobs, variables) in surroundings {
        let (messages, files) = render(subfolder, mask, jobs, variables);
        assert!(messages == first.0, "{subfolder}: {}", String::from_utf8_lossy(&messages));
        assert!(files.keys().eq(first.1.keys()), "{subfolder}");
        files.iter().for_each(|(name, bytes)| assert!(first.1[name] == *bytes, "{subfolder}: {name}"));
    }
}

#[test]
fn the_environment_does_not_change_the_output() {
    let german = [("LANG", "de_DE.UTF-8"), ("LC_ALL", "de_DE.UTF-8"), ("LC_NUMERIC", "de_DE"), ("TZ", "Asia/Kolkata")];
    let plain = [("LC_ALL", "C"), ("TZ", "America/St_Johns"), ("TERM", "dumb"), ("NO_COLOR", "1"), ("COLUMNS", "20")];
    assert_same_output(&[("a/deeper/folder", "077", "2", &german), ("ümlaut and space", "002", "8", &plain)]);
}

#[test]
#[ignore = "thorough"]
fn other_environments_do_not_change_the_output() {
    let home = TempDir::new().unwrap();
    let home = home.path().to_str().unwrap();
    let turkish = [("LC_ALL", "tr_TR.UTF-8"), ("HOME", home), ("TMPDIR", home), ("TERM", "xterm-256color")];
    let rayon = [("RAYON_NUM_THREADS", "1"), ("SOURCE_DATE_EPOCH", "1"), ("COLUMNS", "0")];
    assert_same_output(&[("x", "000", "8", &turkish), ("y", "022", "3", &rayon)]);
}

/// No file contains the folder, the user, the host or a date of the run.
#[test]
fn no_file_identifies_the_machine() {
    let (_, files) = render("a-telling-name", "022", "2", &[("USER", "telling-user"), ("HOSTNAME", "telling-host")]);
    let source = env!("CARGO_MANIFEST_DIR");
    for (name, bytes) in &files {
        for word in ["telling", "CreationDate", source] {
            assert!(!bytes.windows(word.len()).any(|window| window == word.as_bytes()), "{name} contains {word}");
        }
    }
}
