//! An image that is compressed while it is drawn.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// An image of opaque pixels that is compressed while its rows are drawn.
///
/// The crate `png` writes the file around the pixels. They are compressed here, many rows at once: it would compress each row for itself, and
/// each time a buffer of the compression is cleared, which is most of the work.
pub(super) struct Encoder {
    /// What the file says of the pixels.
    info: png::Info<'static>,
    pixels: ZlibEncoder<Vec<u8>>,
    /// Rows that are not compressed yet, each after the byte of its filter.
    rows: Vec<u8>,
    width: usize,
    paper: [u8; 4],
}

impl Encoder {
    /// An image without rows, of a size in pixels, and with a resolution in pixels per inch. Most pixels are those of the paper.
    pub fn new((width, height): (u32, u32), dpi: f64, paper: [u8; 4]) -> Encoder {
        let mut info = png::Info::with_size(width, height);
        (info.color_type, info.bit_depth) = (png::ColorType::Rgb, png::BitDepth::Eight);
        let per_metre = (dpi / 0.0254).round() as u32;
        info.pixel_dims = Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter });
        // Level 1 takes little more than half the time of level 3, for files a quarter larger.
        let pixels = ZlibEncoder::new(Vec::new(), Compression::new(1));
        Encoder { info, pixels, rows: Vec::new(), width: width as usize, paper }
    }

    /// Appends rows of pixels, whose last byte is left out; at first as many as ever.
    pub fn push_rows(&mut self, rgba: &[u8]) -> std::io::Result<()> {
        let length = 1 + 3 * self.width;
        let rgba_rows = rgba.chunks_exact(4 * self.width);
        if self.rows.is_empty() {
            // Pixels that are not paper do not resemble their neighbours, so filters would make the image larger: 0 is
            // none.
            self.rows = vec![0; length * rgba_rows.len()];
        }
        let rows = &mut self.rows[..length * rgba_rows.len()];
        for (row, rgba) in rows.chunks_exact_mut(length).zip(rgba_rows) {
            copy_rgb(&mut row[1..], rgba, self.paper);
        }
        self.pixels.write_all(rows)
    }

    /// The file.
    pub fn finish(self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut file = png::Encoder::with_info(&mut bytes, self.info)?.write_header()?;
        for part in self.pixels.finish()?.chunks(i32::MAX as usize) {
            file.write_chunk(png::chunk::IDAT, part)?;
        }
        file.finish()?;
        Ok(bytes)
    }
}

/// Copies pixels without their last byte, four at a time, which is sooner done if all are `frequent`.
fn copy_rgb(rgb: &mut [u8], rgba: &[u8], frequent: [u8; 4]) {
    let frequent_fours = std::array::from_fn(|k| frequent[k % 4]);
    let frequent_packed = pack(&frequent_fours);
    let ((packed, rest), (fours, last)) = (rgb.as_chunks_mut(), rgba.as_chunks());
    for (packed, four) in packed.iter_mut().zip(fours) {
        *packed = if *four == frequent_fours { frequent_packed } else { pack(four) };
    }
    rest.chunks_exact_mut(3).zip(last.chunks_exact(4)).for_each(|(rgb, rgba)| rgb.copy_from_slice(&rgba[..3]));
}

/// Four pixels without their last bytes.
fn pack(four: &[u8; 16]) -> [u8; 12] {
    let [a, b] = [0, 8].map(|at| {
        let two = u64::from_le_bytes(std::array::from_fn(|k| four[at + k]));
        two & 0xff_ffff | two >> 8 & 0xffff_ff00_0000
    });
    let packed = (u128::from(a) | u128::from(b) << 48).to_le_bytes();
    std::array::from_fn(|k| packed[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_lose_their_last_byte() {
        for count in 0..20 {
            // The first four pixels are the same.
            let byte = |k: usize| 255 - if k < 16 { k % 4 } else { k } as u8;
            let rgba: Vec<u8> = (0..4 * count).map(byte).collect();
            let rgb: Vec<u8> = (0..4 * count).filter(|k| k % 4 != 3).map(byte).collect();
            for frequent in [[0; 4], [255, 254, 253, 252]] {
                let mut out = vec![0; 3 * count];
                copy_rgb(&mut out, &rgba, frequent);
                assert_eq!(out, rgb);
            }
        }
    }
}
