//! Damage to any file of an atlas is found, and images are compared by their pixels where their bytes differ.

use std::fs;

use crate::support::folder::{Atlas, edit_record, files, tree, update_digest};

const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = { width = "100 mm", height = "100 mm" }
dpi = 25
[[family]]
id = "evans"
linkage = "evans"
panels = [1, 1]
sampling = { samples = 24 }
cases = [{ p = 2, a = 2.5 }, { p = 3, a = 4.0 }]
"#;

fn rendered() -> Atlas {
    Atlas::rendered(MANIFEST, &[])
}

/// The exit code and output of a check.
fn check(atlas: &Atlas) -> (i32, String) {
    let (code, out, _) = atlas.check(&["-q"]);
    (code, out)
}

#[test]
#[ignore = "thorough"]
fn damage_to_every_region_of_every_recorded_file_is_found() {
    /// The number of regions of a file, each of which is overwritten in turn.
    const REGIONS: usize = 7;
    let atlas = rendered();
    assert_eq!(check(&atlas), (0, String::new()));
    for name in files(&atlas.out()).into_iter().filter(|name| name != "run.json") {
        let path = atlas.out().join(&name);
        let original = fs::read(&path).unwrap();
        for region in 0..REGIONS {
            let [from, to] = [region, region + 1].map(|k| k * original.len() / REGIONS);
            // Zeros, as after a crash of the machine, and a single flipped bit.
            let mut zeroed = original.clone();
            zeroed[from..to].fill(0);
            let mut flipped = original.clone();
            flipped[(from + to) / 2] ^= 1;
            for damaged in [&zeroed, &flipped] {
                fs::write(&path, damaged).unwrap();
                let (code, out) = check(&atlas);
                assert!(code == 1 && out.contains(&name), "{name}, region {region}: {code} {out}");
            }
        }
        fs::write(&path, &original[..original.len() / 2]).unwrap();
        assert_eq!(check(&atlas).0, 1, "{name} is cut short");
        fs::remove_file(&path).unwrap();
        assert_eq!(check(&atlas).0, 1, "{name} is missing");
        fs::write(&path, &original).unwrap();
    }
    // The record itself: damaged so that it cannot be read, or so that it says something else.
    let path = atlas.out().join("run.json");
    let original = fs::read(&path).unwrap();
    for k in (0..original.len()).step_by(97) {
        let mut damaged = original.clone();
        damaged[k] ^= 4;
        fs::write(&path, &damaged).unwrap();
        let (code, out) = check(&atlas);
        let text = String::from_utf8_lossy(&damaged[k.saturating_sub(40)..(k + 40).min(damaged.len())]).into_owned();
        assert_ne!(code, 0, "byte {k}, in {text}: {out}");
    }
    fs::write(&path, &original).unwrap();
    assert_eq!(check(&atlas), (0, String::new()));
}

/// A record may be edited so that it has a right digest of itself: what it says of inputs is compared with the manifest.
#[test]
fn inputs_that_are_not_those_of_the_manifest_are_found() {
    let atlas = rendered();
    let original = fs::read(atlas.out().join("run.json")).unwrap();
    let other = "0".repeat(64);
    let with_pointer = |pointer: &str, value: serde_json::Value| {
        edit_record(&atlas.out(), |run| *run.pointer_mut(pointer).unwrap() = value);
        let found = check(&atlas);
        fs::write(atlas.out().join("run.json"), &original).unwrap();
        found
    };
    let run: serde_json::Value = serde_json::from_slice(&original).unwrap();
    let mut pointers = vec!["/book/inputs_sha256".to_owned(), "/book/files/0/inputs_sha256".to_owned()];
    for (k, family) in run["families"].as_array().unwrap().iter().enumerate() {
        pointers.push(format!("/families/{k}/inputs_sha256"));
        let files = family["files"].as_array().unwrap().iter().enumerate();
        let pages = files.filter(|(_, file)| !file["inputs_sha256"].is_null());
        pointers.extend(pages.map(|(file, _)| format!("/families/{k}/files/{file}/inputs_sha256")));
    }
    assert!(pointers.len() > 4, "{pointers:?}");
    for pointer in &pointers {
        let (code, out) = with_pointer(pointer, other.as_str().into());
        assert!(code == 1 && out.contains("run.json") && out.contains("inputs_sha256"), "{pointer}: {out}");
    }
    let (code, out) = with_pointer("/program", "another-atlas".into());
    assert!(code == 1 && out.contains("another-atlas"), "{out}");
    assert_eq!(check(&atlas), (0, String::new()));
    // `render` records them again.
    edit_record(&atlas.out(), |run| *run.pointer_mut(&pointers[2]).unwrap() = other.as_str().into());
    assert_eq!(atlas.run(&[]).0, 0);
    assert!(fs::read(atlas.out().join("run.json")).unwrap() == original);
    // How a manifest is written does not matter, nor do keys that change no file.
    atlas.edit(&format!(
        "# A comment.\n{}",
        MANIFEST.replace(" = ", "  =  ").replace("\"svg\", \"png\"", "\"png\", \"svg\"")
    ));
    assert_eq!(check(&atlas), (0, String::new()));
}

