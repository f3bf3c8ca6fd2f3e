//! The fonts of a book.

use std::collections::HashMap;

use krilla::text::{Font, GlyphId, KrillaGlyph};

use crate::scene::Face;

/// The fonts of a book, each parsed on first use. Only the glyphs in use are embedded.
#[derive(Default)]
pub(super) struct FontCache {
    fonts: HashMap<Face, Option<Font>>,
}

impl FontCache {
    /// The font of a face, if it can be parsed.
    pub fn get(&mut self, face: Face) -> Option<Font> {
        self.fonts.entry(face).or_insert_with(|| Font::new(face.bytes().into(), 0)).clone()
    }

    /// A used face whose font cannot be parsed.
    pub fn first_unreadable(&self) -> Option<Face> {
        self.fonts.iter().find(|(_, font)| font.is_none()).map(|(face, _)| *face)
    }
}

/// The glyphs of a text, one for each character and without kerning, as in the other formats.
pub(super) fn layout_glyphs(text: &str, face: Face) -> Vec<KrillaGlyph> {
    let glyph = |(at, c): (usize, char)| {
        let (glyph, advance) = (GlyphId::new(face.glyph_index(c)), face.advance(c) as f32);
        KrillaGlyph::new(glyph, advance, 0.0, 0.0, 0.0, at..at + c.len_utf8(), None)
    };
    text.char_indices().map(glyph).collect()
}
