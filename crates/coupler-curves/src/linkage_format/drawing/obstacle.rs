//! What keeps a drawing from being placed, in words.

use super::Drawing;
use super::group::MAX_GROUPED;
use super::mobility::Mobility;
use super::placer::{Obstacle, Placer};
use crate::problem::Problem;

/// The problem of a drawing that cannot be placed.
pub(super) fn describe(drawing: &Drawing, mobility: Mobility, placer: &Placer, obstacle: Obstacle) -> Problem {
    let count = mobility.in_words();
    let listed = |joints: Vec<usize>| {
        let names: Vec<String> = joints.into_iter().map(|joint| drawing.joint_name(joint)).collect();
        match &names[..] {
            [] => String::new(),
            [only] => only.clone(),
            [others @ .., last] => format!("{} and {last}", others.join(", ")),
        }
    };
    let unplaced = || (0..drawing.names.len()).filter(|joint| !placer.is_placed(*joint)).collect::<Vec<_>>();
    match obstacle {
        Obstacle::Redundant(link) => {
            let span = drawing.links[link].span.clone();
            let problem = Problem::error(
                span,
                format!(
                    "{} is one too many: its joints are held without it, so that a part is rigid",
                    drawing.link_name(link)
                ),
            );
            problem.with_help(format!("leave it out, or a joint of it; degrees of freedom: {count}. A parallelogram with a further link is a joint with `parallelogram` in [linkage.joints]"))
        }
        Obstacle::RedundantSlide(joint) => {
            let problem = Problem::error(
                drawing.spans[joint][0].clone(),
                format!(
                    "{} is held without the line on which it slides, so that a part is rigid",
                    drawing.joint_name(joint)
                ),
            );
            problem.with_help(format!("leave the line out of `slides`; degrees of freedom: {count}"))
        }
        Obstacle::TooLarge(joints) => {
            let message = format!("{joints} joints hold each other, at most {MAX_GROUPED} can be placed together");
            let problem = Problem::error(drawing.input_span.clone(), message);
            problem.with_help("drive it elsewhere, so that dyads place joints one after the other: input = …")
        }
        Obstacle::Open if mobility.degrees() > 1 => {
            let problem = Problem::error(
                drawing.span.clone(),
                format!("the drawing has {} degrees of freedom, where one is driven: {count}", mobility.degrees()),
            );
            problem.with_help(format!("add links or slides that hold {}", listed(unplaced())))
        }
        // With one degree of freedom they are placed together.
        Obstacle::Open => {
            let problem = Problem::error(drawing.span.clone(), format!("the drawing cannot move: {count}"));
            problem.with_help(format!("leave a link out; those with {} hold each other", listed(unplaced())))
        }
    }
}
