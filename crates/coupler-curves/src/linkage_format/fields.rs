use toml::de::{DeTable, DeValue};

use super::schema::TableSchema;
use super::toml_parser::{TomlParser, TomlValue};
use crate::problem::{Problem, Span, nearest_word, suggestion};

/// The keys of a table and their values.
pub struct Fields<'v, 't> {
    table: &'v DeTable<'t>,
    /// The span of the whole table.
    pub span: Span,
    /// The name of the table in messages.
    pub display_name: String,
    /// The keys it may have; `None` if any are allowed.
    schema: Option<&'static TableSchema>,
}

impl<'v, 't> Fields<'v, 't> {
    /// The keys of a table, of which those not in its schema are reported. `None` if the value is not a table.
    pub fn from_value(
        value: &'v TomlValue<'t>,
        schema: &'static TableSchema,
        parser: &mut TomlParser<'t>,
    ) -> Option<Fields<'v, 't>> {
        let fields = Fields { schema: Some(schema), ..Fields::with_any_keys(value, schema.display_name, parser)? };
        let known = schema.key_names();
        for key in fields.table.keys() {
            let name = key.get_ref().as_ref();
            if !known.contains(&name) {
                let problem = Problem::error(key.span(), format!("{} has no key `{name}`", schema.display_name));
                let help = match schema.table_with(name) {
                    Some(table) => format!("did you mean `{table}.{name}`?"),
                    None if nearest_word(name, known.iter().copied()).is_some() => suggestion(name, &known),
                    None => match parser.table_of(name) {
                        Some(table) => format!("`{name}` is a key of {table}"),
                        None => format!("{}{}", schema.other_names, suggestion(name, &known)),
                    },
                };
                parser.report(problem.with_help(help));
            }
        }
        Some(fields)
    }

    /// The keys of a table that may have any keys. `None` if the value is not a table.
    pub fn with_any_keys(
        value: &'v TomlValue<'t>,
        display_name: &str,
        parser: &mut TomlParser<'t>,
    ) -> Option<Fields<'v, 't>> {
        match value.get_ref() {
            DeValue::Table(table) => {
                Some(Fields { table, span: value.span(), display_name: display_name.to_owned(), schema: None })
            }
            _ => {
                let help = match display_name.starts_with('[') {
                    true => format!("write it under {display_name}, once"),
                    false => "write it like { key = value }".to_owned(),
                };
                parser.report_mismatch(value, "a table", &help);
                None
            }
        }
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&'v TomlValue<'t>> {
        // A key that is not in the schema would be rejected wherever it is used.
        debug_assert!(
            self.schema.is_none_or(|schema| schema.key_names().contains(&key)),
            "{} lacks {key}",
            self.display_name
        );
        self.table.get(key)
    }

    /// The value of a required key; `example` shows how it is written.
    pub fn required(&self, key: &str, example: &str, parser: &mut TomlParser<'t>) -> Option<&'v TomlValue<'t>> {
        let value = self.get(key);
        // A key that is misspelt is reported by itself, and one may be in an entry that could not be read.
        if value.is_none() && !parser.has_syntax_error() && !self.may_be_misspelt(key) {
            let problem = Problem::error(self.span.clone(), format!("{} has no `{key}`", self.display_name));
            parser.report(problem.with_help(format!("add {example}")));
        }
        value
    }

    /// Whether another key may be this one, misspelt, or is one of the table that belongs at this key.
    pub fn may_be_misspelt(&self, key: &str) -> bool {
        let known = self.schema.map(TableSchema::key_names).unwrap_or_default();
        let mut unknown = self.table.keys().map(|key| key.get_ref().as_ref()).filter(|other| !known.contains(other));
        let is_of_table = |other: &str| self.schema.and_then(|schema| schema.table_with(other)) == Some(key);
        unknown.any(|other| nearest_word(other, known.iter().copied()) == Some(key) || is_of_table(other))
    }

    /// The string at a required key.
    pub fn required_text(&self, key: &str, example: &str, parser: &mut TomlParser<'t>) -> Option<String> {
        let value = self.required(key, example, parser)?;
        parser.text(value)
    }

    /// The tables of an array of tables, in order; empty if the key is absent.
    pub fn tables(&self, key: &str, parser: &mut TomlParser<'t>) -> &'v [TomlValue<'t>] {
        match self.get(key).map(|value| (value, value.get_ref())) {
            None => &[],
            Some((_, DeValue::Array(tables))) => tables,
            Some((value, found)) => {
                let parent = self.display_name.strip_prefix('[').and_then(|name| name.strip_suffix(']'));
                let path = parent.map_or(key.to_owned(), |parent| format!("{parent}.{key}"));
                parser.report_mismatch(value, "a list of tables", &format!("write it as [[{path}]]"));
                if found.is_table() { std::slice::from_ref(value) } else { &[] }
            }
        }
    }

    /// Every key with its span and its value, in the order written.
    pub fn entries(&self) -> impl Iterator<Item = (&'v str, Span, &'v TomlValue<'t>)> + use<'v, 't> {
        self.table.iter().map(|(key, value)| (key.get_ref().as_ref(), key.span(), value))
    }

    /// The keys, in the order written.
    pub fn keys(&self) -> Vec<&'v str> {
        self.table.keys().map(|key| key.get_ref().as_ref()).collect()
    }
}

/// The items of a list, or the value itself if it is not a list.
pub fn one_or_more<'v, 't>(value: &'v TomlValue<'t>) -> &'v [TomlValue<'t>] {
    value.get_ref().as_array().map_or(std::slice::from_ref(value), |list| &list[..])
}
