//! The report as JSON.

use crate::check::Report;
use serde::Serialize;

use super::super::{Failure, report};

/// The version of the format of the report.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    has_differences: bool,
    #[serde(flatten)]
    report: &'a Report,
}

/// The report as JSON, described in docs/check.md; infinite numbers are null.
pub fn text(report: &Report) -> Result<String, Failure> {
    report::json(FORMAT, &Document { has_differences: report.has_differences(), report })
}
