//! The journal of a run: what it has finished so far, a line for each event.
//!
//! A run that is killed leaves its journal behind. Together with `run.json` it says which files are complete, so that the
//! next run continues from there. Lines are only appended; a line that was not written to its end is ignored.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::digest::Digest;
use super::regular_file::open_regular_file;
use super::run::{BookRecord, FamilyRecord, FileRecord, RunRecord};
use crate::manifest::MAX_MANIFEST_BYTES;
use crate::sweep::Division;

/// The most families and files that a journal may add to a record, twice as many as an atlas may have.
const MAX_ADDITIONS: usize = 1_000_000;

/// The most volumes that a journal may add to the record of a book.
const MAX_VOLUMES: usize = 10_000;

/// A line of a journal. Paths are relative to the folder of the atlas, with `/` between folders.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JournalEntry {
    /// The atlas that is written, without its families and files; the first line.
    Atlas(Box<RunRecord>),
    /// The record of a family, without its files. It replaces an earlier one, which keeps its files.
    Family(FamilyRecord),
    /// The record of the book, without its files, which an earlier one keeps.
    Book(BookRecord),
    /// The file at this path is going to be replaced: nothing is known about it from here on.
    Writing(String),
    /// A file is complete.
    Written {
        /// Its path.
        path: String,
        /// Its record; the name in it is empty.
        #[serde(flatten)]
        file: FileRecord,
        /// See [`FileRecord::image_sha256`].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        image_sha256: Option<Digest>,
    },
    /// A piece of the gallery's data of a family is complete.
    Piece {
        /// The id of the family.
        family: String,
        /// Its number among the pieces of the family, from 0.
        number: usize,
        /// Its entry in the index of pieces.
        index: Value,
    },
    /// How far the tables of a family have been written.
    Progress(FamilyProgress),
    /// That only a shard of the pages is drawn.
    Shard(PageShardHead),
    /// A part of the text of the manifest of a shard.
    Manifest(String),
    /// The shard is complete.
    Finished,
}

/// Which of the pages of an atlas a shard has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PageShardHead {
    /// Which of the pages of each family.
    pub division: Division,
    /// The formats in place of those of the manifest, by name, in order.
    pub formats: Option<Vec<String>>,
    /// The folder of the manifest, in which the files are that it names, relative to that of the atlas.
    #[serde(default)]
    pub manifest_folder: Option<String>,
}

/// A shard of the pages of an atlas, as its journal records it.
#[derive(Debug)]
pub struct PageShardRecord {
    /// Which pages it has.
    pub head: PageShardHead,
    /// The text of its manifest.
    pub manifest: String,
    /// Whether all its pages are drawn.
    pub is_finished: bool,
    /// The pages that are drawn.
    pub run: RunRecord,
}

impl PageShardRecord {
    /// Reads the journal of a shard; `None` if it is none.
    ///
    /// # Errors
    /// The journal cannot be read.
    pub fn read(journal: &Path) -> io::Result<Option<PageShardRecord>> {
        let open = || open_regular_file(journal, u64::MAX).map(BufReader::new).map_err(io::Error::other);
        let mut lines = Lines { journal: open()?, line: Vec::new() };
        let (mut head, mut manifest, mut is_finished) = (None, String::new(), false);
        while let Some(line) = lines.next_line()? {
            match serde_json::from_slice(line) {
                Ok(JournalEntry::Shard(found)) => head = Some(found),
                Ok(JournalEntry::Manifest(text)) if manifest.len() <= MAX_MANIFEST_BYTES => manifest.push_str(&text),
                Ok(JournalEntry::Finished) => is_finished = true,
                _ => {}
            }
        }
        let replay = JournalReplay::new(None, open()?)?;
        Ok(head.zip(replay).map(|(head, replay)| PageShardRecord {
            head,
            manifest,
            is_finished,
            run: replay.finish().0,
        }))
    }
}

