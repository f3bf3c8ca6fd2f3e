//! The advance widths of all characters of all faces, from a table of 21 KB instead of font files of 4 MB.
//!
//! `widths.bin` has the upright and the italic face of the serif and of the sans typeface. A condensed face has nine
//! tenths of their widths, rounded down, and all characters of the monospaced typeface have one width. Characters
//! without a glyph, for which a face draws a box, have the width of the box.
//!
//! A face is a list of runs of characters with the same width, from U+0000: the length of the run, then the width. The
//! length of the last run, which goes on to the last character, is written as 0. An italic face has the differences from
//! the upright one in place of widths, for hardly a tenth of its characters are wider or narrower. All numbers are
//! written in groups of seven bits, the least significant first, each in a byte whose highest bit says that more follow;
//! a width or difference `n` is written as `2 n`, or as `-2 n - 1` if it is negative.
//!
//! A test of the glyphs compares the table with the font files, and can write it.

use std::sync::LazyLock;

use super::{Face, FontFamily};

/// The units of an em, in which widths are whole numbers.
pub(super) const UNITS_PER_EM: f64 = 2048.0;

/// The ascent of all faces, in units.
pub(super) const ASCENT: f64 = 1901.0;

/// The descent of all faces, in units.
pub(super) const DESCENT: f64 = 483.0;

/// The width of all characters of the monospaced typeface, in units.
const MONO_WIDTH: u32 = 1233;

/// The width of a character, in units.
pub(super) fn units(face: Face, character: char) -> u32 {
    let [serif, sans] = &*TABLES;
    let width = |faces: &[WidthTable; 2]| faces[usize::from(face.is_italic)].width(character);
    match face.typeface.family {
        FontFamily::Serif => width(serif),
        FontFamily::SerifCondensed => width(serif) * 9 / 10,
        FontFamily::Sans => width(sans),
        FontFamily::SansCondensed => width(sans) * 9 / 10,
        FontFamily::Mono => MONO_WIDTH,
    }
}

/// The upright and the italic face of the serif and of the sans typeface.
static TABLES: LazyLock<[[WidthTable; 2]; 2]> = LazyLock::new(|| {
    let mut bytes = include_bytes!("widths.bin").iter().copied();
    [(); 2].map(|()| {
        let upright = read_runs(&mut bytes);
        let differences = read_runs(&mut bytes);
        [WidthTable::new(upright.clone(), Vec::new()), WidthTable::new(upright, differences)]
    })
});

/// The number of characters whose widths are found without a search: Latin letters, and most of what pages are set in.
const FIRST_CHARACTERS: usize = 0x180;

/// The widths of a face: those of the upright one, and the differences from them.
struct WidthTable {
    upright: Vec<Run>,
    differences: Vec<Run>,
    /// The widths of the first characters.
    first: Vec<u32>,
}

/// Characters of one width.
#[derive(Clone, Copy)]
struct Run {
    /// The code point of the first.
    first: u32,
    /// Their width, or by how much they are wider.
    units: i16,
}

impl WidthTable {
    fn new(upright: Vec<Run>, differences: Vec<Run>) -> WidthTable {
        let mut table = WidthTable { upright, differences, first: Vec::new() };
        table.first = ('\0'..).take(FIRST_CHARACTERS).map(|character| table.width(character)).collect();
        table
    }

    fn width(&self, character: char) -> u32 {
        self.first.get(character as usize).copied().unwrap_or_else(|| self.find(character))
    }

    fn find(&self, character: char) -> u32 {
        let at = |runs: &[Run]| {
            let after = runs.partition_point(|run| run.first <= u32::from(character));
            after.checked_sub(1).map_or(0, |k| runs[k].units)
        };
        (at(&self.upright) + at(&self.differences)) as u32
    }
}

/// Reads the runs of a face.
fn read_runs(bytes: &mut impl Iterator<Item = u8>) -> Vec<Run> {
    let (mut runs, mut first) = (Vec::new(), 0);
    loop {
        let length = read_number(bytes);
        let number = read_number(bytes);
        let half = (number / 2) as i16;
        runs.push(Run { first, units: if number & 1 == 0 { half } else { -half - 1 } });
        if length == 0 {
            return runs;
        }
        first += length;
    }
}

fn read_number(bytes: &mut impl Iterator<Item = u8>) -> u32 {
    let mut number = 0;
    for (shift, byte) in (0..).step_by(7).zip(bytes) {
        number |= u32::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            break;
        }
    }
    number
}
