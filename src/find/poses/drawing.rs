//! A drawing of the poses and of the linkages that guide a body through them.

use coupler_curves::geometry::Similarity;
use coupler_drawing::page::{self, AnswersPage, FoundCurve, Options, Paper};
use coupler_drawing::render::{self, TextMode};
use coupler_find::{PoseAnswer, PoseSet, format_length as number};

use super::body::guided_body;

/// The most curves of a drawing: more of them hide each other.
const MAX_CURVES: usize = 5;

/// A landscape page of A4 with the poses, the paths of the body's point, and the best linkage in the first pose, as SVG; with the
/// places of pivots and pins that the poses have.
pub fn draw_poses(title: &str, set: &PoseSet, answers: &[PoseAnswer]) -> Vec<u8> {
    let size = set.size();
    let curves = (1..).zip(answers).filter_map(|(rank, answer)| {
        let solved = answer.solved()?;
        let pose = answer.joints(&solved);
        let values: Vec<String> = answer
            .guide
            .parameters()
            .into_iter()
            .map(|(name, value)| format!("{name} = {}", number(value, size)))
            .collect();
        let [at_poses, _] = answer.mu_worst_deg;
        let label = format!("{rank}: {}, μ ≥ {at_poses:.1}° at the poses, {}", answer.guide.name(), values.join(", "));
        Some(FoundCurve { solved, placement: Similarity::IDENTITY, pose, label })
    });
    let page = AnswersPage {
        title,
        details: if answers.is_empty() {
            vec!["no linkage passes the poses as asked for".to_owned()]
        } else {
            Vec::new()
        },
        target: set.poses().iter().map(|pose| pose.point).collect(),
        target_label: format!("the poses: {}, S = {}", set.poses().len(), number(size, size)),
        curves: curves.take(MAX_CURVES).collect(),
        body: guided_body(set.poses(), true),
    };
    let paper = Paper { width: 297.0, height: 210.0 };
    render::svg(&page::compose_answers(&page, &Options::for_paper(paper)), TextMode::Text)
}
