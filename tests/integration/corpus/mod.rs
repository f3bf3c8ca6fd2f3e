//! The checks of the fuzz targets on the corpora in `fuzz/`: on each text, and on some changes of it.

mod any_linkage;
mod checks;
mod mutator;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use mutator::Mutator;

/// The number of changes that are made of each text, of large ones a tenth; `CORPUS_CHANGES=10000` makes more.
fn change_count() -> usize {
    std::env::var("CORPUS_CHANGES").ok().and_then(|number| number.parse().ok()).unwrap_or(300)
}

/// The texts of single files and of the files of folders, sorted by path.
fn texts(places: &[&str]) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for place in places.iter().map(|place| Path::new(env!("CARGO_MANIFEST_DIR")).join(place)) {
        let files = match fs::read_dir(&place) {
            Ok(entries) => entries.map(|entry| entry.unwrap().path()).collect(),
            Err(_) => vec![place],
        };
        let is_text = |path: &PathBuf| path.is_file() && path.extension().is_none_or(|extension| extension != "rs");
        found.extend(files.into_iter().filter(is_text).map(|path| {
            let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            (path, text)
        }));
    }
    found.sort();
    found
}

/// Runs a check on texts and their changes, and names the one that fails.
fn run_check(texts: &[(PathBuf, String)], changes: usize, check: fn(&str)) {
    let seeds = 1..;
    for (seed, (path, text)) in seeds.zip(texts) {
        let mut mutator = Mutator::new(seed);
        let changed = std::iter::repeat_with(|| mutator.change(text)).take(changes);
        for (k, text) in std::iter::once(text.clone()).chain(changed).enumerate() {
            let passes = std::panic::catch_unwind(|| check(&text));
            assert!(passes.is_ok(), "{}, change {k}:\n{text}", path.display());
        }
    }
}

#[test]
fn any_manifest_is_a_plan_or_has_problems() {
    let small = texts(&["fuzz/corpus/manifest", "src/cli/starter.toml", "crates/coupler-curves/src/catalogue"]);
    assert!(small.len() > 20);
    run_check(&small, change_count(), checks::manifest);
    let large = texts(&["atlas.toml", "examples"]);
    assert!(large.len() > 2);
    run_check(&large, change_count() / 10, checks::manifest);
}

#[test]
fn any_expression_is_parsed_or_has_an_error() {
    let texts = texts(&["fuzz/corpus/expression"]);
    assert!(texts.len() > 10);
    run_check(&texts, change_count(), checks::expression);
}

/// Bytes that choose linkages, the same in every run.
fn random_bytes(count: usize) -> impl Iterator<Item = Vec<u8>> {
    (1..=count as u64).map(|seed| {
        let mut mutator = Mutator::new(seed);
        (0..96).map(|_| mutator.below(256) as u8).collect()
    })
}

/// Measures a number of linkages, and names the one that fails.
fn measure_linkages(count: usize) {
    let mut curves = 0;
    for bytes in random_bytes(count) {
        match std::panic::catch_unwind(|| any_linkage::measures(&bytes)) {
            Ok(has_curve) => curves += usize::from(has_curve),
            Err(_) => panic!("{}", any_linkage::command(&bytes)),
        }
    }
    assert!(curves > count / 10, "{curves} have curves");
}

#[test]
fn any_linkage_is_refused_or_measured() {
    measure_linkages(100);
}

/// In a process of its own, whose greatest memory is that of the linkages. `CORPUS_CHANGES=2000` measures 10,000.
#[test]
#[ignore = "thorough"]
fn any_linkage_is_measured_in_bounded_memory() {
    const CHILD: &str = "CORPUS_MEASURES_LINKAGES";
    const MAX_KILOBYTES: u64 = 150_000;
    if std::env::var_os(CHILD).is_none() {
        let name = "corpus::any_linkage_is_measured_in_bounded_memory";
        let mut child = Command::new(std::env::current_exe().unwrap());
        let output = child.args([name, "--exact", "--ignored", "--nocapture"]).env(CHILD, "1").output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        return;
    }
    measure_linkages(5 * change_count());
    // Elsewhere it is only measured that none fails.
    let Ok(status) = fs::read_to_string("/proc/self/status") else { return };
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("the peak of memory");
    let kilobytes: u64 = peak.split_whitespace().next().expect("a number").parse().unwrap();
    assert!(kilobytes <= MAX_KILOBYTES, "{kilobytes} kB");
}

#[test]
#[ignore = "thorough"]
fn any_file_of_a_recorded_atlas_can_be_checked() {
    for (corpus, check) in [
        ("fuzz/corpus/points", checks::points as fn(&str)),
        ("fuzz/corpus/cells", checks::cells),
        ("fuzz/corpus/page", checks::page),
        ("fuzz/corpus/record", checks::record),
    ] {
        let texts = texts(&[corpus]);
        assert!(!texts.is_empty(), "{corpus}");
        run_check(&texts, change_count(), check);
    }
}

/// The files of paths with changes of their text and of their numbers, also in the encodings of spreadsheets.
fn check_paths(changes: usize) -> usize {
    let texts = texts(&["fuzz/corpus/path", "examples/sketch.svg"]);
    assert!(texts.len() > 15);
    let mut count = 0;
    for (seed, (path, text)) in (1..).zip(&texts) {
        let mut mutator = Mutator::new(seed);
        for k in 0..changes {
            let text = match k % 3 {
                0 => mutator.change(text),
                1 => mutator.change_numbers(text),
                _ => {
                    let changed = mutator.change(text);
                    mutator.change_numbers(&changed)
                }
            };
            let bytes = match k % 7 {
                3 => text.encode_utf16().flat_map(u16::to_le_bytes).collect(),
                _ => text.clone().into_bytes(),
            };
            let passes = std::panic::catch_unwind(|| checks::path(&bytes));
            assert!(passes.is_ok(), "{}, change {k}:\n{text}", path.display());
            count += 1;
        }
    }
    count
}

#[test]
fn any_file_is_a_path_or_has_problems() {
    assert!(check_paths(40) > 600);
}

#[test]
#[ignore = "thorough"]
fn any_of_many_files_is_a_path_or_has_problems() {
    assert!(check_paths(1200) >= 20_000);
}
