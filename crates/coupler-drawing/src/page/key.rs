//! The key of a page: what it says of the linkage, and how each joint is placed.

use super::marks::straight_criterion_text;
use coupler_curves::expression::{MathText, displayed_name};
use coupler_curves::family::{Cell, Family};
use coupler_curves::linkage::{JointId, JointKind, Linkage, OutputLink};
use coupler_curves::template::{InputValue, JointKindTemplate, JointTemplate, Template};
use coupler_curves::text::format_as_written;

/// What a page says about the linkages on it, so that they can be built: how the joints are placed by parameters, and
/// the dimensions that are the same for all.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Key {
    /// The dimensions that all linkages share, as of [`Family::common_dimensions`].
    pub dimensions: Vec<MathText>,
    /// The name of each joint, and how it is placed; those that only serve to place others come last.
    pub joints: Vec<(String, MathText)>,
    /// What the drawing has at pins.
    pub(super) marks: PinMarks,
    /// Those of them that are no pins, but points of moving links.
    pub helpers: Vec<String>,
    /// Those of the joints that are so far from the linkage that the drawing does not have them.
    pub beyond: Vec<String>,
    /// The formulas of the note under each panel, if its values follow from the parameters, such as the lengths of cognates.
    pub note: Option<MathText>,
    /// What drives the linkage, what it drives, the load that it moves, and from where it is seen.
    pub remarks: Vec<String>,
    /// The load alone, if there is one.
    pub load: Option<String>,
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
        let structure = template.structure().ok();
        let is_helper = |joint: &JointTemplate| {
            structure
                .as_ref()
                .is_some_and(|linkage| linkage.find_joint(&joint.name).is_some_and(|id| linkage.is_helper(id)))
        };
        let joint = |(k, joint): (usize, &JointTemplate)| (displayed_name(&joint.name), template.construction(k));
        let stated = template.joints.iter().enumerate().filter(|(k, _)| !template.is_foot_at_pivot(*k));
        let (helpers, pins): (Vec<_>, Vec<_>) = stated.partition(|(_, joint)| is_helper(joint));
        // A fixed point is called one.
        let is_moving = |(_, joint): &&(usize, &JointTemplate)| !matches!(joint.kind, JointKindTemplate::Fixed(_));
        Key {
            dimensions,
            marks: PinMarks::Names,
            helpers: helpers.iter().filter(is_moving).map(|(_, joint)| displayed_name(&joint.name)).collect(),
            beyond: Vec::new(),
            joints: pins.into_iter().chain(helpers).map(joint).collect(),
            note: note_formulas(family),
            remarks: remarks(template, structure.as_ref()),
            load: template.load_in_words(),
            straight: straight_criterion_text(family.straight, if template.is_driven_by_length() { "" } else { "°" }),
        }
    }
}

/// What the drawing of a key has at pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum PinMarks {
    /// The names of their joints.
    #[default]
    Names,
    /// The numbers of their joints in the key, from 1, as a name is too long.
    Numbers,
    /// Letters in their place, from a, where curves have numbers.
    Letters,
}

impl Key {
    /// The mark of a joint by its index in the key; `None` if that is its name.
    pub(super) fn mark(&self, k: usize) -> Option<String> {
        const LETTERS: [char; 26] = [
            'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h', 'i', 'j', 'k', 'l', 'm', 'n', 'o', 'p', 'q', 'r', 's', 't', 'u',
            'v', 'w', 'x', 'y', 'z',
        ];
        match self.marks {
            PinMarks::Names => None,
            PinMarks::Numbers => Some((k + 1).to_string()),
            PinMarks::Letters => {
                let round = k / LETTERS.len();
                let round = if round > 0 { round.to_string() } else { String::new() };
                Some(format!("{}{round}", LETTERS[k % LETTERS.len()]))
            }
        }
    }

