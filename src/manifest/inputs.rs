//! What a manifest contributes to the files of a family, in a normal form.

use coupler_curves::linkage_format::{Fields, TomlValue, canonical_text};

/// The part of a manifest that determines a family's files, in a form that does not depend on how it is written.
///
/// Two manifests in which it is equal give the same files with the same version of the program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ManifestInputs {
    /// What determines all its files, except the formats.
    pub family: String,
    /// What determines a page of cells, in addition to the cells' values and curves.
    pub page: String,
}

/// Keys of `[atlas]` that do not change the contents of files.
const IGNORED_ATLAS_KEYS: [&str; 4] = ["format", "output", "formats", "volume_pages"];
/// Keys of a family that do not change the contents of its files.
const IGNORED_FAMILY_KEYS: [&str; 3] = ["formats", "limit", "check"];
/// [`IGNORED_FAMILY_KEYS`], and the keys that determine the values of cells, their curves and their order.
const IGNORED_PAGE_KEYS: [&str; 8] = ["formats", "limit", "check", "grid", "cases", "let", "where", "sort"];

impl ManifestInputs {
    /// The inputs of the family with this table of the manifest.
    pub(super) fn from_manifest(root: &Fields, family: &TomlValue) -> ManifestInputs {
        let text_of = |key: &str, table: &TomlValue| {
            let name = table.get_ref().as_table().and_then(|table| table.get(key))?;
            name.get_ref().as_str().map(str::to_owned)
        };
        let linkage = text_of("linkage", family);
        // All tables other than families and linkages apply to every family.
        let mut common = String::new();
        for (key, _, value) in root.entries().filter(|(key, ..)| !["family", "linkage", "check"].contains(key)) {
            let ignored_keys: &[&str] = if key == "atlas" { &IGNORED_ATLAS_KEYS } else { &[] };
            common.push_str(&format!("{key:?}={},", canonical_text(value, ignored_keys)));
        }
        let linkages = root.get("linkage").and_then(|value| value.get_ref().as_array());
        for table in linkages.into_iter().flatten().filter(|table| text_of("id", table) == linkage) {
            common.push_str(&canonical_text(table, &[]));
        }
        ManifestInputs {
            family: format!("{common}{}", canonical_text(family, &IGNORED_FAMILY_KEYS)),
            page: format!("{common}{}", canonical_text(family, &IGNORED_PAGE_KEYS)),
        }
    }
}
