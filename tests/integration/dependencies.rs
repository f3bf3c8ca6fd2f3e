//! docs/dependencies.md and deny.toml agree with the manifests, the lock file and the licences of the crates.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use toml::de::{DeTable, DeValue};

fn parsed(text: &'static str) -> DeTable<'static> {
    DeTable::parse(text).unwrap().into_inner()
}

fn table<'v>(table: &'v DeTable<'static>, key: &str) -> &'v DeTable<'static> {
    table.get(key).and_then(|value| value.get_ref().as_table()).unwrap_or_else(|| panic!("no [{key}]"))
}

fn texts<'v>(table: &'v DeTable<'static>, key: &str) -> Vec<&'v str> {
    let list = table.get(key).and_then(|value| value.get_ref().as_array());
    list.into_iter().flatten().filter_map(|item| item.get_ref().as_str()).collect()
}

/// The features a dependency is used with, as the table of docs/dependencies.md writes them.
fn features(dependency: &DeValue<'static>) -> String {
    let Some(options) = dependency.as_table() else { return "default".to_owned() };
    let has_default = options.get("default-features").is_none_or(|value| value.get_ref().as_bool() == Some(true));
    let features = has_default.then_some("default").into_iter().chain(texts(options, "features"));
    match features.collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => "none".to_owned(),
        features => features,
    }
}

/// The rows of the tables of docs/dependencies.md, each by its first cell.
fn documented() -> BTreeMap<&'static str, Vec<&'static str>> {
    let rows = include_str!("../../docs/dependencies.md").lines().filter(|line| line.starts_with("| `"));
    let mut found = BTreeMap::new();
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let name = cells[0].trim_matches('`');
        assert!(found.insert(name, cells[1..].to_vec()).is_none(), "{name} is listed twice");
    }
    found
}

/// Every crate that is built on this machine, with its licence.
fn licences() -> BTreeMap<String, String> {
    let version = Command::new("rustc").arg("-vV").output().unwrap();
    let version = String::from_utf8(version.stdout).unwrap();
    let host = version.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    // Crates of other platforms may not be available, and tests fetch nothing.
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked", "--offline", "--filter-platform", host])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(metadata.status.success(), "{}", String::from_utf8_lossy(&metadata.stderr));
    let metadata: Value = serde_json::from_slice(&metadata.stdout).unwrap();
    let licence = |package: &Value| {
        let text = |key: &str| package[key].as_str().unwrap_or_default().to_owned();
        (text("name"), text("license"))
    };
    metadata["packages"].as_array().unwrap().iter().map(licence).collect()
}

#[test]
fn exactly_the_direct_dependencies_are_documented() {
    let cargo = parsed(include_str!("../../Cargo.toml"));
    let direct: BTreeMap<&str, String> = table(table(&cargo, "workspace"), "dependencies")
        .iter()
        .filter(|(name, _)| !name.get_ref().starts_with("coupler-"))
        .map(|(name, value)| (name.get_ref().as_ref(), features(value.get_ref())))
        .collect();
    let documented = documented();
    assert_eq!(direct.keys().collect::<Vec<_>>(), documented.keys().collect::<Vec<_>>());
    let licences = licences();
    for (name, cells) in documented {
        let [purpose, features, licence] = cells[..] else { panic!("{name}: {cells:?}") };
        assert!(purpose.len() > 10, "no purpose is documented for {name}");
        assert_eq!(features, direct[name], "the features of {name}");
        assert_eq!(licence, licences[name], "the licence of {name}");
    }
}

/// Whether some choice among the alternatives of a licence expression has allowed licences only.
fn is_allowed(licence: &str, allowed: &BTreeSet<&str>) -> bool {
    let licence = licence.replace('/', " OR ");
    let is_one = |part: &str| part.trim_matches(['(', ')']).split(" OR ").any(|one| allowed.contains(one));
    !licence.is_empty() && licence.split(" AND ").all(is_one)
}

