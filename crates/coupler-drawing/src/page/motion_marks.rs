//! Marks of the motion along a curve: its start with an arrowhead, and ticks at equal steps of the input.

use super::element::Drawing;
use super::labels::LabelPlacer;
use super::plot::Plot;
use super::theme::Theme;
use crate::scene::{Anchor, Color, Item, Path, Polyline};

use coupler_curves::geometry::{Point, Vector, left_normal};
use coupler_curves::linkage::{Input, JointId, Linkage};
use coupler_curves::motion::{self, Circuit, JointPositions};
use coupler_curves::text::{format_exactly, round_to_six_digits};

/// The input from a tick to the next, and from a number at a tick to the next, in degrees or as lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TickSteps {
    pub tick: f64,
    number: f64,
}

impl TickSteps {
    /// The steps for a linkage: a twelfth and a quarter of a turn; for the length of an actuator five dashes with their
    /// gaps, of which the greatest range has at least twenty.
    pub fn new(linkage: &Linkage, dash_period: f64) -> TickSteps {
        match linkage.input() {
            Input::Length => {
                let tick = round_to_six_digits(5.0 * dash_period);
                TickSteps { tick, number: tick }
            }
            _ => TickSteps { tick: 30.0, number: 90.0 },
        }
    }
}

/// A point of a curve at an input, with the direction of the motion as the input increases or decreases along the
/// circuit.
struct Station {
    input: f64,
    at: Point,
    direction: Vector,
}

/// The marks of a curve on the page.
pub(super) struct MotionMarks {
    /// The lines of the ticks, and the arrowhead.
    pub items: Vec<Item>,
    /// The numbers of some ticks, with their points on the page.
    numbers: Vec<(Point, String)>,
}

impl MotionMarks {
    /// The marks of the curve of a joint on a circuit.
    ///
    /// Ticks closer together than they are long are left out.
    pub fn new(poses: &TickPoses, joint: JointId, plot: &Plot, ink: Color, theme: &Theme) -> MotionMarks {
        let mut marks = MotionMarks { items: Vec::new(), numbers: Vec::new() };
        let stations = poses.stations(joint, plot);
        if let Some(start) = stations.first() {
            marks.items.push(start_item(start.at, start.direction, ink, theme));
        }
        let mut last = stations.first().map(|start| start.at);
        for station in stations.iter().skip(1) {
            let is_far = |other: Point| (station.at - other).norm() >= 2.0 * tick_length(theme);
            if !last.is_none_or(is_far) || !stations.first().is_none_or(|start| is_far(start.at)) {
                continue;
            }
            last = Some(station.at);
            marks.items.push(tick_item(station.at, station.direction, ink, theme));
            if let Some(number) = poses.number_at(station.input) {
                // A path that is traversed twice at the same inputs has each number once.
                let is_like = |(at, known): &(Point, String)| *known == number && (at - station.at).norm() < 0.01;
                if !marks.numbers.iter().any(is_like) {
                    marks.numbers.push((station.at, number));
                }
            }
        }
        marks
    }

    /// The numbers, where they are clear of everything.
    pub fn place_numbers(all: Vec<MotionMarks>, placer: &mut LabelPlacer, theme: &Theme) -> Drawing {
        let line =
            |number: &str| theme.text_line(number, Point::origin(), Anchor::Middle, theme.small_size(), theme.grey);
        let numbers = all.iter().flat_map(|marks| &marks.numbers);
        let items = numbers.filter_map(|(at, number)| placer.place_if_clear(*at, line(number).text)).collect();
        Drawing { class: "input", title: String::new(), items }
    }
}

/// The poses of a circuit at its start and at its ticks, in its order; those of one pass are computed together.
pub(super) struct TickPoses {
    steps: TickSteps,
    is_angle: bool,
    /// The inputs of each pass, and the positions of all joints: just before, at and just after each.
    passes: Vec<(Vec<f64>, JointPositions)>,
    /// The positions of all joints well after the start: one that stands still there moves off in its direction.
    after_start: JointPositions,
}

impl TickPoses {
    /// The poses of a circuit.
    pub fn new(linkage: &Linkage, circuit: &Circuit, steps: TickSteps) -> TickPoses {
        /// The part of a step over which the direction of the motion is taken: a chord of less than 0.01 mm on paper.
        const PART: f64 = 1.0 / 3000.0;
        /// The part of a step after the start.
        const AFTER_START: f64 = 1.0 / 60.0;
        let mut passes = Vec::new();
        for (k, pass) in circuit.passes.iter().enumerate() {
            let (from, to) = (pass.from.input.value, pass.to.input.value);
            let step = PART * if to >= from { steps.tick } else { -steps.tick };
            let [low, high] = pass.input_range();
            let mut inputs = ticks_between(low, high, steps.tick);
            if to < from {
                inputs.reverse();
            }
            if k == 0 && inputs.first() != Some(&from) {
                inputs.insert(0, from);
            }
            // The end of a full turn is its start.
            inputs.retain(|input| !circuit.is_closed || *input != to || (k == 0 && *input == from));
            let around = |input: &f64| [-0.5, 0.0, 0.5].map(|part| (input + part * step).clamp(low, high));
            let positions = motion::poses(linkage, pass, &inputs.iter().flat_map(around).collect::<Vec<f64>>());
            passes.push((inputs, positions));
        }
        let first = &circuit.passes[0];
        let (from, to) = (first.from.input.value, first.to.input.value);
        let step = AFTER_START * if to >= from { steps.tick } else { -steps.tick };
        let after_start = motion::poses(linkage, first, &[from + step.clamp(-(to - from).abs(), (to - from).abs())]);
        TickPoses { steps, is_angle: linkage.input() != Input::Length, passes, after_start }
    }

