//! The formats of pages: a function for each that renders a scene to bytes.
//!
//! Layout is finished before a scene is rendered. The formats do not depend on each other.

#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "png")]
mod png;
mod svg;

#[cfg(feature = "png")]
pub use png::{Error as PngError, png};
pub use svg::svg;

/// A format that an atlas is rendered to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Format {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
    /// Portable Document Format, all pages in one book.
    Pdf,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 3] = [Format::Svg, Format::Png, Format::Pdf];

    /// The format of the files of single pages; `None` if all pages are in one book.
    pub fn page_format(self) -> Option<PageFormat> {
        match self {
            Format::Svg => Some(PageFormat::Svg),
            Format::Png => Some(PageFormat::Png),
            Format::Pdf => None,
        }
    }

    /// Whether this build can write it: PDF needs the feature `pdf`.
    pub fn is_built_in(self) -> bool {
        self != Format::Pdf || cfg!(feature = "pdf")
    }

    /// The name, which is also the extension of the files.
    pub fn name(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
            Format::Pdf => "pdf",
        }
    }
}

/// A format in which each page is a separate file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageFormat {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
}

impl PageFormat {
    /// Every format of single pages.
    pub const ALL: [PageFormat; 2] = [PageFormat::Svg, PageFormat::Png];

    /// The name, which is also the extension of the files.
    pub fn name(self) -> &'static str {
        match self {
            PageFormat::Svg => Format::Svg.name(),
            PageFormat::Png => Format::Png.name(),
        }
    }
}

/// How text is written in an SVG.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextMode {
    /// As text elements, which can be searched and read aloud; what they look like depends on the installed fonts.
    #[default]
    Text,
    /// As outlines of glyphs, which look the same everywhere. Without the feature `fonts`, text is written as text
    /// elements.
    Outlines,
}
