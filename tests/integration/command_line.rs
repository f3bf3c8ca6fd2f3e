//! What all commands have in common: help, colours, standard input and output; and the manual page.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const COMMANDS: [&str; 10] =
    ["render", "validate", "check", "inspect", "design", "export", "list", "init", "completions", "man"];

const MANIFEST: &str = r#"[atlas]
title = "T"
output = "pages"
formats = ["svg"]
[[family]]
id = "evans"
linkage = "evans"
sampling = { samples = 20 }
cases = [{ p = 2, a = 2.5 }, { p = 3, a = 3 }]
"#;

fn program(folder: &Path) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_coupler-atlas"));
    program.current_dir(folder).stdin(Stdio::null());
    for name in ["NO_COLOR", "CLICOLOR_FORCE", "COLUMNS"] {
        program.env_remove(name);
    }
    program
}

fn result(output: Output) -> (i32, String, String) {
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    result(program(folder).args(arguments).output().unwrap())
}

/// The standard output of a command that succeeds.
fn text(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, err) = run(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    out
}

fn folder_with(manifest: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("atlas.toml"), manifest).unwrap();
    folder
}

#[test]
fn help_is_wrapped_at_the_width_of_the_terminal() {
    let widest = |columns: Option<&str>, arguments: &[&str]| {
        let mut program = program(Path::new("."));
        if let Some(columns) = columns {
            program.env("COLUMNS", columns);
        }
        let (code, out, err) = result(program.args(arguments).output().unwrap());
        assert_eq!(code, 0, "{arguments:?}: {err}");
        out.lines().map(|line| line.chars().count()).max().unwrap()
    };
    let commands = COMMANDS.map(|command| vec![command]);
    for command in commands.iter().map(Vec::as_slice).chain([&[][..]]) {
        for flag in ["-h", "--help"] {
            let arguments = [command, &[flag]].concat();
            assert!(widest(Some("80"), &arguments) <= 80, "{arguments:?}");
            assert!(widest(None, &arguments) <= 100, "{arguments:?}");
            assert!(widest(Some("300"), &arguments) <= 100, "{arguments:?}");
            // No width is too small for it to end.
            widest(Some("1"), &arguments);
        }
    }
    assert!((61..=80).contains(&widest(Some("80"), &["export", "--help"])), "it uses the width");
}

#[test]
fn colours_follow_the_option_and_the_environment() {
    let folder = folder_with("[atlas]\n");
    let is_styled = |variables: &[(&str, &str)], arguments: &[&str]| {
        let (code, _, err) =
            result(program(folder.path()).envs(variables.iter().copied()).args(arguments).output().unwrap());
        assert_eq!(code, 2, "{err}");
        assert!(err.contains("error"), "{err}");
        err.contains('\u{1b}')
    };
    let (problems, argument) = (&["validate"][..], &["bogus"][..]);
    for command in [problems, argument] {
        assert!(!is_styled(&[], command));
        assert!(is_styled(&[], &[command, &["--color", "always"]].concat()));
        assert!(is_styled(&[], &[&["--color=always"], command].concat()));
        assert!(is_styled(&[("NO_COLOR", "1")], &[command, &["--color=always"]].concat()));
        assert!(is_styled(&[("CLICOLOR_FORCE", "1")], command));
        assert!(is_styled(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "")], command));
        assert!(!is_styled(&[("CLICOLOR_FORCE", "0")], command));
        assert!(!is_styled(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")], command));
        assert!(!is_styled(&[("CLICOLOR_FORCE", "1")], &[command, &["--color", "never"]].concat()));
        assert!(is_styled(&[("CLICOLOR_FORCE", "1")], &[command, &["--color", "auto"]].concat()));
    }
    let (code, _, err) = run(folder.path(), &["validate", "--color", "blue"]);
    assert_eq!(code, 2);
    assert!(err.contains("possible values: auto, always, never"), "{err}");
}

#[test]
fn the_number_of_threads_has_a_short_option() {
    let folder = folder_with(MANIFEST);
    text(folder.path(), &["render", "-q", "-j", "1"]);
    text(folder.path(), &["check", "-q", "-j1", "--against", "pages"]);
    assert_eq!(run(folder.path(), &["render", "-j", "0"]).0, 2);
}

/// The terms and descriptions of a section of the manual page.
fn section(manual: &str, title: &str) -> Vec<(String, String)> {
    let body = manual.split(&format!(".SH \"{title}\"\n")).nth(1);
    let body = body.or_else(|| manual.split(&format!(".SH {title}\n")).nth(1));
    let body = body.unwrap_or_else(|| panic!("{title}")).split("\n.SH ").next().unwrap();
    // Each section has a preamble of its own.
    let body = body.split("\n.ie ").next().unwrap();
    let plain = |line: &str| line.replace("\\fB", "").replace("\\fR", "").replace("\\-", "-").replace("\\&", "");
    let entries = body.split(".TP\n").skip(1).map(|entry| {
        let (term, description) = entry.split_once('\n').unwrap();
        (plain(term), plain(description.trim_end()))
    });
    entries.collect()
}

#[test]
fn the_manual_states_files_exit_codes_and_variables_as_help_and_documentation_do() {
    let manual = text(Path::new("."), &["man"]);
    let help = text(Path::new("."), &["--help"]).split_whitespace().collect::<Vec<_>>().join(" ");
    let document = include_str!("../../docs/commands.md").replace('`', "");
    let codes = section(&manual, "EXIT STATUS");
    assert_eq!(codes.iter().map(|(code, _)| code.as_str()).collect::<Vec<_>>(), ["0", "1", "2", "3", "130"]);
    for (code, meaning) in codes {
        let meaning = meaning[..1].to_lowercase() + meaning[1..].trim_end_matches('.');
        assert!(help.contains(&format!("{code} {meaning}")), "{code} {meaning}: {help}");
        assert!(document.contains(&format!("| {code} | {meaning} |")), "{code} {meaning}");
    }
    for (variable, _) in section(&manual, "ENVIRONMENT") {
        assert!(document.contains(&format!("| {variable} |")) && help.contains(&variable), "{variable}");
    }
    // The named files are those of an atlas.
    let folder = folder_with(MANIFEST);
    text(folder.path(), &["render", "-q", "--format", "svg"]);
    for (name, _) in section(&manual, "FILES") {
        let path = name.replace("DIR", "pages").replace("FAMILY", "evans");
        assert!(folder.path().join(path).is_file() || name.ends_with(".journal"), "{name}");
    }
}

/// Runs the examples one after another in a folder that is empty at first.
#[cfg(unix)]
#[test]
fn the_examples_of_the_manual_can_be_run() {
    let folder = TempDir::new().unwrap();
    let examples = section(&text(folder.path(), &["man"]), "EXAMPLES");
    assert!(examples.len() > 5);
    for (example, description) in examples {
        assert!(description.len() > 10, "{example}");
        let line = example.replace("coupler-atlas ", &format!("{} ", env!("CARGO_BIN_EXE_coupler-atlas")));
        let output = Command::new("sh").current_dir(folder.path()).args(["-c", &line]).output().unwrap();
        let (code, _, err) = result(output);
        assert_eq!(code, 0, "{example}: {err}");
    }
    for file in ["output/index.html", "curve.dxf", "best/index.html"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
}
