//! The outlines of glyphs.

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

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

/// The outline of a glyph in ems; empty if it cannot be drawn.
pub(super) fn outline(font: &FontRef, glyph: GlyphId, units_per_em: f64) -> Vec<OutlineSegment> {
    let mut pen = Pen { units_per_em, segments: Vec::new() };
    if let Some(glyph) = font.outline_glyphs().get(glyph) {
        // A glyph that cannot be drawn has an empty outline.
        let _ = glyph.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut pen);
    }
    pen.segments
}

/// Collects the outline of a glyph in ems.
pub(super) struct Pen {
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