/// How far the tables of a family have been written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FamilyProgress {
    /// The id of the family.
    pub family: String,
    /// SHA-256 of what its files are made from.
    pub inputs_sha256: Digest,
    /// The number of groups of cells whose rows are in the tables.
    pub groups: usize,
    /// The number of groups of sorted cells whose pages are finished; 0 if the pages are not sorted.
    pub sorted_groups: usize,
    /// The number of curves in the tables.
    pub curves: usize,
    /// The number of curves that `where` left out.
    pub curves_left_out: usize,
    /// The number of cells that could not be assembled, or not over the whole requested range.
    pub not_assembled: usize,
    /// The number of those that are assembled over a part of the range.
    #[serde(default)]
    pub partly_assembled: usize,
    /// The unfinished tables.
    pub tables: Vec<PartialFile>,
    /// The number of finished pieces of the gallery's data.
    pub pieces: usize,
    /// What the unfinished pieces contain.
    pub open_pieces: Value,
}

/// The beginning of a file that is being written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartialFile {
    /// The file's final name.
    pub name: String,
    /// The number of bytes.
    pub bytes: u64,
    /// SHA-256 of these bytes.
    pub sha256: Digest,
}

impl JournalEntry {
    /// The entry of a finished file; `folder` is empty, or the id of the family.
    pub fn written(folder: &str, file: FileRecord) -> JournalEntry {
        let path = path_in_atlas(folder, &file.name);
        let image_sha256 = file.image_sha256;
        JournalEntry::Written { path, file: FileRecord { name: String::new(), ..file }, image_sha256 }
    }

    /// The line of the entry, with its end.
    pub fn to_line(&self) -> Vec<u8> {
        // Serializing an entry cannot fail.
        let mut line = serde_json::to_vec(self).unwrap_or_default();
        line.push(b'\n');
        line
    }
}

/// The path of a file in the folder of an atlas; `folder` is empty, or the id of the family.
pub fn path_in_atlas(folder: &str, name: &str) -> String {
    if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") }
}

/// The complete lines of a journal.
struct Lines<R> {
    journal: R,
    line: Vec<u8>,
}

impl<R: BufRead> Lines<R> {
    /// The next line; `None` if there is no more, or if it is incomplete or longer than any that a run writes.
    fn next_line(&mut self) -> io::Result<Option<&[u8]>> {
        const MAX_LINE_BYTES: u64 = 1 << 20;
        self.line.clear();
        (&mut self.journal).take(MAX_LINE_BYTES).read_until(b'\n', &mut self.line)?;
        Ok(self.line.strip_suffix(b"\n"))
    }
}

/// The state of the atlas that `run.json` and a journal describe.
#[derive(Debug)]
pub struct JournalReplay {
    run: RunRecord,
    /// The place of each family in the record, by id.
    families: HashMap<String, FamilyPlace>,
    /// The last progress of each family.
    progress: HashMap<String, FamilyProgress>,
    /// The index of the finished pieces of each family.
    pieces: HashMap<String, Vec<Value>>,
    /// How many more families and files may be added; a journal is not trusted.
    additions_left: usize,
}

#[derive(Debug)]
struct FamilyPlace {
    index: usize,
    /// The index of each of its files, by name.
    files: HashMap<String, usize>,
}

impl FamilyPlace {
    fn new(index: usize, files: &[FileRecord]) -> FamilyPlace {
        FamilyPlace { index, files: files.iter().enumerate().map(|(k, file)| (file.name.clone(), k)).collect() }
    }
}

