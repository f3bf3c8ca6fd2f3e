//! Orders the joints of a drawing so that each is placed from joints before it: on the driven link, by dyads, and on links that are placed.

use super::mobility::Mobility;
use super::vectors::DrawnVector;
use super::{Drawing, DrawnInput, Slide};
use crate::expression::{CompiledExpression, Unit};
use crate::problem::Problem;
use crate::template::{Coordinate, InputValue, JointKindTemplate, Side, SideTemplate};

/// The joints of a drawing as they are placed.
pub struct PlacedDrawing {
    /// How each joint is placed, in the order of the drawing, then those that it has not.
    pub kinds: Vec<JointKindTemplate>,
    /// The names of joints that the drawing has not: the feet of perpendiculars to lines that slide.
    pub feet: Vec<String>,
    /// The input in the drawing.
    pub start: InputValue,
    /// The frame, if another link is at rest while positions are computed.
    pub seen_from: Option<[usize; 2]>,
}

/// Places the joints of a drawing.
///
/// # Errors
/// It has another mobility than one, is rigid in a part, or has a group of links that no dyads solve.
pub fn place(drawing: &Drawing) -> Result<PlacedDrawing, Problem> {
    let mobility = Mobility::of(drawing);
    let mut placer = Placer::new(drawing);
    let mut result = placer.place_all();
    if result.is_ok() && mobility.degrees() != 1 {
        result = Err(Obstacle::Open);
    }
    let seen_from = seen_from(drawing);
    match result {
        Ok(()) => {
            let kinds =
                placer.kinds.into_iter().flatten().chain(placer.feet.iter().map(|foot| foot.kind.clone())).collect();
            let feet = placer.feet.into_iter().map(|foot| foot.name).collect();
            Ok(PlacedDrawing { kinds, feet, start: start(drawing), seen_from: seen_from? })
        }
        Err(obstacle) => Err(describe(drawing, mobility, &placer, obstacle)),
    }
}

/// Why joints cannot be placed.
enum Obstacle {
    /// A link, whose joints are all placed without it.
    Redundant(usize),
    /// A joint, which need not be on a line to be placed.
    RedundantSlide(usize),
    /// No joint can be placed from those that are.
    Open,
}

/// The foot of the perpendicular from a pivot to a line that slides through a joint.
struct Foot {
    name: String,
    kind: JointKindTemplate,
}

struct Placer<'d, 'v> {
    drawing: &'d Drawing<'v>,
    kinds: Vec<Option<JointKindTemplate>>,
    is_link_placed: Vec<bool>,
    is_slide_used: Vec<bool>,
    feet: Vec<Foot>,
}

impl<'d, 'v> Placer<'d, 'v> {
    fn new(drawing: &'d Drawing<'v>) -> Placer<'d, 'v> {
        Placer {
            drawing,
            kinds: vec![None; drawing.names.len()],
            is_link_placed: vec![false; drawing.links.len()],
            is_slide_used: vec![false; drawing.slides.len()],
            feet: Vec::new(),
        }
    }

    fn place_all(&mut self) -> Result<(), Obstacle> {
        self.place_ground();
        self.place_input()?;
        loop {
            self.check_links()?;
            if !(self.place_dyad()? || self.place_slide()? || self.place_slot()?) {
                break;
            }
        }
        if let Some(slide) = self.is_slide_used.iter().position(|is_used| !is_used) {
            let slide = &self.drawing.slides[slide];
            if self.is_placed(slide.joint) && self.is_link_placed[slide.link] {
                return Err(Obstacle::RedundantSlide(slide.joint));
            }
        }
        if self.kinds.iter().all(Option::is_some) && self.is_link_placed.iter().all(|is_placed| *is_placed) {
            Ok(())
        } else {
            Err(Obstacle::Open)
        }
    }

    fn is_placed(&self, joint: usize) -> bool {
        self.kinds[joint].is_some()
    }

