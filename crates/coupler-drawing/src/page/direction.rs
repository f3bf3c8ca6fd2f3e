//! The marks of a key that tell the directions of the input and of the output.

use super::mechanism::PosedMechanism;
use super::theme::Theme;
use crate::scene::{Item, Path, Polyline};
use coupler_curves::geometry::{Point, Similarity, Vector, cross, left_normal, trig};
use coupler_curves::linkage::{JointId, OutputLink};
use coupler_curves::motion::Circuit;

/// The lines of the marks, in the plane of the linkage or on the page.
#[derive(Default)]
pub(super) struct DirectionMarks {
    /// From the crank's pivot in the direction of input 0; none if there is no crank.
    zero: Vec<Point>,
    /// Lines that end with an arrowhead: an arc from that line in the direction of increasing input, a line in which an actuator
    /// extends, arcs to both sides of an output link that swings or to one of a link that turns, lines to both sides of a slider.
    arrows: Vec<Vec<Point>>,
}

impl DirectionMarks {
    /// The marks of a linkage in its pose, in the plane; `circuit` tells whether its output swings. The arc of the input
    /// has at least a radius, for a short crank is hidden by its joints.
    pub fn new(mechanism: &PosedMechanism, circuit: &Circuit, least_radius: f64) -> DirectionMarks {
        let mut marks = input_marks(mechanism, least_radius).unwrap_or_default();
        marks.arrows.extend(actuator_arrows(mechanism, least_radius));
        marks.arrows.extend(output_arrows(mechanism, circuit, least_radius));
        marks
    }

    /// The marks in other coordinates.
    pub fn map(&self, similarity: Similarity) -> DirectionMarks {
        let map = |points: &Vec<Point>| points.iter().map(|p| similarity.apply(*p)).collect();
        DirectionMarks { zero: map(&self.zero), arrows: self.arrows.iter().map(map).collect() }
    }

    /// All points of the marks.
    pub fn points(&self) -> impl Iterator<Item = Point> + '_ {
        self.zero.iter().chain(self.arrows.iter().flatten()).copied()
    }

    /// The end of the line in the direction of input 0, where its label is.
    pub fn zero_end(&self) -> Option<Point> {
        self.zero.last().copied()
    }

    /// The items of marks on the page.
    pub fn items(&self, theme: &Theme) -> Vec<Item> {
        let line =
            |points: &Vec<Point>, width| Item::Path(Path::stroked(points.clone(), theme.stroke(theme.grey, width)));
        let mut items = Vec::new();
        if !self.zero.is_empty() {
            items.push(line(&self.zero, theme.hair_width));
        }
        for arrow in &self.arrows {
            items.push(line(arrow, theme.fine_width));
            items.extend(arrowhead(arrow, theme));
        }
        items
    }
}

/// The line of input 0 and the arc in the direction of increasing input.
fn input_marks(mechanism: &PosedMechanism, least_radius: f64) -> Option<DirectionMarks> {
    /// The radius of the arc relative to the crank, but at most in least radii, and the length of the line relative to the radius.
    const RADIUS: f64 = 0.5;
    const MOST: f64 = 5.0;
    const LINE: f64 = 1.3;
    const ARC_DEG: u32 = 66;
    const STEP_DEG: usize = 3;
    let [pivot, _] = mechanism.linkage.crank()?;
    let radius = (RADIUS * mechanism.linkage.crank_length()?).clamp(least_radius, MOST * least_radius);
    let (zero, turn) = mechanism.input_axes()?;
    let centre = mechanism.pose[pivot];
    let at = |deg: u32| {
        let (cos, sin) = trig::cos_sin_deg(f64::from(deg));
        centre + (zero * cos + turn * sin) * radius
    };
    let arc = (0..=ARC_DEG).step_by(STEP_DEG).map(at).collect();
    Some(DirectionMarks { zero: vec![centre, centre + zero * (LINE * radius)], arrows: vec![arc] })
}

/// A line beside each actuator, in the direction in which it extends.
fn actuator_arrows(mechanism: &PosedMechanism, least_radius: f64) -> Vec<Vec<Point>> {
    /// Where it begins and ends, in parts of the actuator.
    const ENDS: [f64; 2] = [0.35, 0.7];
    let arrow = |[from, joint]: [JointId; 2]| {
        let (start, along) = (mechanism.pose[from], mechanism.pose[joint] - mechanism.pose[from]);
        let aside = left_normal(along.try_normalize(0.0)?) * (0.6 * least_radius);
        Some(ENDS.map(|part| start + along * part + aside).to_vec())
    };
    mechanism.mechanism.actuators.iter().copied().filter_map(arrow).collect()
}

