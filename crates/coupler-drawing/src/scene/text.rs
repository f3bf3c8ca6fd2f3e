//! Texts of a page.

use super::color::Color;
use super::font::Face;
use coupler_curves::geometry::Point;

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The position of the anchor, on the baseline.
    pub position: Point,
    /// The part of the text that is at `position`.
    pub anchor: Anchor,
    /// The font size (em) in millimetres.
    pub size: f64,
    /// The colour.
    pub color: Color,
    /// The runs of the text, each in one face.
    pub runs: Vec<TextRun>,
    /// The rotation about `position` in quarter turns clockwise.
    pub quarter_turns: u8,
}

impl Text {
    /// The text without its faces.
    pub fn words(&self) -> String {
        self.runs.iter().map(|run| run.text.as_str()).collect()
    }
}

/// The least size of text on paper, in millimetres: 6 points.
pub const MIN_TEXT_SIZE: f64 = 6.0 * 25.4 / 72.0;

/// A run of text in one face.
#[derive(Clone, Debug, PartialEq)]
pub struct TextRun {
    /// The text.
    pub text: String,
    /// The face.
    pub face: Face,
    /// Whether it is an exponent: smaller than the text, and raised.
    pub is_raised: bool,
}

/// The part of a text that is at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The start.
    Start,
    /// The middle.
    Middle,
    /// The end.
    End,
}

impl TextRun {
    /// A run on the baseline.
    pub fn new(text: impl Into<String>, face: Face) -> TextRun {
        TextRun { text: text.into(), face, is_raised: false }
    }

    /// The font size of the run in a text of a size.
    pub fn size(&self, text_size: f64) -> f64 {
        /// As large as a lower-case letter of the text, also of the smallest: one of its full size would be read as a factor.
        const RAISED: f64 = 0.7;
        if self.is_raised { RAISED * text_size } else { text_size }
    }

    /// The height of the run's baseline above that of a text of a size.
    pub fn rise(&self, text_size: f64) -> f64 {
        if self.is_raised { 0.38 * text_size } else { 0.0 }
    }

    /// The width of the run in a text of a size.
    pub fn width(&self, text_size: f64) -> f64 {
        self.face.width(&self.text, self.size(text_size))
    }
}
