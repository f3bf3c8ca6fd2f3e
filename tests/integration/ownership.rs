//! A folder belongs to the manifest that made it, and files that no run wrote are left alone.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::support::folder::{Atlas, check_record, edit_record, files, tree};

/// A manifest of one family, without an output folder.
fn manifest(title: &str, families: &[&str]) -> String {
    let family = |id: &&str| {
        format!(
            "[[family]]\nid = \"{id}\"\nlinkage = \"evans\"\nsampling = {{ samples = 12 }}\ncases = [{{ p = 2, a = 2.5 }}]\n"
        )
    };
    let families: String = families.iter().map(family).collect();
    format!(
        "[atlas]\ntitle = \"{title}\"\nformats = [\"svg\", \"png\", \"pdf\"]\n[page]\n\
         paper = {{ width = \"100 mm\", height = \"100 mm\" }}\ndpi = 20\n{families}"
    )
}

fn write(atlas: &Atlas, name: &str, text: &str) {
    let path = atlas.0.path().join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

/// The exit code and standard error of a run.
fn render(atlas: &Atlas, arguments: &[&str]) -> (i32, String) {
    let (code, _, err) = atlas.run(arguments);
    (code, err)
}

#[test]
fn two_manifests_in_a_folder_have_atlases_of_their_own() {
    let atlas = Atlas::new(&manifest("A", &["evans"]));
    write(&atlas, "b.toml", &manifest("B", &["other"]));
    assert_eq!(render(&atlas, &["-q"]), (0, String::new()));
    assert_eq!(render(&atlas, &["-q", "b.toml"]), (0, String::new()));
    assert!(atlas.0.path().join("atlas/evans/points.csv").exists());
    assert!(atlas.0.path().join("b/other/points.csv").exists());
    fs::copy(atlas.0.path().join("b.toml"), atlas.0.path().join("plain")).unwrap();
    let (code, err) = render(&atlas, &["plain"]);
    assert!(code == 2 && err.contains("plain has no extension") && err.contains("with -o"), "{err}");
}

#[test]
fn the_atlas_of_another_manifest_is_not_replaced() {
    let atlas = Atlas::new(&manifest("A", &["evans", "more"]));
    write(&atlas, "b.toml", &manifest("B", &["other"]));
    write(&atlas, "elsewhere/atlas.toml", &manifest("B", &["evans"]));
    assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 0);
    let before = tree(&atlas.out());
    let record = String::from_utf8(before["run.json"].clone()).unwrap();
    assert!(record.contains("\"manifest\": \"atlas.toml\",\n  \"title\": \"A\""), "{record}");
    for arguments in
        [&["b.toml"][..], &["elsewhere/atlas.toml"], &["b.toml", "--force"], &["b.toml", "--only", "other"]]
    {
        let (code, err) = render(&atlas, &[arguments, &["-o", "out"]].concat());
        assert_eq!(code, 2, "{err}");
        let message = "error: out has the atlas of another manifest, atlas.toml, with the title \"A\": write to another \
                       folder with -o, or replace that atlas with --overwrite\n";
        assert_eq!(err, message);
        assert!(tree(&atlas.out()) == before);
    }
    // Another title, with all families, and a change of families, under the same title, are changes of one manifest.
    atlas.edit(&manifest("Another title", &["evans", "more"]));
    assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 0);
    atlas.edit(&manifest("Another title", &["more"]));
    assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 0);
    // An older record does not name its manifest.
    edit_record(&atlas.out(), |run| drop(run.as_object_mut().unwrap().remove("manifest")));
    assert_eq!(render(&atlas, &["-q", "b.toml", "-o", "out"]).0, 0);
    assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 2);
    assert_eq!(render(&atlas, &["-q", "-o", "out", "--overwrite"]).0, 0);
    assert!(!atlas.out().join("other").exists(), "the other atlas is replaced");
    check_record(&atlas.out());
}

