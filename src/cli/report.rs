//! Reports for programs: how they are requested on the command line, and as JSON.

use std::path::PathBuf;

use serde::Serialize;

use super::printable::is_unprintable;
use super::{Failure, choice, files};

/// A report requested as `FORMAT` or `FORMAT=FILE`.
#[derive(Clone, Debug)]
pub(super) struct ReportRequest<F> {
    pub format: F,
    /// The file to write; `None` for the report to be printed.
    pub file: Option<PathBuf>,
}

/// Parses a request for one of the known formats.
pub(super) fn parse_request<F: Copy>(text: &str, known: &[(&str, F)]) -> Result<ReportRequest<F>, String> {
    let (name, file) = text.split_once('=').map_or((text, None), |(name, file)| (name, Some(file)));
    let format = choice::parse("report", name, known)?;
    match file {
        Some("") => Err(format!("expected a file after `=`, as in {name}=report.{name}")),
        file => Ok(ReportRequest { format, file: file.map(PathBuf::from).filter(|file| !files::is_standard(file)) }),
    }
}

/// A report and what made it.
#[derive(Serialize)]
struct Document<'a, R> {
    format: u32,
    program: &'static str,
    version: &'static str,
    #[serde(flatten)]
    report: &'a R,
}

/// A report in a version of its format as indented JSON; infinite numbers are null.
pub(super) fn json(format: u32, report: &impl Serialize) -> Result<String, Failure> {
    let (program, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    json_value(&Document { format, program, version, report })
}

/// A value as indented JSON; infinite numbers are null.
pub(super) fn json_value(value: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value)? + "\n";
    // What a terminal or the log of a CI run would obey is only in strings, where it can be escaped; the encoder escapes
    // most control characters itself.
    let text = text.replace("##[", "\\u0023#[");
    let is_raw = |c: char| c != '\n' && is_unprintable(c);
    Ok(text.chars().map(|c| if is_raw(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() }).collect())
}
