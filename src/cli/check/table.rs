use coupler_atlas::check::{Finding, Report};

use super::super::count;

/// So many findings are told one by one: with the lines round them they fill a screen.
const SHOWN: usize = 20;

/// The findings for people: the worst one by one, the rest counted.
pub fn text(report: &Report) -> String {
    let mut text = String::new();
    let shown = &report.findings[..report.findings.len().min(SHOWN)];
    let width = |of: fn(&Finding) -> usize| shown.iter().map(of).max().unwrap_or(0);
    let (kinds, places) = (width(|f| f.change.kind().len()), width(|f| f.place.to_string().chars().count()));
    for Finding { place, change } in shown {
        text.push_str(&format!("{:kinds$}  {:places$}  {change}\n", change.kind(), place.to_string()));
    }
    let left = report.total() - shown.len();
    if left > 0 {
        let mut counts = report.counts.clone();
        for finding in shown {
            counts.entry(finding.change.kind()).and_modify(|count| *count -= 1);
        }
        let counted = counts.into_iter().filter(|(_, count)| *count > 0);
        let counted: Vec<String> = counted.map(|(kind, count)| format!("{count} {kind}")).collect();
        text.push_str(&format!("and {left} more: {}\n", counted.join(", ")));
    }
    let families = if report.families == 1 { "1 family".to_owned() } else { format!("{} families", report.families) };
    let checked = format!("{families}, {}, {}", count(report.curves, "curve"), count(report.pages, "page"));
    let found = match report.total() {
        0 => "nothing has changed".to_owned(),
        n => count(n, "finding"),
    };
    text.push_str(&format!("{checked}: {found}\n"));
    text
}
