//! The report as annotations of a GitHub workflow.

use crate::check::Report;

use super::super::printable;
use super::super::source::ManifestSource;
use super::left_out::not_compared;
use super::place::{line_of, manifest_path};

/// GitHub shows at most this many annotations of one step.
const MAX_ANNOTATIONS: usize = 10;

/// The worst findings as annotations, each at the table of its family in the manifest.
pub fn text(report: &Report, source: &ManifestSource) -> String {
    let file = manifest_path(source);
    let mut text = String::new();
    for finding in report.findings.iter().take(MAX_ANNOTATIONS) {
        let level = if finding.change.is_difference() { "error" } else { "notice" };
        let (line, title) = (
            line_of(source, &finding.location.family),
            format!("{}: {}", finding.change.kind(), printable(&finding.location)),
        );
        let (file, title) = (escape_property(&file), escape_property(&title));
        text.push_str(&format!(
            "::{level} file={file},line={line},title={title}::{}\n",
            escape_data(&printable(&finding.change))
        ));
    }
    let omitted = report.total().saturating_sub(MAX_ANNOTATIONS);
    if omitted > 0 {
        text.push_str(&format!(
            "::error file={},line=1,title=and {omitted} more::see the report\n",
            escape_property(&file)
        ));
    }
    if let Some(words) = not_compared(&report.left_out) {
        text.push_str(&format!(
            "::notice file={},line=1,title=check::{}\n",
            escape_property(&file),
            escape_data(&words)
        ));
    }
    text
}

/// Escapes the message of an annotation.
fn escape_data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Escapes a property of an annotation.
fn escape_property(text: &str) -> String {
    escape_data(text).replace(':', "%3A").replace(',', "%2C")
}
