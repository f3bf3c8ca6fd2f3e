//! The built-in linkages: one TOML file each, in the format of a manifest's `[[linkage]]` tables.
//!
//! To add a linkage, add a file here and a line in `FILES`; lists and validation include it.

use std::sync::{Arc, LazyLock};

use crate::linkage_format;
use crate::template::Template;

const FILES: [&str; 36] = [
    include_str!("four-bar.toml"),
    include_str!("evans.toml"),
    include_str!("chebyshev.toml"),
    include_str!("watt.toml"),
    include_str!("roberts.toml"),
    include_str!("hoeken.toml"),
    include_str!("hrones-nelson.toml"),
    include_str!("cognates.toml"),
    include_str!("slider-crank.toml"),
    include_str!("inverted-slider-crank.toml"),
    include_str!("scotch-yoke.toml"),
    include_str!("jansen.toml"),
    include_str!("klann.toml"),
    include_str!("pantograph.toml"),
    include_str!("peaucellier-lipkin.toml"),
    include_str!("hart-inversor.toml"),
    include_str!("linear-actuator.toml"),
    include_str!("geared-five-bar.toml"),
    include_str!("watt-six-bar.toml"),
    include_str!("stephenson-six-bar.toml"),
    include_str!("whitworth.toml"),
    include_str!("shaper.toml"),
    include_str!("elliptic-trammel.toml"),
    include_str!("toggle-press.toml"),
    include_str!("dwell-eight-bar.toml"),
    include_str!("excavator.toml"),
    include_str!("gripper.toml"),
    include_str!("watt-i-six-bar.toml"),
    include_str!("watt-i-six-bar-by-ternary.toml"),
    include_str!("watt-ii-six-bar-by-ternary.toml"),
    include_str!("stephenson-i-six-bar.toml"),
    include_str!("stephenson-ii-six-bar.toml"),
    include_str!("stephenson-ii-six-bar-by-binary.toml"),
    include_str!("stephenson-iii-six-bar-by-binary.toml"),
    include_str!("eight-bar-class-iii.toml"),
    include_str!("rack-steering.toml"),
];

static TEMPLATES: LazyLock<Vec<Arc<Template>>> = LazyLock::new(|| {
    let parse =
        |text: &&str| linkage_format::parse_templates(text).unwrap_or_else(|problems| panic!("{problems:?}\n{text}"));
    FILES.iter().flat_map(parse).map(Arc::new).collect()
});

/// Every built-in linkage.
pub fn all() -> &'static [Arc<Template>] {
    &TEMPLATES
}

/// The built-in linkage with an id.
pub fn find(id: &str) -> Option<Arc<Template>> {
    all().iter().find(|template| template.id == id).cloned()
}

/// The file of the built-in linkage with an id.
#[doc(hidden)]
pub fn source_text(id: &str) -> Option<&'static str> {
    let at = all().iter().position(|template| template.id == id)?;
    FILES.get(at).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_is_a_linkage_with_a_source() {
        assert_eq!(all().len(), FILES.len());
        for template in all() {
            assert!(!template.source.is_empty() && !template.legend.is_empty(), "{}", template.id);
        }
    }
}
