//! The glyphs of a text with their positions.
//!
//! Characters that a face has are set one by one, without kerning, so that all formats agree. The others are shaped with the
//! font file of the typeface, if it has one, and text that runs from right to left is reordered by the Unicode
//! Bidirectional Algorithm (UAX #9), each part that has a direction of its own by itself.

use std::borrow::Cow;
use std::ops::Range;

use unicode_bidi::BidiInfo;

use super::{Face, FontFile, OutlineSegment, has_right_to_left, reading_parts};
use crate::scene::{Text, TextRun};
use coupler_curves::geometry::{Point, Vector};

/// Glyphs of one font and size, next to each other.
#[derive(Clone, Debug)]
pub struct GlyphRun<'t> {
    /// The text that they are part of.
    pub text: &'t str,
    /// The embedded face.
    pub face: Face,
    /// The font file of the glyphs; `None` for the embedded face.
    pub file: Option<&'static FontFile>,
    /// The origin of the first glyph, in millimetres.
    pub origin: Point,
    /// The font size (em) in millimetres.
    pub size: f64,
    /// The glyphs from left to right.
    pub glyphs: Vec<PlacedGlyph>,
}

/// A glyph of a [`GlyphRun`].
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedGlyph {
    /// Its index in the font.
    pub index: u32,
    /// The character of the embedded face; the first of those that a glyph of a font file stands for.
    character: char,
    /// The bytes of the text that it stands for.
    pub range: Range<usize>,
    /// The distance to the next glyph, in ems.
    pub advance: f64,
    /// To the right and up, before it is drawn, in ems.
    pub offset: [f64; 2],
}

impl GlyphRun<'_> {
    /// The outlines of the glyphs with their origins, in millimetres; outlines are in ems.
    pub fn outlines(&self) -> impl Iterator<Item = (Point, Cow<'static, [OutlineSegment]>)> + '_ {
        let mut at = self.origin;
        self.glyphs.iter().map(move |glyph| {
            let [right, up] = glyph.offset;
            let origin = at + Vector::new(right, -up) * self.size;
            at.x += glyph.advance * self.size;
            let outline = match self.file {
                Some(file) => Cow::Owned(file.outline(glyph.index)),
                None => self.face.outline(glyph.character),
            };
            (origin, outline)
        })
    }

    fn width(&self) -> f64 {
        self.glyphs.iter().map(|glyph| glyph.advance).sum::<f64>() * self.size
    }
}

impl Text {
    /// The glyphs of the text, from left to right, before its rotation.
    pub fn glyph_runs(&self) -> Vec<GlyphRun<'_>> {
        let mut runs = place(&self.runs, self.size);
        let mut at = self.start();
        for run in &mut runs {
            let width = run.width();
            run.origin += at.coords;
            at.x += width;
        }
        runs
    }
}

/// The width of a text in a face, in ems.
pub(super) fn width(face: Face, text: &str) -> f64 {
    runs_width(&[TextRun::new(text, face)], 1.0)
}

/// The width of runs of text at a size.
pub(in crate::scene) fn runs_width(runs: &[TextRun], size: f64) -> f64 {
    place(runs, size).iter().map(GlyphRun::width).sum()
}

/// The glyphs of runs of text from left to right; their origins have only the height above the baseline.
fn place(runs: &[TextRun], size: f64) -> Vec<GlyphRun<'_>> {
    let mut placed = Vec::with_capacity(runs.len());
    let has_file = runs.iter().any(|run| run.face.typeface.fallback.is_some());
    if !(has_file && runs.iter().any(|run| has_right_to_left(&run.text))) {
        runs.iter().for_each(|run| append(run, 0..run.text.len(), false, size, &mut placed));
        return placed;
    }
    let whole: String = runs.iter().map(|run| run.text.as_str()).collect();
    for part in reading_parts(&whole) {
        let bidi = BidiInfo::new(&whole[part.clone()], None);
        for paragraph in &bidi.paragraphs {
            let (levels, visual) = bidi.visual_runs(paragraph, paragraph.range.clone());
            for range in visual {
                let is_right_to_left = levels[range.start].is_rtl();
                let range = part.start + range.start..part.start + range.end;
                append_range(runs, range, is_right_to_left, size, &mut placed);
            }
        }
    }
    placed
}

/// Appends the glyphs of a range of the text of all runs, which has one direction.
fn append_range<'t>(
    runs: &'t [TextRun],
    range: Range<usize>,
    is_right_to_left: bool,
    size: f64,
    placed: &mut Vec<GlyphRun<'t>>,
) {
    let mut parts: Vec<(&TextRun, Range<usize>)> = Vec::new();
    let mut start = 0;
    for run in runs {
        let end = start + run.text.len();
        let part = range.start.max(start)..range.end.min(end);
        if part.start < part.end {
            parts.push((run, part.start - start..part.end - start));
        }
        start = end;
    }
    if is_right_to_left {
        parts.reverse();
    }
    parts.into_iter().for_each(|(run, part)| append(run, part, is_right_to_left, size, placed));
}

