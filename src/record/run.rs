//! The record of a run, `run.json`.

use std::collections::BTreeMap;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::digest::{Digest, RunningDigest};
use super::images::IMAGES_FILE_NAME;
use super::regular_file::FileError;

/// The version of the format of `run.json`.
pub const FORMAT_VERSION: u32 = 1;

/// The name of the file in the folder of an atlas.
pub const RUN_FILE_NAME: &str = "run.json";

/// The name of the journal in the folder of an atlas.
pub const JOURNAL_FILE_NAME: &str = ".coupler-atlas.journal";

/// The most files that the record of an atlas may list. A record takes a few hundred bytes of memory for each.
pub const MAX_RECORDED_FILES: usize = 500_000;

/// `run.json`: what a run has written. It has no time, host, path or number of threads, so equal runs have equal bytes.
///
/// Its third line is the SHA-256 of the other lines: a damaged record is recognized as such. Records of before there was one
/// have none.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunRecord {
    /// The version of the format.
    pub format: u32,
    /// The program that wrote it.
    pub program: String,
    /// The program's version.
    pub version: String,
    /// The file name of the manifest, without its folder, or [`RunRecord::STANDARD_INPUT`]; older records have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manifest: Option<String>,
    /// The atlas's title.
    pub title: String,
    /// The families, in the order of the manifest.
    pub families: Vec<FamilyRecord>,
    /// The book, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub book: Option<BookRecord>,
    /// The gallery's page.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gallery: Option<FileRecord>,
    /// The script with the kernel of the gallery; records of before it was a file have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kernel: Option<FileRecord>,
}

/// The record of the book.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BookRecord {
    /// SHA-256 of what it was made from; `None` while it is not finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<Digest>,
    /// The number of its pages, including front matter and index.
    pub pages: usize,
    /// Its volumes, in the atlas's folder.
    #[serde(default)]
    pub files: Vec<FileRecord>,
}

/// The record of a family.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FamilyRecord {
    /// Its id, and the name of its folder.
    pub id: String,
    /// Its title.
    pub title: String,
    /// The id of its linkage.
    pub linkage: String,
    /// The unit of its lengths; `None` if they are in a unit of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// SHA-256 of what all its files were made from; `None` while not all of them are finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<Digest>,
    /// The number of its cells.
    pub cells: usize,
    /// The number of cells kept by `where`.
    pub kept: usize,
    /// The number of cells that `where` does not keep because they cannot be assembled at any input: it uses measures.
    #[serde(default)]
    pub unassembled_left_out: usize,
    /// The number of kept cells that could not be assembled, or not over the whole requested range.
    pub not_assembled: usize,
    /// The number of those that are assembled over a part of the range.
    #[serde(default)]
    pub partly_assembled: usize,
    /// The number of curves of kept cells that `where` left out.
    pub curves_left_out: usize,
    /// The number of traced curves.
    pub curves: usize,
    /// The number of its pages.
    pub pages: usize,
    /// Its files, in its folder.
    #[serde(default)]
    pub files: Vec<FileRecord>,
}

/// The record of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Its name.
    pub name: String,
    /// SHA-256 of its bytes; `None` for an image or a book, whose bytes may differ from machine to machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<Digest>,
    /// SHA-256 of what an image is drawn from: the page's SVG and the resolution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn_from_sha256: Option<Digest>,
    /// SHA-256 of what a page is made from: the program's version, its part of the manifest, and the cells on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<Digest>,
    /// SHA-256 of the bytes of an image or a book on the machine that wrote it. It is kept in `images.json`, since
    /// `run.json` is the same on every machine.
    #[serde(skip)]
    pub image_sha256: Option<Digest>,
}

impl FileRecord {
    /// Whether it is the image of a page: of these and of books `images.json` has the digests.
    pub fn is_image(&self) -> bool {
        self.name.ends_with(".png")
    }
}

