use std::fs;
use std::process::Stdio;
use std::time::Duration;

use super::{check_files, complete, old_and_new, undisturbed};
use crate::support::folder::{Atlas, tree};

/// A folder at the path of a file, or a file at the path of a folder, is reported with a remedy and left alone.
#[test]
#[ignore = "thorough"]
fn an_obstacle_at_the_path_of_a_file_is_reported_and_kept() {
    let [old, new] = old_and_new();
    let [before, after] = [&old, &new].map(|manifest| undisturbed(manifest));
    let remedy = "something else has this path: move it away, or name another path\n";
    for name in ["evans/evans-003.svg", "evans/evans-003.png", "over/cells.csv", "run.json", "atlas.pdf"] {
        let atlas = Atlas::new(&old);
        complete(&atlas);
        atlas.edit(&new);
        let path = atlas.out().join(name);
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        fs::write(path.join("mine"), "mine").unwrap();
        let (code, out, err) = atlas.run(&[]);
        assert_eq!((code, out.as_str()), (3, ""), "{name}");
        let message = format!("error: cannot write out/{name}: ");
        assert!(err.contains(&message) && err.ends_with(remedy), "{err}");
        assert_eq!(fs::read_to_string(path.join("mine")).unwrap(), "mine");
        fs::remove_dir_all(&path).unwrap();
        let others =
            before.iter().filter(|(other, _)| *other != name).map(|(name, bytes)| (name.clone(), bytes.clone()));
        check_files(&atlas.out(), &others.collect(), &after);
        // Without its record, the files may be those of others.
        let arguments: &[&str] = if name == "run.json" { &["--overwrite"] } else { &[] };
        assert_eq!(atlas.run(arguments).0, 0);
        assert!(tree(&atlas.out()) == after, "{name}");
    }
    let atlas = Atlas::new(&old);
    fs::create_dir(atlas.out()).unwrap();
    for name in ["out/evans", "blocked"] {
        let path = atlas.0.path().join(name);
        fs::write(&path, "mine").unwrap();
        let (code, _, err) = atlas.run(if name == "blocked" { &["-o", "blocked/deeper"] } else { &[] });
        assert!(code == 3 && err.contains(&format!("cannot write {name}")) && err.ends_with(remedy), "{err}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
        fs::remove_file(&path).unwrap();
    }
    complete(&atlas);
    assert!(tree(&atlas.out()) == before);
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_is_left_unchanged() {
    use std::os::unix::fs::PermissionsExt;
    let [old, new] = old_and_new();
    let atlas = Atlas::new(&old);
    complete(&atlas);
    let before = tree(&atlas.out());
    let folder = atlas.out().join("evans");
    let allow = |mode| fs::set_permissions(&folder, fs::Permissions::from_mode(mode)).unwrap();
    allow(0o555);
    if fs::write(folder.join("probe"), "").is_ok() {
        eprintln!("skipped: this user can write in spite of the permissions");
        fs::remove_file(folder.join("probe")).unwrap();
    } else {
        atlas.edit(&new);
        let (code, _, err) = atlas.run(&[]);
        assert!(code == 3 && err.contains("cannot write out/evans/"), "{err}");
        assert!(err.ends_with("; change its permissions, or name another path\n"), "{err}");
        check_files(&atlas.out(), &before, &undisturbed(&new));
    }
    allow(0o755);
    atlas.edit(&new);
    complete(&atlas);
    assert!(tree(&atlas.out()) == undisturbed(&new));
}

/// Files and whole folders are removed while a run writes them.
#[test]
#[ignore = "thorough"]
fn files_that_vanish_during_a_run_are_written_by_the_next() {
    let [old, new] = old_and_new();
    let [before, after] = [&old, &new].map(|manifest| undisturbed(manifest));
    let atlas = Atlas::new(&old);
    complete(&atlas);
    let moments = ["evans/points.csv", "evans", "over/cells.csv", "evans", "run.json", "atlas.pdf", "over"];
    for (k, name) in moments.into_iter().enumerate() {
        let (manifest, expected) = if k % 2 == 0 { (&new, &after) } else { (&old, &before) };
        atlas.edit(manifest);
        let mut child = atlas.command(&["-q"]).stderr(Stdio::piped()).spawn().unwrap();
        // The file is removed again and again until the run ends, at different intervals for each file.
        while child.try_wait().unwrap().is_none() {
            let path = atlas.out().join(name);
            let _ = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
            std::thread::sleep(Duration::from_millis(1 + 7 * k as u64));
        }
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        let is_reported = err.starts_with("error: cannot write out")
            && err.ends_with("its folder does not exist: create it, or name another\n");
        // A run that begins without the record takes the files for those of others.
        let is_refused = output.status.code() == Some(2) && err.contains("no earlier run wrote out/");
        let is_expected = output.status.success() || output.status.code() == Some(3) && is_reported || is_refused;
        assert!(is_expected, "{name}: {err}");
        // Without its record, the files may be those of others.
        let arguments: &[&str] = if atlas.out().join("run.json").exists() { &[] } else { &["--overwrite"] };
        let (code, _, err) = atlas.run(arguments);
        assert_eq!(code, 0, "{name}: {err}");
        assert!(tree(&atlas.out()) == *expected, "{name}");
    }
}
