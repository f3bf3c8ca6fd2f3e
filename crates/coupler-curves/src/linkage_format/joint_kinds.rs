//! The ways to place a joint, and the keys that go with each.

use super::schema::{KeySchema, TableSchema, ValueSchema, words};
use crate::expression::Dimension;
use crate::template::Side;

/// The sides of a line.
pub(super) const SIDES: [(&str, Side); 2] = [("left", Side::Left), ("right", Side::Right)];
/// The ways along it.
pub(super) const SLIDE_SIDES: [(&str, Side); 2] = [("ahead", Side::Left), ("behind", Side::Right)];

/// The most points a grid in one joint may have.
pub(super) const MAX_GRID_POINTS: usize = 10_000;

/// The name of a joint.
const JOINT_NAME: ValueSchema = ValueSchema::Text;
/// The names of two joints.
const TWO_JOINTS: ValueSchema = ValueSchema::Set(&JOINT_NAME, [2, 2]);
/// Two numbers.
const TWO_NUMBERS: ValueSchema = ValueSchema::List(&ValueSchema::Number, [2, 2]);
const OFFSET: KeySchema =
    KeySchema::new("offset", ValueSchema::Number, "How far to the left of the line.").with_default("0");
const LINE_OFFSET: KeySchema =
    KeySchema::new("offset", ValueSchema::Number, "The distance of the line from the first pivot.").with_default("0");
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

/// The ways to place a joint: each by the key it is known by.
pub(super) static JOINT_KINDS: [(&str, TableSchema); 11] = [
    (
        "fixed",
        TableSchema::new(
            "a joint with `fixed`",
            &[KeySchema::required("fixed", TWO_NUMBERS, "A pivot on the frame: its x and y.")],
        ),
    ),
    (
        "crank",
        TableSchema::new(
            "a joint with `crank`",
            &[
                KeySchema::required(
                    "crank",
                    JOINT_NAME,
                    "The end of the crank that drives the linkage: the pivot it turns about.",
                ),
                LENGTH,
            ],
        ),
    ),
    (
        "gear",
        TableSchema::new(
            "a joint with `gear`",
            &[
                KeySchema::required(
                    "gear",
                    JOINT_NAME,
                    "The end of a second crank, geared to the first: the first one's end.",
                ),
                KeySchema::required("about", JOINT_NAME, "The pivot it turns about."),
                LENGTH,
                KeySchema::required(
                    "ratio",
                    TWO_NUMBERS,
                    "Its turns to those of the first crank: two whole numbers, negative the other way.",
                ),
                KeySchema::new("phase", ValueSchema::Quantity(Dimension::Angle), "Its angle where the input is 0.")
                    .with_default("\"0 deg\""),
            ],
        ),
    ),
    (
        "piston",
        TableSchema::new(
            "a joint with `piston`",
            &[
                KeySchema::required(
                    "piston",
                    TWO_JOINTS,
                    "The end of a crank that an actuator drives, the input: the actuator's pivot, the crank's.",
                ),
                LENGTH,
                LINE_OFFSET,
                SIDE,
            ],
        ),
    ),
    (
        "dyad",
        TableSchema::new(
            "a joint with `dyad`",
            &[
                KeySchema::required("dyad", TWO_JOINTS, "Where two links meet: the joints they come from."),
                KeySchema::required(
                    "lengths",
                    ValueSchema::List(&ValueSchema::Positive, [2, 2]),
                    "The lengths of the two links.",
                ),
                SIDE,
            ],
        ),
    ),
    (
        "slide",
        TableSchema::new(
            "a joint with `slide`",
            &[
                KeySchema::required(
                    "slide",
                    JOINT_NAME,
                    "The end of a link that slides on a line: the joint the link comes from.",
                ),
                LENGTH,
                LINE,
                OFFSET,
                KeySchema::required(
                    "side",
                    ValueSchema::Word(|| words(&SLIDE_SIDES)),
                    "Which way along the line, from the joint the link comes from.",
                ),
            ],
        ),
    ),
    (
        "yoke",
        TableSchema::new(
            "a joint with `yoke`",
            &[
                KeySchema::required(
                    "yoke",
                    JOINT_NAME,
                    "A yoke that slides on a line: the joint that slides in its slot.",
                ),
                LINE,
                OFFSET,
                KeySchema::new("angle", ValueSchema::Quantity(Dimension::Angle), "That of the slot to the line.")
                    .with_default("\"90 deg\""),
            ],
        ),
    ),
    (
        "slot",
        TableSchema::new(
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
    ),
    (
        "parallelogram",
        TableSchema::new(
            "a joint with `parallelogram`",
            &[KeySchema::required(
                "parallelogram",
                ValueSchema::Set(&JOINT_NAME, [3, 3]),
                "The fourth corner of a parallelogram: its other corners in order.",
            )],
        ),
    ),
    (
        "distances",
        TableSchema::new(
            "a joint with `distances`",
            &[
                KeySchema::required("point", TWO_JOINTS, "A point of the link that carries these two joints."),
                KeySchema::required("distances", TWO_NUMBERS, "How far it is from each of them."),
                SIDE,
            ],
        ),
    ),
    (
        "point",
        TableSchema::new(
            "a joint with `point`",
            &[
                KeySchema::required("point", TWO_JOINTS, "A point of the link that carries these two joints."),
                KeySchema::new("along", COORDINATE, "How far along the line from the first to the second.")
                    .with_default("0"),
                KeySchema::new("across", COORDINATE, "How far to the left of it.").with_default("0"),
            ],
        ),
    ),
];

/// A number, or as many as a grid has.
const COORDINATE: ValueSchema = ValueSchema::AnyOf(&[ValueSchema::Number, ValueSchema::Table(&RANGE)]);
pub(super) static RANGE: TableSchema = TableSchema::new(
    "a range",
    &[
        KeySchema::required("from", ValueSchema::Number, "The first value."),
        KeySchema::required("to", ValueSchema::Number, "The last value."),
        KeySchema::required("count", ValueSchema::Integer([1, MAX_GRID_POINTS]), "How many values."),
    ],
);
