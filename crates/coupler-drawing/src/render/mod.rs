//! A scene as bytes: a function for each format. The formats decide nothing and do not know each other.

#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "png")]
mod png;
mod svg;

#[cfg(feature = "png")]
pub use png::{Error as PngError, png};
pub use svg::svg;

/// A format pages are rendered in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
    /// Portable Document Format: all pages in one book.
    Pdf,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 3] = [Format::Svg, Format::Png, Format::Pdf];

    /// The format of the files of single pages; none where all pages are in one book.
    pub fn page_format(self) -> Option<PageFormat> {
        match self {
            Format::Svg => Some(PageFormat::Svg),
            Format::Png => Some(PageFormat::Png),
            Format::Pdf => None,
        }
    }

    /// Its name, which is also the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
            Format::Pdf => "pdf",
        }
    }
}

/// A format in which each page is a file of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageFormat {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
}

impl PageFormat {
    /// Every such format.
    pub const ALL: [PageFormat; 2] = [PageFormat::Svg, PageFormat::Png];

    /// Its name, which is also the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            PageFormat::Svg => Format::Svg.name(),
            PageFormat::Png => Format::Png.name(),
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
