//! Parses the joints of a linkage, drawn or joint by joint, and sorts them so that each can be placed.

use std::collections::{HashMap, HashSet};

use toml::de::DeValue;

use super::drawing::{self, PlacedDrawing, place, read_drawing};
use super::fields::Fields;
use super::joint_forms::parse_joint;
use super::joint_id::check_joint_id;
use super::joint_values::{parse_joint_pair, parse_joint_ref};
use super::names::JointNames;
use super::quantities::InputKind;
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::Scope;
use crate::problem::{Problem, Span};
use crate::template::{
    ClosureTemplate, Coordinate, DependencyCycle, InputValue, JointKindTemplate, JointTemplate, OutputLinkTemplate,
    dependency_order,
};

/// The joints of a linkage in the order they are placed.
pub(super) struct ParsedJoints {
    pub joints: Vec<JointTemplate>,
    pub closures: Vec<ClosureTemplate>,
    /// The joints of the drawing as they are placed if it is driven elsewhere, and the input there.
    pub driven_elsewhere: Option<(Vec<JointTemplate>, InputValue)>,
    pub traced: Vec<usize>,
    pub seen_from: Option<[usize; 2]>,
    pub output_link: Option<OutputLinkTemplate>,
    pub chains: Vec<Vec<usize>>,
    /// The input in the drawing, if there is one.
    pub start: Option<InputValue>,
    /// Each joint's name and its span in the text.
    pub spans: Vec<(String, Span)>,
}

const TRACE_EXAMPLE: &str = "trace = [\"M\"]";

/// A joint with its name, where this is, and where it is said how the joint is placed.
struct Entry<'e> {
    name: &'e str,
    name_span: Span,
    span: Span,
    /// Whether it is of a drawing, and need not be of use.
    is_drawn: bool,
}

