//! Font files that a manifest names, for characters that the embedded fonts do not have.

use std::hash::{Hash, Hasher};
use std::ops::Range;
use std::sync::Mutex;

use harfrust::{Direction, Script, ShapeOptions, ShaperData, UnicodeBuffer, script};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};

use super::error::FontFileError;
use super::outline::{OutlineSegment, outline};

/// A font file, in memory until the program ends; two with the same contents are one.
pub struct FontFile {
    bytes: &'static [u8],
    font: FontRef<'static>,
    shaper: ShaperData,
    units_per_em: f64,
}

/// A glyph of a shaped text, in ems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShapedGlyph {
    pub index: u32,
    /// The byte of the text at which the characters of the glyph begin.
    pub cluster: usize,
    pub advance: f64,
    /// To the right and up, before the glyph is drawn.
    pub offset: [f64; 2],
}

static FILES: Mutex<Vec<&'static FontFile>> = Mutex::new(Vec::new());

impl FontFile {
    /// The font in a file, or the first of a collection.
    ///
    /// # Errors
    /// It is not a font, or its glyphs have no outlines.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<&'static FontFile, FontFileError> {
        let mut files = FILES.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if let Some(known) = files.iter().find(|file| file.bytes == bytes) {
            return Ok(known);
        }
        let units_per_em = {
            let font = FontRef::from_index(&bytes, 0).map_err(|_| FontFileError::NotAFont)?;
            let metrics = font.metrics(Size::unscaled(), LocationRef::default());
            if metrics.units_per_em == 0 || font.charmap().mappings().next().is_none() {
                return Err(FontFileError::NotAFont);
            }
            font.outline_glyphs().format().ok_or(FontFileError::NoOutlines)?;
            f64::from(metrics.units_per_em)
        };
        let bytes: &'static [u8] = Box::leak(bytes.into_boxed_slice());
        let font = FontRef::from_index(bytes, 0).map_err(|_| FontFileError::NotAFont)?;
        let shaper = ShaperData::new(&font);
        let file: &'static FontFile = Box::leak(Box::new(FontFile { bytes, font, shaper, units_per_em }));
        files.push(file);
        Ok(file)
    }

    /// The contents of the file.
    pub fn bytes(&self) -> &'static [u8] {
        self.bytes
    }

    /// The length of the file and its CRC-32, by which a changed file is recognized.
    pub fn fingerprint(&self) -> String {
        format!("{} bytes, {:08x}", self.bytes.len(), crc32fast::hash(self.bytes))
    }

    /// Whether the font has a character.
    pub fn has(&self, character: char) -> bool {
        self.font.charmap().map(character).is_some()
    }

    /// The advance width of a character by itself, in ems.
    pub(super) fn advance(&self, character: char) -> f64 {
        let glyph = self.font.charmap().map(character).unwrap_or(GlyphId::NOTDEF);
        let metrics = self.font.glyph_metrics(Size::unscaled(), LocationRef::default());
        f64::from(metrics.advance_width(glyph).unwrap_or_default()) / self.units_per_em
    }

    /// The outline of a glyph.
    pub(super) fn outline(&self, index: u32) -> Vec<OutlineSegment> {
        outline(&self.font, GlyphId::new(index), self.units_per_em)
    }

    /// The glyphs of a text in one direction, from left to right. Each script has forms and ligatures of its own.
    pub(super) fn shape(&self, text: &str, is_right_to_left: bool) -> Vec<ShapedGlyph> {
        let mut parts = parts_by_script(text);
        if is_right_to_left {
            parts.reverse();
        }
        let shape = |part: Range<usize>| {
            let glyphs = self.shape_script(&text[part.clone()], is_right_to_left);
            glyphs.into_iter().map(move |glyph| ShapedGlyph { cluster: part.start + glyph.cluster, ..glyph })
        };
        parts.into_iter().flat_map(shape).collect()
    }

    /// The glyphs of a text in one script and direction, from left to right.
    fn shape_script(&self, text: &str, is_right_to_left: bool) -> Vec<ShapedGlyph> {
        let mut buffer = UnicodeBuffer::new();
        buffer.push_str(text);
        buffer.set_direction(if is_right_to_left { Direction::RightToLeft } else { Direction::LeftToRight });
        buffer.guess_segment_properties();
        let shaped = self.shaper.shaper(&self.font).build().shape(buffer, ShapeOptions::new());
        let ems = |units: i32| f64::from(units) / self.units_per_em;
        let glyphs = shaped.glyph_infos().iter().zip(shaped.glyph_positions());
        let glyph = |(info, position): (&harfrust::GlyphInfo, &harfrust::GlyphPosition)| ShapedGlyph {
            index: info.glyph_id,
            cluster: info.cluster as usize,
            advance: ems(position.x_advance),
            offset: [ems(position.x_offset), ems(position.y_offset)],
        };
        glyphs.map(glyph).collect()
    }
}

/// The parts of a text in one script each. What belongs to no script, such as spaces, numbers and accents, is in the part before it, or at the
/// beginning in the first.
fn parts_by_script(text: &str) -> Vec<Range<usize>> {
    let mut parts: Vec<(Option<Script>, Range<usize>)> = Vec::new();
    for (at, character) in text.char_indices() {
        let (script, end) = (script_of(character), at + character.len_utf8());
        match parts.last_mut() {
            Some((own, part)) if own.is_none() || script.is_none() || *own == script => {
                *own = own.or(script);
                part.end = end;
            }
            _ => parts.push((script, at..end)),
        }
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

/// The script of a character, if it belongs to one.
fn script_of(character: char) -> Option<Script> {
    let mut buffer = UnicodeBuffer::new();
    buffer.add(character, 0);
    buffer.guess_segment_properties();
    Some(buffer.script()).filter(|own| ![script::COMMON, script::INHERITED, script::UNKNOWN].contains(own))
}

impl std::fmt::Debug for FontFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "FontFile({})", self.fingerprint())
    }
}

impl PartialEq for FontFile {
    fn eq(&self, other: &FontFile) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for FontFile {}

impl Hash for FontFile {
    fn hash<H: Hasher>(&self, state: &mut H) {
        std::ptr::from_ref(self).hash(state);
    }
}
