//! Files and folders named on the command line; `-` is standard input or output.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use crate::output;
use crate::record::RunRecord;
use clap::builder::{PathBufValueParser, TypedValueParser};

use super::{InputError, print_bytes, printable};

/// Whether a path is standard input, where a file is read, or standard output, where one is written.
pub(super) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == RunRecord::STANDARD_INPUT
}

/// The name of a file to read, in messages.
pub(super) fn input_name(path: &Path) -> String {
    if is_standard(path) { "standard input".to_owned() } else { printable(path.display()) }
}

/// The name of a file to write, in messages.
pub(super) fn output_name(path: &Path) -> String {
    if is_standard(path) { "the manifest".to_owned() } else { printable(path.display()) }
}

/// The manifests that this run has read, which it must not overwrite.
static MANIFESTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Keeps a manifest from being overwritten by this run.
pub(super) fn protect(manifest: &Path) {
    if let (Ok(path), Ok(mut manifests)) = (manifest.canonicalize(), MANIFESTS.lock()) {
        manifests.push(path);
    }
}

/// Writes a file, or to standard output.
///
/// # Errors
/// The file is a manifest that was read, or a folder, or cannot be written.
pub(super) fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    if is_standard(path) {
        return print_bytes(bytes);
    }
    let is_manifest = |path: &PathBuf| MANIFESTS.lock().is_ok_and(|manifests| manifests.contains(path));
    if path.canonicalize().is_ok_and(|path| is_manifest(&path)) {
        let message = format!("{} is the manifest, which would be lost: name another file", path.display());
        return Err(InputError(message).into());
    }
    if path.is_dir() {
        return Err(InputError(format!("{} is a folder: name a file", path.display())).into());
    }
    Ok(output::write_file(path, bytes)?)
}

/// Whether a drawing is written to standard output, where it takes the place of the text.
///
/// # Errors
/// Something else is to be printed; `printed` are the options that print something, and whether they are given.
pub(super) fn is_drawing_printed(drawing: Option<&Path>, printed: &[(&str, bool)]) -> Result<bool, InputError> {
    if !drawing.is_some_and(is_standard) {
        return Ok(false);
    }
    match printed.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => {
            let message =
                format!("--svg - and {option} both write to standard output: name a file, as in --svg plate.svg");
            Err(InputError(message))
        }
        None => Ok(true),
    }
}

/// Parses the path of a folder; `-` would be the name of one, but means standard output everywhere else.
pub(super) fn folder_parser() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match is_standard(&path) {
        true => Err("a folder is needed, and `-` is standard output: name one, or write ./- for one of this name"),
        false => Ok(path),
    })
}
