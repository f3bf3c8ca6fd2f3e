//! What all pages of an atlas have in common.

use super::paper::Paper;
use super::theme::Theme;

/// The options that all pages of an atlas have in common.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The paper, without a gutter.
    pub paper: Paper,
    /// The width of the gutter by which the sheet is wider than the paper, in millimetres.
    pub gutter: f64,
    /// The range of the input that a dash and its gap span, in degrees.
    pub dash_deg: f64,
    /// Colours, weights, sizes and typeface, for tabloid paper.
    pub theme: Theme,
    /// Whether pages are shown in others: what they need is not said.
    pub is_specimen: bool,
}

impl Options {
    /// The default options on a paper: dashes of 5 degrees, ink on cream.
    pub fn for_paper(paper: Paper) -> Options {
        Options { paper, gutter: 0.0, dash_deg: 5.0, theme: Theme::default(), is_specimen: false }
    }

    /// The options for pages of the same sheet beside a gutter of a width in millimetres, by which the paper is narrower.
    pub fn with_gutter(self, gutter: f64) -> Options {
        let paper = Paper { width: self.paper.width - gutter, ..self.paper };
        Options { paper, gutter: self.gutter + gutter, ..self }
    }

    /// The paper with the gutter, to a tenth of a micrometre, as sums have noise.
    pub fn sheet(&self) -> Paper {
        const PER_MILLIMETRE: f64 = 1e4;
        let width = (self.paper.width + self.gutter) * PER_MILLIMETRE;
        Paper { width: width.round() / PER_MILLIMETRE, ..self.paper }
    }

    /// The options on another paper.
    pub fn with_paper(self, paper: Paper) -> Options {
        Options { paper, ..self }
    }

    /// The options of pages that are shown in others.
    pub fn for_specimen(self) -> Options {
        Options { is_specimen: true, ..self }
    }

    /// The options with another range of the input for a dash and its gap, in degrees.
    pub fn with_dash_deg(self, dash_deg: f64) -> Options {
        Options { dash_deg, ..self }
    }

    /// The options with another theme.
    pub fn with_theme(self, theme: Theme) -> Options {
        Options { theme, ..self }
    }
}