/// Appends the glyphs of a part of a run, which has one direction.
fn append<'t>(
    run: &'t TextRun,
    part: Range<usize>,
    is_right_to_left: bool,
    text_size: f64,
    placed: &mut Vec<GlyphRun<'t>>,
) {
    let size = run.size(text_size);
    let origin = Point::new(0.0, -run.rise(text_size));
    let face = run.face;
    let mut push = |file: Option<&'static FontFile>, range: Range<usize>| {
        let glyphs = match file {
            Some(file) => shaped(file, &run.text, range, is_right_to_left),
            None => plain(face, &run.text, range, is_right_to_left),
        };
        placed.push(GlyphRun { text: &run.text, face, file, origin, size, glyphs });
    };
    let text = &run.text[part.clone()];
    let Some(file) = face.typeface.fallback else { return push(None, part) };
    // What runs from right to left is set in one font if possible, with its spaces and mirrored parentheses.
    if is_right_to_left && text.chars().all(|c| file.has(c)) {
        return push(Some(file), part);
    }
    let mut pieces: Vec<(bool, Range<usize>)> = Vec::new();
    for (at, c) in text.char_indices() {
        let (start, end) = (part.start + at, part.start + at + c.len_utf8());
        let is_of_file = !face.has(c) && file.has(c);
        match pieces.last_mut() {
            Some((last, range)) if *last == is_of_file => range.end = end,
            _ => pieces.push((is_of_file, start..end)),
        }
    }
    if is_right_to_left {
        pieces.reverse();
    }
    pieces.into_iter().for_each(|(is_of_file, range)| push(is_of_file.then_some(file), range));
}

/// The glyphs of characters of an embedded face.
fn plain(face: Face, text: &str, range: Range<usize>, is_right_to_left: bool) -> Vec<PlacedGlyph> {
    let start = range.start;
    let glyph = |(at, character): (usize, char)| PlacedGlyph {
        index: face.glyph_index(character),
        character,
        range: start + at..start + at + character.len_utf8(),
        advance: face.own_advance(character),
        offset: [0.0; 2],
    };
    let mut glyphs: Vec<PlacedGlyph> = text[range].char_indices().map(glyph).collect();
    if is_right_to_left {
        glyphs.reverse();
    }
    glyphs
}

