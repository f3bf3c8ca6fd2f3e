// The digest of everything the kernel is built from: the sources of its crate and of the workspace's crates that it
// depends on, the entries of Cargo.lock of all others, and the settings of the build. Used by the build script, and by the
// test that the module in the repository is not stale.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// The digest of the kernel's sources in a workspace, in hexadecimal digits.
pub fn digest(workspace: &Path) -> io::Result<String> {
    let locked = locked_packages(&fs::read_to_string(workspace.join("Cargo.lock"))?);
    let (mut members, mut others) = (BTreeSet::new(), BTreeSet::new());
    let mut open = vec!["coupler-kernel".to_owned()];
    while let Some(name) = open.pop() {
        let folder = workspace.join("crates").join(&name);
        if folder.is_dir() {
            if members.insert(name) {
                open.extend(required_dependencies(&fs::read_to_string(folder.join("Cargo.toml"))?));
            }
        } else if others.insert(name.clone()) {
            let entries = locked.get(&name).into_iter().flatten();
            // A dependency is a name, and the version where there are several.
            let names =
                entries.flat_map(|entry| quoted_words(entry.split_once("dependencies = [").map_or("", |e| e.1)));
            open.extend(names.map(|word| word.split(' ').next().unwrap_or_default().to_owned()));
        }
    }
    let mut digest = Sha256::new();
    let mut add = |name: &str, text: &str| {
        for part in [name, text] {
            digest.update((part.len() as u64).to_le_bytes());
            digest.update(part);
        }
    };
    for member in &members {
        let folder = workspace.join("crates").join(member);
        let mut files = vec![folder.join("Cargo.toml")];
        for part in ["src", "build", "build.rs"].map(|part| folder.join(part)) {
            collect_files(&part, &mut files)?;
        }
        files.sort();
        for file in files {
            let name = file.strip_prefix(workspace).unwrap_or(&file).to_string_lossy().replace('\\', "/");
            // The same on a checkout with other line ends.
            add(&name, &String::from_utf8_lossy(&fs::read(&file)?).replace("\r\n", "\n"));
        }
    }
    for entry in others.iter().filter_map(|name| locked.get(name)).flatten() {
        add("lock", entry);
    }
    let manifest = fs::read_to_string(workspace.join("Cargo.toml"))?;
    for line in section(&manifest, "workspace.dependencies") {
        let name = line.split([' ', '.', '=']).next().unwrap_or_default();
        if members.contains(name) || others.contains(name) {
            add("dependency", line);
        }
    }
    let headers = manifest.lines().filter_map(|line| line.strip_prefix('[')?.strip_suffix(']'));
    for name in headers.filter(|name| *name == "workspace.package" || name.starts_with("profile.kernel")) {
        add(name, &section(&manifest, name).collect::<Vec<_>>().join("\n"));
    }
    Ok(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The entries of a lock file by the names of their packages.
fn locked_packages(lock: &str) -> BTreeMap<String, Vec<String>> {
    let mut packages: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for entry in lock.replace("\r\n", "\n").split("[[package]]\n").skip(1) {
        if let Some(name) = quoted_words(entry).next() {
            packages.entry(name.to_owned()).or_default().push(entry.trim_end().to_owned());
        }
    }
    packages
}

/// The words in double quotes of a text.
fn quoted_words(text: &str) -> impl Iterator<Item = &str> {
    text.split('"').skip(1).step_by(2)
}

/// The lines of a section of a manifest that are neither empty nor comments.
fn section<'t>(manifest: &'t str, name: &str) -> impl Iterator<Item = &'t str> {
    let header = format!("[{name}]");
    let lines = manifest.lines().skip_while(move |line| *line != header).skip(1);
    lines.take_while(|line| !line.starts_with('[')).filter(|line| !line.is_empty() && !line.starts_with('#'))
}

/// The names of the dependencies of a manifest that are not optional: the kernel turns no features on.
fn required_dependencies(manifest: &str) -> Vec<String> {
    let names = ["dependencies", "build-dependencies"].map(|name| {
        section(manifest, name)
            .filter(|line| !line.contains("optional = true"))
            .filter_map(|line| line.split([' ', '.', '=']).next())
            .map(str::to_owned)
            .collect::<Vec<_>>()
    });
    names.concat()
}

/// Adds a file, or all files in a folder, if it exists.
fn collect_files(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if path.is_dir() {
        for entry in fs::read_dir(path)? {
            collect_files(&entry?.path(), files)?;
        }
    } else if path.is_file() {
        files.push(path.to_owned());
    }
    Ok(())
}
