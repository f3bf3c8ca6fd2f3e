//! The page's scripts under node; skipped if node is not installed, unless `CI` is true. `.ci/gallery` installs it.

use std::env;
use std::path::Path;
use std::process::Command;

/// Runs a script of `tests/gallery` under node.
fn node(script: &str, arguments: &[&Path]) {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gallery").join(script);
    let Ok(output) = Command::new("node").arg(&script).args(arguments).output() else {
        assert!(env::var("CI").as_deref() != Ok("true"), "node is not installed");
        eprintln!("skipped: node is not installed, and {} cannot run", script.display());
        return;
    };
    let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{stdout}{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn the_page_finds_the_files_with_its_data() {
    node("data.mjs", &[]);
}

/// Tests plates, filters and exports with the families of the committed atlas.
#[test]
fn the_page_computes_with_the_committed_atlas() {
    let atlas = Path::new(env!("CARGO_MANIFEST_DIR")).join("output");
    for script in ["plate-parts.mjs", "find.mjs", "export-parts.mjs"] {
        node(script, &[&atlas]);
    }
}
