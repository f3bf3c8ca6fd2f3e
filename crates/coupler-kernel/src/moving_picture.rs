//! A moving picture as a GIF, of frames that the page draws.

use std::borrow::Cow;
use std::collections::BTreeMap;

use gif::{DisposalMethod, Encoder, Frame, Repeat};

/// The code of a pixel that is as in the frame before; the codes below it are those of colours.
const UNCHANGED: u8 = u8::MAX;

/// A picture that repeats without end. Its colours are those of its first frame, in which drawings have all their colours.
#[derive(Default)]
pub(crate) struct MovingPicture {
    size: [u16; 2],
    colors: Vec<u32>,
    codes: BTreeMap<u32, u8>,
    /// The codes of the last frame.
    before: Vec<u8>,
    encoder: Option<Encoder<Vec<u8>>>,
}

impl MovingPicture {
    /// A picture without frames, with a width and a height in pixels.
    ///
    /// # Errors
    /// It is empty, or larger than a GIF can be.
    pub fn new(size: [usize; 2]) -> Result<MovingPicture, String> {
        let size = size.map(|side| u16::try_from(side).unwrap_or(0));
        if size.contains(&0) {
            return Err("a moving picture has 1 to 65,535 pixels on each side".to_owned());
        }
        Ok(MovingPicture { size, ..MovingPicture::default() })
    }

    /// Adds a frame that is shown for some hundredths of a second: its pixels row by row, with red in the lowest byte, then green and
    /// blue. The number of bytes so far.
    ///
    /// # Errors
    /// There are not as many pixels as the picture has.
    pub fn add(&mut self, pixels: &[f64], delay: usize) -> Result<usize, String> {
        let [width, height] = self.size.map(usize::from);
        if pixels.len() != width * height {
            return Err(format!("a frame has {} pixels instead of {}", pixels.len(), width * height));
        }
        let pixels: Vec<u32> = pixels.iter().map(|pixel| *pixel as u32 & 0x00ff_ffff).collect();
        if self.encoder.is_none() {
            self.colors = main_colors(&pixels);
            let palette: Vec<u8> = self.colors.iter().flat_map(|color| channels(*color)).collect();
            let mut encoder =
                Encoder::new(Vec::new(), self.size[0], self.size[1], &palette).map_err(|e| e.to_string())?;
            encoder.set_repeat(Repeat::Infinite).map_err(|e| e.to_string())?;
            self.encoder = Some(encoder);
        }
        // Most pixels are as those before them.
        let mut last = (pixels[0], self.code(pixels[0]));
        let codes: Vec<u8> = pixels
            .iter()
            .map(|pixel| {
                if *pixel != last.0 {
                    last = (*pixel, self.code(*pixel));
                }
                last.1
            })
            .collect();
        let (frame, [left, top, width, height]) = changed_part(&self.before, &codes, width, height);
        let frame = Frame {
            delay: u16::try_from(delay).unwrap_or(u16::MAX),
            dispose: DisposalMethod::Keep,
            transparent: Some(UNCHANGED),
            left,
            top,
            width,
            height,
            buffer: Cow::Owned(frame),
            ..Frame::default()
        };
        self.before = codes;
        let Some(encoder) = &mut self.encoder else { return Ok(0) };
        encoder.write_frame(&frame).map_err(|e| e.to_string())?;
        Ok(encoder.get_ref().len())
    }

    /// The bytes of the file.
    ///
    /// # Errors
    /// It has no frame.
    pub fn finish(self) -> Result<Vec<u8>, String> {
        let encoder = self.encoder.ok_or("a moving picture needs a frame")?;
        encoder.into_inner().map_err(|e| e.to_string())
    }

    /// The code of the colour that is nearest to one.
    fn code(&mut self, color: u32) -> u8 {
        let distance = |other: u32| -> i32 {
            let pairs = channels(color).into_iter().zip(channels(other));
            pairs.map(|(a, b)| (i32::from(a) - i32::from(b)).pow(2)).sum()
        };
        let nearest =
            || (0..UNCHANGED).zip(&self.colors).min_by_key(|(_, other)| distance(**other)).map_or(0, |(code, _)| code);
        *self.codes.entry(color).or_insert_with(nearest)
    }
}

/// Red, green and blue.
fn channels(color: u32) -> [u8; 3] {
    let [red, green, blue, _] = color.to_le_bytes();
    [red, green, blue]
}

/// The colours of most pixels, at most one of those that differ in the lower half of their bits only: the shades at the edges of lines
/// and letters do not take the places of rarer colours.
fn main_colors(pixels: &[u32]) -> Vec<u32> {
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    for pixel in pixels {
        *counts.entry(*pixel).or_default() += 1;
    }
    let mut groups: BTreeMap<u32, (usize, u32)> = BTreeMap::new();
    for (color, count) in counts {
        let group = groups.entry(color & 0x00f0_f0f0).or_default();
        *group = (*group).max((count, color));
    }
    let mut found: Vec<(usize, u32)> = groups.into_values().collect();
    found.sort_unstable_by(|a, b| b.cmp(a));
    found.truncate(usize::from(UNCHANGED));
    found.into_iter().map(|(_, color)| color).collect()
}

/// The codes of the rectangle in which a frame differs from the one before, and its left, top, width and height; a single pixel if it
/// does not differ.
fn changed_part(before: &[u8], codes: &[u8], width: usize, height: usize) -> (Vec<u8>, [u16; 4]) {
    let is_changed = |at: usize| before.get(at) != Some(&codes[at]);
    let rows = (0..height).filter(|row| (0..width).any(|column| is_changed(row * width + column)));
    let columns = (0..width).filter(|column| (0..height).any(|row| is_changed(row * width + column)));
    let range = |mut changed: Box<dyn Iterator<Item = usize> + '_>| {
        let first = changed.next().unwrap_or(0);
        first..changed.last().unwrap_or(first) + 1
    };
    let (rows, columns) = (range(Box::new(rows)), range(Box::new(columns)));
    let place = [columns.start, rows.start, columns.len(), rows.len()].map(|n| n as u16);
    let code = |at: usize| if is_changed(at) { codes[at] } else { UNCHANGED };
    let part = rows.flat_map(|row| columns.clone().map(move |column| row * width + column)).map(code);
    (part.collect(), place)
}
