//! What the arguments ask of a search for linkages that guide a body.

use coupler_curves::geometry::Point;
use coupler_find::{Options, PoseCondition, PoseOptions, PoseSet};

use super::super::request;
use super::{Arguments, Failure};
use crate::find::Searched;

/// The options of the search.
///
/// # Errors
/// All that is wrong with them, in one failure.
pub(super) fn check(arguments: &Arguments) -> Result<PoseOptions, Failure> {
    let mut messages = contradictions(arguments);
    let condition = arguments.condition.as_deref().map(|text| {
        PoseCondition::new(text).map_err(|error| format!("--where: `{text}`: {}", error.message_with_help()))
    });
    let condition = condition.transpose().unwrap_or_else(|message| {
        messages.push(message);
        None
    });
    let options = match request::check_all(arguments, Searched::Poses) {
        Ok((options, _)) => options,
        Err(problems) => {
            messages.extend(problems);
            Options::default()
        }
    };
    let given_pivots = given_pivots(arguments).unwrap_or_else(|problems| {
        messages.extend(problems);
        Vec::new()
    });
    if !messages.is_empty() {
        return Err(Failure::inputs(&messages));
    }
    let Options { full_turn, max_link, pivots, effort, seed, most, .. } = options;
    let Arguments { any_order, any_circuit, .. } = *arguments;
    Ok(PoseOptions { full_turn, any_order, any_circuit, max_link, pivots, given_pivots, condition, effort, seed, most })
}

/// The pivots that are given.
///
/// # Errors
/// All that is wrong with them.
fn given_pivots(arguments: &Arguments) -> Result<Vec<Point>, Vec<String>> {
    /// A linkage has no more.
    const MOST: usize = 2;
    let mut problems = Vec::new();
    let mut pivots: Vec<Point> = Vec::new();
    for text in &arguments.pivot {
        match request::parse_numbers(text, "--pivot", "two", "10,-20") {
            Ok([x, y]) if !x.is_finite() || !y.is_finite() => {
                problems.push(format!("--pivot: `{text}` is not finite; write it like --pivot=10,-20"));
            }
            Ok([x, y]) if pivots.contains(&Point::new(x, y)) => {
                problems.push(format!("--pivot: `{text}` is given twice: leave one out"));
            }
            Ok([x, y]) => pivots.push(Point::new(x, y)),
            Err(problem) => problems.push(problem),
        }
    }
    if arguments.pivot.len() > MOST {
        let count = arguments.pivot.len();
        problems.push(format!("--pivot is given {count} times, and a linkage has two fixed pivots: give one or two"));
    }
    if problems.is_empty() { Ok(pivots) } else { Err(problems) }
}

/// Checks that some poses have linkages with given pivots.
///
/// # Errors
/// They are more than three.
pub(super) fn check_given_pivots(name: &str, poses: &PoseSet, options: &PoseOptions) -> Result<(), Failure> {
    /// Of more poses the pivots are on a curve, or are a few points.
    const MOST: usize = 3;
    let count = poses.poses().len();
    if options.given_pivots.is_empty() || count <= MOST {
        return Ok(());
    }
    let which = match count {
        4 => "are on a curve",
        5 => "are at most four points",
        _ => "are where the linkage is nearest to the poses",
    };
    Err(Failure::input(format!(
        "{name}: --pivot is of 2 or 3 poses, and the pivots of {count} {which}: leave poses out, or give a box in its place, --pivots XMIN,YMIN,XMAX,YMAX"
    )))
}

/// The options that have no meaning for poses.
fn contradictions(arguments: &Arguments) -> Vec<String> {
    const PATH: &str = "is of paths";
    const SEARCH: &str = "is of the search for curves";
    let options = [
        (arguments.like.is_some(), "--like", "names a curve, which has no poses of a body: name a file"),
        (arguments.timed, "--timed", "is of paths whose points have angles of the crank"),
        (arguments.closed, "--closed", PATH),
        (arguments.open, "--open", PATH),
        (arguments.part, "--part", PATH),
        (arguments.atlas.is_some(), "--atlas", SEARCH),
        (
            arguments.linkage.is_some(),
            "--linkage",
            "searches one linkage for a path, and poses are passed by four-bars and slider-cranks",
        ),
        (!arguments.keep.is_empty(), "--keep", SEARCH),
        (arguments.fixed, "--fixed", SEARCH),
        (arguments.index.is_some(), "--index", SEARCH),
        (arguments.no_refine, "--no-refine", SEARCH),
        (arguments.manifest.is_some(), "--manifest", SEARCH),
    ];
    let given = options.into_iter().filter(|(is_given, ..)| *is_given);
    given.map(|(_, name, why)| format!("{name} and --poses do not go together: {name} {why}; leave one out")).collect()
}
