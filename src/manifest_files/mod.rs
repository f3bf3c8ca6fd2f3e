//! What a manifest needs besides its text: the fonts and tables of cases that it names, as CSV or Parquet, and the answers of its searches.

mod case_rows;
mod csv_table;
mod designs;
mod known_table;
mod parquet_table;

use std::cell::RefCell;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::manifest::{CaseTable, DesignRequest, FileProblem, Files, WishPlace};
use crate::output::{self, Error};
use case_rows::{CaseRows, MAX_TABLE_BYTES};
use coupler_curves::template::Template;
use designs::Progress;

pub use known_table::KnownTable;

/// The most bytes of a font file: those for Chinese, Japanese and Korean have some 20 MB.
const MAX_FONT_BYTES: u64 = 1 << 26;

/// Reads the files that a manifest names while it is parsed, relative to its folder. That one is missing or wrong is a problem of the manifest.
pub struct ManifestFiles {
    folder: PathBuf,
    known: Vec<KnownTable>,
    named: RefCell<Vec<NamedFile>>,
    failure: RefCell<Option<Error>>,
    report_part: Box<Progress>,
}

/// A file that a manifest names, as it was before it was read.
pub struct NamedFile {
    /// Its path.
    pub path: PathBuf,
    state: Option<fs::Metadata>,
}

impl ManifestFiles {
    /// Those of the manifest at a path; of one from standard input they are relative to the current folder.
    pub fn new(manifest: &Path) -> ManifestFiles {
        let folder = manifest.parent().unwrap_or(Path::new("")).to_owned();
        let (named, failure) = (RefCell::default(), RefCell::default());
        ManifestFiles { folder, known: Vec::new(), named, failure, report_part: Box::new(|_, _| {}) }
    }

    /// The same that says of a search, by what its answers are called, which part of it is done, from 0 to 1.
    pub fn with_progress(self, report_part: impl Fn(&str, f64) + 'static) -> ManifestFiles {
        ManifestFiles { report_part: Box::new(report_part), ..self }
    }

    /// The same with tables that have been read before, and are not read again.
    pub fn with_tables(self, known: Vec<KnownTable>) -> ManifestFiles {
        ManifestFiles { known, ..self }
    }

    /// The files that the manifest has named so far, whether they can be read or not.
    pub fn take_named(&self) -> Vec<NamedFile> {
        self.named.take()
    }

    /// That the system failed to read one of them, so that nothing is known about it, if it did.
    pub fn take_failure(&self) -> Option<Error> {
        self.failure.take()
    }

    /// Opens a file of at most so many bytes.
    fn open(&self, name: &str, max_bytes: u64) -> io::Result<io::Take<File>> {
        let named = NamedFile::new(self.folder.join(name));
        let opened = output::open_regular(&named.path);
        self.named.borrow_mut().push(named);
        let file = opened?;
        if file.metadata()?.len() > max_bytes {
            let message = format!("it has more than {max_bytes} bytes");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        Ok(file.take(max_bytes))
    }

    /// Says why a file cannot be read, and keeps it if the system has failed.
    fn describe(&self, name: &str, source: io::Error) -> String {
        let message = source.to_string();
        if !output::is_wrong_input(&source) {
            self.failure.replace(Some(Error::Read { path: self.folder.join(name), source }));
        }
        message
    }
}

impl Files for ManifestFiles {
    fn font(&self, name: &str) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let read = self.open(name, MAX_FONT_BYTES).and_then(|mut file| file.read_to_end(&mut bytes));
        read.map_err(|error| self.describe(name, error))?;
        Ok(bytes)
    }

    fn cases(&self, name: &str, limit: usize, report: &mut dyn FnMut(FileProblem)) -> Option<CaseTable> {
        let is_parquet = Path::new(name).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("parquet"));
        let mut rows = CaseRows::new(name, limit, report);
        if let Some(known) = self.known.iter().find(|known| known.path == name) {
            if let Err(error) = known.read(&mut rows) {
                rows.report_unreadable(&error.to_string());
                return None;
            }
            return rows.into_table();
        }
        let read = self.open(name, MAX_TABLE_BYTES).and_then(|file| match is_parquet {
            true => parquet_table::read(file.into_inner(), &mut rows),
            false => csv_table::read(file, &mut rows),
        });
        if let Err(error) = read {
            let message = self.describe(name, error);
            rows.report_unreadable(&message);
            return None;
        }
        rows.into_table()
    }

    fn designs(
        &self,
        template: &Template,
        request: &DesignRequest,
        report: &mut dyn FnMut(WishPlace, FileProblem),
    ) -> Option<CaseTable> {
        let known = self.known.iter().find(|known| known.path == request.name);
        designs::search(template, request, (known, &self.report_part), report)
    }
}

impl NamedFile {
    fn new(path: PathBuf) -> NamedFile {
        NamedFile { state: fs::metadata(&path).ok(), path }
    }

    /// The same file as it is now.
    pub fn now(&self) -> NamedFile {
        NamedFile::new(self.path.clone())
    }

    /// Whether there is a file.
    pub fn exists(&self) -> bool {
        self.state.is_some()
    }
}

impl PartialEq for NamedFile {
    /// Whether it is the same file with the same length and time.
    fn eq(&self, other: &NamedFile) -> bool {
        let [state, other_state] = [self, other].map(|file| file.state.as_ref().map(|s| (s.len(), s.modified().ok())));
        self.path == other.path && state == other_state
    }
}
