//! Typefaces, and their faces.

use std::ops::Range;

use super::FontFile;

/// A family of fonts, and a font file for the characters that it does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Typeface {
    /// The family.
    pub family: FontFamily,
    /// The font file; without it, characters that the family does not have are drawn as boxes.
    pub fallback: Option<&'static FontFile>,
}

impl From<FontFamily> for Typeface {
    /// The typeface without a font file for other characters.
    fn from(family: FontFamily) -> Typeface {
        Typeface { family, fallback: None }
    }
}

/// A family of DejaVu fonts, whose files are embedded in the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FontFamily {
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

impl FontFamily {
    /// Every family with its name in a manifest.
    pub const NAMED: [(&'static str, FontFamily); 5] = [
        ("serif", FontFamily::Serif),
        ("serif-condensed", FontFamily::SerifCondensed),
        ("sans", FontFamily::Sans),
        ("sans-condensed", FontFamily::SansCondensed),
        ("mono", FontFamily::Mono),
    ];

    /// The value of `font-family` in an SVG: this typeface, then families of similar width.
    pub fn fallback_families(self) -> &'static str {
        match self {
            FontFamily::Serif => "'DejaVu Serif','Bitstream Vera Serif',Georgia,'Noto Serif',serif",
            FontFamily::SerifCondensed => {
                "'DejaVu Serif Condensed','Bitstream Vera Serif','Noto Serif',Charter,Cambria,Georgia,'DejaVu Serif',serif"
            }
            FontFamily::Sans => "'DejaVu Sans','Bitstream Vera Sans',Verdana,'Noto Sans',sans-serif",
            FontFamily::SansCondensed => {
                "'DejaVu Sans Condensed','Open Sans','Noto Sans','Segoe UI',Tahoma,'DejaVu Sans',sans-serif"
            }
            FontFamily::Mono => {
                "'DejaVu Sans Mono','Bitstream Vera Sans Mono',Menlo,Consolas,'Noto Sans Mono',monospace"
            }
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

/// Whether a text has characters of scripts that are written from right to left (the ranges that Unicode reserves for them).
pub fn has_right_to_left(text: &str) -> bool {
    let is_right_to_left = |c: char| matches!(u32::from(c), 0x0590..=0x08ff | 0xfb1d..=0xfdff | 0xfe70..=0xfeff | 0x10800..=0x10fff | 0x1e800..=0x1efff);
    text.chars().any(is_right_to_left)
}

/// The parts of a text that are read one after the other from left to right, with the separators between them: one is the whole text, unless
/// pieces between dots, or values after their names between commas, begin in different directions. Each has the direction of its first letter.
pub fn reading_parts(text: &str) -> Vec<Range<usize>> {
    const SEPARATORS: [&str; 2] = [" · ", ", "];
    let is_right_to_left = |range: &Range<usize>| {
        let first = text[range.clone()].chars().find(|c| c.is_alphabetic())?;
        Some(has_right_to_left(first.encode_utf8(&mut [0; 4])))
    };
    let matches = SEPARATORS.iter().flat_map(|separator| text.match_indices(separator));
    let mut separators: Vec<Range<usize>> = matches.map(|(at, separator)| at..at + separator.len()).collect();
    separators.sort_by_key(|separator| separator.start);
    separators.dedup_by(|next, last| next.start < last.end);
    let ends = separators.iter().map(|separator| separator.start).chain([text.len()]);
    let starts = std::iter::once(0).chain(separators.iter().map(|separator| separator.end));
    let mut pieces = starts.zip(ends).map(|(start, end)| start..end);
    let mut parts: Vec<Range<usize>> = pieces.next().into_iter().collect();
    let mut last = parts.first().and_then(is_right_to_left);
    for (separator, piece) in separators.iter().zip(pieces) {
        let own = is_right_to_left(&piece);
        // A piece after a comma is read with the one before it, unless its direction is another and one of them is a value after its name.
        let is_value = |range: &Range<usize>| text[range.clone()].contains(['=', '≈']);
        let is_other = own.zip(last).is_some_and(|(own, last)| own != last);
        let is_value = is_value(&piece) || parts.last().is_some_and(is_value);
        let is_read_on = text[separator.clone()] == *", " && !(is_other && is_value);
        match parts.last_mut().filter(|_| is_read_on) {
            Some(part) => (part.end, last) = (piece.end, last.or(own)),
            None => {
                parts.extend([separator.clone(), piece]);
                last = own;
            }
        }
    }
    let directions: Vec<bool> = parts.iter().filter_map(is_right_to_left).collect();
    if directions.windows(2).all(|pair| pair[0] == pair[1]) { std::iter::once(0..text.len()).collect() } else { parts }
}
