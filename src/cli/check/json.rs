//! The report as JSON.

use coupler_atlas::check::Report;
use serde::Serialize;

use super::super::printable::is_unprintable;

/// The version of the format of the report.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    program: &'static str,
    version: &'static str,
    has_differences: bool,
    #[serde(flatten)]
    report: &'a Report,
}

/// The report as JSON, described in docs/check.md; infinite numbers are null.
pub fn text(report: &Report) -> anyhow::Result<String> {
    let document = Document {
        format: FORMAT,
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        has_differences: report.has_differences(),
        report,
    };
    let text = serde_json::to_string_pretty(&document)? + "\n";
    // What a terminal or the log of a CI run would obey is only in strings, where it can be escaped; the encoder escapes
    // most control characters itself.
    let text = text.replace("##[", "\\u0023#[");
    let is_raw = |c: char| c != '\n' && is_unprintable(c);
    Ok(text.chars().map(|c| if is_raw(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() }).collect())
}
