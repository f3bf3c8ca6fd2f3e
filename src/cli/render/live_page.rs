//! The page of `render --watch --open`: the pages of an atlas, as they change.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde::Serialize;
use tempfile::TempDir;

use super::rendering::Rendered;

/// A page in a temporary folder, with a script that it reads again and again: a page on disk can read no other files.
pub(super) struct LivePage {
    folder: TempDir,
    path: PathBuf,
    state: State,
}

/// What the page shows.
#[derive(Default, Serialize)]
struct State {
    title: String,
    /// The problems of the manifest, if it has not been rendered.
    problem: Option<String>,
    pages: Vec<Page>,
}

#[derive(Serialize)]
struct Page {
    /// Its address, with its digest, so that a changed page is read again.
    address: String,
    name: String,
}

const PAGE_FILE: &str = "index.html";
const STATE_FILE: &str = "state.js";

/// The characters of a path that an address has as they are.
const KEPT: &AsciiSet = &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'_').remove(b'.').remove(b':');

impl LivePage {
    /// A page without an atlas.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn new() -> io::Result<LivePage> {
        let folder = TempDir::with_prefix("coupler-atlas-")?;
        let path = folder.path().join(PAGE_FILE);
        fs::write(&path, include_str!("live-page.html"))?;
        let page = LivePage { folder, path, state: State::default() };
        page.write()?;
        Ok(page)
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Shows an atlas.
    ///
    /// # Errors
    /// The page cannot be written.
    pub fn show(&mut self, Rendered { output, run, .. }: &Rendered) -> io::Result<()> {
        let output = output.canonicalize()?;
        self.state.title.clone_from(&run.title);
        self.state.problem = None;
        self.state.pages.clear();
        for family in &run.families {
            let is_page = |name: &str| name.ends_with(".svg");
            let has_svg = family.files.iter().any(|file| is_page(&file.name));
            for file in &family.files {
                if !(is_page(&file.name) || (!has_svg && file.is_image())) {
                    continue;
                }
                let path = output.join(&family.id).join(&file.name).to_string_lossy().replace('\\', "/");
                let slash = if path.starts_with('/') { "" } else { "/" };
                let path = utf8_percent_encode(&path, KEPT);
                let digest = file.sha256.or(file.drawn_from_sha256).map_or(String::new(), |digest| digest.to_string());
                self.state
                    .pages
                    .push(Page { address: format!("file://{slash}{path}?{digest}"), name: file.name.clone() });
            }
        }
        self.write()
    }

    /// Shows the problems of a manifest, above the pages of before.
    ///
    /// # Errors
    /// The page cannot be written.
    pub fn show_problem(&mut self, problem: &str) -> io::Result<()> {
        self.state.problem = Some(problem.to_owned());
        self.write()
    }

    fn write(&self) -> io::Result<()> {
        let script = format!("show({});\n", serde_json::to_string(&self.state)?);
        let mut file = tempfile::NamedTempFile::new_in(self.folder.path())?;
        io::Write::write_all(&mut file, script.as_bytes())?;
        file.persist(self.folder.path().join(STATE_FILE))?;
        Ok(())
    }
}