/// The arrows of the output.
fn output_arrows(mechanism: &PosedMechanism, circuit: &Circuit, least_radius: f64) -> Vec<Vec<Point>> {
    match mechanism.linkage.output() {
        Some(OutputLink::Link(ends)) => output_arcs(mechanism, circuit, ends, least_radius),
        Some(OutputLink::Slot { base, .. }) => output_arcs(mechanism, circuit, base, least_radius),
        Some(OutputLink::Slider { joint, .. }) => slider_arrows(mechanism, joint, least_radius).unwrap_or_default(),
        None => Vec::new(),
    }
}

/// Lines to both sides of a slider, along its guide.
fn slider_arrows(mechanism: &PosedMechanism, joint: JointId, least_radius: f64) -> Option<Vec<Vec<Point>>> {
    /// Where they begin and end, in least radii from the slider's centre.
    const ENDS: [f64; 2] = [1.2, 2.6];
    let guide = mechanism.linkage.slider_line(joint)?.map(|joint| mechanism.pose[joint]);
    let along = (guide[1] - guide[0]).try_normalize(0.0)? * least_radius;
    let aside = left_normal(along) * 0.6;
    let centre = mechanism.pose[joint] + aside;
    Some([1.0, -1.0].map(|side| ENDS.map(|end| centre + along * (side * end)).to_vec()).to_vec())
}

/// Two arcs from an output link to its sides, about its pivot; if it turns fully, and the input never reverses, one in the direction in which it does.
fn output_arcs(
    mechanism: &PosedMechanism,
    circuit: &Circuit,
    [pivot, end]: [JointId; 2],
    least_radius: f64,
) -> Vec<Vec<Point>> {
    /// The radii of the arcs relative to the link, of which the first is chosen that is clear of joints, and the least in least
    /// radii: a short link is hidden by its joints.
    const RADII: [f64; 7] = [0.6, 0.45, 0.75, 0.35, 0.85, 1.4, 2.0];
    const LEAST: f64 = 2.0;
    /// The angle of an arc, and its least length in least radii: it is longer than its arrowhead.
    const ARC_DEG: i32 = 15;
    const LEAST_LENGTH: f64 = 1.0;
    let arm = |k: usize| circuit.positions.point(end, k) - circuit.positions.point(pivot, k);
    let turned: f64 = (1..circuit.len()).map(|k| angle_between(arm(k - 1), arm(k))).sum();
    let sides: &[i32] = match turned {
        turned if !circuit.is_full_turn() || turned.abs() <= 180.0 => &[1, -1],
        turned if turned > 0.0 => &[2],
        _ => &[-2],
    };
    let (centre, arm) = (mechanism.pose[pivot], mechanism.pose[end] - mechanism.pose[pivot]);
    let Some(along) = arm.try_normalize(0.0) else { return Vec::new() };
    let arcs = |part: f64| -> Vec<Vec<Point>> {
        let radius = (part * arm.norm()).max(LEAST * least_radius);
        let arc_deg = ARC_DEG.max(trig::degrees(LEAST_LENGTH * least_radius / radius).ceil() as i32);
        let along = along * radius;
        let at = |deg: i32| {
            let (cos, sin) = trig::cos_sin_deg(f64::from(deg));
            centre + along * cos + left_normal(along) * sin
        };
        sides.iter().map(|side| (0..=arc_deg).map(|deg| at(side * deg)).collect()).collect()
    };
    let joints = mechanism.drawn_joints();
    let with_clearance = |arcs: Vec<Vec<Point>>| {
        let distances =
            arcs.iter().flatten().flat_map(|&p| joints.iter().map(move |&joint| (mechanism.pose[joint] - p).norm()));
        (distances.fold(f64::INFINITY, f64::min).min(0.5 * least_radius), arcs)
    };
    let candidates = RADII.into_iter().map(|part| with_clearance(arcs(part)));
    candidates.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, arcs)| arcs).unwrap_or_default()
}

/// The angle from a vector to another, in degrees from -180 to 180.
fn angle_between(a: Vector, b: Vector) -> f64 {
    trig::degrees(trig::atan2(cross(a, b), a.dot(&b)))
}

/// A filled arrowhead at the end of a line.
fn arrowhead(points: &[Point], theme: &Theme) -> Option<Item> {
    let [.., before, tip] = *points else { return None };
    let along = (tip - before).try_normalize(0.0)? * (2.0 * theme.joint_radius);
    let across = left_normal(along) * 0.35;
    let points = vec![tip, tip - along + across, tip - along - across];
    Some(Item::Path(Path {
        polylines: vec![Polyline { points, is_closed: true }],
        stroke: None,
        fill: Some(theme.grey),
    }))
}