#[test]
fn swapped_images_and_a_damaged_book_are_found_and_renewed() {
    let atlas = rendered();
    let expected = tree(&atlas.out());
    let [first, second] = ["evans/evans-001.png", "evans/evans-002.png"].map(|name| atlas.out().join(name));
    let book = atlas.out().join("atlas.pdf");
    let swapped = atlas.out().join("swapped");
    fs::rename(&first, &swapped).unwrap();
    fs::rename(&second, &first).unwrap();
    fs::rename(&swapped, &second).unwrap();
    let mut bytes = fs::read(&book).unwrap();
    let quarter = bytes.len() / 4;
    bytes[quarter..3 * quarter].fill(0);
    fs::write(&book, bytes).unwrap();
    let (code, out) = check(&atlas);
    assert_eq!(code, 1);
    for name in ["evans/evans-001.png", "evans/evans-002.png", "atlas.pdf"] {
        assert!(out.contains(&format!("altered  {name}")), "{out}");
    }
    let (code, out, _) = atlas.run(&[]);
    assert!(code == 0 && !out.contains("unchanged"), "{out}");
    assert!(tree(&atlas.out()) == expected);
    // A damaged images.json makes images be drawn again, and is renewed.
    fs::write(atlas.out().join("images.json"), "{}").unwrap();
    assert!(check(&atlas).1.contains("images.json"));
    assert_eq!(atlas.run(&[]).0, 0);
    assert!(tree(&atlas.out()) == expected);
}

#[test]
fn an_image_with_other_bytes_and_equal_pixels_is_the_same_image() {
    let atlas = rendered();
    let path = atlas.out().join("evans/evans-001.png");
    let original = image::load_from_memory(&fs::read(&path).unwrap()).unwrap();
    let save = |image: &image::DynamicImage| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        fs::write(&path, bytes.into_inner()).unwrap();
    };
    save(&original.to_rgba8().into());
    assert_eq!(check(&atlas), (0, String::new()));
    for (difference, is_found) in [(1, false), (2, true)] {
        let mut changed = original.to_rgba8();
        let pixel = changed.get_pixel_mut(40, 30);
        pixel[0] = if pixel[0] > 100 { pixel[0] - difference } else { pixel[0] + difference };
        save(&changed.into());
        assert_eq!(check(&atlas).0, i32::from(is_found), "{difference}");
    }
    // Another size, and something that is no image.
    save(&original.crop_imm(0, 0, 20, 20));
    assert!(check(&atlas).1.contains("altered"));
}

/// Drawings may differ in another version, and measures that it defines otherwise: one notice says so, which is no difference. Of a later version
/// nothing is known.
#[test]
fn an_atlas_of_another_version_is_compared_as_far_as_both_define_it() {
    let atlas = rendered();
    let record = atlas.out().join("run.json");
    let set_version = |version: &str| edit_record(&atlas.out(), |run| run["version"] = version.into());
    // A column that this version does not have, one that it defines otherwise, and a page that it draws differently, as that version recorded them.
    let cells = atlas.out().join("evans/cells.csv");
    let table = fs::read_to_string(&cells).unwrap();
    let (header, rows) = table.split_once('\n').unwrap();
    let at = |name: &str| header.split(',').position(|column| column == name).unwrap();
    let with = |name: &str, value: &str| {
        let edited = |row: &str| {
            let mut fields: Vec<&str> = row.split(',').collect();
            fields[at(name)] = value;
            fields.join(",")
        };
        rows.lines().map(edited).collect::<Vec<_>>().join("\n")
    };
    let unknown = header.replace("mu_min_deg", "least_mu");
    fs::write(&cells, format!("{unknown}\n{}\n", with("inflections", "7"))).unwrap();
    set_version(env!("CARGO_PKG_VERSION"));
    assert!(check(&atlas).1.lines().count() > 1);
    let edited = |line: &&str| !line.starts_with("altered");
    for (version, words, expected) in
        [("0.0.9", "defined anew: symmetry", 0), ("99.1.0", "check the atlas with that version", 1)]
    {
        set_version(version);
        let (_, out) = check(&atlas);
        // The table was edited here without its digest.
        let lines: Vec<&str> = out.lines().filter(edited).collect();
        assert!(lines[0].contains("outdated") && lines[0].contains(words), "{out}");
        assert!(lines.len() == 2 && lines[1].contains("1 family") | lines[1].contains("famil"), "{out}");
        update_digest(&atlas.out(), "evans", "cells.csv");
        assert_eq!(check(&atlas).0, expected, "{out}");
    }
    // A measure that both define alike is compared, but not with a later version.
    fs::write(&cells, format!("{header}\n{}\n", with("length", "7"))).unwrap();
    for (version, expected) in [("0.0.9", true), ("99.1.0", false)] {
        set_version(version);
        assert_eq!(check(&atlas).1.contains("length was 7"), expected);
    }
    // Curves are compared as always.
    let points = atlas.out().join("evans/points.csv");
    let table = fs::read_to_string(&points).unwrap();
    let line = table.lines().nth(3).unwrap();
    let (rest, _) = line.rsplit_once(',').unwrap();
    fs::write(&points, table.replace(line, &format!("{rest},7.5"))).unwrap();
    set_version("0.0.9");
    assert!(check(&atlas).1.contains("moved"));
    // A record of an older format says the same.
    fs::write(&record, "{\"format\": 0, \"program\": \"coupler-atlas\", \"version\": \"0.0.1\"}").unwrap();
    let (code, _, err) = atlas.check(&[]);
    assert!(code == 2 && err.lines().count() == 1 && err.contains("render the atlas again"), "{err}");
}