/// Whether there are images or books, for which there is an `images.json`.
pub fn has_images(families: &[FamilyRecord], book: Option<&BookRecord>) -> bool {
    families.iter().flat_map(|family| &family.files).any(FileRecord::is_image)
        || book.is_some_and(|book| !book.files.is_empty())
}

/// An error of reading a `run.json`.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be read.
    #[error("it {0}")]
    File(#[from] FileError),
    /// The journal of an unfinished run cannot be read.
    #[error("its journal, {name}, {0}", name = JOURNAL_FILE_NAME)]
    Journal(#[source] FileError),
    /// The system fails to read the digests of its images and books.
    #[error("{name} beside it {0}", name = IMAGES_FILE_NAME)]
    Images(#[source] FileError),
    /// It lists more files than this program writes.
    #[error("it lists {files} files, expected at most {}", MAX_RECORDED_FILES)]
    TooManyFiles {
        /// The number of files, approximately.
        files: usize,
    },
    /// It is not as it was written.
    #[error("it is not what a run has written: it has another SHA-256 than the one in it")]
    Altered,
    /// It is not JSON as this program writes it.
    #[error("it is not the record of a run: {0}")]
    Syntax(#[from] serde_json::Error),
    /// It has another format.
    #[error(
        "it has format {format} on line {line}, written by {writer}, but this is {} {}, which reads format \
         {FORMAT_VERSION}",
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION")
    )]
    UnsupportedFormat {
        /// The format, as it is written.
        format: String,
        /// The line of the format, from 1.
        line: usize,
        /// The program that wrote it and its version, as far as they are recorded.
        writer: String,
    },
}

/// The keys that records of all formats have.
#[derive(Deserialize)]
struct FormatHeader {
    format: Value,
    #[serde(default)]
    program: Value,
    #[serde(default)]
    version: Value,
    #[serde(default)]
    sha256: Value,
}

/// What the line of a record with its own digest begins with: no other line is indented so little and has this key.
const DIGEST_LINE: &str = "  \"sha256\": ";

/// The line of a record with the digest of its other lines.
fn digest_line(others: Digest) -> String {
    format!("{DIGEST_LINE}\"{others}\",\n")
}

/// Whether a record is as it was written, except for line ends, which an editor or a version control system may have changed.
/// One of before there were digests has only the keys of then, so that a digest whose key is damaged is missed.
fn is_as_written(bytes: &[u8], header: &FormatHeader) -> Result<bool, serde_json::Error> {
    const KEYS: [&str; 9] =
        ["format", "program", "version", "manifest", "title", "families", "book", "gallery", "kernel"];
    if header.sha256.is_null() {
        let keys: BTreeMap<String, IgnoredAny> = serde_json::from_slice(bytes)?;
        return Ok(keys.keys().all(|key| KEYS.contains(&key.as_str())));
    }
    let (mut others, mut own) = (RunningDigest::default(), Vec::new());
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        match line.starts_with(DIGEST_LINE.as_bytes()) {
            true => own.extend(line.iter().copied().filter(|&byte| byte != b'\r')),
            false => line.split(|&byte| byte == b'\r').for_each(|part| others.update(part)),
        }
    }
    Ok(own == digest_line(others.finish()).as_bytes())
}

/// A type without values: deserializing it always fails.
#[derive(Deserialize)]
enum Never {}

/// Deserializing this fails at the value of `format`, so the error has its line.
#[derive(Deserialize)]
struct FormatLocator {
    #[serde(rename = "format")]
    _format: Never,
}

impl ReadError {
    /// Whether the system failed to read it, so that nothing is known about it and another attempt may succeed.
    pub fn is_system_failure(&self) -> bool {
        let (ReadError::File(error) | ReadError::Journal(error) | ReadError::Images(error)) = self else {
            return false;
        };
        matches!(error, FileError::Unreadable { .. })
    }

