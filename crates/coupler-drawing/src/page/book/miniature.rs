//! Small drawings of curves.

use super::super::area::Area;
use super::super::element::Drawing;
use super::super::plot::Plot;
use super::super::rect::Rect;
use super::super::theme::Theme;
use crate::mechanism::Mechanism;
use crate::scene::{Circle, Curve, Item, Path, Polyline};
use coupler_curves::geometry::{Bounds, Point, Spline, Vector};
use coupler_curves::linkage::{JointId, LinkOutline, Linkage};
use coupler_curves::measure::{self, Measure, MeasureKey, TracedCurve};
use coupler_curves::motion::{self, Circuit};
use coupler_curves::path;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// What a small drawing of a curve emphasises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Emphasis {
    /// Nothing.
    None,
    /// The straight portion.
    Straight,
    /// The straight portion to 0.005 of its length.
    Straight5,
    /// The straight portion to 0.01 of its length.
    Straight10,
    /// The circular portion.
    Dwell,
    /// The sharpest point.
    Sharpest,
    /// The axis of symmetry.
    Axis,
    /// The linkage at the limits of its output.
    Limits,
}

/// A small drawing of a curve, in the plane.
#[derive(Clone, Debug)]
pub struct Miniature {
    curve: Vec<Spline>,
    /// The emphasised portion.
    portion: Vec<Point>,
    /// The emphasised point.
    point: Option<Point>,
    axis: Option<[Point; 2]>,
    /// The links in each pose that is drawn, instead of the curve.
    poses: Vec<Vec<Vec<Point>>>,
    pivots: Vec<Point>,
    /// The guides on the frame, of the poses.
    guides: Vec<Vec<Point>>,
    bounds: Bounds,
    /// The input at the sharpest point, in degrees or as a length, if that is emphasised.
    pub sharpest_input: Option<f64>,
    /// How far the curve goes from the circle of its circular portion, if that is emphasised.
    pub dwell_lift: Option<f64>,
}

/// The greatest distance of a spline from its curve relative to the greatest extent of the curve: less than is visible in a
/// drawing of 50 mm.
const TOLERANCE: f64 = 4e-4;

impl Miniature {
    /// The drawing of a curve of a cell.
    pub fn new(solved: &SolvedCell, curve: &MeasuredCurve, emphasis: Emphasis) -> Miniature {
        let circuit = solved.circuit(curve);
        let bounds = Bounds::from_points(circuit.points(curve.joint));
        let extent = bounds.size().max();
        let tolerance = if extent > 0.0 { TOLERANCE * extent } else { 1.0 };
        let splines = path::joint_splines(&solved.linkage, circuit, curve.joint, tolerance);
        let bounds = Bounds::from_points(splines.iter().flat_map(|spline| spline.points())).union(bounds);
        let mut drawing = Miniature {
            curve: splines,
            portion: Vec::new(),
            point: None,
            axis: None,
            poses: Vec::new(),
            pivots: Vec::new(),
            guides: Vec::new(),
            bounds,
            sharpest_input: None,
            dwell_lift: None,
        };
        let number = |key: MeasureKey<f64>| curve.measure(key).filter(|value| value.is_finite());
        let between = |start: MeasureKey<f64>, span: MeasureKey<f64>| {
            let (start, span) = (number(start)?, number(span)?);
            portion(&solved.linkage, circuit, curve.joint, [start, span])
        };
        match emphasis {
            Emphasis::None => {}
            Emphasis::Straight => {
                drawing.portion = curve.straight.as_ref().map(|portion| portion.points.clone()).unwrap_or_default();
            }
            Emphasis::Straight5 => {
                drawing.portion = between(Measure::STRAIGHT_5_START, Measure::STRAIGHT_5_INPUT).unwrap_or_default();
            }
            Emphasis::Straight10 => {
                drawing.portion = between(Measure::STRAIGHT_10_START, Measure::STRAIGHT_10_INPUT).unwrap_or_default();
            }
            Emphasis::Dwell => {
                drawing.portion = between(Measure::DWELL_START, Measure::DWELL_INPUT).unwrap_or_default();
                if let (Some(x), Some(y), Some(radius)) =
                    (number(Measure::DWELL_X), number(Measure::DWELL_Y), number(Measure::DWELL_RADIUS))
                {
                    let distance = |p: Point| ((p - Point::new(x, y)).norm() - radius).abs();
                    drawing.dwell_lift = Some(circuit.points(curve.joint).map(distance).fold(0.0, f64::max));
                }
            }
            Emphasis::Sharpest => {
                let sharpest = sharpest_point(&solved.linkage, circuit, curve.joint);
                drawing.point = sharpest.map(|(_, point)| point);
                drawing.sharpest_input = sharpest.map(|(input, _)| input);
            }
            Emphasis::Axis => {
                let axis = curve.symmetry.as_ref().and_then(|symmetry| symmetry.axis);
                drawing.axis = axis.map(|axis| across(bounds, axis.point, axis.direction));
                // No end is outside the frame, where text may be.
                drawing.bounds = bounds.union(Bounds::from_points(drawing.axis.into_iter().flatten()));
            }
            Emphasis::Limits => drawing.add_limits(solved, curve),
        }
        drawing
    }

