//! One joint: how it is placed, and its numbers.

use super::fields::Fields;
use super::joint_kinds::{JOINT_KINDS, MAX_GRID_POINTS, RANGE, SIDES, SLIDE_SIDES};
use super::schema::TableSchema;
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::{CompiledExpression, Kind};
use crate::problem::{Problem, suggestion};
use crate::template::{Coordinate, InputValue, JointKindTemplate, Side};

/// How a joint is placed; `names` are those of all joints, `scope` the parameters.
pub(super) fn parse_joint<'t>(
    name: &str,
    value: &TomlValue<'t>,
    names: &[&str],
    scope: &[(&str, Kind)],
    reader: &mut TomlParser<'t>,
) -> Option<JointKindTemplate> {
    let open = Fields::with_any_keys(value, "a joint", reader)?;
    let given = |(kind, _): &&(&str, TableSchema)| open.get(kind).is_some();
    let Some((kind, form)) = JOINT_KINDS.iter().find(given) else {
        let problem = Problem::error(open.span.clone(), format!("the joint `{name}` does not say how it is placed"));
        reader.report(problem.with_help("it is `fixed`, a `crank`, `gear`, `piston`, `dyad`, `slide`, `yoke`, `slot`, `parallelogram` or `point`, as in { dyad = [\"A\", \"C\"], lengths = [2, 3], side = \"left\" }"));
        return None;
    };
    let fields = Fields::from_value(value, form, reader)?;
    let two = |key: &str, reader: &mut TomlParser<'t>| {
        let value = fields.required(key, &format!("{key} = [2, 3]"), reader)?;
        let [a, b] = reader.pair(value)?;
        let (a, b) = (reader.numeric_expression(a, scope), reader.numeric_expression(b, scope));
        Some([a?, b?])
    };
    match *kind {
        "fixed" => Some(JointKindTemplate::Fixed(two("fixed", reader)?)),
        "crank" => {
            let pivot = fields.get("crank").and_then(|value| parse_joint_ref(value, names, reader));
            let length = parse_length(&fields, scope, reader);
            Some(JointKindTemplate::Crank { pivot: pivot?, length: length? })
        }
        "gear" => {
            let crank = fields.get("gear").and_then(|value| parse_joint_ref(value, names, reader));
            let pivot = fields
                .required("about", "about = \"P\"", reader)
                .and_then(|value| parse_joint_ref(value, names, reader));
            let length = parse_length(&fields, scope, reader);
            let ratio =
                fields.required("ratio", "ratio = [2, 3]", reader).and_then(|value| parse_ratio(value, scope, reader));
            let phase = match fields.get("phase") {
                None => Some(InputValue { value: CompiledExpression::constant(0.0), unit: None }),
                Some(value) => reader.angle(value, scope),
            };
            Some(JointKindTemplate::Gear {
                crank: crank?,
                pivot: pivot?,
                length: length?,
                ratio: ratio?,
                phase: phase?,
            })
        }
        "piston" => {
            let base = fields.get("piston").and_then(|value| parse_joint_pair(value, names, reader));
            let length = parse_length(&fields, scope, reader);
            let (offset, side) = (parse_offset(&fields, scope, reader), parse_side(&fields, &SIDES, reader));
            Some(JointKindTemplate::Piston { base: base?, length: length?, offset: offset?, side: side? })
        }
        "dyad" => {
            let base = fields.get("dyad").and_then(|value| parse_joint_pair(value, names, reader));
            let lengths = two("lengths", reader);
            if let Some(values) = fields.get("lengths").and_then(|value| value.get_ref().as_array()) {
                lengths.iter().flatten().zip(values).for_each(|(length, value)| check_positive(length, value, reader));
            }
            let side = parse_side(&fields, &SIDES, reader);
            Some(JointKindTemplate::Dyad { base: base?, lengths: lengths?, side: side? })
        }
        "slide" => {
            let from = fields.get("slide").and_then(|value| parse_joint_ref(value, names, reader));
            let length = parse_length(&fields, scope, reader);
            let line = fields
                .required("line", "line = [\"P\", \"Q\"]", reader)
                .and_then(|v| parse_joint_pair(v, names, reader));
            let offset = parse_offset(&fields, scope, reader);
            let side = parse_side(&fields, &SLIDE_SIDES, reader);
            Some(JointKindTemplate::Slide { from: from?, length: length?, line: line?, offset: offset?, side: side? })
        }
        "yoke" => {
            let from = fields.get("yoke").and_then(|value| parse_joint_ref(value, names, reader));
            let line = fields
                .required("line", "line = [\"P\", \"Q\"]", reader)
                .and_then(|v| parse_joint_pair(v, names, reader));
            let offset = parse_offset(&fields, scope, reader);
            let angle = match fields.get("angle") {
                None => Some(InputValue { value: CompiledExpression::constant(90.0), unit: None }),
                Some(value) => reader.angle(value, scope),
            };
            Some(JointKindTemplate::Yoke { from: from?, line: line?, offset: offset?, angle: angle? })
        }
        "slot" => {
            let base = fields.get("slot").and_then(|value| parse_joint_pair(value, names, reader));
            let offset = parse_offset(&fields, scope, reader);
            // Without offset the line points from pivot to joint at the start, whatever the side.
            let is_given = fields.get("offset").is_some() || fields.get("side").is_some();
            let side = if is_given { parse_side(&fields, &SIDES, reader) } else { Some(Side::Right) };
            Some(JointKindTemplate::Slot { base: base?, offset: offset?, side: side? })
        }
        "parallelogram" => {
            let corners = fields.get("parallelogram").and_then(|value| parse_corners(value, names, reader));
            Some(JointKindTemplate::Parallelogram { corners: corners? })
        }
        "distances" => {
            let base = fields
                .required("point", "point = [\"A\", \"B\"]", reader)
                .and_then(|v| parse_joint_pair(v, names, reader));
            let distances = two("distances", reader);
            let side = parse_side(&fields, &SIDES, reader);
            Some(JointKindTemplate::Distances { base: base?, distances: distances?, side: side? })
        }
        _ => {
            let base = fields.get("point").and_then(|value| parse_joint_pair(value, names, reader));
            let mut coordinate = |key: &str| match fields.get(key) {
                None => Some(Coordinate::Single(
                    crate::expression::Expression::constant(0.0).compile(&[], Kind::Number).ok()?,
                )),
                Some(value) => parse_coordinate(value, scope, reader),
            };
            let (along, across) = (coordinate("along"), coordinate("across"));
            let (along, across) = (along?, across?);
            if along.count().saturating_mul(across.count()) > MAX_GRID_POINTS {
                let problem = Problem::error(fields.span.clone(), format!("the grid `{name}` has too many points"));
                reader.report(problem.with_help(format!("{MAX_GRID_POINTS} is the most")));
                return None;
            }
            Some(JointKindTemplate::Point { base: base?, along, across })
        }
    }
}

