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
    let (lines, _) = lines.split_once("\n    - name: ").unwrap();
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

/// Tolerances and families are passed on, and counts and a summary given back.
#[test]
fn inputs_are_options_and_outputs_are_counts() {
    let folder = folder_with(&MANIFEST.replace("id = \"f\"", "id = \"g\"\nlinkage = \"evans\"\nsampling = { samples = 12 }\ncases = [{ p = 2 , a = 2.5 }]\n[[family]]\nid = \"f\""));
    let path = folder.path();
    fs::create_dir(path.join("coupler-atlas")).unwrap();
    symlink(PROGRAM, path.join("coupler-atlas/coupler-atlas")).unwrap();
    assert_eq!(run(path, &["render", "-o", "output", "--format", "svg", "-q"]).0, 0);
    let table = fs::read_to_string(path.join("output/f/points.csv")).unwrap();
    fs::write(path.join("output/f/points.csv"), table.replacen(",0,", ",0.001,", 1)).unwrap();
    let check = |inputs: &[(&str, &str)]| {
        let mut command = Command::new("bash");
        command.args(["--noprofile", "--norc", "-eo", "pipefail", "-c", &script()]).current_dir(path);
        command.envs([("MANIFEST", "atlas.toml"), ("AGAINST", "output")]).envs(inputs.iter().copied());
        for (name, file) in [("GITHUB_OUTPUT", "outputs"), ("GITHUB_STEP_SUMMARY", "summary")] {
            let _ = fs::remove_file(path.join(file));
            command.env(name, path.join(file));
        }
        let (code, _, err) = result(command.env("RUNNER_TEMP", path).output().unwrap());
        let read = |file: &str| fs::read_to_string(path.join(file)).unwrap_or_default();
        (code, err, read("outputs"), read("summary"))
    };
    let (code, err, outputs, summary) = check(&[]);
    assert_eq!((code, err.as_str()), (1, ""));
    let lines: Vec<&str> = outputs.lines().collect();
    let findings: usize = lines[0].strip_prefix("findings=").unwrap().parse().unwrap();
    assert!(findings > 0 && lines[1] == "differences=true" && lines[2].starts_with("report="), "{outputs}");
    assert!(summary.contains("| f |"), "{summary}");
    let (code, _, outputs, _) = check(&[("ONLY", "g")]);
    assert!(code == 0 && outputs.starts_with("findings=0\ndifferences=false\n"), "{outputs}");
    let wrong = [("ONLY", "f g"), ("ATOL", "much"), ("RTOL", "1e-3"), ("MEASURE_RTOL", "1"), ("IGNORE", "length x_y")];
    let (code, err, outputs, _) = check(&wrong);
    assert!(code == 2 && outputs.is_empty(), "{err}");
    let (code, err, ..) =
        check(&[("ONLY", "g f"), ("ATOL", "10"), ("RTOL", "10"), ("MEASURE_RTOL", "10"), ("IGNORE", "length area")]);
    assert_eq!((code, err.as_str()), (1, ""), "the table is not the file that was recorded");
}
