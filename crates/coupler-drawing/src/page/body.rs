//! A body that a linkage guides: its poses as axes with numbers, and the places of pivots and pins.

use super::area::Area;
use super::element::Drawing;
use super::labels::{LabelPlacer, Obstacles};
use super::plot::Plot;
use super::rect::Rect;
use super::theme::Theme;
use super::{BodyFrame, BodyPlaces, GuidedBody};
use crate::scene::{Anchor, Circle, Color, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Point, Vector, trig};

/// What is drawn of a body on a page.
pub(super) struct BodyDrawing {
    drawings: Vec<Drawing>,
    /// The texts, each with the points that it may be beside, the best first.
    labels: Vec<(Vec<Point>, String)>,
    /// Whether some places are outside the frame, and left out.
    pub has_places_beyond: bool,
}

/// The parts of the length of axes that are tried in turn.
const SHORTER: [f64; 4] = [1.0, 0.8, 0.6, 0.45];
const SHORTEST: f64 = 0.3;

impl BodyDrawing {
    /// The drawing of a body in a plot, as far as it is in its frame.
    pub fn new(body: &GuidedBody, plot: &Plot, theme: &Theme) -> BodyDrawing {
        let frame = plot.rect_above_scale_bar(theme);
        let on_page = |p: &Point| plot.page_from_plane.apply(*p);
        let mut drawings = Vec::new();
        let mut labels = Vec::new();
        let mut has_places_beyond = false;
        for places in &body.places {
            let mut items = Vec::new();
            let lines = places.lines.iter().map(|line| line.iter().map(on_page).collect::<Vec<Point>>());
            let polylines = lines.flat_map(|line| within(&line, &frame)).collect();
            items.push(Item::Path(Path { polylines, stroke: Some(places.stroke(theme)), fill: None }));
            for (at, name) in places.marks.iter().map(|(at, name)| (on_page(at), name)) {
                has_places_beyond |= !frame.contains(&at);
                if frame.contains(&at) {
                    items.push(mark_item(at, places.ink(theme), theme));
                    labels.push((vec![at], name.clone()));
                }
            }
            drawings.push(Drawing { class: "places", title: places.label.clone(), items });
        }
        let (count, step) = (body.poses.len(), body.step());
        let shown = (1..).zip(&body.poses).filter(|(number, _)| (number - 1) % step == 0 || *number == count);
        let shown: Vec<(usize, &BodyFrame)> = shown.collect();
        let of_length = |length: f64| -> Vec<(usize, Axes)> {
            let axes = |pose: &BodyFrame| Axes::new(on_page(&pose.origin), pose.angle_deg, length);
            shown.iter().map(|(number, pose)| (*number, axes(pose))).collect()
        };
        let longest = axis_length(&body.poses, plot.page_from_plane.scale(), theme);
        let fits = |axes: &Vec<(usize, Axes)>| axes.iter().all(|(_, axes)| axes.is_within(&frame));
        // Shorter ones if they would leave the frame, where texts are.
        let mut choices = SHORTER.into_iter().map(|part| of_length(part * longest));
        let axes = choices.find(fits).unwrap_or_else(|| of_length(SHORTEST * longest));
        let items = axes.iter().flat_map(|(_, axes)| axes.items(theme.ink, theme)).collect();
        drawings.push(Drawing { class: "pose", title: "the poses of the body".to_owned(), items });
        let numbered = axes.iter().filter(|(number, _)| is_numbered(*number, count));
        // The numbers of the poses are placed first.
        let numbers = numbered.map(|(number, axes)| (vec![axes.origin, axes.x, axes.y], number.to_string()));
        let labels = numbers.chain(labels.into_iter().filter(|(_, name)| !name.is_empty())).collect();
        BodyDrawing { drawings, labels, has_places_beyond }
    }

    /// Adds what is drawn to the obstacles of labels.
    pub fn add_to(&self, obstacles: &mut Obstacles) {
        self.drawings.iter().for_each(|drawing| obstacles.add(&drawing.items, false));
    }

    /// Draws the axes and the places; the texts are left for [`BodyDrawing::draw_labels`].
    pub fn draw(&mut self, area: &impl Area) {
        let drawn = std::mem::take(&mut self.drawings).into_iter().filter(|drawing| !drawing.items.is_empty());
        drawn.for_each(|drawing| area.record(drawing));
    }

