//! Parses a joint: its kind and its dimensions.

use super::fields::Fields;
use super::joint_kinds::{DEFAULT_SLOT_ANGLE_DEG, JOINT_KINDS, MAX_GRID_POINTS, RANGE, SIDES, SLIDE_SIDES};
use super::names::JointNames;
use super::schema::TableSchema;
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::{CompiledExpression, Kind, Scope};
use crate::problem::{Problem, suggestion};
use crate::template::{Coordinate, InputValue, JointKindTemplate, Side};

/// Parses how a joint is placed; `names` are those of all joints, `scope` the parameters.
pub(super) fn parse_joint<'t>(
    name: &str,
    value: &TomlValue<'t>,
    names: &JointNames,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<JointKindTemplate> {
    let any_fields = Fields::with_any_keys(value, "a joint", parser)?;
    let is_present = |(kind, _): &&(&str, TableSchema)| any_fields.get(kind).is_some();
    let Some((kind, schema)) = JOINT_KINDS.iter().find(is_present) else {
        let problem =
            Problem::error(any_fields.span.clone(), format!("the joint `{name}` does not say how it is placed"));
        parser.report(problem.with_help("add one of `fixed`, `crank`, `gear`, `piston`, `dyad`, `slide`, `yoke`, `slot`, `parallelogram` or `point`, as in { dyad = [\"A\", \"C\"], lengths = [2, 3], side = \"left\" }"));
        return None;
    };
    let fields = Fields::from_value(value, schema, parser)?;
    let two = |key: &str, parser: &mut TomlParser<'t>| {
        let value = fields.required(key, &format!("{key} = [2, 3]"), parser)?;
        let [a, b] = parser.pair(value, "[1, 2]")?;
        let (a, b) = (parser.numeric_expression(a, scope), parser.numeric_expression(b, scope));
        Some([a?, b?])
    };
    match *kind {
        "fixed" => Some(JointKindTemplate::Fixed(two("fixed", parser)?)),
        "crank" => {
            let pivot = fields.get("crank").and_then(|value| parse_joint_ref(value, names, parser));
            let length = parse_length(&fields, scope, parser);
            Some(JointKindTemplate::Crank { pivot: pivot?, length: length? })
        }
        "gear" => {
            let crank = fields.get("gear").and_then(|value| parse_joint_ref(value, names, parser));
            let pivot = fields
                .required("about", "about = \"P\"", parser)
                .and_then(|value| parse_joint_ref(value, names, parser));
            let length = parse_length(&fields, scope, parser);
            let ratio =
                fields.required("ratio", "ratio = [2, 3]", parser).and_then(|value| parse_ratio(value, scope, parser));
            let phase = match fields.get("phase") {
                None => Some(InputValue { value: CompiledExpression::constant(0.0), unit: None }),
                Some(value) => parser.angle(value, scope),
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
            let base = fields.get("piston").and_then(|value| parse_joint_pair(value, names, parser));
            let length = parse_length(&fields, scope, parser);
            let (offset, side) = (parse_offset(&fields, scope, parser), parse_side(&fields, &SIDES, parser));
            Some(JointKindTemplate::Piston { base: base?, length: length?, offset: offset?, side: side? })
        }
        "dyad" => {
            let base = fields.get("dyad").and_then(|value| parse_joint_pair(value, names, parser));
            let lengths = two("lengths", parser);
            if let Some(values) = fields.get("lengths").and_then(|value| value.get_ref().as_array()) {
                lengths.iter().flatten().zip(values).for_each(|(length, value)| check_positive(length, value, parser));
            }
            let side = parse_side(&fields, &SIDES, parser);
            Some(JointKindTemplate::Dyad { base: base?, lengths: lengths?, side: side? })
        }
        "slide" => {
            let from = fields.get("slide").and_then(|value| parse_joint_ref(value, names, parser));
            let length = parse_length(&fields, scope, parser);
            let line = fields
                .required("line", "line = [\"P\", \"Q\"]", parser)
                .and_then(|v| parse_joint_pair(v, names, parser));
            let offset = parse_offset(&fields, scope, parser);
            let side = parse_side(&fields, &SLIDE_SIDES, parser);
            Some(JointKindTemplate::Slide { from: from?, length: length?, line: line?, offset: offset?, side: side? })
        }
        "yoke" => {
            let from = fields.get("yoke").and_then(|value| parse_joint_ref(value, names, parser));
            let line = fields
                .required("line", "line = [\"P\", \"Q\"]", parser)
                .and_then(|v| parse_joint_pair(v, names, parser));
            let offset = parse_offset(&fields, scope, parser);
            let angle = match fields.get("angle") {
                None => Some(InputValue { value: CompiledExpression::constant(DEFAULT_SLOT_ANGLE_DEG), unit: None }),
                Some(value) => parser.angle(value, scope),
            };
            Some(JointKindTemplate::Yoke { from: from?, line: line?, offset: offset?, angle: angle? })
        }
        "slot" => {
            let base = fields.get("slot").and_then(|value| parse_joint_pair(value, names, parser));
            let offset = parse_offset(&fields, scope, parser);
            // Without offset the line points from pivot to joint at the start, on either side.
            let needs_side = fields.get("offset").is_some() || fields.get("side").is_some();
            let side = if needs_side { parse_side(&fields, &SIDES, parser) } else { Some(Side::Right) };
            Some(JointKindTemplate::Slot { base: base?, offset: offset?, side: side? })
        }
        "parallelogram" => {
            let corners = fields.get("parallelogram").and_then(|value| parse_corners(value, names, parser));
            Some(JointKindTemplate::Parallelogram { corners: corners? })
        }
        "distances" => {
            let base = fields
                .required("point", "point = [\"A\", \"B\"]", parser)
                .and_then(|v| parse_joint_pair(v, names, parser));
            let distances = two("distances", parser);
            let side = parse_side(&fields, &SIDES, parser);
            Some(JointKindTemplate::Distances { base: base?, distances: distances?, side: side? })
        }
        _ => {
            let base = fields.get("point").and_then(|value| parse_joint_pair(value, names, parser));
            let mut coordinate = |key: &str| match fields.get(key) {
                None => Some(Coordinate::Single(
                    crate::expression::Expression::constant(0.0).compile(&Scope::default(), Kind::Number).ok()?,
                )),
                Some(value) => parse_coordinate(value, scope, parser),
            };
            let (along, across) = (coordinate("along"), coordinate("across"));
            let (along, across) = (along?, across?);
            if along.count().saturating_mul(across.count()) > MAX_GRID_POINTS {
                let problem = Problem::error(fields.span.clone(), format!("the grid `{name}` has too many points"));
                parser.report(problem.with_help(format!("a grid may have at most {MAX_GRID_POINTS}")));
                return None;
            }
            Some(JointKindTemplate::Point { base: base?, along, across })
        }
    }
}

