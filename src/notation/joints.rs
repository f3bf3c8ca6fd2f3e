//! The `[linkage.joints]` table: read joint by joint, then put in an order in which each can be placed.

use super::reader::{Fields, Reader, Value};
use crate::expression::{Bound, Kind};
use crate::problem::{Problem, Span, nearest_or_all};
use crate::template::{Coordinate, InputValue, JointTemplate, Open, Placing, Side, dependency_order};

/// The joints of a linkage in the order they are placed.
pub(super) struct Joints {
    pub joints: Vec<JointTemplate>,
    pub traced: Vec<usize>,
    pub seen_from: Option<[usize; 2]>,
    /// Each joint's name and place in the text.
    pub places: Vec<(String, Span)>,
}

/// A way to place a joint: the key it is known by, and the keys that go with it.
const KINDS: [(&str, &[&str]); 10] = [
    ("fixed", &["fixed"]),
    ("crank", &["crank", "length"]),
    ("gear", &["gear", "about", "length", "ratio", "phase"]),
    ("piston", &["piston", "length", "offset", "side"]),
    ("dyad", &["dyad", "lengths", "side"]),
    ("slide", &["slide", "length", "line", "offset", "side"]),
    ("yoke", &["yoke", "line", "offset", "angle"]),
    ("slot", &["slot", "offset", "side"]),
    ("distances", &["point", "distances", "side"]),
    ("point", &["point", "along", "across"]),
];

/// The most points a grid in one joint may have.
const MAX_POINTS: usize = 10_000;

