//! The `[linkage.joints]` table: read joint by joint, then put in an order in which each can be placed.

use super::fields::Fields;
use super::joint::{parse_joint, parse_joint_pair, parse_joint_ref};
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::Kind;
use crate::problem::{Problem, Span};
use crate::template::{Coordinate, DependencyCycle, JointKindTemplate, JointTemplate, dependency_order};

/// The joints of a linkage in the order they are placed.
pub(super) struct ParsedJoints {
    pub joints: Vec<JointTemplate>,
    pub traced: Vec<usize>,
    pub seen_from: Option<[usize; 2]>,
    /// Each joint's name and place in the text.
    pub spans: Vec<(String, Span)>,
}

pub(super) fn parse_joints<'t>(
    value: &TomlValue<'t>,
    linkage: &Fields<'_, 't>,
    scope: &[(&str, Kind)],
    reader: &mut TomlParser<'t>,
) -> Option<ParsedJoints> {
    let table = Fields::with_any_keys(value, "`joints`", reader)?;
    let names = table.keys();
    let entries: Vec<(&str, Span, &TomlValue<'t>)> = table.entries().collect();
    let read: Vec<Option<JointKindTemplate>> =
        entries.iter().map(|(name, _, value)| parse_joint(name, value, &names, scope, reader)).collect();
    let traced = parse_traced(linkage, &names, reader);
    let seen_from = linkage.get("seen_from").map(|value| parse_joint_pair(value, &names, reader));
    check_inputs(&entries, &read, &table, reader);
    let placings: Vec<JointKindTemplate> = read.into_iter().collect::<Option<_>>()?;
    check_grids(&entries, &placings, reader);
    let order = order_joints(&entries, &placings, reader)?;
    let traced = traced?;
    let seen_from = match seen_from {
        None => None,
        Some(found) => Some(found?),
    };
    check_unused(&entries, &placings, &traced, seen_from, reader);
    if seen_from.is_none() {
        check_traced_joints_move(&entries, &placings, &order, &traced, reader);
    }
    let now = |joint: usize| order.iter().position(|&k| k == joint).unwrap_or(joint);
    let joints = order
        .iter()
        .map(|&k| JointTemplate { name: names[k].to_owned(), kind: placings[k].clone().map_joints(now) })
        .collect();
    let places = entries.iter().map(|(name, span, _)| ((*name).to_owned(), span.clone())).collect();
    Some(ParsedJoints {
        joints,
        traced: traced.into_iter().map(now).collect(),
        seen_from: seen_from.map(|p| p.map(now)),
        spans: places,
    })
}

/// Whether a linkage's joints have a piston among them, which makes its input a length.
pub(super) fn has_piston(linkage: &Fields) -> bool {
    let joints = linkage.get("joints").and_then(|value| value.get_ref().as_table());
    let is_piston = |joint: &TomlValue| joint.get_ref().as_table().is_some_and(|joint| joint.contains_key("piston"));
    joints.is_some_and(|joints| joints.values().any(is_piston))
}

fn parse_traced<'t>(linkage: &Fields<'_, 't>, names: &[&str], reader: &mut TomlParser<'t>) -> Option<Vec<usize>> {
    let value = linkage.required("trace", "trace = [\"M\"]", reader)?;
    let list = reader.list(value)?;
    if list.is_empty() {
        reader.report(Problem::error(value.span(), "no joint is traced").with_help("name at least one, as in [\"M\"]"));
        return None;
    }
    let found: Vec<Option<usize>> = list.iter().map(|value| parse_joint_ref(value, names, reader)).collect();
    let found: Vec<usize> = found.into_iter().collect::<Option<_>>()?;
    for (k, joint) in found.iter().enumerate() {
        if found[..k].contains(joint) {
            let problem = Problem::error(list[k].span(), format!("`{}` is traced twice", names[*joint]));
            reader.report(problem.with_help("name each joint once"));
        }
    }
    Some(found)
}

/// A linkage has one input, and its gears are geared to it.
fn check_inputs(
    entries: &[(&str, Span, &TomlValue)],
    read: &[Option<JointKindTemplate>],
    table: &Fields,
    reader: &mut TomlParser,
) {
    let is_input =
        |k: &usize| matches!(read[*k], Some(JointKindTemplate::Crank { .. } | JointKindTemplate::Piston { .. }));
    let inputs: Vec<usize> = (0..read.len()).filter(is_input).collect();
    // A joint that could not be read may be the input.
    if inputs.is_empty() && read.iter().all(Option::is_some) {
        let problem = Problem::error(table.span.clone(), "the linkage has no input");
        reader.report(problem.with_help("one joint is driven: { crank = \"O\", length = 1 }"));
    }
    for &k in inputs.iter().skip(1) {
        let (first, second) = (entries[inputs[0]].0, entries[k].0);
        let problem = Problem::error(entries[k].2.span(), format!("`{second}` is a second input beside `{first}`"));
        let help = "a linkage of one degree of freedom has one input: place the other joints by dyads or gears";
        reader.report(problem.with_help(help));
    }
    for (k, placing) in read.iter().enumerate() {
        let Some(JointKindTemplate::Gear { crank, .. }) = placing else { continue };
        if !matches!(read[*crank], Some(JointKindTemplate::Crank { .. }) | None) {
            let message = format!("`{}` is geared to `{}`, which is no crank", entries[k].0, entries[*crank].0);
            let problem = Problem::error(entries[k].2.span(), message);
            reader.report(problem.with_help("name the pin of the crank that drives the linkage"));
        }
    }
}

