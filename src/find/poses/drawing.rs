//! A drawing of the poses and of the linkages that guide a body through them.

use coupler_curves::geometry::{Point, Similarity, trig};
use coupler_drawing::page::{self, AnswersPage, FoundCurve, FoundLine, Options, Paper};
use coupler_drawing::render::{self, TextMode};
use coupler_find::{PoseAnswer, PoseSet, burmester_curves, format_length as number};

/// The most curves of a drawing: more of them hide each other.
const MAX_CURVES: usize = 5;

/// A landscape page of A4 with the poses, the paths of the body's point, and the best linkage in the first pose, as SVG; of four poses with the
/// curves of their pivots and pins.
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
    let mut lines = vec![FoundLine { points: frames(set), texts: numbers(set), label: String::new(), is_light: false }];
    if let Some([centres, circles]) = burmester_curves(set) {
        let label = "the pivots of all dyads, the centre-point curve".to_owned();
        lines.push(FoundLine { points: centres, texts: Vec::new(), label, is_light: false });
        let label = "their pins at the first pose, the circle-point curve".to_owned();
        lines.push(FoundLine { points: circles, texts: Vec::new(), label, is_light: true });
    }
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
        lines,
    };
    let paper = Paper { width: 297.0, height: 210.0 };
    render::svg(&page::compose_answers(&page, &Options::for_paper(paper)), TextMode::Text)
}

/// The axes of the body at each pose, that of x longer.
fn frames(set: &PoseSet) -> Vec<Vec<Point>> {
    let length = 0.25 * set.size();
    let frame = |pose: &coupler_find::BodyPose| {
        let (cos, sin) = trig::cos_sin_deg(pose.angle_deg);
        let at = |x: f64, y: f64| {
            Point::new(pose.point.x + length * (x * cos - y * sin), pose.point.y + length * (x * sin + y * cos))
        };
        vec![at(0.0, 0.6), at(0.0, 0.0), at(1.0, 0.0), at(0.85, 0.08), at(0.85, -0.08), at(1.0, 0.0)]
    };
    set.poses().iter().map(frame).collect()
}

/// The numbers of the poses, beside the body's point; of many, of the first and the last.
fn numbers(set: &PoseSet) -> Vec<(Point, String)> {
    const MOST: usize = 12;
    let count = set.poses().len();
    let is_shown = |number: &usize| count <= MOST || [1, count].contains(number);
    let numbered = (1..).zip(set.poses()).filter(|(number, _)| is_shown(number));
    numbered.map(|(number, pose)| (pose.point, number.to_string())).collect()
}
