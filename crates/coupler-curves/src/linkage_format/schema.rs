//! The schema of a manifest: its tables, their keys, and the values allowed at each key.
//!
//! The parser accepts the keys of these tables only, and the JSON schema for editors is generated from them, so that
//! both have the same keys.

use crate::expression::Dimension;
use crate::problem::nearest_word;

/// A table with a fixed set of keys.
#[derive(Debug)]
pub struct TableSchema {
    /// Its name in messages.
    pub display_name: &'static str,
    /// Its keys.
    pub keys: &'static [KeySchema],
    /// Keys of which exactly one must be present; no restriction if empty.
    pub one_of: &'static [&'static str],
    /// Keys of which one at least must be present; no restriction if empty.
    pub any_of: &'static [&'static str],
    /// A key, and another that is required if it is present.
    pub dependent_keys: Option<(&'static str, &'static str)>,
    /// Where in messages it is said that other names are given; empty if nowhere.
    pub other_names: &'static str,
}

/// A key of a table.
#[derive(Debug)]
pub struct KeySchema {
    /// Its name.
    pub name: &'static str,
    /// The values it may have.
    pub value: ValueSchema,
    /// Its purpose, in a sentence.
    pub description: &'static str,
    /// Whether it is required.
    pub is_required: bool,
    /// Computes the value of an absent key, as JSON; `None` if the key has no default, or one that depends on others.
    pub default: Option<fn() -> String>,
}

/// The values that a key may have.
#[derive(Debug)]
pub enum ValueSchema {
    /// Any string.
    Text,
    /// A name for folders and files, see [`parse_slug`](super::parse_slug).
    Slug,
    /// A colour: `#rrggbb` or `#rgb`.
    Color,
    /// One of several words.
    Word(fn() -> Vec<&'static str>),
    /// A value, with examples of it.
    WithExamples(&'static ValueSchema, fn() -> Vec<&'static str>),
    /// A boolean.
    Boolean,
    /// A whole number from a least to a greatest value.
    Integer([usize; 2]),
    /// A number, or an expression in quotes.
    Number,
    /// A number greater than 0, or an expression in quotes.
    Positive,
    /// A number from a least to a greatest value, or an expression in quotes.
    InRange([f64; 2]),
    /// A number and its unit, in quotes.
    Quantity(Dimension),
    /// Two numbers with a colon between them, in quotes.
    Ratio,
    /// A value of the input: an angle with its unit, or a length if a piston drives the linkage.
    Input,
    /// A list, with the least and the greatest number of items.
    List(&'static ValueSchema, [usize; 2]),
    /// A list of distinct items, with the least and the greatest number of them.
    Set(&'static ValueSchema, [usize; 2]),
    /// A list with the least number of items, or one item without brackets.
    OneOrMore(&'static ValueSchema, usize),
    /// A table with a fixed set of keys.
    Table(&'static TableSchema),
    /// A table whose keys are names that expressions may use.
    IdentifierMap(&'static ValueSchema),
    /// A table with any keys.
    Map(&'static ValueSchema),
    /// A table of one of several kinds: the first whose key is present.
    Variants(fn() -> Vec<(&'static str, &'static TableSchema)>),
    /// A value that any of several schemas allows.
    AnyOf(&'static [ValueSchema]),
}

impl TableSchema {
    /// A table with these keys.
    pub const fn new(display_name: &'static str, keys: &'static [KeySchema]) -> TableSchema {
        TableSchema { display_name, keys, one_of: &[], any_of: &[], dependent_keys: None, other_names: "" }
    }

    /// Requires exactly one of these keys.
    pub const fn with_one_of(self, one_of: &'static [&'static str]) -> TableSchema {
        TableSchema { one_of, ..self }
    }

    /// Says in messages where what is no key of it is written, before the list of its keys.
    pub const fn with_other_names(self, other_names: &'static str) -> TableSchema {
        TableSchema { other_names, ..self }
    }

    /// Requires one of these keys or several.
    pub const fn with_any_of(self, any_of: &'static [&'static str]) -> TableSchema {
        TableSchema { any_of, ..self }
    }

    /// Requires the second key if the first is present.
    pub const fn with_dependent_keys(self, key: &'static str, other: &'static str) -> TableSchema {
        TableSchema { dependent_keys: Some((key, other)), ..self }
    }

    /// The names of its keys.
    pub fn key_names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }

    /// The key of the first table in it that has a key `name`, which this one itself has neither so nor misspelt.
    pub(super) fn table_with(&self, name: &str) -> Option<&'static str> {
        let has_name = |key: &&KeySchema| match &key.value {
            ValueSchema::Table(table) => table.keys.iter().any(|key| key.name == name),
            _ => false,
        };
        let table = self.keys.iter().find(has_name)?;
        nearest_word(name, self.key_names()).is_none().then_some(table.name)
    }
}

impl KeySchema {
    /// An optional key.
    pub const fn new(name: &'static str, value: ValueSchema, description: &'static str) -> KeySchema {
        KeySchema { name, value, description, is_required: false, default: None }
    }

    /// A required key.
    pub const fn required(name: &'static str, value: ValueSchema, description: &'static str) -> KeySchema {
        KeySchema { is_required: true, ..KeySchema::new(name, value, description) }
    }

    /// Sets the default, as JSON; it is computed from the constant that the parser uses.
    pub const fn with_default(self, default: fn() -> String) -> KeySchema {
        KeySchema { default: Some(default), ..self }
    }
}

/// The JSON of the word for the default of a table of words and their meanings.
pub fn default_word<T: Default + PartialEq>(table: &[(&'static str, T)]) -> String {
    let default = T::default();
    table.iter().find(|(_, value)| *value == default).map(|(word, _)| format!("\"{word}\"")).unwrap_or_default()
}

/// The words of a table of words and their meanings.
pub fn words<T>(table: &[(&'static str, T)]) -> Vec<&'static str> {
    table.iter().map(|(word, _)| *word).collect()
}
