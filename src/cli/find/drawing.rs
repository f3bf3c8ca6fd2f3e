//! A drawing of the path and the curves that have been found for it.

use crate::find::PlacedCurve;
use coupler_curves::find::{Answer, Placement, Target, format_length as number, format_relative as relative};
use coupler_curves::solve::SolvedCell;
use coupler_drawing::page::{self, AnswersPage, FoundCurve, Options, Paper};
use coupler_drawing::render::{self, TextMode};

use super::super::format::pluralize;
use super::Report;
use super::text::dimensions;

/// The most curves of a drawing: more of them hide each other.
const MAX_CURVES: usize = 5;

/// A landscape page of A4 with the path, the best curves, and the linkage of the best, as SVG.
pub(super) fn page(report: &Report) -> Vec<u8> {
    let Report { target, answers, .. } = report;
    let size = target.size();
    let first = answers.first().map(|answer| {
        let [crank, rocker] = answer.mechanism.four_bar.pivots.map(|p| {
            let [x, y] = [p.x, p.y].map(|value| number(value, size));
            format!("({x}, {y})")
        });
        format!("the linkage of curve 1, with its crank's pivot at {crank} and its rocker's at {rocker}, is at the first point of the path")
    });
    let found = (1..).zip(answers).filter_map(|(rank, answer)| found(rank, answer, size));
    page_of(&report.title(), target, first.into_iter().collect(), found.take(MAX_CURVES).collect())
}

/// A curve of the page.
pub(super) fn found(rank: usize, answer: &Answer, size: f64) -> Option<FoundCurve> {
    let mechanism = &answer.mechanism;
    let label = format!(
        "{rank}: E = {} S, {}, {}, μ ≥ {:.1}°, {}",
        relative(answer.rms_relative),
        answer.quality().name(),
        mechanism.class,
        mechanism.mu_worst_deg,
        dimensions(mechanism, size)
    );
    Some(FoundCurve { solved: mechanism.solved()?, placement: Placement::IDENTITY, pose: mechanism.pose(), label })
}

/// A curve of any linkage of the page, where it is placed, with its linkage at the first sample.
pub(super) fn placed(curve: &PlacedCurve, mut solved: SolvedCell, label: String) -> Option<FoundCurve> {
    solved.curves.retain(|other| [other.trace, other.circuit] == curve.numbers);
    let circuit = solved.circuit(solved.curves.first()?);
    let pose = solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, 0)).collect();
    Some(FoundCurve { solved, placement: curve.fit.placement, pose, label })
}

/// The page of some curves, of which the first are drawn.
pub(super) fn page_of(title: &str, target: &Target, details: Vec<String>, mut curves: Vec<FoundCurve>) -> Vec<u8> {
    curves.truncate(MAX_CURVES);
    let size = target.size();
    let page = AnswersPage {
        title,
        details,
        target: target.points().to_vec(),
        target_label: format!("the path: {}, S = {}", pluralize(target.points().len(), "point"), number(size, size)),
        curves,
    };
    let paper = Paper { width: 297.0, height: 210.0 };
    render::svg(&page::compose_answers(&page, &Options::for_paper(paper)), TextMode::Text)
}
