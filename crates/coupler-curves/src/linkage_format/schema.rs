//! The form of a text: its tables, their keys, and what may stand at each key.
//!
//! The reader knows no other keys than those of these tables, and the schema for editors is written from them, so that
//! neither can forget one.

use crate::expression::Dimension;

/// A table whose keys are the program's own.
#[derive(Debug)]
pub struct TableSchema {
    /// What it is, in the words of messages.
    pub display_name: &'static str,
    /// Its keys.
    pub keys: &'static [KeySchema],
    /// Keys of which just one is given; none where empty.
    pub one_of: &'static [&'static str],
    /// A key, and the one that must be there where it is.
    pub dependent_keys: Option<(&'static str, &'static str)>,
}

/// A key of a table.
#[derive(Debug)]
pub struct KeySchema {
    /// Its name.
    pub name: &'static str,
    /// What may stand there.
    pub value: ValueSchema,
    /// What it is for: a sentence.
    pub description: &'static str,
    /// Whether it must be there.
    pub is_required: bool,
    /// What holds where it is left out, as JSON; empty where that is nothing, or not the same everywhere.
    pub default: &'static str,
}

/// What may stand at a key.
#[derive(Debug)]
pub enum ValueSchema {
    /// Any text.
    Text,
    /// A name for folders and files, see [`slug`](super::parse_slug).
    Slug,
    /// A colour: `#rrggbb` or `#rgb`.
    Color,
    /// One of some words.
    Word(fn() -> Vec<&'static str>),
    /// Something for which these are examples.
    WithExamples(&'static ValueSchema, fn() -> Vec<&'static str>),
    /// True or false.
    Boolean,
    /// A whole number, the least and the greatest.
    Integer([usize; 2]),
    /// A number, or an expression in quotes.
    Number,
    /// A number of more than 0, or an expression in quotes.
    Positive,
    /// A number, the least and the greatest, or an expression in quotes.
    InRange([f64; 2]),
    /// A number and its unit in quotes.
    Quantity(Dimension),
    /// A value of the input: an angle with its unit, or, where a piston drives, a length.
    Input,
    /// A list, with the least and the greatest number of items.
    List(&'static ValueSchema, [usize; 2]),
    /// A list in which nothing stands twice, with the least and the greatest number of items.
    Set(&'static ValueSchema, [usize; 2]),
    /// A list with the least number of items, or one item without brackets.
    OneOrMore(&'static ValueSchema, usize),
    /// A table with keys of the program's own.
    Table(&'static TableSchema),
    /// A table whose keys are names for expressions.
    IdentifierMap(&'static ValueSchema),
    /// A table whose keys are the writer's own.
    Map(&'static ValueSchema),
    /// A table of one of several kinds, the first whose key it has.
    Variants(&'static [(&'static str, TableSchema)]),
    /// One of several forms.
    AnyOf(&'static [ValueSchema]),
}

impl TableSchema {
    /// A table.
    pub const fn new(what: &'static str, keys: &'static [KeySchema]) -> TableSchema {
        TableSchema { display_name: what, keys, one_of: &[], dependent_keys: None }
    }

    /// The same; just one of these keys is given.
    pub const fn with_one_of(self, one_of: &'static [&'static str]) -> TableSchema {
        TableSchema { one_of, ..self }
    }

    /// The same; where the first key is, the second must be.
    pub const fn with_dependent_keys(self, key: &'static str, other: &'static str) -> TableSchema {
        TableSchema { dependent_keys: Some((key, other)), ..self }
    }

    /// The names of its keys.
    pub fn key_names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }
}

impl KeySchema {
    /// A key that may be left out.
    pub const fn new(name: &'static str, form: ValueSchema, about: &'static str) -> KeySchema {
        KeySchema { name, value: form, description: about, is_required: false, default: "" }
    }

    /// A key that must be there.
    pub const fn required(name: &'static str, form: ValueSchema, about: &'static str) -> KeySchema {
        KeySchema { is_required: true, ..KeySchema::new(name, form, about) }
    }

    /// The same, with what holds where it is left out, as JSON.
    pub const fn with_default(self, default: &'static str) -> KeySchema {
        KeySchema { default, ..self }
    }
}

/// The words of a table of words and their meanings.
pub fn words<T>(table: &[(&'static str, T)]) -> Vec<&'static str> {
    table.iter().map(|(word, _)| *word).collect()
}
