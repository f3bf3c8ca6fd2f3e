//! The book that `render` writes: its files, its record, and when it is rewritten or left unchanged.

use std::collections::BTreeMap;
use std::fs;
use std::time::SystemTime;

use crate::support::command::run;
use crate::support::folder::{Atlas, edit_record};

const MANIFEST: &str = r#"
[atlas]
title = "Two families"
formats = ["svg", "pdf"]
output = "out"
[page]
paper = "a4"
[[family]]
id = "evans"
linkage = "evans"
title = "Evans linkage"
panels = [2, 1]
sampling = { samples = 60 }
grid = { p = [2, 3, 4, 5, 6] }
let = { a = "(1 + p)^1.5 / 2" }
[[family]]
id = "points"
linkage = "hrones-nelson"
title = "Coupler points"
layout = "coupler-grid"
sampling = { samples = 60 }
sort = "-A"
cases = [{ A = 2.5, B = 3, C = 2 }, { A = 3, B = 2, C = 3.5 }, { A = 1, B = 1, C = 4 }]
"#;

impl Atlas {
    /// Runs `render`, which must succeed, and returns its standard output.
    fn render(&self, arguments: &[&str]) -> String {
        let (code, out, err) = self.run(arguments);
        assert_eq!(code, 0, "{err}");
        out
    }

    /// The books in the output folder, with the times they were written and their bytes.
    fn books(&self) -> BTreeMap<String, (SystemTime, Vec<u8>)> {
        let mut found = BTreeMap::new();
        for entry in fs::read_dir(self.out()).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "pdf") {
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                found.insert(name, (fs::metadata(&path).unwrap().modified().unwrap(), fs::read(&path).unwrap()));
            }
        }
        found
    }

    fn names(&self) -> Vec<String> {
        self.books().into_keys().collect()
    }

    fn record(&self) -> serde_json::Value {
        serde_json::from_str(&self.read("run.json")).unwrap()
    }
}

/// The number of pages of a book: each has a size.
fn pages(bytes: &[u8]) -> usize {
    let size = b"/MediaBox";
    bytes.windows(size.len()).filter(|window| window == size).count()
}

/// The number of pages of a book that a run says it has written.
fn book_pages(out: &str) -> usize {
    let count = out.split("atlas.pdf: ").nth(1).and_then(|rest| rest.split(" pages\n").next()?.parse().ok());
    count.unwrap_or_else(|| panic!("{out}"))
}

#[test]
fn an_unchanged_book_is_not_rewritten() {
    let atlas = Atlas::new(MANIFEST);
    let out = atlas.render(&[]);
    // Three pages of panels and one of each cell of the grid; before them the title page, two pages that say how they are read and
    // the contents; after them lists and the index.
    let count = book_pages(&out);
    assert!(count > 4 + 6 + 1, "{out}");
    let books = atlas.books();
    assert_eq!(atlas.names(), ["atlas.pdf"]);
    let (time, bytes) = &books["atlas.pdf"];
    assert_eq!(pages(bytes), count);
    assert!(bytes.starts_with(b"%PDF-1.") && bytes.ends_with(b"%%EOF"));
    assert_eq!(atlas.record()["book"]["files"][0]["name"], "atlas.pdf");
    assert!(atlas.record()["book"]["files"][0]["sha256"].is_null());
    assert!(atlas.render(&[]).contains(&format!("atlas.pdf: {count} pages (unchanged)\n")));
    assert_eq!(atlas.books()["atlas.pdf"].0, *time);
    // The same bytes in another folder and on other threads.
    let other = Atlas::new(MANIFEST);
    other.render(&["--jobs", "3", "--format", "pdf"]);
    assert!(other.books()["atlas.pdf"].1 == *bytes);
    assert!(fs::read_dir(other.out().join("evans")).unwrap().count() == 3, "tables and data, and no pages");
}

