//! Checks images and books, whose bytes may differ from machine to machine.
//!
//! A file with the digest that was recorded when it was written is intact. An image without it, because it was drawn
//! anew elsewhere or compressed by another program, is compared with the current drawing, pixel by pixel.

use std::io::Cursor;
use std::path::Path;

use image::codecs::png::PngDecoder;
use image::{ImageDecoder, Limits};

use super::Error;
use super::finding::{Change, Finding, Location};
use crate::record::{
    Digest, FileError, FileRecord, FolderRecord, IMAGES_FILE_NAME, ImagesState, file_digest, has_images, is_intact_png,
    read_regular_file,
};

/// The largest image that is read, in bytes: more than the pixels of a page of the greatest size and resolution.
const MAX_IMAGE_BYTES: u64 = 1 << 32;

/// The greatest difference of a channel of two equal pixels: what rounding may differ by between machines.
const PIXEL_TOLERANCE: u8 = 1;

/// What has happened to a recorded image; `draw` returns the current one as a PNG, or `None` if what the image was drawn
/// from has changed, so that there is nothing to compare its pixels with.
///
/// # Errors
/// The system fails to read it.
pub(super) fn image_change(
    folder: &Path,
    record: &FileRecord,
    draw: impl FnOnce() -> Option<Vec<u8>>,
) -> Result<Option<Change>, Error> {
    let bytes = match read_regular_file(&folder.join(&record.name), MAX_IMAGE_BYTES) {
        Ok(bytes) => bytes,
        Err(error) => return Error::or_damage(error).map(Some),
    };
    if record.image_sha256 == Some(Digest::of(&bytes)) {
        return Ok(None);
    }
    if !is_intact_png(&bytes) {
        return Ok(Some(Change::Damaged { message: "is not a complete PNG image".to_owned() }));
    }
    Ok(match draw() {
        Some(current) if is_same_image(&bytes, &current) => None,
        // Without a digest nothing is known about the image as it was.
        None if record.image_sha256.is_none() => None,
        _ => Some(Change::Altered),
    })
}

/// Whether two images have equal pixels, up to the tolerance.
fn is_same_image(recorded: &[u8], current: &[u8]) -> bool {
    let (Some(recorded), Some(current)) = (open_png(recorded), open_png(current)) else { return false };
    // The sizes are compared before the pixels are decoded, so that these take no more memory than those of a page.
    if recorded.dimensions() != current.dimensions() {
        return false;
    }
    let (Some(recorded), Some(current)) = (rgba(recorded), rgba(current)) else { return false };
    recorded.len() == current.len()
        && recorded.as_flattened().iter().zip(current.as_flattened()).all(|(a, b)| a.abs_diff(*b) <= PIXEL_TOLERANCE)
}

/// A PNG image whose header has been read.
fn open_png(bytes: &[u8]) -> Option<PngDecoder<Cursor<&[u8]>>> {
    PngDecoder::with_limits(Cursor::new(bytes), Limits::no_limits()).ok()
}

/// The pixels of an image: red, green, blue and opacity.
fn rgba(decoder: PngDecoder<Cursor<&[u8]>>) -> Option<Vec<[u8; 4]>> {
    let color = decoder.color_type();
    let (channels, size) = (usize::from(color.channel_count()), usize::from(color.bytes_per_pixel()));
    let mut bytes = vec![0; usize::try_from(decoder.total_bytes()).ok()?];
    decoder.read_image(&mut bytes).ok()?;
    let pixel = |pixel: &[u8]| {
        let channel = |k: usize| match size / channels {
            1 => pixel[k],
            // The eight higher bits of sixteen, rounded.
            _ => ((u32::from(u16::from_ne_bytes([pixel[2 * k], pixel[2 * k + 1]])) + 128) / 257) as u8,
        };
        let opacity = |k: usize| if channels > k { channel(k) } else { u8::MAX };
        match channels {
            1 | 2 => [channel(0), channel(0), channel(0), opacity(1)],
            _ => [channel(0), channel(1), channel(2), opacity(3)],
        }
    };
    Some(bytes.chunks_exact(size).map(pixel).collect())
}

/// The finding on a volume of the book, if it is not the file that was written.
///
/// # Errors
/// The system fails to read it.
pub(super) fn check_volume(output: &Path, record: &FileRecord) -> Result<Option<Finding>, Error> {
    // A record is not trusted: a name with a folder would lead out of the atlas.
    let is_file_name = Path::new(&record.name).components().count() == 1;
    let digest = if is_file_name { file_digest(&output.join(&record.name)) } else { Err(FileError::NotFound) };
    let change = match (digest, record.image_sha256) {
        (Err(error), _) => Error::or_damage(error)?,
        (Ok(_), None) => Change::Damaged { message: format!("is not in {IMAGES_FILE_NAME}") },
        (Ok(found), Some(recorded)) if found == recorded => return Ok(None),
        (Ok(_), Some(_)) => Change::Altered,
    };
    Ok(Some(Location::default().with_file(&record.name).finding(change)))
}

/// The finding on `images.json`, if the atlas has images or books and it cannot be used.
pub(super) fn check_images_file(record: &FolderRecord) -> Option<Finding> {
    let message = match &record.images {
        ImagesState::Intact => return None,
        ImagesState::Damaged(message) => message.clone(),
        ImagesState::Missing => {
            if record.is_unfinished || !has_images(&record.run.families, record.run.book.as_ref()) {
                return None;
            }
            FileError::NotFound.to_string()
        }
    };
    Some(Location::default().with_file(IMAGES_FILE_NAME).finding(Change::Damaged { message }))
}
