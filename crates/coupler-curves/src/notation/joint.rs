//! One joint: how it is placed, and its numbers.

use super::fields::Fields;
use super::form::Table;
use super::kinds::{KINDS, MAX_POINTS, RANGE, SIDES, WAYS};
use super::reader::{Reader, Value};
use crate::expression::{Bound, Kind};
use crate::problem::{Problem, nearest_or_all};
use crate::template::{Coordinate, InputValue, Placing, Side};

/// How a joint is placed; `names` are those of all joints, `scope` the parameters.
pub(super) fn joint<'t>(
    name: &str,
    value: &Value<'t>,
    names: &[&str],
    scope: &[(&str, Kind)],
    reader: &mut Reader<'t>,
) -> Option<Placing> {
    let open = Fields::open(value, "a joint", reader)?;
    let given = |(kind, _): &&(&str, Table)| open.get(kind).is_some();
    let Some((kind, form)) = KINDS.iter().find(given) else {
        let problem = Problem::error(open.span.clone(), format!("the joint `{name}` does not say how it is placed"));
        reader.note(problem.help("it is `fixed`, a `crank`, `gear`, `piston`, `dyad`, `slide`, `yoke`, `slot`, `parallelogram` or `point`, as in { dyad = [\"A\", \"C\"], lengths = [2, 3], side = \"left\" }"));
        return None;
    };
    let fields = Fields::of(value, form, reader)?;
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
            let length = length(&fields, scope, reader);
            Some(Placing::Crank { pivot: pivot?, length: length? })
        }
        "gear" => {
            let crank = fields.get("gear").and_then(|value| reference(value, names, reader));
            let pivot =
                fields.required("about", "about = \"P\"", reader).and_then(|value| reference(value, names, reader));
            let length = length(&fields, scope, reader);
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
            let length = length(&fields, scope, reader);
            let (offset, side) = (offset(&fields, scope, reader), side(&fields, &SIDES, reader));
            Some(Placing::Piston { base: base?, length: length?, offset: offset?, side: side? })
        }
        "dyad" => {
            let base = fields.get("dyad").and_then(|value| base(value, names, reader));
            let lengths = two("lengths", reader);
            if let Some(values) = fields.get("lengths").and_then(|value| value.get_ref().as_array()) {
                lengths.iter().flatten().zip(values).for_each(|(length, value)| positive(length, value, reader));
            }
            let side = side(&fields, &SIDES, reader);
            Some(Placing::Dyad { base: base?, lengths: lengths?, side: side? })
        }
        "slide" => {
            let from = fields.get("slide").and_then(|value| reference(value, names, reader));
            let length = length(&fields, scope, reader);
            let line = fields.required("line", "line = [\"P\", \"Q\"]", reader).and_then(|v| base(v, names, reader));
            let offset = offset(&fields, scope, reader);
            let side = side(&fields, &WAYS, reader);
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
            // Without offset the line points from pivot to joint at the start, whatever the side.
            let is_given = fields.get("offset").is_some() || fields.get("side").is_some();
            let side = if is_given { side(&fields, &SIDES, reader) } else { Some(Side::Right) };
            Some(Placing::Slot { base: base?, offset: offset?, side: side? })
        }
        "parallelogram" => {
            let corners = fields.get("parallelogram").and_then(|value| corners(value, names, reader));
            Some(Placing::Parallelogram { corners: corners? })
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
    let fields = Fields::of(value, &RANGE, reader)?;
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

fn side<'t>(fields: &Fields<'_, 't>, words: &[(&str, Side)], reader: &mut Reader<'t>) -> Option<Side> {
    let value = fields.required("side", &format!("side = \"{}\"", words[0].0), reader)?;
    reader.word(value, words)
}

/// The length of a link.
fn length<'t>(fields: &Fields<'_, 't>, scope: &[(&str, Kind)], reader: &mut Reader<'t>) -> Option<Bound> {
    let value = fields.required("length", "length = 1", reader)?;
    let length = reader.bound(value, scope)?;
    positive(&length, value, reader);
    Some(length)
}

/// A length that is the same in every cell is told of here, the others with their cells.
fn positive<'t>(length: &Bound, value: &Value<'t>, reader: &mut Reader<'t>) {
    let number = length.evaluate(|_| f64::NAN);
    if number <= 0.0 {
        let problem = Problem::error(value.span(), format!("a link of length {number} is none"));
        reader.note(problem.help("give a length of more than 0"));
    }
}

/// The offset of a line, 0 where none is given.
fn offset<'t>(fields: &Fields<'_, 't>, scope: &[(&str, Kind)], reader: &mut Reader<'t>) -> Option<Bound> {
    match fields.get("offset") {
        None => Some(Bound::constant(0.0)),
        Some(value) => reader.bound(value, scope),
    }
}

/// A joint by its name.
pub(super) fn reference<'t>(value: &Value<'t>, names: &[&str], reader: &mut Reader<'t>) -> Option<usize> {
    let name = reader.text(value)?;
    let found = names.iter().position(|n| *n == name);
    if found.is_none() {
        let problem = Problem::error(value.span(), format!("there is no joint `{name}`"));
        reader.note(problem.help(nearest_or_all(&name, names)));
    }
    found
}

/// Three different joints by their names.
fn corners<'t>(value: &Value<'t>, names: &[&str], reader: &mut Reader<'t>) -> Option<[usize; 3]> {
    let list = reader.list(value)?;
    let [a, b, c] = list else {
        let problem =
            Problem::error(value.span(), format!("a parallelogram is placed from 3 joints, not {}", list.len()));
        reader.note(problem.help("name its other corners in order, as in parallelogram = [\"C\", \"O\", \"A\"]"));
        return None;
    };
    let [a, b, c] = [a, b, c].map(|value| reference(value, names, reader));
    let corners = [a?, b?, c?];
    let twice = (0..3).find(|&k| corners[..k].contains(&corners[k]));
    if let Some(k) = twice {
        let problem = Problem::error(list[k].span(), format!("`{}` is named twice", names[corners[k]]));
        reader.note(problem.help("name three different joints"));
        return None;
    }
    Some(corners)
}

/// Two different joints by their names.
pub(super) fn base<'t>(value: &Value<'t>, names: &[&str], reader: &mut Reader<'t>) -> Option<[usize; 2]> {
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
