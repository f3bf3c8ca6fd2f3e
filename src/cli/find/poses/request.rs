//! What the arguments ask of a search for linkages that guide a body.

use coupler_find::{Options, PoseCondition, PoseOptions};

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
    if !messages.is_empty() {
        return Err(Failure::inputs(&messages));
    }
    let Options { full_turn, max_link, pivots, effort, seed, most, .. } = options;
    let Arguments { any_order, any_circuit, .. } = *arguments;
    Ok(PoseOptions { full_turn, any_order, any_circuit, max_link, pivots, condition, effort, seed, most })
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