pub(super) fn read<'t>(
    value: &Value<'t>,
    linkage: &Fields<'_, 't>,
    scope: &[(&str, Kind)],
    reader: &mut Reader<'t>,
) -> Option<Joints> {
    let table = Fields::open(value, "`joints`", reader)?;
    let names = table.keys();
    let entries: Vec<(&str, Span, &Value<'t>)> = table.entries().collect();
    let read: Vec<Option<Placing>> =
        entries.iter().map(|(name, _, value)| joint(name, value, &names, scope, reader)).collect();
    let traced = traced(linkage, &names, reader);
    let seen_from = linkage.get("seen_from").map(|value| base(value, &names, reader));
    inputs(&entries, &read, &table, reader);
    let placings: Vec<Placing> = read.into_iter().collect::<Option<_>>()?;
    grids_are_only_traced(&entries, &placings, reader);
    let order = order(&entries, &placings, reader)?;
    let traced = traced?;
    let seen_from = match seen_from {
        None => None,
        Some(found) => Some(found?),
    };
    unused(&entries, &placings, &traced, seen_from, reader);
    let now = |joint: usize| order.iter().position(|&k| k == joint).unwrap_or(joint);
    let joints = order
        .iter()
        .map(|&k| JointTemplate { name: names[k].to_owned(), placing: placings[k].clone().renamed(now) })
        .collect();
    let places = entries.iter().map(|(name, span, _)| ((*name).to_owned(), span.clone())).collect();
    Some(Joints {
        joints,
        traced: traced.into_iter().map(now).collect(),
        seen_from: seen_from.map(|p| p.map(now)),
        places,
    })
}

fn joint<'t>(
    name: &str,
    value: &Value<'t>,
    names: &[&str],
    scope: &[(&str, Kind)],
    reader: &mut Reader<'t>,
) -> Option<Placing> {
    let open = Fields::open(value, "a joint", reader)?;
    let given = |key: &&(&str, &[&str])| open.get(key.0).is_some();
    let Some((kind, keys)) = KINDS.iter().find(given) else {
        let problem = Problem::error(open.span.clone(), format!("the joint `{name}` does not say how it is placed"));
        reader.note(problem.help("it is `fixed`, a `crank`, `gear`, `piston`, `dyad`, `slide`, `yoke`, `slot` or `point`, as in { dyad = [\"A\", \"C\"], lengths = [2, 3], side = \"left\" }"));
        return None;
    };
    let fields = Fields::of(value, &format!("a joint with `{kind}`"), keys, reader)?;
    let two = |key: &str, reader: &mut Reader<'t>| {
        let value = fields.required(key, &format!("{key} = [2, 3]"), reader)?;
        let [a, b] = reader.pair(value)?;
        let (a, b) = (reader.bound(a, scope), reader.bound(b, scope));
        Some([a?, b?])
    };
    match *kind {
        "fixed" => Some(Placing::Fixed(two("fixed", reader)?)),
        "crank" => {
            let pivot = fields.get("crank").and_then(|value| reference(value, names, reader));
            let length = fields.required("length", "length = 1", reader).and_then(|value| reader.bound(value, scope));
            Some(Placing::Crank { pivot: pivot?, length: length? })
        }
        "gear" => {
            let crank = fields.get("gear").and_then(|value| reference(value, names, reader));
            let pivot =
                fields.required("about", "about = \"P\"", reader).and_then(|value| reference(value, names, reader));
            let length = fields.required("length", "length = 1", reader).and_then(|value| reader.bound(value, scope));
            let ratio =
                fields.required("ratio", "ratio = [2, 3]", reader).and_then(|value| ratio(value, scope, reader));
            let phase = match fields.get("phase") {
                None => Some(InputValue { value: Bound::constant(0.0), unit: None }),
                Some(value) => reader.angle(value, scope),
            };
            Some(Placing::Gear { crank: crank?, pivot: pivot?, length: length?, ratio: ratio?, phase: phase? })
        }
        "piston" => {
            let base = fields.get("piston").and_then(|value| base(value, names, reader));
            let length = fields.required("length", "length = 1", reader).and_then(|value| reader.bound(value, scope));
            let (offset, side) = (offset(&fields, scope, reader), side(&fields, &SIDES, reader));
            Some(Placing::Piston { base: base?, length: length?, offset: offset?, side: side? })
        }
        "dyad" => {
            let base = fields.get("dyad").and_then(|value| base(value, names, reader));
            let lengths = two("lengths", reader);
            let side = side(&fields, &SIDES, reader);
            Some(Placing::Dyad { base: base?, lengths: lengths?, side: side? })
        }
        "slide" => {
            let from = fields.get("slide").and_then(|value| reference(value, names, reader));
            let length = fields.required("length", "length = 1", reader).and_then(|value| reader.bound(value, scope));
            let line = fields.required("line", "line = [\"P\", \"Q\"]", reader).and_then(|v| base(v, names, reader));
            let offset = offset(&fields, scope, reader);
            let side = side(&fields, &[("ahead", Side::Left), ("behind", Side::Right)], reader);
            Some(Placing::Slide { from: from?, length: length?, line: line?, offset: offset?, side: side? })
        }
        "yoke" => {
            let from = fields.get("yoke").and_then(|value| reference(value, names, reader));
            let line = fields.required("line", "line = [\"P\", \"Q\"]", reader).and_then(|v| base(v, names, reader));
            let offset = offset(&fields, scope, reader);
            let angle = match fields.get("angle") {
                None => Some(InputValue { value: Bound::constant(90.0), unit: None }),
                Some(value) => reader.angle(value, scope),
            };
            Some(Placing::Yoke { from: from?, line: line?, offset: offset?, angle: angle? })
        }
        "slot" => {
            let base = fields.get("slot").and_then(|value| base(value, names, reader));
            let offset = offset(&fields, scope, reader);
            let side = if fields.get("offset").is_some() { side(&fields, &SIDES, reader) } else { Some(Side::Left) };
            Some(Placing::Slot { base: base?, offset: offset?, side: side? })
        }
        "distances" => {
            let base = fields.required("point", "point = [\"A\", \"B\"]", reader).and_then(|v| base(v, names, reader));
            let distances = two("distances", reader);
            let side = side(&fields, &SIDES, reader);
            Some(Placing::Distances { base: base?, distances: distances?, side: side? })
        }
        _ => {
            let base = fields.get("point").and_then(|value| base(value, names, reader));
            let mut coordinate = |key: &str| match fields.get(key) {
                None => {
                    Some(Coordinate::One(crate::expression::Expression::constant(0.0).bind(&[], Kind::Number).ok()?))
                }
                Some(value) => coordinate(value, scope, reader),
            };
            let (along, across) = (coordinate("along"), coordinate("across"));
            let (along, across) = (along?, across?);
            if along.count().saturating_mul(across.count()) > MAX_POINTS {
                let problem = Problem::error(fields.span.clone(), format!("the grid `{name}` has too many points"));
                reader.note(problem.help(format!("{MAX_POINTS} is the most")));
                return None;
            }
            Some(Placing::Point { base: base?, along, across })
        }
    }
}

