//! Where exported files are written.

use std::path::{Path, PathBuf};

use crate::export::Format;
use crate::output;

use super::super::{Failure, files, print_bytes, printable};

/// Where the files are written.
pub(super) enum Destination {
    Stdout,
    File(PathBuf),
    Folder(PathBuf),
}

impl Destination {
    /// The destination of `count` files at a path; creates the folder if there are several.
    ///
    /// # Errors
    /// The path cannot be that of so many files, or the folder cannot be created.
    pub fn from_path(path: Option<&Path>, count: usize) -> Result<Destination, Failure> {
        let error = |message: String| Err(Failure::input(message));
        let Some(path) = path.filter(|path| !files::is_standard(path)) else {
            return match count {
                1 => Ok(Destination::Stdout),
                _ => error(format!("there are {count} files to write: name a folder for them with -o FOLDER")),
            };
        };
        let name = printable(path.display());
        // A file is written under a temporary name and renamed, which would replace a device or a pipe.
        if path.exists() && !path.is_file() && !path.is_dir() {
            return error(format!("{name} is neither a file nor a folder: name one with -o, or leave -o out"));
        }
        let is_folder = path.is_dir() || path.as_os_str().to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR]);
        if count == 1 && !is_folder {
            return Ok(Destination::File(path.to_owned()));
        }
        if path.is_file() {
            return error(format!("{name} is a file, and there are {count} to write: name a folder with -o"));
        }
        if !is_folder && is_file_name(path) {
            return error(format!(
                "{name} is the name of one file, and there are {count} to write: name a folder with -o, as in -o curves, \
                 or a single curve"
            ));
        }
        output::create_folder(path)?;
        Ok(Destination::Folder(path.to_owned()))
    }

    /// Writes a file; `name` is that in a folder.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_file(&mut self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        match self {
            Destination::Stdout => Ok(print_bytes(bytes)?),
            Destination::File(path) => files::write(path, bytes),
            Destination::Folder(folder) => files::write(&folder.join(name), bytes),
        }
    }
}

/// Whether a path has the extension of a format, each of which is the format's name.
fn is_file_name(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    extension.is_some_and(|extension| Format::ALL.iter().any(|format| format.name() == extension))
}
