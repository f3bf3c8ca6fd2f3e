//! What the arguments ask of a search for linkages that guide a body.

use coupler_curves::geometry::Point;
use coupler_find::PoseOptions;

use super::super::request;
use super::{Arguments, Failure};
use crate::find::{PoseRequest, Searched};

/// The options of the search.
///
/// # Errors
/// All that is wrong with them, in one failure.
pub(super) fn check(arguments: &Arguments) -> Result<PoseOptions, Failure> {
    let mut messages = contradictions(arguments);
    let (request, unread) = request::read(arguments, Searched::Poses);
    messages.extend(unread);
    let given_pivots = arguments.pivot.iter().filter_map(|text| {
        let read = request::parse_numbers(text, "--pivot", "two", "10,-20");
        read.map(|[x, y]| Point::new(x, y)).map_err(|message| messages.push(message)).ok()
    });
    let given_pivots = given_pivots.collect();
    let Arguments { any_order, any_circuit, .. } = *arguments;
    match (PoseRequest { request, any_order, any_circuit, given_pivots }).check() {
        Ok(options) if messages.is_empty() => Ok(options),
        checked => {
            messages.extend(checked.err().into_iter().flatten());
            Err(Failure::inputs(&messages))
        }
    }
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
            "searches one linkage for a path, and poses are passed by four-bars, slider-cranks and inverted slider-cranks",
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