/// A grid of points has no one place that another joint could hang on.
fn check_grids(entries: &[(&str, Span, &TomlValue)], placings: &[JointKindTemplate], reader: &mut TomlParser) {
    let is_grid = |k: usize| match &placings[k] {
        JointKindTemplate::Point { along, across, .. } => {
            matches!(along, Coordinate::Range { .. }) || matches!(across, Coordinate::Range { .. })
        }
        _ => false,
    };
    for (k, placing) in placings.iter().enumerate() {
        for base in placing.referenced_joints().into_iter().filter(|&base| is_grid(base)) {
            let (name, grid) = (entries[k].0, entries[base].0);
            let problem =
                Problem::error(entries[k].2.span(), format!("`{name}` hangs on `{grid}`, which is a grid of points"));
            reader.report(problem.with_help("a grid can only be traced: hang the joint on a single point"));
        }
    }
}

/// The joints a joint is placed from: those it names, and, for a point of a link that carries a slot's line, the
/// slot's foot, without which there is no such link; an actuator's and a slider's are named.
fn dependencies(placings: &[JointKindTemplate], k: usize) -> Vec<usize> {
    let mut bases = placings[k].referenced_joints();
    if let JointKindTemplate::Point { base, .. } | JointKindTemplate::Distances { base, .. } = &placings[k] {
        let carries =
            |other: &JointKindTemplate| matches!(other, JointKindTemplate::Slot { base: slot, .. } if slot == base);
        bases.extend(placings.iter().position(carries));
    }
    bases
}

/// An order in which every joint comes after those it is placed from; as written, where that is one.
fn order_joints(
    entries: &[(&str, Span, &TomlValue)],
    placings: &[JointKindTemplate],
    reader: &mut TomlParser,
) -> Option<Vec<usize>> {
    match dependency_order(placings.len(), |k| dependencies(placings, k)) {
        Ok(order) => Some(order),
        Err(DependencyCycle { cycle, unresolved: all }) => {
            let names = |joints: &[usize]| joints.iter().map(|&k| format!("`{}`", entries[k].0)).collect::<Vec<_>>();
            let (round, open) = (names(&cycle), names(&all));
            let problem =
                Problem::error(entries[cycle[0]].2.span(), format!("the joint {} is placed from itself", round[0]));
            let help = if cycle.len() <= 2 {
                format!("{} needs its own place: place it from joints already placed", round[0])
            } else {
                format!(
                    "the cycle is {}: no chain of dyads solves this linkage, and {} stay open; \
                     place one of them from joints already placed",
                    round.join(" -> "),
                    open.join(", ")
                )
            };
            reader.report(problem.with_help(help));
            None
        }
    }
}

/// Every joint is traced, seen from, or carries another; a parallelogram may be there for its links.
fn check_unused(
    entries: &[(&str, Span, &TomlValue)],
    placings: &[JointKindTemplate],
    traced: &[usize],
    seen_from: Option<[usize; 2]>,
    reader: &mut TomlParser,
) {
    for (k, (name, span, _)) in entries.iter().enumerate() {
        let carries = (0..placings.len()).any(|other| dependencies(placings, other).contains(&k));
        let is_seen = seen_from.is_some_and(|joints| joints.contains(&k));
        let has_links = matches!(
            placings[k],
            JointKindTemplate::Crank { .. }
                | JointKindTemplate::Piston { .. }
                | JointKindTemplate::Parallelogram { .. }
        );
        if !carries && !is_seen && !has_links && !traced.contains(&k) {
            let problem = Problem::error(span.clone(), format!("the joint `{name}` is not used"));
            reader.report(problem.with_help(format!("trace it, hang another joint on it, or take `{name}` away")));
        }
    }
}

/// A traced joint hangs on the joint that is driven, or it stands still; seen from a link that moves, all others move.
fn check_traced_joints_move(
    entries: &[(&str, Span, &TomlValue)],
    placings: &[JointKindTemplate],
    order: &[usize],
    traced: &[usize],
    reader: &mut TomlParser,
) {
    let mut moves = vec![false; placings.len()];
    for &k in order {
        let is_driven = matches!(
            placings[k],
            JointKindTemplate::Crank { .. } | JointKindTemplate::Gear { .. } | JointKindTemplate::Piston { .. }
        );
        moves[k] = is_driven || dependencies(placings, k).iter().any(|&need| moves[need]);
    }
    for &k in traced.iter().filter(|&&k| !moves[k]) {
        let (name, span) = (entries[k].0, entries[k].1.clone());
        let problem = Problem::error(span, format!("the traced joint `{name}` is not reached by the motion"));
        reader.report(problem.with_help("trace a joint that hangs on the driven one"));
    }
}
