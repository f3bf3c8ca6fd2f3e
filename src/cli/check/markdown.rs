//! The report as Markdown, as for the summary of a job.

use crate::check::Report;

use super::super::printable;
use super::left_out::not_compared;
use super::summary::{self, FamilySummary};

/// At most this many findings are listed one by one.
const MAX_FINDINGS: usize = 50;

/// A table of the families with findings, and one of the worst findings.
pub fn text(report: &Report) -> String {
    let mut text = format!("## coupler-atlas check\n\n{}\n", escape(&summary::total(report)));
    let summaries = summary::of_report(report);
    if !summaries.is_empty() {
        text.push_str("\n| family | curves moved | furthest | other changes |\n|---|--:|---|---|\n");
        for FamilySummary { name, moved, furthest, others } in &summaries {
            text.push_str(&format!("| {} | {moved} | {} | {} |\n", escape(name), escape(furthest), escape(others)));
        }
        text.push_str("\n| kind | where | what |\n|---|---|---|\n");
        for finding in report.findings.iter().take(MAX_FINDINGS) {
            let (location, change) = (finding.location.to_string(), finding.change.to_string());
            text.push_str(&format!("| {} | {} | {} |\n", finding.change.kind(), escape(&location), escape(&change)));
        }
        let omitted = report.total().saturating_sub(MAX_FINDINGS);
        if omitted > 0 {
            text.push_str(&format!("\nand {omitted} more\n"));
        }
    }
    text.extend(not_compared(&report.left_out).map(|words| format!("\n{words}\n")));
    text
}

/// A text as Markdown and HTML show it, in one cell of a table.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in printable(text).chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '|' | '\\' | '`' | '*' | '_' | '[' | ']' | '#' | '~' | '@' | '!' => {
                out.push('\\');
                out.push(c);
            }
            c => out.push(c),
        }
    }
    out
}