fn parse_coordinate<'t>(
    value: &TomlValue<'t>,
    scope: &[(&str, Kind)],
    reader: &mut TomlParser<'t>,
) -> Option<Coordinate> {
    if value.get_ref().as_table().is_none() {
        return reader.numeric_expression(value, scope).map(Coordinate::Single);
    }
    let fields = Fields::from_value(value, &RANGE, reader)?;
    let mut end = |key: &str| {
        fields.required(key, &format!("{key} = 1"), reader).and_then(|v| reader.numeric_expression(v, scope))
    };
    let (from, to) = (end("from"), end("to"));
    let count = fields.required("count", "count = 5", reader).and_then(|v| reader.integer(v, 1, MAX_GRID_POINTS));
    Some(Coordinate::Range { from: from?, to: to?, count: count? })
}

/// Two whole numbers that are not 0; those that come of parameters are checked with their values.
fn parse_ratio<'t>(
    value: &TomlValue<'t>,
    scope: &[(&str, Kind)],
    reader: &mut TomlParser<'t>,
) -> Option<[CompiledExpression; 2]> {
    let [a, b] = reader.pair(value)?;
    let mut whole = |value: &TomlValue<'t>| {
        let bound = reader.numeric_expression(value, scope)?;
        let number = bound.evaluate(|_| f64::NAN);
        if number.is_nan() || number.fract() == 0.0 && (1.0..=100.0).contains(&number.abs()) {
            return Some(bound);
        }
        let problem = Problem::error(value.span(), format!("{number} makes no gear ratio"));
        reader.report(problem.with_help("give whole numbers from 1 to 100; a negative one turns the other way"));
        None
    };
    let (a, b) = (whole(a), whole(b));
    Some([a?, b?])
}

