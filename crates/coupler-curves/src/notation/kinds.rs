//! The ways to place a joint, and the keys that go with each.

use super::form::{Form, Key, Table, words};
use crate::expression::Dimension;
use crate::template::Side;

/// The sides of a line.
pub(super) const SIDES: [(&str, Side); 2] = [("left", Side::Left), ("right", Side::Right)];
/// The ways along it.
pub(super) const WAYS: [(&str, Side); 2] = [("ahead", Side::Left), ("behind", Side::Right)];

/// The most points a grid in one joint may have.
pub(super) const MAX_POINTS: usize = 10_000;

/// The name of a joint.
const JOINT: Form = Form::Text;
/// The names of two joints.
const TWO: Form = Form::Set(&JOINT, [2, 2]);
/// Two numbers.
const NUMBERS: Form = Form::List(&Form::Number, [2, 2]);
const OFFSET: Key = Key::new("offset", Form::Number, "How far to the left of the line.").or("0");
const LINE_OFFSET: Key = Key::new("offset", Form::Number, "The distance of the line from the first pivot.").or("0");
const LENGTH: Key = Key::required("length", Form::Positive, "The length of the link.");
const LINE: Key =
    Key::required("line", TWO, "Two joints of the line, fixed or moving: it points from the first to the second.");
const SIDE: Key =
    Key::required("side", Form::Word(|| words(&SIDES)), "The side of the line from the first joint to the second.");

/// The ways to place a joint: each by the key it is known by.
pub(super) static KINDS: [(&str, Table); 11] = [
    (
        "fixed",
        Table::new("a joint with `fixed`", &[Key::required("fixed", NUMBERS, "A pivot on the frame: its x and y.")]),
    ),
    (
        "crank",
        Table::new(
            "a joint with `crank`",
            &[
                Key::required(
                    "crank",
                    JOINT,
                    "The end of the crank that drives the linkage: the pivot it turns about.",
                ),
                LENGTH,
            ],
        ),
    ),
    (
        "gear",
        Table::new(
            "a joint with `gear`",
            &[
                Key::required("gear", JOINT, "The end of a second crank, geared to the first: the first one's end."),
                Key::required("about", JOINT, "The pivot it turns about."),
                LENGTH,
                Key::required(
                    "ratio",
                    NUMBERS,
                    "Its turns to those of the first crank: two whole numbers, negative the other way.",
                ),
                Key::new("phase", Form::Quantity(Dimension::Angle), "Its angle where the input is 0.").or("\"0 deg\""),
            ],
        ),
    ),
    (
        "piston",
        Table::new(
            "a joint with `piston`",
            &[
                Key::required(
                    "piston",
                    TWO,
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
        Table::new(
            "a joint with `dyad`",
            &[
                Key::required("dyad", TWO, "Where two links meet: the joints they come from."),
                Key::required("lengths", Form::List(&Form::Positive, [2, 2]), "The lengths of the two links."),
                SIDE,
            ],
        ),
    ),
    (
        "slide",
        Table::new(
            "a joint with `slide`",
            &[
                Key::required(
                    "slide",
                    JOINT,
                    "The end of a link that slides on a line: the joint the link comes from.",
                ),
                LENGTH,
                LINE,
                OFFSET,
                Key::required(
                    "side",
                    Form::Word(|| words(&WAYS)),
                    "Which way along the line, from the joint the link comes from.",
                ),
            ],
        ),
    ),
    (
        "yoke",
        Table::new(
            "a joint with `yoke`",
            &[
                Key::required("yoke", JOINT, "A yoke that slides on a line: the joint that slides in its slot."),
                LINE,
                OFFSET,
                Key::new("angle", Form::Quantity(Dimension::Angle), "That of the slot to the line.").or("\"90 deg\""),
            ],
        ),
    ),
    (
        "slot",
        Table::new(
            "a joint with `slot`",
            &[
                Key::required(
                    "slot",
                    TWO,
                    "The inverted slider: the foot, from the first joint, of a line that slides through the second.",
                ),
                LINE_OFFSET,
                Key { is_required: false, ..SIDE },
            ],
        )
        .with("offset", "side"),
    ),
    (
        "parallelogram",
        Table::new(
            "a joint with `parallelogram`",
            &[Key::required(
                "parallelogram",
                Form::Set(&JOINT, [3, 3]),
                "The fourth corner of a parallelogram: its other corners in order.",
            )],
        ),
    ),
    (
        "distances",
        Table::new(
            "a joint with `distances`",
            &[
                Key::required("point", TWO, "A point of the link that carries these two joints."),
                Key::required("distances", NUMBERS, "How far it is from each of them."),
                SIDE,
            ],
        ),
    ),
    (
        "point",
        Table::new(
            "a joint with `point`",
            &[
                Key::required("point", TWO, "A point of the link that carries these two joints."),
                Key::new("along", COORDINATE, "How far along the line from the first to the second.").or("0"),
                Key::new("across", COORDINATE, "How far to the left of it.").or("0"),
            ],
        ),
    ),
];

/// A number, or as many as a grid has.
const COORDINATE: Form = Form::Either(&[Form::Number, Form::Table(&RANGE)]);
pub(super) static RANGE: Table = Table::new(
    "a range",
    &[
        Key::required("from", Form::Number, "The first value."),
        Key::required("to", Form::Number, "The last value."),
        Key::required("count", Form::Count([1, MAX_POINTS]), "How many values."),
    ],
);