    /// Whether the record is lost or damaged, so that it can be rebuilt from the files of the atlas.
    pub fn is_damage(&self) -> bool {
        match self {
            ReadError::Altered | ReadError::Syntax(_) | ReadError::TooManyFiles { .. } => true,
            ReadError::File(error) => matches!(error, FileError::NotFound | FileError::TooLarge { .. }),
            ReadError::Journal(_) | ReadError::Images(_) | ReadError::UnsupportedFormat { .. } => false,
        }
    }
}

impl FormatHeader {
    /// The error of a format that this program does not read.
    fn format_error(&self, bytes: &[u8]) -> ReadError {
        let line = serde_json::from_slice::<FormatLocator>(bytes).err().map_or(1, |error| error.line());
        let words: Vec<&str> = [&self.program, &self.version].into_iter().filter_map(Value::as_str).collect();
        let writer = if words.is_empty() { "another program".to_owned() } else { words.join(" ") };
        ReadError::UnsupportedFormat { format: self.format.to_string(), line, writer }
    }
}

impl RunRecord {
    /// What stands for the name of a manifest that is read from standard input.
    pub const STANDARD_INPUT: &str = "-";

    /// An empty record of an atlas; `manifest` is the file name of its manifest.
    pub fn new(manifest: Option<&str>, title: &str) -> RunRecord {
        let (program, version) = (env!("CARGO_PKG_NAME").to_owned(), env!("CARGO_PKG_VERSION").to_owned());
        RunRecord {
            format: FORMAT_VERSION,
            program,
            version,
            manifest: manifest.map(str::to_owned),
            title: title.to_owned(),
            families: Vec::new(),
            book: None,
            gallery: None,
            kernel: None,
        }
    }

    /// Reads the bytes of a record, and whether they are as they were written.
    ///
    /// # Errors
    /// They are not a record of this format.
    pub fn from_bytes(bytes: &[u8]) -> Result<(RunRecord, bool), ReadError> {
        // An editor may have added a byte order mark.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let header: FormatHeader = serde_json::from_slice(bytes)?;
        if header.format != FORMAT_VERSION {
            return Err(header.format_error(bytes));
        }
        let is_as_written = is_as_written(bytes, &header)?;
        Ok((serde_json::from_slice(bytes)?, is_as_written))
    }

    /// The record that makes no claims: what is known of each family and file is only that an earlier run wrote it.
    pub fn without_claims(&self) -> RunRecord {
        let names = |files: &[FileRecord]| files.iter().map(|file| FileRecord::from_name(&file.name)).collect();
        let family = |family: &FamilyRecord| FamilyRecord {
            inputs_sha256: None,
            files: names(&family.files),
            ..family.without_files()
        };
        RunRecord {
            families: self.families.iter().map(family).collect(),
            book: self.book.as_ref().map(|book| BookRecord {
                inputs_sha256: None,
                files: names(&book.files),
                ..book.without_files()
            }),
            gallery: self.gallery.as_ref().map(|file| FileRecord::from_name(&file.name)),
            kernel: self.kernel.as_ref().map(|file| FileRecord::from_name(&file.name)),
            ..RunRecord::new(self.manifest.as_deref(), &self.title)
        }
    }

    /// The bytes of the record.
    pub fn to_bytes(&self) -> Vec<u8> {
        // Serializing a record cannot fail.
        let mut bytes = serde_json::to_vec_pretty(self).unwrap_or_default();
        bytes.push(b'\n');
        // After the brace and the format, which tells how to read the rest.
        let place = bytes.split_inclusive(|&byte| byte == b'\n').take(2).map(<[u8]>::len).sum::<usize>();
        let line = digest_line(Digest::of(&bytes));
        bytes.splice(place..place, line.into_bytes());
        bytes
    }
}

impl FamilyRecord {
    /// The record without its files.
    pub fn without_files(&self) -> FamilyRecord {
        let FamilyRecord { id, title, linkage, unit, .. } = self;
        FamilyRecord {
            id: id.clone(),
            title: title.clone(),
            linkage: linkage.clone(),
            unit: unit.clone(),
            files: Vec::new(),
            inputs_sha256: self.inputs_sha256,
            cells: self.cells,
            kept: self.kept,
            unassembled_left_out: self.unassembled_left_out,
            not_assembled: self.not_assembled,
            partly_assembled: self.partly_assembled,
            curves_left_out: self.curves_left_out,
            curves: self.curves,
            pages: self.pages,
        }
    }
}

