//! A second run draws what has changed and nothing else, also after an interrupted or killed run.

use std::fs;
use std::process::{Child, Command, Output, Stdio};
use std::time::SystemTime;

use crate::support::folder::{Atlas, check_record, files, times, tree};

/// Three pages of panels, one of charts, one with a cell that is not assembled.
const MANIFEST: &str = r#"[atlas]
title = "T"
output = "out"
formats = ["svg", "png"]
[page]
paper = { width = "120 mm", height = "100 mm" }
dpi = 40
[[family]]
id = "evans"
linkage = "evans"
panels = [1, 1]
sampling = { step = "10 deg" }
cases = [{ p = 2, a = 2.5 }, { p = 3, a = 4.0 }, { p = 4, a = 5.6 }]
[[family]]
id = "over"
linkage = "evans"
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4] }
let = { a = "(1 + p)^1.5 / 2" }
layout = "chart"
chart = { x = "p", y = ["length"] }
[[family]]
id = "far"
linkage = "mine"
panels = [1, 1]
sampling = { samples = 20 }
cases = [{ p = 4 }, { p = 90 }]
[[linkage]]
id = "mine"
parameters = { p = { min = 0 } }
caption = "p = {p:.1}"
trace = ["M"]
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = ["p", 0] }
A = { crank = "O", length = 1 }
B = { dyad = ["A", "C"], lengths = [4, 3], side = "left" }
M = { point = ["A", "B"], along = 2, across = 1 }
"#;

impl Atlas {
    /// Renders; the standard output, and the names of the files written or removed.
    fn touched(&self, arguments: &[&str]) -> (String, Vec<String>) {
        let before = times(&self.out());
        let (code, out, err) = self.run(arguments);
        assert_eq!(code, 0, "{err}");
        let after = times(&self.out());
        let names = before.keys().chain(after.keys().filter(|name| !before.contains_key(*name)));
        let mut touched: Vec<String> = names.filter(|&name| before.get(name) != after.get(name)).cloned().collect();
        touched.sort();
        check_record(&self.out());
        (out, touched)
    }
}

/// A grid of panels that depends on the number of cells changes pages on which the cells are the same.
#[test]
fn another_number_of_cells_changes_the_grid_of_a_page() {
    let with = |values: &str| {
        format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"svg\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
             sampling = {{ step = \"10 deg\" }}\nwhere = \"p < 4\"\ngrid = {{ a = 2.5, p = [{values}] }}\n"
        )
    };
    let atlas = Atlas::new(&with("2, 3"));
    atlas.touched(&[]);
    atlas.edit(&with("2, 3, 5"));
    let (_, touched) = atlas.touched(&[]);
    assert!(touched.iter().any(|name| name.ends_with("e-001.svg")), "{touched:?}");
    assert!(atlas.touched(&[]).1.iter().all(|name| !name.ends_with(".svg")));
}

#[test]
fn an_unchanged_atlas_is_left_alone() {
    let atlas = Atlas::new(MANIFEST);
    let (_, out, _) = atlas.run(&[]);
    assert!(out.contains("evans: 3 cells, 3 curves, 3 pages\n"), "{out}");
    let (out, touched) = atlas.touched(&[]);
    assert_eq!(touched, [""; 0]);
    assert!(out.contains("evans: 3 cells, 3 curves, 3 pages (unchanged)\n"), "{out}");
    assert!(out.contains("over: 3 cells, 3 curves, 1 page (unchanged)\n"), "{out}");
    // Writing the same values differently changes nothing.
    atlas.edit(&MANIFEST.replace("dpi = 40", "dpi = 40.0 # coarse").replace("p = 3, a = 4.0", "p=3,   a=4"));
    assert_eq!(atlas.touched(&[]).1, [""; 0]);
    // Cells that are not assembled are still reported.
    let (code, out, err) = atlas.run(&["--strict"]);
    assert_eq!(code, 1);
    assert!(out.contains("far: 2 cells (1 not assembled), 1 curve, 2 pages (unchanged)\n"), "{out}");
    assert!(err.contains("warning: far, cell 2: B cannot be placed: A and C are "), "{err}");
}

#[test]
fn force_draws_everything() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let before = tree(&atlas.out());
    let (out, touched) = atlas.touched(&["--force"]);
    // All files but the gallery's page and kernel and the digests of images, which are not drawn.
    assert_eq!(touched.len() + 3, before.len(), "{touched:?}");
    assert!(["images.json", "index.html", "kernel.js"].iter().all(|name| !touched.contains(&(*name).to_owned())));
    assert!(!out.contains("unchanged") && !out.contains("drawn"), "{out}");
    assert_eq!(tree(&atlas.out()), before);
}

