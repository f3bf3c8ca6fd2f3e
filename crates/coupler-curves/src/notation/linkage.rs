use super::fields::Fields;
use super::form::{Form, Key, Table, words};
use super::joints;
use super::kinds::KINDS;
use super::reader::{Reader, Value};
use crate::expression::Kind;
use crate::problem::{Problem, Span};
use crate::template::{Circuits, Coincident, Continuation, InputValue, Parameter, Placement, Template};

/// The name of a joint.
const JOINT: Form = Form::Text;

/// A `[[linkage]]`.
pub(super) static LINKAGE: Table = Table::new(
    "a [[linkage]]",
    &[
        Key::required("id", Form::Slug, "Its name, by which families call it; none of the catalogue's."),
        Key::new("source", Form::Text, "Where it comes from: a book, a paper.").or("\"\""),
        Key::new("legend", Form::Text, "What its parameters are, in a line under the title.").or("\"\""),
        Key::new("parameters", Form::Names(&Form::Table(&PARAMETER)), "Its parameters, by their names.").or("{}"),
        Key::new("caption", Form::Text, "The line under a cell, with values in braces: \"p = {p:.2}\"."),
        Key::new("note", Form::Text, "A second, smaller line, with values in braces."),
        Key::required("trace", Form::Set(&JOINT, [1, usize::MAX]), "The joints whose curves are drawn."),
        Key::required("joints", Form::Entries(&Form::Kinds(&KINDS)), "Its joints, by their names, in any order."),
        CIRCUITS_KEY.or("\"start\""),
        CONTINUATION_KEY.or("\"smooth\""),
        COINCIDENT_KEY.or("\"together\""),
        Key::new("start", Form::Input, "The value of the input at which the sides of the joints hold."),
        Key::new("input", Form::Table(&INPUT), "How far the input goes; as far as the linkage lets it where left out."),
        Key::new(
            "seen_from",
            Form::Set(&JOINT, [2, 2]),
            "Two joints of a link in whose frame everything is reported: its origin, and a joint on its x-axis.",
        ),
        Key::new(
            "arc",
            Form::Table(&ARC),
            "The part of the curve that is drawn in full weight; all of it where left out.",
        ),
    ],
);

/// Which circuits are drawn.
pub const CIRCUITS_KEY: Key = Key::new(
    "circuits",
    Form::Word(|| words(&CIRCUITS)),
    "Which circuits are drawn: the one through the start pose, or all.",
);
/// How a circuit goes on at a change point.
pub const CONTINUATION_KEY: Key = Key::new(
    "continuation",
    Form::Word(|| words(&CONTINUATIONS)),
    "How a circuit goes on at a change point: smoothly, or on its branch.",
);
/// What dyads do that lie flat at one input.
pub const COINCIDENT_KEY: Key = Key::new(
    "coincident",
    Form::Word(|| words(&COINCIDENTS)),
    "Which of the dyads that lie flat at one input change their sides there.",
);

static PARAMETER: Table = Table::new(
    "a parameter",
    &[
        Key::new("default", Form::Number, "Its value where a family gives none; it may use other parameters."),
        Key::new("min", Form::Number, "The least value; a least of 0 is itself too little."),
        Key::new("max", Form::Number, "The greatest value; a greatest of 0 is itself too great."),
    ],
);

const FROM: Key = Key::required("from", Form::Input, "Where it begins.");
const TO: Key = Key::required("to", Form::Input, "Where it ends.");
static INPUT: Table = Table::new("an input", &[FROM, TO]);
static ARC: Table = Table::new(
    "an arc",
    &[FROM, TO, Key::new("branch", Form::Within([-1.0, 1.0]), "The branch it is on: 1 is left, -1 right.").or("1")],
);

/// The words for [`Circuits`].
pub const CIRCUITS: [(&str, Circuits); 2] = [("start", Circuits::Start), ("all", Circuits::All)];

/// The words for [`Continuation`].
pub const CONTINUATIONS: [(&str, Continuation); 2] =
    [("smooth", Continuation::Smooth), ("branch", Continuation::Branch)];

/// The words for [`Coincident`].
pub const COINCIDENTS: [(&str, Coincident); 3] =
    [("together", Coincident::Together), ("first", Coincident::First), ("last", Coincident::Last)];

/// The template a `[[linkage]]` table describes; `None` where a problem stands in the way of it.
pub fn template<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<Template> {
    let before = reader.noted();
    let fields = Fields::of(value, &LINKAGE, reader)?;
    let id = fields.required("id", "id = \"my-linkage\"", reader).and_then(|value| slug(value, reader));
    let parameters = fields.get("parameters").map(|value| parameters(value, reader)).unwrap_or_default();
    let scope: Vec<(&str, Kind)> = parameters.iter().map(|p| (p.name.as_str(), Kind::Number)).collect();
    let text = |key: &str, reader: &mut Reader<'t>| fields.get(key).and_then(|value| reader.text(value));
    let source = text("source", reader).unwrap_or_default();
    let legend = text("legend", reader).unwrap_or_default();
    let caption = fields.get("caption").and_then(|value| reader.caption(value, &scope, &[]));
    let note = fields.get("note").and_then(|value| reader.caption(value, &scope, &[]));
    let circuits = fields.get("circuits").and_then(|value| reader.word(value, &CIRCUITS)).unwrap_or_default();
    let continuation =
        fields.get("continuation").and_then(|value| reader.word(value, &CONTINUATIONS)).unwrap_or_default();
    let coincident = fields.get("coincident").and_then(|value| reader.word(value, &COINCIDENTS)).unwrap_or_default();
    let is_length = joints::has_piston(&fields);
    let start = fields.get("start").and_then(|value| reader.input(value, is_length, &scope));
    let input = fields.get("input").and_then(|value| range(value, &INPUT, (is_length, &scope), reader));
    let arc = fields.get("arc").and_then(|value| arc(value, (is_length, &scope), reader));
    let joints = fields
        .required("joints", "a table [linkage.joints]", reader)
        .and_then(|value| joints::read(value, &fields, &scope, reader));
    let (id, joints) = (id?, joints?);
    let template = Template {
        id,
        source,
        legend,
        caption,
        note,
        joints: joints.joints,
        traced: joints.traced,
        seen_from: joints.seen_from,
        placement: Placement::default(),
        circuits,
        continuation,
        coincident,
        start,
        input,
        arc,
        parameters,
    };
    if let Some(error) = template.structural_error() {
        let place = joints.places.iter().find(|(name, _)| name == error.joint()).map(|(_, span)| span.clone());
        let span = place.or_else(|| fields.get("seen_from").map(Value::span)).unwrap_or_else(|| fields.span.clone());
        reader.note(Problem::error(span, error.to_string()).help(error.help()));
    }
    (reader.noted() == before).then_some(template)
}

