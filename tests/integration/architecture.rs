//! What the crates without files, threads and clocks must not use, and the crates that each is built from.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::imports::CRATES;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The Rust files of a folder, each with its code: without comments and without the unit tests at its end.
fn code_files(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(code_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
            let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
            let code = code.map(|line| format!("{line}\n")).collect();
            found.push((path, code));
        }
    }
    found
}

#[test]
fn only_the_program_uses_files_threads_clocks_and_the_terminal() {
    let banned = [
        "std::fs",
        "std::io::std",
        "std::thread",
        "std::time",
        "std::process",
        "std::env",
        "std::net",
        "rayon",
        "println!",
        "eprintln!",
    ];
    for source in &CRATES[..5] {
        for (path, code) in code_files(&root().join(source)) {
            for word in banned {
                assert!(!code.contains(word), "{} uses {word}", path.display());
            }
        }
    }
    for (path, code) in code_files(&root().join(CRATES[5])) {
        // Output depends on no clock, and only the command line prints.
        assert!(!code.contains("SystemTime") && !code.contains("Instant::now"), "{} uses a clock", path.display());
        let prints = ["println!", "eprintln!", "stdout()", "stderr()"].iter().any(|word| code.contains(word));
        assert!(!prints || path.starts_with(root().join("src/cli")), "{} prints", path.display());
    }
}

/// The crates a package is built from on this machine, including itself, each with its version.
fn crates(package: &str, options: &[&str]) -> Vec<String> {
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--offline", "--edges", "normal", "--prefix", "none", "--package", package])
        .args(options)
        .current_dir(root())
        .output()
        .unwrap();
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let tree = String::from_utf8(tree.stdout).unwrap();
    let mut crates: Vec<String> = tree.lines().map(|line| line.trim_end_matches(" (*)").to_owned()).collect();
    crates.sort_unstable();
    crates.dedup();
    crates
}

#[test]
fn the_core_is_built_from_few_crates() {
    let count = crates("coupler-curves", &[]).len();
    assert!((10..=50).contains(&count), "coupler-curves is built from {count} crates");
    let plates = crates("coupler-drawing", &["--no-default-features"]).len();
    let drawing = crates("coupler-drawing", &[]).len();
    let program = crates("coupler-atlas", &[]).len();
    assert!(program > drawing && drawing > plates && plates > count);
    // Other systems take other crates.
    if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        let page = include_str!("../../docs/architecture.md");
        for (package, counts) in [
            ("coupler-curves", format!("{count} crates")),
            ("coupler-drawing", format!("{plates} crates without features, {drawing} with all")),
            ("coupler-atlas", format!("{program} crates")),
        ] {
            let row = page.lines().find(|line| line.starts_with(&format!("| [`{package}`]"))).unwrap();
            assert!(row.ends_with(&format!("| {counts} |")), "{package} is built from {counts}");
        }
    }
}

#[test]
fn plates_need_neither_plotters_nor_font_files_nor_threads() {
    let is_one_of = |name: &'static str| move |one: &String| one.starts_with(&format!("{name} "));
    let [plates, drawing] = [&["--no-default-features"][..], &[]].map(|options| crates("coupler-drawing", options));
    for name in ["plotters", "plotters-backend", "flate2", "skrifa"] {
        assert!(!plates.iter().any(is_one_of(name)) && drawing.iter().any(is_one_of(name)), "{name}");
    }
    let kernel = crates("coupler-kernel", &["--target", "wasm32-unknown-unknown"]);
    assert!(kernel.iter().any(is_one_of("coupler-manifest")));
    for name in ["rayon", "wasm-bindgen", "js-sys", "web-sys", "plotters", "flate2", "skrifa"] {
        assert!(![&plates, &kernel].iter().any(|crates| crates.iter().any(is_one_of(name))), "{name}");
    }
}
