//! What a manifest contributes to the files of a family, in a normal form.

use std::collections::HashMap;
use std::sync::Arc;

use coupler_drawing::page::Layout;
use coupler_drawing::scene::FontFile;

use coupler_curves::linkage_format::{Fields, TomlValue, canonical_toml, quoted};

/// The part of a manifest that determines a family's files, in a form that does not depend on how it is written.
///
/// Two manifests in which it is equal give the same files with the same version of the program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ManifestInputs {
    /// The tables that apply to every family, each as a line of TOML.
    tables: Arc<str>,
    /// The linkage as an inline table; empty for one of the catalogue.
    linkage: Arc<str>,
    /// The table of the family as an inline table, except the formats.
    family: String,
    /// The same without the parameter sets.
    settings: String,
    /// The keys of that table that determine its tables of points and measures.
    tables_of_curves: String,
    /// The keys of that table that determine a page of cells, in addition to the cells' values and curves.
    page: String,
}

impl ManifestInputs {
    /// What determines all files of the family, except the formats.
    pub fn family_text(&self) -> String {
        [&*self.tables, &*self.linkage, &self.family].concat()
    }

    /// What determines the values in the tables of the family.
    pub fn table_text(&self) -> String {
        [&*self.linkage, &self.tables_of_curves].concat()
    }

    /// A manifest of this family alone, with other keys in place of its own parameter sets.
    pub(super) fn excerpt(&self, keys: &str) -> String {
        let linkage = if self.linkage.is_empty() { String::new() } else { format!("linkage=[{}]\n", self.linkage) };
        let settings = self.settings.strip_suffix('}').unwrap_or_default();
        format!("{}{linkage}family=[{settings},{keys}}}]\n", self.tables)
    }

    /// What determines a page of cells, in addition to the cells' values and curves.
    pub fn page_text(&self) -> String {
        [&*self.tables, &*self.linkage, &self.page].concat()
    }
}

/// Keys of `[atlas]` that do not change the contents of files.
const IGNORED_ATLAS_KEYS: [&str; 4] = ["format", "output", "formats", "volume_pages"];
/// Keys of a family that do not change the contents of its files.
const IGNORED_FAMILY_KEYS: [&str; 3] = ["formats", "limit", "check"];
/// [`IGNORED_FAMILY_KEYS`], and the keys of the parameter sets.
const IGNORED_SETTINGS: [&str; 6] = ["formats", "limit", "check", "grid", "cases", "design"];
/// [`IGNORED_FAMILY_KEYS`], and the keys that determine the values of cells, their curves and their order.
const IGNORED_PAGE_KEYS: [&str; 9] = ["formats", "limit", "check", "grid", "cases", "design", "let", "where", "sort"];

/// The keys of a family that determine neither the cells, nor their curves, nor the columns of tables.
const IGNORED_TABLE_KEYS: [&str; 15] = [
    "title", "unit", "source", "layout", "panels", "scale", "ghosts", "poses", "chart", "sort", "caption", "note",
    "formats", "limit", "check",
];

/// The texts that the inputs of several families have in common.
pub(crate) struct SharedInputs {
    /// That of all tables other than families and linkages.
    tables: Arc<str>,
    /// Those of the linkages, by their ids.
    linkages: HashMap<String, Arc<str>>,
}

impl SharedInputs {
    /// The shared texts of a manifest.
    pub fn from_manifest(root: &Fields, fallback: Option<&FontFile>) -> SharedInputs {
        // As a comment, for an excerpt begins with these lines.
        let mut tables = fallback.map_or(String::new(), |file| format!("# fallback_face {file:?}\n"));
        for (key, _, value) in root.entries().filter(|(key, ..)| !["family", "linkage", "check", "book"].contains(key))
        {
            let ignored_keys: &[&str] = if key == "atlas" { &IGNORED_ATLAS_KEYS } else { &[] };
            tables.push_str(&format!("{key}={}\n", canonical_toml(value, ignored_keys)));
        }
        let linkages = root.get("linkage").and_then(|value| value.get_ref().as_array());
        let by_id = |table| Some((string_at("id", table)?.to_owned(), Arc::from(canonical_toml(table, &[]))));
        SharedInputs { tables: Arc::from(tables), linkages: linkages.into_iter().flatten().filter_map(by_id).collect() }
    }

    /// The inputs of the family with this table of the manifest, with what depends on the whole manifest: its layout, and its title if it states
    /// none, which a manifest of the family alone would not have. A file with its cases counts by what is in it, whatever its name, and
    /// wishes by what is found.
    pub fn of_family(
        &self,
        family: &TomlValue,
        (layout, title): (Layout, &str),
        case_digest: Option<&str>,
    ) -> ManifestInputs {
        let linkage = string_at("linkage", family).and_then(|id| self.linkages.get(id));
        let title = string_at("title", family).is_none().then(|| quoted(title));
        let with_key = |table: String, key: &str, value: Option<&String>| match value {
            None => table,
            Some(value) => format!("{},{key}={value}}}", table.strip_suffix('}').unwrap_or_default()),
        };
        let case_digest = case_digest.map(quoted);
        let with_cases = |ignored: &[&str]| match &case_digest {
            Some(digest) if !ignored.contains(&"cases") => {
                with_key(canonical_toml(family, &[ignored, &["cases", "design"]].concat()), "cases", Some(digest))
            }
            _ => canonical_toml(family, ignored),
        };
        let with_title = |ignored: &[&str]| with_key(with_cases(ignored), "title", title.as_ref());
        let [columns, rows] = layout.grid();
        ManifestInputs {
            tables: Arc::clone(&self.tables),
            linkage: linkage.cloned().unwrap_or_default(),
            family: with_title(&IGNORED_FAMILY_KEYS),
            settings: with_title(&IGNORED_SETTINGS),
            tables_of_curves: with_cases(&IGNORED_TABLE_KEYS),
            page: format!("{}# grid {columns} x {rows}\n", with_title(&IGNORED_PAGE_KEYS)),
        }
    }
}

/// The string at a key of a table.
fn string_at<'v>(key: &str, table: &'v TomlValue) -> Option<&'v str> {
    table.get_ref().as_table()?.get(key)?.get_ref().as_str()
}