/// Parses the joints of a linkage: those of its drawing, and those of `[linkage.joints]`, which may be placed from them.
pub(super) fn parse_joints<'t>(
    linkage: &Fields<'_, 't>,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<ParsedJoints> {
    let drawing = linkage.get("drawing").and_then(|value| read_drawing(value, scope, parser));
    let placed = drawing.as_ref().map(place).and_then(|placed| placed.map_err(|problem| parser.report(problem)).ok());
    let table = match (linkage.get("joints"), linkage.get("drawing")) {
        (None, Some(_)) => Some(None),
        _ => linkage
            .required("joints", "a table [linkage.joints], or a drawing, [linkage.drawing]", parser)
            .and_then(|value| Fields::with_any_keys(value, "`joints`", parser).map(Some)),
    };
    // Of a drawing that cannot be placed the joints have names, with which the other keys are checked.
    let written = match (linkage.get("drawing"), &placed) {
        (Some(drawing), None) => {
            drawing.get_ref().as_table().and_then(|table| table.get("joints")?.get_ref().as_table())
        }
        _ => None,
    };
    let (Some(table), true) = (table, linkage.get("drawing").is_none() || placed.is_some() || written.is_some()) else {
        linkage.required("trace", TRACE_EXAMPLE, parser);
        return None;
    };
    let mut entries: Vec<Entry> = Vec::new();
    entries.extend(written.into_iter().flatten().map(|(name, value)| Entry {
        name: name.get_ref(),
        name_span: name.span(),
        span: value.span(),
        is_drawn: true,
    }));
    if let Some((drawing, placed)) = drawing.as_ref().zip(placed.as_ref()) {
        let drawn = drawing.names.iter().zip(&drawing.spans);
        entries.extend(drawn.map(|(name, [name_span, span])| Entry {
            name,
            name_span: name_span.clone(),
            span: span.clone(),
            is_drawn: true,
        }));
        let further =
            |name| Entry { name, name_span: drawing.span.clone(), span: drawing.span.clone(), is_drawn: true };
        entries.extend(placed.further.iter().map(|joint| further(joint.name.as_str())));
    }
    let drawn_count = entries.len();
    let own: Vec<(&str, Span, &TomlValue<'t>)> = table.iter().flat_map(Fields::entries).collect();
    for (name, name_span, value) in &own {
        check_joint_id(name, name_span).into_iter().for_each(|problem| parser.report(problem));
        if entries[..drawn_count].iter().any(|entry| entry.name == *name) {
            let problem = Problem::error(name_span.clone(), format!("the joint `{name}` is in the drawing"));
            parser.report(problem.with_help("give it another name, or leave it out of one of the two"));
        }
        entries.push(Entry { name, name_span: name_span.clone(), span: value.span(), is_drawn: false });
    }
    let names = JointNames::new(entries.iter().map(|entry| entry.name).collect());
    let drawn = placed.iter().flat_map(|placed| {
        let further = placed.further.iter().map(|joint| &joint.kind);
        placed.kinds.iter().chain(further).cloned().map(Some)
    });
    let mut parsed: Vec<Option<JointKindTemplate>> = drawn.collect();
    parsed.resize(drawn_count, None);
    parsed
        .extend(own.iter().map(|(name, _, value)| parse_joint(name, value, &names, scope, parser)).collect::<Vec<_>>());
    let traced = parse_traced(linkage, &names, parser);
    let seen_from = linkage.get("seen_from").map(|value| parse_joint_pair(value, &names, parser));
    let output_link = linkage.get("output_link").map(|value| parse_output_link(value, &names, &parsed, parser));
    let chains = linkage.get("chains").map_or(Some(Vec::new()), |value| parse_chains(value, &names, parser));
    let span = table.as_ref().map_or_else(|| linkage.span.clone(), |table| table.span.clone());
    let is_driven = placed.as_ref().is_some_and(PlacedDrawing::has_driven_distance);
    check_inputs(&entries, &parsed, is_driven, span, parser);
    let placings: Vec<JointKindTemplate> = parsed.into_iter().collect::<Option<_>>()?;
    check_grids(&entries, &placings, parser);
    if placed.as_ref().is_some_and(|placed| !placed.closures.is_empty()) {
        check_beside_group(&entries[drawn_count..], &placings[drawn_count..], parser);
    }
    let needs = dependencies(&placings);
    let order = order_joints(&entries, &needs, parser)?;
    let traced = traced?;
    let seen_from = match seen_from {
        None => placed.as_ref().and_then(|placed| placed.seen_from),
        Some(joints) => Some(joints?),
    };
    let output_link = match output_link {
        None => None,
        Some(output) => Some(output?),
    };
    let chains = chains?;
    let loaded = linkage.get("load").and_then(|load| load.get_ref().as_table()?.get("joint")?.get_ref().as_str());
    let loaded = loaded.map(|name| names.index_of(name));
    // A joint that seems to be of no use may be that of a misspelt name.
    if loaded != Some(None) {
        let named = seen_from.into_iter().flatten().chain(output_joints(output_link)).chain(loaded.flatten());
        check_unused(&entries, &placings, &needs, &traced, &named.collect::<Vec<_>>(), parser);
    }
    if seen_from.is_none() {
        check_traced_joints_move(&entries, &placings, &needs, &order, &traced, parser);
    }
    let new_indices = places_in(&order);
    let new_index = |joint: usize| new_indices[joint];
    let drawn_at = |k: usize| {
        let (drawing, placed) = drawing.as_ref().zip(placed.as_ref())?;
        drawing.position(k).or_else(|| placed.further.get(k - drawing.names.len())?.drawn.clone())
    };
    let joints = order
        .iter()
        .map(|&k| JointTemplate {
            name: names.all()[k].to_owned(),
            kind: placings[k].clone().map_joints(new_index),
            drawn: drawn_at(k),
        })
        .collect();
    let spans = entries.iter().map(|entry| (entry.name.to_owned(), entry.name_span.clone())).collect();
    let closures = placed.iter().flat_map(|placed| placed.closures.iter().cloned());
    let closures = closures.map(|closure| closure.map_joints(new_index)).collect();
    let driven_elsewhere = placed.as_ref().and_then(|placed| placed.driven_elsewhere.as_deref());
    let driven_elsewhere = driven_elsewhere.and_then(|other| {
        let drawing = drawing.as_ref()?;
        Some((joints_in_order(drawing.names.as_slice(), other)?, other.start.clone()))
    });
    Some(ParsedJoints {
        joints,
        closures,
        driven_elsewhere,
        traced: traced.into_iter().map(new_index).collect(),
        seen_from: seen_from.map(|joints| joints.map(new_index)),
        output_link: output_link.map(|output| match output {
            OutputLinkTemplate::Link(joints) => OutputLinkTemplate::Link(joints.map(new_index)),
            OutputLinkTemplate::Slider(joint) => OutputLinkTemplate::Slider(new_index(joint)),
        }),
        chains: chains.into_iter().map(|chain| chain.into_iter().map(new_index).collect()).collect(),
        start: placed.map(|placed| placed.start),
        spans,
    })
}

/// The names of the joints of a linkage as they are written; `None` if they are not all known, as those of a drawing.
pub(super) fn written_names<'v>(linkage: &Fields<'v, '_>) -> Option<Vec<&'v str>> {
    let joints = linkage.get("joints").filter(|_| linkage.get("drawing").is_none())?.get_ref().as_table()?;
    Some(joints.keys().map(|name| name.get_ref().as_ref()).collect())
}

/// The place of each joint in an order of all.
fn places_in(order: &[usize]) -> Vec<usize> {
    let mut places = vec![0; order.len()];
    order.iter().zip(0..).for_each(|(&joint, place)| places[joint] = place);
    places
}

/// The joints of a drawing in an order in which each can be placed.
fn joints_in_order(names: &[&str], placed: &PlacedDrawing) -> Option<Vec<JointTemplate>> {
    let further = placed.further.iter().map(|joint| &joint.kind);
    let kinds: Vec<JointKindTemplate> = placed.kinds.iter().chain(further).cloned().collect();
    let needs = dependencies(&kinds);
    let order = dependency_order(kinds.len(), |k| needs[k].clone()).ok()?;
    let new_indices = places_in(&order);
    let name = |k: usize| {
        names.get(k).copied().or_else(|| placed.further.get(k - names.len()).map(|joint| joint.name.as_str()))
    };
    let joint = |&k: &usize| {
        let kind = kinds[k].clone().map_joints(|joint| new_indices[joint]);
        Some(JointTemplate { name: name(k)?.to_owned(), kind, drawn: None })
    };
    order.iter().map(joint).collect()
}

/// What the input of a linkage is: a length if it has a piston.
pub(super) fn input_kind(linkage: &Fields) -> InputKind {
    if let Some(drawing) = linkage.get("drawing") {
        return drawing::input_kind(drawing);
    }
    let joints = linkage.get("joints").and_then(|value| value.get_ref().as_table());
    let has = |key: &str| {
        let is_so = |joint: &TomlValue| joint.get_ref().as_table().is_some_and(|joint| joint.contains_key(key));
        joints.is_some_and(|joints| joints.values().any(is_so))
    };
    match (has("piston") || has("slider"), has("crank")) {
        (true, _) => InputKind::Length,
        (false, true) => InputKind::Angle { has_slider: has("slide") || has("yoke") },
        (false, false) => InputKind::Unknown,
    }
}

fn parse_traced<'t>(linkage: &Fields<'_, 't>, names: &JointNames, parser: &mut TomlParser<'t>) -> Option<Vec<usize>> {
    let value = linkage.required("trace", TRACE_EXAMPLE, parser)?;
    let list = parser.list(value)?;
    if list.is_empty() {
        parser.report(Problem::error(value.span(), "no joint is traced").with_help("name at least one, as in [\"M\"]"));
        return None;
    }
    let traced: Vec<Option<usize>> = list.iter().map(|value| parse_joint_ref(value, names, parser)).collect();
    let traced: Vec<usize> = traced.into_iter().collect::<Option<_>>()?;
    let mut seen = HashSet::new();
    for (k, joint) in traced.iter().enumerate() {
        if !seen.insert(joint) {
            let problem = Problem::error(list[k].span(), format!("`{}` is traced twice", names.all()[*joint]));
            parser.report(problem.with_help("name each joint once"));
        }
    }
    Some(traced)
}

