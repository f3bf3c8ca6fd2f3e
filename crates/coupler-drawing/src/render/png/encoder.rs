//! The file format of PNG images.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// An image of opaque pixels that is compressed while its rows are drawn.
pub(super) struct Encoder {
    /// The file up to the pixels.
    file: Vec<u8>,
    pixels: ZlibEncoder<Vec<u8>>,
    /// Rows that are not compressed yet, each after the byte of its filter.
    rows: Vec<u8>,
    width: usize,
    paper: [u8; 4],
}

impl Encoder {
    /// An image without rows, of a size in pixels, and with a resolution in pixels per inch. Most pixels are those of the paper.
    pub fn new((width, height): (u32, u32), dpi: f64, paper: [u8; 4]) -> Encoder {
        let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
        // Eight bits for each of red, green and blue, without interlacing.
        let size = [width.to_be_bytes(), height.to_be_bytes()].concat();
        push_chunk(&mut file, b"IHDR", &[&size[..], &[8, 2, 0, 0, 0]].concat());
        // Pixels per metre in both directions.
        let per_metre = ((dpi / 0.0254).round() as u32).to_be_bytes();
        push_chunk(&mut file, b"pHYs", &[&per_metre[..], &per_metre, &[1]].concat());
        // Level 1 takes little more than half the time of level 3, for files a quarter larger.
        let pixels = ZlibEncoder::new(Vec::new(), Compression::new(1));
        Encoder { file, pixels, rows: Vec::new(), width: width as usize, paper }
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
        // All at once, for each call clears a buffer of the encoder.
        self.pixels.write_all(rows)
    }

    /// The file.
    pub fn finish(self) -> std::io::Result<Vec<u8>> {
        let mut file = self.file;
        for part in self.pixels.finish()?.chunks(i32::MAX as usize) {
            push_chunk(&mut file, b"IDAT", part);
        }
        push_chunk(&mut file, b"IEND", &[]);
        Ok(file)
    }
}

/// Appends a chunk with its length and checksum.
fn push_chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(data);
    let checksum = crc32fast::hash(&file[start..]);
    file.extend(checksum.to_be_bytes());
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
