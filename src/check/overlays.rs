//! Pages that show a recorded and a current curve, one over the other.

use std::collections::HashSet;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::family::FamilyCheck;
use super::left_out::LeftOut;
use super::{Change, Error, Finding, Options, Report};
use crate::manifest::Plan;
use crate::pipeline::FamilyPipeline;
use crate::record::{FolderRecord, RUN_FILE_NAME};
use coupler_curves::geometry::Point;
use coupler_curves::path::joint_polyline;
use coupler_drawing::page::{self, OverlayPage};
use coupler_drawing::render;

/// A page that shows a curve as recorded and as it is now.
#[derive(Clone, Debug)]
pub struct Overlay<'r> {
    /// The name of its file.
    pub name: String,
    /// Its SVG.
    pub svg: Vec<u8>,
    /// The finding on the curve.
    pub finding: &'r Finding,
}

/// Draws a page for each curve in a report that has moved or is sampled differently, at most `max_overlays` of the
/// worst; calls `receive` with each.
///
/// # Errors
/// The system fails to read a recorded file.
pub fn draw_overlays<'r>(
    plan: &Plan,
    recorded: &Path,
    options: &Options,
    report: &'r Report,
    max_overlays: usize,
    mut receive: impl FnMut(Overlay<'r>),
) -> Result<(), Error> {
    let is_on_curve = |finding: &&Finding| matches!(finding.change, Change::Moved(_) | Change::Samples { .. });
    let mut findings: Vec<&Finding> = report.findings.iter().filter(is_on_curve).collect();
    // A curve may have moved and be sampled differently: it is drawn once.
    let mut seen = HashSet::new();
    findings.retain(|finding| seen.insert(finding.location.to_string()));
    findings.truncate(max_overlays);
    let run = match FolderRecord::read(recorded) {
        Ok(record) => record.run,
        Err(source) if source.is_system_failure() => {
            return Err(Error::Record { path: recorded.join(RUN_FILE_NAME), source });
        }
        Err(_) => return Ok(()),
    };
    for planned in &plan.families {
        let family_findings: Vec<&Finding> =
            findings.iter().copied().filter(|f| f.location.family == planned.family.id).collect();
        let record = run.families.iter().find(|record| record.id == planned.family.id);
        let (Some(record), false) = (record, family_findings.is_empty()) else { continue };
        // A check is not interrupted.
        let Some(pipeline) = FamilyPipeline::new(plan, planned, &AtomicBool::new(false)) else { continue };
        let tolerances = options.tolerances.clone().or(planned.tolerances.clone()).or_defaults();
        let family_check =
            FamilyCheck::open(&pipeline, record, (recorded, LeftOut::default()), tolerances, &mut Vec::new())?;
        for finding in family_findings {
            if let Some(overlay) = draw_overlay(plan, &family_check, finding)? {
                receive(overlay);
            }
        }
    }
    Ok(())
}

/// Draws the page of a finding; `None` if the recorded or the current curve does not exist.
///
/// # Errors
/// The system fails to read the recorded curve.
fn draw_overlay<'r>(
    plan: &Plan,
    family_check: &FamilyCheck,
    finding: &'r Finding,
) -> Result<Option<Overlay<'r>>, Error> {
    let location = &finding.location;
    let (Some(cell), Some(trace), Some(circuit)) = (location.cell, location.trace, location.circuit) else {
        return Ok(None);
    };
    let Some((recorded_curves, solved)) = family_check.recorded_and_current(cell)? else { return Ok(None) };
    let recorded = recorded_curves.into_iter().find(|curve| curve.trace == trace && curve.circuit == circuit);
    let curve = solved.curves.iter().find(|curve| curve.trace == trace && curve.circuit == circuit);
    let (Some(recorded), Some(curve)) = (recorded, curve) else { return Ok(None) };
    let sampled = solved.circuit(curve);
    let current: Vec<Point> = sampled.points(curve.joint).collect();
    let worst_points = match &finding.change {
        Change::Moved(displacement) => vec![displacement.recorded.into(), displacement.current.into()],
        _ => Vec::new(),
    };
    // As fine as paper can show a curve that fills the page.
    let size = recorded.size().max(f64::MIN_POSITIVE);
    let path = joint_polyline(&solved.linkage, sampled, curve.joint, 5e-5 * size);
    let title = location.to_string();
    let sheet = OverlayPage {
        title: &title,
        details: vec![finding.change.to_string()],
        footer: &plan.title,
        recorded: recorded.points,
        current,
        current_path: path,
        is_closed: sampled.is_closed,
        worst_points,
    };
    let svg = render::svg(&page::compose_overlay(&sheet, &plan.page), plan.text_mode);
    Ok(Some(Overlay { name: format!("{}-{cell}-{trace}-{circuit}.svg", location.family), svg, finding }))
}
