//! Manifests and records with other format versions, and files with the line ends and paths of Windows.

use std::fs;

use coupler_atlas::manifest;
use coupler_atlas::record::{self, ReadError, RunRecord};
use tempfile::TempDir;

use crate::support::command::{printed, run};
use crate::support::folder::{Atlas, tree};
use crate::support::plan::plan;

const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg"]
[[family]]
id = "evans"
linkage = "evans"
sampling = { step = "10 deg" }
grid = { p = [2, 3] }
let = { a = "(1 + p)^1.5 / 2" }
"#;

fn with_format(format: &str) -> String {
    MANIFEST.replacen("[atlas]\n", &format!("[atlas]\nformat = {format}\n"), 1)
}

#[test]
fn a_manifest_of_another_format_is_rejected_with_one_error() {
    // Keys that another format may have are not reported.
    let newer = with_format("2").replace("[[family]]", "[[brood]]").replace("title", "name");
    let atlas = Atlas::new(&newer);
    for command in [&["validate"][..], &["inspect", "mine", "--manifest", "atlas.toml"]] {
        let (code, _, err) = run(atlas.0.path(), command);
        assert_eq!(code, 2, "{command:?}: {err}");
        let version = env!("CARGO_PKG_VERSION");
        let message = format!("the manifest has format 2, but this is version {version}, which reads format 1");
        assert!(err.contains(&message) && err.contains("atlas.toml:2:10\n"), "{err}");
        assert!(err.contains("help: use a newer version; or write format = 1"), "{err}");
        assert_eq!(err.matches("error: the manifest").count(), 1, "{err}");
        assert!(!err.contains("has no key") && !err.contains("has no `"), "{err}");
    }
    for invalid in ["0", "-1", "1.5", "\"1\"", "true", "inf"] {
        let loaded = manifest::parse(&with_format(invalid));
        assert!(loaded.plan.is_none());
        let [problem] = &loaded.problems[..] else { panic!("{:?}", loaded.problems) };
        assert_eq!(problem.message, "unknown format version", "{invalid}");
        assert!(problem.help.starts_with("write format = 1, or leave it out"), "{}", problem.help);
    }
}

#[test]
fn writing_out_the_format_changes_nothing() {
    let inputs = |text: &str| plan(text).families[0].manifest_inputs.clone();
    let without = inputs(MANIFEST);
    for one in ["1", "1.0"] {
        assert_eq!(inputs(&with_format(one)), without, "nothing is drawn again");
    }
}

/// No file is removed or overwritten in a folder whose record has another format.
#[test]
fn a_folder_of_another_format_is_left_alone() {
    let atlas = Atlas::new(MANIFEST);
    assert_eq!(atlas.run(&["--quiet"]).0, 0);
    fs::write(atlas.out().join(".coupler-atlas-a1.tmp"), "a newer version writes this").unwrap();
    fs::write(atlas.out().join("evans/evans-001.svg"), "a newer page").unwrap();
    let path = atlas.out().join("run.json");
    for (record, format, line, writer) in [
        (
            "{\n  \"program\": \"coupler-atlas\",\n  \"format\": 2,\n  \"version\": \"0.9.0\"\n}",
            "2",
            3,
            "coupler-atlas 0.9.0",
        ),
        ("{\"format\": 99999999999999, \"version\": [0, 9]}", "99999999999999", 1, "another program"),
        ("\u{feff}{\r\n\"format\":\r\n\"two\", \"program\": \"coupler-atlas\"}", "\"two\"", 3, "coupler-atlas"),
        ("{\"format\": 0}", "0", 1, "another program"),
    ] {
        fs::write(&path, record).unwrap();
        let before = tree(&atlas.out());
        for arguments in [&[][..], &["--force"], &["--only", "evans"]] {
            let (code, out, err) = atlas.run(arguments);
            assert_eq!((code, out.as_str()), (2, ""), "{err}");
            let message =
                format!("it has format {format} on line {line}, written by {writer}, but this is coupler-atlas ");
            assert!(
                err.contains("cannot overwrite out") && err.contains("run.json: ") && err.contains(&message),
                "{err}"
            );
            assert!(err.contains("render with the version that wrote it, or into another folder with -o"), "{err}");
            assert!(tree(&atlas.out()) == before, "{record}: the folder is unchanged");
        }
        assert_eq!(atlas.run(&["-q", "-o", "other"]).0, 0, "another folder can be used");
    }
}

