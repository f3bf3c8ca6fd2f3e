//! Typefaces: the widths of their characters, and the glyphs in their font files.

#[cfg(feature = "fonts")]
mod glyphs;
mod widths;

#[cfg(feature = "fonts")]
pub use glyphs::OutlineSegment;

use widths::{UNITS_PER_EM, units};

/// A typeface of the DejaVu family; its font files are embedded in the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Typeface {
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

impl Typeface {
    /// Every typeface with its name in a manifest.
    pub const NAMED: [(&'static str, Typeface); 5] = [
        ("serif", Typeface::Serif),
        ("serif-condensed", Typeface::SerifCondensed),
        ("sans", Typeface::Sans),
        ("sans-condensed", Typeface::SansCondensed),
        ("mono", Typeface::Mono),
    ];

    /// The upright face.
    pub fn regular(self) -> Face {
        Face { typeface: self, is_italic: false }
    }

    /// The italic or oblique face, for the names of parameters.
    pub fn italic(self) -> Face {
        Face { typeface: self, is_italic: true }
    }

    /// The value of `font-family` in an SVG: this typeface, then families of similar width.
    pub fn fallback_families(self) -> &'static str {
        match self {
            Typeface::Serif => "'DejaVu Serif','Bitstream Vera Serif',Georgia,'Noto Serif',serif",
            Typeface::SerifCondensed => {
                "'DejaVu Serif Condensed','Bitstream Vera Serif','Noto Serif',Charter,Cambria,Georgia,'DejaVu Serif',serif"
            }
            Typeface::Sans => "'DejaVu Sans','Bitstream Vera Sans',Verdana,'Noto Sans',sans-serif",
            Typeface::SansCondensed => {
                "'DejaVu Sans Condensed','Open Sans','Noto Sans','Segoe UI',Tahoma,'DejaVu Sans',sans-serif"
            }
            Typeface::Mono => "'DejaVu Sans Mono','Bitstream Vera Sans Mono',Menlo,Consolas,'Noto Sans Mono',monospace",
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

impl Face {
    /// The width of a text at a font size, in the unit of `size`, without kerning.
    pub fn width(self, text: &str, size: f64) -> f64 {
        text.chars().map(|c| self.advance(c)).sum::<f64>() * size
    }

    /// The advance width of a character, in ems; that of a box if the face does not have it.
    pub fn advance(self, character: char) -> f64 {
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
        let [wide, narrow] =
            ["MM", "ii"].map(|text| Typeface::NAMED.map(|(_, typeface)| typeface.regular().width(text, 10.0)));
        assert!((0..4).all(|k| wide[k] > narrow[k]) && wide[4] == narrow[4], "{wide:?} {narrow:?}");
    }
}
