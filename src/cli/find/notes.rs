//! What to know of the best answer, and what may help.

use crate::sweep;
use coupler_curves::expression::Kind;
use coupler_curves::family::Family;
use coupler_curves::measure::parse_condition;
use coupler_find::{Options, Quality};

use super::super::effort::EffortChoice;
use super::super::jams::jams;
use super::super::printable;
use super::{Arguments, InputChoice};

/// What a note depends on.
pub(super) struct Best {
    pub quality: Quality,
    /// Its worst transmission angle; not a number if it has none.
    pub mu_worst_deg: f64,
}

/// The notes on the best answer, a line each.
pub(super) fn notes(best: &Best, arguments: &Arguments) -> String {
    let mut out = String::new();
    out += &jams(best.mu_worst_deg, arguments.condition.as_deref());
    if best.quality == Quality::Poor {
        out += &format!("note: the best fit is poor; what may help: {}\n", remedies(arguments).join(", "));
    }
    out
}

/// Which conditions a cell of a family does not meet, and its values, or why the condition has no meaning there.
pub(super) fn unmet(family: Family, cell: usize, condition: &str) -> String {
    let scope = Family::scope(&family.names, family.template.is_driven_by_length());
    let found = match parse_condition(condition).and_then(|parsed| parsed.compile(&scope, Kind::Boolean)) {
        Ok(filter) => {
            let family = Family { filter: Some(filter), sort: None, ..family };
            sweep::diagnose(&family, cell..cell + 1).describe(1)
        }
        Err(error) => error.to_string(),
    };
    format!("note: the nearest miss does not meet --where: {}\n", printable(found))
}

/// What may lead to a better fit than with these arguments.
fn remedies(arguments: &Arguments) -> Vec<&'static str> {
    let has_link_limit = arguments.max_link_or_default().trim() != "inf";
    let is_short = has_link_limit && arguments.max_link_or_default().trim() != Options::default().max_link.to_string();
    let candidates = [
        (arguments.condition.is_some(), "a weaker --where"),
        (arguments.pivots.is_some(), "a larger --pivots"),
        (is_short, "a greater --max-link"),
        (arguments.fixed, "no --fixed"),
        (arguments.no_refine, "no --no-refine"),
        (arguments.effort != EffortChoice::Thorough, "--effort thorough"),
        (!arguments.part, "--part, if the path is a part of the curve"),
        (arguments.input_or_default() == InputChoice::FullTurn, "--input any, if the crank need not turn fully"),
        (arguments.atlas.is_some(), "a search of all four-bars, without --atlas"),
        (arguments.linkage.is_some(), "another --linkage"),
    ];
    candidates.into_iter().filter(|(helps, _)| *helps).map(|(_, remedy)| remedy).collect()
}
