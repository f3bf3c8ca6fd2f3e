//! Typefaces: the widths of their characters, and the glyphs in their font files.

#[cfg(feature = "fonts")]
mod file;
#[cfg(feature = "fonts")]
mod glyphs;
#[cfg(feature = "fonts")]
mod layout;
mod widths;

#[cfg(feature = "fonts")]
pub use file::FontFile;
#[cfg(feature = "fonts")]
pub use glyphs::OutlineSegment;
#[cfg(feature = "fonts")]
pub(super) use layout::runs_width;
#[cfg(feature = "fonts")]
pub use layout::{GlyphRun, PlacedGlyph};

use widths::{UNITS_PER_EM, units};

/// A font file; builds without the feature `fonts` have none.
#[cfg(not(feature = "fonts"))]
#[derive(Debug, PartialEq, Eq, Hash)]
pub enum FontFile {}

#[cfg(not(feature = "fonts"))]
impl FontFile {
    /// Whether the font has a character.
    pub fn has(&self, _: char) -> bool {
        match *self {}
    }
}

#[cfg(not(feature = "fonts"))]
impl Face {
    /// Whether the face has a character; a program without fonts does not draw it.
    pub fn has(self, _: char) -> bool {
        true
    }
}

/// Why a file cannot be used as a font.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FontFileError {
    /// It is not a font.
    #[error("it is not a font in OpenType or TrueType format")]
    NotAFont,
    /// Its glyphs are images, or it has none.
    #[error("its glyphs have no outlines")]
    NoOutlines,
}

/// A family of fonts, and a font file for the characters that it does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Typeface {
    /// The family.
    pub family: FontFamily,
    /// The font file; without it, characters that the family does not have are drawn as boxes.
    pub fallback: Option<&'static FontFile>,
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

impl From<FontFamily> for Typeface {
    /// The typeface without a font file for other characters.
    fn from(family: FontFamily) -> Typeface {
        Typeface { family, fallback: None }
    }
}

impl Typeface {
    /// The typeface with a font file for the characters that its family does not have. Builds without the feature `fonts`,
    /// which draw no outlines, have none.
    ///
    /// # Errors
    /// The file is not a font, or its glyphs have no outlines.
    pub fn with_fallback(self, file: Vec<u8>) -> Result<Typeface, FontFileError> {
        #[cfg(feature = "fonts")]
        return Ok(Typeface { fallback: Some(FontFile::from_bytes(file)?), ..self });
        #[cfg(not(feature = "fonts"))]
        return (!file.is_empty()).then_some(self).ok_or(FontFileError::NotAFont);
    }

    /// Whether a character can be drawn in PNG, PDF and as an outline. Builds without the feature `fonts`, which have none of
    /// these, can draw all.
    pub fn can_draw(self, character: char) -> bool {
        self.regular().has(character) || self.fallback.is_some_and(|file| file.has(character))
    }

    /// The upright face.
    pub fn regular(self) -> Face {
        Face { typeface: self, is_italic: false }
    }

    /// The italic or oblique face, for the names of parameters.
    pub fn italic(self) -> Face {
        Face { typeface: self, is_italic: true }
    }
}

/// Whether a text has characters of scripts that are written from right to left (the ranges that Unicode reserves for them).
pub fn has_right_to_left(text: &str) -> bool {
    let is_right_to_left = |c: char| matches!(u32::from(c), 0x0590..=0x08ff | 0xfb1d..=0xfdff | 0xfe70..=0xfeff | 0x10800..=0x10fff | 0x1e800..=0x1efff);
    text.chars().any(is_right_to_left)
}

/// The upright or the italic face of a typeface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Face {
    /// The typeface.
    pub typeface: Typeface,
    /// Whether it is italic or oblique.
    pub is_italic: bool,
}

impl Face {
    /// The width of a text at a font size, in the unit of `size`, without kerning.
    pub fn width(self, text: &str, size: f64) -> f64 {
        #[cfg(feature = "fonts")]
        if self.typeface.fallback.is_some() {
            return layout::width(self, text) * size;
        }
        text.chars().map(|c| self.advance(c)).sum::<f64>() * size
    }

    /// The advance width of a character by itself, in ems; that of a box if the face does not have it.
    pub fn advance(self, character: char) -> f64 {
        #[cfg(feature = "fonts")]
        if let Some(file) = self.typeface.fallback.filter(|_| !self.has(character)) {
            return file.advance(character);
        }
        self.own_advance(character)
    }

    /// The advance width of a character of the embedded face, in ems.
    fn own_advance(self, character: char) -> f64 {
        f64::from(units(self, character)) / UNITS_PER_EM
    }

    /// The ascent and the descent of the face, in ems, both positive; they are those of every face.
    pub fn ascent_and_descent(self) -> (f64, f64) {
        (widths::ASCENT / UNITS_PER_EM, widths::DESCENT / UNITS_PER_EM)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_differ_in_width_except_in_the_monospaced_typeface() {
        let [wide, narrow] = ["MM", "ii"]
            .map(|text| FontFamily::NAMED.map(|(_, family)| Typeface::from(family).regular().width(text, 10.0)));
        assert!((0..4).all(|k| wide[k] > narrow[k]) && wide[4] == narrow[4], "{wide:?} {narrow:?}");
    }
}
