//! Shards of pages.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use coupler_drawing::scene::{FontFamily, Typeface};

use super::{gather_problems, shard};
use crate::support::command::{folder_with, printed, program, run};
use crate::support::folder::tree;

/// Pages of panels, sorted and filtered, of a coupler grid, with charts, and of many cells without curves.
const PAGES: &str = r#"[atlas]
title = "T"
formats = ["svg", "png"]
[page]
dpi = 40
[[family]]
id = "panels"
linkage = "evans"
panels = [2, 1]
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4, 5, 6], a = [3, 4] }
[[family]]
id = "sorted"
linkage = "evans"
panels = [1, 1]
sampling = { step = "10 deg" }
where = "length > 3"
sort = "-straight_length"
grid = { p = [2, 3, 4], a = [3, 4] }
[[family]]
id = "far"
linkage = "watt"
panels = [1, 1]
sampling = { samples = 20 }
cases = [{ p = 4, r = 2, a = 1 }, { p = 90, r = 2, a = 1 }, { p = 4, r = 2, a = 1.5 }]
[[family]]
id = "grid"
linkage = "hrones-nelson"
layout = "coupler-grid"
sampling = { step = "20 deg" }
cases = [{ A = 2, B = 2.5, C = 3 }, { A = 3, B = 2, C = 3 }]
[[family]]
id = "chart"
linkage = "evans"
layout = "chart"
panels = [1, 1]
chart = { x = "p", y = ["straight_length", "mu_min_deg"] }
sampling = { step = "20 deg" }
grid = { p = [2, 3, 4], a = [3, 4] }
"#;

#[test]
#[ignore = "thorough"]
fn the_pages_of_shards_are_those_of_one_run() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    for format in ["svg,png", "svg,pdf"] {
        let whole = format!("whole-{format}");
        printed(path, &["render", "-q", "-o", &whole, "--format", format]);
        let whole = tree(&path.join(&whole));
        for of in [1, 2, 3, 40] {
            let output = format!("{format}-{of}");
            let draw = |index: usize| {
                let shard = format!("{index}/{of}");
                let mut command = program(path);
                command.args(["render", "--shard", &shard, "-o", &output, "--format", format, "-j", "1"]);
                command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
            };
            // All at once, in no order, but for one.
            let running: Vec<_> = (1..of).rev().map(draw).collect();
            let drawn = |child: std::process::Child| -> usize {
                let (code, out, err) = crate::support::command::result(child.wait_with_output().unwrap());
                assert_eq!(code, 0, "{err}");
                out.split(", ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap()
            };
            let of_others: usize = running.into_iter().map(drawn).sum();
            if of > 1 {
                let message = gather_problems(path, &[&output]);
                let expected = format!("{output}: of {of} shards of pages these are not complete: 0; draw them with");
                assert!(message.contains(&expected), "{message}");
            }
            let of_first = drawn(draw(0));
            assert_eq!(of_others + of_first, whole.keys().filter(|name| name.ends_with(".svg")).count());
            assert_eq!(drawn(draw(0)), 0, "a shard that is drawn again keeps its pages");
            let (code, out, err) = run(path, &["gather", &output]);
            assert!(code == 0 && out.is_empty() && err.contains(&format!("written to {output}; open ")), "{err}");
            let found = tree(&path.join(&output));
            assert!(found.keys().eq(whole.keys()), "{format} in {of}");
            for ((name, bytes), (_, expected)) in found.iter().zip(&whole) {
                assert!(bytes == expected, "{format} in {of} shards: {} differs", name);
            }
            assert!(printed(path, &["render", "-o", &output, "--format", format]).contains("nothing has changed"));
        }
    }
}

