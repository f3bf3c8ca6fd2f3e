//! The coupler curves of a page, read back from its SVG, to be compared with their samples.
//!
//! A page may be anything: cut short, edited, of any size. What is not as [`svg`](coupler_drawing::render::svg) writes it, where it would
//! change how a curve is drawn, is an error and never a guess.

mod comparison;
mod path;
mod reader;

use coupler_curves::geometry::{Point, Similarity};

pub use reader::read_drawn_curves;

/// A coupler curve as it is drawn on a page.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCurve {
    /// The name of its group.
    pub id: String,
    /// The number of its cell.
    pub cell: usize,
    /// The number of its traced point.
    pub trace: usize,
    /// The number of its circuit.
    pub circuit: usize,
    /// From the plane to millimetres of the page.
    pub page_from_plane: Similarity,
    /// Period and drawn part of its dashes, in the input's unit: a dash begins at each multiple of the first and spans
    /// the second.
    pub dash: [f64; 2],
    /// What is drawn, in millimetres of the page; each line has two points or more.
    pub polylines: Vec<Vec<Point>>,
}

/// Why the curves of a page cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrawnCurveError {
    /// The bytes are no text.
    #[error("it is not text in UTF-8")]
    NotUtf8,
    /// The text is not XML.
    #[error("it is not well-formed XML at byte {byte_offset}: {reason}")]
    NotXml {
        /// Where, in bytes from the beginning.
        byte_offset: u64,
        /// What is wrong there.
        reason: String,
    },
    /// The text ends before its elements do.
    #[error("it breaks off before its end")]
    Truncated,
    /// The XML is not one SVG.
    #[error("it is no SVG page")]
    NotSvg,
    /// Its coordinates are not millimetres.
    #[error("its viewBox is not its width and height in millimetres")]
    NotInMillimetres,
    /// It has a part that may change what is drawn elsewhere: a document type, a style sheet, a script.
    #[error("it has a {part}, which pages do not have")]
    UnsupportedPart {
        /// The part.
        part: &'static str,
    },
    /// A curve lacks a fact.
    #[error("curve '{curve}' has no {attribute}")]
    MissingAttribute {
        /// The name of the curve; may be empty.
        curve: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// A fact is not what it has to be.
    #[error("{attribute}=\"{value}\" of curve '{curve}' is not {expected}")]
    InvalidAttribute {
        /// The name of the curve.
        curve: String,
        /// The attribute.
        attribute: &'static str,
        /// Its value, or the beginning of it.
        value: String,
        /// What it has to be.
        expected: &'static str,
    },
    /// A curve is moved by a transform or a style, of its own or of what it is in.
    #[error("curve '{curve}' has a {attribute}, on it or on what it is in")]
    Transformed {
        /// The name of the curve.
        curve: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// A curve has something in it, or is in something, that pages do not have there.
    #[error("curve '{curve}' and <{element}> are one in the other")]
    UnexpectedNesting {
        /// The name of the curve.
        curve: String,
        /// The element.
        element: String,
    },
    /// A path is not one of straight lines.
    #[error("the path of curve '{curve}' is not one of straight lines")]
    NotLines {
        /// The name of the curve.
        curve: String,
    },
    /// There is more than any page draws.
    #[error("its curves have more than {max_points} points")]
    TooManyPoints {
        /// The most that are read.
        max_points: usize,
    },
}
