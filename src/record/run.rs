use std::io::Read;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

/// The version of the format of `run.json`.
pub const FORMAT_VERSION: u32 = 1;

/// A record of more bytes, some millions of files, is none.
const MAX_BYTES: u64 = 1 << 30;

/// `run.json`: what a run has written. No time, host, path or number of jobs, so that the same run has the same bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunRecord {
    /// The version of this format.
    pub format: u32,
    /// The program that wrote it.
    pub program: String,
    /// The program's version.
    pub version: String,
    /// The atlas's title.
    pub title: String,
    /// The families, in the order of the manifest.
    pub families: Vec<FamilyRecord>,
    /// The book, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub book: Option<BookRecord>,
    /// The gallery's page.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gallery: Option<FileRecord>,
}

/// What was written of the book.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BookRecord {
    /// SHA-256 of what it was made from; none while it is not finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<String>,
    /// How many pages it has, with those that stand before and after those of the families.
    pub pages: usize,
    /// Its volumes, in the atlas's folder.
    pub files: Vec<FileRecord>,
}

/// What was written of a family.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FamilyRecord {
    /// Its id, and the name of its folder.
    pub id: String,
    /// Its title.
    pub title: String,
    /// The linkage.
    pub linkage: String,
    /// SHA-256 of what all its files were made from; none while they are not all finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<String>,
    /// How many cells it has.
    pub cells: usize,
    /// How many of them `where` kept.
    pub kept: usize,
    /// How many of those could not be assembled, or not over the whole range asked for.
    pub not_assembled: usize,
    /// How many curves of the cells kept `where` left out.
    pub curves_left_out: usize,
    /// How many curves were traced.
    pub curves: usize,
    /// How many pages there are.
    pub pages: usize,
    /// Its files, in its folder.
    pub files: Vec<FileRecord>,
}

/// A file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRecord {
    /// Its name.
    pub name: String,
    /// SHA-256 of its bytes; none for an image or a book, whose bytes may differ from machine to machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// SHA-256 of what an image is drawn from: the page's SVG, and the resolution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn_from_sha256: Option<String>,
    /// SHA-256 of what a page is made from: the program's version, what the manifest says, and the cells on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inputs_sha256: Option<String>,
}

/// Why a `run.json` cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be read.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// It is no file, or one that is larger than any record.
    #[error("it is no record of a run: it is no file, or has more than {MAX_BYTES} bytes")]
    NotARecord,
    /// It is not what this program writes.
    #[error("it is no record of a run: {0}")]
    Syntax(#[from] serde_json::Error),
    /// It is of another format.
    #[error(
        "it has format {format} on line {line}, written by {writer}, and this is {} {}, which reads format {FORMAT_VERSION}",
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION")
    )]
    UnsupportedFormat {
        /// The format, as it is written.
        format: String,
        /// The line it stands on, from 1.
        line: usize,
        /// The program that wrote it, and its version, as far as it says so.
        writer: String,
    },
}

/// What records of all formats say of themselves.
#[derive(Deserialize)]
struct FormatHeader {
    format: Value,
    #[serde(default)]
    program: Value,
    #[serde(default)]
    version: Value,
}

/// No value at all.
#[derive(Deserialize)]
enum Never {}

/// What cannot be read of any record, and no further than its format.
#[derive(Deserialize)]
struct FormatLocator {
    #[serde(rename = "format")]
    _format: Never,
}

impl FormatHeader {
    /// What is wrong with a format that is not this program's.
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
    /// A file that cannot be read, or is no record of this format.
    pub fn read(path: &Path) -> Result<RunRecord, ReadError> {
        let metadata = std::fs::metadata(path)?;
        if !metadata.is_file() || metadata.len() > MAX_BYTES {
            return Err(ReadError::NotARecord);
        }
        let mut bytes = Vec::new();
        std::fs::File::open(path)?.take(MAX_BYTES).read_to_end(&mut bytes)?;
        // An editor may have put a byte order mark before it.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let header: FormatHeader = serde_json::from_slice(bytes)?;
        if header.format != FORMAT_VERSION {
            return Err(header.format_error(bytes));
        }
        Ok(serde_json::from_slice(bytes)?)
    }

    /// The bytes of the record.
    pub fn to_bytes(&self) -> Vec<u8> {
        // A record has nothing that JSON cannot say.
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

    /// The record of an image by what it is drawn from.
    pub fn from_page_svg(name: impl Into<String>, svg: &[u8], dpi: f64) -> FileRecord {
        let mut digest = RunningDigest::default();
        digest.update(svg);
        digest.update(dpi.to_string().as_bytes());
        let drawn_from_sha256 = Some(digest.finish());
        FileRecord { drawn_from_sha256, ..FileRecord::from_name(name) }
    }

    /// The record of a file of which nothing but its name is known.
    pub fn from_name(name: impl Into<String>) -> FileRecord {
        FileRecord { name: name.into(), sha256: None, drawn_from_sha256: None, inputs_sha256: None }
    }

    /// The same, with what the file was made from.
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
    /// Takes in more bytes.
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

/// Two digests of a text: of its bytes as they are, and without carriage returns, as this program would have written it.
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
