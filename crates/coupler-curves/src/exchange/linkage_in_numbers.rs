//! A linkage joint by joint, in numbers: the `[[linkage]]` of a template with the values of its parameters.

use std::fmt::Write;

use crate::expression::CompiledExpression;
use crate::linkage::Load;
use crate::linkage_format::{quoted, toml_key, toml_number};
use crate::template::{Coordinate, InputValue, JointKindTemplate, OutputLinkTemplate, Side, SideTemplate, Template};

/// The keys of a `[[linkage]]` but its id: the joints of a template with the values of its parameters, in numbers. Joints of a group cannot be
/// written so; they have no keys.
pub fn linkage_in_numbers(template: &Template, values: &[f64]) -> String {
    let text = Text { template, values };
    let traced = traced_joints(template);
    let is_needed = needed_joints(template, &traced);
    let mut out = String::new();
    let mut line = |key: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{key} = {value}");
    };
    if !template.source.is_empty() {
        line("source", quoted(&template.source));
    }
    line("trace", text.names(&traced));
    if let Some(start) = &template.start {
        line("start", text.input(start));
    }
    if let Some(range) = &template.input {
        line("input", format!("{{ {} }}", text.range(range)));
    }
    if let Some((range, branch)) = &template.arc {
        line("arc", format!("{{ {}, branch = {branch} }}", text.range(range)));
    }
    if let Some(joints) = &template.seen_from {
        line("seen_from", text.names(joints));
    }
    match &template.output_link {
        None => {}
        Some(OutputLinkTemplate::Link(joints)) => line("output_link", text.names(joints)),
        Some(OutputLinkTemplate::Slider(joint)) => line("output_link", text.name(*joint)),
    }
    if let Some(tolerance) = template.tolerance {
        line("tolerance", toml_number(tolerance));
    }
    if let Some(load) = template.load {
        line("load", load_to_toml(template, load));
    }
    if !template.chains.is_empty() {
        let chains: Vec<String> = template.chains.iter().map(|joints| text.names(joints)).collect();
        line("chains", format!("[{}]", chains.join(", ")));
    }
    out.push_str("\n[linkage.joints]\n");
    for (placed, _) in template.joints.iter().zip(is_needed).filter(|(_, is_needed)| *is_needed) {
        let _ = writeln!(out, "{} = {{ {} }}", toml_key(&placed.name), text.kind(&placed.kind));
    }
    out
}

/// The `load` of a template.
pub(super) fn load_to_toml(template: &Template, load: Load<usize>) -> String {
    let direction = load.direction_deg.map(|deg| format!(", direction = \"{} deg\"", toml_number(deg)));
    let joint = quoted(&template.joints[load.joint].name);
    format!("{{ joint = {joint}, force = {}{} }}", toml_number(load.force), direction.unwrap_or_default())
}

/// The joints that are traced, and those that nothing is placed from but whose links limit the motion: a manifest has no others
/// that are used for nothing.
fn traced_joints(template: &Template) -> Vec<usize> {
    let mut traced = template.traced.clone();
    for (k, joint) in template.joints.iter().enumerate().rev() {
        let has_limits = matches!(
            joint.kind,
            JointKindTemplate::Dyad { .. } | JointKindTemplate::Slide { .. } | JointKindTemplate::Slot { .. }
        );
        if has_limits && !needed_joints(template, &traced)[k] {
            traced.push(k);
        }
    }
    traced
}

/// Which joints are needed: those that are named, that drive the linkage or limit its motion, and those that they are placed from.
fn needed_joints(template: &Template, named: &[usize]) -> Vec<bool> {
    let mut is_needed = vec![false; template.joints.len()];
    let output = match template.output_link {
        None => Vec::new(),
        Some(OutputLinkTemplate::Link(joints)) => joints.to_vec(),
        Some(OutputLinkTemplate::Slider(joint)) => vec![joint],
    };
    let other = template.seen_from.iter().flatten().chain(&output).chain(template.chains.iter().flatten());
    let loaded = template.load.map(|load| load.joint);
    named.iter().chain(other).chain(&loaded).for_each(|&joint| is_needed[joint] = true);
    // Each joint is placed from joints before it.
    for (k, joint) in template.joints.iter().enumerate().rev() {
        is_needed[k] |= drives(&joint.kind);
        if is_needed[k] {
            joint.kind.referenced_joints().into_iter().for_each(|base| is_needed[base] = true);
        }
    }
    is_needed
}

/// Whether a joint drives the linkage, or is there for its links alone.
fn drives(kind: &JointKindTemplate) -> bool {
    matches!(
        kind,
        JointKindTemplate::Crank { .. }
            | JointKindTemplate::Piston { .. }
            | JointKindTemplate::DrivenSlider { .. }
            | JointKindTemplate::Parallelogram { .. }
    )
}

/// Writes the values of a template.
struct Text<'t> {
    template: &'t Template,
    values: &'t [f64],
}

