//! What a check says of files that it has nothing to compare with.

use crate::check::LeftOut;
use coupler_curves::text::pluralize;

/// What a folder leaves out, if anything: "not compared, for the folder has none of them: 29 images, 27 files of the gallery".
pub fn not_compared(left_out: &LeftOut) -> Option<String> {
    let LeftOut { images, volumes, gallery_files } = *left_out;
    let kinds = [(images, "image", ""), (volumes, "volume", ""), (gallery_files, "file", " of the gallery")];
    let kinds = kinds.into_iter().filter(|(count, ..)| *count > 0);
    let kinds: Vec<String> = kinds.map(|(count, noun, of)| pluralize(count, noun) + of).collect();
    (!kinds.is_empty()).then(|| format!("not compared, for the folder has none of them: {}", kinds.join(", ")))
}