/// Parses an output link: two joints of a link, or the joint of a slider; `parsed` are the joints that can be read.
fn parse_output_link<'t>(
    value: &TomlValue<'t>,
    names: &JointNames,
    parsed: &[Option<JointKindTemplate>],
    parser: &mut TomlParser<'t>,
) -> Option<OutputLinkTemplate> {
    match value.get_ref() {
        DeValue::String(_) => parse_joint_ref(value, names, parser).map(OutputLinkTemplate::Slider),
        DeValue::Array(joints) if joints.len() != 2 => {
            let problem = Problem::error(
                value.span(),
                "an output link is named by two of its joints, and a slider by one without brackets",
            );
            let is_slider = |name: &&str| {
                let joint = names.index_of(name).and_then(|joint| parsed[joint].as_ref());
                joint.is_some_and(is_sliding)
            };
            let help = match joints.iter().filter_map(|joint| joint.get_ref().as_str()).find(is_slider) {
                Some(slider) => format!("write output_link = \"{slider}\" for the slider"),
                None => "name two joints of a link, as in output_link = [\"C\", \"B\"]".to_owned(),
            };
            parser.report(problem.with_help(help));
            None
        }
        _ => parse_joint_pair(value, names, parser).map(OutputLinkTemplate::Link),
    }
}

