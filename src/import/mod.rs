//! Linkages of other programs as manifests: readers of their formats, each to a sketch of joints and links, and from it a drawing.
//!
//! ```text
//! text -> sketch -> drawing -> manifest
//! ```

mod assembly;
mod drawing;
mod error;
mod joint_table;
mod json_values;
mod linkage2;
mod linkage_sim;
mod links;
mod manifest_text;
mod names;
mod pmks;
mod pmks_address;
mod pmks_short;
mod pylinkage;
mod pylinkage_components;
mod pyslvs;
mod sketch;

pub use drawing::{Drawing, DrawingInput};
pub use error::Error;
pub use manifest_text::manifest_text;

// For `export`, which draws linkages, too.
pub(crate) use self::{manifest_text::linkage_text, names::Names};

use serde_json::{Map, Value};
use sketch::Sketch;

/// A format of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// An address of PMKS+, readable or short.
    Pmks,
    /// The JSON of a mechanism of pylinkage, or of its components.
    Pylinkage,
    /// An expression of Pyslvs.
    Pyslvs,
    /// The lists or arrays of LINKS and LInK, in JSON.
    Links,
    /// A file of Linkage, in XML.
    Linkage2,
    /// The JSON of linkage_sim.
    LinkageSim,
    /// A table of joints and the bars between them.
    Csv,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 7] = [
        Format::Pmks,
        Format::Pylinkage,
        Format::Pyslvs,
        Format::Links,
        Format::Linkage2,
        Format::LinkageSim,
        Format::Csv,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Format::Pmks => "pmks",
            Format::Pylinkage => "pylinkage",
            Format::Pyslvs => "pyslvs",
            Format::Links => "links",
            Format::Linkage2 => "linkage2",
            Format::LinkageSim => "linkage_sim",
            Format::Csv => "csv",
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
        Some(Format::Pylinkage) => parse_pylinkage(&json_object(text)?),
        Some(Format::Links) => links::parse(&json_object(text)?),
        Some(Format::Linkage2) => linkage2::parse(text),
        Some(Format::LinkageSim) => linkage_sim::parse(&json_object(text)?),
        Some(Format::Csv) => joint_table::parse(text),
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
    text.starts_with(['{', '?'])
        || text.starts_with("http")
        || pyslvs::is_pyslvs(text)
        || linkage2::is_xml(text)
        || joint_table::is_table(text)
}

/// Whether a text is a linkage in one of the formats, as far as its beginning or its keys show it.
pub fn is_linkage(text: &str) -> bool {
    let text = text.trim_start();
    let is_json = |object: Map<String, Value>| format_of_object(&object).is_some();
    pyslvs::is_pyslvs(text)
        || joint_table::is_table(text)
        || linkage2::is_linkage2(text)
        || text.starts_with('{') && json_object(text).is_ok_and(is_json)
}

fn parse_any(text: &str) -> Result<Sketch, Error> {
    if text.starts_with('{') {
        let object = json_object(text)?;
        return match format_of_object(&object) {
            Some(Format::Pylinkage) => parse_pylinkage(&object),
            Some(Format::LinkageSim) => linkage_sim::parse(&object),
            Some(Format::Links) => links::parse(&object),
            _ => Err(unknown("the JSON is of no known format")),
        };
    }
    if pyslvs::is_pyslvs(text) {
        return pyslvs::parse(text);
    }
    if linkage2::is_xml(text) {
        return linkage2::parse(text);
    }
    if joint_table::is_table(text) {
        return joint_table::parse(text);
    }
    if pmks_address::query(text).is_some() {
        return parse_address(text);
    }
    Err(unknown(if text.is_empty() { "it is empty" } else { "its format is not known" }))
}

/// The format of an object, by its keys.
fn format_of_object(object: &Map<String, Value>) -> Option<Format> {
    if pylinkage::is_pylinkage(object) || pylinkage_components::is_components(object) {
        return Some(Format::Pylinkage);
    }
    if linkage_sim::is_linkage_sim(object) {
        return Some(Format::LinkageSim);
    }
    links::is_links(object).then_some(Format::Links)
}

fn unknown(message: &str) -> Error {
    let remedy = "give an address of PMKS+, the JSON of pylinkage, of LINKS or of linkage_sim, an expression of Pyslvs, a file of Linkage, or a \
                  table with the columns x, y and bars (docs/import.md)";
    Error::new("the text", message, remedy)
}

fn parse_pylinkage(object: &Map<String, Value>) -> Result<Sketch, Error> {
    if pylinkage_components::is_components(object) {
        return pylinkage_components::parse(object);
    }
    pylinkage::parse(object)
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
