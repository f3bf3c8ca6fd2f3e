//! Where in the manifest a finding is.

use super::super::printable;
use super::super::source::ManifestSource;

/// The path of the manifest, with slashes.
pub fn manifest_path(source: &ManifestSource) -> String {
    printable(source.path.display()).replace('\\', "/")
}

/// The line of the table of a family in the manifest, from 1; the first for the atlas as a whole.
pub fn line_of(source: &ManifestSource, family: &str) -> usize {
    let planned = source.plan.families.iter().find(|planned| planned.family.id == family);
    planned.map_or(1, |planned| source.text[..planned.span.start].matches('\n').count() + 1)
}