    /// The joints of the link at rest.
    fn place_ground(&mut self) {
        let ground = self.drawing.ground();
        let line = match self.drawing.input {
            DrawnInput::Crank { from, .. } => from,
            DrawnInput::Slider { .. } | DrawnInput::Actuator { .. } => None,
        };
        for &joint in &self.drawing.links[ground].joints {
            let DrawnVector(position) = match line {
                None => self.drawing.coordinates[joint].clone(),
                Some([a, b]) => {
                    let (x_axis, own) = (self.drawing.vector(a, b), self.drawing.vector(a, joint));
                    DrawnVector([x_axis.along(&own), x_axis.across(&own)])
                }
            };
            self.kinds[joint] = Some(JointKindTemplate::Fixed(position));
        }
        self.is_link_placed[ground] = true;
    }

    fn place_input(&mut self) -> Result<(), Obstacle> {
        let drawing = self.drawing;
        let (link, line) = match drawing.input {
            DrawnInput::Slider { slide, .. } => {
                let Slide { joint, line: [a, b], .. } = drawing.slides[slide];
                let offset = drawing.vector(a, b).across(&drawing.vector(a, joint));
                self.kinds[joint] = Some(JointKindTemplate::DrivenSlider { line: [a, b], offset });
                self.is_slide_used[slide] = true;
                return Ok(());
            }
            DrawnInput::Crank { link, line: [pivot, joint], .. } => {
                self.kinds[joint] = Some(JointKindTemplate::Crank { pivot, length: drawing.length(pivot, joint) });
                (link, [pivot, joint])
            }
            DrawnInput::Actuator { link, joints: [from, joint, pivot], .. } => {
                self.kinds[joint] = Some(JointKindTemplate::Piston {
                    base: [from, pivot],
                    length: drawing.length(pivot, joint),
                    offset: CompiledExpression::constant(0.0),
                    side: self.side_of(joint, [from, pivot]),
                });
                (link, [pivot, joint])
            }
        };
        self.place_link(link, line)
    }

    /// The side of a line on which a joint is.
    fn side_of(&self, joint: usize, [a, b]: [usize; 2]) -> SideTemplate {
        let (first, second) = (self.drawing.vector(a, joint), self.drawing.vector(b, joint));
        // The angle at the joint is that between the links there.
        SideTemplate::Drawn(first.sine(&second))
    }

    /// Places the other joints of a link on which two are placed.
    fn place_link(&mut self, link: usize, base: [usize; 2]) -> Result<(), Obstacle> {
        self.is_link_placed[link] = true;
        let drawing = self.drawing;
        for &joint in drawing.links[link].joints.iter().filter(|joint| !base.contains(joint)) {
            if self.is_placed(joint) {
                return Err(Obstacle::Redundant(link));
            }
            self.kinds[joint] = Some(self.point(joint, base));
        }
        Ok(())
    }

    /// A point of a link, by coordinates on it, or by the distances that are given.
    fn point(&self, joint: usize, base: [usize; 2]) -> JointKindTemplate {
        let drawing = self.drawing;
        let [a, b] = base;
        let is_given = |[p, q]: [usize; 2]| drawing.given_length(p, q).is_some();
        if [[a, b], [a, joint], [b, joint]].into_iter().any(is_given) {
            let distances = base.map(|other| drawing.length(other, joint));
            return JointKindTemplate::Distances { base, distances, side: self.side_of(joint, base) };
        }
        let (line, own) = (drawing.vector(a, b), drawing.vector(a, joint));
        let [along, across] = [line.along(&own), line.across(&own)].map(Coordinate::Single);
        JointKindTemplate::Point { base, along, across }
    }

    /// Checks that no link is held by more joints than place it.
    fn check_links(&self) -> Result<(), Obstacle> {
        let placed =
            |link: &usize| self.drawing.links[*link].joints.iter().filter(|joint| self.is_placed(**joint)).count();
        let redundant = (0..self.drawing.links.len()).find(|link| !self.is_link_placed[*link] && placed(link) > 1);
        redundant.map_or(Ok(()), |link| Err(Obstacle::Redundant(link)))
    }

