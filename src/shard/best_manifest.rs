//! A manifest of the best curves.

use coupler_curves::exchange::{ParameterSet, manifest_families};
use coupler_curves::linkage_format::quoted;

use super::gather::Gathered;
use crate::manifest;

/// What the first line of a manifest of the best curves has.
const ORIGIN: &str = "from shards gathered by `coupler-atlas gather`";

/// Whether the first line of a file is that of a manifest of the best curves.
pub fn is_best_manifest(first_line: &str) -> bool {
    first_line.starts_with("# The best ") && first_line.contains(ORIGIN)
}

/// A manifest that renders the linkages of the best curves: a family for each of theirs, with a case for each linkage, and the
/// linkages that are their manifest's own.
pub fn best_manifest(gathered: &Gathered) -> String {
    let Gathered { families, best, by, .. } = gathered;
    // The text is on one line of a comment.
    let by: Vec<String> = by.iter().map(|by| by.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let title = families.first().map_or("", |(plan, _)| plan.title.as_str());
    let mut out = format!(
        "# The best {} curves by `{}`, {ORIGIN}; `coupler-atlas render` draws them.\n\n\
         [atlas]\ntitle = {}\nformats = [\"svg\"]\n",
        best.len(),
        by.join("`, `"),
        quoted(&format!("{title}: the best by {}", by.join(", ")))
    );
    let mut linkages: Vec<&str> = Vec::new();
    for curve in best {
        let (plan, totals) = &families[curve.family];
        let id = plan.families[0].family.template.id.as_str();
        if !linkages.contains(&id) {
            linkages.push(id);
            out.extend(manifest::linkage_text(&totals.manifest, id).map(|text| format!("\n{text}")));
        }
    }
    let sets = (1..).zip(best).map(|(rank, curve)| ParameterSet {
        family: &families[curve.family].0.families[0].family,
        values: curve.parameters.clone(),
        curve_name: format!("{rank}: {}, {}", curve.name(families), curve.key),
    });
    out + &manifest_families(&sets.collect::<Vec<_>>(), true)
}