#[test]
fn a_changed_case_draws_its_page() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let changed = MANIFEST.replace("{ p = 3, a = 4.0 }", "{ p = 3, a = 4.123456 }");
    atlas.edit(&changed);
    let (out, touched) = atlas.touched(&[]);
    assert!(out.contains("evans: 3 cells, 3 curves, 3 pages (1 of 3 pages drawn)\n"), "{out}");
    let expected = [
        "evans/cells.csv",
        "evans/evans-002.png",
        "evans/evans-002.svg",
        "evans/gallery.js",
        "evans/points.csv",
        "images.json",
        "index.html",
        "run.json",
    ];
    assert_eq!(touched, expected);
    let fresh = Atlas::new(&changed);
    fresh.run(&[]);
    assert_eq!(tree(&atlas.out()), tree(&fresh.out()));
}

#[test]
fn pages_not_drawn_in_one_format_are_drawn_by_the_next_run() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let changed = |a: &str| MANIFEST.replace("p = 3, a = 4.0", &format!("p = 3, a = {a}"));
    let pages = |touched: Vec<String>| -> Vec<String> {
        let is_page = |name: &String| name.starts_with("evans/evans-");
        touched.into_iter().filter(is_page).collect()
    };
    atlas.edit(&changed("4.1"));
    assert_eq!(pages(atlas.touched(&["--format", "svg"]).1), ["evans/evans-002.svg"]);
    assert_eq!(pages(atlas.touched(&["--format", "svg"]).1), [""; 0]);
    assert_eq!(pages(atlas.touched(&[]).1), ["evans/evans-002.png"]);
    assert_eq!(pages(atlas.touched(&[]).1), [""; 0]);
    // If no page was drawn at all, it is unknown which of them have changed.
    atlas.edit(&changed("4.2"));
    assert_eq!(pages(atlas.touched(&["--format", "pdf"]).1), [""; 0]);
    assert!(pages(atlas.touched(&[]).1).iter().filter(|name| name.contains("-002.")).count() == 2);
    let fresh = Atlas::new(&changed("4.2"));
    fresh.run(&[]);
    let page = "evans/evans-002.png";
    assert_eq!(fs::read(atlas.out().join(page)).unwrap(), fs::read(fresh.out().join(page)).unwrap());
}

#[test]
#[ignore = "thorough"]
fn every_input_of_a_page_redraws_it() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let check_redrawn = |from: &str, to: &str, pages: &[&str]| {
        assert!(MANIFEST.contains(from), "{from}");
        let changed = MANIFEST.replacen(from, to, 1);
        atlas.edit(&changed);
        let (_, touched) = atlas.touched(&[]);
        let is_page = |name: &&String| name.ends_with(".svg");
        assert_eq!(touched.iter().filter(is_page).collect::<Vec<_>>(), pages, "{from} -> {to}");
        let fresh = Atlas::new(&changed);
        fresh.run(&[]);
        assert!(tree(&atlas.out()) == tree(&fresh.out()), "{from} -> {to}");
        atlas.edit(MANIFEST);
        atlas.touched(&[]);
    };
    let evans = ["evans/evans-001.svg", "evans/evans-002.svg", "evans/evans-003.svg"];
    let far = ["far/far-001.svg", "far/far-002.svg"];
    let over = ["over/over-001.svg"];
    let all = [&evans[..], &far, &over].concat();
    check_redrawn("\"T\"", "\"U\"", &all);
    check_redrawn("dpi = 40", "dpi = 50", &all);
    check_redrawn("dpi = 40", "dpi = 40\ndash = \"10 deg\"", &all);
    check_redrawn("dpi = 40", "dpi = 40\ntheme = \"dark\"", &all);
    check_redrawn("width = \"120 mm\"", "width = \"130 mm\"", &all);
    check_redrawn("panels = [1, 1]", "panels = [1, 1]\ntitle = \"Evans\"", &evans);
    check_redrawn("\"10 deg\" }\ncases", "\"5 deg\" }\ncases", &evans);
    check_redrawn("along = 2", "along = 3", &far);
    check_redrawn("{p:.1}", "{p:.2}", &far);
    check_redrawn("p = [2, 3, 4]", "p = [2, 3, 5]", &over);
    // The number of pages is on all of them; a `where` that keeps the same cells is on none.
    check_redrawn(", { p = 4, a = 5.6 }]", "]", &evans);
    check_redrawn("cases = [{ p = 2", "where = \"p > 1\"\ncases = [{ p = 2", &[]);
    check_redrawn("cases = [{ p = 2", "where = \"p > 2\"\ncases = [{ p = 2", &evans);
    check_redrawn("cases = [{ p = 2", "sort = \"-p\"\ncases = [{ p = 2", &[evans[0], evans[2]]);
}

