//! Files and folders named on the command line; `-` is standard input or output.

use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

use crate::manifest_files::NamedFile;
use crate::output;
use crate::record::RunRecord;
use clap::builder::{PathBufValueParser, TypedValueParser};

use super::{Failure, print_bytes, printable};

/// The manifest that a command reads when none is given.
pub const DEFAULT_MANIFEST: &str = "atlas.toml";

/// Whether a path is standard input, where a file is read, or standard output, where one is written.
pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == RunRecord::STANDARD_INPUT
}

/// A path as it is shown: without the folders that a following `..` leaves, if it is the same path without them.
pub(super) fn without_parents(path: &Path) -> PathBuf {
    let mut shorter = PathBuf::new();
    for component in path.components() {
        match (component, shorter.components().next_back()) {
            (Component::ParentDir, Some(Component::Normal(_))) => drop(shorter.pop()),
            _ => shorter.push(component),
        }
    }
    let is_same = || Some(path.canonicalize().ok()? == shorter.canonicalize().ok()?);
    if is_same() == Some(true) { shorter } else { path.to_owned() }
}

/// The name of a file to read, in messages.
pub(super) fn input_name(path: &Path) -> String {
    if is_standard(path) { "standard input".to_owned() } else { printable(path.display()) }
}

/// Why standard input cannot be read.
pub(super) fn standard_input_error(error: &io::Error) -> Failure {
    let message = format!("cannot read standard input: {error}");
    match output::is_wrong_input(error) {
        true => Failure::input(message),
        false => Failure::system(message),
    }
}

/// The extension of a path, in small letters.
pub(super) fn extension(path: &Path) -> Option<String> {
    path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase())
}

/// The name of a file to write, in messages.
pub(super) fn output_name(path: &Path) -> String {
    if is_standard(path) { "the manifest".to_owned() } else { printable(path.display()) }
}

/// The manifests and their files that this run has read, which it must not overwrite, and what each is.
static PROTECTED: Mutex<Vec<(PathBuf, &str)>> = Mutex::new(Vec::new());

/// Keeps a file from being overwritten by this run, and says what it is.
pub(super) fn protect(path: &Path, what: &'static str) {
    if let (Ok(path), Ok(mut files)) = (path.canonicalize(), PROTECTED.lock()) {
        files.push((path, what));
    }
}

/// The files that the last manifest names, as they were before they were read.
static NAMED: Mutex<Vec<NamedFile>> = Mutex::new(Vec::new());

/// Keeps the files that a manifest names from being overwritten by this run, and for [`take_named`].
pub(super) fn set_named(files: Vec<NamedFile>) {
    files.iter().for_each(|file| protect(&file.path, "a file of the manifest"));
    if let Ok(mut named) = NAMED.lock() {
        *named = files;
    }
}

/// The files that the manifest which was read last names; none if none has been read since the last call.
pub(super) fn take_named() -> Vec<NamedFile> {
    NAMED.lock().map(|mut named| std::mem::take(&mut *named)).unwrap_or_default()
}

/// Checks that [`write`] can write a file: makes its folder, and writes another file there, which is removed.
///
/// # Errors
/// As of [`write`].
pub(super) fn require_writable(path: &Path) -> Result<(), Failure> {
    if is_standard(path) {
        return Ok(());
    }
    require_unprotected(path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    output::create_folder(folder)?;
    let error = |error| Failure::system(format!("{} cannot be written: {error}", printable(path.display())));
    tempfile::NamedTempFile::new_in(folder).map(drop).map_err(error)
}

/// Writes a file, or to standard output.
///
/// # Errors
/// The file is a manifest that was read, or a folder, or cannot be written.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_standard(path) {
        return Ok(print_bytes(bytes)?);
    }
    require_unprotected(path)?;
    Ok(output::write_file(path, bytes)?)
}

/// Checks that a file is not one that was read, nor a folder.
fn require_unprotected(path: &Path) -> Result<(), Failure> {
    let canonical = path.canonicalize().ok();
    let protected = PROTECTED
        .lock()
        .ok()
        .and_then(|files| files.iter().find(|(own, _)| Some(own) == canonical.as_ref()).map(|(_, what)| *what));
    if let Some(what) = protected {
        let message = format!("{} is {what}, which would be lost: name another file", path.display());
        return Err(Failure::input(message));
    }
    if path.is_dir() {
        return Err(Failure::input(format!("{} is a folder: name a file", path.display())));
    }
    Ok(())
}

/// Whether a drawing is written to standard output, where it takes the place of the text.
///
/// # Errors
/// Something else is to be printed; `printed` are the options that print something, and whether they are given.
pub(super) fn is_drawing_printed(drawing: Option<&Path>, printed: &[(&str, bool)]) -> Result<bool, Failure> {
    if !drawing.is_some_and(is_standard) {
        return Ok(false);
    }
    match printed.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => {
            let message =
                format!("--svg - and {option} both write to standard output: name a file, as in --svg plate.svg");
            Err(Failure::input(message))
        }
        None => Ok(true),
    }
}

/// Parses the path of a drawing in SVG; that of another kind of file says what makes it.
pub(super) fn svg_parser() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        let Some(extension) = extension(&path) else { return Ok(path) };
        let kind = extension.to_ascii_uppercase();
        let remedy = match extension.as_str() {
            "png" => format!(
                "; `coupler-atlas export … --format png` draws curves as {kind}, and `coupler-atlas render MANIFEST --format png` pages"
            ),
            "pdf" => format!("; `coupler-atlas render MANIFEST --format pdf` makes a {kind}"),
            "dxf" | "csv" | "json" => {
                format!("; `coupler-atlas export … --format {extension}` writes curves as {kind}")
            }
            "jpg" | "jpeg" | "gif" | "webp" | "svgz" | "eps" | "ps" | "html" | "htm" | "txt" | "dwg" | "step" => String::new(),
            _ => return Ok(path),
        };
        Err(format!("the drawing is SVG, not {kind}: name a file that ends in .svg{remedy}"))
    })
}

/// Parses the path of a folder; `-` would be the name of one, but means standard output everywhere else.
pub(super) fn folder_parser() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match is_standard(&path) {
        true => Err("a folder is needed, and `-` is standard output: name one, or write ./- for one of this name"),
        false => Ok(path),
    })
}
