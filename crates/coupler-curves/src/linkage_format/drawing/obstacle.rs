//! What keeps a drawing from being placed, in words.

use super::mobility::Mobility;
use super::placer::{Obstacle, Placer};
use super::{Drawing, DrawnInput};
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
        Obstacle::Open if mobility.degrees() > 1 => {
            let problem = Problem::error(
                drawing.span.clone(),
                format!("the drawing has {} degrees of freedom, where one is driven: {count}", mobility.degrees()),
            );
            problem.with_help(format!("add links or slides that hold {}", listed(unplaced())))
        }
        Obstacle::Open if mobility.degrees() < 1 => {
            let problem = Problem::error(drawing.span.clone(), format!("the drawing cannot move: {count}"));
            problem.with_help(format!("leave a link out; those with {} hold each other", listed(unplaced())))
        }
        Obstacle::Open => {
            let message = format!("no dyads place {}: these links hold each other", listed(unplaced()));
            let problem = Problem::error(drawing.input_span.clone(), message);
            let inputs = other_inputs(drawing);
            problem.with_help(match &inputs[..] {
                [] => "there is no other input by which dyads would place them".to_owned(),
                inputs => format!("drive it elsewhere, which gives the same curves: input = {}", inputs.join(" or ")),
            })
        }
    }
}

/// The inputs by which dyads place all joints: links on the frame, then angles between moving links.
fn other_inputs(drawing: &Drawing) -> Vec<String> {
    let mut found = Vec::new();
    for ground in 0..drawing.links.len() {
        for link in (1..drawing.links.len()).filter(|link| *link > ground) {
            let (own, other) = (&drawing.links[link].joints, &drawing.links[ground].joints);
            let Some(&pivot) = own.iter().find(|joint| other.contains(joint)) else { continue };
            let Some(&joint) = own.iter().find(|joint| **joint != pivot) else { continue };
            let Some(&before) = other.iter().find(|joint| **joint != pivot).or((ground == 0).then_some(&pivot)) else {
                continue;
            };
            let from = (ground != 0).then_some([before, pivot]);
            let input = DrawnInput::Crank { ground, from, link, line: [pivot, joint] };
            let tried = Drawing { input, ..drawing.clone() };
            if Placer::new(&tried).place_all().is_ok() {
                let name = |joint: usize| drawing.names[joint];
                found.push(match ground {
                    0 => format!("\"{} {}\"", name(pivot), name(joint)),
                    _ => format!(
                        "{{ between = [\"{} {}\", \"{} {}\"] }}",
                        name(before),
                        name(pivot),
                        name(pivot),
                        name(joint)
                    ),
                });
            }
            if found.len() == 2 {
                return found;
            }
        }
    }
    found
}
