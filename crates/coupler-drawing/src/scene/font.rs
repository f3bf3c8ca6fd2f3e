//! Typefaces, and the glyphs of their characters.

use std::borrow::Cow;
use std::sync::{LazyLock, OnceLock};

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

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

/// A segment of the outline of a glyph, in ems with y up, from the origin of the glyph on the baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlineSegment {
    /// The start of a contour.
    Move([f64; 2]),
    /// A straight line to a point.
    Line([f64; 2]),
    /// A quadratic Bézier curve: control point and end.
    Quad([f64; 2], [f64; 2]),
    /// A cubic Bézier curve: both control points and end.
    Cubic([f64; 2], [f64; 2], [f64; 2]),
    /// The end of a closed contour.
    Close,
}

/// A parsed font file with its cached glyphs.
struct Font {
    bytes: &'static [u8],
    font: FontRef<'static>,
    units_per_em: f64,
    /// The cached glyphs of the first [`CACHED_CHARACTERS`] characters, each read on first use.
    glyphs: Vec<OnceLock<Glyph>>,
}

/// The glyph of a character in a face.
#[derive(Clone)]
struct Glyph {
    /// The glyph index in the font.
    index: u32,
    /// The advance width in ems.
    advance: f64,
    outline: Vec<OutlineSegment>,
}

/// The number of characters whose glyphs are cached: Latin, Greek and Cyrillic, punctuation, arrows and mathematical
/// signs.
const CACHED_CHARACTERS: usize = 0x2300;

impl Font {
    fn new(bytes: &'static [u8]) -> Font {
        let font = FontRef::new(bytes).expect("the fonts of the dejavu crate are valid");
        let units_per_em = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        Font { bytes, font, units_per_em, glyphs: vec![OnceLock::new(); CACHED_CHARACTERS] }
    }

    fn glyph(&self, character: char) -> Cow<'_, Glyph> {
        match self.glyphs.get(character as usize) {
            Some(cell) => Cow::Borrowed(cell.get_or_init(|| self.read_glyph(character))),
            None => Cow::Owned(self.read_glyph(character)),
        }
    }

    /// The glyph of a character; a box if the face does not have it.
    fn read_glyph(&self, character: char) -> Glyph {
        let id = self.font.charmap().map(character).unwrap_or(GlyphId::NOTDEF);
        let advance = self.font.glyph_metrics(Size::unscaled(), LocationRef::default()).advance_width(id);
        let mut pen = Pen { units_per_em: self.units_per_em, segments: Vec::new() };
        if let Some(glyph) = self.font.outline_glyphs().get(id) {
            // A glyph that cannot be drawn has an empty outline.
            let _ = glyph.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut pen);
        }
        let advance = f64::from(advance.unwrap_or_default()) / self.units_per_em;
        Glyph { index: id.to_u32(), advance, outline: pen.segments }
    }
}

/// A font, parsed on first use.
macro_rules! font {
    ($module:ident, $face:ident) => {{
        static FONT: LazyLock<Font> = LazyLock::new(|| Font::new(dejavu::$module::$face()));
        &FONT
    }};
}

impl Face {
    /// The font file, in OpenType format.
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

    /// The width of a text at a font size, in the unit of `size`, without kerning.
    pub fn width(self, text: &str, size: f64) -> f64 {
        text.chars().map(|c| self.advance(c)).sum::<f64>() * size
    }

    /// The advance width of a character, in ems.
    pub fn advance(self, character: char) -> f64 {
        self.font().glyph(character).advance
    }

    /// The ascent and the descent of the face, in ems, both positive.
    pub fn ascent_and_descent(self) -> (f64, f64) {
        let Font { font, units_per_em, .. } = self.font();
        let metrics = font.metrics(Size::unscaled(), LocationRef::default());
        (f64::from(metrics.ascent) / units_per_em, f64::from(-metrics.descent) / units_per_em)
    }

    /// The outline of a character; a box if the face does not have it.
    pub fn outline(self, character: char) -> Cow<'static, [OutlineSegment]> {
        match self.font().glyph(character) {
            Cow::Borrowed(glyph) => Cow::Borrowed(&glyph.outline),
            Cow::Owned(glyph) => Cow::Owned(glyph.outline),
        }
    }

    /// The glyph index of a character; 0, which is a box, if the face does not have it.
    pub fn glyph_index(self, character: char) -> u32 {
        self.font().glyph(character).index
    }
}

/// Collects the outline of a glyph in ems.
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
    fn all_faces_have_the_characters_of_pages() {
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
