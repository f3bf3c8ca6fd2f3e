//! Text from a recorded atlas, a path or an argument cannot control a terminal, give a workflow command to the log of a
//! CI run, or damage a report.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use tempfile::TempDir;

use crate::support::command::{folder_with, program, result};
use crate::support::folder::edit_record;

const MANIFEST: &str = r#"[atlas]
title = "Atlas"
output = "output"
formats = ["svg"]

[[family]]
id = "evans"
linkage = "evans"
title = "Evans"
sampling = { step = "10 deg" }
cases = [{ p = 2, s = 2.59, a = 2.59 }, { p = 3, s = 4, a = 4 }]
"#;

/// Escape sequences, workflow commands at the beginning of lines, NUL, C1 and bidirectional controls, line separators.
const HOSTILE: &str = "::error::a\u{1b}[31m\u{0}\n::error::b\r\n \t::warning::c\u{9b}2J\u{85}\u{7f}\u{202e}d\u{2066}\u{200f}\u{2028}\
                       ::error::e\u{feff}##[error]f<&\"]]>\u{ffff}";

/// The same without the characters that a path, an argument or a field of a table cannot have.
fn hostile_word() -> String {
    HOSTILE.replace(['\0', '"'], "")
}

struct Atlas {
    folder: TempDir,
}

impl Atlas {
    fn new() -> Atlas {
        let atlas = Atlas { folder: folder_with(MANIFEST) };
        assert!(atlas.run(&["render", "-q"]).status.success());
        atlas
    }

    fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.folder.path().join(name)
    }

    fn run<A: AsRef<OsStr>>(&self, arguments: &[A]) -> Output {
        program(self.folder.path()).args(arguments).output().unwrap()
    }

    /// Runs the program; what it prints must be printable and have no workflow command.
    fn run_printable<A: AsRef<OsStr>>(&self, arguments: &[A]) -> (i32, String) {
        let (code, out, errors) = result(self.run(arguments));
        let printed = out + &errors;
        assert_printable(&printed);
        for line in printed.lines() {
            assert!(!line.trim_start().starts_with("::") && !line.contains("##["), "{line}\n{printed}");
        }
        (code, printed)
    }

    fn edit_record(&self, change: impl FnOnce(&mut serde_json::Value)) {
        edit_record(&self.path("output"), change);
    }

    fn edit_table(&self, name: &str, change: impl FnOnce(&str) -> String) {
        let path = self.path("output/evans").join(name);
        let text = fs::read_to_string(&path).unwrap();
        fs::write(path, change(&text)).unwrap();
    }
}

