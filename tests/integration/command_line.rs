//! What all commands have in common: help, colours, standard input and output; and the manual page.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use tempfile::TempDir;

use crate::support::command::{COMMANDS, folder_with, printed, program, result, run};

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

/// Runs the program with a text on standard input.
fn run_with_input(folder: &Path, arguments: &[&str], input: &str) -> (i32, String, String) {
    let mut command = program(folder);
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // A program that does not read its input may end first.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    result(child.wait_with_output().unwrap())
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
    printed(folder.path(), &["render", "-q", "-j", "1"]);
    printed(folder.path(), &["check", "-q", "-j1", "--against", "pages"]);
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
    let manual = printed(Path::new("."), &["man"]);
    let help = printed(Path::new("."), &["--help"]).split_whitespace().collect::<Vec<_>>().join(" ");
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
    printed(folder.path(), &["render", "-q", "--format", "svg"]);
    for (name, _) in section(&manual, "FILES") {
        let path = name.replace("DIR", "pages").replace("FAMILY", "evans");
        assert!(folder.path().join(path).is_file() || name.ends_with(".journal"), "{name}");
    }
}

/// Runs the examples one after another in a folder that is empty at first.
#[cfg(unix)]
#[test]
#[ignore = "thorough"]
fn the_examples_of_the_manual_can_be_run() {
    let folder = TempDir::new().unwrap();
    let examples = section(&printed(folder.path(), &["man"]), "EXAMPLES");
    assert!(examples.len() > 5);
    for (example, description) in examples {
        assert!(description.len() > 10, "{example}");
        let line = example.replace("coupler-atlas ", "\"$0\" ");
        let (code, _, err) = result(crate::support::command::shell(folder.path(), &line).output().unwrap());
        assert_eq!(code, 0, "{example}: {err}");
    }
    for file in ["output/index.html", "curve.dxf", "best/index.html"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
}

#[test]
fn a_hyphen_is_standard_input_wherever_a_manifest_is_named() {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["render", "-q"]);
    let reads = |arguments: &[&str]| {
        let (code, out, err) = run_with_input(folder.path(), arguments, MANIFEST);
        assert_eq!(code, 0, "{arguments:?}: {err}");
        out
    };
    assert_eq!(reads(&["validate", "-"]), "standard input: 1 family, 2 cells\n");
    reads(&["render", "-", "-q", "-o", "from-input"]);
    assert!(reads(&["check", "-", "--against", "pages"]).contains("nothing has changed"));
    let curve = ["evans:1.1.1", "--format", "csv"];
    let exported = printed(folder.path(), &[&["export"], &curve[..]].concat());
    assert_eq!(reads(&[&["export", "-"], &curve[..]].concat()), exported);
    assert_eq!(reads(&[&["export", "-"], &curve[..], &["-o", "-"]].concat()), exported);
    // The linkages of a manifest can be those of the starter.
    let starter = printed(folder.path(), &["init", "-"]);
    for arguments in [
        &["inspect", "my-four-bar", "frame=3", "--manifest", "-"][..],
        &["export", "--linkage", "my-four-bar", "--manifest", "-", "frame=3", "--format", "csv"],
    ] {
        let (code, _, err) = run_with_input(folder.path(), arguments, &starter);
        assert_eq!(code, 0, "{arguments:?}: {err}");
    }
    let (code, _, err) = run_with_input(folder.path(), &["validate", "-"], "[atlas]\n");
    assert!(code == 2 && err.contains("--> standard input:1:1") && err.contains("standard input: 2 problems"), "{err}");
    let mut command = program(folder.path());
    let file = folder.path().join("binary");
    fs::write(&file, [0xff]).unwrap();
    let (code, _, err) = result(command.args(["render", "-"]).stdin(fs::File::open(file).unwrap()).output().unwrap());
    assert!(code == 2 && err.contains("cannot read standard input: "), "{err}");
}

#[test]
fn a_hyphen_is_standard_output_wherever_a_file_is_written() {
    let folder = folder_with(MANIFEST);
    let starter = printed(folder.path(), &["init", "-"]);
    assert_eq!(starter, include_str!("../../src/cli/starter.toml"));
    let design = ["design", "straight-line", "--input", "motor", "--p", "2", "--best", "1", "--types", "hoeken"];
    for command in [&["inspect", "hoeken"][..], &design] {
        let plate = printed(folder.path(), &[command, &["--svg", "-"]].concat());
        assert!(plate.starts_with("<svg") && plate.ends_with("</svg>\n"), "{plate}");
        let (code, out, err) = run(folder.path(), &[command, &["--svg", "-", "--json"]].concat());
        assert!(code == 2 && out.is_empty() && err.contains("--svg - and --json both write to"), "{err}");
    }
    printed(folder.path(), &["render", "-q"]);
    let report = printed(folder.path(), &["check", "--against", "pages", "--report", "json=-"]);
    assert_eq!(report, printed(folder.path(), &["check", "--against", "pages", "--report", "json"]));
    let report = printed(folder.path(), &["validate", "--report", "json=-"]);
    assert_eq!(report, printed(folder.path(), &["validate", "--report", "json"]));
    // Several files do not go to standard output, and folders neither.
    let (code, out, err) = run(folder.path(), &["export", "-o", "-"]);
    assert!(code == 2 && out.is_empty() && err.contains("name a folder for them with -o FOLDER"), "{err}");
    for arguments in
        [&["render", "-o", "-"][..], &["check", "--against", "-"], &["check", "--against", "pages", "--diff", "-"]]
    {
        let (code, out, err) = run(folder.path(), arguments);
        assert!(code == 2 && out.is_empty() && err.contains("a folder is needed"), "{arguments:?}: {err}");
    }
    let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["atlas.toml", "pages"]);
}

