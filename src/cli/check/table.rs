use std::collections::HashMap;

use coupler_atlas::check::{Change, Finding, Report};

use super::super::pluralize;

/// So many findings are told one by one: with the lines round them they fill a screen.
const MAX_FINDINGS: usize = 20;

/// The findings for people: the worst one by one, the rest counted.
pub fn text(report: &Report) -> String {
    let mut text = String::new();
    let lines = group_findings(&report.findings);
    let shown: Vec<&Finding> = lines.iter().take(MAX_FINDINGS).map(|(finding, _)| *finding).collect();
    let width = |of: fn(&Finding) -> usize| shown.iter().map(|finding| of(finding)).max().unwrap_or(0);
    let (kinds, places) = (width(|f| f.change.kind().len()), width(|f| f.location.to_string().chars().count()));
    let mut counts = report.counts.clone();
    for (Finding { location: place, change }, like) in lines.iter().take(MAX_FINDINGS) {
        let more = if *like > 0 { format!("; and {} of it", pluralize(*like, "more measure")) } else { String::new() };
        text.push_str(&format!("{:kinds$}  {:places$}  {change}{more}\n", change.kind(), place.to_string()));
        counts.entry(change.kind()).and_modify(|count| *count -= 1 + like);
    }
    let left: usize = counts.values().sum();
    if left > 0 {
        let counted = counts.into_iter().filter(|(_, count)| *count > 0);
        let counted: Vec<String> = counted.map(|(kind, count)| format!("{count} {kind}")).collect();
        text.push_str(&format!("and {left} more: {}\n", counted.join(", ")));
    }
    let families = if report.families == 1 { "1 family".to_owned() } else { format!("{} families", report.families) };
    let checked = format!("{families}, {}, {}", pluralize(report.curves, "curve"), pluralize(report.pages, "page"));
    let found = match report.total() {
        0 => "nothing has changed".to_owned(),
        n => pluralize(n, "finding"),
    };
    text.push_str(&format!("{checked}: {found}\n"));
    text
}

/// The findings in their order, those on the measures of one curve together: the worst, and how many more there are.
fn group_findings(findings: &[Finding]) -> Vec<(&Finding, usize)> {
    let mut lines: Vec<(&Finding, usize)> = Vec::new();
    let mut measured: HashMap<String, usize> = HashMap::new();
    for finding in findings {
        if let Change::Measure { .. } = finding.change {
            let line = *measured.entry(finding.location.to_string()).or_insert(lines.len());
            if let Some((_, like)) = lines.get_mut(line) {
                *like += 1;
                continue;
            }
        }
        lines.push((finding, 0));
    }
    lines
}
