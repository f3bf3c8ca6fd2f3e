//! The key of a page: what it says of the linkage, and how each joint is placed.

use super::marks::straight_criterion_text;
use coupler_curves::expression::{MathText, displayed_name};
use coupler_curves::family::{Cell, Family};
use coupler_curves::linkage::{JointId, OutputLink};
use coupler_curves::template::{InputValue, JointTemplate, Template};
use coupler_curves::text::format_exactly;

/// What a page says about the linkages on it, so that they can be built: how the joints are placed by parameters, and
/// the dimensions that are the same for all.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Key {
    /// The dimensions that all linkages share, as of [`Family::common_dimensions`].
    pub dimensions: Vec<MathText>,
    /// The name of each joint, and how it is placed.
    pub joints: Vec<(String, MathText)>,
    /// The formulas of the note under each panel, if its values follow from the parameters, such as the lengths of cognates.
    pub note: Option<MathText>,
    /// What drives the linkage, what it drives, and from where it is seen.
    pub remarks: Vec<String>,
    /// Which straight portions are marked.
    pub straight: String,
}

impl Key {
    /// The key of a family's linkages: the parameters that vary are for their captions.
    pub fn new(family: &Family) -> Key {
        Key::with_dimensions(family, family.common_dimensions())
    }

    /// The key of one cell, with all its dimensions.
    pub fn for_cell(family: &Family, cell: &Cell) -> Key {
        Key { note: None, ..Key::with_dimensions(family, family.cell_dimensions(cell)) }
    }

    fn with_dimensions(family: &Family, dimensions: Vec<MathText>) -> Key {
        let template = &*family.template;
        let joint = |(k, joint): (usize, &JointTemplate)| (displayed_name(&joint.name), template.construction(k));
        Key {
            dimensions,
            joints: template.joints.iter().enumerate().map(joint).collect(),
            note: note_formulas(family),
            remarks: remarks(template),
            straight: straight_criterion_text(family.straight, if template.is_driven_by_length() { "" } else { "°" }),
        }
    }
}

/// The note of a family's panels with formulas in place of values, if it has any and all are of parameters.
fn note_formulas(family: &Family) -> Option<MathText> {
    let note = family.captions[1].as_ref()?;
    let mut names = note.expressions().flat_map(|(expression, _)| expression.names());
    let has_values = note.expressions().next().is_some();
    (has_values && names.all(|name| family.names.contains(name))).then(|| note.to_math_text())
}

/// The input, the output and the frame of a linkage in words.
fn remarks(template: &Template) -> Vec<String> {
    let name = |joint: usize| displayed_name(&template.joints[joint].name);
    let driven_by = match (template.is_driven_by_length(), template.seen_from) {
        (true, _) => format!("input: {}", template.input_in_words()),
        (false, None) => "input: the crank's angle from 0, in the direction of its arrow".to_owned(),
        (false, Some(_)) => "input: the driving link's angle from 0, in the direction of its arrow".to_owned(),
    };
    let range = template.input.as_ref().map_or(String::new(), |[from, to]| {
        let [from, to] = [from, to].map(InputValue::to_math_text);
        format!(", from {from} to {to}")
    });
    let driven_by = format!("{driven_by}{range}");
    let structure = template.structure().ok();
    let output = structure.as_ref().and_then(|linkage| {
        let name = |joint: JointId| displayed_name(&linkage.joints[joint].name);
        Some(match linkage.output()? {
            OutputLink::Link([from, to]) => format!("output: the link from {} to {}", name(from), name(to)),
            OutputLink::Slot { base: [pivot, through], .. } => {
                format!("output: the link from {} that slides through {}", name(pivot), name(through))
            }
            OutputLink::Slider { joint, .. } => format!("output: the slider {}", name(joint)),
        })
    });
    let frame = template.seen_from.map(|[origin, x]| format!("drawn with {} and {} fixed", name(origin), name(x)));
    [driven_by.to_owned()].into_iter().chain(output).chain(frame).chain(orientation(template)).collect()
}

/// How the drawing is turned against what the key says of the linkage, if it is.
fn orientation(template: &Template) -> Option<String> {
    let rotation = match template.orientation.rotation_deg() {
        0.0 => None,
        deg => Some(format!("turned by {}°", format_exactly(deg))),
    };
    let reflection = (template.orientation.handedness() < 0.0).then(|| "mirrored about the x-axis".to_owned());
    let parts: Vec<String> = reflection.into_iter().chain(rotation).collect();
    let what = "coordinates, sides and angles are those before";
    (!parts.is_empty()).then(|| format!("drawn {}: {what}", parts.join(", then ")))
}
