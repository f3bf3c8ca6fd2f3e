//! The committed atlas is what the program renders from `atlas.toml`: text byte for byte, images pixel for pixel.
//!
//! After an intended change, `cargo run --release -- render --force` updates it.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

/// The files of a folder and its subfolders, by their paths relative to it, sorted.
fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            found.extend(files(&path).into_iter().map(|file| format!("{name}/{file}")));
        } else {
            found.push(path.file_name().unwrap().to_string_lossy().into_owned());
        }
    }
    found.sort();
    found
}

#[test]
fn the_committed_atlas_equals_a_fresh_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let fresh = TempDir::new().unwrap();
    let status = Command::new(env!("CARGO_BIN_EXE_coupler-atlas"))
        .args(["render", "-q", "--strict", "-o"])
        .args([fresh.path(), &root.join("atlas.toml")])
        .status()
        .unwrap();
    assert!(status.success());
    let committed = root.join("output");
    assert_eq!(files(&committed), files(fresh.path()));
    for file in files(&committed) {
        let (old, new) = (fs::read(committed.join(&file)).unwrap(), fs::read(fresh.path().join(&file)).unwrap());
        if file.ends_with(".png") {
            let pixels = |bytes: &[u8]| image::load_from_memory(bytes).unwrap().to_rgb8();
            let (old, new) = (pixels(&old), pixels(&new));
            assert_eq!(old.dimensions(), new.dimensions(), "{file}");
            let difference = old.as_raw().iter().zip(new.as_raw()).map(|(a, b)| a.abs_diff(*b)).max();
            // Blending rounds differently on machines with other vector instructions.
            assert!(difference <= Some(1), "{file} differs by {difference:?}");
        } else if file != "images.json" {
            // The digests of images differ between machines, as their bytes do.
            assert!(old == new, "{file} differs from a fresh run: `cargo run --release -- render --force` updates it");
        }
    }
}

#[test]
fn the_atlas_has_the_forty_captioned_figures() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pages = ["evans", "chebyshev", "watt", "roberts"].map(|family| {
        fs::read_to_string(root.join(format!("output/{family}/{family}-001.svg")))
            .unwrap()
            .replace("<tspan font-style=\"italic\">", "")
            .replace("</tspan>", "")
    });
    assert_eq!(pages.iter().map(|page| page.matches("class=\"curve\"").count()).collect::<Vec<_>>(), [10, 10, 14, 6]);
    assert!(pages[0].contains(">p = 2.00, r = 1.00, s = 2.59, a = 2.59</text>"));
    assert!(pages[0].contains(">r = 1, k = 2</text>"));
    assert!(pages[1].contains(">p = 6.00, r = 10.20, s = 10.20, a = 1.00</text>"));
    assert!(pages[2].contains(">p = 6.00, r = 2.00, s = 2.00, a = 5.00</text>"));
    assert!(pages[3].contains(">b = 2.00</text>"));
}
