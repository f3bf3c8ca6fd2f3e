//! What has changed, family by family, for one who decides whether that is intended.

use std::collections::BTreeSet;

use crate::check::{Change, Displacement, Finding, Report};

use super::super::printable;
use coupler_curves::text::pluralize;

/// What has changed in a family, or in the atlas as a whole.
pub struct FamilySummary {
    /// The id of the family; "atlas" for the atlas as a whole.
    pub name: String,
    /// The curves that have moved or have other samples.
    pub moved: usize,
    /// The furthest that one has moved: "cell 3, trace 1, circuit 1: 1.000e-8, 2.0e-9 of its size".
    pub furthest: String,
    /// The other changes, by their kinds: "3 measure, 1 drawing".
    pub others: String,
}

/// The summaries of the families with findings, those that have moved furthest first.
pub fn of_report(report: &Report) -> Vec<FamilySummary> {
    let mut families: Vec<&str> = Vec::new();
    for Finding { location, .. } in &report.findings {
        if !families.contains(&location.family.as_str()) {
            families.push(&location.family);
        }
    }
    // Findings are sorted, the worst first.
    let summary = |family: &&str| {
        let findings: Vec<&Finding> =
            report.findings.iter().filter(|finding| finding.location.family == **family).collect();
        let is_move = |finding: &&&Finding| matches!(finding.change, Change::Moved(_) | Change::Samples { .. });
        let moved: BTreeSet<_> = findings
            .iter()
            .filter(is_move)
            .map(|Finding { location, .. }| (location.cell, location.trace, location.circuit))
            .collect();
        let mut kinds: Vec<(&str, usize)> = Vec::new();
        for kind in findings.iter().filter(|finding| !is_move(finding)).map(|finding| finding.change.kind()) {
            match kinds.iter_mut().find(|(other, _)| *other == kind) {
                Some((_, count)) => *count += 1,
                None => kinds.push((kind, 1)),
            }
        }
        let others: Vec<String> = kinds.into_iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        FamilySummary {
            name: if family.is_empty() { "atlas".to_owned() } else { (*family).to_owned() },
            moved: moved.len(),
            furthest: furthest(&findings).unwrap_or_default(),
            others: others.join(", "),
        }
    };
    families.iter().map(summary).collect()
}

/// Where a curve has moved furthest for its size, and how far.
fn furthest(findings: &[&Finding]) -> Option<String> {
    let moves = findings.iter().filter_map(|finding| match &finding.change {
        Change::Moved(displacement) => Some((&finding.location, displacement)),
        _ => None,
    });
    let (location, Displacement { distance, relative, .. }) =
        moves.max_by(|(_, a), (_, b)| a.relative.total_cmp(&b.relative))?;
    let numbers = [("cell", location.cell), ("trace", location.trace), ("circuit", location.circuit)];
    let place: Vec<String> =
        numbers.iter().filter_map(|(name, number)| Some(format!("{name} {}", (*number)?))).collect();
    Some(format!("{}: {distance:.3e}, {relative:.1e} of its size", place.join(", ")))
}

/// How many things were compared, and what was found: "38 families, 439 curves, 43 pages: 2 findings".
pub fn total(report: &Report) -> String {
    let compared = [(report.families, "family"), (report.curves, "curve"), (report.pages, "page")];
    let checked = compared.map(|(count, noun)| pluralize(count, noun)).join(", ");
    let result = match report.total() {
        0 => "nothing has changed".to_owned(),
        n => pluralize(n, "finding"),
    };
    format!("{checked}: {result}")
}

/// The summaries as lines of text.
pub fn text(report: &Report) -> String {
    let summaries = of_report(report);
    // A recorded name may have what a terminal obeys.
    let width = summaries.iter().map(|own| printable(&own.name).chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for FamilySummary { name, moved, furthest, others } in &summaries {
        let moved = (*moved > 0).then(|| match furthest.is_empty() {
            true => format!("{} sampled otherwise", pluralize(*moved, "curve")),
            false => format!("{} moved, at most {furthest}", pluralize(*moved, "curve")),
        });
        let parts: Vec<String> = moved.into_iter().chain((!others.is_empty()).then(|| others.clone())).collect();
        text.push_str(&format!("{:width$}  {}\n", printable(name), parts.join("; ")));
    }
    text + &total(report) + "\n"
}
