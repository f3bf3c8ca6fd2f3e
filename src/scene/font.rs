use std::sync::LazyLock;

use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// A face of the shipped typeface, DejaVu Serif Condensed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// Upright.
    Regular,
    /// Italic, for letters that stand for values.
    Italic,
}

/// A part of a glyph's outline: in ems, y up, from the glyph's origin on the baseline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
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
    charmap: Charmap<'static>,
    metrics: GlyphMetrics<'static>,
    units_per_em: f64,
}

impl Font {
    fn new(bytes: &'static [u8]) -> Font {
        let font = FontRef::new(bytes).expect("the dejavu crate ships whole fonts");
        let units_per_em = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        let (charmap, metrics) = (font.charmap(), font.glyph_metrics(Size::unscaled(), LocationRef::default()));
        Font { bytes, font, charmap, metrics, units_per_em }
    }
}

static REGULAR: LazyLock<Font> = LazyLock::new(|| Font::new(dejavu::serif_condensed::regular()));
static ITALIC: LazyLock<Font> = LazyLock::new(|| Font::new(dejavu::serif_condensed::italic()));

impl Face {
    /// What a text is set in where this very typeface is not to be had: families of like width, in order.
    pub const FAMILIES: &'static str =
        "'DejaVu Serif Condensed','Bitstream Vera Serif','Noto Serif',Charter,Cambria,Georgia,'DejaVu Serif',serif";

    /// The whole font, an OpenType file.
    pub fn bytes(self) -> &'static [u8] {
        self.font().bytes
    }

    fn font(self) -> &'static Font {
        match self {
            Face::Regular => &REGULAR,
            Face::Italic => &ITALIC,
        }
    }

    /// The width of a text at an em of `size`, in the unit of `size`; no kerning.
    pub fn width(self, text: &str, size: f64) -> f64 {
        text.chars().map(|c| self.advance(c)).sum::<f64>() * size
    }

    /// How far a character moves on, in ems.
    pub fn advance(self, character: char) -> f64 {
        let Font { metrics, units_per_em, .. } = self.font();
        f64::from(metrics.advance_width(self.glyph(character)).unwrap_or_default()) / units_per_em
    }

    /// How far the face reaches above and below its baseline, in ems, both positive.
    pub fn extents(self) -> (f64, f64) {
        let Font { font, units_per_em, .. } = self.font();
        let metrics = font.metrics(Size::unscaled(), LocationRef::default());
        (f64::from(metrics.ascent) / units_per_em, f64::from(-metrics.descent) / units_per_em)
    }

    /// The outline of a character; a box for one the face does not have.
    pub fn outline(self, character: char) -> Vec<Segment> {
        let Font { font, units_per_em, .. } = self.font();
        let mut pen = Pen { units_per_em: *units_per_em, segments: Vec::new() };
        if let Some(glyph) = font.outline_glyphs().get(self.glyph(character)) {
            // A glyph that cannot be drawn leaves its space empty.
            let _ = glyph.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut pen);
        }
        pen.segments
    }

    /// The number of a character's glyph in the font; 0, a box, for one the face does not have.
    pub fn glyph_index(self, character: char) -> u32 {
        self.glyph(character).to_u32()
    }

    fn glyph(self, character: char) -> GlyphId {
        self.font().charmap.map(character).unwrap_or(GlyphId::NOTDEF)
    }
}

struct Pen {
    units_per_em: f64,
    segments: Vec<Segment>,
}

impl Pen {
    fn ems(&self, x: f32, y: f32) -> [f64; 2] {
        [f64::from(x) / self.units_per_em, f64::from(y) / self.units_per_em]
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.segments.push(Segment::Move(self.ems(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.segments.push(Segment::Line(self.ems(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.segments.push(Segment::Quad(self.ems(cx, cy), self.ems(x, y)));
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.segments.push(Segment::Cubic(self.ems(cx0, cy0), self.ems(cx1, cy1), self.ems(x, y)));
    }

    fn close(&mut self) {
        self.segments.push(Segment::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_faces_have_the_letters_of_the_pages() {
        for face in [Face::Regular, Face::Italic] {
            for c in "Watt's linkage · p = 2.00, 5° – × ∞ §".chars().filter(|c| *c != ' ') {
                assert_ne!(face.glyph(c), GlyphId::NOTDEF, "{c}");
                assert!(!face.outline(c).is_empty() && face.advance(c) > 0.1, "{c}");
            }
        }
        assert!(Face::Regular.width("MM", 10.0) > Face::Regular.width("ii", 10.0));
    }
}