#[test]
fn init_creates_the_missing_folder() {
    let folder = TempDir::new().unwrap();
    let out = printed(folder.path(), &["init", "a/b/x.toml"]);
    assert_eq!(out, "written to a/b/x.toml; `coupler-atlas render a/b/x.toml` draws it\n");
    printed(folder.path(), &["validate", "a/b/x.toml"]);
    printed(folder.path(), &["init", "a/b/y.toml"]);
    fs::write(folder.path().join("a/b/x.toml"), "mine").unwrap();
    assert_eq!(run(folder.path(), &["init", "a/b/x.toml"]).0, 2);
    assert_eq!(fs::read_to_string(folder.path().join("a/b/x.toml")).unwrap(), "mine");
    // A file cannot be a folder.
    let (code, _, err) = run(folder.path(), &["init", "a/b/x.toml/z.toml"]);
    assert!(code == 3 && err.contains("cannot write a/b/x.toml"), "{err}");
    let (code, _, err) = run(folder.path(), &["validate", "c/d.toml"]);
    assert!(code == 2 && err.contains("`coupler-atlas init c/d.toml` writes"), "{err}");
}

#[test]
fn names_of_formats_may_be_surrounded_by_blanks() {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["render", "-q", "--format", "svg, png"]);
    assert!(folder.path().join("pages/evans/evans-001.png").is_file());
    printed(folder.path(), &["export", "evans:1", "--format", " svg , csv", "-o", "curves"]);
    assert!(folder.path().join("curves/evans-1-1-1.csv").is_file());
    for command in [&["render"][..], &["export", "evans:1"]] {
        for formats in ["", " ", "svg,", "svg,,png"] {
            let (code, out, err) = run(folder.path(), &[command, &["--format", formats]].concat());
            assert!(code == 2 && out.is_empty(), "{formats}: {err}");
            assert!(err.contains("the name of a format is missing: it can be"), "{formats}: {err}");
        }
        let (_, _, err) = run(folder.path(), &[command, &["--format", "svg, pgn"]].concat());
        assert!(err.contains("unknown format `pgn`: did you mean `png`?"), "{err}");
    }
    let (code, _, err) = run(folder.path(), &["design", "straight-line", "--types", "evans,,watt"]);
    assert!(code == 2 && err.contains("--types: the name of a linkage is missing"), "{err}");
}

#[test]
fn render_names_what_to_open_and_says_if_nothing_has_changed() {
    let folder = folder_with(MANIFEST);
    let last = |arguments: &[&str]| printed(folder.path(), arguments).lines().last().unwrap().to_owned();
    let unchanged = "nothing has changed in pages; open pages/index.html";
    assert_eq!(last(&["render"]), "written to pages; open pages/index.html");
    assert_eq!(last(&["render"]), unchanged);
    assert_eq!(last(&["render", "--only", "evans"]), unchanged);
    assert_eq!(last(&["render", "--force"]), "written to pages; open pages/index.html");
    // Whatever is restored or changed, even if it is in no family.
    for file in ["index.html", "kernel.js", "evans/evans-001.svg", "evans/points.csv", "evans/gallery.js"] {
        fs::write(folder.path().join("pages").join(file), "damaged").unwrap();
        assert_eq!(last(&["render"]), "written to pages; open pages/index.html", "{file}");
        assert_eq!(last(&["render"]), unchanged, "{file}");
    }
    fs::write(folder.path().join("atlas.toml"), MANIFEST.replace("title = \"T\"", "title = \"U\"")).unwrap();
    assert_eq!(last(&["render"]), "written to pages; open pages/index.html");
    assert_eq!(last(&["render"]), unchanged);
    if cfg!(feature = "pdf") {
        let book = last(&["render", "--format", "svg,pdf"]);
        let (_, book) = book.strip_prefix("written to pages; open ").unwrap().split_once(" or ").unwrap();
        assert!(book.ends_with(".pdf") && folder.path().join(book).is_file(), "{book}");
    }
}

