//! A manifest with all that makes curves, their linkages in numbers.

use std::fmt::Write;

use coupler_curves::exchange::{SelectedCurve, drawn_family_settings, family_id, family_settings, linkage_in_numbers};
use coupler_curves::linkage_format::quoted;
use coupler_curves::template::{JointKindTemplate, JointTemplate};

use super::drawing::{FormError, drawing};
use crate::import::linkage_text;

/// What a manifest says of the linkages of exported curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ManifestForm {
    /// Families that name their linkages, with the values of the parameters.
    #[default]
    Families,
    /// The linkages in numbers, joint by joint.
    Joints,
    /// The linkages in numbers, each drawn in a pose.
    Drawing,
}

impl ManifestForm {
    /// Every form.
    pub const ALL: [ManifestForm; 3] = [ManifestForm::Families, ManifestForm::Joints, ManifestForm::Drawing];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            ManifestForm::Families => "families",
            ManifestForm::Joints => "joints",
            ManifestForm::Drawing => "drawing",
        }
    }
}

/// A family of one cell with a linkage of its own, but their ids.
#[derive(Clone, Debug)]
pub struct CompleteFamily {
    /// The id of the linkage that it was.
    linkage_id: String,
    title: String,
    settings: String,
    /// The keys of the linkage.
    linkage: String,
    /// The curves that it has.
    names: Vec<String>,
}

/// The families of the curves of a cell: one joint by joint, or one drawing for each circuit.
///
/// # Errors
/// The linkage has a joint that the form cannot express.
pub fn complete_families(curves: &[SelectedCurve], form: ManifestForm) -> Result<Vec<CompleteFamily>, FormError> {
    let family = |curves: &[&SelectedCurve], settings: String, linkage: String| CompleteFamily {
        linkage_id: curves[0].family.template.id.clone(),
        title: curves[0].family.title.clone(),
        settings,
        linkage,
        names: curves.iter().map(|curve| curve.name()).collect(),
    };
    let all: Vec<&SelectedCurve> = curves.iter().collect();
    let Some(first) = all.first() else { return Ok(Vec::new()) };
    let source = first.family;
    match form {
        ManifestForm::Families => Ok(Vec::new()),
        ManifestForm::Joints => {
            let is_grouped = |joint: &&JointTemplate| matches!(joint.kind, JointKindTemplate::Grouped { .. });
            if let Some(joint) = source.template.joints.iter().find(is_grouped) {
                let (what, form) = ("group of links that no dyads place", "a list of joints");
                return Err(FormError { joint: joint.name.clone(), what, form, other: "drawing" });
            }
            let values = source.parameter_values(&first.solved.cell);
            Ok(vec![family(&all, family_settings(source), linkage_in_numbers(&source.template, values))])
        }
        ManifestForm::Drawing => {
            let mut circuits: Vec<usize> = all.iter().map(|curve| curve.curve().circuit).collect();
            circuits.sort_unstable();
            circuits.dedup();
            let mut out = Vec::new();
            for circuit in circuits {
                let own: Vec<&SelectedCurve> =
                    all.iter().copied().filter(|curve| curve.curve().circuit == circuit).collect();
                let drawn = drawing(&own)?;
                out.extend(drawn.map(|drawn| family(&own, drawn_family_settings(source), linkage_text(&drawn))));
            }
            Ok(out)
        }
    }
}

/// A manifest of some families.
pub fn complete_manifest(families: &[CompleteFamily]) -> String {
    let title = families.first().map_or("Exported curves", |family| &family.title);
    let mut out = format!("[atlas]\ntitle = {}\n", quoted(title));
    for (k, family) in families.iter().enumerate() {
        let earlier = families[..k].iter().filter(|other| other.linkage_id == family.linkage_id).count();
        let id = family_id(&family.linkage_id, earlier + 1);
        // Writing to a string cannot fail.
        let _ = write!(
            out,
            "\n[[family]]\nid = \"{id}\"\nlinkage = \"{id}\"\ntitle = {}\n{}cases = [{{}}] # {}\n\n[[linkage]]\nid = \"{id}\"\n{}",
            quoted(&family.title),
            family.settings,
            family.names.join(", "),
            family.linkage
        );
    }
    out
}