impl BookRecord {
    /// The record without its files.
    pub fn without_files(&self) -> BookRecord {
        BookRecord { inputs_sha256: self.inputs_sha256, pages: self.pages, files: Vec::new() }
    }
}

impl FileRecord {
    /// Whether the record says anything about the file besides its name.
    pub fn makes_claims(&self) -> bool {
        self.sha256.is_some() || self.image_sha256.is_some() || self.inputs_sha256.is_some()
    }

    /// The record of a text with these bytes.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> FileRecord {
        FileRecord::from_digest(name, Digest::of(bytes))
    }

    /// The record of a text with this digest.
    pub fn from_digest(name: impl Into<String>, sha256: Digest) -> FileRecord {
        FileRecord { sha256: Some(sha256), ..FileRecord::from_name(name) }
    }

    /// The digest of what an image is drawn from: the page's SVG and the resolution.
    pub fn drawing_digest(svg: &[u8], dpi: f64) -> Digest {
        let mut digest = RunningDigest::default();
        digest.update(svg);
        digest.update(dpi.to_string().as_bytes());
        digest.finish()
    }

    /// The record of an image that is drawn from the SVG with this digest, see [`FileRecord::drawing_digest`].
    pub fn from_image(name: impl Into<String>, drawn_from_sha256: Digest, image: &[u8]) -> FileRecord {
        let image_sha256 = Some(Digest::of(image));
        FileRecord { drawn_from_sha256: Some(drawn_from_sha256), image_sha256, ..FileRecord::from_name(name) }
    }

    /// The record of a book with these bytes.
    pub fn from_book(name: impl Into<String>, book: &[u8]) -> FileRecord {
        FileRecord { image_sha256: Some(Digest::of(book)), ..FileRecord::from_name(name) }
    }

    /// A record with only the name of a file.
    pub fn from_name(name: impl Into<String>) -> FileRecord {
        FileRecord { name: name.into(), sha256: None, drawn_from_sha256: None, inputs_sha256: None, image_sha256: None }
    }

    /// Sets the digest of what the file was made from.
    pub fn with_inputs(self, inputs_sha256: Digest) -> FileRecord {
        FileRecord { inputs_sha256: Some(inputs_sha256), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_damaged_byte_is_noticed() {
        let mut run = RunRecord::new(Some("a.toml"), "T");
        run.gallery = Some(FileRecord::from_bytes("index.html", b"html"));
        let bytes = run.to_bytes();
        assert_eq!(RunRecord::from_bytes(&bytes).unwrap(), (run.clone(), true));
        let windows = String::from_utf8(bytes.clone()).unwrap().replace('\n', "\r\n");
        assert_eq!(RunRecord::from_bytes(format!("\u{feff}{windows}").as_bytes()).unwrap(), (run.clone(), true));
        let is_intact = |bytes: &[u8]| RunRecord::from_bytes(bytes).is_ok_and(|(_, is_as_written)| is_as_written);
        for k in 0..bytes.len() {
            for change in [1, 2, 16, 32, 128] {
                let mut damaged = bytes.clone();
                damaged[k] ^= change;
                assert!(!is_intact(&damaged), "byte {k}");
            }
            assert!(!is_intact(&bytes[..k]), "{k} bytes");
        }
        // A record of before there were digests.
        let is_digest = |line: &&str| line.starts_with(DIGEST_LINE);
        let older: String =
            std::str::from_utf8(&bytes).unwrap().split_inclusive('\n').filter(|line| !is_digest(line)).collect();
        assert_eq!(RunRecord::from_bytes(older.as_bytes()).unwrap(), (run, true));
    }
}
