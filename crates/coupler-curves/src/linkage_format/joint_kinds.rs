//! The kinds of joints and the keys of each.

use super::schema::{KeySchema, TableSchema, ValueSchema, words};
use crate::expression::Dimension;
use crate::template::Side;

/// The sides of a line.
pub(super) const SIDES: [(&str, Side); 2] = [("left", Side::Left), ("right", Side::Right)];
/// The sides of a slide: ahead of or behind the joint it is linked to, along the line.
pub(super) const SLIDE_SIDES: [(&str, Side); 2] = [("ahead", Side::Left), ("behind", Side::Right)];

/// The most points that the grid of one `point` joint may have.
pub(super) const MAX_GRID_POINTS: usize = 10_000;

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

/// The kinds of joints, each with the key that identifies it.
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
                    "The pin of the crank that drives the linkage: the pivot it turns about.",
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
    ),
    (
        "piston",
        TableSchema::new(
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
    ),
    (
        "dyad",
        TableSchema::new(
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
    ),
    (
        "slide",
        TableSchema::new(
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
    ),
    (
        "yoke",
        TableSchema::new(
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
                KeySchema::required("distances", TWO_NUMBERS, "Its distances from the two joints."),
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
                KeySchema::new("along", COORDINATE, "The distance along the line from the first to the second.")
                    .with_default(|| "0".to_owned()),
                KeySchema::new("across", COORDINATE, "The distance to the left of that line.")
                    .with_default(|| "0".to_owned()),
            ],
        ),
    ),
];

/// A number, or a range that makes a grid of points.
const COORDINATE: ValueSchema = ValueSchema::AnyOf(&[ValueSchema::Number, ValueSchema::Table(&RANGE)]);
pub(super) static RANGE: TableSchema = TableSchema::new(
    "a range",
    &[
        KeySchema::required("from", ValueSchema::Number, "The first value."),
        KeySchema::required("to", ValueSchema::Number, "The last value."),
        KeySchema::required("count", ValueSchema::Integer([1, MAX_GRID_POINTS]), "The number of values."),
    ],
);