/// Parses chains: lists of joints.
fn parse_chains<'t>(value: &TomlValue<'t>, names: &JointNames, parser: &mut TomlParser<'t>) -> Option<Vec<Vec<usize>>> {
    let mut chains = Vec::new();
    let mut all_read = true;
    for value in parser.list(value)? {
        let joints = parser.list(value).unwrap_or_default();
        let chain: Vec<usize> = joints.iter().filter_map(|joint| parse_joint_ref(joint, names, parser)).collect();
        let distinct: HashSet<&usize> = chain.iter().collect();
        let is_list = value.get_ref().is_array();
        all_read &= is_list && chain.len() == joints.len();
        if is_list && (joints.len() < 2 || distinct.len() < chain.len()) {
            let problem = Problem::error(value.span(), "a chain has two or more joints, each once");
            parser.report(problem.with_help("name the joints of its links, as in [\"O\", \"A\", \"B\"]"));
            all_read = false;
        }
        chains.push(chain);
    }
    all_read.then_some(chains)
}

/// The joints that an output link is given by.
fn output_joints(output: Option<OutputLinkTemplate>) -> Vec<usize> {
    match output {
        None => Vec::new(),
        Some(OutputLinkTemplate::Link(joints)) => joints.to_vec(),
        Some(OutputLinkTemplate::Slider(joint)) => vec![joint],
    }
}

/// Whether a joint is that of a slider or a yoke.
fn is_sliding(kind: &JointKindTemplate) -> bool {
    matches!(kind, JointKindTemplate::Slide { .. } | JointKindTemplate::Yoke { .. } | JointKindTemplate::Rack { .. })
}

/// Whether a joint is that of the input.
fn is_input(kind: &JointKindTemplate) -> bool {
    matches!(
        kind,
        JointKindTemplate::Crank { .. } | JointKindTemplate::Piston { .. } | JointKindTemplate::DrivenSlider { .. }
    )
}