fn parse_side<'t>(fields: &Fields<'_, 't>, words: &[(&str, Side)], reader: &mut TomlParser<'t>) -> Option<Side> {
    let value = fields.required("side", &format!("side = \"{}\"", words[0].0), reader)?;
    reader.word(value, words)
}

/// The length of a link.
fn parse_length<'t>(
    fields: &Fields<'_, 't>,
    scope: &[(&str, Kind)],
    reader: &mut TomlParser<'t>,
) -> Option<CompiledExpression> {
    let value = fields.required("length", "length = 1", reader)?;
    let length = reader.numeric_expression(value, scope)?;
    check_positive(&length, value, reader);
    Some(length)
}

/// A length that is the same in every cell is told of here, the others with their cells.
fn check_positive<'t>(length: &CompiledExpression, value: &TomlValue<'t>, reader: &mut TomlParser<'t>) {
    let number = length.evaluate(|_| f64::NAN);
    if number <= 0.0 {
        let problem = Problem::error(value.span(), format!("a link of length {number} is none"));
        reader.report(problem.with_help("give a length of more than 0"));
    }
}

/// The offset of a line, 0 where none is given.
fn parse_offset<'t>(
    fields: &Fields<'_, 't>,
    scope: &[(&str, Kind)],
    reader: &mut TomlParser<'t>,
) -> Option<CompiledExpression> {
    match fields.get("offset") {
        None => Some(CompiledExpression::constant(0.0)),
        Some(value) => reader.numeric_expression(value, scope),
    }
}

/// A joint by its name.
pub(super) fn parse_joint_ref<'t>(value: &TomlValue<'t>, names: &[&str], reader: &mut TomlParser<'t>) -> Option<usize> {
    let name = reader.text(value)?;
    let found = names.iter().position(|n| *n == name);
    if found.is_none() {
        let problem = Problem::error(value.span(), format!("there is no joint `{name}`"));
        reader.report(problem.with_help(suggestion(&name, names)));
    }
    found
}

/// Three different joints by their names.
fn parse_corners<'t>(value: &TomlValue<'t>, names: &[&str], reader: &mut TomlParser<'t>) -> Option<[usize; 3]> {
    let list = reader.list(value)?;
    let [a, b, c] = list else {
        let problem =
            Problem::error(value.span(), format!("a parallelogram is placed from 3 joints, not {}", list.len()));
        reader
            .report(problem.with_help("name its other corners in order, as in parallelogram = [\"C\", \"O\", \"A\"]"));
        return None;
    };
    let [a, b, c] = [a, b, c].map(|value| parse_joint_ref(value, names, reader));
    let corners = [a?, b?, c?];
    let twice = (0..3).find(|&k| corners[..k].contains(&corners[k]));
    if let Some(k) = twice {
        let problem = Problem::error(list[k].span(), format!("`{}` is named twice", names[corners[k]]));
        reader.report(problem.with_help("name three different joints"));
        return None;
    }
    Some(corners)
}

/// Two different joints by their names.
pub(super) fn parse_joint_pair<'t>(
    value: &TomlValue<'t>,
    names: &[&str],
    reader: &mut TomlParser<'t>,
) -> Option<[usize; 2]> {
    let [a, b] = reader.pair(value)?;
    let (a, b) = (parse_joint_ref(a, names, reader), parse_joint_ref(b, names, reader));
    let (a, b) = (a?, b?);
    if a == b {
        let problem = Problem::error(value.span(), format!("`{}` is named twice", names[a]));
        reader.report(problem.with_help("name two different joints"));
        return None;
    }
    Some([a, b])
}
