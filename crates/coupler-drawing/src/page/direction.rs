//! The marks of a key that tell the directions of the input and of the output.

use super::mechanism::PosedMechanism;
use super::theme::Theme;
use crate::scene::{Item, Path, Polyline};
use coupler_curves::geometry::{Point, Similarity, Vector, cross, left_normal, trig};
use coupler_curves::linkage::OutputLink;
use coupler_curves::motion::Circuit;

/// The lines of the marks, in the plane of the linkage or on the page.
#[derive(Default)]
pub(super) struct DirectionMarks {
    /// From the crank's pivot in the direction of input 0; none if there is no crank.
    zero: Vec<Point>,
    /// Arcs that end with an arrowhead: from that line in the direction of increasing input, and to both sides of an
    /// output link that swings.
    arrows: Vec<Vec<Point>>,
}

impl DirectionMarks {
    /// The marks of a linkage in its pose, in the plane; `circuit` tells whether its output swings. The arc of the input
    /// has at least a radius, for a short crank is hidden by its joints.
    pub fn new(mechanism: &PosedMechanism, circuit: &Circuit, least_radius: f64) -> DirectionMarks {
        let mut marks = input_marks(mechanism, least_radius).unwrap_or_default();
        marks.arrows.extend(output_arcs(mechanism, circuit).into_iter().flatten());
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
    /// The radius of the arc relative to the crank, and the length of the line relative to the radius.
    const RADIUS: f64 = 0.5;
    const LINE: f64 = 1.3;
    const ARC_DEG: u32 = 66;
    const STEP_DEG: usize = 3;
    let [pivot, _] = mechanism.linkage.crank()?;
    let radius = (RADIUS * mechanism.linkage.crank_length()?).max(least_radius);
    let (zero, turn) = mechanism.input_axes()?;
    let centre = mechanism.pose[pivot];
    let at = |deg: u32| {
        let (cos, sin) = trig::cos_sin_deg(f64::from(deg));
        centre + (zero * cos + turn * sin) * radius
    };
    let arc = (0..=ARC_DEG).step_by(STEP_DEG).map(at).collect();
    Some(DirectionMarks { zero: vec![centre, centre + zero * (LINE * radius)], arrows: vec![arc] })
}

/// Two arcs from the output link to its sides, about its pivot; `None` if it does not swing.
fn output_arcs(mechanism: &PosedMechanism, circuit: &Circuit) -> Option<[Vec<Point>; 2]> {
    /// The radius of the arcs relative to the link.
    const RADIUS: f64 = 0.6;
    const ARC_DEG: i32 = 15;
    let OutputLink::Link([pivot, end]) = mechanism.linkage.output()? else { return None };
    let arm = |k: usize| circuit.positions.point(end, k) - circuit.positions.point(pivot, k);
    let turned: f64 = (1..circuit.len()).map(|k| angle_between(arm(k - 1), arm(k))).sum();
    if turned.abs() > 180.0 && circuit.is_closed {
        return None;
    }
    let (centre, arm) = (mechanism.pose[pivot], mechanism.pose[end] - mechanism.pose[pivot]);
    let at = |deg: i32| {
        let (cos, sin) = trig::cos_sin_deg(f64::from(deg));
        centre + (arm * cos + left_normal(arm) * sin) * RADIUS
    };
    Some([1, -1].map(|side| (0..=ARC_DEG).map(|deg| at(side * deg)).collect()))
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