#[test]
fn a_modified_or_missing_file_is_restored() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let before = tree(&atlas.out());
    let cut = |name: &str| before[name][..before[name].len() - 5].to_vec();
    let mut edited = before["evans/evans-001.svg"].clone();
    edited[100] ^= 1;
    // Damage in the middle of a file: a flipped bit, and a block that was never written.
    let (mut flipped, mut torn) = (before["evans/evans-002.png"].clone(), before["evans/evans-002.png"].clone());
    let middle = flipped.len() / 2;
    flipped[middle] ^= 1;
    torn[middle..middle + 512].fill(0);
    for (name, bytes) in [
        ("evans/evans-001.svg", Some(edited)),
        ("evans/evans-002.svg", None),
        ("evans/evans-003.png", Some(cut("evans/evans-003.png"))),
        ("evans/evans-003.png", Some(Vec::new())),
        ("evans/evans-002.png", Some(flipped)),
        ("evans/evans-002.png", Some(torn)),
        ("over/over-001.svg", Some(cut("over/over-001.svg"))),
        ("far/points.csv", Some(cut("far/points.csv"))),
        ("far/cells.csv", None),
    ] {
        let path = atlas.out().join(name);
        match bytes {
            Some(bytes) => fs::write(&path, bytes).unwrap(),
            None => fs::remove_file(&path).unwrap(),
        }
        let (_, touched) = atlas.touched(&[]);
        let family = name.split('/').next().unwrap();
        let mut expected = ["cells.csv", "gallery.js", "points.csv"].map(|file| format!("{family}/{file}")).to_vec();
        expected.push(name.to_owned());
        expected.push("run.json".to_owned());
        expected.sort();
        expected.dedup();
        assert_eq!(touched, expected);
        assert!(tree(&atlas.out()) == before, "{name}");
    }
}

#[test]
fn files_that_no_longer_belong_to_the_atlas_are_removed_and_no_others() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let foreign = ["notes.txt", "evans/notes.txt", "evans/evans-009.png", "far/far-001.svg.bak"];
    foreign.iter().for_each(|name| fs::write(atlas.out().join(name), "mine").unwrap());
    let fewer = MANIFEST.replace(", { p = 4, a = 5.6 }]", "]").replace("\"over\"", "\"above\"");
    atlas.edit(&fewer.replace("id = \"far\"", "id = \"near\""));
    // With `--only`, the other families are left alone, also those that the manifest no longer has.
    let (_, touched) = atlas.touched(&["--only", "evans"]);
    let common = ["images.json", "index.html", "run.json"];
    assert!(touched.iter().all(|name| name.starts_with("evans/") || common.contains(&name.as_str())), "{touched:?}");
    assert!(touched.contains(&"evans/evans-003.svg".to_owned()) && !atlas.out().join("evans/evans-003.svg").exists());
    atlas.touched(&[]);
    let fresh = Atlas::new(&fewer.replace("id = \"far\"", "id = \"near\""));
    fresh.run(&[]);
    let mut remaining = tree(&atlas.out());
    for name in foreign {
        assert_eq!(remaining.remove(name).as_deref(), Some(&b"mine"[..]), "{name}");
    }
    assert!(remaining == tree(&fresh.out()));
    assert!(!atlas.out().join("over").exists(), "an empty folder is removed");
    assert!(atlas.out().join("far").exists(), "a folder with foreign files is kept");
    // Formats that the command line leaves out are kept; those that the manifest no longer names are removed.
    let images = || files(&atlas.out()).into_iter().filter(|name| name.ends_with(".png")).collect::<Vec<_>>();
    let before = images();
    let (_, touched) = atlas.touched(&["--format", "svg"]);
    assert!(touched.is_empty() && images() == before && before.len() > 1, "{touched:?}");
    atlas.edit(&fewer.replace("id = \"far\"", "id = \"near\"").replace("[\"svg\", \"png\"]", "[\"svg\"]"));
    atlas.touched(&[]);
    assert_eq!(images(), ["evans/evans-009.png"]);
}

