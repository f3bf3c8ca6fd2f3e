//! Which room may import which, read from the imports themselves.
//!
//! Where this differs from a plain reading of data going one way, it is for the sake of one word for one thing: a
//! family says how its circuits are sampled in motion's words, a manifest names the templates that notation reads, and
//! the colours and typefaces of a scene, and a record has the columns of the measures. What comes off the press in order
//! is the same for those who write it and those who check it: a room of its own before both. The gallery's page has a solver
//! of its own, which is given the templates themselves, and shows where a page's scene has which curve. What is taken away of a
//! curve is drawn as a page is and written as a record is, and has JSON of its own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

const HOUSE: [(&str, &str); 24] = [
    ("geometry", ""),
    ("problem", ""),
    ("expression", "geometry problem"),
    ("linkage", "geometry"),
    ("motion", "geometry linkage"),
    ("measure", "geometry linkage motion"),
    ("template", "expression linkage problem"),
    ("notation", "template expression problem"),
    ("catalogue", "notation template problem"),
    ("family", "template expression measure problem motion"),
    ("sweep", "family linkage motion measure"),
    ("chart", "expression family linkage measure motion sweep"),
    ("design", "geometry linkage motion measure template catalogue family sweep"),
    ("scene", "geometry"),
    ("page", "geometry expression linkage motion measure sweep scene chart"),
    ("render", "geometry scene"),
    ("manifest", "problem expression notation catalogue family page render template chart scene"),
    ("record", "family sweep measure"),
    ("export", "geometry linkage motion measure template catalogue family sweep scene page render record"),
    ("press", "family measure sweep chart scene page render manifest"),
    ("gallery", "geometry expression measure template family sweep scene page manifest record"),
    (
        "build",
        "geometry problem expression linkage motion measure template notation catalogue family sweep chart scene page \
         render manifest record press gallery",
    ),
    ("check", "geometry linkage motion measure sweep page manifest press gallery record render"),
    (
        "cli",
        "build check catalogue design export expression family geometry linkage manifest measure motion page problem record render sweep template",
    ),
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The code of each room, without comments and tests.
fn rooms() -> BTreeMap<String, Vec<(PathBuf, String)>> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut rooms: BTreeMap<String, Vec<(PathBuf, String)>> = BTreeMap::new();
    for path in sources(&src) {
        let relative = path.strip_prefix(&src).unwrap().to_owned();
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap();
        let code: String =
            code.lines().filter(|l| !l.trim_start().starts_with("//")).map(|l| format!("{l}\n")).collect();
        if relative.components().count() > 1 {
            let room = relative.components().next().unwrap().as_os_str().to_string_lossy().into_owned();
            rooms.entry(room).or_default().push((relative, code));
        }
    }
    rooms
}

/// The rooms a text names behind `prefix`, in single imports and in braces.
fn imports(code: &str, prefix: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        let rest = &code[at + prefix.len()..];
        let list = match rest.strip_prefix('{') {
            Some(list) => list.split('}').next().unwrap(),
            None => rest,
        };
        let names: Vec<&str> = if rest.starts_with('{') { list.split(',').collect() } else { vec![list] };
        for name in names {
            let name: String = name.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if !name.is_empty() {
                found.push(name);
            }
        }
    }
    found
}

#[test]
fn every_import_goes_the_way_of_the_data() {
    let rooms = rooms();
    let names: Vec<&str> = HOUSE.iter().map(|(room, _)| *room).collect();
    assert_eq!(rooms.keys().map(String::as_str).collect::<Vec<_>>(), {
        let mut n = names.clone();
        n.sort_unstable();
        n
    });
    let mut seen = 0;
    for (room, allowed) in HOUSE {
        let allowed: Vec<&str> = allowed.split_whitespace().collect();
        let prefix = if room == "cli" { "coupler_atlas::" } else { "crate::" };
        for (path, code) in &rooms[room] {
            for import in imports(code, prefix) {
                seen += 1;
                let is_allowed = import == room || allowed.contains(&import.as_str());
                assert!(is_allowed, "{} imports {import}, which {room} may not", path.display());
            }
        }
    }
    assert!(seen > 100, "the test reads the imports: {seen}");
}

#[test]
fn the_table_itself_has_no_way_back() {
    for (k, (room, allowed)) in HOUSE.iter().enumerate() {
        for import in allowed.split_whitespace() {
            let at = HOUSE.iter().position(|(other, _)| *other == import).unwrap();
            assert!(at < k, "{room} imports {import}, which stands after it");
        }
    }
}

#[test]
fn formats_files_and_prints_stay_in_their_rooms() {
    let only = [
        ("toml::", &["notation", "manifest", "catalogue"][..]),
        ("csv::", &["record", "cli"]),
        ("serde_json::", &["record", "export", "gallery", "cli"]),
        ("std::fs", &["build", "check", "record"]),
        ("fs::", &["build", "check", "record"]),
        ("println!", &["cli"]),
        ("eprintln!", &["cli"]),
        ("stdout()", &["cli"]),
        ("stderr()", &["cli"]),
        ("plotters", &["scene", "page"]),
        ("tiny_skia", &["render"]),
        ("krilla", &["render"]),
        ("quick_xml", &["cli", "render"]),
        ("svgtypes", &["render"]),
        ("skrifa", &["scene"]),
        ("annotate_snippets", &["problem"]),
        ("indicatif", &["cli"]),
        ("anyhow", &["cli"]),
        // Nothing depends on when it is.
        ("SystemTime", &[]),
        ("Instant::now", &[]),
    ];
    for (room, files) in rooms() {
        for (path, code) in files {
            for (word, rooms) in only {
                assert!(!code.contains(word) || rooms.contains(&room.as_str()), "{} has {word}", path.display());
            }
        }
    }
}