    /// Whether it has no texts.
    pub fn is_empty(&self) -> bool {
        self.labels.is_empty()
    }

    /// Draws the texts that are clear of everything at one of their points.
    pub fn draw_labels(&self, area: &impl Area, placer: &mut LabelPlacer, theme: &Theme) {
        let mut items = Vec::new();
        for (places, text) in &self.labels {
            let line = theme.text_line(text, Point::origin(), Anchor::Middle, theme.note_size, theme.ink);
            items.extend(places.iter().find_map(|at| placer.place_if_clear(*at, line.text.clone())));
        }
        if !items.is_empty() {
            area.record(Drawing { class: "pose-number", title: String::new(), items });
        }
    }
}

impl BodyPlaces {
    fn ink(&self, theme: &Theme) -> Color {
        theme.curve_ink(if self.is_light { 3 } else { 2 })
    }

    /// The stroke of its lines.
    pub(super) fn stroke(&self, theme: &Theme) -> Stroke {
        theme.stroke(self.ink(theme), if self.is_light { theme.hair_width } else { theme.fine_width })
    }
}

/// The axes of a body on a page.
pub(super) struct Axes {
    origin: Point,
    /// The ends of the axes.
    x: Point,
    y: Point,
    /// Along the x-axis and along the y-axis of the body, as long as the x-axis is drawn.
    directions: [Vector; 2],
}

impl Axes {
    /// Axes of a length in millimetres; that of y is shorter, so that the two differ.
    pub fn new(origin: Point, angle_deg: f64, length: f64) -> Axes {
        const OF_Y: f64 = 0.6;
        let (cos, sin) = trig::cos_sin_deg(angle_deg.rem_euclid(360.0));
        // y points down on a page.
        let directions = [Vector::new(cos, -sin) * length, Vector::new(-sin, -cos) * length];
        Axes { origin, x: origin + directions[0], y: origin + directions[1] * OF_Y, directions }
    }

    /// Whether both ends are in a rectangle.
    fn is_within(&self, frame: &Rect) -> bool {
        frame.contains(&self.x) && frame.contains(&self.y)
    }

    /// The axes as lines, that of x with an arrowhead, and the body's point as a dot.
    pub fn items(&self, ink: Color, theme: &Theme) -> Vec<Item> {
        let [along, across] = self.directions;
        let line = |points: Vec<Point>| Polyline { points, is_closed: false };
        let head = [1.0, -1.0].map(|side| self.x - along * 0.22 + across * (0.12 * side));
        let polylines = vec![line(vec![self.y, self.origin, self.x]), line(vec![head[0], self.x, head[1]])];
        vec![
            Item::Path(Path { polylines, stroke: Some(theme.stroke(ink, theme.fine_width)), fill: None }),
            mark_item(self.origin, ink, theme),
        ]
    }
}

/// A place as a dot.
pub(super) fn mark_item(centre: Point, ink: Color, theme: &Theme) -> Item {
    Item::Circle(Circle { centre, radius: 0.45 * theme.joint_radius, stroke: None, fill: Some(ink) })
}

/// The length of the axes in millimetres: less if the poses are near each other.
fn axis_length(poses: &[BodyFrame], scale: f64, theme: &Theme) -> f64 {
    /// In radii of a joint.
    const RANGE: [f64; 2] = [4.0, 9.0];
    /// Of the root mean square distance of the places from their middle.
    const PART: f64 = 0.4;
    let count = poses.len().max(1) as f64;
    let middle = poses.iter().map(|pose| pose.origin.coords / count).sum::<Vector>();
    let square = poses.iter().map(|pose| (pose.origin.coords - middle).norm_squared() / count).sum::<f64>();
    (PART * scale * square.sqrt()).clamp(RANGE[0] * theme.joint_radius, RANGE[1] * theme.joint_radius)
}

/// Whether a pose has its number; of many, the first and the last.
fn is_numbered(number: usize, count: usize) -> bool {
    const MOST: usize = 12;
    count <= MOST || [1, count].contains(&number)
}

/// The parts of a polyline within a rectangle: whole segments, for they are short.
fn within(line: &[Point], frame: &Rect) -> Vec<Polyline> {
    let parts = line.split(|p| !frame.contains(p)).filter(|part| part.len() > 1);
    parts.map(|part| Polyline { points: part.to_vec(), is_closed: false }).collect()
}
