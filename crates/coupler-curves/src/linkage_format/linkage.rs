//! The schema of a `[[linkage]]` table and its parser.

use super::drawing::DRAWING;
use super::fields::Fields;
use super::identifiers::parse_slug;
use super::joint_forms::joint_schemas;
use super::joints;
use super::load::{LOAD_KEY, parse_load, parse_load_on};
use super::parameters::{PARAMETER, parse_parameters};
use super::quantities::InputKind;
use super::schema::{KeySchema, TableSchema, ValueSchema, default_word, words};
use super::tolerance::{TOLERANCE_KEY, parse_tolerance};
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::Scope;
use crate::linkage::{self, DwellBand};
use crate::problem::Problem;
use crate::template::{
    CircuitSelection, CoincidentDyads, Continuation, InputValue, Orientation, Parameter, ParameterKind, Template,
};

/// The name of a joint.
const JOINT_NAME: ValueSchema = ValueSchema::Text;

/// The schema of a `[[linkage]]` table.
pub(super) static LINKAGE: TableSchema = TableSchema::new(
    "a [[linkage]]",
    &[
        KeySchema::required("id", ValueSchema::Slug, "Its name, which families refer to; not one of the catalogue's."),
        KeySchema::new("source", ValueSchema::Text, "Its source: a book or a paper.")
            .with_default(|| "\"\"".to_owned()),
        KeySchema::new("legend", ValueSchema::Text, "The meaning of its parameters, printed under the title.")
            .with_default(|| "\"\"".to_owned()),
        KeySchema::new(
            "parameters",
            ValueSchema::IdentifierMap(&ValueSchema::Table(&PARAMETER)),
            "Its parameters, by their names.",
        )
        .with_default(|| "{}".to_owned()),
        KeySchema::new("caption", ValueSchema::Text, "The line under a cell, with values in braces: \"p = {p:.2}\"."),
        KeySchema::new("note", ValueSchema::Text, "A second, smaller line, with values in braces."),
        KeySchema::required(
            "trace",
            ValueSchema::Set(&JOINT_NAME, [1, usize::MAX]),
            "The joints whose curves are traced.",
        ),
        KeySchema::new(
            "joints",
            ValueSchema::Map(&ValueSchema::Variants(joint_schemas)),
            "Its joints, by their names, in any order; with a drawing, further ones that are placed from it.",
        ),
        KeySchema::new(
            "drawing",
            ValueSchema::Table(&DRAWING),
            "The pose it is drawn in: joints by coordinates, and links by their joints. Dimensions and sides follow from it.",
        ),
        CIRCUITS_KEY.with_default(|| default_word(&CIRCUIT_SELECTIONS)),
        CONTINUATION_KEY.with_default(|| default_word(&CONTINUATIONS)),
        COINCIDENT_KEY.with_default(|| default_word(&COINCIDENT_DYADS)),
        KeySchema::new("start", ValueSchema::Input, "The input at which the joints are on their given sides."),
        KeySchema::new(
            "input",
            ValueSchema::Table(&INPUT),
            "The range of the input; the whole assemblable range by default.",
        ),
        KeySchema::new(
            "seen_from",
            ValueSchema::Set(&JOINT_NAME, [2, 2]),
            "Two joints of a link in whose frame everything is reported: its origin, and a joint on its x-axis.",
        ),
        KeySchema::new(
            "output_link",
            ValueSchema::AnyOf(&[JOINT_NAME, ValueSchema::Set(&JOINT_NAME, [2, 2])]),
            "The link that it drives, by two of its joints, or the slider, by its joint; the last driven link on the frame by default.",
        ),
        LOAD_KEY,
        TOLERANCE_KEY,
        KeySchema::new(
            "chains",
            ValueSchema::List(&ValueSchema::Set(&JOINT_NAME, [2, usize::MAX]), [0, usize::MAX]),
            "Parts of the linkage, such as the cognates of a four-bar, each by its joints: the links between them are drawn in an ink of their own.",
        )
        .with_default(|| "[]".to_owned()),
        KeySchema::new(
            "arc",
            ValueSchema::Table(&ARC),
            "The part of the curve that is drawn in full weight; all of it by default.",
        ),
    ],
)
.with_any_of(&["joints", "drawing"]);

