//! A drawing as joints of which each is placed from others, with the input in it and the frame from which it is seen.

use super::mobility::Mobility;
use super::obstacle::describe;
use super::placer::{FurtherJoint, Obstacle, Placer};
use super::vectors::DrawnVector;
use super::{Drawing, DrawnInput, Slide};
use crate::expression::{CompiledExpression, Unit};
use crate::problem::Problem;
use crate::template::{ClosureTemplate, Coordinate, InputValue, JointKindTemplate};

/// The joints of a drawing as they are placed.
pub struct PlacedDrawing {
    /// How each joint of the drawing is placed.
    pub kinds: Vec<JointKindTemplate>,
    /// The joints that the drawing has not: feet of perpendiculars to lines that slide, and what the frame is seen by.
    pub further: Vec<FurtherJoint>,
    /// The closed loops of the joints that no dyads place.
    pub closures: Vec<ClosureTemplate>,
    /// The same drawing driven elsewhere, by which dyads place all joints, if they are not placed by dyads here.
    pub driven_elsewhere: Option<Box<PlacedDrawing>>,
    /// The input in the drawing.
    pub start: InputValue,
    /// Two joints of the frame, if it does not lie as in the drawing while positions are computed.
    pub seen_from: Option<[usize; 2]>,
}

impl PlacedDrawing {
    /// Whether an actuator between two joints that are placed with the others drives it.
    pub fn has_driven_distance(&self) -> bool {
        self.closures.iter().any(|closure| matches!(closure, ClosureTemplate::Drive { .. }))
    }
}

/// Places the joints of a drawing.
///
/// # Errors
/// It has another mobility than one, is rigid in a part, or or has more joints that no dyads place than are possible; or it is to be seen from a frame with one joint.
pub fn place(drawing: &Drawing) -> Result<PlacedDrawing, Problem> {
    let mobility = Mobility::of(drawing);
    let mut placer = Placer::new(drawing);
    let mut result = placer.place_all();
    let (mut closures, mut driven_elsewhere) = (Vec::new(), None);
    if matches!(result, Err(Obstacle::Open)) && mobility.degrees() == 1 {
        placer = Placer::new(drawing);
        (result, closures) = match placer.place_as_group() {
            Ok(closures) => (Ok(()), closures),
            Err(obstacle) => (Err(obstacle), Vec::new()),
        };
        driven_elsewhere = drive_elsewhere(drawing).map(Box::new);
    }
    if result.is_ok() && mobility.degrees() != 1 {
        result = Err(Obstacle::Open);
    }
    if let Err(obstacle) = result {
        return Err(describe(drawing, mobility, &placer, obstacle));
    }
    let seen_from = match drawing.input {
        DrawnInput::Crank { ground: 0, from: None, .. }
        | DrawnInput::Slider { ground: 0, .. }
        | DrawnInput::Actuator { ground: 0, .. }
        | DrawnInput::Distance { .. } => None,
        _ => Some(seen_from(drawing, &mut placer)?),
    };
    let kinds = placer.kinds.into_iter().flatten().collect();
    Ok(PlacedDrawing { kinds, further: placer.further, closures, driven_elsewhere, start: start(drawing), seen_from })
}

/// The drawing driven by the angle between two links by which dyads place all joints; links on the frame are tried first.
fn drive_elsewhere(drawing: &Drawing) -> Option<PlacedDrawing> {
    let links = drawing.links.len();
    let mut pairs = (0..links).flat_map(|ground| (ground + 1..links).map(move |link| (ground, link)));
    pairs.find_map(|(ground, link)| {
        let (own, other) = (&drawing.links[link].joints, &drawing.links[ground].joints);
        let pivot = *own.iter().find(|joint| other.contains(joint))?;
        let joint = *own.iter().find(|joint| **joint != pivot)?;
        let from = match ground {
            0 => None,
            _ => Some([*other.iter().find(|joint| **joint != pivot)?, pivot]),
        };
        let input = DrawnInput::Crank { ground, from, link, line: [pivot, joint] };
        let tried = Drawing { input, ..drawing.clone() };
        let mut placer = Placer::new(&tried);
        placer.place_all().ok()?;
        Some(PlacedDrawing {
            kinds: placer.kinds.into_iter().flatten().collect(),
            further: placer.further,
            closures: Vec::new(),
            driven_elsewhere: None,
            start: start(&tried),
            seen_from: None,
        })
    })
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
        DrawnInput::Actuator { joints: [a, b, _], .. } | DrawnInput::Distance { joints: [a, b] } => {
            InputValue { value: drawing.length(a, b), unit: None }
        }
    }
}

/// Two joints of the frame, at the origin and on the x-axis of the drawing, from which everything is seen if another link is at rest while positions are
/// computed, or the frame lies along a line from which the input is measured; points of the frame are added for what it has not.
fn seen_from(drawing: &Drawing, placer: &mut Placer) -> Result<[usize; 2], Problem> {
    let frame = &drawing.links[0];
    let &[a, b, ..] = &frame.joints[..] else {
        let problem =
            Problem::error(frame.span.clone(), "neither link of the input is on the frame, which has one joint only");
        return Err(problem.with_help("add a second fixed joint, which shows how the frame lies"));
    };
    let is_at = |joint: &usize, x: f64, y: f64| {
        let DrawnVector(xy) = &drawing.coordinates[*joint];
        xy.each_ref().map(CompiledExpression::constant_value) == [Some(x), Some(y)]
    };
    let is_on_axis = |joint: &usize| {
        let DrawnVector([x, y]) = &drawing.coordinates[*joint];
        y.constant_value() == Some(0.0) && x.constant_value().is_some_and(|x| x > 0.0)
    };
    let origin = frame.joints.iter().copied().find(|joint| is_at(joint, 0.0, 0.0));
    let on_axis = frame.joints.iter().copied().find(is_on_axis);
    let mut point = |name: &str, x: f64| {
        let position = [x, 0.0].map(CompiledExpression::constant);
        let (line, own) = (drawing.vector(a, b), &DrawnVector(position.clone()) - &drawing.coordinates[a]);
        let [along, across] = line.components(&own).map(Coordinate::Single);
        placer.add_further(name.to_owned(), JointKindTemplate::Point { base: [a, b], along, across }, Some(position))
    };
    let origin = origin.unwrap_or_else(|| point("origin", 0.0));
    Ok([origin, on_axis.unwrap_or_else(|| point("x-axis", 1.0))])
}