#[test]
#[ignore = "thorough"]
fn shards_of_pages_of_different_manifests_are_not_completed() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    printed(path, &["render", "-q", "--shard", "0/2", "-o", "out"]);
    fs::write(path.join("atlas.toml"), PAGES.replace("dpi = 40", "dpi = 50")).unwrap();
    printed(path, &["render", "-q", "--shard", "1/2", "-o", "out"]);
    assert!(gather_problems(path, &["out"]).contains("--shard 0/2 and --shard 1/2 are of different manifests"));
    // A run of all draws what is missing.
    printed(path, &["render", "-q", "-o", "out"]);
    printed(path, &["render", "-q", "-o", "whole"]);
    assert!(tree(&path.join("out")) == tree(&path.join("whole")));
    // Files of others are not replaced, and the folder of another manifest is not used.
    fs::create_dir_all(path.join("mine/far")).unwrap();
    fs::write(path.join("mine/far/far-001.svg"), "mine").unwrap();
    let (code, _, err) = run(path, &["render", "--shard", "1/3", "-o", "mine"]);
    assert!(code == 2 && err.contains("no earlier run wrote mine/far/far-001.svg"), "{err}");
    fs::copy(path.join("atlas.toml"), path.join("other.toml")).unwrap();
    let (code, _, err) = run(path, &["render", "other.toml", "--shard", "1/3", "-o", "whole"]);
    assert!(code == 2 && err.contains("has the atlas of another manifest"), "{err}");
}

/// Draws all shards of the pages of a manifest in a folder into another.
fn draw_all(folder: &Path, manifest: &str, output: &str, of: usize) {
    for index in 0..of {
        printed(folder, &["render", manifest, "-q", "-o", output, "--shard", &format!("{index}/{of}")]);
    }
}

#[test]
#[ignore = "thorough"]
fn pages_of_another_manifest_are_drawn_again() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    let other = PAGES.replace("10 deg", "15 deg").replace("samples = 20", "samples = 24");
    for (name, text) in [("a", PAGES), ("b", &other)] {
        fs::create_dir(path.join(name)).unwrap();
        fs::write(path.join(name).join("p.toml"), text).unwrap();
        printed(path, &["render", &format!("{name}/p.toml"), "-q", "-o", &format!("whole-{name}")]);
    }
    let whole = ["a", "b"].map(|name| tree(&path.join(format!("whole-{name}"))));
    printed(path, &["render", "a/p.toml", "-q", "-o", "out"]);
    printed(path, &["render", "b/p.toml", "-q", "-o", "out", "--shard", "0/2"]);
    printed(path, &["render", "a/p.toml", "-q", "-o", "out"]);
    assert!(tree(&path.join("out")) == whole[0]);
    draw_all(path, "b/p.toml", "out", 2);
    printed(path, &["gather", "out"]);
    assert!(tree(&path.join("out")) == whole[1]);
}

#[test]
#[ignore = "thorough"]
fn completing_pages_can_be_repeated() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    draw_all(path, "atlas.toml", "out", 3);
    // Of another number, which is not complete and not needed.
    printed(path, &["render", "-q", "-o", "out", "--shard", "1/2"]);
    let (code, _, err) = run(path, &["gather", "out"]);
    assert!(
        code == 0 && err.contains("all 3 shards of pages are complete; those of other numbers are not needed"),
        "{err}"
    );
    let whole = tree(&path.join("out"));
    let (code, out, err) = run(path, &["gather", "out"]);
    assert_eq!((code, out.as_str(), err.as_str()), (0, "", "out has a complete atlas, and no shards to gather\n"));
    // An engine starts a shard again.
    let again = printed(path, &["render", "-o", "out", "--shard", "1/3"]);
    assert!(again.contains(", 0 of them drawn, in out, where the atlas is complete already"), "{again}");
    assert!(tree(&path.join("out")) == whole);
    // A page that is not intact is drawn again by its shard, and the others are not needed.
    fs::remove_file(path.join("out/far/far-001.svg")).unwrap();
    draw_all(path, "atlas.toml", "out", 3);
    assert!(path.join("out/far/far-001.svg").exists());
    printed(path, &["gather", "out"]);
    assert!(tree(&path.join("out")) == whole);
    // Without a complete set of shards.
    printed(path, &["render", "-q", "-o", "parts", "--shard", "1/3"]);
    printed(path, &["render", "-q", "-o", "parts", "--shard", "0/2"]);
    let message = gather_problems(path, &["parts"]);
    for expected in ["of 2 these are not complete: 1, and of 3", "0, 2", "`coupler-atlas render MANIFEST -o parts`"] {
        assert!(message.contains(expected), "{message}");
    }
    printed(path, &["render", "-q", "-o", "parts", "--shard", "1/2"]);
    printed(path, &["gather", "parts"]);
    assert!(tree(&path.join("parts")) == whole);
    // Formats have no order.
    printed(path, &["render", "-q", "-o", "formats", "--shard", "0/2", "--format", "svg,png"]);
    printed(path, &["render", "-q", "-o", "formats", "--shard", "1/2", "--format", "png,svg"]);
    printed(path, &["gather", "formats"]);
    assert!(tree(&path.join("formats")) == whole);
}