/// Checks that a linkage has one input, which may be a distance in its drawing, and that its gears are geared to it.
fn check_inputs(
    entries: &[Entry],
    parsed: &[Option<JointKindTemplate>],
    is_driven: bool,
    table: Span,
    parser: &mut TomlParser,
) {
    let inputs: Vec<usize> = (0..parsed.len()).filter(|&k| parsed[k].as_ref().is_some_and(is_input)).collect();
    // A joint that could not be parsed may be the input.
    if inputs.is_empty() && !is_driven && parsed.iter().all(Option::is_some) {
        let problem = Problem::error(table, "the linkage has no input");
        let help = match parsed.iter().flatten().any(is_sliding) {
            true => {
                "add a crank, as in { crank = \"O\", length = 1 }, an actuator, as in { piston = [\"C\", \"O\"], length = 1 }, or a \
                 slider that is driven, as in { slider = [\"P\", \"Q\"] }"
            }
            false => "add a crank, as in { crank = \"O\", length = 1 }",
        };
        parser.report(problem.with_help(help));
    }
    for &k in inputs.iter().skip(usize::from(!is_driven)) {
        let first = match is_driven {
            true => "the distance that drives the drawing".to_owned(),
            false => format!("`{}`", entries[inputs[0]].name),
        };
        let message = format!("`{}` is a second input in addition to {first}", entries[k].name);
        let problem = Problem::error(entries[k].span.clone(), message);
        let help = "a linkage of one degree of freedom has one input; place the other joints by dyads or gears";
        parser.report(problem.with_help(help));
    }
    for (k, placing) in parsed.iter().enumerate() {
        let (Some(JointKindTemplate::Gear { crank, .. }) | Some(JointKindTemplate::Rack { crank, .. })) = placing
        else {
            continue;
        };
        if !matches!(parsed[*crank], Some(JointKindTemplate::Crank { .. }) | None) {
            let message =
                format!("`{}` is geared to `{}`, which is not a crank", entries[k].name, entries[*crank].name);
            let problem = Problem::error(entries[k].span.clone(), message);
            parser.report(problem.with_help("name the pin of the crank that drives the linkage"));
        }
    }
}

/// Checks that no joint beside a drawing with joints that no dyads place is one that can be on two sides.
fn check_beside_group(entries: &[Entry], placings: &[JointKindTemplate], parser: &mut TomlParser) {
    for (entry, placing) in entries.iter().zip(placings) {
        let has_sides = matches!(
            placing,
            JointKindTemplate::Dyad { .. } | JointKindTemplate::Slide { .. } | JointKindTemplate::Slot { .. }
        );
        if has_sides {
            let message =
                format!("`{}` is placed by a dyad, beside a drawing with joints that no dyads place", entry.name);
            let problem = Problem::error(entry.span.clone(), message);
            parser.report(problem.with_help("put the joint and its links into the drawing"));
        }
    }
}

/// Checks that no joint is placed from a grid of points, which has more than one position.
fn check_grids(entries: &[Entry], placings: &[JointKindTemplate], parser: &mut TomlParser) {
    let is_grid = |k: usize| match &placings[k] {
        JointKindTemplate::Point { along, across, .. } => {
            matches!(along, Coordinate::Range { .. }) || matches!(across, Coordinate::Range { .. })
        }
        _ => false,
    };
    for (k, placing) in placings.iter().enumerate() {
        for base in placing.referenced_joints().into_iter().filter(|&base| is_grid(base)) {
            let (name, grid) = (entries[k].name, entries[base].name);
            let problem =
                Problem::error(entries[k].span.clone(), format!("`{name}` is placed from `{grid}`, a grid of points"));
            parser.report(problem.with_help("a grid can only be traced; place the joint from a single point"));
        }
    }
}

/// The joints each joint is placed from: those it names, and, for a point of the link that carries a slot's line or of the block that the line
/// slides through, the slot's foot, which the point does not name but which creates that link. Actuators and sliders are named.
fn dependencies(placings: &[JointKindTemplate]) -> Vec<Vec<usize>> {
    let mut slots: HashMap<[usize; 2], usize> = HashMap::new();
    for (k, placing) in placings.iter().enumerate() {
        if let JointKindTemplate::Slot { base, .. } = placing {
            slots.entry(*base).or_insert(k);
        }
    }
    let needs = |placing: &JointKindTemplate| {
        let mut needs = placing.referenced_joints();
        if let JointKindTemplate::Point { base, .. } | JointKindTemplate::Distances { base, .. } = placing {
            needs.extend(slots.get(base).or_else(|| slots.get(&[base[1], base[0]])));
        }
        needs
    };
    placings.iter().map(needs).collect()
}

