//! The report as SARIF 2.1.0, which code scanning reads.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::check::Report;

use super::super::source::ManifestSource;
use super::super::{Failure, printable, report};
use super::place::{line_of, manifest_path};

/// The findings, each at the table of its family in the manifest.
pub fn text(report: &Report, source: &ManifestSource) -> Result<String, Failure> {
    let kinds: BTreeSet<&str> = report.findings.iter().map(|finding| finding.change.kind()).collect();
    let rules: Vec<Value> = kinds.iter().map(|kind| json!({ "id": kind, "name": kind })).collect();
    let uri = manifest_path(source);
    let result = |finding: &crate::check::Finding| {
        let location = printable(&finding.location);
        let kind = finding.change.kind();
        json!({
            "ruleId": kind,
            "level": if finding.change.is_difference() { "error" } else { "note" },
            "message": { "text": format!("{location}: {}", printable(&finding.change)) },
            "locations": [{
                "physicalLocation": {
                    "artifactLocation": { "uri": uri },
                    "region": { "startLine": line_of(source, &finding.location.family) },
                },
                "logicalLocations": [{ "fullyQualifiedName": location }],
            }],
            // The same finding of the next run is not a new one.
            "partialFingerprints": { "place/v1": format!("{kind} {location}") },
        })
    };
    let driver = json!({
        "name": env!("CARGO_PKG_NAME"),
        "version": env!("CARGO_PKG_VERSION"),
        "informationUri": env!("CARGO_PKG_REPOSITORY"),
        "rules": rules,
    });
    report::json_value(&json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{ "tool": { "driver": driver }, "results": report.findings.iter().map(result).collect::<Vec<_>>() }],
    }))
}
