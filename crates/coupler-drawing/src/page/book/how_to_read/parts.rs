//! The parts of plates that are explained.

use coupler_curves::geometry::Vector;

/// The title of both pages.
pub(in crate::page::book) const TITLE: &str = "How to read this book";

/// A part of a plate that is explained.
pub(super) struct Part {
    /// The class of the group in the scene of the plate.
    pub class: &'static str,
    /// The layouts in which it is explained.
    pub layouts: [bool; 3],
    /// The side of the group at which its number is.
    pub side: Vector,
    /// Whether it is so long that its number may point to another place of it.
    pub is_long: bool,
    pub title: &'static str,
    pub text: &'static str,
}

const PANELS: [bool; 3] = [true, false, false];
const GRID: [bool; 3] = [false, true, false];
const CHART: [bool; 3] = [false, false, true];
const FIGURES: [bool; 3] = [true, true, false];

/// The parts in the order of their numbers. `{dash}` stands for what a dash and its gap span.
pub(super) static PARTS: [Part; 16] = [
    Part {
        class: "curve",
        layouts: FIGURES,
        side: Vector::new(-1.0, 0.0),
        is_long: true,
        title: "The curve",
        text: "is the path of a traced point. It is drawn in dashes: a dash and its gap are {dash}. Where the dashes are long, the \
               point moves fast.",
    },
    Part {
        class: "motion",
        layouts: FIGURES,
        side: Vector::new(0.0, -1.0),
        is_long: true,
        title: "Ticks",
        text: "across the curve are at the inputs that the line of symbols states. At the input 0, or where its range begins, is an \
               arrow in the direction of the motion: inputs are counted from it.",
    },
    Part {
        class: "straight",
        layouts: FIGURES,
        side: Vector::new(0.0, 1.0),
        is_long: false,
        title: "A band",
        text: "under a curve is its straight portion.",
    },
    Part {
        class: "coupler-point",
        layouts: FIGURES,
        side: Vector::new(1.0, -0.6),
        is_long: false,
        title: "The traced points",
        text: "are circles on their link. On a page with many points each has a number, which is at the far end of its curve, too.",
    },
    Part {
        class: "grid",
        layouts: GRID,
        side: Vector::new(-0.6, -1.0),
        is_long: false,
        title: "The grid",
        text: "joins the points of the page, which are on one link.",
    },
    Part {
        class: "linkage",
        layouts: FIGURES,
        side: Vector::new(1.0, 0.6),
        is_long: false,
        title: "The linkage",
        text: "is drawn in one pose. Double circles are fixed pivots; a plate between joints is a single link.",
    },
    Part {
        class: "axis",
        layouts: PANELS,
        side: Vector::new(0.0, -1.0),
        is_long: false,
        title: "The axis",
        text: "is drawn where the curve is symmetrical.",
    },
    Part {
        class: "ghost",
        layouts: PANELS,
        side: Vector::new(0.0, 1.0),
        is_long: false,
        title: "Fine lines",
        text: "are the linkage at the limits of its motion.",
    },
    Part {
        class: "scale",
        layouts: FIGURES,
        side: Vector::new(0.0, 1.0),
        is_long: false,
        title: "The scale bar",
        text: "has the length that is written next to it, or that the line of symbols states.",
    },
    Part {
        class: "key",
        layouts: GRID,
        side: Vector::new(-1.0, -0.4),
        is_long: false,
        title: "The key",
        text: "has the letters of links and joints, and shows from where and in which direction the coordinates of a point are counted.",
    },
    Part {
        class: "swatch",
        layouts: GRID,
        side: Vector::new(-1.0, 0.0),
        is_long: false,
        title: "The table",
        text: "has a row for each curve, in its ink: the coordinates of the point, the straight portions to two tolerances, from \
               which input and over how much, the portion that is nearest to an arc, and the cusps. The notes under it define each.",
    },
    Part {
        class: "speed",
        layouts: GRID,
        side: Vector::new(1.0, 0.0),
        is_long: false,
        title: "The graphs",
        text: "are the speed of the point over the input.",
    },
    Part {
        class: "transmission",
        layouts: GRID,
        side: Vector::new(1.0, 0.6),
        is_long: false,
        title: "The transmission angle",
        text: "is drawn over the same input: in the bands it is too small to transmit a force well.",
    },
    Part {
        class: "symbol",
        layouts: FIGURES,
        side: Vector::new(-1.0, 0.0),
        is_long: false,
        title: "The line of symbols",
        text: "explains every mark on the page.",
    },
    Part {
        class: "series",
        layouts: CHART,
        side: Vector::new(0.0, -1.0),
        is_long: false,
        title: "A line",
        text: "is a quantity of the curves over another, for one value of the name written next to it.",
    },
    Part {
        class: LARGEST_TEXT,
        layouts: [true, true, true],
        side: Vector::new(0.0, -1.0),
        is_long: false,
        title: "The largest letters",
        text: "name the linkage: on a page with a single linkage they are its dimensions, which with the coordinates of a point are \
               all that is needed to build it.",
    },
];

/// Stands for the text in the largest letters, which has no group.
pub(super) const LARGEST_TEXT: &str = "largest text";
