//! A record that is lost or damaged is rebuilt from the files of the atlas, and from nothing else.

use std::fs;

use crate::support::folder::{Atlas, check_record, edit_record, files, times, tree};

const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = { width = "110 mm", height = "100 mm" }
dpi = 30
[[family]]
id = "evans"
linkage = "evans"
panels = [1, 1]
sampling = { step = "10 deg" }
cases = [{ p = 2, a = 2.6 }, { p = 3, a = 4 }]
[[family]]
id = "watt"
linkage = "watt"
sampling = { step = "10 deg" }
cases = [{ p = 3, r = 2, a = 1 }]
"#;

/// Asserts that a repair succeeds, and returns what it says.
#[track_caller]
fn repair(atlas: &Atlas) -> String {
    let (code, _, err) = atlas.run(&["--repair"]);
    assert_eq!(code, 0, "{err}");
    err
}

#[test]
fn a_lost_or_damaged_record_is_rebuilt() {
    let atlas = Atlas::rendered(MANIFEST, &[]);
    let (before, written) = (tree(&atlas.out()), times(&atlas.out()));
    let record = &before["run.json"];
    let flipped = String::from_utf8(record.clone()).unwrap().replacen("\"pages\": 2", "\"pages\": 3", 1).into_bytes();
    let path = atlas.out().join("run.json");
    for damaged in [&b""[..], b"{", &record[..record.len() / 2], &vec![0; record.len()], &flipped] {
        fs::write(&path, damaged).unwrap();
        // Both commands name what to do, and neither changes anything.
        let found = tree(&atlas.out());
        let (code, out, err) = atlas.check(&[]);
        let is_read = damaged == flipped;
        assert!(code == if is_read { 1 } else { 2 } && format!("{out}{err}").contains("render --repair"), "{out}{err}");
        for arguments in [&[][..], &["--force"], &["--only", "evans"]] {
            let (code, _, err) = atlas.run(arguments);
            assert!(code == 2 && err.contains("out/run.json") && err.contains("--repair"), "{err}");
        }
        assert!(tree(&atlas.out()) == found);
        let err = repair(&atlas);
        let rebuilt = files(&atlas.out()).len() - 2;
        assert_eq!(err, format!("note: out/run.json is rebuilt from {rebuilt} files of the atlas\n"));
        assert!(tree(&atlas.out()) == before);
        let mut now = times(&atlas.out());
        now.insert("run.json".to_owned(), written["run.json"]);
        assert!(now == written, "no other file is written");
        assert_eq!(atlas.check(&["-q"]).0, 0);
    }
    fs::remove_file(&path).unwrap();
    repair(&atlas);
    assert!(tree(&atlas.out()) == before);
    // There is nothing to repair.
    let (code, out, err) = atlas.run(&["--repair"]);
    assert!(code == 0 && err.is_empty() && out.contains("nothing has changed in out"), "{out}{err}");
    assert!(tree(&atlas.out()) == before);
}

#[test]
fn a_repair_makes_what_is_missing_and_leaves_files_of_others() {
    let atlas = Atlas::rendered(MANIFEST, &[]);
    let before = tree(&atlas.out());
    let mine = ["notes.txt", "evans/notes.svg", "evans/evans-009.svg", "other/other-001.svg"];
    fs::create_dir(atlas.out().join("other")).unwrap();
    mine.iter().for_each(|name| fs::write(atlas.out().join(name), "mine").unwrap());
    // As a failure of the machine leaves them: empty, or not there.
    for name in ["run.json", "images.json", "evans/evans-002.svg", "watt/points.csv"] {
        fs::write(atlas.out().join(name), "").unwrap();
    }
    for name in ["evans/evans-001.png", "atlas.pdf", "kernel.js"] {
        fs::remove_file(atlas.out().join(name)).unwrap();
    }
    let err = repair(&atlas);
    let named = "note: not known to be of the atlas, and left as they are: out/evans/evans-009.svg, out/evans/notes.svg, \
                 out/notes.txt, out/other/other-001.svg\n";
    assert!(err.ends_with(named), "{err}");
    let mut found = tree(&atlas.out());
    mine.iter().for_each(|name| assert_eq!(found.remove(*name).as_deref(), Some(&b"mine"[..]), "{name}"));
    assert!(found == before);
}

#[test]
fn a_file_in_the_place_of_one_of_the_atlas_is_left_and_named() {
    let atlas = Atlas::rendered(MANIFEST, &[]);
    let before = tree(&atlas.out());
    for name in ["evans/evans-001.svg", "watt/cells.csv", "atlas.pdf", "index.html"] {
        let path = atlas.out().join(name);
        fs::write(&path, "mine").unwrap();
        fs::write(atlas.out().join("run.json"), "").unwrap();
        let (code, _, err) = atlas.run(&["--repair"]);
        assert!(code == 2 && err.contains(&format!("no earlier run wrote out/{name}: move it away")), "{err}");
        // The record has the others, and is true.
        let mut found = tree(&atlas.out());
        assert_eq!(found.remove(name).as_deref(), Some(&b"mine"[..]));
        assert!(found.iter().all(|(other, bytes)| other.ends_with(".json") || *bytes == before[other]));
        let record: serde_json::Value = serde_json::from_slice(&found["run.json"]).unwrap();
        assert!(
            record["families"].as_array().unwrap().len() == 2 && !record.to_string().contains(&format!("{name}\""))
        );
        // A folder need not have a book.
        assert_eq!(atlas.check(&[]).0, i32::from(name != "atlas.pdf"), "{name}");
        assert_eq!(atlas.run(&[]).0, 2, "it is still there");
        fs::remove_file(&path).unwrap();
        let (code, _, err) = atlas.run(&[]);
        assert_eq!((code, err.as_str()), (0, ""));
        assert!(tree(&atlas.out()) == before, "{name}");
    }
    check_record(&atlas.out());
}

