//! The forms of joints: the keys of each, and what they mean.

use super::fields::Fields;
use super::joint_values::{COORDINATE, JointFields, MAX_GRID_POINTS, SIDES, SLIDE_SIDES};
use super::names::JointNames;
use super::schema::{KeySchema, TableSchema, ValueSchema, words};
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::{Dimension, Scope};
use crate::problem::Problem;
use crate::template::{JointKindTemplate, Side};

/// The default angle from the line that a yoke slides along to its slot.
pub(super) const DEFAULT_SLOT_ANGLE_DEG: f64 = 90.0;

/// The name of a joint.
const JOINT_NAME: ValueSchema = ValueSchema::Text;
/// The names of two joints.
const TWO_JOINTS: ValueSchema = ValueSchema::Set(&JOINT_NAME, [2, 2]);
/// Two numbers.
const TWO_NUMBERS: ValueSchema = ValueSchema::List(&ValueSchema::Number, [2, 2]);
const OFFSET: KeySchema = KeySchema::new("offset", ValueSchema::Number, "The distance to the left of the line.")
    .with_default(|| "0".to_owned());
const LINE_OFFSET: KeySchema =
    KeySchema::new("offset", ValueSchema::Number, "The distance of the line from the first pivot.")
        .with_default(|| "0".to_owned());
const LENGTH: KeySchema = KeySchema::required("length", ValueSchema::Positive, "The length of the link.");
const LINE: KeySchema = KeySchema::required(
    "line",
    TWO_JOINTS,
    "Two joints of the line, fixed or moving: it points from the first to the second.",
);
const SIDE: KeySchema = KeySchema::required(
    "side",
    ValueSchema::Word(|| words(&SIDES)),
    "The side of the line from the first joint to the second.",
);