#[test]
fn tables_beside_pages_are_gathered_too() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    draw_all(path, "atlas.toml", "out", 2);
    let message = gather_problems(path, &["out", "--top", "2", "--by", "length"]);
    assert!(
        message.contains("--top is for tables, and there are none in out: `coupler-atlas sweep` writes them"),
        "{message}"
    );
    printed(path, &["sweep", "-q", "-o", "out"]);
    let (code, out, err) = run(path, &["gather", "out", "--top", "2", "--by", "length", "--only", "panels"]);
    assert!(code == 0 && out.lines().count() == 3 && err.contains("written to out; open "), "{out}{err}");
    assert!(path.join("out/run.json").exists());
    // A book alone has no pages to divide.
    let (code, out, err) = run(path, &["render", "--format", "pdf", "--shard", "0/2", "-o", "book"]);
    assert!(
        code == 0 && out.starts_with("0 pages") && err.contains("there are no pages to divide: a book"),
        "{out}{err}"
    );
}

#[test]
#[ignore = "thorough"]
fn a_font_file_is_beside_the_manifest() {
    let text =
        PAGES.replace("dpi = 40", "dpi = 40\ntheme = { fallback_face = \"fonts/my.ttf\" }").replace("\"T\"", "\"ש\"");
    let folder = folder_with("");
    let path = folder.path();
    for name in ["project/fonts", "elsewhere"] {
        fs::create_dir_all(path.join(name)).unwrap();
    }
    fs::write(path.join("project/atlas.toml"), text).unwrap();
    let font = Typeface::from(FontFamily::Sans).regular().bytes();
    fs::write(path.join("project/fonts/my.ttf"), font).unwrap();
    printed(path, &["render", "project/atlas.toml", "-q", "-o", "whole"]);
    draw_all(path, "project/atlas.toml", "project/out", 2);
    draw_all(path, "project/atlas.toml", "away", 2);
    // Without the file, the message says where it was looked for.
    fs::rename(path.join("project/fonts"), path.join("fonts")).unwrap();
    let message = gather_problems(path, &["away"]);
    assert!(
        message.contains("project/atlas.toml") && message.contains("`coupler-atlas render MANIFEST -o away`"),
        "{message}"
    );
    fs::rename(path.join("fonts"), path.join("project/fonts")).unwrap();
    printed(&path.join("elsewhere"), &["gather", "-q", "../away"]);
    assert!(tree(&path.join("away")) == tree(&path.join("whole")));
    // The project is moved with its output.
    fs::rename(path.join("project"), path.join("moved")).unwrap();
    printed(&path.join("elsewhere"), &["gather", "-q", "../moved/out"]);
    assert!(tree(&path.join("moved/out")) == tree(&path.join("whole")));
}

#[cfg(unix)]
#[test]
fn pages_are_not_drawn_through_links() {
    let folder = folder_with(PAGES);
    let path = folder.path();
    for name in ["mine", "out"] {
        fs::create_dir(path.join(name)).unwrap();
    }
    std::os::unix::fs::symlink(path.join("mine"), path.join("out/panels")).unwrap();
    let (code, _, err) = run(path, &["render", "-q", "-o", "out", "--shard", "0/2"]);
    assert!(code == 2 && err.contains("no earlier run wrote out/panels"), "{err}");
    assert!(fs::read_dir(path.join("mine")).unwrap().next().is_none());
    // Tables are swept and gathered through links.
    printed(path, &["sweep", "-q", "-o", "out", "--only", "panels", "--no-points", "--measures", "none"]);
    assert!(path.join("mine").join(shard("cells", 0, 1, "parquet")).exists());
    printed(path, &["gather", "out", "--only", "panels"]);
}