/// The key that selects the circuits to solve.
pub const CIRCUITS_KEY: KeySchema = KeySchema::new(
    "circuits",
    ValueSchema::Word(|| words(&CIRCUIT_SELECTIONS)),
    "The circuits to draw: the one through the start pose, or all.",
);
/// The key that selects the way in which a circuit continues at a change point.
pub const CONTINUATION_KEY: KeySchema = KeySchema::new(
    "continuation",
    ValueSchema::Word(|| words(&CONTINUATIONS)),
    "How a circuit continues at a change point: smoothly, or on the same branch.",
);
/// The key that selects the dyads that change sides where several are flat at one input.
pub const COINCIDENT_KEY: KeySchema = KeySchema::new(
    "coincident",
    ValueSchema::Word(|| words(&COINCIDENT_DYADS)),
    "The dyads that change sides where several are flat at one input.",
);

const FROM: KeySchema = KeySchema::required("from", ValueSchema::Input, "The input at which it begins.");
const TO: KeySchema = KeySchema::required("to", ValueSchema::Input, "The input at which it ends.");
static INPUT: TableSchema = TableSchema::new("an input", &[FROM, TO]);
static ARC: TableSchema = TableSchema::new(
    "an arc",
    &[
        FROM,
        TO,
        KeySchema::new("branch", ValueSchema::InRange([-1.0, 1.0]), "The branch it is on: 1 is left, -1 right.")
            .with_default(|| "1".to_owned()),
    ],
);

/// The words for [`CircuitSelection`].
pub const CIRCUIT_SELECTIONS: [(&str, CircuitSelection); 2] =
    [("start", CircuitSelection::Start), ("all", CircuitSelection::All)];

/// The words for [`Continuation`].
pub const CONTINUATIONS: [(&str, Continuation); 2] =
    [("smooth", Continuation::Smooth), ("branch", Continuation::Branch)];

/// The words for [`CoincidentDyads`].
pub const COINCIDENT_DYADS: [(&str, CoincidentDyads); 3] =
    [("together", CoincidentDyads::Together), ("first", CoincidentDyads::First), ("last", CoincidentDyads::Last)];

/// Parses a `[[linkage]]` table, and reports its problems. With problems in its id, its texts and its settings only there is a template all the
/// same, so that families of the linkage can be checked.
pub fn parse_template<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<Template> {
    let before = parser.problem_count();
    let fields = Fields::from_value(value, &LINKAGE, parser)?;
    let parameters = fields.get("parameters").map_or(Some(Vec::new()), |value| parse_parameters(value, parser));
    match parameters.filter(|_| !fields.may_be_misspelt("parameters")) {
        Some(parameters) => parse_with_parameters(&fields, before, parameters, parser),
        None => parser.with_unknown_names(|parser| parse_with_parameters(&fields, before, Vec::new(), parser)),
    }
}

