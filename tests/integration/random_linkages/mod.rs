//! Random linkages are rendered, and checked at once: the check finds nothing.

mod generator;

use std::process::Command;

use super::folder::Atlas;
use generator::{KIND_COUNT, Random, manifest};

/// The findings of a check right after the render.
fn findings(text: &str) -> Vec<serde_json::Value> {
    let atlas = Atlas::new(text);
    let (code, _, errors) = atlas.run(&["-q", "-o", "out"]);
    assert_eq!(code, 0, "{errors}\n{text}");
    let output = Command::new(env!("CARGO_BIN_EXE_coupler-atlas"))
        .current_dir(atlas.0.path())
        .args(["check", "--against", "out", "--report", "json", "-q"])
        .output()
        .unwrap();
    let report: serde_json::Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}\n{text}", String::from_utf8_lossy(&output.stderr)));
    assert!(report["curves"].as_u64().is_some_and(|curves| curves > 50), "{report}\n{text}");
    report["findings"].as_array().unwrap().clone()
}

/// A number from the environment.
fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

/// By default on 198 linkages; `RANDOM_LINKAGES=5000` sets their number, and `RANDOM_SEED=…` the seed.
#[test]
fn a_check_right_after_the_render_finds_nothing() {
    const CELLS: usize = 3;
    let manifests = (number("RANDOM_LINKAGES", 198) as usize).div_ceil(CELLS * KIND_COUNT);
    let mut random = Random(number("RANDOM_SEED", 1951));
    for _ in 0..manifests {
        let text = manifest(&mut random, 0..KIND_COUNT, CELLS);
        let found = findings(&text);
        assert!(found.is_empty(), "{found:#?}\n{text}");
    }
}