    /// Adds the linkage at the limits of its output, which are then drawn instead of the curve.
    fn add_limits(&mut self, solved: &SolvedCell, curve: &MeasuredCurve) {
        let traced = TracedCurve::new(&solved.linkage, &solved.motion, solved.circuit(curve), curve.joint);
        let Some(poses) = measure::output_limit_poses(&traced) else { return };
        let mechanism = Mechanism::new(&solved.linkage, solved.circuit(curve));
        self.bounds = Bounds::EMPTY;
        for pose in poses {
            let corners = |outline: &LinkOutline| {
                let mut corners: Vec<Point> = outline.joints.iter().map(|&joint| pose[joint]).collect();
                let first = corners.first().copied().filter(|_| corners.len() > 2);
                corners.extend(first);
                corners
            };
            let mut links: Vec<Vec<Point>> = mechanism.links.iter().map(corners).collect();
            let slots = mechanism.slots.iter().map(|slot| (pose[slot.foot], slot.ends_in(&pose)));
            links.extend(slots.map(|(foot, [a, b])| vec![foot, a, b]));
            links.extend(mechanism.actuators.iter().map(|ends| ends.map(|joint| pose[joint]).to_vec()));
            self.guides = mechanism.guides.iter().map(|guide| guide.ends.to_vec()).collect();
            self.pivots = mechanism.pivots.iter().map(|&joint| pose[joint]).collect();
            let points = links.iter().chain(&self.guides).flatten().chain(&self.pivots).copied();
            self.bounds = self.bounds.union(Bounds::from_points(points));
            self.poses.push(links);
        }
        self.curve.clear();
    }

    /// The greatest scale at which it fits a frame, in millimetres to a unit.
    pub(super) fn fit_scale(&self, frame: Rect) -> f64 {
        frame.fit_scale(self.bounds)
    }

    /// Draws it at the centre of a frame, at a scale or as large as it fits.
    pub(super) fn draw(&self, area: &impl Area, frame: Rect, scale: Option<f64>, theme: &Theme) {
        let (plot, _) = Plot::whole(frame).at_scale(self.bounds, scale);
        let on_page = |p: Point| plot.page_from_plane.apply(p);
        let line =
            |points: &[Point]| Polyline { points: points.iter().map(|p| on_page(*p)).collect(), is_closed: false };
        let mut items = Vec::new();
        let path = |polylines: Vec<Polyline>, color, width| {
            let stroke = Some(crate::scene::Stroke { color, width, has_round_ends: true });
            Item::Path(Path { polylines, stroke, fill: None })
        };
        if let Some(ends) = &self.axis {
            items.push(path(vec![line(ends)], theme.grey, theme.hair_width));
        }
        let ink = theme.curve_ink(0);
        if self.portion.len() > 1 {
            items.push(path(vec![line(&self.portion)], theme.faded(ink), 4.0 * theme.curve_width));
        }
        if !self.guides.is_empty() {
            items.push(path(self.guides.iter().map(|guide| line(guide)).collect(), theme.grey, theme.hair_width));
        }
        for (links, color) in self.poses.iter().zip([theme.ink, ink]).rev() {
            items.push(path(links.iter().map(|link| line(link)).collect(), color, theme.curve_width));
        }
        if !self.curve.is_empty() {
            let splines = self.curve.iter().map(|spline| spline.map(on_page)).collect();
            let stroke = theme.stroke(theme.ink, theme.fine_width);
            items.push(Item::Curve(Curve { splines, stroke }));
        }
        let circle = |centre: Point, radius: f64, stroke, fill| Item::Circle(Circle { centre, radius, stroke, fill });
        for pivot in &self.pivots {
            let stroke = Some(theme.stroke(theme.ink, theme.fine_width));
            items.push(circle(on_page(*pivot), 0.6 * theme.joint_radius, stroke, Some(theme.paper)));
        }
        if let Some(point) = self.point {
            items.push(circle(
                on_page(point),
                1.2 * theme.joint_radius,
                Some(theme.stroke(ink, theme.curve_width)),
                None,
            ));
        }
        area.record(Drawing { class: "miniature", title: String::new(), items });
    }
}

