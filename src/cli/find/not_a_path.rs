//! What is wrong with a file that is given for a path, and what to give.

use std::io::ErrorKind;
use std::path::Path;

use crate::find::function::FORMULA_EXAMPLE;
use crate::output;

use super::{Failure, files};

/// Why the file of a path cannot be read, with the remedy.
pub(super) fn unreadable(path: &Path, error: output::Error) -> Failure {
    unreadable_as(path, error, "a table of points, JSON or a drawing in SVG or DXF")
}

/// Why the file of a function cannot be read, with the remedy.
pub(super) fn unreadable_function(path: &Path, error: output::Error) -> Failure {
    let forms = format!("a table with the columns input,output, or write the function as in \"{FORMULA_EXAMPLE}\"");
    unreadable_as(path, error, &forms)
}

fn unreadable_as(path: &Path, error: output::Error, forms: &str) -> Failure {
    let name = files::input_name(path);
    let kind = match &error {
        output::Error::Read { source, .. } => source.kind(),
        _ => ErrorKind::Other,
    };
    let message = match kind {
        ErrorKind::NotFound => format!("cannot find {name}: name {forms}"),
        ErrorKind::IsADirectory => format!("{name} is a folder: name {forms}"),
        _ => return error.into(),
    };
    Failure::input(message)
}

/// What to do with a manifest in place of a path; `None` if the text is no manifest.
pub(super) fn manifest_message(path: &Path, bytes: &[u8]) -> Option<String> {
    let is_manifest = files::extension(path).as_deref() == Some("toml")
        || bytes.split(|byte| *byte == b'\n').any(|line| line.trim_ascii() == b"[[family]]");
    let name = files::input_name(path);
    is_manifest.then(|| {
        format!(
            "{name} is a manifest, not a path: `coupler-atlas render {name}` draws it, and `coupler-atlas find PATH --atlas {name}` \
             looks a path up in its curves"
        )
    })
}
