//! The action of GitHub passes its inputs on as they are given.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use crate::support::command::{PROGRAM, folder_with, result, run};

const MANIFEST: &str =
    "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\nlinkage = \"hoeken\"\nsampling = { samples = 12 }\ncases = [{}]\n";

/// The script of the step that checks, without its indentation.
fn script() -> String {
    let action = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/action.yml")).unwrap();
    let (_, step) = action.split_once("- name: Check the atlas\n").unwrap();
    let (_, lines) = step.split_once("run: |\n").unwrap();
    lines.lines().map(|line| line.strip_prefix("        ").unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// An input that begins with a hyphen names a file or a folder, and is neither an option nor standard input.
#[test]
fn an_input_that_begins_with_a_hyphen_is_a_path() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    fs::create_dir(path.join("coupler-atlas")).unwrap();
    symlink(PROGRAM, path.join("coupler-atlas/coupler-atlas")).unwrap();
    let check = |manifest: &str, against: &str, diff: &str, report: &str| {
        let mut command = Command::new("bash");
        command.args(["--noprofile", "--norc", "-eo", "pipefail", "-c", &script()]).current_dir(path);
        let inputs = [("MANIFEST", manifest), ("AGAINST", against), ("DIFF", diff), ("REPORT", report)];
        result(command.envs(inputs).env("RUNNER_TEMP", path).output().unwrap())
    };
    for (manifest, against) in [("atlas.toml", "recorded"), ("-", "--"), ("--strict", "-q"), ("-o x.toml", "--bless")] {
        let at = |name: &str| format!("./{name}");
        if manifest != "atlas.toml" {
            fs::copy(path.join("atlas.toml"), path.join(manifest)).unwrap();
        }
        let (code, _, err) = run(path, &["render", &at(manifest), "-o", &at(against), "--format", "svg", "-q"]);
        assert_eq!(code, 0, "{err}");
        let before = fs::read(path.join(against).join("run.json")).unwrap();
        fs::write(path.join(against).join("f/f-001.svg"), "changed").unwrap();
        let (code, _, err) = check(manifest, against, "--diff-of", "-reports/-r.xml");
        assert_eq!((code, err.as_str()), (1, "0 curves drawn in ./--diff-of\n"), "{manifest} {against}");
        assert!(fs::read_to_string(path.join("-reports/-r.xml")).unwrap().contains("f/f-001.svg"));
        assert_eq!(fs::read(path.join(against).join("run.json")).unwrap(), before, "nothing is replaced");
        fs::remove_dir_all(path.join("-reports")).unwrap();
    }
}