#[test]
fn a_record_with_other_line_ends_is_read() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let path = atlas.out().join("run.json");
    let text = fs::read_to_string(&path).unwrap();
    let as_on_windows = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    fs::write(&path, &as_on_windows).unwrap();
    assert_eq!(RunRecord::from_bytes(&fs::read(&path).unwrap()).unwrap(), (serde_json::from_str(&text).unwrap(), true));
    let (code, out, err) = atlas.run(&[]);
    assert!(code == 0 && err.is_empty() && out.contains("(unchanged)"), "{out}{err}");
    assert_eq!(fs::read_to_string(&path).unwrap(), text, "it is rewritten with the usual line ends");
    fs::write(&path, "{\"format\": 1}").unwrap();
    assert!(matches!(RunRecord::from_bytes(&fs::read(&path).unwrap()), Err(ReadError::Syntax(_))));
    // The tables of cells are read back as well.
    let cells = "cell,status,reason\n1,ok,\n2,none,\"too long, by far\"\n";
    let as_on_windows = format!("\u{feff}{}", cells.replace('\n', "\r\n"));
    let expected = [(2, "too long, by far".to_owned())];
    assert_eq!(record::read_unassembled_cells(cells.as_bytes()), expected);
    assert_eq!(record::read_unassembled_cells(as_on_windows.as_bytes()), expected);
}

/// Lines, columns and underlines of problems do not depend on the line ends.
#[test]
fn reports_are_the_same_with_windows_line_ends() {
    let broken = MANIFEST.replace("[2, 3]", "[2,\n  3]").replace("(1 + p)", "(1 + q)").replace("step", "stop");
    let broken = broken.replace("title = \"T\"", "title = 3").replace("[\"svg\"]", "[\n\"svg\",\n'swg']")
        + "note = \"\"\"\nμ {mu}\n{cell +}\"\"\"\nwhere = '''p > 2\n and q'''\n";
    let folder = TempDir::new().unwrap();
    let validate = |text: &str| {
        fs::write(folder.path().join("m.toml"), text).unwrap();
        run(folder.path(), &["validate", "m.toml"]).2
    };
    let plain = validate(&broken);
    for place in ["m.toml:2:9", "m.toml:6:1", "m.toml:10:14", "m.toml:13:19", "m.toml:14:8", "m.toml:18:6"] {
        assert!(plain.contains(place), "{place}: {plain}");
    }
    let crlf = broken.replace('\n', "\r\n");
    for (text, change) in [
        (format!("\u{feff}{broken}"), "a byte order mark"),
        (crlf.clone(), "line ends"),
        (format!("\u{feff}{crlf}"), "both"),
    ] {
        let report = validate(&text);
        assert!(!report.contains('\r'), "{change}: {report:?}");
        assert_eq!(report, plain, "{change}");
    }
}

#[test]
fn the_output_folder_may_be_written_with_backslashes() {
    for output in ["\"..\\\\there\\\\pages\"", "'..\\there\\pages'", "'../there\\pages'"] {
        let folder = TempDir::new().unwrap();
        let here = folder.path().join("here");
        fs::create_dir(&here).unwrap();
        fs::write(here.join("atlas.toml"), MANIFEST.replace("\"out\"", output).replace('\n', "\r\n")).unwrap();
        printed(&here, &["render", "-q"]);
        assert!(folder.path().join("there/pages/evans/evans-001.svg").exists(), "{output}");
        assert_eq!(fs::read_dir(&here).unwrap().count(), 1, "{output}");
    }
}

#[cfg(not(windows))]
#[test]
fn drives_are_rejected_where_they_do_not_exist() {
    for output in ["'C:\\atlas'", "\"d:/atlas\"", "'\\\\server\\share'"] {
        let loaded = manifest::parse(&MANIFEST.replace("\"out\"", output));
        let [problem] = &loaded.problems[..] else { panic!("{:?}", loaded.problems) };
        assert_eq!(problem.message, "drives and network shares exist only on Windows", "{output}");
        assert!(problem.help.contains("relative to the manifest"), "{}", problem.help);
    }
}

#[test]
fn ids_cannot_be_device_names_of_windows() {
    for id in ["con", "prn", "aux", "nul", "com0", "com9", "lpt1"] {
        let loaded = manifest::parse(&MANIFEST.replace("id = \"evans\"", &format!("id = \"{id}\"")));
        let [problem] = &loaded.problems[..] else { panic!("{:?}", loaded.problems) };
        assert_eq!(problem.message, format!("the id `{id}` is a device name on Windows"));
        assert_eq!(problem.help, format!("an id names folders and files; choose another, as in \"{id}-1\""));
    }
    for id in ["con-1", "cone", "com", "com10", "lpt", "lpta", "a-nul"] {
        assert!(manifest::parse(&MANIFEST.replace("id = \"evans\"", &format!("id = \"{id}\""))).plan.is_some(), "{id}");
    }
}
