//! The named themes.

use super::{CurveStyle, Theme};
use crate::scene::{Color, FontFamily};

/// A theme with a name.
#[derive(Clone, Copy, Debug)]
pub struct NamedTheme {
    /// The name used in a manifest.
    pub name: &'static str,
    /// A short description.
    pub description: &'static str,
    /// The function that builds the theme.
    pub theme: fn() -> Theme,
}

impl Theme {
    /// Every named theme, the default first.
    pub const NAMED: [NamedTheme; 4] = [
        NamedTheme { name: "paper", description: "ink on cream paper", theme: Theme::paper },
        NamedTheme { name: "print", description: "the same inks on white, for a printer", theme: Theme::print },
        NamedTheme {
            name: "monochrome",
            description: "greys on white: curves differ in lightness, weight and dashes",
            theme: Theme::monochrome,
        },
        NamedTheme { name: "dark", description: "light inks on a dark ground, for screens", theme: Theme::dark },
    ];

    /// The inks of curves differ in lightness by at least 8, so that they can be distinguished in greyscale and by
    /// colour-blind readers.
    fn paper() -> Theme {
        Theme {
            paper: Color(0xff, 0xfd, 0xf8),
            ink: Color(0x11, 0x11, 0x11),
            grey: Color(0x55, 0x55, 0x55),
            hairline: Color(0xb4, 0xba, 0xc0),
            curve_inks: vec![
                Color(0x7b, 0x25, 0x13),
                Color(0x39, 0x8a, 0xd0),
                Color(0x3c, 0x61, 0x49),
                Color(0x44, 0x16, 0x6c),
                Color(0x97, 0x64, 0x0c),
            ],
            curve_styles: vec![CurveStyle::PLAIN],
            typeface: FontFamily::SerifCondensed.into(),
            dash_fraction: 0.6,
            border: 8.0,
            margin: 8.0,
            title_size: 8.5,
            source_size: 3.8,
            caption_size: 3.7,
            note_size: 3.1,
            link_width: 0.7,
            curve_width: 0.4,
            fine_width: 0.3,
            hair_width: 0.15,
            joint_radius: 0.9,
        }
    }

    fn print() -> Theme {
        Theme { paper: Color(0xff, 0xff, 0xff), ..Theme::paper() }
    }

    fn monochrome() -> Theme {
        Theme::print().into_greyscale(None)
    }

    /// No ink is pure white, which would glare, and links are a little finer, because light lines look broader. The
    /// inks of curves differ in lightness by at least 8, so that they can be distinguished in greyscale and by
    /// colour-blind readers.
    fn dark() -> Theme {
        Theme {
            paper: Color(0x14, 0x18, 0x1d),
            ink: Color(0xe4, 0xe1, 0xda),
            grey: Color(0xa3, 0xa8, 0xae),
            hairline: Color(0x50, 0x58, 0x62),
            curve_inks: vec![
                Color(0xf3, 0x77, 0x6b),
                Color(0x38, 0x88, 0xe0),
                Color(0x9f, 0xd8, 0xa9),
                Color(0xc2, 0xa7, 0xea),
                Color(0xf9, 0xe2, 0x86),
            ],
            link_width: 0.6,
            ..Theme::paper()
        }
    }

    /// The theme in greys of the same lightness, with a different style for each ink.
    ///
    /// Curves have the greys of `inks`; by default, greys from that of the theme's ink to the faintest one that is well
    /// visible on the paper.
    pub fn into_greyscale(self, inks: Option<Vec<Color>>) -> Theme {
        /// A little more than the contrast of 3:1 that a line needs on its background.
        const MIN_CONTRAST: f64 = 3.4;
        /// The order of the greys, as fractions from the ink to the faintest: consecutive greys differ clearly.
        const GREY_STEPS: [f64; 5] = [0.0, 1.0, 0.5, 0.75, 0.25];
        let (paper, ink) = (self.paper.to_grey(), self.ink.to_grey());
        let greys = (0..=u8::MAX).map(|level| Color(level, level, level));
        let is_lighter = |color: &Color| color.luminance() > paper.luminance();
        let is_visible = |grey: &Color| grey.contrast(paper) >= MIN_CONTRAST && is_lighter(grey) == is_lighter(&ink);
        let faintest = greys.filter(is_visible).min_by(|a, b| a.contrast(paper).total_cmp(&b.contrast(paper)));
        let faintest = faintest.map_or(ink.lightness(), Color::lightness);
        let step = |part: f64| Color::from_lightness(ink.lightness() * (1.0 - part) + faintest * part);
        let curves =
            inks.map_or_else(|| GREY_STEPS.map(step).to_vec(), |inks| inks.into_iter().map(Color::to_grey).collect());
        Theme {
            paper,
            ink,
            grey: self.grey.to_grey(),
            hairline: self.hairline.to_grey(),
            curve_inks: curves,
            curve_styles: CurveStyle::FOR_GREYS.to_vec(),
            ..self
        }
    }
}
