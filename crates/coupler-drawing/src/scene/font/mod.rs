//! Typefaces: the widths of their characters, and the glyphs in their font files.

mod error;
#[cfg(feature = "fonts")]
mod file;
#[cfg(feature = "fonts")]
mod glyphs;
#[cfg(feature = "fonts")]
mod layout;
#[cfg(not(feature = "fonts"))]
mod no_file;
#[cfg(feature = "fonts")]
mod outline;
mod typeface;
mod widths;

pub use error::FontFileError;
#[cfg(feature = "fonts")]
pub use file::FontFile;
#[cfg(feature = "fonts")]
pub(super) use layout::runs_width;
#[cfg(feature = "fonts")]
pub use layout::{GlyphRun, PlacedGlyph};
#[cfg(not(feature = "fonts"))]
pub use no_file::FontFile;
#[cfg(feature = "fonts")]
pub use outline::OutlineSegment;
pub use typeface::{Face, FontFamily, Typeface, has_right_to_left, reading_parts};

use widths::{UNITS_PER_EM, units};

#[cfg(not(feature = "fonts"))]
impl Face {
    /// Whether the face has a character; a program without fonts does not draw it.
    pub fn has(self, _: char) -> bool {
        true
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