fn assert_printable(text: &str) {
    let is_raw = |c: char| {
        c.is_control() && c != '\n'
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    assert!(!text.contains(is_raw), "{text:?}");
}

/// An atlas of whose record every text is hostile.
fn hostile_atlas() -> Atlas {
    let atlas = Atlas::new();
    atlas.edit_record(|run| {
        run["title"] = HOSTILE.into();
        let mut family = run["families"][0].clone();
        family["id"] = HOSTILE.into();
        let mut long = family.clone();
        long["id"] = HOSTILE.repeat(2000).into();
        run["families"][0]["linkage"] = HOSTILE.into();
        run["families"][0]["title"] = HOSTILE.into();
        let files = run["families"][0]["files"].as_array_mut().unwrap();
        files.push(serde_json::json!({ "name": HOSTILE, "sha256": HOSTILE }));
        let families = run["families"].as_array_mut().unwrap();
        families.push(family);
        families.push(long);
        run["book"] = serde_json::json!({ "pages": 1, "files": [{ "name": HOSTILE }] });
    });
    // A field of a table is on one line.
    let field = hostile_word().replace(['\n', '\r'], "");
    atlas.edit_table("cells.csv", |text| text.replacen(",ok,,", &format!(",{field},{field},"), 1));
    atlas.edit_table("points.csv", |text| {
        let text = text.replacen("y\n", &format!("y,{field}\n"), 1);
        text.replacen("1,1,1,1,0,", &format!("1,1,1,{field},0,"), 1)
    });
    atlas
}

#[test]
fn a_hostile_record_is_checked_in_every_report_format() {
    let atlas = hostile_atlas();
    let check = |more: &[&str]| -> Vec<String> {
        ["check", "--against", "output"].iter().chain(more).map(|&word| word.to_owned()).collect()
    };
    let (code, table) = atlas.run_printable(&check(&["--diff", "moved"]));
    assert_eq!(code, 1);
    assert!(table.contains("\\u{1b}[31m") && table.contains("\\n::error::b"), "{table}");
    assert_printable(&fs::read_to_string(atlas.path("moved/index.html")).unwrap());

    let (_, json) = {
        let output = atlas.run(&check(&["--report", "json"]));
        assert!(output.stderr.is_empty());
        (output.status, String::from_utf8(output.stdout).unwrap())
    };
    assert_printable(&json);
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    let findings = report["findings"].as_array().unwrap();
    assert!(findings.iter().any(|finding| finding["family"] == HOSTILE), "the text is kept");
    assert!(findings.iter().any(|finding| finding["was"] == HOSTILE), "{json}");

    let (_, xml) = atlas.run_printable(&check(&["--report", "junit"]));
    let document = roxmltree::Document::parse(&xml).unwrap();
    let names = document.descendants().filter_map(|node| node.attribute("name"));
    assert!(names.into_iter().any(|name| name.contains("\\u{1b}[31m\\u{0}\\n::error::b")), "{xml}");

    let output = atlas.run(&check(&["--report", "github"]));
    let annotations = String::from_utf8(output.stdout).unwrap();
    assert_printable(&annotations);
    assert!(annotations.contains("\\u{1b}"), "{annotations}");
    for line in annotations.lines() {
        let rest = line.strip_prefix("::error ").or(line.strip_prefix("::notice ")).unwrap();
        let rest = rest.strip_prefix("file=atlas.toml,line=").unwrap();
        let (properties, message) = rest.split_once("::").unwrap();
        assert!(properties.contains(",title=") && properties.matches([':', ',']).count() == 1, "{line}");
        assert!(!message.contains(['\n', '\r']), "{line}");
    }
}

#[test]
fn a_record_of_a_hostile_program_is_reported() {
    let atlas = Atlas::new();
    atlas.edit_record(|run| {
        run["format"] = 99.into();
        run["program"] = HOSTILE.into();
        run["version"] = HOSTILE.into();
    });
    for arguments in [&["check", "--against", "output"][..], &["render"]] {
        let (code, printed) = atlas.run_printable(arguments);
        assert!(code == 2 && printed.contains("\\u{1b}[31m"), "{arguments:?}: {printed}");
    }
    for invalid in [format!("{{\"{}\": 1", HOSTILE.escape_debug()), HOSTILE.to_owned()] {
        fs::write(atlas.path("output/run.json"), invalid).unwrap();
        assert_eq!(atlas.run_printable(&["check", "--against", "output"]).0, 2);
        atlas.run_printable(&["render"]);
    }
}

#[test]
fn hostile_arguments_are_quoted() {
    let atlas = Atlas::new();
    let word = hostile_word();
    let parameter = format!("{word}=1");
    let value = format!("p={word}");
    let curve = format!("{word}:1");
    let report = format!("json{word}");
    for arguments in [
        &["check", "--against", &word][..],
        &["check", "--against", "output", "--only", &word],
        &["check", "--against", "output", "--report", &report],
        &["check", &word, "--against", "output"],
        &["render", "--only", &word],
        &["render", "--format", &word],
        &["validate", &word],
        &["inspect", &word],
        &["inspect", "evans", &parameter],
        &["inspect", "evans", &value],
        &["inspect", "evans", "p=2", "--at", &word],
        &["export", &word],
        &["export", &curve],
        &["export", "evans:1", &parameter],
        &["design", "straight-line", "--kinds", &word],
        &["list", &word],
        &["--", &word],
        &[&word],
    ] {
        let (code, printed) = atlas.run_printable(arguments);
        assert!(matches!(code, 2 | 3), "{arguments:?}: {code}, {printed}");
    }
}

#[cfg(unix)]
#[test]
fn hostile_paths_are_printed() {
    let atlas = Atlas::new();
    let word = hostile_word().replace('/', "");
    let (code, printed) = atlas.run_printable(&["init", &word]);
    assert!(code == 0 && printed.contains("\\u{1b}[31m"), "{printed}");
    assert_eq!(atlas.run_printable(&["init", &word]).0, 2);
    assert_eq!(atlas.run_printable(&["validate", &word]).0, 0);
    let folder = format!("folder{word}");
    for arguments in
        [&["export", "evans", "-o", &folder][..], &["render", "-o", &folder], &["check", "--against", &folder]]
    {
        assert_eq!(atlas.run_printable(arguments).0, 0, "{arguments:?}");
    }
    fs::write(atlas.path(&word), format!("title = 1 # \u{2066}\n[[family]]\nid = {:?}\n", "a\n::error::b")).unwrap();
    let (code, printed) = atlas.run_printable(&["validate", &word]);
    assert!(code == 2 && printed.contains("error"), "{printed}");
}
