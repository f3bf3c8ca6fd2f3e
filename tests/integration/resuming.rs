//! A run that was killed is continued where it ended, and its bookkeeping is proportional to its pages.

use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use coupler_atlas::manifest::Plan;
use coupler_atlas::output::{Error, Event, Options, write_atlas};
use tempfile::TempDir;

use crate::support;
use crate::support::folder::tree;

/// A family of this many pages; sorted pages come after all tables.
fn plan(pages: usize, is_sorted: bool, formats: &str) -> Plan {
    let sort = if is_sorted { "sort = \"-length\"\n" } else { "" };
    let text = format!(
        "[atlas]\ntitle = \"T\"\nformats = [{formats}]\n[page]\npaper = {{ width = \"100 mm\", height = \"100 mm\" }}\n\
         dpi = 20\n[[family]]\nid = \"evans\"\nlinkage = \"evans\"\npanels = [1, 1]\nmeasures = [\"length\"]\n{sort}\
         sampling = {{ samples = 12 }}\ngrid = {{ k = {{ from = 1, to = 9, count = {pages} }} }}\n\
         let = {{ p = 2, a = 2.6 }}\n"
    );
    support::plan::plan(&text)
}

/// Writes an atlas, and interrupts the run after this many pages; the number of pages drawn if it ended.
fn write(plan: &Plan, output: &TempDir, interrupt_after: usize) -> Option<usize> {
    let interrupt = Arc::new(AtomicBool::new(false));
    let options = Options { interrupt: Arc::clone(&interrupt), ..Options::default() };
    let (mut pages, mut drawn_pages) = (0, None);
    let result = write_atlas(plan, output.path(), &options, &mut |event| match event {
        Event::Page => {
            pages += 1;
            interrupt.store(pages >= interrupt_after, Ordering::Relaxed);
        }
        Event::End { drawn, .. } => drawn_pages = Some(drawn.unwrap_or(0)),
        _ => {}
    });
    assert!(matches!(result, Ok(_) | Err(Error::Interrupted)));
    result.ok().and(drawn_pages)
}

#[cfg(unix)]
#[test]
fn a_run_continues_its_unfinished_tables() {
    use std::os::unix::fs::MetadataExt;
    for (is_sorted, formats) in [(false, "\"svg\""), (true, "\"svg\", \"png\"")] {
        let plan = plan(60, is_sorted, formats);
        let fresh = TempDir::new().unwrap();
        assert_eq!(write(&plan, &fresh, usize::MAX), Some(60));
        let output = TempDir::new().unwrap();
        assert_eq!(write(&plan, &output, 40), None);
        let partial = output.path().join("evans/.coupler-atlas-points.csv.partial");
        let unfinished = fs::metadata(&partial).unwrap();
        let journal = fs::read_to_string(output.path().join(".coupler-atlas.journal")).unwrap();
        assert!(journal.lines().filter(|line| line.starts_with("{\"progress\"")).count() >= 40);
        // The table is the same file: its rows were not computed again.
        let drawn = write(&plan, &output, usize::MAX).unwrap();
        assert!((1..=20).contains(&drawn), "{drawn} pages were drawn after 40");
        assert_eq!(fs::metadata(output.path().join("evans/points.csv")).unwrap().ino(), unfinished.ino());
        assert!(tree(output.path()) == tree(fresh.path()));
    }
}

/// A family with several pieces of data for the gallery, which is interrupted when the first of them are finished.
#[test]
#[ignore = "thorough"]
fn a_run_continues_the_pieces_of_the_gallery() {
    let text = "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\n[[family]]\nid = \"evans\"\nlinkage = \"evans\"\n\
                panels = [32, 8]\nmeasures = []\nsampling = { samples = 128 }\n\
                grid = { k = { from = 1, to = 9, count = 10000 } }\nlet = { p = 2, a = 2.6 }\n";
    let plan = support::plan::plan(text);
    let fresh = TempDir::new().unwrap();
    write(&plan, &fresh, usize::MAX);
    let expected = tree(fresh.path());
    assert!(expected.contains_key("evans/gallery-curves-0002.js"));
    let output = TempDir::new().unwrap();
    let pages = expected.keys().filter(|name| name.ends_with(".svg")).count();
    assert_eq!(write(&plan, &output, pages - 8), None);
    assert!(output.path().join("evans/gallery-curves-0001.js").exists());
    let drawn = write(&plan, &output, usize::MAX).unwrap();
    assert!(drawn <= 8, "{drawn} pages were drawn");
    assert!(tree(output.path()) == expected);
}

#[test]
#[ignore = "thorough"]
fn damaged_remains_of_a_run_are_not_continued() {
    let plan = plan(40, false, "\"svg\"");
    let fresh = TempDir::new().unwrap();
    write(&plan, &fresh, usize::MAX);
    let partial = |name: &str| format!("evans/.coupler-atlas-{name}.partial");
    for name in [&partial("points.csv"), &partial("cells.csv"), "evans/evans-003.svg", ".coupler-atlas.journal"] {
        for damage in [0, 1, 2] {
            let output = TempDir::new().unwrap();
            assert_eq!(write(&plan, &output, 25), None);
            let path = output.path().join(name);
            let mut bytes = fs::read(&path).unwrap();
            match damage {
                0 => fs::remove_file(&path).unwrap(),
                1 => fs::write(&path, &bytes[..bytes.len() / 3]).unwrap(),
                _ => {
                    bytes[5] ^= 1;
                    fs::write(&path, bytes).unwrap();
                }
            }
            let interrupt = Options { overwrite: true, ..Options::default() };
            write_atlas(&plan, output.path(), &interrupt, &mut |_| {}).unwrap();
            assert!(tree(output.path()) == tree(fresh.path()), "{name}, damage {damage}");
        }
    }
}

#[test]
fn a_change_after_an_interruption_starts_anew() {
    let output = TempDir::new().unwrap();
    assert_eq!(write(&plan(40, false, "\"svg\""), &output, 25), None);
    let other = plan(30, false, "\"svg\"");
    assert_eq!(write(&other, &output, usize::MAX), Some(30));
    let fresh = TempDir::new().unwrap();
    write(&other, &fresh, usize::MAX);
    assert!(tree(output.path()) == tree(fresh.path()));
}

/// Twice the pages take twice the bytes of journal, and `run.json` is written only at the end.
#[test]
fn the_journal_grows_with_the_pages() {
    let journal_bytes = |pages: usize| {
        let output = TempDir::new().unwrap();
        assert_eq!(write(&plan(2 * pages, false, "\"svg\""), &output, pages), None);
        let journal = fs::read_to_string(output.path().join(".coupler-atlas.journal")).unwrap();
        // Pages drawn ahead of the interruption are in it as well.
        let written = journal.lines().filter(|line| line.starts_with("{\"written\"")).count();
        journal.len() as f64 / written as f64
    };
    let [few, many] = [50, 200].map(journal_bytes);
    assert!(many / few < 1.3 && few / many < 1.3, "{few} and {many} bytes a page");
}