    /// What the drawing has at a pin: the names of its joints that are in the key, or their marks.
    pub(super) fn pin_label(&self, names: &[String]) -> String {
        let is_known = |name: &&String| self.joints.iter().any(|(own, _)| own.split(", ").any(|own| own == *name));
        let known: Vec<String> = names.iter().filter(is_known).cloned().collect();
        let names = if known.is_empty() { names } else { &known };
        let whole = names.join(", ");
        if self.marks == PinMarks::Names {
            return whole;
        }
        let mark = |name: &String| self.joints.iter().position(|(own, _)| own == name).and_then(|k| self.mark(k));
        let each = || names.iter().map(|name| mark(name).unwrap_or_default()).collect::<Vec<_>>().join(", ");
        mark(&whole).unwrap_or_else(each)
    }

    /// The key in which joints that are one pin on all pages of some linkages are one line with both names.
    pub(super) fn with_common_pins(mut self, pins: &[Vec<String>]) -> Key {
        for names in pins {
            let is_of_pin = |(name, _): &(String, MathText)| names.contains(name);
            let Some(first) = self.joints.iter().position(is_of_pin) else { continue };
            let (of_pin, others): (Vec<_>, Vec<_>) = self.joints.into_iter().partition(is_of_pin);
            self.joints = others;
            let name = of_pin.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
            let placed = MathText::join(of_pin.into_iter().map(|(_, placed)| placed), "; also ");
            self.joints.insert(first.min(self.joints.len()), (name, placed));
        }
        self
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
fn remarks(template: &Template, structure: Option<&Linkage>) -> Vec<String> {
    let name = |joint: usize| displayed_name(&template.joints[joint].name);
    let crank = template.joints.iter().enumerate().find_map(|(pin, joint)| match joint.kind {
        JointKindTemplate::Crank { pivot, .. } => {
            let ends = template.names_in_a_row(&[pivot, pin]);
            let link = if template.seen_from.is_some() { "driving link" } else { "crank" };
            Some(format!("the angle of the {link} {ends} {}", template.input_as_drawn()))
        }
        _ => None,
    });
    let driven_by = crank.unwrap_or_else(|| template.input_in_words());
    let range = template.input.as_ref().map_or(String::new(), |[from, to]| {
        let [from, to] = [from, to].map(InputValue::to_math_text);
        format!(", from {from} to {to}")
    });
    let driven_by = format!("input: {driven_by}{range}");
    let output = structure.and_then(|linkage| {
        let name = |joint: JointId| displayed_name(&linkage.joints[joint].name);
        let sliding = |pivot: JointId, through: JointId| {
            format!("output: the link from {} that slides through {}", name(pivot), name(through))
        };
        Some(match linkage.output()? {
            OutputLink::Link([from, to]) => match linkage.joints[to].kind {
                // Also where the line passes through the pivot, and the foot of the perpendicular is no other point.
                JointKind::Slot { base: [pivot, through], .. } if pivot == from => sliding(pivot, through),
                _ => format!("output: the link from {} to {}", name(from), name(to)),
            },
            OutputLink::Slot { base: [pivot, through], .. } => sliding(pivot, through),
            OutputLink::Slider { joint, .. } => format!("output: the slider {}", name(joint)),
        })
    });
    let frame = template.seen_from.map(|[origin, x]| format!("drawn with {} and {} fixed", name(origin), name(x)));
    let rotation = match template.rotation_before_drawing() {
        0.0 => None,
        deg => Some(format!("drawn turned by {}°: coordinates are those before", format_as_written(deg))),
    };
    let laid_out = template.joints.iter().any(|joint| joint.drawn.is_some());
    let laid_out =
        laid_out.then(|| "lengths and sides that are not stated are those of the places laid out".to_owned());
    let load = template.load_in_words().map(|load| format!("load: {load}"));
    [driven_by].into_iter().chain(output).chain(load).chain(frame).chain(rotation).chain(laid_out).collect()
}