#[test]
fn a_record_that_cannot_be_read_removes_nothing() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let before = tree(&atlas.out());
    for text in ["{", "{}", "\u{0}", "{\"format\": 1, \"families\": 7}"] {
        fs::write(atlas.out().join("run.json"), text).unwrap();
        fs::write(atlas.out().join("evans/evans-004.svg"), "old").unwrap();
        let (code, _, err) = atlas.run(&[]);
        assert!(code == 2 && err.contains("cannot overwrite out/run.json: ") && err.contains("--overwrite"), "{err}");
        assert_eq!(fs::read(atlas.out().join("run.json")).unwrap(), text.as_bytes());
        let (code, out, err) = atlas.run(&["--overwrite"]);
        assert_eq!(code, 0);
        assert!(err.contains("warning: out/run.json is replaced: "), "{err}");
        assert!(!out.contains("unchanged"), "{out}");
        fs::remove_file(atlas.out().join("evans/evans-004.svg")).unwrap();
        assert!(tree(&atlas.out()) == before);
    }
}

/// A forged `run.json` cannot make the program remove or trust files that it did not write.
#[test]
fn a_forged_record_does_not_reach_other_files() {
    let atlas = Atlas::new(MANIFEST);
    atlas.run(&[]);
    let path = atlas.out().join("run.json");
    let record: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    let outside = atlas.0.path().join("evans-001.svg");
    let absolute = outside.to_string_lossy().into_owned();
    fs::write(&outside, "mine").unwrap();
    fs::create_dir_all(atlas.out().join("other/evans-007.svg")).unwrap();
    for name in ["notes.txt", "evans/evans-notes.svg", "other/notes.txt", "other/other-1.svg"] {
        fs::write(atlas.out().join(name), "mine").unwrap();
    }
    #[cfg(unix)]
    std::os::unix::fs::symlink("../aside", atlas.out().join("linked")).unwrap();
    fs::create_dir(atlas.0.path().join("aside")).unwrap();
    fs::write(atlas.0.path().join("aside/cells.csv"), "mine").unwrap();
    let foreign_files = |atlas: &Atlas| {
        let mut found = tree(atlas.0.path());
        found.retain(|_, bytes| bytes == b"mine");
        found.len()
    };
    let before = foreign_files(&atlas);
    let names = [
        "../evans-001.svg",
        "../../evans-001.svg",
        "../notes.txt",
        "evans-notes.svg",
        "notes.txt",
        "evans-007.svg",
        "..",
        ".",
        "",
        "/etc/hostname",
        "..\\notes.txt",
        "other-1.svg",
        "cells.csv",
        &absolute,
    ];
    for id in ["evans", "..", ".", "", "../..", "other", "linked", "evans/../..", "/tmp"] {
        let mut forged = record.clone();
        forged.as_object_mut().unwrap().remove("sha256");
        let mut family = forged["families"][0].clone();
        let entry = |name: &&str| serde_json::json!({ "name": name, "sha256": "00", "inputs_sha256": "00" });
        family["id"] = id.into();
        family["pages"] = u64::MAX.into();
        family["files"] = names.iter().map(entry).collect::<Vec<_>>().into();
        forged["families"].as_array_mut().unwrap().insert(0, family);
        fs::write(&path, forged.to_string()).unwrap();
        let (code, _, err) = atlas.run(&[]);
        assert_eq!(code, 0, "{err}");
        assert_eq!(foreign_files(&atlas), before, "{id}");
    }
    assert!(atlas.out().join("other/evans-007.svg").is_dir());
}