#[test]
fn a_manifest_from_standard_input_needs_a_folder() {
    let atlas = Atlas::new(&manifest("A", &["evans"]));
    let run = |arguments: &[&str]| {
        let mut command = atlas.command(&[&["-"], arguments].concat());
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(manifest("A", &["evans"]).as_bytes()).unwrap();
        let Output { status, stderr, .. } = child.wait_with_output().unwrap();
        (status.code(), String::from_utf8(stderr).unwrap())
    };
    let (code, err) = run(&[]);
    assert!(code == Some(2) && err.contains("from standard input has no folder") && err.contains("-o"), "{err}");
    assert_eq!(run(&["-q", "-o", "out"]), (Some(0), String::new()));
    assert!(fs::read_to_string(atlas.out().join("run.json")).unwrap().contains("\"manifest\": \"-\""));
    assert_eq!(run(&["-q", "-o", "out"]).0, Some(0));
    assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 2);
}

#[test]
fn files_that_no_run_wrote_are_not_overwritten() {
    let text = manifest("A", &["evans"]);
    let names =
        ["index.html", "kernel.js", "atlas.pdf", "images.json", "run.json", "evans/points.csv", "evans/evans-001.svg"];
    for name in names {
        let atlas = Atlas::new(&text);
        write(&atlas, &format!("out/{name}"), "mine");
        write(&atlas, "out/evans/notes.txt", "mine");
        let before = tree(&atlas.out());
        for arguments in [&["-o", "out"][..], &["-o", "out", "--force"]] {
            let (code, err) = render(&atlas, arguments);
            assert_eq!(code, 2, "{name}: {err}");
            assert!(err.contains(&format!("out/{name}")) && err.contains("--overwrite"), "{err}");
            assert!(tree(&atlas.out()) == before, "{name}");
        }
        assert_eq!(render(&atlas, &["-q", "-o", "out", "--overwrite"]).0, 0, "{name}");
        assert!(fs::read(atlas.out().join(name)).unwrap() != b"mine");
        assert_eq!(fs::read(atlas.out().join("evans/notes.txt")).unwrap(), b"mine");
        // From here on the file is the run's own.
        assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 0);
    }
    // All of them are counted; files of formats that are not written are not in the way.
    let atlas = Atlas::new(&text.replace("\"svg\", \"png\", \"pdf\"", "\"svg\""));
    for name in ["evans/points.csv", "evans/evans-001.png", "evans/cells.csv", "atlas.pdf", "images.json"] {
        write(&atlas, &format!("out/{name}"), "mine");
    }
    let (code, err) = render(&atlas, &["-o", "out"]);
    assert!(code == 2 && err.contains("no earlier run wrote out/evans/cells.csv and 1 more: move them away"), "{err}");
}

#[cfg(unix)]
#[test]
fn nothing_is_written_through_a_link() {
    use std::os::unix::fs::symlink;
    let text = manifest("A", &["evans"]);
    for (name, is_folder) in [("evans", true), ("index.html", false), ("kernel.js", false), ("evans/points.csv", false)]
    {
        let atlas = Atlas::new(&text);
        // The file was written by a run, and then replaced by a link.
        assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 0);
        let (path, target) = (atlas.out().join(name), atlas.0.path().join("target"));
        fs::rename(&path, &target).unwrap();
        symlink(&target, &path).unwrap();
        let before = if is_folder { tree(&target) } else { [(String::new(), fs::read(&target).unwrap())].into() };
        atlas.edit(&text.replace("12", "14"));
        let (code, err) = render(&atlas, &["-o", "out"]);
        assert!(code == 2 && err.contains(&format!("out/{name}:")) && err.contains("--overwrite"), "{err}");
        assert_eq!(render(&atlas, &["-q", "-o", "out", "--overwrite"]), (0, String::new()));
        let after = if is_folder { tree(&target) } else { [(String::new(), fs::read(&target).unwrap())].into() };
        assert!(before == after, "{name}: the target is unchanged");
        assert!(!fs::symlink_metadata(&path).unwrap().is_symlink());
        check_record(&atlas.out());
    }
}