    /// The links that are not placed but for one joint, each with this joint.
    fn held_links(&self) -> impl Iterator<Item = (usize, usize)> {
        let links = self.drawing.links.iter().enumerate().filter(|(link, _)| !self.is_link_placed[*link]);
        links.filter_map(|(link, own)| {
            let mut placed = own.joints.iter().copied().filter(|joint| self.is_placed(*joint));
            Some((link, placed.next()?)).filter(|_| placed.next().is_none())
        })
    }

    /// Places the common joint of two links, each of which has one joint that is placed.
    fn place_dyad(&mut self) -> Result<bool, Obstacle> {
        let drawing = self.drawing;
        let mut held = vec![None; drawing.links.len()];
        self.held_links().for_each(|(link, by)| held[link] = Some(by));
        for joint in (0..self.kinds.len()).filter(|joint| !self.is_placed(*joint)) {
            let mut at_joint = drawing.links_at[joint].iter().filter_map(|&link| Some((link, held[link]?)));
            let Some((first, a)) = at_joint.next() else { continue };
            let Some((second, b)) = at_joint.find(|(_, other)| *other != a) else { continue };
            let lengths = [a, b].map(|other| drawing.length(other, joint));
            let side = self.side_of(joint, [a, b]);
            self.kinds[joint] = Some(JointKindTemplate::Dyad { base: [a, b], lengths, side });
            self.place_link(first, [a, joint])?;
            self.place_link(second, [b, joint])?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Places a joint that slides on a line of a link that is placed.
    fn place_slide(&mut self) -> Result<bool, Obstacle> {
        let drawing = self.drawing;
        for (k, slide) in drawing.slides.iter().enumerate() {
            let joint = slide.joint;
            let is_free = !self.is_slide_used[k] && !self.is_placed(joint);
            let held = self.held_links().find(|(link, _)| drawing.links_at[joint].contains(link));
            let Some((link, from)) = held.filter(|_| is_free && self.is_link_placed[slide.link]) else { continue };
            let [a, b] = slide.line;
            let line = drawing.vector(a, b);
            let own = drawing.vector(from, joint);
            self.kinds[joint] = Some(JointKindTemplate::Slide {
                from,
                length: drawing.length(from, joint),
                line: slide.line,
                offset: line.across(&drawing.vector(a, joint)),
                // The cosine of the angle between the link and the line.
                side: SideTemplate::Drawn(line.along(&own) / own.length()),
            });
            self.is_slide_used[k] = true;
            self.place_link(link, [from, joint])?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Places a link with a line that slides through a joint that is placed.
    fn place_slot(&mut self) -> Result<bool, Obstacle> {
        let drawing = self.drawing;
        for (k, slide) in drawing.slides.iter().enumerate() {
            let through = slide.joint;
            let held = self.held_links().find(|(link, _)| *link == slide.link);
            let is_free = !self.is_slide_used[k] && self.is_placed(through);
            let Some((link, pivot)) = held.filter(|(_, pivot)| is_free && *pivot != through) else { continue };
            self.place_sliding_link(link, pivot, (through, slide.line));
            self.is_slide_used[k] = true;
            self.is_link_placed[link] = true;
            return Ok(true);
        }
        Ok(false)
    }

    fn place_sliding_link(&mut self, link: usize, pivot: usize, (through, line): (usize, [usize; 2])) {
        let drawing = self.drawing;
        let [a, b] = line;
        let direction = drawing.vector(a, b);
        let to_joint = drawing.vector(pivot, through);
        // From the foot to the joint, in the direction of the line.
        let ahead = direction.along(&to_joint);
        let offset = direction.across(&to_joint);
        let is_on_line = line.contains(&pivot);
        let kind = if is_on_line {
            JointKindTemplate::Slot {
                base: [pivot, through],
                offset: CompiledExpression::constant(0.0),
                side: SideTemplate::Given(Side::Right),
            }
        } else {
            // The foot is to the right of the line to the joint if the joint is ahead on a line that passes to the left of the pivot.
            let turned = ahead.clone() * offset.clone() / (to_joint.dot(&to_joint));
            let is_flat = offset.constant_value() == Some(0.0);
            JointKindTemplate::Slot {
                base: [pivot, through],
                offset: CompiledExpression::call(crate::expression::Function::Abs, [offset]),
                side: if is_flat { SideTemplate::Given(Side::Right) } else { SideTemplate::Drawn(turned) },
            }
        };
        let name = (1..)
            .map(|k| format!("{}{}", drawing.names[pivot], "'".repeat(k)))
            .find(|name| !drawing.names.contains(&name.as_str()) && self.feet.iter().all(|foot| foot.name != *name));
        self.feet.push(Foot { name: name.unwrap_or_default(), kind });
        // Points of the link are measured in the direction from the foot to the joint.
        let sign = ahead.clone() / CompiledExpression::call(crate::expression::Function::Abs, [ahead]);
        for &joint in drawing.links[link].joints.iter().filter(|joint| **joint != pivot) {
            let own = drawing.vector(pivot, joint);
            let [along, across] =
                [direction.along(&own), direction.across(&own)].map(|value| Coordinate::Single(value * sign.clone()));
            self.kinds[joint] = Some(JointKindTemplate::Point { base: [pivot, through], along, across });
        }
    }
}

/// The input in a drawing.
fn start(drawing: &Drawing) -> InputValue {
    let one = CompiledExpression::constant(1.0);
    let angle = |from: &DrawnVector, to: &DrawnVector| {
        let radians = from.angle_to(to);
        match radians.constant_value() {
            Some(radians) => {
                InputValue { value: CompiledExpression::constant(radians.to_degrees()), unit: Some(Unit::Deg) }
            }
            None => InputValue { value: radians, unit: Some(Unit::Rad) },
        }
    };
    match drawing.input {
        DrawnInput::Crank { from, line: [pivot, joint], .. } => {
            let x_axis = DrawnVector([one, CompiledExpression::constant(0.0)]);
            let from = from.map_or(x_axis, |[a, b]| drawing.vector(a, b));
            angle(&from, &drawing.vector(pivot, joint))
        }
        DrawnInput::Slider { slide, .. } => {
            let Slide { joint, line: [a, b], .. } = drawing.slides[slide];
            InputValue { value: drawing.vector(a, b).along(&drawing.vector(a, joint)), unit: None }
        }
        DrawnInput::Actuator { joints: [a, b, _], .. } => InputValue { value: drawing.length(a, b), unit: None },
    }
}

/// The two joints of the frame from which everything is seen, if another link is at rest while positions are computed.
fn seen_from(drawing: &Drawing) -> Result<Option<[usize; 2]>, Problem> {
    if drawing.ground() == 0 {
        return Ok(None);
    }
    let frame = &drawing.links[0];
    let constant = |joint: usize| {
        let DrawnVector(xy) = &drawing.coordinates[joint];
        xy.each_ref().map(CompiledExpression::constant_value)
    };
    let origin = frame.joints.iter().copied().find(|joint| constant(*joint) == [Some(0.0), Some(0.0)]);
    let is_on_axis = |joint: &usize| {
        let DrawnVector([x, y]) = &drawing.coordinates[*joint];
        // Of an expression the sign is checked where it is a number.
        y.constant_value() == Some(0.0) && x.constant_value().is_none_or(|x| x > 0.0)
    };
    let on_axis = frame.joints.iter().copied().find(|joint| Some(*joint) != origin && is_on_axis(joint));
    match origin.zip(on_axis) {
        Some((origin, on_axis)) => Ok(Some([origin, on_axis])),
        None => {
            let problem = Problem::error(
                frame.span.clone(),
                "neither link of the input is on the frame, which then needs a joint at [0, 0] and one at [x, 0] to its right",
            );
            Err(problem.with_help("draw a fixed joint at the origin, and another to its right"))
        }
    }
}

/// The problem of a drawing that cannot be placed.
fn describe(drawing: &Drawing, mobility: Mobility, placer: &Placer, obstacle: Obstacle) -> Problem {
    let count = mobility.in_words();
    let listed = |joints: Vec<usize>| {
        let names: Vec<String> = joints.into_iter().map(|joint| drawing.joint_name(joint)).collect();
        match &names[..] {
            [] => String::new(),
            [only] => only.clone(),
            [others @ .., last] => format!("{} and {last}", others.join(", ")),
        }
    };
    let unplaced = || (0..drawing.names.len()).filter(|joint| !placer.is_placed(*joint)).collect::<Vec<_>>();
    match obstacle {
        Obstacle::Redundant(link) => {
            let span = drawing.links[link].span.clone();
            let problem = Problem::error(
                span,
                format!(
                    "{} is one too many: its joints are held without it, so that a part is rigid",
                    drawing.link_name(link)
                ),
            );
            problem.with_help(format!("leave it out, or a joint of it; degrees of freedom: {count}. A parallelogram with a further link is a joint with `parallelogram` in [linkage.joints]"))
        }
        Obstacle::RedundantSlide(joint) => {
            let problem = Problem::error(
                drawing.spans[joint][0].clone(),
                format!(
                    "{} is held without the line on which it slides, so that a part is rigid",
                    drawing.joint_name(joint)
                ),
            );
            problem.with_help(format!("leave the line out of `slides`; degrees of freedom: {count}"))
        }
        Obstacle::Open if mobility.degrees() > 1 => {
            let problem = Problem::error(
                drawing.span.clone(),
                format!("the drawing has {} degrees of freedom, where one is driven: {count}", mobility.degrees()),
            );
            problem.with_help(format!("add links or slides that hold {}", listed(unplaced())))
        }
        Obstacle::Open if mobility.degrees() < 1 => {
            let problem = Problem::error(drawing.span.clone(), format!("the drawing cannot move: {count}"));
            problem.with_help(format!("leave a link out; those with {} hold each other", listed(unplaced())))
        }
        Obstacle::Open => {
            let message = format!("no dyads place {}: these links hold each other", listed(unplaced()));
            let problem = Problem::error(drawing.input_span.clone(), message);
            let inputs = other_inputs(drawing);
            problem.with_help(match &inputs[..] {
                [] => "there is no other input by which dyads would place them".to_owned(),
                inputs => format!("drive it elsewhere, which gives the same curves: input = {}", inputs.join(" or ")),
            })
        }
    }
}

/// The inputs by which dyads place all joints: links on the frame, then angles between moving links.
fn other_inputs(drawing: &Drawing) -> Vec<String> {
    let mut found = Vec::new();
    for ground in 0..drawing.links.len() {
        for link in (1..drawing.links.len()).filter(|link| *link > ground) {
            let (own, other) = (&drawing.links[link].joints, &drawing.links[ground].joints);
            let Some(&pivot) = own.iter().find(|joint| other.contains(joint)) else { continue };
            let Some(&joint) = own.iter().find(|joint| **joint != pivot) else { continue };
            let Some(&before) = other.iter().find(|joint| **joint != pivot).or((ground == 0).then_some(&pivot)) else {
                continue;
            };
            let from = (ground != 0).then_some([before, pivot]);
            let input = DrawnInput::Crank { ground, from, link, line: [pivot, joint] };
            let tried = Drawing { input, ..drawing.clone() };
            if Placer::new(&tried).place_all().is_ok() {
                let name = |joint: usize| drawing.names[joint];
                found.push(match ground {
                    0 => format!("\"{} {}\"", name(pivot), name(joint)),
                    _ => format!(
                        "{{ between = [\"{} {}\", \"{} {}\"] }}",
                        name(before),
                        name(pivot),
                        name(pivot),
                        name(joint)
                    ),
                });
            }
            if found.len() == 2 {
                return found;
            }
        }
    }
    found
}