/// An order in which every joint comes after those it is placed from; the order as written, if it is one.
fn order_joints(entries: &[Entry], needs: &[Vec<usize>], parser: &mut TomlParser) -> Option<Vec<usize>> {
    match dependency_order(needs.len(), |k| needs[k].clone()) {
        Ok(order) => Some(order),
        Err(DependencyCycle { cycle, unresolved }) => {
            let names = |joints: &[usize]| joints.iter().map(|&k| format!("`{}`", entries[k].name)).collect::<Vec<_>>();
            let (cycle_names, unresolved) = (names(&cycle), names(&unresolved));
            let first = &cycle_names[0];
            let problem =
                Problem::error(entries[cycle[0]].span.clone(), format!("the joint {first} is placed from itself"));
            let help = if cycle.len() <= 2 {
                format!("{first} needs its own position; place it from joints already placed")
            } else {
                format!(
                    "the cycle is {}: no chain of dyads solves this linkage, and {} remain unsolved; \
                     place one of them from joints already placed",
                    cycle_names.join(" -> "),
                    unresolved.join(", ")
                )
            };
            parser.report(problem.with_help(help));
            None
        }
    }
}

/// Checks that every joint is traced, is in `seen_from`, `output_link` or `load` (the joints `named`), carries another joint, or
/// has a link: a parallelogram may be there for its links alone.
fn check_unused(
    entries: &[Entry],
    placings: &[JointKindTemplate],
    needs: &[Vec<usize>],
    traced: &[usize],
    named: &[usize],
    parser: &mut TomlParser,
) {
    let mut is_used = vec![false; placings.len()];
    let used = needs.iter().flatten().chain(traced).chain(named);
    used.for_each(|&k| is_used[k] = true);
    for (k, Entry { name, name_span, is_drawn, .. }) in entries.iter().enumerate() {
        let has_links = matches!(
            placings[k],
            JointKindTemplate::Crank { .. }
                | JointKindTemplate::Piston { .. }
                | JointKindTemplate::DrivenSlider { .. }
                | JointKindTemplate::Parallelogram { .. }
        );
        if !is_used[k] && !has_links && !is_drawn {
            let problem = Problem::error(name_span.clone(), format!("the joint `{name}` is not used"));
            parser.report(problem.with_help(format!("trace it, place another joint from it, or remove `{name}`")));
        }
    }
}

/// Checks that the traced joints depend on the driven one, if there is one, without which they do not move. With `seen_from` this does
/// not apply: relative to a moving link, fixed joints move.
fn check_traced_joints_move(
    entries: &[Entry],
    placings: &[JointKindTemplate],
    needs: &[Vec<usize>],
    order: &[usize],
    traced: &[usize],
    parser: &mut TomlParser,
) {
    if !placings.iter().any(is_input) {
        return;
    }
    let mut moves = vec![false; placings.len()];
    for &k in order {
        let is_geared = matches!(
            placings[k],
            JointKindTemplate::Gear { .. } | JointKindTemplate::Rack { .. } | JointKindTemplate::Grouped { .. }
        );
        let is_driven = is_input(&placings[k]) || is_geared;
        moves[k] = is_driven || needs[k].iter().any(|&need| moves[need]);
    }
    for &k in traced.iter().filter(|&&k| !moves[k]) {
        let (name, span) = (entries[k].name, entries[k].name_span.clone());
        let problem = Problem::error(span, format!("the traced joint `{name}` does not move"));
        parser.report(problem.with_help("trace a joint that depends on the driven one"));
    }
}
