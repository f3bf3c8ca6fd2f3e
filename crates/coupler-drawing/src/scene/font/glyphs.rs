//! The glyphs in the font files: their outlines and indices.

use std::borrow::Cow;
use std::io::Read;
use std::sync::{LazyLock, OnceLock};

use flate2::read::ZlibDecoder;
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};

use super::outline::{OutlineSegment, outline};
use super::{Face, FontFamily};

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
    outline: Vec<OutlineSegment>,
}

/// The number of characters whose glyphs are cached: Latin, Greek and Cyrillic, punctuation, arrows and mathematical
/// signs.
const CACHED_CHARACTERS: usize = 0x2300;

impl Font {
    /// The font in a compressed file, whose bytes stay in memory until the program ends.
    fn new(compressed: &[u8]) -> Font {
        let mut bytes = Vec::new();
        ZlibDecoder::new(compressed).read_to_end(&mut bytes).expect("the build script has compressed the fonts");
        let bytes: &'static [u8] = bytes.leak();
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
        Glyph { index: id.to_u32(), outline: outline(&self.font, id, self.units_per_em) }
    }
}

/// A font, unpacked and parsed on first use.
macro_rules! font {
    ($module:ident, $face:ident) => {{
        const COMPRESSED: &[u8] =
            include_bytes!(concat!(env!("OUT_DIR"), "/", stringify!($module), "-", stringify!($face), ".zlib"));
        static FONT: LazyLock<Font> = LazyLock::new(|| Font::new(COMPRESSED));
        &FONT
    }};
}

impl Face {
    /// The font file, in OpenType format.
    pub fn bytes(self) -> &'static [u8] {
        self.font().bytes
    }

    fn font(self) -> &'static Font {
        match (self.typeface.family, self.is_italic) {
            (FontFamily::Serif, false) => font!(serif, regular),
            (FontFamily::Serif, true) => font!(serif, italic),
            (FontFamily::SerifCondensed, false) => font!(serif_condensed, regular),
            (FontFamily::SerifCondensed, true) => font!(serif_condensed, italic),
            (FontFamily::Sans, false) => font!(sans, regular),
            (FontFamily::Sans, true) => font!(sans, oblique),
            (FontFamily::SansCondensed, false) => font!(sans_condensed, regular),
            (FontFamily::SansCondensed, true) => font!(sans_condensed, oblique),
            (FontFamily::Mono, false) => font!(sans_mono, regular),
            (FontFamily::Mono, true) => font!(sans_mono, oblique),
        }
    }

    /// Whether the face has a character and can draw it as it is: one that is written from right to left it cannot.
    pub fn has(self, character: char) -> bool {
        self.glyph_index(character) != 0 && !super::has_right_to_left(character.encode_utf8(&mut [0; 4]))
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

#[cfg(test)]
mod tests {
    use super::super::Typeface;
    use super::*;

    fn faces() -> impl Iterator<Item = Face> {
        FontFamily::NAMED
            .into_iter()
            .map(|(_, family)| Typeface::from(family))
            .flat_map(|typeface| [typeface.regular(), typeface.italic()])
    }

    #[test]
    fn all_faces_have_the_characters_of_pages() {
        for face in faces() {
            for c in "Watt's linkage · p = 2.00, 5° – × ∞ §".chars().filter(|c| *c != ' ') {
                assert_ne!(face.font().font.charmap().map(c), None, "{c}");
                assert!(!face.outline(c).is_empty() && face.advance(c) > 0.1, "{c}");
            }
        }
    }

    /// The advance width of every character in the font of a face, by code point, in units of the font.
    fn font_widths(face: Face) -> Vec<i32> {
        let font = &face.font().font;
        let (characters, metrics) = (font.charmap(), font.glyph_metrics(Size::unscaled(), LocationRef::default()));
        let width = |code: u32| {
            let glyph = char::from_u32(code).and_then(|c| characters.map(c)).unwrap_or(GlyphId::NOTDEF);
            metrics.advance_width(glyph).unwrap_or_default() as i32
        };
        (0..=u32::from(char::MAX)).map(width).collect()
    }

    /// The runs of numbers, as `widths.bin` has them.
    fn encode_runs(numbers: &[i32]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut push = |mut number: usize| {
            while number > 0x7f {
                bytes.push(number as u8 | 0x80);
                number >>= 7;
            }
            bytes.push(number as u8);
        };
        let mut rest = numbers.len();
        for run in numbers.chunk_by(|a, b| a == b) {
            rest -= run.len();
            push(if rest == 0 { 0 } else { run.len() });
            push((if run[0] < 0 { -2 * run[0] - 1 } else { 2 * run[0] }) as usize);
        }
        bytes
    }

    /// `widths.bin`, from the fonts.
    fn encode_widths() -> Vec<u8> {
        let mut bytes = Vec::new();
        for typeface in [FontFamily::Serif, FontFamily::Sans].map(Typeface::from) {
            let [upright, italic] = [typeface.regular(), typeface.italic()].map(font_widths);
            let differences: Vec<i32> = italic.iter().zip(&upright).map(|(italic, upright)| italic - upright).collect();
            bytes.extend(encode_runs(&upright));
            bytes.extend(encode_runs(&differences));
        }
        bytes
    }

    /// `WRITE_WIDTHS=1 cargo test --package coupler-drawing widths` writes the table.
    #[test]
    fn widths_are_those_of_the_fonts() {
        let table = encode_widths();
        if std::env::var_os("WRITE_WIDTHS").is_some() {
            std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/src/scene/font/widths.bin"), &table).unwrap();
        }
        assert!(table == include_bytes!("widths.bin"), "widths.bin is not that of the fonts, or has just been written");
        for face in faces() {
            let metrics = face.font().font.metrics(Size::unscaled(), LocationRef::default());
            let units = f64::from(metrics.units_per_em);
            let heights = (f64::from(metrics.ascent) / units, f64::from(-metrics.descent) / units);
            assert_eq!(face.ascent_and_descent(), heights);
            for (code, width) in (0..).zip(font_widths(face)) {
                let Some(c) = char::from_u32(code) else { continue };
                assert_eq!(face.advance(c), f64::from(width) / units, "{c:?} in {face:?}");
            }
        }
    }
}