/// A form of joints: how one is written, and what it means.
pub(super) struct JointForm {
    /// The key that no other form before it has.
    key: &'static str,
    schema: TableSchema,
    parse: for<'f, 't> fn(&JointFields<'f, 't>, &mut TomlParser<'t>) -> Option<JointKindTemplate>,
}

/// All forms: a joint has the first whose key is present.
static FORMS: [JointForm; 13] = [
    JointForm {
        key: "fixed",
        schema: TableSchema::new(
            "a joint with `fixed`",
            &[KeySchema::required("fixed", TWO_NUMBERS, "A pivot on the frame: its x and y.")],
        ),
        parse: |joint, parser| Some(JointKindTemplate::Fixed(joint.numbers("fixed", parser)?)),
    },
    JointForm {
        key: "crank",
        schema: TableSchema::new(
            "a joint with `crank`",
            &[
                KeySchema::required(
                    "crank",
                    JOINT_NAME,
                    "The pin of the crank that drives the linkage: the pivot it turns about.",
                ),
                LENGTH,
            ],
        ),
        parse: |joint, parser| {
            let (pivot, length) = (joint.joint("crank", parser), joint.length(parser));
            Some(JointKindTemplate::Crank { pivot: pivot?, length: length? })
        },
    },
    JointForm {
        key: "gear",
        schema: TableSchema::new(
            "a joint with `gear`",
            &[
                KeySchema::required(
                    "gear",
                    JOINT_NAME,
                    "The pin of a second crank, geared to the first: the first one's pin.",
                ),
                KeySchema::required("about", JOINT_NAME, "The pivot it turns about."),
                LENGTH,
                KeySchema::required(
                    "ratio",
                    TWO_NUMBERS,
                    "Its turns to those of the first crank: two whole numbers, negative for the opposite direction.",
                ),
                KeySchema::new("phase", ValueSchema::Quantity(Dimension::Angle), "Its angle when the input is 0.")
                    .with_default(|| "\"0 deg\"".to_owned()),
            ],
        ),
        parse: |joint, parser| {
            let crank = joint.joint("gear", parser);
            let pivot = joint.joint("about", parser);
            let (length, ratio) = (joint.length(parser), joint.ratio(parser));
            let phase = joint.angle("phase", 0.0, parser);
            Some(JointKindTemplate::Gear {
                crank: crank?,
                pivot: pivot?,
                length: length?,
                ratio: ratio?,
                phase: phase?,
            })
        },
    },
    JointForm {
        key: "rack",
        schema: TableSchema::new(
            "a joint with `rack`",
            &[
                KeySchema::required(
                    "rack",
                    JOINT_NAME,
                    "A rack that a pinion on the crank moves along a line by its pitch radius times the crank's angle: the pin of that crank.",
                ),
                KeySchema::required(
                    "radius",
                    ValueSchema::Number,
                    "The pitch radius of the pinion; negative if the rack moves against the line as the crank's angle rises.",
                ),
                LINE,
                OFFSET,
                KeySchema::new(
                    "start",
                    ValueSchema::Number,
                    "Its distance from the first joint of the line when the input is 0.",
                )
                .with_default(|| "0".to_owned()),
            ],
        ),
        parse: |joint, parser| {
            let (crank, radius) = (joint.joint("rack", parser), joint.number("radius", "radius = 0.5", parser));
            let (line, offset) = (joint.joint_pair("line", parser), joint.offset(parser));
            let start = joint.number_or_zero("start", parser);
            Some(JointKindTemplate::Rack {
                crank: crank?,
                line: line?,
                offset: offset?,
                radius: radius?,
                start: start?,
            })
        },
    },
    JointForm {
        key: "piston",
        schema: TableSchema::new(
            "a joint with `piston`",
            &[
                KeySchema::required(
                    "piston",
                    TWO_JOINTS,
                    "The pin of a crank driven by an actuator, the input: the actuator's pivot, the crank's.",
                ),
                LENGTH,
                LINE_OFFSET,
                SIDE,
            ],
        ),
        parse: |joint, parser| {
            let (base, length) = (joint.joint_pair("piston", parser), joint.length(parser));
            let (offset, side) = (joint.offset(parser), joint.side(&SIDES, parser));
            Some(JointKindTemplate::Piston { base: base?, length: length?, offset: offset?, side: side?.into() })
        },
    },
    JointForm {
        key: "slider",
        schema: TableSchema::new(
            "a joint with `slider`",
            &[
                KeySchema::required(
                    "slider",
                    TWO_JOINTS,
                    "A slider that is driven along the line of two joints of a link; its distance from the first is the input.",
                ),
                OFFSET,
            ],
        ),
        parse: |joint, parser| {
            let (line, offset) = (joint.joint_pair("slider", parser), joint.offset(parser));
            Some(JointKindTemplate::DrivenSlider { line: line?, offset: offset? })
        },
    },
    JointForm {
        key: "dyad",
        schema: TableSchema::new(
            "a joint with `dyad`",
            &[
                KeySchema::required("dyad", TWO_JOINTS, "The common pin of two links: the joints at their other ends."),
                KeySchema::required(
                    "lengths",
                    ValueSchema::List(&ValueSchema::Positive, [2, 2]),
                    "The lengths of the two links.",
                ),
                SIDE,
            ],
        ),
        parse: |joint, parser| {
            let (base, lengths) = (joint.joint_pair("dyad", parser), joint.lengths(parser));
            let side = joint.side(&SIDES, parser);
            Some(JointKindTemplate::Dyad { base: base?, lengths: lengths?, side: side?.into() })
        },
    },
    JointForm {
        key: "slide",
        schema: TableSchema::new(
            "a joint with `slide`",
            &[
                KeySchema::required(
                    "slide",
                    JOINT_NAME,
                    "The end of a link that slides on a line: the joint at its other end.",
                ),
                LENGTH,
                LINE,
                OFFSET,
                KeySchema::required(
                    "side",
                    ValueSchema::Word(|| words(&SLIDE_SIDES)),
                    "Ahead of or behind that joint along the line.",
                ),
            ],
        ),
        parse: |joint, parser| {
            let (from, length) = (joint.joint("slide", parser), joint.length(parser));
            let (line, offset) = (joint.joint_pair("line", parser), joint.offset(parser));
            let side = joint.side(&SLIDE_SIDES, parser);
            Some(JointKindTemplate::Slide {
                from: from?,
                length: length?,
                line: line?,
                offset: offset?,
                side: side?.into(),
            })
        },
    },
    JointForm {
        key: "yoke",
        schema: TableSchema::new(
            "a joint with `yoke`",
            &[
                KeySchema::required(
                    "yoke",
                    JOINT_NAME,
                    "A yoke that slides along a line: the joint that slides in its slot.",
                ),
                LINE,
                OFFSET,
                KeySchema::new(
                    "angle",
                    ValueSchema::Quantity(Dimension::Angle),
                    "The angle from the line to the slot.",
                )
                .with_default(|| format!("\"{DEFAULT_SLOT_ANGLE_DEG} deg\"")),
            ],
        ),
        parse: |joint, parser| {
            let (from, line) = (joint.joint("yoke", parser), joint.joint_pair("line", parser));
            let offset = joint.offset(parser);
            let angle = joint.angle("angle", DEFAULT_SLOT_ANGLE_DEG, parser);
            Some(JointKindTemplate::Yoke { from: from?, line: line?, offset: offset?, angle: angle? })
        },
    },
    JointForm {
        key: "slot",
        schema: TableSchema::new(
            "a joint with `slot`",
            &[
                KeySchema::required(
                    "slot",
                    TWO_JOINTS,
                    "The inverted slider: the foot, from the first joint, of a line that slides through the second.",
                ),
                LINE_OFFSET,
                KeySchema { is_required: false, ..SIDE },
            ],
        )
        .with_dependent_keys("offset", "side"),
        parse: |joint, parser| {
            let (base, offset) = (joint.joint_pair("slot", parser), joint.offset(parser));
            // Without offset the line points from pivot to joint at the start, on either side.
            let needs_side = ["offset", "side"].iter().any(|key| joint.fields.get(key).is_some());
            let side = if needs_side { joint.side(&SIDES, parser) } else { Some(Side::Right) };
            Some(JointKindTemplate::Slot { base: base?, offset: offset?, side: side?.into() })
        },
    },
    JointForm {
        key: "parallelogram",
        schema: TableSchema::new(
            "a joint with `parallelogram`",
            &[KeySchema::required(
                "parallelogram",
                ValueSchema::Set(&JOINT_NAME, [3, 3]),
                "The fourth corner of a parallelogram: its other corners in order.",
            )],
        ),
        parse: |joint, parser| {
            Some(JointKindTemplate::Parallelogram { corners: joint.corners("parallelogram", parser)? })
        },
    },
    JointForm {
        key: "distances",
        schema: TableSchema::new(
            "a joint with `distances`",
            &[
                KeySchema::required("point", TWO_JOINTS, "A point of the link that carries these two joints."),
                KeySchema::required("distances", TWO_NUMBERS, "Its distances from the two joints."),
                SIDE,
            ],
        ),
        parse: |joint, parser| {
            let base = joint.joint_pair("point", parser);
            let (distances, side) = (joint.numbers("distances", parser), joint.side(&SIDES, parser));
            Some(JointKindTemplate::Distances { base: base?, distances: distances?, side: side?.into() })
        },
    },
    JointForm {
        key: "point",
        schema: TableSchema::new(
            "a joint with `point`",
            &[
                KeySchema::required("point", TWO_JOINTS, "A point of the link that carries these two joints."),
                KeySchema::new("along", COORDINATE, "The distance along the line from the first to the second.")
                    .with_default(|| "0".to_owned()),
                KeySchema::new("across", COORDINATE, "The distance to the left of that line.")
                    .with_default(|| "0".to_owned()),
            ],
        ),
        parse: |joint, parser| {
            let base = joint.joint_pair("point", parser);
            let (along, across) = (joint.coordinate("along", parser), joint.coordinate("across", parser));
            let (along, across) = (along?, across?);
            if along.count().saturating_mul(across.count()) > MAX_GRID_POINTS {
                let message = format!("the grid `{}` has too many points", joint.name);
                let problem = Problem::error(joint.fields.span.clone(), message);
                parser.report(problem.with_help(format!("a grid may have at most {MAX_GRID_POINTS}")));
                return None;
            }
            Some(JointKindTemplate::Point { base: base?, along, across })
        },
    },
];

/// The keys of all forms.
pub(super) fn joint_schemas() -> Vec<(&'static str, &'static TableSchema)> {
    FORMS.iter().map(|form| (form.key, &form.schema)).collect()
}

/// Parses how a joint is placed; `names` are those of all joints, `scope` the parameters.
pub(super) fn parse_joint<'t>(
    name: &str,
    value: &TomlValue<'t>,
    names: &JointNames,
    scope: &Scope,
    parser: &mut TomlParser<'t>,
) -> Option<JointKindTemplate> {
    let any_fields = Fields::with_any_keys(value, "a joint", parser)?;
    let Some(form) = FORMS.iter().find(|form| any_fields.get(form.key).is_some()) else {
        let problem =
            Problem::error(any_fields.span.clone(), format!("the joint `{name}` does not say how it is placed"));
        let mut words: Vec<String> = FORMS.iter().map(|form| format!("`{}`", form.schema.keys[0].name)).collect();
        words.dedup();
        let (last, others) = words.split_last()?;
        let list = format!("{} or {last}", others.join(", "));
        parser.report(problem.with_help(format!(
            "add one of {list}, as in {{ dyad = [\"A\", \"C\"], lengths = [2, 3], side = \"left\" }}"
        )));
        return None;
    };
    let fields = Fields::from_value(value, &form.schema, parser)?;
    (form.parse)(&JointFields { name, fields, names, scope }, parser)
}
