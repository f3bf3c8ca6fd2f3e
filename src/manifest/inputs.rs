use coupler_curves::linkage_format::{Fields, TomlValue, canonical_text};

/// What a manifest says of that which a family's files are made from, in a form that does not tell how it was written.
///
/// Two manifests in which it is the same, read by the same version of the program, make the same files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ManifestInputs {
    /// All of it, but the formats.
    pub family: String,
    /// What the pages of some cells are drawn from, beside the cells' own values and their curves.
    pub page: String,
}

/// Keys of [atlas_json] that say how it is written or where files go, not what is in them.
const IGNORED_ATLAS_KEYS: [&str; 4] = ["format", "output", "formats", "volume_pages"];
/// Keys of a family that say the same, or what it is held against.
const IGNORED_FAMILY_KEYS: [&str; 3] = ["formats", "limit", "check"];
/// Keys of a family, with [`IGNORED_FAMILY_KEYS`], that come to the values of cells, their curves and their order.
const IGNORED_PAGE_KEYS: [&str; 8] = ["formats", "limit", "check", "grid", "cases", "let", "where", "sort"];

impl ManifestInputs {
    /// What a manifest says of a family's table in it.
    pub(super) fn from_manifest(root: &Fields, family: &TomlValue) -> ManifestInputs {
        let named = |key: &str, table: &TomlValue| {
            let name = table.get_ref().as_table().and_then(|table| table.get(key))?;
            name.get_ref().as_str().map(str::to_owned)
        };
        let linkage = named("linkage", family);
        // Whatever is in a manifest beside families and linkages goes for all of them.
        let mut common = String::new();
        for (key, _, value) in root.entries().filter(|(key, ..)| !["family", "linkage", "check"].contains(key)) {
            let leaving_out: &[&str] = if key == "atlas" { &IGNORED_ATLAS_KEYS } else { &[] };
            common.push_str(&format!("{key:?}={},", canonical_text(value, leaving_out)));
        }
        let linkages = root.get("linkage").and_then(|value| value.get_ref().as_array());
        for own in linkages.into_iter().flatten().filter(|own| named("id", own) == linkage) {
            common.push_str(&canonical_text(own, &[]));
        }
        ManifestInputs {
            family: format!("{common}{}", canonical_text(family, &IGNORED_FAMILY_KEYS)),
            page: format!("{common}{}", canonical_text(family, &IGNORED_PAGE_KEYS)),
        }
    }
}
