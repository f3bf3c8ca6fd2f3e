//! Default values as the JSON of the schema, computed from the constants that the parser uses.

use std::fmt::Display;

/// An empty table.
pub(crate) fn empty_table() -> String {
    "{}".to_owned()
}

/// An empty list.
pub(crate) fn empty_list() -> String {
    "[]".to_owned()
}

/// A string of plain characters.
pub(crate) fn string(text: &str) -> String {
    format!("\"{text}\"")
}

/// A list of words.
pub(crate) fn strings(words: impl IntoIterator<Item = &'static str>) -> String {
    format!("[{}]", words.into_iter().map(string).collect::<Vec<_>>().join(", "))
}

/// The word that stands for a value in a table of words; empty, and so no JSON, if none does.
pub(crate) fn word<T: PartialEq>(words: &[(&'static str, T)], value: &T) -> String {
    words.iter().find(|(_, other)| other == value).map(|(word, _)| string(word)).unwrap_or_default()
}

/// An angle in degrees.
pub(crate) fn degrees(angle: impl Display) -> String {
    format!("\"{angle} deg\"")
}