#[test]
fn a_folder_without_a_file_of_the_atlas_is_not_taken() {
    let atlas = Atlas::new(MANIFEST);
    fs::create_dir_all(atlas.out().join("evans")).unwrap();
    for (record, message) in [
        (Some("mine"), "cannot rebuild out/run.json: it is not the record of a run"),
        (None, "no earlier run wrote out/evans/cells.csv"),
    ] {
        match record {
            Some(text) => fs::write(atlas.out().join("run.json"), text).unwrap(),
            None => fs::remove_file(atlas.out().join("run.json")).unwrap(),
        }
        fs::write(atlas.out().join("evans/cells.csv"), "mine").unwrap();
        let before = tree(&atlas.out());
        let (code, _, err) = atlas.run(&["--repair"]);
        assert!(code == 2 && err.contains(message), "{err}");
        assert!(tree(&atlas.out()) == before);
    }
    // A record of another format is that of another version, and a folder without anything is simply rendered into.
    fs::write(atlas.out().join("run.json"), "{\"format\": 2}").unwrap();
    let (code, _, err) = atlas.run(&["--repair"]);
    assert!(code == 2 && err.contains("it has format 2"), "{err}");
    fs::remove_dir_all(atlas.out()).unwrap();
    assert_eq!(repair(&atlas), "");
    check_record(&atlas.out());
}

/// Files of an earlier state of the manifest are those of the atlas if the journal or `images.json` says so.
#[test]
fn a_repair_knows_files_by_the_journal_and_by_images_json() {
    let changed = MANIFEST.replace("p = 3, a = 4", "p = 3, a = 4.1").replace("step = \"10 deg\"", "step = \"6 deg\"");
    let [atlas, fresh] = [MANIFEST, &changed].map(|manifest| Atlas::rendered(manifest, &[]));
    atlas.edit(&changed);
    // A run that has begun, and written nothing: its journal has what `run.json` said.
    let journal = atlas.out().join(".coupler-atlas.journal");
    let lines = journal_of(&atlas);
    fs::write(atlas.out().join("run.json"), "").unwrap();
    // Without the journal only the images are known.
    let (code, _, err) = atlas.run(&["--repair"]);
    assert!(code == 2 && err.contains("no earlier run wrote out/evans/cells.csv and "), "{err}");
    assert!(!err.contains(".png") && !err.contains("atlas.pdf"), "{err}");
    fs::write(atlas.out().join("run.json"), "").unwrap();
    fs::write(&journal, lines).unwrap();
    repair(&atlas);
    assert!(tree(&atlas.out()) == tree(&fresh.out()));
}

/// The journal with which a run begins that replaces the files of an atlas.
fn journal_of(atlas: &Atlas) -> Vec<u8> {
    let read = |name: &str| serde_json::from_str::<serde_json::Value>(&atlas.read(name)).unwrap();
    let (run, images) = (read("run.json"), read("images.json"));
    let mut header = run.clone();
    for key in ["book", "gallery", "kernel", "sha256"] {
        header.as_object_mut().unwrap().remove(key);
    }
    header["families"] = serde_json::json!([]);
    let mut entries = vec![serde_json::json!({ "atlas": header })];
    let written = |folder: &str, file: &serde_json::Value| {
        let mut entry = file.clone();
        let path = format!("{folder}{}", file["name"].as_str().unwrap());
        entry["image_sha256"] = images["files"][&path].clone();
        entry["path"] = path.into();
        entry["name"] = "".into();
        serde_json::json!({ "written": entry })
    };
    for family in run["families"].as_array().unwrap() {
        let mut without_files = family.clone();
        without_files["files"] = serde_json::json!([]);
        entries.push(serde_json::json!({ "family": without_files }));
        let folder = format!("{}/", family["id"].as_str().unwrap());
        entries.extend(family["files"].as_array().unwrap().iter().map(|file| written(&folder, file)));
    }
    let mut book = run["book"].clone();
    book["files"] = serde_json::json!([]);
    entries.push(serde_json::json!({ "book": book }));
    let others = [&run["book"]["files"][0], &run["gallery"], &run["kernel"]];
    entries.extend(others.map(|file| written("", file)));
    entries.iter().flat_map(|entry| format!("{entry}\n").into_bytes()).collect()
}

/// The folder of a repair that was killed is removed by the next run.
#[test]
fn the_temporary_folder_of_a_repair_does_not_stay() {
    let atlas = Atlas::rendered(MANIFEST, &["--format", "svg"]);
    let before = tree(&atlas.out());
    fs::create_dir_all(atlas.out().join(".coupler-atlas-a1B2c3.tmp/evans")).unwrap();
    fs::write(atlas.out().join(".coupler-atlas-a1B2c3.tmp/run.json"), "").unwrap();
    edit_record(&atlas.out(), |run| run["families"][0]["pages"] = 7.into());
    let (code, _, err) = atlas.run(&["--format", "svg"]);
    assert_eq!(code, 0, "{err}");
    assert!(tree(&atlas.out()) == before);
}