#[test]
fn every_licence_is_one_of_those_allowed() {
    let deny = parsed(include_str!("../../deny.toml"));
    let licenses = table(&deny, "licenses");
    let allowed: BTreeSet<&str> = texts(licenses, "allow").into_iter().collect();
    let excepted = |name: &str, licence: &str| {
        let exceptions = licenses.get("exceptions").and_then(|value| value.get_ref().as_array()).unwrap();
        exceptions.iter().filter_map(|one| one.get_ref().as_table()).any(|one| {
            let is_for_crate = one.get("crate").and_then(|value| value.get_ref().as_str()) == Some(name);
            is_for_crate && texts(one, "allow").contains(&licence)
        })
    };
    let licences = licences();
    assert!(licences.len() > 100);
    for (name, licence) in &licences {
        assert!(is_allowed(licence, &allowed) || excepted(name, licence), "{name} is under {licence}");
    }
    for licence in ["GPL-3.0", "MIT AND GPL-3.0", "AGPL-3.0-only", "", "MPL-2.0"] {
        assert!(!is_allowed(licence, &allowed), "{licence}");
    }
    for licence in &allowed {
        let is_needed = |other: &String| other.split([' ', '/', '(', ')']).any(|word| word == *licence);
        assert!(licences.values().any(is_needed), "no crate is under {licence}");
    }
}

/// Checked in Cargo.lock, which has the crates of all platforms.
#[test]
fn all_crates_are_from_crates_io_and_none_is_banned() {
    let lock = parsed(include_str!("../../Cargo.lock"));
    let packages = lock.get("package").and_then(|value| value.get_ref().as_array()).unwrap();
    let text = |package: &DeTable<'static>, key: &str| {
        package.get(key).and_then(|value| value.get_ref().as_str()).map(str::to_owned)
    };
    let mut names = BTreeSet::new();
    for package in packages.iter().filter_map(|package| package.get_ref().as_table()) {
        let name = text(package, "name").unwrap();
        let source = text(package, "source");
        let is_own = name.starts_with("coupler-") && source.is_none();
        let is_of_crates_io = source.as_deref() == Some("registry+https://github.com/rust-lang/crates.io-index");
        assert!(is_own || is_of_crates_io, "{name} comes from {source:?}");
        names.insert(name);
    }
    assert!(names.len() > 100);
    let deny = parsed(include_str!("../../deny.toml"));
    let bans = table(&deny, "bans").get("deny").and_then(|value| value.get_ref().as_array()).unwrap();
    let banned: Vec<String> = bans.iter().filter_map(|ban| text(ban.get_ref().as_table()?, "crate")).collect();
    for expected in ["evalexpr", "exmex", "fasteval", "usvg@<0.48", "svg2pdf", "ttf-parser", "rustybuzz", "bincode"] {
        assert!(banned.iter().any(|ban| ban == expected), "{expected}");
    }
    // The lock file has no version at all of usvg, of which only some versions are banned.
    let found: Vec<_> = banned.iter().filter(|ban| names.contains(ban.split('@').next().unwrap())).collect();
    assert!(found.is_empty(), "{found:?}");
}

/// The lints of the workspace apply to libraries, program, tests, benchmarks and examples of every crate alike, except the
/// kernel, whose functions for the page share memory with it: only their module allows unsafe code.
#[test]
fn unsafe_code_is_forbidden() {
    let cargo = parsed(include_str!("../../Cargo.toml"));
    let lints = table(table(&cargo, "workspace"), "lints");
    let level = table(lints, "rust").get("unsafe_code").and_then(|value| value.get_ref().as_str());
    assert_eq!(level, Some("forbid"));
    let curves = parsed(include_str!("../../crates/coupler-curves/Cargo.toml"));
    let drawing = parsed(include_str!("../../crates/coupler-drawing/Cargo.toml"));
    let manifest = parsed(include_str!("../../crates/coupler-manifest/Cargo.toml"));
    for member in [&cargo, &curves, &drawing, &manifest] {
        let inherits = table(member, "lints").get("workspace").and_then(|value| value.get_ref().as_bool());
        assert_eq!(inherits, Some(true));
    }
    let kernel = parsed(include_str!("../../crates/coupler-kernel/Cargo.toml"));
    let rust = table(table(&kernel, "lints"), "rust");
    assert_eq!(rust.get("unsafe_code").and_then(|value| value.get_ref().as_str()), Some("deny"));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/coupler-kernel/src");
    let allows = |path: &Path| std::fs::read_to_string(path).unwrap().contains("unsafe_code");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| allows(path));
    let names: Vec<_> = files.map(|path| path.file_name().unwrap().to_owned()).collect();
    assert_eq!(names, ["exports.rs"]);
}