/// Parses the other keys of a linkage; `before` is the number of problems before it.
fn parse_with_parameters<'t>(
    fields: &Fields<'_, 't>,
    before: usize,
    parameters: Vec<(Parameter, bool)>,
    parser: &mut TomlParser<'t>,
) -> Option<Template> {
    let (parameters, states_unit): (Vec<Parameter>, Vec<bool>) = parameters.into_iter().unzip();
    let scope = Scope::from_numbers(parameters.iter().map(|parameter| parameter.name.as_str()));
    let input_kind = joints::input_kind(fields);
    let start = fields.get("start").and_then(|value| parser.input(value, input_kind, &scope));
    let input = fields.get("input").and_then(|value| parse_input_range(value, &INPUT, input_kind, &scope, parser));
    let joints = joints::parse_joints(fields, &scope, parser);
    let before_settings = parser.problem_count();
    let id = fields.required("id", "id = \"my-linkage\"", parser).and_then(|value| parse_slug(value, parser));
    let text = |key: &str, parser: &mut TomlParser<'t>| fields.get(key).and_then(|value| parser.text(value));
    let source = text("source", parser).unwrap_or_default();
    let legend = text("legend", parser).unwrap_or_default();
    let caption = fields.get("caption").and_then(|value| parser.caption(value, &scope, &[]));
    let note = fields.get("note").and_then(|value| parser.caption(value, &scope, &[]));
    let circuits = fields.get("circuits").and_then(|value| parser.word(value, &CIRCUIT_SELECTIONS)).unwrap_or_default();
    let continuation =
        fields.get("continuation").and_then(|value| parser.word(value, &CONTINUATIONS)).unwrap_or_default();
    let coincident =
        fields.get("coincident").and_then(|value| parser.word(value, &COINCIDENT_DYADS)).unwrap_or_default();
    let arc = fields.get("arc").and_then(|value| parse_arc(value, input_kind, &scope, parser));
    let settings_problems = parser.problem_count() - before_settings;
    if let (Some(start), Some(_)) = (fields.get("start"), fields.get("drawing")) {
        let problem = Problem::error(start.span(), "the drawing is the start of the motion");
        parser.report(problem.with_help("leave `start` out, or draw the linkage in that pose"));
    }
    let Some(joints) = joints else {
        fields.get("tolerance").and_then(|value| parse_tolerance(value, None, parser));
        fields.get("load").and_then(|value| parse_load_on(value, joints::written_names(fields), |_| false, parser));
        return None;
    };
    let mut template = Template {
        id: id.unwrap_or_default(),
        source,
        legend,
        caption,
        note,
        joints: joints.joints,
        closures: joints.closures,
        driven_elsewhere: None,
        traced: joints.traced,
        seen_from: joints.seen_from,
        output_link: joints.output_link,
        load: None,
        tolerance: None,
        dwell: DwellBand::default(),
        chains: joints.chains,
        orientation: Orientation::default(),
        circuits,
        continuation,
        coincident,
        start: start.or(joints.start),
        input,
        arc,
        parameters,
    };
    if let (Some((joints, start)), CircuitSelection::All) = (joints.driven_elsewhere, circuits) {
        let (traced, start) = ((0..joints.len()).collect(), Some(start));
        template.driven_elsewhere = Some(Box::new(Template {
            joints,
            closures: Vec::new(),
            traced,
            start,
            seen_from: None,
            output_link: None,
            chains: Vec::new(),
            input: None,
            ..template.clone()
        }));
    }
    template.tolerance = fields.get("tolerance").and_then(|value| parse_tolerance(value, Some(&template), parser));
    template.load = fields.get("load").and_then(|value| parse_load(value, Some(&template.joints), parser));
    for ((kind, states_unit), parameter) in
        template.infer_kinds().into_iter().zip(states_unit).zip(&mut template.parameters)
    {
        match (parameter.kind, kind) {
            (ParameterKind::Number, _) => parameter.kind = kind,
            (ParameterKind::Angle(_), ParameterKind::Angle(_)) if !states_unit => parameter.kind = kind,
            _ => {}
        }
    }
    // A range with a problem is one that is stated.
    let is_stated = |error: &linkage::Error| {
        matches!(error, linkage::Error::RackWithoutRange { .. }) && fields.get("input").is_some()
    };
    if let Some(error) = template.structural_error().filter(|error| !is_stated(error)) {
        let joint_span = joints.spans.iter().find(|(name, _)| name == error.joint()).map(|(_, span)| span.clone());
        let key = if error.joint() == "output_link" { "output_link" } else { "seen_from" };
        let span = joint_span.or_else(|| fields.get(key).map(TomlValue::span)).unwrap_or_else(|| fields.span.clone());
        parser.report(Problem::error(span, error.to_string()).with_help(error.help()));
    }
    (parser.problem_count() == before + settings_problems).then_some(template)
}

fn parse_input_range<'t>(
    value: &TomlValue<'t>,
    schema: &'static TableSchema,
    kind: InputKind,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<[InputValue; 2]> {
    let fields = Fields::from_value(value, schema, parser)?;
    if let InputKind::Unknown = kind {
        return None;
    }
    let mut end = |key| {
        let value = fields.required(key, &format!("{key} = {}", kind.example()), parser)?;
        parser.input(value, kind, scope)
    };
    let (from, to) = (end("from"), end("to"));
    Some([from?, to?])
}

/// Parses an `arc` table: the input range and the branch.
fn parse_arc<'t>(
    value: &TomlValue<'t>,
    kind: InputKind,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<([InputValue; 2], i8)> {
    let range = parse_input_range(value, &ARC, kind, scope, parser);
    let given = value.get_ref().as_table().and_then(|table| table.get("branch"));
    let branch = match given.map(|branch| (branch, parser.constant(branch))) {
        None | Some((_, Some(1.0))) => Some(1),
        Some((_, Some(-1.0))) => Some(-1),
        Some((branch, Some(_))) => {
            parser.report(Problem::error(branch.span(), "a branch must be 1 or -1").with_help("1 is left, -1 right"));
            None
        }
        Some((_, None)) => None,
    };
    range.zip(branch)
}