    /// The number at a tick, if it has one.
    fn number_at(&self, input: f64) -> Option<String> {
        let input = if self.is_angle { input } else { round_to_six_digits(input) };
        let count = input / self.steps.number;
        ((count - count.round()).abs() < 1e-9).then(|| format_exactly(input))
    }

    /// The points of the curve of a joint at the inputs.
    fn stations(&self, joint: JointId, plot: &Plot) -> Vec<Station> {
        let of_pass = |(inputs, positions): &(Vec<f64>, JointPositions)| {
            let at = |k: usize| plot.page_from_plane.apply(positions.point(joint, k));
            let station = |(k, input): (usize, &f64)| {
                let [before, here, after] = [3 * k, 3 * k + 1, 3 * k + 2].map(at);
                // Where the point turns back, what it does before says nothing.
                let (chord, ahead) = (after - before, after - here);
                let direction = if 2.0 * chord.norm() < ahead.norm() { ahead } else { chord };
                Station { input: *input, at: here, direction }
            };
            inputs.iter().enumerate().map(station).collect::<Vec<_>>()
        };
        let is_defined = |station: &Station| station.at.x.is_finite() && station.at.y.is_finite();
        let mut stations: Vec<Station> = self.passes.iter().flat_map(of_pass).filter(is_defined).collect();
        if let Some(start) = stations.first_mut() {
            let off = plot.page_from_plane.apply(self.after_start.point(joint, 0)) - start.at;
            // Of a motion that begins with a higher power of the input than the second, only rounding is seen so near.
            if start.direction.norm() < RESOLVED * off.norm() {
                start.direction = off;
            }
        }
        stations
    }
}

/// The part of the way well after the start from which a direction near it is more than rounding.
const RESOLVED: f64 = 1e-5;

/// The multiples of a step from `low` to `high`, of which there are at most a thousand.
fn ticks_between(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step).ceil();
    let count = ((high / step).floor() - first + 1.0).clamp(0.0, 1000.0) as usize;
    (0..count).map(|k| (first + k as f64) * step).collect()
}

/// The length of a tick in millimetres.
fn tick_length(theme: &Theme) -> f64 {
    1.3 * theme.joint_radius
}

/// A tick across a curve that runs in a direction.
pub(super) fn tick_item(at: Point, direction: Vector, ink: Color, theme: &Theme) -> Item {
    let half = left_normal(direction).try_normalize(0.0).unwrap_or(Vector::new(0.0, 1.0)) * (0.5 * tick_length(theme));
    Item::Path(Path::stroked(vec![at - half, at + half], theme.stroke(ink, theme.fine_width)))
}

/// The mark of the start of a curve: a filled triangle that points in the direction of the motion.
pub(super) fn start_item(at: Point, direction: Vector, ink: Color, theme: &Theme) -> Item {
    let along = direction.try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0)) * (1.1 * theme.joint_radius);
    let across = left_normal(along) * 0.75;
    let points = vec![at + along * 1.2, at - along * 0.8 + across, at - along * 0.8 - across];
    let stroke = Some(theme.stroke(theme.paper, theme.hair_width));
    Item::Path(Path { polylines: vec![Polyline { points, is_closed: true }], stroke, fill: Some(ink) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::rect::Rect;
    use coupler_curves::catalogue;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::geometry::Bounds;
    use coupler_curves::solve::Solver;

    /// Also of a ram that moves with the fourth power of the input at first.
    #[test]
    fn arrows_at_the_start_point_to_where_the_point_goes() {
        let press = (catalogue::find("toggle-press").unwrap(), vec![("r".to_owned(), 0.9)]);
        let defaults = catalogue::all().iter().map(|template| (template.clone(), Vec::new()));
        for (template, values) in defaults.chain([press]) {
            let id = template.id.clone();
            let Ok(family) = Family::single_cell(template, &values, Sampling::Samples(72)) else { continue };
            let Some(solved) = Solver::new(&family).solve(0) else { continue };
            for curve in &solved.curves {
                let circuit = solved.circuit(curve);
                let pass = &circuit.passes[0];
                let (from, to) = (pass.from.input.value, pass.to.input.value);
                let later = motion::poses(&solved.linkage, pass, &[from, from + 0.005 * (to - from)]);
                let [start, later] = [0, 1].map(|k| later.point(curve.joint, k));
                let bounds = Bounds::from_points(circuit.points(curve.joint));
                if (later - start).norm() < 1e-9 * bounds.size().max() {
                    continue;
                }
                let plot = Plot::whole(Rect { corner: Point::origin(), size: Vector::repeat(100.0) }).fitted_to(bounds);
                let poses = TickPoses::new(&solved.linkage, circuit, TickSteps::new(&solved.linkage, 5.0));
                let station = &poses.stations(curve.joint, &plot)[0];
                let on_page = plot.page_from_plane.apply(later) - plot.page_from_plane.apply(start);
                let cosine = on_page.normalize().dot(&station.direction.normalize());
                assert!(cosine > 0.5, "{id}, joint {:?}, circuit {}: {cosine}", curve.joint, curve.circuit);
            }
        }
    }
}
