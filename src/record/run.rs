//! The record of a run, `run.json`.

use std::io::Read;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

/// The version of the format of `run.json`.
pub const FORMAT_VERSION: u32 = 1;

/// The most bytes of a record, enough for some millions of files.
const MAX_BYTES: u64 = 1 << 30;

/// `run.json`: what a run has written. It has no time, host, path or number of threads, so equal runs have equal bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunRecord {
    /// The version of the format.
    pub format: u32,
    /// The program that wrote it.
    pub program: String,
    /// The program's version.
    pub version: String,
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
}

/// The record of the book.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BookRecord {
    /// SHA-256 of what it was made from; `None` while it is not finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<String>,
    /// The number of its pages, including front matter and index.
    pub pages: usize,
    /// Its volumes, in the atlas's folder.
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
    /// SHA-256 of what all its files were made from; `None` while not all of them are finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<String>,
    /// The number of its cells.
    pub cells: usize,
    /// The number of cells kept by `where`.
    pub kept: usize,
    /// The number of kept cells that could not be assembled, or not over the whole requested range.
    pub not_assembled: usize,
    /// The number of curves of kept cells that `where` left out.
    pub curves_left_out: usize,
    /// The number of traced curves.
    pub curves: usize,
    /// The number of its pages.
    pub pages: usize,
    /// Its files, in its folder.
    pub files: Vec<FileRecord>,
}

/// The record of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Its name.
    pub name: String,
    /// SHA-256 of its bytes; `None` for an image or a book, whose bytes may differ from machine to machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// SHA-256 of what an image is drawn from: the page's SVG and the resolution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn_from_sha256: Option<String>,
    /// SHA-256 of what a page is made from: the program's version, its part of the manifest, and the cells on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<String>,
}

/// An error of reading a `run.json`.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be read.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// It is not a regular file, or larger than any record.
    #[error("it is not the record of a run: it is not a regular file, or has more than {MAX_BYTES} bytes")]
    NotARecord,
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
    /// An empty record of an atlas.
    pub fn new(title: &str) -> RunRecord {
        let (program, version) = (env!("CARGO_PKG_NAME").to_owned(), env!("CARGO_PKG_VERSION").to_owned());
        RunRecord {
            format: FORMAT_VERSION,
            program,
            version,
            title: title.to_owned(),
            families: Vec::new(),
            book: None,
            gallery: None,
        }
    }

    /// Reads a record.
    ///
    /// # Errors
    /// The file cannot be read, or is not a record of this format.
    pub fn read(path: &Path) -> Result<RunRecord, ReadError> {
        let metadata = std::fs::metadata(path)?;
        if !metadata.is_file() || metadata.len() > MAX_BYTES {
            return Err(ReadError::NotARecord);
        }
        let mut bytes = Vec::new();
        std::fs::File::open(path)?.take(MAX_BYTES).read_to_end(&mut bytes)?;
        // An editor may have added a byte order mark.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let header: FormatHeader = serde_json::from_slice(bytes)?;
        if header.format != FORMAT_VERSION {
            return Err(header.format_error(bytes));
        }
        Ok(serde_json::from_slice(bytes)?)
    }

    /// The bytes of the record.
    pub fn to_bytes(&self) -> Vec<u8> {
        // Serializing a record cannot fail.
        let mut bytes = serde_json::to_vec_pretty(self).unwrap_or_default();
        bytes.push(b'\n');
        bytes
    }
}

impl FileRecord {
    /// The record of a file with these bytes.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> FileRecord {
        let mut digest = RunningDigest::default();
        digest.update(bytes);
        digest.into_file_record(name)
    }

    /// The record of an image that is drawn from this SVG.
    pub fn from_page_svg(name: impl Into<String>, svg: &[u8], dpi: f64) -> FileRecord {
        let mut digest = RunningDigest::default();
        digest.update(svg);
        digest.update(dpi.to_string().as_bytes());
        let drawn_from_sha256 = Some(digest.finish());
        FileRecord { drawn_from_sha256, ..FileRecord::from_name(name) }
    }

    /// A record with only the name of a file.
    pub fn from_name(name: impl Into<String>) -> FileRecord {
        FileRecord { name: name.into(), sha256: None, drawn_from_sha256: None, inputs_sha256: None }
    }

    /// Sets the digest of what the file was made from.
    pub fn with_inputs(self, inputs_sha256: &str) -> FileRecord {
        FileRecord { inputs_sha256: Some(inputs_sha256.to_owned()), ..self }
    }
}

/// The digest of a file that is still being written.
#[derive(Clone, Default)]
pub struct RunningDigest(Sha256);

impl std::io::Write for RunningDigest {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl RunningDigest {
    /// Adds bytes to the digest.
    pub fn update(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// The record of the file.
    pub fn into_file_record(self, name: impl Into<String>) -> FileRecord {
        FileRecord { sha256: Some(self.finish()), ..FileRecord::from_name(name) }
    }

    /// The digest, in hexadecimal digits.
    pub fn finish(self) -> String {
        format!("{:x}", self.0.finalize())
    }
}

/// Two digests of a text: of its bytes, and of its bytes without carriage returns, as this program writes it.
#[derive(Clone, Default)]
pub struct TextDigests([RunningDigest; 2]);

impl TextDigests {
    /// Both digests, in hexadecimal digits.
    pub fn finish(self) -> [String; 2] {
        self.0.map(RunningDigest::finish)
    }
}

impl std::io::Write for TextDigests {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0[0].update(bytes);
        bytes.split(|&byte| byte == b'\r').for_each(|part| self.0[1].update(part));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
