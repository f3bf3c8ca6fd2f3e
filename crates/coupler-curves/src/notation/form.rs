//! The form of a text: its tables, their keys, and what may stand at each key.
//!
//! The reader knows no other keys than those of these tables, and the schema for editors is written from them, so that
//! neither can forget one.

use crate::expression::Dimension;

/// A table whose keys are the program's own.
#[derive(Debug)]
pub struct Table {
    /// What it is, in the words of messages.
    pub what: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
    /// Keys of which just one is given; none where empty.
    pub one_of: &'static [&'static str],
    /// A key, and the one that must be there where it is.
    pub with: Option<(&'static str, &'static str)>,
}

/// A key of a table.
#[derive(Debug)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// What may stand there.
    pub form: Form,
    /// What it is for: a sentence.
    pub about: &'static str,
    /// Whether it must be there.
    pub is_required: bool,
    /// What holds where it is left out, as JSON; empty where that is nothing, or not the same everywhere.
    pub default: &'static str,
}

/// What may stand at a key.
#[derive(Debug)]
pub enum Form {
    /// Any text.
    Text,
    /// A name for folders and files, see [`slug`](super::slug).
    Slug,
    /// A colour: `#rrggbb` or `#rgb`.
    Color,
    /// One of some words.
    Word(fn() -> Vec<&'static str>),
    /// Something for which these are examples.
    Like(&'static Form, fn() -> Vec<&'static str>),
    /// True or false.
    Truth,
    /// A whole number, the least and the greatest.
    Count([usize; 2]),
    /// A number, or an expression in quotes.
    Number,
    /// A number of more than 0, or an expression in quotes.
    Positive,
    /// A number, the least and the greatest, or an expression in quotes.
    Within([f64; 2]),
    /// A number and its unit in quotes.
    Quantity(Dimension),
    /// A value of the input: an angle with its unit, or, where a piston drives, a length.
    Input,
    /// A list, with the least and the greatest number of items.
    List(&'static Form, [usize; 2]),
    /// A list in which nothing stands twice, with the least and the greatest number of items.
    Set(&'static Form, [usize; 2]),
    /// A list with the least number of items, or one item without brackets.
    OneOrMore(&'static Form, usize),
    /// A table with keys of the program's own.
    Table(&'static Table),
    /// A table whose keys are names for expressions.
    Names(&'static Form),
    /// A table whose keys are the writer's own.
    Entries(&'static Form),
    /// A table of one of several kinds, the first whose key it has.
    Kinds(&'static [(&'static str, Table)]),
    /// One of several forms.
    Either(&'static [Form]),
}

impl Table {
    /// A table.
    pub const fn new(what: &'static str, keys: &'static [Key]) -> Table {
        Table { what, keys, one_of: &[], with: None }
    }

    /// The same; just one of these keys is given.
    pub const fn with_one_of(self, one_of: &'static [&'static str]) -> Table {
        Table { one_of, ..self }
    }

    /// The same; where the first key is, the second must be.
    pub const fn with(self, key: &'static str, other: &'static str) -> Table {
        Table { with: Some((key, other)), ..self }
    }

    /// The names of its keys.
    pub fn names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }
}

impl Key {
    /// A key that may be left out.
    pub const fn new(name: &'static str, form: Form, about: &'static str) -> Key {
        Key { name, form, about, is_required: false, default: "" }
    }

    /// A key that must be there.
    pub const fn required(name: &'static str, form: Form, about: &'static str) -> Key {
        Key { is_required: true, ..Key::new(name, form, about) }
    }

    /// The same, with what holds where it is left out, as JSON.
    pub const fn or(self, default: &'static str) -> Key {
        Key { default, ..self }
    }
}

/// The words of a table of words and their meanings.
pub fn words<T>(table: &[(&'static str, T)]) -> Vec<&'static str> {
    table.iter().map(|(word, _)| *word).collect()
}
