use std::fs;
use std::os::unix::fs::symlink;

use super::old_and_new;
use crate::support::command::{folder_with, run};
use crate::support::folder::Atlas;

/// Files of which the system says that they exist, and whose bytes it fails to read: a process has nothing at address 0.
const UNREADABLE: &str = "/proc/self/mem";

/// Another attempt may succeed, unlike one with a file that is wrong, so that the exit code is another one.
#[test]
fn an_input_that_the_system_fails_to_read_is_not_wrong() {
    let [manifest, _] = old_and_new();
    let folder = folder_with(&manifest);
    for name in ["broken.toml", "broken.csv", "broken.ttf"] {
        symlink(UNREADABLE, folder.path().join(name)).unwrap();
    }
    let with_font = manifest.replacen("[page]", "[page]\ntheme = { fallback_face = \"broken.ttf\" }", 1);
    fs::write(folder.path().join("font.toml"), with_font).unwrap();
    let with_table = manifest.replacen(
        "[[family]]",
        "[[family]]\nid = \"table\"\nlinkage = \"evans\"\ncases = \"broken.csv\"\n[[family]]",
        1,
    );
    fs::write(folder.path().join("table.toml"), with_table).unwrap();
    for (arguments, name) in [
        (&["validate", "broken.toml"][..], "broken.toml"),
        (&["render", "broken.toml"], "broken.toml"),
        (&["render", "broken.toml", "--shard", "0/2"], "broken.toml"),
        (&["sweep", "broken.toml"], "broken.toml"),
        (&["check", "broken.toml", "--against", "out"], "broken.toml"),
        (&["export", "broken.toml", "evans:1.1.1"], "broken.toml"),
        (&["list", "linkages", "evans", "--manifest", "broken.toml"], "broken.toml"),
        (&["inspect", "evans", "--manifest", "broken.toml"], "broken.toml"),
        (&["find", "broken.csv"], "broken.csv"),
        (&["find", "broken.csv", "--atlas", "broken.toml"], "broken."),
        (&["validate", "font.toml"], "broken.ttf"),
        (&["render", "font.toml"], "broken.ttf"),
        (&["sweep", "font.toml"], "broken.ttf"),
        (&["sweep", "table.toml"], "broken.csv"),
    ] {
        let (code, out, err) = run(folder.path(), arguments);
        assert_eq!((code, out.as_str()), (3, ""), "{arguments:?}: {err}");
        assert!(err.starts_with("error: cannot read ") && err.contains(name), "{arguments:?}: {err}");
        assert!(err.ends_with("Input/output error (os error 5)\n"), "{arguments:?}: {err}");
    }
    // What is not there, or has been read and is none, is wrong.
    fs::write(folder.path().join("bytes.toml"), [0xff; 9]).unwrap();
    for name in ["nowhere.toml", "bytes.toml", "nowhere/atlas.toml", "atlas.toml/atlas.toml"] {
        assert_eq!(run(folder.path(), &["sweep", name]).0, 2, "{name}");
    }
    fs::write(
        folder.path().join("font.toml"),
        manifest.replacen("[page]", "[page]\ntheme = { fallback_face = \"no.ttf\" }", 1),
    )
    .unwrap();
    assert_eq!(run(folder.path(), &["sweep", "font.toml"]).0, 2);
}

/// Nothing is known about it: that is no difference. Here a folder leads to itself.
#[test]
#[ignore = "thorough"]
fn a_recorded_file_that_the_system_fails_to_read_is_not_damaged() {
    let [manifest, _] = old_and_new();
    let atlas = Atlas::rendered(&manifest, &[]);
    let folder = atlas.out().join("over");
    fs::rename(&folder, atlas.0.path().join("over")).unwrap();
    symlink("over", &folder).unwrap();
    let (code, out, err) = atlas.check(&[]);
    assert_eq!((code, out.as_str()), (3, ""), "{err}");
    let file = "out/over/points.csv";
    assert!(err.starts_with(&format!("error: cannot use {file}: it cannot be read: ")), "{err}");
    assert!(err.ends_with("(os error 40); run it again\n"), "{err}");
    // Other families can be checked, and a file in the place of the folder is read, and wrong.
    assert_eq!(atlas.check(&["--only", "evans"]).0, 0);
    fs::remove_file(&folder).unwrap();
    fs::write(&folder, "").unwrap();
    let (code, out, err) = atlas.check(&[]);
    assert!(code == 1 && out.contains("damaged  over/points.csv    does not exist\n"), "{err}{out}");
    fs::remove_file(&folder).unwrap();
    fs::rename(atlas.0.path().join("over"), &folder).unwrap();
    assert_eq!(atlas.check(&[]).0, 0);
}