impl JournalReplay {
    /// Replays a journal on the record of an earlier run; `None` if there is neither.
    ///
    /// # Errors
    /// The journal cannot be read.
    pub fn new(earlier: Option<RunRecord>, journal: impl BufRead) -> io::Result<Option<JournalReplay>> {
        let mut lines = Lines { journal, line: Vec::new() };
        let header = lines.next_line()?.and_then(|line| match serde_json::from_slice(line) {
            Ok(JournalEntry::Atlas(header)) => Some(*header),
            _ => None,
        });
        let is_journal = header.is_some();
        let run = match (header, earlier) {
            (Some(header), Some(RunRecord { families, book, gallery, kernel, .. })) => {
                RunRecord { families, book, gallery, kernel, ..header }
            }
            (Some(header), None) => {
                RunRecord { families: Vec::new(), book: None, gallery: None, kernel: None, ..header }
            }
            (None, Some(earlier)) => earlier,
            (None, None) => return Ok(None),
        };
        let places = run.families.iter().enumerate();
        let families = places.map(|(k, family)| (family.id.clone(), FamilyPlace::new(k, &family.files))).collect();
        let mut replay = JournalReplay {
            run,
            families,
            progress: HashMap::new(),
            pieces: HashMap::new(),
            additions_left: MAX_ADDITIONS,
        };
        while let Some(line) = lines.next_line()?.filter(|_| is_journal) {
            if let Ok(entry) = serde_json::from_slice(line) {
                replay.apply(entry);
            }
        }
        Ok(Some(replay))
    }

    /// The record of the atlas, the last progress of each family, and the index of its finished pieces.
    pub fn finish(self) -> (RunRecord, Vec<FamilyProgress>, HashMap<String, Vec<Value>>) {
        (self.run, self.progress.into_values().collect(), self.pieces)
    }

    fn apply(&mut self, entry: JournalEntry) {
        match entry {
            JournalEntry::Atlas(_) | JournalEntry::Shard(_) | JournalEntry::Manifest(_) | JournalEntry::Finished => {}
            JournalEntry::Family(record) => match self.families.get(&record.id) {
                Some(place) => {
                    let files = std::mem::take(&mut self.run.families[place.index].files);
                    self.run.families[place.index] = FamilyRecord { files, ..record };
                }
                None if self.additions_left == 0 => {}
                None => {
                    self.additions_left -= 1;
                    let place = FamilyPlace::new(self.run.families.len(), &[]);
                    self.families.insert(record.id.clone(), place);
                    self.run.families.push(FamilyRecord { files: Vec::new(), ..record });
                }
            },
            JournalEntry::Book(record) => {
                let files = self.run.book.take().map(|book| book.files).unwrap_or_default();
                self.run.book = Some(BookRecord { files, ..record });
            }
            JournalEntry::Writing(path) => self.set_file(&path, FileRecord::from_name("")),
            JournalEntry::Written { path, file, image_sha256 } => {
                self.set_file(&path, FileRecord { image_sha256, ..file });
            }
            JournalEntry::Piece { family, number, index } => {
                let pieces = match self.pieces.entry(family) {
                    Entry::Occupied(pieces) => pieces.into_mut(),
                    Entry::Vacant(vacant) if self.families.contains_key(vacant.key()) => vacant.insert(Vec::new()),
                    Entry::Vacant(_) => return,
                };
                // A run that starts a family anew counts its pieces from 0 again.
                pieces.truncate(number);
                if pieces.len() < MAX_ADDITIONS {
                    pieces.push(index);
                }
            }
            JournalEntry::Progress(progress) if !self.families.contains_key(&progress.family) => {}
            JournalEntry::Progress(progress) => {
                self.progress.insert(progress.family.clone(), progress);
            }
        }
    }