impl Text<'_> {
    fn name(&self, joint: usize) -> String {
        quoted(&self.template.joints[joint].name)
    }

    fn names(&self, joints: &[usize]) -> String {
        format!("[{}]", joints.iter().map(|&joint| self.name(joint)).collect::<Vec<_>>().join(", "))
    }

    fn evaluate(&self, expression: &CompiledExpression) -> f64 {
        // Without a minus where it is zero.
        expression.evaluate(|slot| self.values[slot]) + 0.0
    }

    fn number(&self, expression: &CompiledExpression) -> String {
        toml_number(self.evaluate(expression))
    }

    fn pair(&self, numbers: &[CompiledExpression; 2]) -> String {
        format!("[{}]", numbers.each_ref().map(|number| self.number(number)).join(", "))
    }

    fn input(&self, value: &InputValue) -> String {
        let number = toml_number(value.evaluate(self.values) + 0.0);
        if value.unit.is_some() { format!("\"{number} deg\"") } else { number }
    }

    fn range(&self, [from, to]: &[InputValue; 2]) -> String {
        format!("from = {}, to = {}", self.input(from), self.input(to))
    }

    /// The side of a joint, in the words for the left one and the right one.
    fn side(&self, side: &SideTemplate, [left, right]: [&str; 2]) -> String {
        let side = side.evaluate(|sine| self.evaluate(sine));
        format!("side = \"{}\"", if side == Some(Side::Right) { right } else { left })
    }

    fn coordinate(&self, coordinate: &Coordinate) -> String {
        match coordinate {
            Coordinate::Single(value) => self.number(value),
            Coordinate::Range { from, to, count } => {
                format!("{{ from = {}, to = {}, count = {count} }}", self.number(from), self.number(to))
            }
        }
    }

    /// How a joint is placed, as the keys of its table.
    fn kind(&self, kind: &JointKindTemplate) -> String {
        const SIDES: [&str; 2] = ["left", "right"];
        let offset = |offset: &CompiledExpression| format!("offset = {}", self.number(offset));
        match kind {
            JointKindTemplate::Fixed(position) => format!("fixed = {}", self.pair(position)),
            JointKindTemplate::Crank { pivot, length } => {
                format!("crank = {}, length = {}", self.name(*pivot), self.number(length))
            }
            JointKindTemplate::Gear { crank, pivot, length, ratio, phase } => format!(
                "gear = {}, about = {}, length = {}, ratio = {}, phase = {}",
                self.name(*crank),
                self.name(*pivot),
                self.number(length),
                self.pair(ratio),
                self.input(phase)
            ),
            JointKindTemplate::Rack { crank, line, offset: own, radius, start } => format!(
                "rack = {}, radius = {}, line = {}, {}, start = {}",
                self.name(*crank),
                self.number(radius),
                self.names(line),
                offset(own),
                self.number(start)
            ),
            // Only drawings have the links of a group.
            JointKindTemplate::Grouped { .. } => String::new(),
            JointKindTemplate::Piston { base, length, offset: own, side } => format!(
                "piston = {}, length = {}, {}, {}",
                self.names(base),
                self.number(length),
                offset(own),
                self.side(side, SIDES)
            ),
            JointKindTemplate::DrivenSlider { line, offset: own } => {
                format!("slider = {}, {}", self.names(line), offset(own))
            }
            JointKindTemplate::Dyad { base, lengths, side } => {
                let (base, lengths) = (self.names(base), self.pair(lengths));
                format!("dyad = {base}, lengths = {lengths}, {}", self.side(side, SIDES))
            }
            JointKindTemplate::Slide { from, length, line, offset: own, side } => format!(
                "slide = {}, length = {}, line = {}, {}, {}",
                self.name(*from),
                self.number(length),
                self.names(line),
                offset(own),
                self.side(side, ["ahead", "behind"])
            ),
            JointKindTemplate::Yoke { from, line, offset: own, angle } => format!(
                "yoke = {}, line = {}, {}, angle = {}",
                self.name(*from),
                self.names(line),
                offset(own),
                self.input(angle)
            ),
            // In a drawing a line without an offset points to the joint through which it slides, as it does without a side.
            JointKindTemplate::Slot { base, offset: own, side: SideTemplate::Drawn(_) }
                if self.evaluate(own) == 0.0 =>
            {
                format!("slot = {}", self.names(base))
            }
            JointKindTemplate::Slot { base, offset: own, side } => {
                format!("slot = {}, {}, {}", self.names(base), offset(own), self.side(side, SIDES))
            }
            JointKindTemplate::Parallelogram { corners } => format!("parallelogram = {}", self.names(corners)),
            JointKindTemplate::Point { base, along, across } => format!(
                "point = {}, along = {}, across = {}",
                self.names(base),
                self.coordinate(along),
                self.coordinate(across)
            ),
            JointKindTemplate::Distances { base, distances, side } => {
                let (base, distances) = (self.names(base), self.pair(distances));
                format!("point = {base}, distances = {distances}, {}", self.side(side, SIDES))
            }
        }
    }
}