/// The glyphs of a part of a text in a font file.
fn shaped(file: &FontFile, text: &str, range: Range<usize>, is_right_to_left: bool) -> Vec<PlacedGlyph> {
    let start = range.start;
    let part = &text[range];
    let glyphs = file.shape(part, is_right_to_left);
    let mut clusters: Vec<usize> = glyphs.iter().map(|glyph| glyph.cluster).collect();
    clusters.sort_unstable();
    let glyph = |glyph: super::file::ShapedGlyph| {
        let next = clusters.partition_point(|cluster| *cluster <= glyph.cluster);
        let end = clusters.get(next).copied().unwrap_or(part.len());
        PlacedGlyph {
            index: glyph.index,
            character: part[glyph.cluster..].chars().next().unwrap_or(' '),
            range: start + glyph.cluster..start + end,
            advance: glyph.advance,
            offset: glyph.offset,
        }
    };
    glyphs.into_iter().map(glyph).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Anchor, Color, FontFamily, Typeface};

    /// Serif letters, and DejaVu Sans for those of other scripts.
    fn typeface() -> Typeface {
        let sans = Typeface::from(FontFamily::Sans).regular().bytes();
        Typeface::from(FontFamily::SerifCondensed).with_fallback(sans.to_vec()).unwrap()
    }

    fn text(runs: Vec<TextRun>) -> Text {
        let position = Point::new(10.0, 20.0);
        Text { position, anchor: Anchor::Start, size: 5.0, color: Color(0, 0, 0), runs, quarter_turns: 0 }
    }

    /// The characters of the glyphs from left to right, with a bar between fonts.
    fn visual(text: &Text) -> String {
        let of_run = |run: &GlyphRun| run.glyphs.iter().map(|glyph| glyph.character).collect::<String>();
        text.glyph_runs().iter().map(of_run).collect::<Vec<_>>().join("|")
    }

    #[test]
    fn text_from_right_to_left_is_reordered() {
        let face = typeface().regular();
        assert_eq!(visual(&text(vec![TextRun::new("Hoeken 3", face)])), "Hoeken 3");
        assert_eq!(visual(&text(vec![TextRun::new("abגדה", face)])), "ab|הדג");
        // The direction is that of the first letter; numbers run from left to right.
        assert_eq!(visual(&text(vec![TextRun::new("אב 12 p", face)])), "p| |12| בא");
        let runs = vec![TextRun::new("אב ", face), TextRun::new("p", typeface().italic()), TextRun::new(" = 3", face)];
        assert_eq!(visual(&text(runs)), "p| = 3| בא");
    }

    #[test]
    fn pieces_of_different_directions_are_read_from_left_to_right() {
        let face = typeface().regular();
        let visual = |words: &str| visual(&text(vec![TextRun::new(words, face)])).replace('|', "");
        assert_eq!(visual("אב גד · 4 geometries · 1 page"), "דג בא · 4 geometries · 1 page");
        // A value stays next to its name: 1.04 is not the second value of the offset.
        assert_eq!(
            visual("אב 2.008 · גד 1.04, crank = 1, offset = 0.25"),
            "2.008 בא · 1.04 דג, crank = 1, offset = 0.25"
        );
        assert_eq!(visual("crank = 1, אב 2, 3"), "crank = 1, 3 ,2 בא");
        // A sentence is not torn at its commas.
        assert_eq!(visual("אב, see page 5, גד"), "דג ,see page 5 ,בא");
        // What is all in one direction is read in it.
        assert_eq!(visual("אב · גד, 3"), "3 ,דג · בא");
        assert_eq!(reading_parts("p = 2, q = 3 · r").len(), 1);
    }

    #[test]
    fn arabic_letters_are_joined() {
        let face = typeface().regular();
        let file = face.typeface.fallback.unwrap();
        let word = "سلام";
        let joined: Vec<u32> = file.shape(word, true).iter().map(|glyph| glyph.index).collect();
        let isolated: Vec<u32> =
            word.chars().rev().map(|c| file.shape(c.encode_utf8(&mut [0; 4]), true)[0].index).collect();
        // Lam and alef are one glyph.
        assert!(joined.len() == 3 && joined[..2] != isolated[..2], "{joined:?} {isolated:?}");
        let text = text(vec![TextRun::new(word, face)]);
        let runs = text.glyph_runs();
        let mut ranges: Vec<Range<usize>> = runs[0].glyphs.iter().map(|glyph| glyph.range.clone()).collect();
        ranges.sort_by_key(|range| range.start);
        assert!(ranges[0].start == 0 && ranges[2].end == word.len());
        assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start), "{ranges:?}");
    }

    /// Latin, Hebrew and Arabic in one line: each script has its own forms, whatever is next to it.
    #[test]
    fn arabic_letters_are_joined_next_to_hebrew_ones() {
        let face = typeface().regular();
        let mixed = text(vec![TextRun::new("Hoeken שלום سلام, 3", face)]);
        let alone = text(vec![TextRun::new("سلام", face)]);
        let arabic = |text: &Text| -> Vec<u32> {
            let runs = text.glyph_runs();
            let glyphs = runs.iter().flat_map(|run| &run.glyphs);
            glyphs.filter(|glyph| ('\u{600}'..'\u{700}').contains(&glyph.character)).map(|glyph| glyph.index).collect()
        };
        assert_eq!(arabic(&mixed), arabic(&alone));
        // The Arabic word follows the Hebrew one, to its left, and a number after it is Arabic, too; lam and alef are one glyph.
        assert_eq!(visual(&mixed).replace('|', ""), "Hoeken 3 ,ملس םולש");
        for (first, then) in [("שלום سلام", "سلام"), ("سلام שלום", "سلام")] {
            assert_eq!(arabic(&text(vec![TextRun::new(first, face)])), arabic(&text(vec![TextRun::new(then, face)])));
        }
    }

    #[test]
    fn a_text_is_as_wide_as_its_glyphs() {
        let text =
            text(vec![TextRun::new("Hoeken, הוקן", typeface().regular()), TextRun::new(" 1926", typeface().italic())]);
        let last = text.glyph_runs().pop().unwrap();
        assert!((last.origin.x + last.width() - 10.0 - text.width()).abs() < 1e-9);
        let runs = text.glyph_runs();
        let outlines: Vec<_> = runs.iter().flat_map(GlyphRun::outlines).collect();
        let drawn = outlines.iter().filter(|(_, outline)| !outline.is_empty());
        assert_eq!(drawn.count(), "Hoeken,הוקן1926".chars().count());
        assert!(outlines.windows(2).all(|pair| pair[0].0.x < pair[1].0.x));
    }

    #[test]
    fn what_is_not_a_font_is_an_error() {
        let load = |bytes: Vec<u8>| Typeface::default().with_fallback(bytes).map(|_| ());
        let font = Typeface::from(FontFamily::Sans).regular().bytes();
        use crate::scene::FontFileError::NotAFont;
        assert_eq!(load(Vec::new()), Err(NotAFont));
        assert_eq!(load(b"[atlas]".to_vec()), Err(NotAFont));
        // A truncated font is an error, or has the glyphs that are left.
        for length in (0..font.len()).step_by(20_011) {
            if let Ok(typeface) = Typeface::default().with_fallback(font[..length].to_vec()) {
                visual(&text(vec![TextRun::new("שלום سلام", typeface.regular())]));
            }
        }
    }
}