/// The part of a line in bounds, and a little more.
fn across(bounds: Bounds, through: Point, direction: Vector) -> [Point; 2] {
    /// Of the greater extent of the bounds, how far the line goes beyond them.
    const BEYOND: f64 = 0.06;
    let beyond = BEYOND * bounds.size().max();
    let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
    for k in 0..2 {
        let to = [bounds.min[k] - beyond, bounds.max[k] + beyond].map(|side| (side - through[k]) / direction[k]);
        // Along a side, the line meets none of the two.
        if direction[k] != 0.0 {
            ends = [ends[0].max(to[0].min(to[1])), ends[1].min(to[0].max(to[1]))];
        }
    }
    ends.map(|end| through + direction * end)
}

/// Points of the portion of a curve from an input over a span of it, in degrees; `None` unless the circuit is one pass in
/// which the input turns fully, where an input is one position.
fn portion(linkage: &Linkage, circuit: &Circuit, joint: JointId, [start, span]: [f64; 2]) -> Option<Vec<Point>> {
    const STEP: f64 = 2.0;
    let [pass] = &circuit.passes[..] else { return None };
    if !circuit.is_full_turn() {
        return None;
    }
    let turn = pass.input_length();
    let first = pass.input_range()[0];
    let count = (span / STEP).ceil().clamp(1.0, 720.0);
    let input = |k: usize| first + (start + span * (k as f64 / count) - first).rem_euclid(turn);
    let inputs: Vec<f64> = (0..=count as usize).map(input).collect();
    let positions = motion::poses(linkage, pass, &inputs);
    Some((0..inputs.len()).map(|k| positions.point(joint, k)).collect())
}

/// The input and the position at which a path bends most sharply.
fn sharpest_point(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Option<(f64, Point)> {
    /// Samples of a pass, and of the two intervals around the sharpest of them.
    const COUNTS: [usize; 3] = [720, 64, 64];
    let mut best: Option<(f64, f64, Point)> = None;
    for pass in &circuit.passes {
        let [mut from, mut to] = [pass.from.input.value, pass.to.input.value];
        let (mut found, mut is_whole) = (None, true);
        for count in COUNTS {
            let step = (to - from) / count as f64;
            let inputs: Vec<f64> = (0..=count).map(|k| from + step * k as f64).collect();
            let positions = motion::poses(linkage, pass, &inputs);
            let point = |k: usize| positions.point(joint, k);
            // In a full turn the last sample is the first.
            let is_ring = is_whole && circuit.is_full_turn();
            let sharpness = |k: usize| {
                let (before, after) =
                    if is_ring { ((k + count - 1) % count, k + 1) } else { (k.checked_sub(1)?, k + 1) };
                let (from, to) = (point(k) - point(before), point(after) - point(k));
                let (a, b) = (from.norm(), to.norm());
                // The square of the angle per length, for small angles.
                let sharpness = 2.0 * (1.0 - from.dot(&to) / (a * b)) / ((a + b) * (a + b));
                sharpness.is_finite().then_some((sharpness, k))
            };
            is_whole = false;
            let sharpest = (0..count).filter_map(sharpness);
            let Some((sharpness, k)) = sharpest.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))) else { break };
            found = Some((sharpness, inputs[k], point(k)));
            [from, to] = [inputs[k] - step, inputs[k] + step];
        }
        best = [best, found].into_iter().flatten().reduce(|a, b| if b.0 > a.0 { b } else { a });
    }
    best.map(|(_, input, point)| (input, point))
}