#[test]
#[ignore = "thorough"]
fn a_changed_book_is_rewritten() {
    let atlas = Atlas::new(MANIFEST);
    atlas.render(&[]);
    let whole = atlas.books()["atlas.pdf"].1.clone();
    let cases: [(&str, &str); 5] = [
        ("A = 3, ", "A = 3.1, "),
        ("\"a4\"", "\"letter\""),
        ("Two families", "Another title"),
        ("sort = \"-A\"", ""),
        ("[page]", "[book]\nindex = false\n[page]"),
    ];
    for (from, to) in cases {
        atlas.edit(&MANIFEST.replace(from, to));
        assert!(book_pages(&atlas.render(&[])) > 4 + 6, "{from}");
        assert!(atlas.books()["atlas.pdf"].1 != whole, "{from}");
    }
    atlas.edit(MANIFEST);
    atlas.render(&[]);
    assert!(atlas.books()["atlas.pdf"].1 == whole);
    // A truncated book, and a missing one.
    let path = atlas.out().join("atlas.pdf");
    fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    atlas.render(&[]);
    assert!(fs::read(&path).unwrap() == whole);
    fs::remove_file(&path).unwrap();
    atlas.render(&[]);
    assert!(fs::read(&path).unwrap() == whole);
}

#[test]
fn a_longer_book_is_written_as_volumes() {
    let atlas = Atlas::new(MANIFEST);
    atlas.render(&[]);
    atlas.edit(&MANIFEST.replace("output =", "volume_pages = 4\noutput ="));
    let out = atlas.render(&[]);
    // Volumes of four and of two pages, each with front matter; lists and the index are in the last.
    assert!(out.contains("atlas-1.pdf to atlas-2.pdf: "), "{out}");
    let books = atlas.books();
    assert_eq!(atlas.names(), ["atlas-1.pdf", "atlas-2.pdf"], "the single book is removed");
    let counts: Vec<usize> = books.values().map(|(_, bytes)| pages(bytes)).collect();
    // Title, how to read and contents are before the plates of each.
    assert_eq!(counts[0], 4 + 4, "{counts:?}");
    assert!(counts[1] > 4 + 2 + 1, "{counts:?}");
    // One volume for each page: their names sort.
    atlas.edit(
        &MANIFEST
            .replace("output =", "volume_pages = 1\noutput =")
            .replace("p = [2, 3, 4, 5, 6]", "p = { from = 2, to = 10, step = 0.5 }"),
    );
    atlas.render(&[]);
    let names = atlas.names();
    assert_eq!((names.len(), names[0].as_str(), names[11].as_str()), (12, "atlas-01.pdf", "atlas-12.pdf"));
}

#[test]
fn a_book_that_is_no_longer_requested_is_removed_and_other_files_stay() {
    let atlas = Atlas::new(MANIFEST);
    atlas.render(&[]);
    fs::write(atlas.out().join("notes.pdf"), "mine").unwrap();
    let whole = atlas.books()["atlas.pdf"].clone();
    // Requests for other formats, or for some of the families, leave the book alone.
    atlas.render(&["--format", "png"]);
    atlas.render(&["--only", "evans"]);
    assert_eq!(atlas.books()["atlas.pdf"], whole);
    // A book that is requested explicitly has the requested families.
    let count = book_pages(&atlas.render(&["--only", "points", "--format", "pdf"]));
    assert!(count < book_pages(&atlas.render(&[])));
    assert_eq!(atlas.books()["atlas.pdf"].1, whole.1);
    atlas.edit(&MANIFEST.replace("[\"svg\", \"pdf\"]", "[\"svg\"]"));
    atlas.render(&[]);
    assert_eq!(atlas.names(), ["notes.pdf"]);
    assert!(atlas.record()["book"].is_null());
    // A record that names a file that is not a book removes nothing.
    atlas.edit(MANIFEST);
    atlas.render(&[]);
    edit_record(&atlas.out(), |run| run["book"]["files"][0]["name"] = "notes.pdf".into());
    atlas.edit(&MANIFEST.replace("[\"svg\", \"pdf\"]", "[\"svg\"]"));
    atlas.render(&[]);
    assert_eq!(atlas.names(), ["atlas.pdf", "notes.pdf"]);
}

#[test]
fn a_volume_has_at_least_one_page() {
    for wrong in ["0", "-3", "1.5", "\"many\"", "20000"] {
        let atlas = Atlas::new(&MANIFEST.replace("output =", &format!("volume_pages = {wrong}\noutput =")));
        let (code, _, errors) = run(atlas.0.path(), &["validate"]);
        assert!(code == 2 && errors.contains("atlas.toml:5:16"), "{errors}");
    }
}
