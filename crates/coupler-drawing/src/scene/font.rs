use std::borrow::Cow;
use std::sync::{LazyLock, OnceLock};

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// A typeface that is shipped, of the DejaVu family.
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
    /// Every typeface by the name it goes by in a manifest.
    pub const NAMED: [(&'static str, Typeface); 5] = [
        ("serif", Typeface::Serif),
        ("serif-condensed", Typeface::SerifCondensed),
        ("sans", Typeface::Sans),
        ("sans-condensed", Typeface::SansCondensed),
        ("mono", Typeface::Mono),
    ];

    /// Its upright face.
    pub fn regular(self) -> Face {
        Face { typeface: self, is_italic: false }
    }

    /// Its italic or oblique face, for letters that stand for values.
    pub fn italic(self) -> Face {
        Face { typeface: self, is_italic: true }
    }

    /// What a text is set in where this very typeface is not to be had: families of like width, in order.
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

/// A face of a shipped typeface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Face {
    /// The typeface.
    pub typeface: Typeface,
    /// Whether it is the italic or oblique one.
    pub is_italic: bool,
}

/// A part of a glyph's outline: in ems, y up, from the glyph's origin on the baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlineSegment {
    /// A new contour begins.
    Move([f64; 2]),
    /// A straight line.
    Line([f64; 2]),
    /// A quadratic curve by its control point and its end.
    Quad([f64; 2], [f64; 2]),
    /// A cubic curve by its control points and its end.
    Cubic([f64; 2], [f64; 2], [f64; 2]),
    /// The contour is closed.
    Close,
}

struct Font {
    bytes: &'static [u8],
    font: FontRef<'static>,
    units_per_em: f64,
    /// The glyphs of the characters that texts are made of, each read when it is first met.
    glyphs: Vec<OnceLock<Glyph>>,
}

/// What is known of a character in a face.
#[derive(Clone)]
struct Glyph {
    /// Its number in the font.
    index: u32,
    /// In ems.
    advance: f64,
    outline: Vec<OutlineSegment>,
}

/// Latin, Greek and Cyrillic, punctuation, arrows and the signs of mathematics are before this character.
const CACHED_CHARACTERS: usize = 0x2300;

impl Font {
    fn new(bytes: &'static [u8]) -> Font {
        let font = FontRef::new(bytes).expect("the dejavu crate ships whole fonts");
        let units_per_em = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        Font { bytes, font, units_per_em, glyphs: vec![OnceLock::new(); CACHED_CHARACTERS] }
    }

    fn glyph(&self, character: char) -> Cow<'_, Glyph> {
        match self.glyphs.get(character as usize) {
            Some(kept) => Cow::Borrowed(kept.get_or_init(|| self.read_glyph(character))),
            None => Cow::Owned(self.read_glyph(character)),
        }
    }

    /// The glyph of a character; a box for one the face does not have.
    fn read_glyph(&self, character: char) -> Glyph {
        let id = self.font.charmap().map(character).unwrap_or(GlyphId::NOTDEF);
        let advance = self.font.glyph_metrics(Size::unscaled(), LocationRef::default()).advance_width(id);
        let mut pen = Pen { units_per_em: self.units_per_em, segments: Vec::new() };
        if let Some(glyph) = self.font.outline_glyphs().get(id) {
            // A glyph that cannot be drawn leaves its space empty.
            let _ = glyph.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut pen);
        }
        let advance = f64::from(advance.unwrap_or_default()) / self.units_per_em;
        Glyph { index: id.to_u32(), advance, outline: pen.segments }
    }
}

/// A font that is read when it is first needed.
macro_rules! font {
    ($module:ident, $face:ident) => {{
        static FONT: LazyLock<Font> = LazyLock::new(|| Font::new(dejavu::$module::$face()));
        &FONT
    }};
}

impl Face {
    /// The whole font, an OpenType file.
    pub fn bytes(self) -> &'static [u8] {
        self.font().bytes
    }

    fn font(self) -> &'static Font {
        match (self.typeface, self.is_italic) {
            (Typeface::Serif, false) => font!(serif, regular),
            (Typeface::Serif, true) => font!(serif, italic),
            (Typeface::SerifCondensed, false) => font!(serif_condensed, regular),
            (Typeface::SerifCondensed, true) => font!(serif_condensed, italic),
            (Typeface::Sans, false) => font!(sans, regular),
            (Typeface::Sans, true) => font!(sans, oblique),
            (Typeface::SansCondensed, false) => font!(sans_condensed, regular),
            (Typeface::SansCondensed, true) => font!(sans_condensed, oblique),
            (Typeface::Mono, false) => font!(sans_mono, regular),
            (Typeface::Mono, true) => font!(sans_mono, oblique),
        }
    }

    /// The width of a text at an em of `size`, in the unit of `size`; no kerning.
    pub fn width(self, text: &str, size: f64) -> f64 {
        text.chars().map(|c| self.advance(c)).sum::<f64>() * size
    }

    /// How far a character moves on, in ems.
    pub fn advance(self, character: char) -> f64 {
        self.font().glyph(character).advance
    }

    /// How far the face reaches above and below its baseline, in ems, both positive.
    pub fn ascent_and_descent(self) -> (f64, f64) {
        let Font { font, units_per_em, .. } = self.font();
        let metrics = font.metrics(Size::unscaled(), LocationRef::default());
        (f64::from(metrics.ascent) / units_per_em, f64::from(-metrics.descent) / units_per_em)
    }

    /// The outline of a character; a box for one the face does not have.
    pub fn outline(self, character: char) -> Cow<'static, [OutlineSegment]> {
        match self.font().glyph(character) {
            Cow::Borrowed(glyph) => Cow::Borrowed(&glyph.outline),
            Cow::Owned(glyph) => Cow::Owned(glyph.outline),
        }
    }

    /// The number of a character's glyph in the font; 0, a box, for one the face does not have.
    pub fn glyph_index(self, character: char) -> u32 {
        self.font().glyph(character).index
    }
}

struct Pen {
    units_per_em: f64,
    segments: Vec<OutlineSegment>,
}

impl Pen {
    fn ems(&self, x: f32, y: f32) -> [f64; 2] {
        [f64::from(x) / self.units_per_em, f64::from(y) / self.units_per_em]
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.segments.push(OutlineSegment::Move(self.ems(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.segments.push(OutlineSegment::Line(self.ems(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.segments.push(OutlineSegment::Quad(self.ems(cx, cy), self.ems(x, y)));
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.segments.push(OutlineSegment::Cubic(self.ems(cx0, cy0), self.ems(cx1, cy1), self.ems(x, y)));
    }

    fn close(&mut self) {
        self.segments.push(OutlineSegment::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_faces_have_the_letters_of_the_pages() {
        for face in Typeface::NAMED.into_iter().flat_map(|(_, typeface)| [typeface.regular(), typeface.italic()]) {
            for c in "Watt's linkage · p = 2.00, 5° – × ∞ §".chars().filter(|c| *c != ' ') {
                assert_ne!(face.font().font.charmap().map(c), None, "{c}");
                assert!(!face.outline(c).is_empty() && face.advance(c) > 0.1, "{c}");
            }
        }
        let [wide, narrow] =
            ["MM", "ii"].map(|text| Typeface::NAMED.map(|(_, typeface)| typeface.regular().width(text, 10.0)));
        assert!((0..4).all(|k| wide[k] > narrow[k]) && wide[4] == narrow[4], "{wide:?} {narrow:?}");
    }
}