fn coordinate<'t>(value: &Value<'t>, scope: &[(&str, Kind)], reader: &mut Reader<'t>) -> Option<Coordinate> {
    if value.get_ref().as_table().is_none() {
        return reader.bound(value, scope).map(Coordinate::One);
    }
    let fields = Fields::of(value, "a range", &["from", "to", "count"], reader)?;
    let mut end = |key: &str| fields.required(key, &format!("{key} = 1"), reader).and_then(|v| reader.bound(v, scope));
    let (from, to) = (end("from"), end("to"));
    let count = fields.required("count", "count = 5", reader).and_then(|v| reader.count(v, 1, MAX_POINTS));
    Some(Coordinate::Range { from: from?, to: to?, count: count? })
}

/// Two whole numbers that are not 0; those that come of parameters are checked with their values.
fn ratio<'t>(value: &Value<'t>, scope: &[(&str, Kind)], reader: &mut Reader<'t>) -> Option<[Bound; 2]> {
    let [a, b] = reader.pair(value)?;
    let mut whole = |value: &Value<'t>| {
        let bound = reader.bound(value, scope)?;
        let number = bound.evaluate(|_| f64::NAN);
        if number.is_nan() || number.fract() == 0.0 && (1.0..=100.0).contains(&number.abs()) {
            return Some(bound);
        }
        let problem = Problem::error(value.span(), format!("{number} makes no gear ratio"));
        reader.note(problem.help("give whole numbers from 1 to 100; a negative one turns the other way"));
        None
    };
    let (a, b) = (whole(a), whole(b));
    Some([a?, b?])
}

/// Whether a linkage's joints have a piston among them, which makes its input a length.
pub(super) fn has_piston(linkage: &Fields) -> bool {
    let joints = linkage.get("joints").and_then(|value| value.get_ref().as_table());
    let is_piston = |joint: &Value| joint.get_ref().as_table().is_some_and(|joint| joint.contains_key("piston"));
    joints.is_some_and(|joints| joints.values().any(is_piston))
}

/// The sides of a line.
const SIDES: [(&str, Side); 2] = [("left", Side::Left), ("right", Side::Right)];

fn side<'t>(fields: &Fields<'_, 't>, words: &[(&str, Side)], reader: &mut Reader<'t>) -> Option<Side> {
    let value = fields.required("side", &format!("side = \"{}\"", words[0].0), reader)?;
    reader.word(value, words)
}

/// The offset of a line, 0 where none is given.
fn offset<'t>(fields: &Fields<'_, 't>, scope: &[(&str, Kind)], reader: &mut Reader<'t>) -> Option<Bound> {
    match fields.get("offset") {
        None => Some(Bound::constant(0.0)),
        Some(value) => reader.bound(value, scope),
    }
}

/// A joint by its name.
fn reference<'t>(value: &Value<'t>, names: &[&str], reader: &mut Reader<'t>) -> Option<usize> {
    let name = reader.text(value)?;
    let found = names.iter().position(|n| *n == name);
    if found.is_none() {
        let problem = Problem::error(value.span(), format!("there is no joint `{name}`"));
        reader.note(problem.help(nearest_or_all(&name, names)));
    }
    found
}

/// Two different joints by their names.
fn base<'t>(value: &Value<'t>, names: &[&str], reader: &mut Reader<'t>) -> Option<[usize; 2]> {
    let [a, b] = reader.pair(value)?;
    let (a, b) = (reference(a, names, reader), reference(b, names, reader));
    let (a, b) = (a?, b?);
    if a == b {
        let problem = Problem::error(value.span(), format!("`{}` is named twice", names[a]));
        reader.note(problem.help("name two different joints"));
        return None;
    }
    Some([a, b])
}

fn traced<'t>(linkage: &Fields<'_, 't>, names: &[&str], reader: &mut Reader<'t>) -> Option<Vec<usize>> {
    let value = linkage.required("trace", "trace = [\"M\"]", reader)?;
    let list = reader.list(value)?;
    if list.is_empty() {
        reader.note(Problem::error(value.span(), "no joint is traced").help("name at least one, as in [\"M\"]"));
        return None;
    }
    let found: Vec<Option<usize>> = list.iter().map(|value| reference(value, names, reader)).collect();
    let found: Vec<usize> = found.into_iter().collect::<Option<_>>()?;
    for (k, joint) in found.iter().enumerate() {
        if found[..k].contains(joint) {
            let problem = Problem::error(list[k].span(), format!("`{}` is traced twice", names[*joint]));
            reader.note(problem.help("name each joint once"));
        }
    }
    Some(found)
}