fn parse_coordinate<'t>(value: &TomlValue<'t>, scope: &Scope, parser: &mut TomlParser<'t>) -> Option<Coordinate> {
    if value.get_ref().as_table().is_none() {
        return parser.numeric_expression(value, scope).map(Coordinate::Single);
    }
    let fields = Fields::from_value(value, &RANGE, parser)?;
    let mut end = |key: &str| {
        fields.required(key, &format!("{key} = 1"), parser).and_then(|v| parser.numeric_expression(v, scope))
    };
    let (from, to) = (end("from"), end("to"));
    let count = fields.required("count", "count = 5", parser).and_then(|v| parser.integer(v, 1, MAX_GRID_POINTS));
    Some(Coordinate::Range { from: from?, to: to?, count: count? })
}

/// Parses two whole numbers other than 0; how great they are in lowest terms is checked in each cell.
fn parse_ratio<'t>(
    value: &TomlValue<'t>,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<[CompiledExpression; 2]> {
    let [a, b] = parser.pair(value, "[1, 2]")?;
    let mut whole = |value: &TomlValue<'t>| {
        let compiled = parser.numeric_expression(value, scope)?;
        let number = compiled.evaluate(|_| f64::NAN);
        if number.is_nan() || number.fract() == 0.0 && number != 0.0 {
            return Some(compiled);
        }
        let problem = Problem::error(value.span(), format!("a gear ratio cannot contain {number}"));
        parser.report(
            problem
                .with_help("give whole numbers, from 1 to 100 in lowest terms; a negative one reverses the direction"),
        );
        None
    };
    let (a, b) = (whole(a), whole(b));
    Some([a?, b?])
}

