//! Typefaces, and their faces.

use super::FontFile;

/// A family of fonts, and a font file for the characters that it does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Typeface {
    /// The family.
    pub family: FontFamily,
    /// The font file; without it, characters that the family does not have are drawn as boxes.
    pub fallback: Option<&'static FontFile>,
}

impl From<FontFamily> for Typeface {
    /// The typeface without a font file for other characters.
    fn from(family: FontFamily) -> Typeface {
        Typeface { family, fallback: None }
    }
}

/// A family of DejaVu fonts, whose files are embedded in the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FontFamily {
    /// DejaVu Serif.
    Serif,
    /// DejaVu Serif Condensed.
    #[default]
    SerifCondensed,
    /// DejaVu Sans.
    Sans,
    /// DejaVu Sans Condensed.
    SansCondensed,
    /// DejaVu Sans Mono.
    Mono,
}

impl FontFamily {
    /// Every family with its name in a manifest.
    pub const NAMED: [(&'static str, FontFamily); 5] = [
        ("serif", FontFamily::Serif),
        ("serif-condensed", FontFamily::SerifCondensed),
        ("sans", FontFamily::Sans),
        ("sans-condensed", FontFamily::SansCondensed),
        ("mono", FontFamily::Mono),
    ];

    /// The value of `font-family` in an SVG: this typeface, then families of similar width.
    pub fn fallback_families(self) -> &'static str {
        match self {
            FontFamily::Serif => "'DejaVu Serif','Bitstream Vera Serif',Georgia,'Noto Serif',serif",
            FontFamily::SerifCondensed => {
                "'DejaVu Serif Condensed','Bitstream Vera Serif','Noto Serif',Charter,Cambria,Georgia,'DejaVu Serif',serif"
            }
            FontFamily::Sans => "'DejaVu Sans','Bitstream Vera Sans',Verdana,'Noto Sans',sans-serif",
            FontFamily::SansCondensed => {
                "'DejaVu Sans Condensed','Open Sans','Noto Sans','Segoe UI',Tahoma,'DejaVu Sans',sans-serif"
            }
            FontFamily::Mono => {
                "'DejaVu Sans Mono','Bitstream Vera Sans Mono',Menlo,Consolas,'Noto Sans Mono',monospace"
            }
        }
    }
}

/// The upright or the italic face of a typeface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Face {
    /// The typeface.
    pub typeface: Typeface,
    /// Whether it is italic or oblique.
    pub is_italic: bool,
}

/// Whether a text has characters of scripts that are written from right to left (the ranges that Unicode reserves for them).
pub fn has_right_to_left(text: &str) -> bool {
    let is_right_to_left = |c: char| matches!(u32::from(c), 0x0590..=0x08ff | 0xfb1d..=0xfdff | 0xfe70..=0xfeff | 0x10800..=0x10fff | 0x1e800..=0x1efff);
    text.chars().any(is_right_to_left)
}