/// A manifest with 601 pages, enough to interrupt a run while it draws them.
fn many(step: &str, title: &str) -> String {
    format!(
        "[atlas]\ntitle = \"{title}\"\noutput = \"out\"\nformats = [\"svg\"]\n[[family]]\nid = \"few\"\nlinkage = \"evans\"\n\
         sampling = {{ step = \"10 deg\" }}\ncases = [{{ p = 2, a = 2.5 }}]\n[[family]]\nid = \"many\"\n\
         linkage = \"evans\"\npanels = [1, 1]\nsampling = {{ step = \"{step}\" }}\n\
         grid = {{ p = {{ from = 2, to = 4, count = 30 }}, k = {{ from = 1, to = 2, count = 20 }} }}\n\
         let = {{ a = \"(1 + p)^1.5 / 2\" }}\n"
    )
}

/// Starts a run and waits until a condition holds or the run has ended.
fn start_until(atlas: &Atlas, mut condition: impl FnMut() -> bool) -> Child {
    let mut child = atlas.command(&[]).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while !condition() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    child
}

/// The condition that this many pages have been written from now on.
fn has_drawn(atlas: &Atlas, count: usize) -> impl FnMut() -> bool {
    let start = SystemTime::now();
    let folder = atlas.out().join("many");
    let is_new = move |time: &SystemTime| *time >= start;
    move || {
        let entries = fs::read_dir(&folder).into_iter().flatten().flatten();
        let pages = entries.filter(|entry| entry.path().extension().is_some_and(|e| e == "svg"));
        pages.filter_map(|page| page.metadata().ok()?.modified().ok()).filter(is_new).count() >= count
    }
}

#[cfg(unix)]
fn terminate(child: &Child) {
    assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
}

#[cfg(unix)]
#[test]
#[ignore = "thorough"]
fn an_interrupted_run_is_continued() {
    let manifest = many("10 deg", "T");
    let fresh = Atlas::new(&manifest);
    fresh.run(&[]);
    let expected = tree(&fresh.out());
    for count in [1, 40, 300] {
        let atlas = Atlas::new(&manifest);
        let child = start_until(&atlas, has_drawn(&atlas, count));
        terminate(&child);
        let Output { status, stderr, .. } = child.wait_with_output().unwrap();
        assert_eq!(status.code(), Some(130));
        let message = "error: interrupted: finished files are kept, and the next run continues from there\n";
        assert_eq!(String::from_utf8(stderr).unwrap(), message);
        // Every finished file is recorded; the unfinished tables and the journal are kept for the next run.
        let pages: Vec<String> = files(&atlas.out()).into_iter().filter(|name| name.ends_with(".svg")).collect();
        assert!(pages.len() > count && pages.len() < 601, "{}", pages.len());
        assert_eq!(check_record(&atlas.out()), pages.len());
        let others = files(&atlas.out()).into_iter().filter(|name| !name.ends_with(".svg")).collect::<Vec<_>>();
        let tables = ["cells.csv", "gallery.js", "points.csv"];
        let mut expected_others = vec![".coupler-atlas.journal".to_owned(), "run.json".to_owned()];
        expected_others.extend(tables.map(|name| format!("few/{name}")));
        let unfinished = ["cells.csv", "gallery-curves.js", "gallery-table.js", "points.csv"];
        expected_others.extend(unfinished.map(|name| format!("many/.coupler-atlas-{name}.partial")));
        expected_others.sort();
        assert_eq!(others, expected_others);
        let (out, touched) = atlas.touched(&[]);
        assert!(touched.iter().all(|name| !pages.contains(name)), "{touched:?}");
        assert!(out.contains(&format!("({} of 600 pages drawn)", 601 - pages.len())), "{out}");
        assert!(tree(&atlas.out()) == expected);
    }
}

#[cfg(unix)]
#[test]
#[ignore = "thorough"]
fn an_interrupted_change_leaves_old_and_new_files_whole() {
    let [old, new] = ["10 deg", "12 deg"].map(|step| {
        let atlas = Atlas::new(&many(step, "T"));
        atlas.run(&[]);
        atlas
    });
    let (before, after) = (tree(&old.out()), tree(&new.out()));
    old.edit(&many("12 deg", "T"));
    let child = start_until(&old, has_drawn(&old, 100));
    terminate(&child);
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
    check_record(&old.out());
    let between = tree(&old.out());
    let is_temporary = |name: &str| name.contains(".coupler-atlas");
    assert!(between.keys().filter(|name| !is_temporary(name)).eq(after.keys()));
    for (name, bytes) in between.iter().filter(|(name, _)| *name != "run.json" && !is_temporary(name)) {
        assert!(*bytes == before[name] || *bytes == after[name], "{name}");
    }
    // The record has both the new pages and the untouched ones, so reverting the change does not draw all pages.
    let drawn = between.iter().filter(|(name, bytes)| name.ends_with(".svg") && **bytes != before[*name]).count();
    old.edit(&many("10 deg", "T"));
    let (out, _) = old.touched(&[]);
    let redrawn: usize = out.split(" of 600").next().unwrap().rsplit('(').next().unwrap().parse().unwrap();
    assert!(redrawn >= drawn && redrawn < 400, "{redrawn} after {drawn}: {out}");
    assert!(tree(&old.out()) == before);
}

