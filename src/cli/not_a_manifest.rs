//! What is wrong with a path that is given for a manifest, and what to give.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::import;
use crate::record;

use super::files;
use super::files::DEFAULT_MANIFEST;

/// The extensions of files with paths for `find`.
const OF_PATHS: [&str; 4] = ["svg", "csv", "tsv", "json"];

/// Why a manifest cannot be read, with the remedy; `None` for other errors than those of a wrong name.
pub(super) fn reason(path: &Path, kind: ErrorKind) -> Option<String> {
    let shown = path.display();
    match kind {
        ErrorKind::NotFound => Some(format!("cannot find {shown}: {}", in_place_of(path))),
        ErrorKind::IsADirectory => Some(match manifest_of(path) {
            Some(manifest) => format!("{shown} is a folder: name its manifest, {}", manifest.display()),
            None => format!("{shown} is a folder: name a manifest, a file whose name ends in .toml"),
        }),
        ErrorKind::InvalidData => {
            Some(format!("{shown} is not a text: name a manifest, a file whose name ends in .toml"))
        }
        _ => None,
    }
}

/// What to give in place of a file that does not exist.
fn in_place_of(path: &Path) -> String {
    let with_extension = with_toml(path);
    match files::extension(path).as_deref() {
        Some("toml") => format!("`coupler-atlas init {}` writes a manifest to start from", path.display()),
        _ if with_extension.is_file() => format!("did you mean {}?", with_extension.display()),
        None => format!("`coupler-atlas init {}` writes a manifest to start from", with_extension.display()),
        Some(_) => "name a manifest, a file whose name ends in .toml".to_owned(),
    }
}

/// The manifest in a folder, or that of a rendered one, which is beside it or named after it; `None` if there is none.
fn manifest_of(folder: &Path) -> Option<PathBuf> {
    let beside = record::manifest_of(folder).ok().map(|(path, _)| path);
    let candidates = [Some(folder.join(DEFAULT_MANIFEST)), beside, folder.file_name().map(|_| with_toml(folder))];
    candidates.into_iter().flatten().find(|path| path.is_file())
}

fn with_toml(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".toml");
    PathBuf::from(name)
}

/// Why a text is no manifest but a linkage for `import` or a path for `find`, with the remedy; `None` if it may be one.
pub(super) fn form(path: &Path, text: &str) -> Option<String> {
    if import::is_linkage(text) {
        let (name, given) = (files::input_name(path), path.display());
        let remedy = format!("`coupler-atlas import {given}` prints a manifest with it");
        return Some(format!("{name} is a linkage of another program, not a manifest: {remedy}"));
    }
    let is_named_so = files::extension(path).is_some_and(|extension| OF_PATHS.contains(&extension.as_str()));
    let is_drawing = text.trim_start().starts_with('<');
    if !is_named_so && !is_drawing {
        return None;
    }
    let what = if is_drawing { "a drawing" } else { "a file of points" };
    let (name, given) = (files::input_name(path), path.display());
    Some(format!("{name} is {what}, not a manifest: `coupler-atlas find {given}` finds linkages that trace a path"))
}
