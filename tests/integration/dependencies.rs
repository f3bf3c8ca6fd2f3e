//! docs/dependencies.md and deny.toml agree with the manifests, the lock file and the licences of the crates.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

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

/// The crates that are built on this machine for what plain `cargo test` tests or, with further options, for more, each with its licence.
fn licences(more: &[&str]) -> BTreeMap<String, String> {
    // Unlike its metadata, cargo's tree needs no crates of other platforms and members, which may not have been fetched.
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--edges", "all", "--prefix", "none", "--no-dedupe", "--format", "{p}|{l}"])
        .args(more)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let tree = String::from_utf8(tree.stdout).unwrap();
    let crates = tree.lines().filter_map(|line| line.split_once('|'));
    crates.map(|(package, licence)| (package.split(' ').next().unwrap().to_owned(), licence.to_owned())).collect()
}

/// The licences of what has been fetched for `cargo test`, which fetches nothing itself.
fn fetched_licences() -> BTreeMap<String, String> {
    licences(&["--offline"])
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
    let licences = fetched_licences();
    let mut count = 0;
    for (name, cells) in documented {
        let [purpose, features, licence] = cells[..] else { panic!("{name}: {cells:?}") };
        assert!(purpose.len() > 10, "no purpose is documented for {name}");
        assert_eq!(features, direct[name], "the features of {name}");
        // Those of the other members' crates are another test's.
        if let Some(own) = licences.get(name) {
            assert_eq!(licence, own, "the licence of {name}");
            count += 1;
        }
    }
    assert!(count > 30, "only {count} licences were compared");
}

/// What deny.toml allows.
struct Policy {
    licences: BTreeSet<String>,
    /// Further licences of single crates.
    exceptions: Vec<(String, Vec<String>)>,
}

impl Policy {
    fn read() -> Policy {
        let deny = parsed(include_str!("../../deny.toml"));
        let licenses = table(&deny, "licenses");
        let owned = |texts: Vec<&str>| texts.into_iter().map(str::to_owned).collect::<Vec<_>>();
        let exceptions = licenses.get("exceptions").and_then(|value| value.get_ref().as_array()).unwrap();
        let exception = |one: &DeTable<'static>| {
            let name = one.get("crate").and_then(|value| value.get_ref().as_str()).unwrap();
            (name.to_owned(), owned(texts(one, "allow")))
        };
        Policy {
            licences: owned(texts(licenses, "allow")).into_iter().collect(),
            exceptions: exceptions.iter().filter_map(|one| one.get_ref().as_table()).map(exception).collect(),
        }
    }

    /// Whether some choice among the alternatives of a crate's licence expression has allowed licences only.
    fn allows(&self, name: &str, licence: &str) -> bool {
        let licence = licence.replace('/', " OR ");
        let is_exception = |one: &str| {
            self.exceptions.iter().any(|(other, allowed)| other == name && allowed.iter().any(|other| other == one))
        };
        let is_allowed = |one: &str| self.licences.contains(one) || is_exception(one);
        let is_one = |part: &str| part.trim_matches(['(', ')']).split(" OR ").any(is_allowed);
        !licence.is_empty() && licence.split(" AND ").all(is_one)
    }

    fn check(&self, licences: &BTreeMap<String, String>) {
        assert!(licences.len() > 100);
        for (name, licence) in licences {
            assert!(self.allows(name, licence), "{name} is under {licence}");
        }
    }
}

#[test]
fn every_licence_is_one_of_those_allowed() {
    let policy = Policy::read();
    policy.check(&fetched_licences());
    for licence in ["GPL-3.0", "MIT AND GPL-3.0", "AGPL-3.0-only", "", "MPL-2.0"] {
        assert!(!policy.allows("other", licence), "{licence}");
    }
}

/// Also those of the crates that only the Python package and the tests of the gallery's module need; fetches them.
#[test]
#[ignore = "thorough"]
fn the_licences_of_all_members_are_documented_and_allowed() {
    let (policy, licences) = (Policy::read(), licences(&["--workspace", "--all-features"]));
    policy.check(&licences);
    for (name, cells) in documented() {
        assert_eq!(cells[2], licences[name], "the licence of {name}");
    }
    for licence in &policy.licences {
        let is_needed = |other: &String| other.split([' ', '/', '(', ')']).any(|word| word == licence);
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
    let find = parsed(include_str!("../../crates/coupler-find/Cargo.toml"));
    let drawing = parsed(include_str!("../../crates/coupler-drawing/Cargo.toml"));
    let manifest = parsed(include_str!("../../crates/coupler-manifest/Cargo.toml"));
    let paths = parsed(include_str!("../../crates/coupler-paths/Cargo.toml"));
    for member in [&cargo, &curves, &find, &drawing, &manifest, &paths] {
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