/// A linkage has one input, and its gears are geared to it.
fn inputs(entries: &[(&str, Span, &Value)], read: &[Option<Placing>], table: &Fields, reader: &mut Reader) {
    let is_input = |k: &usize| matches!(read[*k], Some(Placing::Crank { .. } | Placing::Piston { .. }));
    let inputs: Vec<usize> = (0..read.len()).filter(is_input).collect();
    // A joint that could not be read may be the input.
    if inputs.is_empty() && read.iter().all(Option::is_some) {
        let problem = Problem::error(table.span.clone(), "the linkage has no input");
        reader.note(problem.help("one joint is driven: { crank = \"O\", length = 1 }"));
    }
    for &k in inputs.iter().skip(1) {
        let (first, second) = (entries[inputs[0]].0, entries[k].0);
        let problem = Problem::error(entries[k].2.span(), format!("`{second}` is a second input beside `{first}`"));
        let help = "a linkage of one degree of freedom has one input: place the other joints by dyads or gears";
        reader.note(problem.help(help));
    }
    for (k, placing) in read.iter().enumerate() {
        let Some(Placing::Gear { crank, .. }) = placing else { continue };
        if !matches!(read[*crank], Some(Placing::Crank { .. }) | None) {
            let message = format!("`{}` is geared to `{}`, which is no crank", entries[k].0, entries[*crank].0);
            let problem = Problem::error(entries[k].2.span(), message);
            reader.note(problem.help("name the pin of the crank that drives the linkage"));
        }
    }
}

/// A grid of points has no one place that another joint could hang on.
fn grids_are_only_traced(entries: &[(&str, Span, &Value)], placings: &[Placing], reader: &mut Reader) {
    let is_grid = |k: usize| match &placings[k] {
        Placing::Point { along, across, .. } => {
            matches!(along, Coordinate::Range { .. }) || matches!(across, Coordinate::Range { .. })
        }
        _ => false,
    };
    for (k, placing) in placings.iter().enumerate() {
        for base in placing.bases().into_iter().filter(|&base| is_grid(base)) {
            let (name, grid) = (entries[k].0, entries[base].0);
            let problem =
                Problem::error(entries[k].2.span(), format!("`{name}` hangs on `{grid}`, which is a grid of points"));
            reader.note(problem.help("a grid can only be traced: hang the joint on a single point"));
        }
    }
}

/// The joints a joint is placed from: those it names, and, for a point of a link that carries a slot's line, the
/// slot's foot, without which there is no such link; an actuator's and a slider's are named.
fn needs(placings: &[Placing], k: usize) -> Vec<usize> {
    let mut bases = placings[k].bases();
    if let Placing::Point { base, .. } | Placing::Distances { base, .. } = &placings[k] {
        let carries = |other: &Placing| matches!(other, Placing::Slot { base: slot, .. } if slot == base);
        bases.extend(placings.iter().position(carries));
    }
    bases
}

/// An order in which every joint comes after those it is placed from; as written, where that is one.
fn order(entries: &[(&str, Span, &Value)], placings: &[Placing], reader: &mut Reader) -> Option<Vec<usize>> {
    match dependency_order(placings.len(), |k| needs(placings, k)) {
        Ok(order) => Some(order),
        Err(Open { cycle, all }) => {
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
            reader.note(problem.help(help));
            None
        }
    }
}

/// Every joint is traced, seen from, or carries another.
fn unused(
    entries: &[(&str, Span, &Value)],
    placings: &[Placing],
    traced: &[usize],
    seen_from: Option<[usize; 2]>,
    reader: &mut Reader,
) {
    for (k, (name, span, _)) in entries.iter().enumerate() {
        let carries = (0..placings.len()).any(|other| needs(placings, other).contains(&k));
        let is_seen = seen_from.is_some_and(|joints| joints.contains(&k));
        let is_driven = matches!(placings[k], Placing::Crank { .. } | Placing::Piston { .. });
        if !carries && !is_seen && !is_driven && !traced.contains(&k) {
            let problem = Problem::error(span.clone(), format!("the joint `{name}` is not used"));
            reader.note(problem.help(format!("trace it, hang another joint on it, or take `{name}` away")));
        }
    }
}
