use std::collections::HashMap;

use krilla::text::{Font, GlyphId, KrillaGlyph};

use crate::scene::Face;

/// The faces of a book, each read when it is first needed. What is embedded of them is no more than the glyphs in use.
#[derive(Default)]
pub(super) struct FontCache {
    fonts: HashMap<Face, Option<Font>>,
}

impl FontCache {
    /// A face, if it can be read.
    pub fn get(&mut self, face: Face) -> Option<Font> {
        self.fonts.entry(face).or_insert_with(|| Font::new(face.bytes().into(), 0)).clone()
    }

    /// A face that was asked for and could not be read.
    pub fn first_unreadable(&self) -> Option<Face> {
        self.fonts.iter().find(|(_, font)| font.is_none()).map(|(face, _)| *face)
    }
}

/// A glyph for each character, one after the other and without kerning, as every format sets them.
pub(super) fn layout_glyphs(text: &str, face: Face) -> Vec<KrillaGlyph> {
    let glyph = |(at, c): (usize, char)| {
        let (glyph, advance) = (GlyphId::new(face.glyph_index(c)), face.advance(c) as f32);
        KrillaGlyph::new(glyph, advance, 0.0, 0.0, 0.0, at..at + c.len_utf8(), None)
    };
    text.char_indices().map(glyph).collect()
}
