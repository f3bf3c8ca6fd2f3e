//! The direction of imports inside each crate; between crates the compiler enforces it.
//!
//! The modules of a `lib.rs` are in the order in which data flows, and none imports one that comes after it. No files import each
//! other in a circle: neither two of them, nor several in turn.

mod names;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use names::Names;

/// The source folders of the crates: of those without files, threads and clocks, of the program, and of the Python package.
pub const CRATES: [&str; 8] = [
    "crates/coupler-curves/src",
    "crates/coupler-find/src",
    "crates/coupler-drawing/src",
    "crates/coupler-manifest/src",
    "crates/coupler-paths/src",
    "crates/coupler-kernel/src",
    "src",
    "crates/python/src",
];

/// The names that a file takes from another of its crate.
type Imports = BTreeMap<(String, String), BTreeSet<String>>;

/// The Rust files of a folder, each by its path in the crate's folder, with its text.
fn texts(source: &Path, folder: &Path, found: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts(source, &path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let parts = path.strip_prefix(source).unwrap().iter().map(|part| part.to_str().unwrap());
            found.insert(parts.collect::<Vec<_>>().join("/"), fs::read_to_string(&path).unwrap());
        }
    }
}

/// The files that a file imports, directly or through others.
fn reached<'a>(imports: &'a Imports, file: &'a str) -> BTreeSet<&'a str> {
    let mut found = BTreeSet::new();
    let mut next = vec![file];
    while let Some(from) = next.pop() {
        let direct = imports.keys().filter(|(importer, _)| importer == from).map(|(_, imported)| imported.as_str());
        next.extend(direct.filter(|imported| found.insert(*imported)));
    }
    found
}

/// The circles, each with its files and the names that tie them.
fn circles(imports: &Imports) -> Vec<String> {
    let files: BTreeSet<&str> = imports.keys().map(|(importer, _)| importer.as_str()).collect();
    let reached: BTreeMap<&str, BTreeSet<&str>> = files.iter().map(|file| (*file, reached(imports, file))).collect();
    let circle = |file: &str| -> BTreeSet<&str> {
        let is_back = |other: &&&str| reached[file].contains(**other) && reached[**other].contains(file);
        files.iter().filter(is_back).copied().collect()
    };
    let circles: BTreeSet<BTreeSet<&str>> = files.iter().map(|file| circle(file)).collect();
    let text = |circle: BTreeSet<&str>| {
        let ties = imports.iter().filter(|((from, to), _)| circle.contains(&**from) && circle.contains(&**to));
        let line = |((from, to), names): (&(String, String), &BTreeSet<String>)| {
            format!("\n  {from} takes {} from {to}", names.iter().map(String::as_str).collect::<Vec<_>>().join(", "))
        };
        format!("{} files import each other:{}", circle.len(), ties.map(line).collect::<String>())
    };
    circles.into_iter().filter(|circle| !circle.is_empty()).map(text).collect()
}

/// The modules that a `lib.rs` declares, in its order.
fn modules<'a>(lib: &'a str) -> Vec<&'a str> {
    let name = |line: &'a str| line.trim_start_matches("pub ").strip_prefix("mod ")?.strip_suffix(';');
    lib.lines().filter_map(name).collect()
}

/// The imports of a module that comes after the one that takes it, each in a line.
fn backward(imports: &Imports, modules: &[&str]) -> Vec<String> {
    let place = |file: &str| {
        let module = file.split('/').next().unwrap().trim_end_matches(".rs");
        modules.iter().position(|name| *name == module)
    };
    let is_backward =
        |(from, to): &(String, String)| matches!((place(from), place(to)), (Some(from), Some(to)) if from < to);
    let backward = imports.keys().filter(|pair| is_backward(pair));
    backward.map(|(from, to)| format!("{from} imports {to}, which comes after it")).collect()
}

