//! The fonts of a book.

use std::collections::HashMap;

use krilla::text::{Font, GlyphId, KrillaGlyph};

use crate::scene::{Face, FontFile, GlyphRun};

/// A font: an embedded face, or a file.
type FontKey = (Face, Option<&'static FontFile>);

/// The fonts of a book, each parsed on first use. Only the glyphs in use are embedded.
#[derive(Default)]
pub(super) struct FontCache {
    fonts: HashMap<FontKey, Option<Font>>,
}

impl FontCache {
    /// The font of glyphs, if it can be parsed.
    pub fn get(&mut self, run: &GlyphRun) -> Option<Font> {
        let bytes = || run.file.map_or_else(|| run.face.bytes(), FontFile::bytes);
        self.fonts.entry((run.face, run.file)).or_insert_with(|| Font::new(bytes().into(), 0)).clone()
    }

    /// A used font that cannot be parsed.
    pub fn first_unreadable(&self) -> Option<FontKey> {
        self.fonts.iter().find(|(_, font)| font.is_none()).map(|(key, _)| *key)
    }
}

/// The glyphs of a run.
pub(super) fn layout_glyphs(run: &GlyphRun) -> Vec<KrillaGlyph> {
    let glyphs = run.glyphs.iter();
    let glyph = |glyph: &crate::scene::PlacedGlyph| {
        let [right, up] = glyph.offset.map(|ems| ems as f32);
        KrillaGlyph::new(GlyphId::new(glyph.index), glyph.advance as f32, right, up, 0.0, glyph.range.clone(), None)
    };
    glyphs.map(glyph).collect()
}
