//! `render --watch` and `--open`.

#![cfg(unix)]

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::support::command::{folder_with, program, run};

fn manifest(p: f64) -> String {
    format!(
        "[atlas]\ntitle = \"T\"\noutput = \"out\"\n[[family]]\nid = \"evans\"\nlinkage = \"evans\"\ntitle = \"Evans\"\n\
         cases = [{{ p = {p}, a = 2.6 }}]\n[[family]]\nid = \"hoeken\"\nlinkage = \"hoeken\"\ntitle = \"Hoeken\"\n\
         cases = [{{}}]\n"
    )
}

/// A program that opens files, first on the path: it writes their names to `opened`.
fn opener(folder: &Path) -> String {
    let path = folder.join("bin");
    fs::create_dir(&path).unwrap();
    let script = path.join("xdg-open");
    fs::write(&script, format!("#!/bin/sh\necho \"$1\" >> '{}'\n", folder.join("opened").display())).unwrap();
    Command::new("chmod").arg("+x").arg(&script).status().unwrap();
    format!("{}:{}", path.display(), std::env::var("PATH").unwrap())
}

/// A run that goes on until it is dropped or ended.
struct Watching {
    folder: TempDir,
    child: Child,
}

impl Watching {
    fn start(arguments: &[&str]) -> Watching {
        let folder = folder_with(&manifest(2.5));
        let [out, err] = ["out.txt", "err.txt"].map(|name| File::create(folder.path().join(name)).unwrap());
        let mut program = program(folder.path());
        program.env("PATH", opener(folder.path())).args(["render", "--watch"]).args(arguments).stdout(out).stderr(err);
        Watching { child: program.spawn().unwrap(), folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_default()
    }

    /// Waits for something that a run brings about.
    fn wait(&self, what: &str, is_there: impl Fn() -> bool) {
        let start = Instant::now();
        while !is_there() {
            assert!(start.elapsed() < Duration::from_secs(60), "{what}: {}", self.text("err.txt"));
            sleep(Duration::from_millis(5));
        }
    }

    /// Waits until the run has waited for changes for the `count`-th time.
    fn wait_for_rest(&self, count: usize) {
        self.wait("rest", || self.text("err.txt").matches("waiting for changes of atlas.toml").count() == count);
    }

    fn end(&mut self) -> Option<i32> {
        assert!(Command::new("kill").args(["-TERM", &self.child.id().to_string()]).status().unwrap().success());
        self.child.wait().unwrap().code()
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn what_has_changed_is_drawn_whenever_the_manifest_changes() {
    let mut watching = Watching::start(&[]);
    watching.wait_for_rest(1);
    let pages = || ["evans", "hoeken"].map(|id| watching.text(&format!("out/{id}/{id}-001.svg")));
    let first = pages();
    fs::write(watching.path("atlas.toml"), manifest(2.75)).unwrap();
    watching.wait_for_rest(2);
    let second = pages();
    assert!(second[0].contains("2.75") && second[0] != first[0] && second[1] == first[1]);
    let out = watching.text("out.txt");
    assert_eq!(out.matches("\nhoeken: ").count(), 1, "{out}");
    // A problem is reported, and nothing is changed until it is mended.
    fs::write(watching.path("atlas.toml"), manifest(2.75).replace("title", "titel")).unwrap();
    watching.wait_for_rest(3);
    assert!(watching.text("err.txt").contains("titel"), "{}", watching.text("err.txt"));
    assert!(pages() == second);
    // As an editor does that moves the old file away.
    fs::rename(watching.path("atlas.toml"), watching.path("atlas.toml~")).unwrap();
    sleep(Duration::from_millis(100));
    fs::write(watching.path("atlas.toml"), manifest(2.5)).unwrap();
    watching.wait_for_rest(4);
    assert!(pages() == first);
    assert_eq!(watching.end(), Some(0));
}

#[test]
fn a_table_of_cases_is_watched_as_well() {
    let mut watching = Watching::start(&[]);
    watching.wait_for_rest(1);
    let text = manifest(2.5).replace("[{ p = 2.5, a = 2.6 }]", "\"list.csv\"");
    fs::write(watching.path("atlas.toml"), text).unwrap();
    watching.wait_for_rest(2);
    assert!(watching.text("err.txt").contains("cannot read `list.csv`"), "{}", watching.text("err.txt"));
    let page = || watching.text("out/evans/evans-001.svg");
    let first = page();
    fs::write(watching.path("list.csv"), "p,a\n2.5,2.6\n").unwrap();
    watching.wait_for_rest(3);
    assert!(page() == first);
    fs::write(watching.path("list.csv"), "p,a\n2.75,2.6\n").unwrap();
    watching.wait_for_rest(4);
    assert!(page().contains("2.75"), "{}", watching.text("err.txt"));
    assert_eq!(watching.end(), Some(0));
}

#[test]
fn the_page_that_is_opened_shows_the_pages_and_the_problems() {
    let mut watching = Watching::start(&["--open"]);
    watching.wait_for_rest(1);
    watching.wait("opened", || watching.text("opened").ends_with(".html\n"));
    let page = PathBuf::from(watching.text("opened").trim_end());
    let state = || fs::read_to_string(page.with_file_name("state.js")).unwrap();
    assert!(fs::read_to_string(&page).unwrap().contains("state.js"));
    let first = state();
    let folder = watching.folder.path().canonicalize().unwrap();
    let address = format!("file://{}/out/evans/evans-001.svg?", folder.display());
    assert!(first.contains(&address) && first.contains("\"problem\":null"), "{first}");
    fs::write(watching.path("atlas.toml"), manifest(2.5).replace("title", "titel")).unwrap();
    watching.wait_for_rest(2);
    assert!(state().contains("titel") && state().contains(&address), "{}", state());
    fs::write(watching.path("atlas.toml"), manifest(2.75)).unwrap();
    watching.wait_for_rest(3);
    assert!(state().contains("\"problem\":null") && state() != first);
    assert_eq!(watching.end(), Some(0));
    assert!(!page.exists());
}

#[test]
fn the_gallery_is_opened() {
    let folder = folder_with(&manifest(2.5));
    let open = |path: &str| program(folder.path()).env("PATH", path).args(["render", "--open"]).output().unwrap();
    let output = open(&opener(folder.path()));
    assert!(output.status.success());
    let start = Instant::now();
    let opened = || fs::read_to_string(folder.path().join("opened")).unwrap_or_default();
    while opened() != "out/index.html\n" {
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}", opened());
        sleep(Duration::from_millis(5));
    }
    // Without a program that opens files the run has done its work all the same.
    let output = open("");
    assert!(output.status.success());
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("warning: cannot open out/index.html: "));
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let folder = folder_with(&manifest(2.5));
    let (code, _, err) = run(folder.path(), &["render", "-", "--watch", "-o", "out"]);
    assert_eq!(
        (code, err.as_str()),
        (2, "error: --watch needs a manifest in a file: standard input does not change\n")
    );
    let (code, _, err) = run(folder.path(), &["render", "--watch", "--strict"]);
    assert!(code == 2 && err.contains("--strict"), "{err}");
}