    /// Replaces the record of the file at a path.
    fn set_file(&mut self, path: &str, file: FileRecord) {
        let Some((folder, name)) = path.split_once('/') else {
            let file = FileRecord { name: path.to_owned(), ..file };
            match &mut self.run.book {
                Some(book) if path.ends_with(".pdf") => match book.files.iter().position(|known| known.name == path) {
                    Some(index) => book.files[index] = file,
                    None if book.files.len() < MAX_VOLUMES => book.files.push(file),
                    None => {}
                },
                _ if path.ends_with(".js") => self.run.kernel = Some(file),
                _ => self.run.gallery = Some(file),
            }
            return;
        };
        let Some(place) = self.families.get_mut(folder) else { return };
        let files = &mut self.run.families[place.index].files;
        let file = FileRecord { name: name.to_owned(), ..file };
        match place.files.get(name) {
            Some(&index) => files[index] = file,
            None if self.additions_left == 0 => {}
            None => {
                self.additions_left -= 1;
                place.files.insert(name.to_owned(), files.len());
                files.push(file);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn family(id: &str, inputs: Option<&str>, files: Vec<FileRecord>) -> FamilyRecord {
        FamilyRecord {
            id: id.to_owned(),
            title: "T".to_owned(),
            linkage: "evans".to_owned(),
            unit: None,
            inputs_sha256: inputs.map(|text| Digest::of(text.as_bytes())),
            cells: 1,
            kept: 1,
            unassembled_left_out: 0,
            not_assembled: 0,
            partly_assembled: 0,
            curves_left_out: 0,
            curves: 1,
            pages: 2,
            files,
        }
    }

    fn journal(entries: &[JournalEntry]) -> Vec<u8> {
        entries.iter().flat_map(JournalEntry::to_line).collect()
    }

    #[test]
    fn a_journal_changes_what_an_earlier_record_says() {
        let page = |number: u32, text: &str| FileRecord::from_bytes(format!("e-{number:03}.svg"), text.as_bytes());
        let mut earlier = RunRecord::new(Some("a.toml"), "Old");
        earlier.families =
            vec![family("e", Some("old"), vec![page(1, "old"), page(2, "old")]), family("f", None, vec![])];
        let png = FileRecord::from_image("g-001.png", Digest::of(b"svg"), b"png");
        let lines = journal(&[
            JournalEntry::Atlas(Box::new(RunRecord::new(Some("a.toml"), "New"))),
            JournalEntry::Family(family("e", None, vec![])),
            JournalEntry::Writing("e/e-001.svg".to_owned()),
            JournalEntry::Writing("e/e-002.svg".to_owned()),
            JournalEntry::written("e", page(1, "new")),
            JournalEntry::Family(family("g", None, vec![])),
            JournalEntry::written("g", png.clone()),
            JournalEntry::Book(BookRecord { inputs_sha256: None, pages: 3, files: vec![] }),
            JournalEntry::written("", FileRecord::from_book("atlas.pdf", b"pdf")),
            JournalEntry::written("", FileRecord::from_bytes("index.html", b"html")),
            JournalEntry::written("", FileRecord::from_bytes("kernel.js", b"js")),
        ]);
        // A line that was not written to its end is ignored, and so is a line of nonsense.
        for cut in 0..3 {
            let text = [&lines[..], b"nonsense\n", b"{\"writing\":\"e/e-001.svg\"}\n"].concat();
            let replay = JournalReplay::new(Some(earlier.clone()), &text[..text.len() - 1 - cut]).unwrap().unwrap();
            let (run, progress, _) = replay.finish();
            assert!(progress.is_empty());
            assert_eq!(run.title, "New");
            assert_eq!(run.families[0], family("e", None, vec![page(1, "new"), FileRecord::from_name("e-002.svg")]));
            assert_eq!(run.families[1], earlier.families[1]);
            assert_eq!(run.families[2], family("g", None, vec![png.clone()]));
            assert_eq!(run.book.unwrap().files, [FileRecord::from_book("atlas.pdf", b"pdf")]);
            assert_eq!(run.gallery.unwrap(), FileRecord::from_bytes("index.html", b"html"));
            assert_eq!(run.kernel.unwrap(), FileRecord::from_bytes("kernel.js", b"js"));
        }
        assert_eq!(JournalReplay::new(Some(earlier.clone()), &b""[..]).unwrap().unwrap().finish().0, earlier);
        assert!(JournalReplay::new(None, &lines[..10]).unwrap().is_none());
        assert_eq!(JournalReplay::new(None, &lines[..]).unwrap().unwrap().finish().0.families.len(), 2);
    }
}
