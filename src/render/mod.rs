//! A scene as bytes: a function for each format. The formats decide nothing and do not know each other.

pub mod pdf;
mod png;
mod svg;

pub use png::{Error as PngError, png};
pub use svg::svg;

/// A format pages are rendered in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 2] = [Format::Svg, Format::Png];

    /// Its name, which is also the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
        }
    }
}

/// How text stands in an SVG.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextMode {
    /// As text, which can be searched and read aloud.
    #[default]
    Text,
    /// As outlines, which look the same everywhere.
    Outlines,
}
