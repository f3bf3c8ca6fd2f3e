//! What a check says of files that it has nothing to compare with.

use crate::check::LeftOut;

use super::super::pluralize;

/// What a folder leaves out, if anything: "not compared, for the folder has none of them: 29 images, 27 files of the gallery".
pub fn not_compared(left_out: &LeftOut) -> Option<String> {
    let LeftOut { images, volumes, gallery_files } = *left_out;
    let gallery = match gallery_files {
        1 => "1 file of the gallery".to_owned(),
        n => format!("{n} files of the gallery"),
    };
    let kinds =
        [(images, pluralize(images, "image")), (volumes, pluralize(volumes, "volume")), (gallery_files, gallery)];
    let kinds: Vec<String> = kinds.into_iter().filter(|(count, _)| *count > 0).map(|(_, text)| text).collect();
    (!kinds.is_empty()).then(|| format!("not compared, for the folder has none of them: {}", kinds.join(", ")))
}