#[test]
#[ignore = "thorough"]
fn a_killed_run_is_continued() {
    let manifest = many("10 deg", "T");
    let fresh = Atlas::new(&manifest);
    fresh.run(&[]);
    let expected = tree(&fresh.out());
    let atlas = Atlas::new(&manifest);
    for count in [1, 50, 200] {
        let mut child = start_until(&atlas, has_drawn(&atlas, count));
        child.kill().unwrap();
        child.wait().unwrap();
        check_record(&atlas.out());
    }
    // The files that a killed run leaves are removed by the next.
    fs::write(atlas.out().join("many/.coupler-atlas-x1y2z3.tmp"), "half a pa").unwrap();
    assert!(atlas.out().join(".coupler-atlas.lock").exists(), "the lock of a killed run");
    let journal = atlas.out().join(".coupler-atlas.journal");
    let recorded = || {
        let text = fs::read_to_string(&journal).unwrap_or_default();
        let pages = text.lines().filter(|line| line.starts_with("{\"written\"") && line.contains(".svg"));
        pages.map(|line| line.split(".svg").next().unwrap().to_owned()).collect::<std::collections::BTreeSet<_>>().len()
    };
    let mut child = start_until(&atlas, || recorded() > 300);
    child.kill().unwrap();
    child.wait().unwrap();
    check_record(&atlas.out());
    let recorded = recorded();
    assert!(recorded > 300 && recorded < 601, "only {recorded} pages were recorded during the run");
    let (out, _) = atlas.touched(&[]);
    assert!(out.contains(&format!("({} of 600 pages drawn)", 601 - recorded)), "{out}");
    assert!(tree(&atlas.out()) == expected);
}

#[test]
#[ignore = "thorough"]
fn a_run_killed_during_a_change_does_not_record_the_old_files() {
    let atlas = Atlas::new(&many("10 deg", "T"));
    atlas.run(&[]);
    let before = tree(&atlas.out());
    atlas.edit(&many("10 deg", "U"));
    let mut child = start_until(&atlas, has_drawn(&atlas, 100));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(check_record(&atlas.out()) < 500);
    atlas.edit(&many("10 deg", "T"));
    atlas.touched(&[]);
    assert!(tree(&atlas.out()) == before);
}

#[test]
#[ignore = "thorough"]
fn two_runs_do_not_write_to_one_folder() {
    let atlas = Atlas::new(&many("10 deg", "T"));
    fs::create_dir(atlas.out()).unwrap();
    fs::write(atlas.out().join(".coupler-atlas.lock"), "").unwrap();
    let mut child = start_until(&atlas, has_drawn(&atlas, 1));
    let (code, out, err) = atlas.run(&[]);
    assert_eq!((code, out.as_str()), (3, ""));
    assert_eq!(err, "error: another run is writing to out: wait until it ends, or name another folder with -o\n");
    assert_eq!(atlas.run(&["-o", "elsewhere"]).0, 0);
    assert!(child.wait().unwrap().success());
    assert!(!atlas.out().join(".coupler-atlas.lock").exists());
    assert!(tree(&atlas.out()) == tree(&atlas.0.path().join("elsewhere")));
    // Several runs at once each find the lock free or held.
    let mut children: Vec<Child> =
        (0..8).map(|_| atlas.command(&["--quiet"]).stderr(Stdio::null()).spawn().unwrap()).collect();
    let codes: Vec<_> = children.iter_mut().map(|child| child.wait().unwrap().code()).collect();
    assert!(codes.iter().all(|code| [Some(0), Some(3)].contains(code)) && codes.contains(&Some(0)), "{codes:?}");
    assert!(!atlas.out().join(".coupler-atlas.lock").exists());
}
