//! What the arguments ask of a search.

use coupler_curves::expression::Expression;
use coupler_find::{LinkageSpace, Options};

use super::arguments::InputChoice;
use super::{Arguments, Failure};
use crate::find::{Notation, Request, Searched};

/// The options of the search, and the space of a linkage's dimensions if these are searched.
///
/// # Errors
/// All that is wrong with them.
pub(super) fn check(arguments: &Arguments, searched: Searched) -> Result<(Options, Option<LinkageSpace>), Failure> {
    let (request, mut messages) = read(arguments, searched);
    match request.check() {
        Ok(checked) if messages.is_empty() => Ok(checked),
        checked => {
            messages.extend(checked.err().into_iter().flatten().map(|problem| problem.message));
            Err(Failure::inputs(&messages))
        }
    }
}

/// What is asked, and a message for each option that cannot be read.
pub(super) fn read(arguments: &Arguments, searched: Searched) -> (Request<'_>, Vec<String>) {
    let default = Options::default();
    let max_link = parse_length(arguments.max_link_or_default());
    let pivots = arguments.pivots.as_deref().map(parse_box).transpose();
    let request = Request {
        notation: Notation::CommandLine,
        searched,
        is_timed: arguments.timed,
        is_fixed: arguments.fixed,
        index: arguments.index.map(|count| count as usize),
        pivots: pivots.clone().unwrap_or_default(),
        condition: arguments.condition.as_deref(),
        options: Options {
            full_turn: arguments.input_or_default() == InputChoice::FullTurn,
            max_link: *max_link.as_ref().unwrap_or(&default.max_link),
            effort: arguments.effort.into(),
            refine: !arguments.no_refine,
            seed: arguments.seed,
            most: arguments.top.into(),
            ..default
        },
    };
    (request, max_link.err().into_iter().chain(pivots.err()).collect())
}

/// Reads a length in sizes of the path, or how many times a link may be as long as another, or `inf`.
pub(super) fn parse_length(text: &str) -> Result<f64, String> {
    if text.trim() == "inf" {
        return Ok(f64::INFINITY);
    }
    Expression::evaluate_constant(text)
        .map_err(|error| format!("--max-link: `{text}`: {error}; write it like 10, or inf"))
}

/// Reads the numbers of a box: `XMIN,YMIN,XMAX,YMAX`.
fn parse_box(text: &str) -> Result<[f64; 4], String> {
    parse_numbers(text, "--pivots", "four", "-50,-20,50,0")
}

/// Reads numbers between commas, the value of an option that has them in words.
pub(super) fn parse_numbers<const N: usize>(
    text: &str,
    option: &str,
    count: &str,
    example: &str,
) -> Result<[f64; N], String> {
    let number = |part: &str| {
        let value = part.trim().parse::<f64>();
        value.map_err(|_| format!("{option}: `{part}` is not a number; write it like {option}={example}"))
    };
    let values: Vec<f64> = text.split(',').map(number).collect::<Result<_, String>>()?;
    let wrong = |_| format!("{option}: `{text}` does not have {count} numbers; write it like {option}={example}");
    values.try_into().map_err(wrong)
}
