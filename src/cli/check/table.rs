//! The report as a table.

use std::collections::HashMap;

use crate::check::{Change, Finding, Report};

use super::super::printable;
use super::left_out::not_compared;
use super::summary;
use coupler_curves::text::pluralize;

/// The findings shown one by one: with the other lines of the report they fill a screen.
const MAX_FINDINGS: usize = 20;

/// The greatest width of the column of locations, in characters: a recorded name may be longer than any line.
const MAX_LOCATION_WIDTH: usize = 80;

/// The worst findings one by one, the number of the others by kind, and what was checked.
pub fn text(report: &Report) -> String {
    let mut text = String::new();
    let lines = group_findings(&report.findings);
    let shown: Vec<&Finding> = lines.iter().take(MAX_FINDINGS).map(|(finding, _)| *finding).collect();
    let width = |length: fn(&Finding) -> usize| shown.iter().map(|finding| length(finding)).max().unwrap_or(0);
    let (kind_width, location_width) =
        (width(|f| f.change.kind().len()), width(|f| printable(&f.location).chars().count()).min(MAX_LOCATION_WIDTH));
    let mut counts = report.counts.clone();
    for (Finding { location, change }, grouped) in lines.iter().take(MAX_FINDINGS) {
        let more = match grouped {
            0 => String::new(),
            n => format!("; and {} of the same curve", pluralize(*n, "more measure")),
        };
        let (kind, location) = (change.kind(), printable(location));
        text.push_str(&format!("{kind:kind_width$}  {location:location_width$}  {}{more}\n", printable(change)));
        counts.entry(kind).and_modify(|count| *count -= 1 + grouped);
    }
    let omitted: usize = counts.values().sum();
    if omitted > 0 {
        let counted = counts.into_iter().filter(|(_, count)| *count > 0);
        let counted: Vec<String> = counted.map(|(kind, count)| format!("{count} {kind}")).collect();
        text.push_str(&format!("and {omitted} more: {}\n", counted.join(", ")));
    }
    text.push_str(&format!("{}\n", summary::total(report)));
    text.extend(not_compared(&report.left_out).map(|words| words + "\n"));
    text
}

/// The findings in order, with those on the measures of one curve grouped: the worst, and the number of the others.
fn group_findings(findings: &[Finding]) -> Vec<(&Finding, usize)> {
    let mut lines: Vec<(&Finding, usize)> = Vec::new();
    let mut measure_lines: HashMap<String, usize> = HashMap::new();
    for finding in findings {
        if let Change::Measure { .. } = finding.change {
            let line = *measure_lines.entry(finding.location.to_string()).or_insert(lines.len());
            if let Some((_, grouped)) = lines.get_mut(line) {
                *grouped += 1;
                continue;
            }
        }
        lines.push((finding, 0));
    }
    lines
}