/// Pipes, devices and files of any size in place of those that a run reads: it neither hangs nor fills memory.
#[cfg(unix)]
#[test]
#[ignore = "thorough"]
fn only_regular_files_of_bounded_size_are_read() {
    let text = manifest("A", &["evans"]);
    let make = |kind: &str, path: &Path| {
        let _ = fs::remove_file(path);
        match kind {
            "pipe" => assert!(Command::new("mkfifo").arg(path).status().unwrap().success()),
            "device" => std::os::unix::fs::symlink("/dev/zero", path).unwrap(),
            _ => fs::File::create(path).unwrap().set_len(3 << 30).unwrap(),
        }
    };
    for name in ["run.json", ".coupler-atlas.lock", ".coupler-atlas.journal", "images.json"] {
        for kind in ["pipe", "device", "3 GB"] {
            let atlas = Atlas::new(&text);
            assert_eq!(render(&atlas, &["-q", "-o", "out"]).0, 0);
            make(kind, &atlas.out().join(name));
            // A limit on memory instead of a clock: whatever is read whole does not fit.
            let limited = |arguments: &str| {
                let script = format!("ulimit -v 2500000; exec timeout 60 \"$0\" {arguments}");
                let output = crate::support::command::shell(atlas.0.path(), &script).output().unwrap();
                (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&output.stderr).into_owned())
            };
            let (check, err) = limited("check --jobs 2 --against out -q");
            assert!((0..=3).contains(&check), "{name}, {kind}: {check} {err}");
            assert!(name != "images.json" || check == 1, "{name}, {kind}: {check} {err}");
            let (code, err) = limited("render --jobs 2 -o out -q");
            assert!((0..=3).contains(&code), "{name}, {kind}: {code} {err}");
            assert!(code == 0 || err.contains(name), "{name}, {kind}: {err}");
        }
    }
    let atlas = Atlas::new(&text);
    for kind in ["pipe", "device", "3 GB"] {
        make(kind, &atlas.0.path().join("atlas.toml"));
        let (code, err) = render(&atlas, &["-o", "out"]);
        assert!(code == 2 && err.contains("atlas.toml"), "{kind}: {err}");
    }
    assert!(files(&atlas.out()).is_empty());
}

#[test]
#[ignore = "thorough"]
fn many_pages_are_in_subfolders() {
    let pages = |count: usize| {
        format!(
            "[atlas]\ntitle = \"T\"\noutput = \"out\"\nformats = [\"svg\"]\n[page]\n\
             paper = {{ width = \"100 mm\", height = \"100 mm\" }}\n[[family]]\nid = \"evans\"\nlinkage = \"evans\"\n\
             panels = [1, 1]\nmeasures = []\nsampling = {{ samples = 6 }}\n\
             grid = {{ k = {{ from = 1, to = 2, count = {count} }} }}\nlet = {{ p = 2, a = \"2.6\" }}\n"
        )
    };
    let atlas = Atlas::new(&pages(1002));
    assert_eq!(render(&atlas, &["-q"]), (0, String::new()));
    let found = files(&atlas.out());
    assert!(found.contains(&"evans/0001-1000/evans-007.svg".to_owned()));
    assert!(found.contains(&"evans/1001-1002/evans-1002.svg".to_owned()));
    assert_eq!(found.iter().filter(|name| name.ends_with(".svg")).count(), 1002);
    let check = || atlas.check(&["-q"]);
    let (code, out, err) = check();
    assert_eq!((code, out.as_str()), (0, ""), "{err}");
    let page = atlas.out().join("evans/1001-1002/evans-1001.svg");
    let drawn = fs::read(&page).unwrap();
    fs::write(&page, "edited").unwrap();
    assert!(check().1.contains("evans/1001-1002/evans-1001.svg"));
    assert_eq!(render(&atlas, &["-q"]), (0, String::new()));
    assert!(fs::read(&page).unwrap() == drawn);
    // With fewer pages, all are in the folder of the family, and the subfolders are gone.
    atlas.edit(&pages(3));
    assert_eq!(render(&atlas, &["-q"]), (0, String::new()));
    let found = files(&atlas.out());
    assert_eq!(found.iter().filter(|name| name.ends_with(".svg")).count(), 3);
    assert!(atlas.out().join("evans/evans-003.svg").exists() && !atlas.out().join("evans/0001-1000").exists());
    check_record(&atlas.out());
}
