//! Linkages by their drawing: the joints by coordinates, and the links by their joints. Dimensions and sides follow from the pose that is drawn.

mod group;
mod mobility;
mod obstacle;
mod placement;
mod placer;
mod read;
mod read_input;
mod vectors;

pub(super) use placement::{PlacedDrawing, place};
pub(super) use read::{input_kind, read_drawing};

use std::collections::HashMap;

use super::schema::{KeySchema, TableSchema, ValueSchema};
use crate::expression::CompiledExpression;
use crate::problem::Span;
use vectors::DrawnVector;

const JOINT_NAME: ValueSchema = ValueSchema::Text;
const TWO_NUMBERS: ValueSchema = ValueSchema::List(&ValueSchema::Number, [2, 2]);
const TWO_JOINTS: ValueSchema = ValueSchema::Set(&JOINT_NAME, [2, 2]);
const LINK: ValueSchema = ValueSchema::Set(&JOINT_NAME, [2, usize::MAX]);
/// Two joints of a link in one text: `"O A"`.
const LINE: ValueSchema = ValueSchema::Text;

/// The schema of a `[linkage.drawing]` table.
pub(super) static DRAWING: TableSchema = TableSchema::new(
    "a [linkage.drawing]",
    &[
        KeySchema::required(
            "joints",
            ValueSchema::Map(&TWO_NUMBERS),
            "Its joints, by their names: the x and y of each.",
        ),
        KeySchema::required("frame", ValueSchema::Set(&JOINT_NAME, [1, usize::MAX]), "The joints that are fixed."),
        KeySchema::required(
            "links",
            ValueSchema::List(&LINK, [1, usize::MAX]),
            "The moving links, each by its joints, two or more, which may be in line.",
        ),
        KeySchema::required(
            "input",
            ValueSchema::AnyOf(&[LINE, ValueSchema::Table(&FLOATING_INPUT)]),
            "What is driven: a link on the frame, by its pivot and another of its joints, as in \"O A\"; or an angle between two links, the way of a \
             slider, or a distance.",
        ),
        KeySchema::new(
            "slides",
            ValueSchema::Map(&TWO_JOINTS),
            "For joints that slide on a line of a link or of the frame: two joints of that line.",
        )
        .with_default(|| "{}".to_owned()),
        KeySchema::new(
            "lengths",
            ValueSchema::Map(&ValueSchema::Positive),
            "Distances of two joints of a link, as in { \"A B\" = 3 }, in place of those in the drawing.",
        )
        .with_default(|| "{}".to_owned()),
    ],
);

static FLOATING_INPUT: TableSchema = TableSchema::new(
    "an input",
    &[
        KeySchema::new(
            "between",
            ValueSchema::List(&LINE, [2, 2]),
            "The angle from the first line to the second, each by two joints of a link, as in [\"A B\", \"B C\"]; the second is from the joint \
             of both links, if there is one.",
        ),
        KeySchema::new(
            "slider",
            JOINT_NAME,
            "A joint of `slides`: its way along its line, from the first joint of the line towards the second.",
        ),
        KeySchema::new(
            "distance",
            TWO_JOINTS,
            "The distance of two joints, the length of an actuator, on two links.",
        ),
    ],
)
.with_one_of(&["between", "slider", "distance"]);

/// A linkage by its drawing. Joints and links are given by their indices; the frame is the first of the links.
#[derive(Clone)]
pub(super) struct Drawing<'v> {
    /// The names of the joints.
    pub names: Vec<&'v str>,
    /// Where each joint is named, and its coordinates.
    pub spans: Vec<[Span; 2]>,
    coordinates: Vec<DrawnVector>,
    links: Vec<DrawnLink>,
    /// The links that each joint is on.
    links_at: Vec<Vec<usize>>,
    slides: Vec<Slide>,
    /// Distances that are given, by the joints in ascending order.
    lengths: HashMap<[usize; 2], CompiledExpression>,
    input: DrawnInput,
    /// Where the input is given.
    input_span: Span,
    /// The whole table.
    pub span: Span,
}

/// A link of a drawing.
#[derive(Clone)]
struct DrawnLink {
    /// Its joints, each once, in the order written.
    joints: Vec<usize>,
    span: Span,
}

/// A joint that slides on a line of a link.
#[derive(Clone)]
struct Slide {
    joint: usize,
    /// Two joints of the line.
    line: [usize; 2],
    /// The link that has the line.
    link: usize,
}

/// What is driven.
#[derive(Clone, Copy)]
enum DrawnInput {
    /// A link, in relation to another, which may have its pivot.
    Crank {
        /// The other link.
        ground: usize,
        /// A line of it from which the angle is measured; the x-axis of the drawing if `None`, on the frame.
        from: Option<[usize; 2]>,
        /// The link that is driven.
        link: usize,
        /// Its pivot, and another of its joints.
        line: [usize; 2],
    },
    /// The way of a joint along the line on which it slides.
    Slider {
        /// The link with the line.
        ground: usize,
        /// Which of the slides.
        slide: usize,
    },
    /// The distance of two joints of links that have no joint in common.
    Distance {
        /// The two joints.
        joints: [usize; 2],
    },
    /// The distance of two joints of links that turn about a joint of both.
    Actuator {
        /// The link with the first.
        ground: usize,
        /// The link with the second.
        link: usize,
        /// The two joints, of which the first is on the ground, and the joint of both links.
        joints: [usize; 3],
    },
}

impl Drawing<'_> {
    /// The coordinates of a joint; `None` for one that is not in the drawing.
    pub fn position(&self, joint: usize) -> Option<[CompiledExpression; 2]> {
        self.coordinates.get(joint).map(|DrawnVector(position)| position.clone())
    }

    /// The vector from a joint to another.
    fn vector(&self, from: usize, to: usize) -> DrawnVector {
        &self.coordinates[to] - &self.coordinates[from]
    }

    /// The distance of two joints, if it is given.
    fn given_length(&self, a: usize, b: usize) -> Option<&CompiledExpression> {
        self.lengths.get(&[a.min(b), a.max(b)])
    }

    /// The distance of two joints of a link.
    fn length(&self, a: usize, b: usize) -> CompiledExpression {
        self.given_length(a, b).cloned().unwrap_or_else(|| self.vector(a, b).length())
    }

    /// The link that is at rest while positions are computed.
    fn ground(&self) -> usize {
        match self.input {
            DrawnInput::Crank { ground, .. }
            | DrawnInput::Slider { ground, .. }
            | DrawnInput::Actuator { ground, .. } => ground,
            DrawnInput::Distance { .. } => 0,
        }
    }

    /// A joint in words: "`A`".
    fn joint_name(&self, joint: usize) -> String {
        format!("`{}`", self.names[joint])
    }

    /// A link in words: "the link A-B-M".
    fn link_name(&self, link: usize) -> String {
        let names: Vec<&str> = self.links[link].joints.iter().map(|&joint| self.names[joint]).collect();
        match link {
            0 => "the frame".to_owned(),
            _ => format!("the link {}", names.join("-")),
        }
    }
}
