//! The JSON of linkages that guide a body.

use crate::find::{PoseFindingsRecord, PoseRecord};
use serde::Serialize;

use super::super::super::{Failure, report};
use super::super::json::FORMAT;
use super::report::{PoseReport, options_of};

#[derive(Serialize)]
struct Document {
    target: Target,
    #[serde(flatten)]
    found: PoseFindingsRecord,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest_miss: Option<NearestMiss>,
}

#[derive(Serialize)]
struct Target {
    #[serde(skip_serializing_if = "str::is_empty")]
    read: String,
    points: Vec<[f64; 2]>,
    angles_deg: Vec<f64>,
    kind: &'static str,
    size: f64,
}

#[derive(Serialize)]
struct NearestMiss {
    relax: Vec<&'static str>,
    result: PoseRecord,
}

/// The poses and the linkages, as indented JSON.
pub(super) fn json(report: &PoseReport) -> Result<String, Failure> {
    let PoseReport { reading, poses, found, .. } = report;
    let nearest_miss = found.relaxed.as_ref().and_then(|relaxed| {
        let result = PoseRecord::new(1, relaxed.findings.answers.first()?, poses);
        Some(NearestMiss { relax: options_of(relaxed), result })
    });
    let target = Target {
        read: reading.clone(),
        points: poses.poses().iter().map(|pose| [pose.point.x, pose.point.y]).collect(),
        angles_deg: poses.poses().iter().map(|pose| pose.angle_deg).collect(),
        kind: "poses",
        size: poses.size(),
    };
    report::json(FORMAT, &Document { target, found: PoseFindingsRecord::new(&found.findings, poses), nearest_miss })
}
