//! Linkages of other programs as manifests: readers of their formats, each to a sketch of joints and links, and from it a drawing.
//!
//! ```text
//! text -> sketch -> drawing -> manifest
//! ```

mod drawing;
mod error;
mod json_values;
mod links;
mod manifest_text;
mod names;
mod pmks;
mod pmks_address;
mod pmks_short;
mod pylinkage;
mod pyslvs;
mod sketch;

pub use drawing::{Drawing, DrawingInput};
pub use error::Error;
pub use manifest_text::manifest_text;

use serde_json::{Map, Value};
use sketch::Sketch;

/// A format of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// An address of PMKS+, readable or short.
    Pmks,
    /// The JSON of a mechanism of pylinkage 1.x.
    Pylinkage,
    /// An expression of Pyslvs.
    Pyslvs,
    /// The lists or arrays of LINKS and LInK, in JSON.
    Links,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 4] = [Format::Pmks, Format::Pylinkage, Format::Pyslvs, Format::Links];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Format::Pmks => "pmks",
            Format::Pylinkage => "pylinkage",
            Format::Pyslvs => "pyslvs",
            Format::Links => "links",
        }
    }
}

/// The most bytes of a text.
pub const MAX_BYTES: usize = 1 << 23;

/// Reads the drawing in a text of another program, in a format that is given or follows from the text. `input` names what is
/// driven in place of the input in the text: two joints of a link, or two lines.
///
/// # Errors
/// What is wrong with the text, where, and what to do.
pub fn read(text: &str, format: Option<Format>, input: Option<&str>) -> Result<Drawing, Error> {
    if text.len() > MAX_BYTES {
        let message = format!("it has more than {MAX_BYTES} bytes, the most that are read");
        return Err(Error::new("the text", message, "import a single linkage"));
    }
    let text = text.trim();
    let sketch = match format {
        Some(Format::Pmks) => parse_address(text),
        Some(Format::Pyslvs) => pyslvs::parse(text),
        Some(Format::Pylinkage) => pylinkage::parse(&json_object(text)?),
        Some(Format::Links) => links::parse(&json_object(text)?),
        None => parse_any(text),
    }?;
    Drawing::new(sketch, input)
}

/// Whether a word is an address or an expression itself, and not the name of a file.
pub fn is_text(word: &str) -> bool {
    word.contains(['?', '\n']) || pyslvs::is_pyslvs(word)
}

/// Whether a text is that of another program, and not a manifest.
pub fn is_foreign(text: &str) -> bool {
    let text = text.trim_start();
    text.starts_with(['{', '?']) || text.starts_with("http") || pyslvs::is_pyslvs(text)
}

fn parse_any(text: &str) -> Result<Sketch, Error> {
    if text.starts_with('{') {
        let object = json_object(text)?;
        if pylinkage::is_pylinkage(&object) {
            return pylinkage::parse(&object);
        }
        if links::is_links(&object) {
            return links::parse(&object);
        }
        let name =
            if object.contains_key("bodies") { "that of linkage_sim, which is not read" } else { "of no known format" };
        return Err(unknown(&format!("the JSON is {name}")));
    }
    if pyslvs::is_pyslvs(text) {
        return pyslvs::parse(text);
    }
    if text.starts_with('<') {
        return Err(unknown("XML, such as a .linkage2 file of Linkage, is not read"));
    }
    if pmks_address::query(text).is_some() {
        return parse_address(text);
    }
    Err(unknown(if text.is_empty() { "it is empty" } else { "its format is not known" }))
}

fn unknown(message: &str) -> Error {
    let remedy = "give an address of PMKS+, the JSON of pylinkage, an expression of Pyslvs, or the JSON of LINKS (docs/import.md)";
    Error::new("the text", message, remedy)
}

fn parse_address(text: &str) -> Result<Sketch, Error> {
    let query = pmks_address::query(text).unwrap_or(text);
    if pmks_address::is_readable(query) { pmks_address::parse(query) } else { pmks_short::parse(query) }
}

fn json_object(text: &str) -> Result<Map<String, Value>, Error> {
    match serde_json::from_str(text) {
        Ok(Value::Object(object)) => Ok(object),
        Ok(_) => Err(Error::new("line 1, column 1", "expected an object", "write { … }")),
        Err(error) => {
            // The message of serde_json ends with the place.
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            let place = format!("line {}, column {}", error.line(), error.column());
            Err(Error::new(place, format!("it is not JSON: {message}"), "save the file again where it was made"))
        }
    }
}
