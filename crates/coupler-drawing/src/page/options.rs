//! What all pages of an atlas have in common.

use super::paper::Paper;
use super::theme::Theme;

/// The options that all pages of an atlas have in common.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The paper.
    pub paper: Paper,
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
        Options { paper, dash_deg: 5.0, theme: Theme::default(), is_specimen: false }
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
