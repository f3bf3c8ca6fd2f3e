//! Pages that show how curves have moved.

use std::collections::HashSet;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::family::FamilyCheck;
use super::{Change, Finding, Options, Report};
use crate::manifest::Plan;
use crate::pipeline::FamilyPipeline;
use crate::record::RunRecord;
use coupler_curves::geometry::Point;
use coupler_curves::motion::{self, DashPattern};
use coupler_drawing::page::{self, OverlayPage};
use coupler_drawing::render;

/// A page that shows how a curve has moved.
#[derive(Clone, Debug)]
pub struct Overlay<'r> {
    /// The name of its file.
    pub name: String,
    /// Its SVG.
    pub svg: Vec<u8>,
    /// What has been found of the curve.
    pub finding: &'r Finding,
}

/// Draws a page for each curve that has moved, or is sampled otherwise, in a report on an atlas: of the worst, so many.
pub fn draw_overlays<'r>(
    plan: &Plan,
    recorded: &Path,
    (options, report): (&Options, &'r Report),
    most: usize,
    mut take: impl FnMut(Overlay<'r>),
) {
    let is_of_a_curve = |finding: &&Finding| matches!(finding.change, Change::Moved(_) | Change::Samples { .. });
    let mut wanted: Vec<&Finding> = report.findings.iter().filter(is_of_a_curve).collect();
    // A curve that is sampled otherwise and has moved is one.
    let mut seen = HashSet::new();
    wanted.retain(|finding| seen.insert(finding.location.to_string()));
    wanted.truncate(most);
    let Ok(run) = RunRecord::read(&recorded.join("run.json")) else { return };
    for planned in &plan.families {
        let ours: Vec<&Finding> = wanted.iter().copied().filter(|f| f.location.family == planned.family.id).collect();
        let record = run.families.iter().find(|record| record.id == planned.family.id);
        let (Some(record), false) = (record, ours.is_empty()) else { continue };
        // Nobody stops this.
        let Some(press) = FamilyPipeline::new(plan, planned, &AtomicBool::new(false)) else { continue };
        let tolerances = options.tolerances.or(planned.tolerances).or_defaults();
        let checked = FamilyCheck::open(&press, record, recorded, tolerances, &mut Vec::new());
        for finding in ours {
            if let Some(overlay) = draw_overlay(plan, &checked, finding) {
                take(overlay);
            }
        }
    }
}

fn draw_overlay<'r>(plan: &Plan, checked: &FamilyCheck, finding: &'r Finding) -> Option<Overlay<'r>> {
    let place = &finding.location;
    let (cell, trace, circuit) = (place.cell?, place.trace?, place.circuit?);
    let (tracks, solved) = checked.recorded_and_current(cell)?;
    let was = tracks.into_iter().find(|track| track.trace == trace && track.circuit == circuit)?;
    let curve = solved.curves.iter().find(|curve| curve.trace == trace && curve.circuit == circuit)?;
    let sampled = solved.circuit(curve);
    let is: Vec<Point> = sampled.points(curve.joint).collect();
    let worst = match &finding.change {
        Change::Moved(by) => vec![by.recorded.into(), by.current.into()],
        _ => Vec::new(),
    };
    // As fine as the paper shows it, as if the curve filled it.
    let size = was.size().max(f64::MIN_POSITIVE);
    let dashes = DashPattern { period: 360.0, dash_span: 360.0 };
    let path = motion::joint_paths(&solved.linkage, sampled, &[curve.joint], dashes, 5e-5 * size).pop()?.points;
    let title = place.to_string();
    let sheet = OverlayPage {
        title: &title,
        details: vec![finding.change.to_string()],
        footer: &plan.title,
        recorded: was.points,
        current: is,
        current_path: path,
        is_closed: sampled.is_closed,
        worst_points: worst,
    };
    let svg = render::svg(&page::compose_overlay(&sheet, &plan.page), plan.text_mode);
    Some(Overlay { name: format!("{}-{cell}-{trace}-{circuit}.svg", place.family), svg, finding })
}
