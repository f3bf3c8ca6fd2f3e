//! A drawing of the path and the curves that have been found for it.

use coupler_curves::family::Family;
use coupler_curves::geometry::Similarity;
use coupler_curves::linkage_format::quoted;
use coupler_curves::solve::Solver;
use coupler_drawing::page::{self, AnswersPage, FoundCurve, GuidedBody, Options, Paper};
use coupler_drawing::render::{self, TextMode};
use coupler_find::{
    Answer, LinkageAnswer, PlacedCurve, Target, format_drawn_length, format_length as number,
    format_relative as relative,
};

use super::description::{deviation, dimensions, parameters, placement};
use super::{AtlasAnswer, Findings};
use crate::manifest::Plan;

/// The most curves of a drawing: more of them hide each other.
const MAX_CURVES: usize = 5;

/// A landscape page of A4 with the path, the best four-bars' curves, and the linkage of the best, as SVG.
pub fn draw_four_bars(title: &str, target: &Target, answers: &[Answer]) -> Vec<u8> {
    let size = target.size();
    let first = answers.first().map(|answer| {
        let [crank, rocker] = answer.mechanism.four_bar.pivots.map(|p| {
            let [x, y] = [p.x, p.y].map(|value| format_drawn_length(value, size));
            format!("({x}, {y})")
        });
        format!("the linkage of curve 1, with its crank's pivot at {crank} and its rocker's at {rocker}, is at the first point of the path")
    });
    let found = (1..).zip(answers).filter_map(|(rank, answer)| found(rank, answer, size));
    page_of(title, target, first.into_iter().collect(), found.take(MAX_CURVES))
}

/// A curve of the page.
fn found(rank: usize, answer: &Answer, size: f64) -> Option<FoundCurve> {
    let mechanism = &answer.mechanism;
    let label = format!(
        "{rank}: E = {} S, {}, {}, μ ≥ {:.1}°, {}",
        relative(answer.deviation.rms_relative),
        answer.deviation.quality().name(),
        mechanism.class,
        mechanism.mu_worst_deg,
        dimensions(mechanism, |value| format_drawn_length(value, size))
    );
    Some(FoundCurve { solved: mechanism.solved()?, placement: Similarity::IDENTITY, pose: mechanism.pose(), label })
}

/// A curve of any linkage of the page, where it is placed, with its linkage at the first sample.
fn placed(curve: &PlacedCurve, family: &Family, cell: usize, label: String) -> Option<FoundCurve> {
    let mut solved = Solver::new(family).measuring(family.selection_measures()).solve(cell)?;
    solved.curves.retain(|other| [other.trace, other.circuit] == curve.numbers);
    let circuit = solved.circuit(solved.curves.first()?);
    let pose = solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, 0)).collect();
    Some(FoundCurve { solved, placement: curve.fit.placement, pose, label })
}

/// The page of some curves, of which the first are drawn.
fn page_of(title: &str, target: &Target, details: Vec<String>, curves: impl Iterator<Item = FoundCurve>) -> Vec<u8> {
    let size = target.size();
    let page = AnswersPage {
        title,
        details,
        target: target.points().to_vec(),
        target_label: format!("the path: {} points, S = {}", target.points().len(), number(size, size)),
        curves: curves.take(MAX_CURVES).collect(),
        body: GuidedBody::default(),
    };
    let paper = Paper { width: 297.0, height: 210.0 };
    render::svg(&page::compose_answers(&page, &Options::for_paper(paper)), TextMode::Text)
}

impl Findings<AtlasAnswer> {
    /// A page with the path and the best curves, as SVG.
    pub fn drawing(&self, name: &str, target: &Target, plan: &Plan) -> Vec<u8> {
        let size = target.size();
        let curves = (1..).zip(&self.answers).filter_map(|(rank, answer)| {
            if let Some(refined) = &answer.refined {
                return found(rank, refined, size);
            }
            let [family, cell] = answer.place;
            let label = format!("{rank}: {}, {}", answer.name, placement(&answer.curve, size));
            placed(&answer.curve, &plan.families[family].family, cell, label)
        });
        page_of(&format!("{name} in {}", quoted(&plan.title)), target, Vec::new(), curves)
    }
}

impl Findings<LinkageAnswer> {
    /// A page with the path and the best curves, as SVG.
    pub fn drawing(&self, name: &str, target: &Target, linkage: &str) -> Vec<u8> {
        let size = target.size();
        let curves = (1..).zip(&self.answers).filter_map(|(rank, answer)| {
            let curve = &answer.curve;
            let template = &answer.family.template;
            let own = if template.id == linkage { String::new() } else { format!("{}, ", template.id) };
            let label = format!(
                "{rank}: {own}{}, {}",
                deviation(&curve.fit.deviation, size),
                parameters(template, curve, size)
            );
            placed(curve, &answer.family, 0, label)
        });
        page_of(&format!("{name}: {linkage}"), target, Vec::new(), curves)
    }
}