#[test]
fn no_files_import_each_other_and_no_module_one_that_comes_after_it() {
    let mut seen = 0;
    let mut found = Vec::new();
    for source in CRATES {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(source);
        let mut files = BTreeMap::new();
        texts(&folder, &folder, &mut files);
        let names = Names::of(&files);
        // The program's own file is a crate of its own.
        let unread: Vec<&String> = files.keys().filter(|file| *file != "main.rs" && !names.has_read(file)).collect();
        assert!(unread.is_empty(), "{source}: no module declares {unread:?}");
        let imports = names.imports();
        seen += imports.len();
        let wrong = [circles(&imports), backward(&imports, &modules(&files["lib.rs"]))].concat();
        found.extend(wrong.into_iter().map(|one| format!("{source}: {one}")));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(seen > 1000, "only {seen} imports were found");
}

/// The imports of an invented crate.
fn invented(files: &[(&str, &str)]) -> Imports {
    let files = files.iter().map(|(path, text)| (path.to_string(), text.to_string())).collect();
    Names::of(&files).imports()
}

/// The imports of one file of an invented crate, as `file: names`.
fn taken(imports: &Imports, file: &str) -> Vec<String> {
    let line = |((_, to), names): (&(String, String), &BTreeSet<String>)| {
        format!("{to}: {}", names.iter().map(String::as_str).collect::<Vec<_>>().join(" "))
    };
    imports.iter().filter(|((from, _), _)| from == file).map(line).collect()
}

#[test]
fn circles_are_found_and_described() {
    let wheel = "use super::axle::Axle;\npub struct Wheel(Axle);";
    let axle = "use crate::cart::BEAM;\npub struct Axle([u8; BEAM]);";
    let cart = "mod axle;\nmod wheel;\nmod load;\npub use load::Load;\npub const BEAM: usize = 2;\n";
    let files = [
        ("lib.rs", "mod cart;"),
        ("cart/axle.rs", axle),
        ("cart/wheel.rs", wheel),
        ("cart/load.rs", "pub struct Load;"),
    ];
    let with_cart = |text: &str| circles(&invented(&[&files[..], &[("cart/mod.rs", text)]].concat()));
    assert_eq!(with_cart(cart), [""; 0]);
    assert_eq!(
        with_cart(&format!("{cart}pub fn roll(_: wheel::Wheel) {{}}")),
        ["3 files import each other:\n  cart/axle.rs takes BEAM from cart/mod.rs\n  cart/mod.rs takes Wheel from \
          cart/wheel.rs\n  cart/wheel.rs takes Axle from cart/axle.rs"]
    );
    // Neither declarations, nor what is exported again, nor tests, nor comments.
    assert_eq!(with_cart(&format!("{cart}pub use wheel::Wheel;\n// wheel::Wheel\n")), [""; 0]);
    assert_eq!(with_cart(&format!("{cart}#[cfg(test)]\nmod tests {{\nuse super::wheel::Wheel;\n}}")), [""; 0]);
}

#[test]
fn a_module_that_imports_a_later_one_is_named() {
    let files = |wheel| [("lib.rs", "pub mod axle;\nmod wheel;"), ("axle.rs", "pub struct Axle;"), ("wheel.rs", wheel)];
    let in_order = |lib| backward(&invented(&files("pub struct Wheel(crate::axle::Axle);")), &modules(lib));
    assert_eq!(in_order("pub mod axle;\nmod wheel;"), [""; 0]);
    assert_eq!(in_order("mod wheel;\npub mod axle;"), ["wheel.rs imports axle.rs, which comes after it"]);
}

#[test]
fn names_lead_to_the_file_that_defines_them() {
    let lib = "pub mod shape;\npub mod paint;\npub use shape::*;";
    let shape = "mod circle;\nmod area;\npub use area::area;\npub(crate) use circle::{Circle as Round, PI};";
    let circle = "pub struct Circle(pub f64);\npub const PI: f64 = 3.0;\npub enum Kind { Small }\npub fn unit() -> Circle { Circle(1.0) }";
    let area = "pub fn area(circle: &super::Round) -> f64 { circle.0 * super::PI }";
    let files = |paint: &'static str| {
        [
            ("lib.rs", lib),
            ("shape/mod.rs", shape),
            ("shape/circle.rs", circle),
            ("shape/area.rs", area),
            ("paint.rs", paint),
        ]
    };
    let taken_by_paint = |text: &'static str| taken(&invented(&files(text)), "paint.rs");
    assert_eq!(taken(&invented(&files("")), "shape/area.rs"), ["shape/circle.rs: PI Round"]);
    // Through several files, under another name, by a glob, in a function, in a macro, in a pattern.
    assert_eq!(
        taken_by_paint("use crate::{Round, area as size};\nfn f(round: &Round) -> f64 { size(round) }"),
        ["shape/area.rs: size", "shape/circle.rs: Round"]
    );
    assert_eq!(taken_by_paint("use crate::shape::*;\nfn f(_: Round) {}"), ["shape/circle.rs: Round"]);
    assert_eq!(taken_by_paint("fn f() { use crate::shape;\nshape::area(todo!()); }"), ["shape/area.rs: area"]);
    assert_eq!(taken_by_paint("fn f() { println!(\"{}\", 2.0 * crate::PI) }"), ["shape/circle.rs: PI"]);
    assert_eq!(
        taken_by_paint(
            "use crate::shape::circle;\nfn f(kind: u8) { matches!(kind, circle::Kind::Small if circle::unit()) }"
        ),
        ["shape/circle.rs: Kind unit"]
    );
    // A module and what it contains under the same name; a name of another crate; fields and methods.
    assert_eq!(taken_by_paint("use crate::shape::area;\nfn f(a: std::area::Round, b: A) { b.area.area() }"), [""; 0]);
    assert_eq!(
        taken_by_paint("mod inner { use super::super::shape; fn f() -> shape::Round {} }"),
        ["shape/circle.rs: Round"]
    );
}