fn parse_side<'t>(fields: &Fields<'_, 't>, words: &[(&str, Side)], parser: &mut TomlParser<'t>) -> Option<Side> {
    let value = fields.required("side", &format!("side = \"{}\"", words[0].0), parser)?;
    parser.word(value, words)
}

/// Parses the length of a link.
fn parse_length<'t>(fields: &Fields<'_, 't>, scope: &Scope, parser: &mut TomlParser<'t>) -> Option<CompiledExpression> {
    let value = fields.required("length", "length = 1", parser)?;
    let length = parser.numeric_expression(value, scope)?;
    check_positive(&length, value, parser);
    Some(length)
}

/// Reports a length that is the same in every cell and not positive; the others are checked in each cell.
fn check_positive<'t>(length: &CompiledExpression, value: &TomlValue<'t>, parser: &mut TomlParser<'t>) {
    let number = length.evaluate(|_| f64::NAN);
    if number <= 0.0 {
        let problem = Problem::error(value.span(), format!("a length must be positive, found {number}"));
        parser.report(problem.with_help("give a length greater than 0"));
    }
}

/// Parses the offset of a line; 0 by default.
fn parse_offset<'t>(fields: &Fields<'_, 't>, scope: &Scope, parser: &mut TomlParser<'t>) -> Option<CompiledExpression> {
    match fields.get("offset") {
        None => Some(CompiledExpression::constant(0.0)),
        Some(value) => parser.numeric_expression(value, scope),
    }
}

/// The index of a joint by its name.
pub(super) fn parse_joint_ref<'t>(
    value: &TomlValue<'t>,
    names: &JointNames,
    parser: &mut TomlParser<'t>,
) -> Option<usize> {
    let name = parser.text(value)?;
    let index = names.index_of(&name);
    // A joint may be in an entry that could not be read.
    if index.is_none() && !parser.has_syntax_error() {
        let problem = Problem::error(value.span(), format!("unknown joint `{name}`"));
        parser.report(problem.with_help(suggestion(&name, names.all())));
    }
    index
}

/// The indices of three different joints by their names.
fn parse_corners<'t>(value: &TomlValue<'t>, names: &JointNames, parser: &mut TomlParser<'t>) -> Option<[usize; 3]> {
    let list = parser.list(value)?;
    let [a, b, c] = list else {
        let problem =
            Problem::error(value.span(), format!("a parallelogram is placed from 3 joints, not {}", list.len()));
        parser
            .report(problem.with_help("name its other corners in order, as in parallelogram = [\"C\", \"O\", \"A\"]"));
        return None;
    };
    let [a, b, c] = [a, b, c].map(|value| parse_joint_ref(value, names, parser));
    let corners = [a?, b?, c?];
    let repeated = (0..3).find(|&k| corners[..k].contains(&corners[k]));
    if let Some(k) = repeated {
        let problem = Problem::error(list[k].span(), format!("`{}` is named twice", names.all()[corners[k]]));
        parser.report(problem.with_help("name three different joints"));
        return None;
    }
    Some(corners)
}

/// The indices of two different joints by their names.
pub(super) fn parse_joint_pair<'t>(
    value: &TomlValue<'t>,
    names: &JointNames,
    parser: &mut TomlParser<'t>,
) -> Option<[usize; 2]> {
    let [a, b] = parser.pair(value, "[\"A\", \"B\"]")?;
    let (a, b) = (parse_joint_ref(a, names, parser), parse_joint_ref(b, names, parser));
    let (a, b) = (a?, b?);
    if a == b {
        let problem = Problem::error(value.span(), format!("`{}` is named twice", names.all()[a]));
        parser.report(problem.with_help("name two different joints"));
        return None;
    }
    Some([a, b])
}