/// A name for folders and files: lower-case letters, digits and single hyphens, and no device of Windows.
pub fn slug<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Option<String> {
    let text = reader.text(value)?;
    let parts_are_plain = text
        .split('-')
        .all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit()));
    if is_device(&text) {
        let problem =
            Problem::error(value.span(), format!("Windows has no folder `{text}`, for it has a device of that name"));
        reader.note(problem.help(format!("an id names folders and files: take another, as in \"{text}-1\"")));
        return None;
    }
    if parts_are_plain && text.len() <= 64 {
        return Some(text);
    }
    let lower = text.to_lowercase();
    let words: Vec<&str> = lower.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty()).collect();
    let suggestion = if words.is_empty() { "evans".to_owned() } else { words.join("-").chars().take(64).collect() };
    let problem = Problem::error(value.span(), format!("the id `{}` is not a slug", text.escape_debug()));
    reader.note(
        problem.help(format!(
            "it names folders and files: lower-case letters, digits and hyphens, as in \"{suggestion}\""
        )),
    );
    None
}

/// Whether Windows keeps a name for a device (Microsoft, *Naming files, paths, and namespaces*).
fn is_device(name: &str) -> bool {
    let port = name.strip_prefix("com").or_else(|| name.strip_prefix("lpt"));
    let is_port = port.is_some_and(|number| number.len() == 1 && number.bytes().all(|b| b.is_ascii_digit()));
    is_port || ["con", "prn", "aux", "nul"].contains(&name)
}

fn parameters<'t>(value: &Value<'t>, reader: &mut Reader<'t>) -> Vec<Parameter> {
    let Some(table) = Fields::open(value, "`parameters`", reader) else { return Vec::new() };
    let names = table.keys();
    let scope: Vec<(&str, Kind)> = names.iter().map(|name| (*name, Kind::Number)).collect();
    let mut out = Vec::new();
    for (name, span, value) in table.entries() {
        check_name(name, span, reader);
        let Some(fields) = Fields::of(value, &PARAMETER, reader) else { continue };
        let default = fields.get("default").and_then(|value| {
            let expression = reader.expression(value)?;
            let bound = expression.bind(&scope, Kind::Number);
            reader.placed(value, bound).map(|_| expression)
        });
        let limit = |key, reader: &mut Reader<'t>| fields.get(key).and_then(|value| reader.constant(value));
        let (min, max) = (limit("min", reader), limit("max", reader));
        if let (Some(min), Some(max)) = (min, max)
            && min > max
        {
            let problem =
                Problem::error(fields.span.clone(), format!("the least value {min} is above the greatest {max}"));
            reader.note(problem.help("exchange `min` and `max`"));
        }
        out.push(Parameter { name: name.to_owned(), default, min, max });
    }
    out
}

/// Whether a parameter, helper or grid name can be used in an expression.
pub fn check_name(name: &str, span: Span, reader: &mut Reader) {
    let first = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    let is_word = first && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let is_taken = ["and", "or", "not", "pi"].contains(&name);
    if !is_word || is_taken {
        let why = if is_taken { "has a meaning of its own" } else { "cannot be used in an expression" };
        let problem = Problem::error(span, format!("the name `{}` {why}", name.escape_debug()));
        reader.note(problem.help("a name is a letter, then letters, digits and underscores"));
    }
}

fn range<'t>(
    value: &Value<'t>,
    form: &'static Table,
    (is_length, scope): (bool, &[(&str, Kind)]),
    reader: &mut Reader<'t>,
) -> Option<[InputValue; 2]> {
    let fields = Fields::of(value, form, reader)?;
    let mut angle = |key| {
        let value = fields.required(key, &format!("{key} = \"90 deg\""), reader)?;
        reader.input(value, is_length, scope)
    };
    let (from, to) = (angle("from"), angle("to"));
    Some([from?, to?])
}

fn arc<'t>(
    value: &Value<'t>,
    scope: (bool, &[(&str, Kind)]),
    reader: &mut Reader<'t>,
) -> Option<([InputValue; 2], i8)> {
    let angles = range(value, &ARC, scope, reader)?;
    let fields = Fields::open(value, "an arc", reader)?;
    let branch = match fields.get("branch") {
        None => 1,
        Some(branch) => match reader.constant(branch)? {
            1.0 => 1,
            -1.0 => -1,
            _ => {
                reader.note(Problem::error(branch.span(), "a branch is 1 or -1").help("1 is left, -1 right"));
                return None;
            }
        },
    };
    Some((angles, branch))
}