#[test]
fn problems_are_reported_as_json() {
    let wrong =
        MANIFEST.replace("title = \"T\"", "title = \"é€𝄞\"").replace("formats = [\"svg\"]", "formats = [ \"gif\" ]");
    let folder = folder_with(&wrong.replace("\"evans\"\nsampling", "\"evens\"\nsampling"));
    let (code, out, err) = run(folder.path(), &["validate", "--report", "json"]);
    assert_eq!((code, err.as_str()), (2, "error: atlas.toml: 2 problems\n"));
    let report: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&report["format"], &report["has_errors"]), (&1.into(), &true.into()));
    assert!(report["families"].is_null() && report["cells"].is_null());
    let problems = report["problems"].as_array().unwrap();
    assert_eq!(problems.len(), 2);
    // The places are those of the text.
    let (code, out, text_report) = run(folder.path(), &["validate", "--report", "text"]);
    assert_eq!((code, out.as_str()), (2, ""));
    for (problem, [line, column]) in problems.iter().zip([[4, 13], [7, 11]]) {
        assert_eq!((&problem["line"], &problem["column"]), (&line.into(), &column.into()));
        assert_eq!((&problem["file"], &problem["severity"]), (&"atlas.toml".into(), &"error".into()));
        assert!(text_report.contains(&format!("atlas.toml:{line}:{column}")), "{text_report}");
        for key in ["message", "help"] {
            assert!(text_report.contains(problem[key].as_str().unwrap()), "{key}: {text_report}");
        }
    }
    assert_eq!(problems[1]["help"], "did you mean `evans`?");
    // Both reports as files, and the text on standard error all the same.
    let (code, out, err) = run(folder.path(), &["validate", "--report", "json=p.json", "--report", "text=p.txt"]);
    assert_eq!((code, out.as_str(), err.as_str()), (2, "", text_report.as_str()));
    let file = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&file("p.json")).unwrap(), report);
    assert!(text_report.starts_with(&file("p.txt")));
    // A valid manifest with a warning.
    fs::write(folder.path().join("atlas.toml"), MANIFEST.replace("cases", "where = \"p > 9\"\ncases")).unwrap();
    let (code, out, err) = run(folder.path(), &["validate", "--report", "json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let report: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&report["has_errors"], &report["families"], &report["cells"]), (&false.into(), &1.into(), &2.into()));
    assert_eq!(report["problems"][0]["severity"], "warning");
    let (code, _, err) = run(folder.path(), &["validate", "--report", "jsn"]);
    assert!(code == 2 && err.contains("unknown report `jsn`: did you mean `json`?"), "{err}");
    assert_eq!(run(folder.path(), &["validate", "--report", "json="]).0, 2);
}

/// The report as JSON has the places of the text, also at the end, behind wide characters and of several problems.
#[test]
fn the_places_of_json_are_those_of_the_text() {
    let many = format!("[atlas]\ntitle = \"T\"\n{}", "[[family]]\nid = \"a\"\nlinkage = \"evens\"\n".repeat(30));
    for manifest in [
        "",
        "\n",
        "x = [\n",
        "x = [\r\n",
        "x = \"é𝄞",
        "[atlas]\r\ntitle = 1\r\n",
        "[atlas]\ntitle = [\"漢字\", 1, \"\u{301}\", oops]\n",
        "\u{feff}[atlas]\ntitel = 1",
        &many,
    ] {
        let folder = folder_with(manifest);
        let (code, out, _) = run(folder.path(), &["validate", "--report", "json"]);
        assert_eq!(code, 2, "{manifest:?}");
        let report: serde_json::Value = serde_json::from_str(&out).unwrap();
        let problems = report["problems"].as_array().unwrap().iter();
        let places: Vec<String> =
            problems.map(|problem| format!("atlas.toml:{}:{}", problem["line"], problem["column"])).collect();
        let (_, _, text) = run(folder.path(), &["validate"]);
        let expected: Vec<&str> = text.lines().filter_map(|line| line.trim_start().strip_prefix("--> ")).collect();
        assert_eq!(places, expected, "{manifest:?}: {text}");
    }
}

#[test]
fn a_negative_number_is_a_value_with_an_error_of_its_own() {
    for (arguments, expected) in [
        (["export", "--linkage", "jansen", "--parts", "--hole", "-3"], "a length greater than 0"),
        (["export", "--linkage", "jansen", "--parts", "--chord", "-1"], "a number from 1e-9 to 0.1"),
        (["sweep", "--by", "x", "atlas.toml", "--top", "-3"], "not in 1..="),
        (["design", "straight-line", "--p", "-1", "--best", "-3"], "--best: -3 is not a whole number from 1"),
        (["design", "straight-line", "--length", "-1", "--mu-min", "-3"], "--mu-min: "),
        (["design", "four-bar", "--minimize", "-length", "--range", "-3"], "`-3`"),
        (["design", "four-bar", "--minimize", "-length", "--fix", "-3"], "`-3`"),
        (["check", "nix.toml", "--rtol", "1", "--atol", "-1"], "must not be negative"),
        (["check", "nix.toml", "--atol", "1", "--rtol", "-1"], "must not be negative"),
        (["check", "nix.toml", "--atol", "1", "--measure-rtol", "-1"], "must not be negative"),
        (["inspect", "four-bar", "--at", "-1", "--branch", "-2"], "[possible values: 1, -1]"),
    ] {
        let (code, _, error) = run(Path::new("."), &arguments);
        assert_eq!(code, 2);
        assert!(error.contains(expected) && !error.contains("use '--"), "{arguments:?}: {error}");
    }
}
