//! `images.json`: the digests of images and books as they were written.
//!
//! Their bytes may differ between machines, so their digests have a file of their own; `run.json` stays the same
//! everywhere.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::digest::Digest;

/// The name of the file in the folder of an atlas.
pub const IMAGES_FILE_NAME: &str = "images.json";

/// The version of the format of `images.json`.
const FORMAT_VERSION: u32 = 1;

/// The digests of images and books, by their paths in the folder of the atlas, as in `evans/evans-001.png`.
pub type ImageDigests = BTreeMap<String, Digest>;

/// The contents of the file.
#[derive(Serialize, Deserialize)]
struct ImagesFile {
    format: u32,
    /// The digest of `files` as JSON: a damaged file is recognized as such, and not taken for damaged images.
    sha256: Digest,
    files: ImageDigests,
}

/// The bytes of the file.
pub fn images_to_bytes(files: &ImageDigests) -> Vec<u8> {
    // Serializing texts cannot fail.
    let sha256 = Digest::of(&serde_json::to_vec(files).unwrap_or_default());
    let file = ImagesFile { format: FORMAT_VERSION, sha256, files: files.clone() };
    let mut bytes = serde_json::to_vec_pretty(&file).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

/// Reads the bytes of the file; `None` if they are not exactly what [`images_to_bytes`] writes, except for line ends and
/// a byte order mark, which an editor or a version control system may have changed.
pub fn images_from_bytes(bytes: &[u8]) -> Option<ImageDigests> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let file: ImagesFile = serde_json::from_slice(bytes).ok()?;
    let is_same = images_to_bytes(&file.files).into_iter().eq(bytes.iter().copied().filter(|&byte| byte != b'\r'));
    is_same.then_some(file.files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_damaged_byte_is_noticed() {
        let names = ["atlas.pdf", "evans/evans-001.png"];
        let files: ImageDigests = names.map(|name| (name.to_owned(), Digest::of(name.as_bytes()))).into();
        let bytes = images_to_bytes(&files);
        assert_eq!(images_from_bytes(&bytes), Some(files.clone()));
        let windows = String::from_utf8(bytes.clone()).unwrap().replace('\n', "\r\n");
        assert_eq!(images_from_bytes(format!("\u{feff}{windows}").as_bytes()), Some(files));
        for k in 0..bytes.len() {
            for change in [1, 2, 16, 128] {
                let mut damaged = bytes.clone();
                damaged[k] ^= change;
                assert_eq!(images_from_bytes(&damaged), None, "byte {k}");
            }
            assert_eq!(images_from_bytes(&bytes[..k]), None, "{k} bytes");
        }
    }
}
