//! Reads the coupler curves of a page back from its SVG, and compares them with their samples and with the linkage.
//!
//! The page is not trusted: it may be truncated, edited, or of any size. Whatever differs from the output of
//! [`svg`](coupler_drawing::render::svg) and could change how a curve is drawn is an error.

mod comparison;
mod path;
mod reader;
mod solved_curve;

use coupler_curves::geometry::{Similarity, Spline};

pub use reader::read_drawn_curves;
pub use solved_curve::SolvedCurve;

/// A coupler curve as drawn on a page.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCurve {
    /// The id of its group.
    pub id: String,
    /// The number of its cell.
    pub cell: usize,
    /// The number of its traced point.
    pub trace: usize,
    /// The number of its circuit.
    pub circuit: usize,
    /// From the plane to millimetres of the page.
    pub page_from_plane: Similarity,
    /// The period and the length of its dashes, in the unit of the input. A dash begins at each multiple of the period.
    pub dash: [f64; 2],
    /// The stretches of the circuit that are drawn in dashes, each by the input travelled from its beginning to the ends of
    /// the stretch; `None` if all are.
    pub dashed_travel: Option<Vec<[f64; 2]>>,
    /// The path of the whole curve, in millimetres of the page; no spline is without segments.
    pub hairline: Vec<Spline>,
    /// The dashes.
    pub dashes: Vec<Spline>,
}

/// How far the chords may be, in millimetres, by which curves are replaced to find the distances of points from them. With
/// the error of the splines, 0.009 mm, and the rounding of their points, 0.0007 mm, that is less than 0.01 mm.
const FLATNESS_MM: f64 = 2e-4;

/// An error of reading the curves of a page.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrawnCurveError {
    /// The bytes are not UTF-8 text.
    #[error("it is not text in UTF-8")]
    NotUtf8,
    /// The text is not XML.
    #[error("it is not well-formed XML at byte {byte_offset}: {reason}")]
    NotXml {
        /// The place of the error, in bytes from the beginning.
        byte_offset: u64,
        /// What is wrong.
        reason: String,
    },
    /// The text ends inside an element.
    #[error("it is truncated")]
    Truncated,
    /// The XML is not a single SVG.
    #[error("it is not an SVG page")]
    NotSvg,
    /// Its coordinates are not millimetres.
    #[error("its viewBox is not its width and height in millimetres")]
    NotInMillimetres,
    /// It has a part that could change how curves are drawn: a document type, a style sheet, a script.
    #[error("it has a {part}, which pages do not have")]
    UnsupportedPart {
        /// The part.
        part: &'static str,
    },
    /// A curve lacks an attribute.
    #[error("curve `{curve}` has no {attribute}")]
    MissingAttribute {
        /// The id of the curve; may be empty.
        curve: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// An attribute has an invalid value.
    #[error("{attribute}=\"{value}\" of curve `{curve}` is not {expected}")]
    InvalidAttribute {
        /// The id of the curve.
        curve: String,
        /// The attribute.
        attribute: &'static str,
        /// Its value, shortened.
        value: String,
        /// What a valid value is.
        expected: &'static str,
    },
    /// A curve, or an element around it, has a transform or a style.
    #[error("curve `{curve}`, or an element around it, has a {attribute}")]
    Transformed {
        /// The id of the curve.
        curve: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// A curve contains, or is inside, an element where pages have none.
    #[error("curve `{curve}` contains or is inside <{element}>")]
    UnexpectedNesting {
        /// The id of the curve.
        curve: String,
        /// The element.
        element: String,
    },
    /// A path does not consist of lines and Bézier curves.
    #[error("the path of curve `{curve}` does not consist of lines and Bézier curves")]
    NotSplines {
        /// The id of the curve.
        curve: String,
    },
    /// The page has more points than any page draws.
    #[error("its curves have more than {max_points} points")]
    TooManyPoints {
        /// The most that are read.
        max_points: usize,
    },
}
