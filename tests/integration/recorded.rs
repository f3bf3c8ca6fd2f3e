//! Files of the repository that the program makes: golden pages, documents and pictures.
//!
//! `.ci/renew` makes them again, or for these alone `RENEW=1 cargo test --test integration -- --include-ignored is_recorded`, which runs the tests
//! whose names end so.

use std::fs;
use std::path::Path;

/// Whether files are written instead of being compared.
pub fn are_renewed() -> bool {
    std::env::var_os("RENEW").is_some()
}

/// Writes a file of the repository, given by its path from the root.
pub fn renew(name: &str, contents: &[u8]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, contents).unwrap();
}

/// Compares a text file with its contents, and names the first line that differs.
pub fn assert_recorded(name: &str, contents: &str) {
    if are_renewed() {
        renew(name, contents.as_bytes());
    }
    let recorded = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).unwrap_or_default();
    if recorded == contents {
        return;
    }
    let differing = (1..).zip(recorded.lines().zip(contents.lines())).find(|(_, (before, now))| before != now);
    let place = match differing {
        Some((line, (before, now))) => format!("line {line} is\n{now}\nand was\n{before}"),
        None => format!("it has {} lines, and had {}", contents.lines().count(), recorded.lines().count()),
    };
    panic!("{name} is not what the program makes: {place}\nif that is intended: .ci/renew");
}
