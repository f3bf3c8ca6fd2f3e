use toml::de::{DeTable, DeValue};

use super::schema::TableSchema;
use super::toml_parser::{TomlParser, TomlValue};
use crate::problem::{Problem, Span, suggestion};

/// The keys of a table.
pub struct Fields<'v, 't> {
    table: &'v DeTable<'t>,
    /// The place of the whole table.
    pub span: Span,
    /// What the table is, for messages.
    pub display_name: String,
    /// The keys it may have; none where they are the writer's own.
    schema: Option<&'static TableSchema>,
}

impl<'v, 't> Fields<'v, 't> {
    /// The keys of a table, all of which must be its form's. `None` where the value is no table.
    pub fn from_value(
        value: &'v TomlValue<'t>,
        form: &'static TableSchema,
        reader: &mut TomlParser<'t>,
    ) -> Option<Fields<'v, 't>> {
        let fields = Fields { schema: Some(form), ..Fields::with_any_keys(value, form.display_name, reader)? };
        let known = form.key_names();
        for key in fields.table.keys() {
            let name = key.get_ref().as_ref();
            if !known.contains(&name) {
                let problem = Problem::error(key.span(), format!("{} has no key `{name}`", form.display_name));
                reader.report(problem.with_help(suggestion(name, &known)));
            }
        }
        Some(fields)
    }

    /// The keys of a table whose keys are names of the writer's own.
    pub fn with_any_keys(value: &'v TomlValue<'t>, what: &str, reader: &mut TomlParser<'t>) -> Option<Fields<'v, 't>> {
        match value.get_ref() {
            DeValue::Table(table) => {
                Some(Fields { table, span: value.span(), display_name: what.to_owned(), schema: None })
            }
            _ => {
                reader.report_mismatch(value, "a table", "write it like { key = value }");
                None
            }
        }
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&'v TomlValue<'t>> {
        // A key that only its reader knew would be refused wherever it is written.
        debug_assert!(
            self.schema.is_none_or(|form| form.key_names().contains(&key)),
            "{} lacks {key}",
            self.display_name
        );
        self.table.get(key)
    }

    /// The value of a key that must be there; `example` shows how it is written.
    pub fn required(&self, key: &str, example: &str, reader: &mut TomlParser<'t>) -> Option<&'v TomlValue<'t>> {
        let found = self.get(key);
        if found.is_none() {
            let problem = Problem::error(self.span.clone(), format!("{} has no `{key}`", self.display_name));
            reader.report(problem.with_help(format!("add {example}")));
        }
        found
    }

    /// The text of a key that must be there.
    pub fn required_text(&self, key: &str, example: &str, reader: &mut TomlParser<'t>) -> Option<String> {
        let value = self.required(key, example, reader)?;
        reader.text(value)
    }

    /// The tables of an array of tables, in their order; none where the key is absent.
    pub fn tables(&self, key: &str, reader: &mut TomlParser<'t>) -> &'v [TomlValue<'t>] {
        match self.get(key).map(|value| (value, value.get_ref())) {
            None => &[],
            Some((_, DeValue::Array(tables))) => tables,
            Some((value, _)) => {
                reader.report_mismatch(value, "a list of tables", &format!("write it as [[{key}]]"));
                &[]
            }
        }
    }

    /// Every key with its place and its value, in the order written.
    pub fn entries(&self) -> impl Iterator<Item = (&'v str, Span, &'v TomlValue<'t>)> + use<'v, 't> {
        self.table.iter().map(|(key, value)| (key.get_ref().as_ref(), key.span(), value))
    }

    /// The keys, in the order written.
    pub fn keys(&self) -> Vec<&'v str> {
        self.table.keys().map(|key| key.get_ref().as_ref()).collect()
    }
}
