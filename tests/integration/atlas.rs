//! The recorded atlas is what the program renders from `atlas.toml`, by the digests of its tables and pages; what Git ignores of `output` is made
//! by the same run.
//!
//! After an intended change, `.ci/renew` renews it.

use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};
use tempfile::TempDir;

use crate::recorded::{are_renewed, renew};
use crate::support::command::printed;
use crate::support::folder::files;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Renders `atlas.toml`, or some of its families, into another folder.
fn rendered(more: &[&str]) -> TempDir {
    let fresh = TempDir::new().unwrap();
    let manifest = root().join("atlas.toml");
    let arguments = ["render", "-q", "--strict", "-o", fresh.path().to_str().unwrap(), manifest.to_str().unwrap()];
    printed(root(), &[&arguments, more].concat());
    fresh
}

#[test]
#[ignore = "thorough"]
fn the_recorded_atlas_equals_a_fresh_run() {
    let (fresh, recorded) = (rendered(&[]), root().join("output"));
    let [new, old] = [fresh.path(), &recorded].map(|folder| fs::read_to_string(folder.join("run.json")).unwrap());
    let differing = new.lines().zip(old.lines()).find(|(new, old)| new != old);
    assert!(new == old, "output/run.json is not that of a fresh run: .ci/renew; {differing:?}");
    // The record has the digests of all of them, and lists what is made.
    let record: serde_json::Value = serde_json::from_str(&old).unwrap();
    let is_kept = |name: &String| name.ends_with(".csv") || name.ends_with(".svg");
    let mut kept = 0;
    for family in record["families"].as_array().unwrap() {
        for file in family["files"].as_array().unwrap() {
            let name = format!("{}/{}", family["id"].as_str().unwrap(), file["name"].as_str().unwrap());
            assert!(fresh.path().join(&name).is_file(), "{name}");
            if is_kept(&name) {
                let bytes = fs::read(recorded.join(&name)).unwrap_or_else(|error| panic!("output/{name}: {error}"));
                assert_eq!(format!("{:x}", Sha256::digest(bytes)), file["sha256"], "output/{name} was edited");
                kept += 1;
            }
        }
    }
    assert_eq!(
        files(&recorded).iter().filter(|name| is_kept(name)).count(),
        kept,
        "output has tables or pages of no family"
    );
}

/// The picture of README.md is a page of the atlas, whose pixels may differ by 1 from machine to machine.
#[test]
#[ignore = "thorough"]
fn the_picture_of_a_page_is_recorded() {
    const PICTURE: &str = "docs/images/page.png";
    let fresh = rendered(&["--only", "hrones-nelson"]);
    let page = fs::read(fresh.path().join("hrones-nelson/hrones-nelson-001.png")).unwrap();
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).unwrap().to_rgb8();
    let is_same = |old: &[u8]| {
        let (old, new) = (pixels(old), pixels(&page));
        old.dimensions() == new.dimensions() && old.as_raw().iter().zip(new.as_raw()).all(|(a, b)| a.abs_diff(*b) <= 1)
    };
    if are_renewed() && !is_same(&fs::read(root().join(PICTURE)).unwrap()) {
        renew(PICTURE, &page);
    }
    assert!(is_same(&fs::read(root().join(PICTURE)).unwrap()), "{PICTURE} is not the page: .ci/renew");
}

#[test]
fn the_atlas_has_the_forty_captioned_figures() {
    let pages = ["evans", "chebyshev", "watt", "roberts"].map(|family| {
        fs::read_to_string(root().join(format!("output/{family}/{family}-001.svg")))
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
