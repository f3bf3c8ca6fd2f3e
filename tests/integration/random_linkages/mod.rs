//! Random linkages are rendered, and checked at once: the check finds nothing.

pub mod generator;

use std::fs;
use std::process::Command;

use sha2::{Digest, Sha256};

use super::folder::Atlas;
use generator::{KIND_COUNT, Random, manifest};

/// The findings of a check right after the render, and of one after each page was given a comment: pages with other bytes
/// than those of a fresh drawing are read back, and their curves compared with the linkages.
fn findings(text: &str) -> [Vec<serde_json::Value>; 2] {
    let atlas = Atlas::new(text);
    let (code, _, errors) = atlas.run(&["-q", "-o", "out"]);
    assert_eq!(code, 0, "{errors}\n{text}");
    let first = check(&atlas, text);
    add_comments(&atlas);
    [first, check(&atlas, text)]
}

fn check(atlas: &Atlas, text: &str) -> Vec<serde_json::Value> {
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

/// Adds a comment to each page, and records its digest as if a run had written it so.
fn add_comments(atlas: &Atlas) {
    let path = atlas.out().join("run.json");
    let mut run: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    for family in run["families"].as_array_mut().unwrap() {
        let folder = atlas.out().join(family["id"].as_str().unwrap());
        for file in family["files"].as_array_mut().unwrap() {
            let name = file["name"].as_str().unwrap().to_owned();
            if name.ends_with(".svg") {
                let page = fs::read_to_string(folder.join(&name)).unwrap().replace("</svg>", "<!-- --></svg>");
                file["sha256"] = format!("{:x}", Sha256::digest(&page)).into();
                fs::write(folder.join(&name), page).unwrap();
            }
        }
    }
    fs::write(path, run.to_string()).unwrap();
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
        let [found, read_back] = findings(&text);
        assert!(found.is_empty(), "{found:#?}\n{text}");
        let is_comment = |finding: &serde_json::Value| finding["kind"] == "drawing";
        assert!(!read_back.is_empty() && read_back.iter().all(is_comment), "{read_back:#?}\n{text}");
    }
}
