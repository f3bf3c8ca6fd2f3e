//! Completions: what shells offer, and the list of families that they use.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::support::command::{PROGRAM, folder_with, run};

fn folder_with_manifest() -> TempDir {
    let family = |id: &str| {
        format!(
            "[[family]]\nid = \"{id}\"\nlinkage = \"evans\"\nsampling = {{ samples = 9 }}\ncases = [{{ p = 2, a = 2.5 }}]\n"
        )
    };
    folder_with(&format!("[atlas]\ntitle = \"T\"\n{}{}", family("mine"), family("other")))
}

#[test]
fn the_families_of_a_manifest_are_listed() {
    let folder = folder_with_manifest();
    assert_eq!(run(folder.path(), &["list", "families"]), (0, "mine\nother\n".to_owned(), String::new()));
    assert_eq!(run(folder.path(), &["list", "families", "atlas.toml"]).1, "mine\nother\n");
    let (code, _, err) = run(folder.path(), &["list", "families", "no.toml"]);
    assert!(code == 2 && err.contains("cannot find no.toml"), "{err}");
    let (code, _, err) = run(folder.path(), &["list", "themes", "atlas.toml"]);
    assert!(code == 2 && err.contains("or `list families atlas.toml` for"), "{err}");
    // They are not built in.
    assert!(!run(folder.path(), &["list"]).1.contains("families\n"));
}

#[test]
fn every_shell_has_completions_without_placeholders() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let (code, script, err) = run(Path::new("."), &["completions", shell]);
        assert_eq!(code, 0, "{shell}: {err}");
        assert!(!script.contains("FAMILIES"), "{shell}");
        if ["bash", "zsh", "fish"].contains(&shell) {
            assert!(script.contains("hrones-nelson"), "{shell}: linkages");
            assert_eq!(script.matches("list families 2>/dev/null").count(), 3, "{shell}: --only of three commands");
        }
    }
}

/// The linkage of a manifest, which is not offered, is accepted all the same.
#[test]
fn offered_values_are_not_the_only_ones() {
    let folder = TempDir::new().unwrap();
    assert_eq!(run(folder.path(), &["init"]).0, 0);
    let arguments = ["inspect", "my-four-bar", "frame=3", "--manifest", "atlas.toml"];
    assert_eq!(run(folder.path(), &arguments).0, 0);
    assert!(run(folder.path(), &["inspect", "hokken"]).2.contains("did you mean `hoeken`?"));
}

/// What bash offers for the last word of a command line.
#[cfg(unix)]
fn offered_by_bash(folder: &Path, line: &[&str]) -> Vec<String> {
    fs::write(folder.join("completions.bash"), run(folder, &["completions", "bash"]).1).unwrap();
    // What bash does when the key is pressed.
    let script = "source ./completions.bash\nCOMP_WORDS=(\"$@\")\nCOMP_CWORD=$(($# - 1))\n\
                  compopt() { :; }\n_coupler__atlas \"$1\" \"${COMP_WORDS[COMP_CWORD]}\" \"${COMP_WORDS[COMP_CWORD - 1]}\"\n\
                  printf '%s\\n' \"${COMPREPLY[@]}\"\n";
    let output = Command::new("bash").current_dir(folder).args(["-c", script, "bash", PROGRAM]).args(line).output();
    let output = output.expect("bash can be run");
    assert!(output.status.success() && output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut words: Vec<String> = String::from_utf8(output.stdout).unwrap().lines().map(str::to_owned).collect();
    words.retain(|word| !word.is_empty());
    words.sort();
    words
}

/// Thorough because it needs bash.
#[cfg(unix)]
#[test]
#[ignore = "thorough"]
fn bash_offers_linkages_families_and_formats() {
    let folder = folder_with_manifest();
    assert_eq!(offered_by_bash(folder.path(), &["in"]), ["init", "inspect"]);
    for (line, expected) in [
        (&["inspect", "ho"][..], &["hoeken"][..]),
        (&["export", "--linkage", "watt-s"], &["watt-six-bar"]),
        (&["design", "straight-line", "--types", "e"], &["evans"]),
        (&["design", "hr"], &["hrones-nelson"]),
        (&["render", "--only", ""], &["mine", "other"]),
        (&["check", "--only", "o"], &["other"]),
        (&["render", "--format", "p"], if cfg!(feature = "pdf") { &["pdf", "png"] } else { &["png"] }),
        (&["export", "--format", "m"], &["moving-svg"]),
        (&["validate", "--report", "j"], &["json"]),
        (&["check", "--report", "j"], &["json", "junit"]),
        (&["list", "fam"], &["families"]),
        (&["render", "--color", "a"], &["always", "auto"]),
        (&["validate", "--rep"], &["--report"]),
    ] {
        assert_eq!(offered_by_bash(folder.path(), line), expected, "{line:?}");
    }
    // Without a manifest there are no families, and no message.
    fs::remove_file(folder.path().join("atlas.toml")).unwrap();
    assert!(offered_by_bash(folder.path(), &["render", "--only", ""]).is_empty());
}
