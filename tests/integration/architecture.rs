//! What the crates without files, threads and clocks must not use, and the crates that each is built from.

use std::collections::BTreeSet;
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
    for source in &CRATES[..6] {
        for (path, code) in code_files(&root().join(source)) {
            for word in banned {
                assert!(!code.contains(word), "{} uses {word}", path.display());
            }
        }
    }
    for (path, code) in code_files(&root().join(CRATES[6])) {
        // Output depends on no clock, and only the command line prints.
        assert!(!code.contains("SystemTime") && !code.contains("Instant::now"), "{} uses a clock", path.display());
        let prints = ["println!", "eprintln!", "stdout()", "stderr()"].iter().any(|word| code.contains(word));
        assert!(!prints || path.starts_with(root().join("src/cli")), "{} prints", path.display());
    }
}

/// The names that a module exports to its documentation, each once, by the module that it is documented in: without those of another
/// public module, and those that are `#[doc(hidden)]` because they are for the other crates of the workspace only.
fn documented_names(file: &Path, module: &str) -> BTreeSet<String> {
    let items = syn::parse_file(&fs::read_to_string(file).unwrap()).unwrap().items;
    let is_hidden = |attributes: &[syn::Attribute]| {
        let is_hidden = |attribute: &syn::Attribute| match &attribute.meta {
            syn::Meta::List(list) => list.path.is_ident("doc") && list.tokens.to_string() == "hidden",
            _ => false,
        };
        attributes.iter().any(is_hidden)
    };
    let is_documented = |visibility: &syn::Visibility, attributes: &[syn::Attribute]| {
        matches!(visibility, syn::Visibility::Public(_)) && !is_hidden(attributes)
    };
    let mut public_modules: BTreeSet<String> = BTreeSet::from(["crate".to_owned()]);
    public_modules.extend(items.iter().filter_map(|item| match item {
        syn::Item::Mod(item) if is_documented(&item.vis, &item.attrs) => Some(item.ident.to_string()),
        _ => None,
    }));
    let mut found = BTreeSet::new();
    for item in &items {
        let (visibility, attributes, names) = match item {
            syn::Item::Mod(item) if public_modules.contains(&item.ident.to_string()) => {
                let (folder, name) = (file.parent().unwrap(), item.ident.to_string());
                let files = [folder.join(&name).join("mod.rs"), folder.join(format!("{name}.rs"))];
                let file = files.iter().find(|file| file.exists()).unwrap();
                found.extend(documented_names(file, &format!("{module}::{name}")));
                continue;
            }
            syn::Item::Use(item) => (&item.vis, &item.attrs, leaves(&item.tree, &public_modules)),
            syn::Item::Const(item) => (&item.vis, &item.attrs, vec![item.ident.to_string()]),
            syn::Item::Enum(item) => (&item.vis, &item.attrs, vec![item.ident.to_string()]),
            syn::Item::Fn(item) => (&item.vis, &item.attrs, vec![item.sig.ident.to_string()]),
            syn::Item::Static(item) => (&item.vis, &item.attrs, vec![item.ident.to_string()]),
            syn::Item::Struct(item) => (&item.vis, &item.attrs, vec![item.ident.to_string()]),
            syn::Item::Trait(item) => (&item.vis, &item.attrs, vec![item.ident.to_string()]),
            syn::Item::Type(item) => (&item.vis, &item.attrs, vec![item.ident.to_string()]),
            _ => continue,
        };
        if is_documented(visibility, attributes) {
            found.extend(names.iter().map(|name| format!("{module}::{name}")));
        }
    }
    found
}

/// The names that a `use` brings in, unless it begins with one of these modules.
fn leaves(tree: &syn::UseTree, public_modules: &BTreeSet<String>) -> Vec<String> {
    match tree {
        syn::UseTree::Path(path) if public_modules.contains(&path.ident.to_string()) => Vec::new(),
        syn::UseTree::Path(path) => leaves(&path.tree, public_modules),
        syn::UseTree::Name(name) => vec![name.ident.to_string()],
        syn::UseTree::Rename(name) => vec![name.rename.to_string()],
        syn::UseTree::Group(group) => group.items.iter().flat_map(|tree| leaves(tree, public_modules)).collect(),
        syn::UseTree::Glob(_) => panic!("names are exported one by one"),
    }
}

/// What a user of the core has to choose from: as many names as `all.html` of its documentation lists.
#[test]
fn the_core_exports_few_names() {
    let names = documented_names(&root().join("crates/coupler-curves/src/lib.rs"), "coupler_curves");
    for name in ["CouplerCurve", "linkage::FourBar", "measure::ALL", "solve::Solver", "geometry::Point", "motion::pose"]
    {
        assert!(names.contains(&format!("coupler_curves::{name}")), "{name}");
    }
    assert!(names.iter().all(|name| !name.contains("TomlParser") && !name.contains("::trig")), "{names:?}");
    assert!(names.len() <= 120, "{} names: {names:#?}", names.len());
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
