use std::fs::{self, File};
use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::PathBuf;
use std::process::Command;

use super::{Tree, check_files, complete, old_and_new, undisturbed};
use crate::support::command::{run, shell};
use crate::support::folder::{Atlas, tree};

/// A small disk in memory, mounted at the folder of an atlas.
struct Disk(PathBuf);

impl Disk {
    const BLOCK: usize = 4096;

    /// Mounts a disk of 4 MiB; `None` if the test does not have the rights to do so, which `.ci/run` sees to.
    fn mount(folder: PathBuf) -> Option<Disk> {
        fs::create_dir(&folder).unwrap();
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", "size=4m", "coupler-atlas-test"]).arg(&folder);
        if mount.output().is_ok_and(|output| output.status.success()) {
            return Some(Disk(folder));
        }
        let is_required = std::env::var_os("MOUNT").is_some();
        assert!(!is_required, "this user does not have the rights to mount a disk");
        eprintln!("skipped: this user does not have the rights to mount a disk");
        None
    }

    /// Fills the disk except for this number of blocks.
    fn fill(&self, free: usize) -> Ballast {
        let path = self.0.join("ballast");
        let mut file = File::create(&path).unwrap();
        let mut blocks = 0;
        while file.write_all(&[0; Disk::BLOCK]).is_ok() {
            blocks += 1;
        }
        file.set_len((Disk::BLOCK * (blocks - free)) as u64).unwrap();
        Ballast(path)
    }

    fn allow_writing(&self, is_allowed: bool) {
        let options = if is_allowed { "remount,rw" } else { "remount,ro" };
        assert!(Command::new("mount").args(["-o", options]).arg(&self.0).status().unwrap().success());
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        // A lazy unmount succeeds even if a process still uses the disk.
        let _ = Command::new("umount").arg("--lazy").arg(&self.0).status();
    }
}

/// A file that fills a disk until it is dropped.
struct Ballast(PathBuf);

impl Drop for Ballast {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[test]
#[ignore = "thorough"]
fn a_full_disk_loses_nothing() {
    let [mut from, mut to] = old_and_new();
    let [mut before, mut after] = [&from, &to].map(|manifest| undisturbed(manifest));
    let atlas = Atlas::new(&from);
    let Some(disk) = Disk::mount(atlas.out()) else { return };
    // The first run, with room for a few of its files or for none.
    for free in [0, 3, 40] {
        let ballast = disk.fill(free);
        let (code, out, err) = atlas.run(&[]);
        assert_eq!((code, out.as_str()), (3, ""), "{err}");
        drop(ballast);
        check_files(&disk.0, &Tree::new(), &before);
    }
    complete(&atlas);
    assert!(tree(&disk.0) == before);
    let mut failed = 0;
    for free in [0, 1, 2, 3, 5, 9, 30] {
        atlas.edit(&to);
        let ballast = disk.fill(free);
        let (code, _, err) = atlas.run(&[]);
        drop(ballast);
        if code == 3 {
            failed += 1;
            assert!(err.starts_with("error: cannot write out/"), "{err}");
            let remedy =
                ": No space left on device (os error 28); free some space and run it again: finished files are kept\n";
            assert!(err.ends_with(remedy), "{err}");
        }
        assert!(code == 3 || code == 0, "{err}");
        check_files(&disk.0, &before, &after);
        complete(&atlas);
        assert!(tree(&disk.0) == after, "{free} blocks were free");
        (from, to) = (to, from);
        (before, after) = (after, before);
    }
    assert!(failed >= 4, "only {failed} runs failed");
}

#[test]
#[ignore = "thorough"]
fn a_starter_manifest_is_complete_or_absent() {
    let folder = tempfile::TempDir::new().unwrap();
    let Some(disk) = Disk::mount(folder.path().join("disk")) else { return };
    let init = || run(&disk.0, &["init", "my.toml"]);
    let ballast = disk.fill(0);
    let (code, _, err) = init();
    assert!(code == 3 && err.starts_with("error: cannot write my.toml: No space left"), "{err}");
    drop(ballast);
    assert!(tree(&disk.0).is_empty());
    assert_eq!(init().0, 0);
}

#[test]
#[ignore = "thorough"]
fn a_disk_that_cannot_be_written_is_left_unchanged() {
    let [old, new] = old_and_new();
    let atlas = Atlas::new(&old);
    let Some(disk) = Disk::mount(atlas.out()) else { return };
    complete(&atlas);
    let before = tree(&disk.0);
    atlas.edit(&new);
    disk.allow_writing(false);
    let (code, out, err) = atlas.run(&[]);
    assert_eq!((code, out.as_str()), (3, ""));
    let message = "error: cannot write out/.coupler-atlas.journal: Read-only file system (os error 30); \
                   change its permissions, or name another path\n";
    assert_eq!(err, message);
    assert!(tree(&disk.0) == before);
    // An unchanged atlas needs nothing to be written.
    atlas.edit(&old);
    let (code, out, err) = atlas.run(&[]);
    assert!(code == 0 && err.is_empty() && out.contains("unchanged"), "{out}{err}");
    atlas.edit(&new);
    disk.allow_writing(true);
    complete(&atlas);
    assert!(tree(&disk.0) == undisturbed(&new));
}

/// The limit ends the program during a write, by a signal that it does not handle.
#[test]
#[ignore = "thorough"]
fn a_limit_on_the_size_of_files_leaves_no_incomplete_file() {
    let [old, new] = old_and_new();
    let [before, after] = [&old, &new].map(|manifest| undisturbed(manifest));
    let atlas = Atlas::new(&old);
    complete(&atlas);
    for blocks in [1, 8, 30, 60] {
        atlas.edit(&new);
        let script = format!("ulimit -c 0; ulimit -f {blocks}; exec \"$0\" render -q");
        let status = shell(atlas.0.path(), &script).output().unwrap().status;
        assert_eq!(status.signal(), Some(25), "SIGXFSZ: {status}");
        check_files(&atlas.out(), &before, &after);
        complete(&atlas);
        assert!(tree(&atlas.out()) == after);
        atlas.edit(&old);
        complete(&atlas);
        assert!(tree(&atlas.out()) == before);
    }
}

#[test]
fn a_full_standard_output_is_reported() {
    let atlas = Atlas::new(&old_and_new()[0]);
    let full = File::options().write(true).open("/dev/full").unwrap();
    let output = atlas.command(&[]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let err = String::from_utf8(output.stderr).unwrap();
    assert!(err.starts_with("error: cannot write to standard output: No space left on device"), "{err}");
    let (code, out, _) = atlas.run(&[]);
    assert!(code == 0 && out.matches("(unchanged)").count() == 3, "the atlas itself is finished: {out}");
}
