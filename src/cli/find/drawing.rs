//! A drawing of the path and the curves that have been found for it.

use coupler_curves::find::{Answer, format_length as number, format_relative as relative};
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
    let found = |(rank, answer): (usize, &Answer)| {
        let mechanism = &answer.mechanism;
        let label = format!(
            "{rank}: E = {} S, {}, {}, μ ≥ {:.1}°, {}",
            relative(answer.rms_relative),
            answer.quality().name(),
            mechanism.class,
            mechanism.mu_worst_deg,
            dimensions(mechanism, size)
        );
        Some(FoundCurve { solved: mechanism.solved()?, pose: mechanism.pose(), label })
    };
    let first = answers.first().map(|answer| {
        let [crank, rocker] = answer.mechanism.four_bar.pivots.map(|p| {
            let [x, y] = [p.x, p.y].map(|value| number(value, size));
            format!("({x}, {y})")
        });
        format!("the linkage of curve 1, with its crank's pivot at {crank} and its rocker's at {rocker}, is at the first point of the path")
    });
    let page = AnswersPage {
        title: &report.title(),
        details: first.into_iter().collect(),
        target: target.points().to_vec(),
        target_label: format!("the path: {}, S = {}", pluralize(target.points().len(), "point"), number(size, size)),
        curves: (1..).zip(answers).filter_map(found).take(MAX_CURVES).collect(),
    };
    let paper = Paper { width: 297.0, height: 210.0 };
    render::svg(&page::compose_answers(&page, &Options::for_paper(paper)), TextMode::Text)
}
