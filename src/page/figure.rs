//! The figure of a cell: its curves, and the linkage that draws them.

use super::arrangement::{Arrangement, Extents, Frame};
use super::element::{Area, CouplerCurve, Drawing, Words, draw};
use super::pose;
use super::theme::Theme;
use super::{Options, Panel, Sheet};
use crate::geometry::{Bounds, Point, Similarity, Vector, cross};
use crate::linkage::{Link, Linkage, Step};
use crate::motion::{self, Dashes};
use crate::scene::{Anchor, Circle, Color, Item, Line, Path, Text};
use crate::sweep::{Curve, Solved};

/// A chord is nowhere further than this from its curve, in millimetres on paper.
const CHORD_ERROR: f64 = 0.01;

/// A cell with the pose its linkage is drawn in.
pub(super) struct Figure<'a> {
    pub panel: &'a Panel<'a>,
    solved: &'a Solved,
    /// The places of all joints.
    pose: Vec<Point>,
    pub extents: Extents,
}

impl<'a> Figure<'a> {
    /// The figure of a cell; `None` where it has no curve.
    pub fn of(panel: &'a Panel<'a>) -> Option<Figure<'a>> {
        let solved = panel.solved;
        let first = solved.curves.first()?;
        let pose = pose::clearest(&solved.linkage, solved.circuit(first));
        let curve = Bounds::of(solved.curves.iter().flat_map(|curve| solved.circuit(curve).points(curve.joint)));
        let drawn = drawn_links(&solved.linkage).concat();
        let key = Bounds::of(drawn.into_iter().map(|joint| pose[joint])).union(curve);
        Some(Figure { panel, solved, pose, extents: Extents { curve, key } })
    }

    /// Draws it in a frame of an area.
    pub fn draw(
        &self,
        area: &Area,
        whole: Frame,
        arrangement: Arrangement,
        sheet: &Sheet,
        (options, theme): (&Options, &Theme),
    ) {
        let [curve, key] = arrangement.frames(whole).map(|frame| Plot::new(frame, theme));
        let period = options.dash_deg;
        // A dash spans three fifths of its period: the first 3 of 5 degrees.
        let dashes = Dashes { period, drawn: 0.6 * period };
        if arrangement == Arrangement::Together {
            let plot = key.of(self.extents.key);
            plot.bar(area, theme);
            self.bodies(area, &plot, theme);
            self.trail(area, &plot, theme.hair, theme);
            self.curves(area, &plot, sheet, dashes, theme);
            self.linkage(area, &plot, theme);
            return;
        }
        let plot = key.of(self.extents.key);
        plot.bar(area, theme);
        self.bodies(area, &plot, theme);
        self.trail(area, &plot, theme.fine, theme);
        self.linkage(area, &plot, theme);
        let plot = curve.of(self.extents.curve);
        plot.bar(area, theme);
        self.trail(area, &plot, theme.hair, theme);
        self.curves(area, &plot, sheet, dashes, theme);
    }

    /// The curves in dashes, each with its coupler point.
    fn curves(&self, area: &Area, plot: &Plot, sheet: &Sheet, dashes: Dashes, theme: &Theme) {
        for curve in &self.solved.curves {
            let ink = self.ink(curve, theme);
            let strokes = self.strokes(curve, plot, dashes);
            let Curve { trace, circuit, .. } = curve;
            let cell = self.solved.cell.number;
            let element = CouplerCurve {
                id: format!("{}-{cell}-{trace}-{circuit}", sheet.family),
                class: "curve",
                title: format!("{}, no. {cell}: {}", sheet.title, self.panel.caption),
                data: vec![("cell", cell.to_string()), ("trace", trace.to_string()), ("circuit", circuit.to_string())],
                strokes,
                weights: [theme.stroke(ink, theme.curve), theme.stroke(theme.faded(ink), theme.fine)],
                marks: self.limits(curve, plot, ink, theme),
            };
            draw(area, &element);
        }
        let points = self.traced_points(plot, theme);
        draw(area, &Drawing { class: "coupler-point", title: String::new(), items: points });
    }

    /// The curves as light unbroken lines: beside the linkage, and under the dashes to lead the eye over their gaps.
    fn trail(&self, area: &Area, plot: &Plot, weight: f64, theme: &Theme) {
        let mut items = Vec::new();
        for curve in &self.solved.curves {
            let whole = Dashes { period: 360.0, drawn: 360.0 };
            let line = |points| Line { points, closed: false };
            let lines = self.strokes(curve, plot, whole).into_iter().map(|stroke| line(stroke.points)).collect();
            let ink = theme.faded(self.ink(curve, theme));
            items.push(Item::Path(Path { lines, stroke: Some(theme.stroke(ink, weight)), fill: None }));
        }
        draw(area, &Drawing { class: "trail", title: String::new(), items });
    }

    fn strokes(&self, curve: &Curve, plot: &Plot, dashes: Dashes) -> Vec<motion::Stroke> {
        let circuit = self.solved.circuit(curve);
        let tolerance = CHORD_ERROR / plot.page_from_plane.scale;
        let strokes = motion::strokes(&self.solved.linkage, circuit, &[curve.joint], dashes, tolerance);
        let on_page = |stroke: motion::Stroke| motion::Stroke {
            points: stroke.points.into_iter().map(|p| plot.page_from_plane.apply(p)).collect(),
            ..stroke
        };
        strokes.into_iter().flatten().map(on_page).collect()
    }

    /// Curves of one traced joint are told apart by circuit, those of several by trace.
    fn ink(&self, curve: &Curve, theme: &Theme) -> Color {
        let one_trace = self.solved.linkage.traced.len() == 1;
        theme.curve_ink(if one_trace { curve.circuit - 1 } else { curve.trace - 1 })
    }

    /// A dot at each limit of the input.
    fn limits(&self, curve: &Curve, plot: &Plot, ink: Color, theme: &Theme) -> Vec<Circle> {
        let circuit = self.solved.circuit(curve);
        let n = circuit.passes.len();
        let turns = |k: usize| circuit.passes[k].heading() != circuit.passes[(k + 1) % n].heading();
        let ends = (0..n).filter(|&k| n > 1 && turns(k) && circuit.passes[k].to.flat.is_some());
        let place = |k: usize| {
            let pass = &circuit.passes[k];
            motion::pose(&self.solved.linkage, pass, pass.to.stop.deg)[curve.joint]
        };
        let dot = |k: usize| Circle {
            centre: plot.page_from_plane.apply(place(k)),
            radius: 0.5 * theme.joint,
            stroke: None,
            fill: Some(ink),
        };
        ends.map(dot).collect()
    }

    fn traced_points(&self, plot: &Plot, theme: &Theme) -> Vec<Item> {
        let mut done = Vec::new();
        let mut items = Vec::new();
        for curve in self.solved.curves.iter().filter(|curve| curve.circuit == self.solved.curves[0].circuit) {
            if !done.contains(&curve.joint) {
                done.push(curve.joint);
                let stroke = Some(theme.stroke(self.ink(curve, theme), theme.fine));
                let centre = plot.page_from_plane.apply(self.pose[curve.joint]);
                items.push(Item::Circle(Circle { centre, radius: theme.joint, stroke, fill: Some(theme.paper) }));
            }
        }
        items
    }

    /// What lies under the curves: the bodies of links that are plates, and the frame as a hairline.
    fn bodies(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let at = |joint: &usize| plot.page_from_plane.apply(self.pose[*joint]);
        let mut items = Vec::new();
        for link in drawn_links(&self.solved.linkage) {
            let points: Vec<Point> = link.iter().map(at).collect();
            if is_plate(&points) {
                let fill = Some(theme.faded(theme.faded(theme.hairline)));
                items.push(Item::Path(Path { lines: vec![Line { points, closed: true }], stroke: None, fill }));
            }
        }
        let points = ground(&self.solved.linkage).iter().map(at).collect();
        items.push(Item::Path(Path::stroked(points, theme.stroke(theme.hairline, theme.hair))));
        draw(area, &Drawing { class: "bodies", title: String::new(), items });
    }

    /// The linkage in ink: links as lines and plates, fixed pivots as double circles.
    fn linkage(&self, area: &Area, plot: &Plot, theme: &Theme) {
        let linkage = &self.solved.linkage;
        let at = |joint: usize| plot.page_from_plane.apply(self.pose[joint]);
        let ground = ground(linkage);
        let mut items = Vec::new();
        let links = drawn_links(linkage);
        for link in &links {
            let points: Vec<Point> = link.iter().map(|&joint| at(joint)).collect();
            let closed = is_plate(&points);
            let stroke = Some(crate::scene::Stroke { round: true, ..theme.stroke(theme.ink, theme.link) });
            items.push(Item::Path(Path { lines: vec![Line { points, closed }], stroke, fill: None }));
        }
        let mut joints: Vec<usize> = links.concat();
        joints.sort_unstable();
        joints.dedup();
        let circle = |centre, radius, color| {
            let stroke = Some(theme.stroke(color, theme.fine));
            Item::Circle(Circle { centre, radius, stroke, fill: Some(theme.paper) })
        };
        for joint in joints {
            let traced = self.solved.curves.iter().find(|curve| curve.joint == joint);
            let color = traced.map_or(theme.ink, |curve| self.ink(curve, theme));
            if ground.contains(&joint) {
                items.push(circle(at(joint), 1.5 * theme.joint, color));
                items.push(circle(at(joint), 0.7 * theme.joint, color));
            } else {
                items.push(circle(at(joint), theme.joint, color));
            }
        }
        draw(area, &Drawing { class: "linkage", title: String::new(), items });
    }
}

/// The joints of the link at rest.
pub(super) fn ground(linkage: &Linkage) -> Vec<usize> {
    linkage.ground().joints.iter().map(|(joint, _)| *joint).collect()
}

/// The moving links as they are drawn, each by its joints in order: along a bar, or round a plate.
pub(super) fn drawn_links(linkage: &Linkage) -> Vec<Vec<usize>> {
    let ground = linkage.ground();
    linkage.links.iter().filter(|link| !std::ptr::eq(*link, ground)).map(|link| outline(linkage, link)).collect()
}

/// The joints of a link round its hull; the points of a grid are left out.
fn outline(linkage: &Linkage, link: &Link) -> Vec<usize> {
    let name = |joint: usize| &linkage.joints[joint].name;
    let is_grid = |joint: usize| {
        let same = |&(other, _): &(usize, Vector)| other != joint && name(other) == name(joint);
        matches!(linkage.joints[joint].step, Step::Rigid { .. }) && link.joints.iter().any(same)
    };
    let joints: Vec<(usize, Vector)> = link.joints.iter().filter(|(joint, _)| !is_grid(*joint)).copied().collect();
    let centre = joints.iter().map(|(_, place)| place).sum::<Vector>() / joints.len().max(1) as f64;
    let points: Vec<Point> = joints.iter().map(|(_, place)| Point::from(*place)).collect();
    let mut order: Vec<usize> = (0..joints.len()).collect();
    if is_flat(&points) {
        let along = points.last().zip(points.first()).map_or(Vector::zeros(), |(b, a)| b - a);
        order.sort_by(|&a, &b| along.dot(&points[a].coords).total_cmp(&along.dot(&points[b].coords)));
    } else {
        let angle = |k: usize| crate::geometry::trig::atan2(joints[k].1.y - centre.y, joints[k].1.x - centre.x);
        order.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    }
    order.into_iter().map(|k| joints[k].0).collect()
}

/// Whether a link is drawn as a plate and not as a bar.
fn is_plate(points: &[Point]) -> bool {
    points.len() > 2 && !is_flat(points)
}

/// Whether points lie on one line, to a thousandth of their extent.
fn is_flat(points: &[Point]) -> bool {
    let size = Bounds::of(points.iter().copied()).size().norm();
    let Some((first, rest)) = points.split_first() else { return true };
    rest.iter().all(|a| rest.iter().all(|b| cross(a - first, b - first).abs() <= 1e-3 * size * size))
}

/// A frame in which something is drawn to scale, and its scale bar.
struct Plot {
    frame: Frame,
    page_from_plane: Similarity,
}

impl Plot {
    fn new(frame: Frame, theme: &Theme) -> Plot {
        let foot = 1.6 * theme.note;
        let inner = Frame { size: Vector::new(frame.size.x, frame.size.y - foot), ..frame };
        Plot {
            frame: inner.inset(2.0 * theme.joint),
            page_from_plane: Similarity::page_from_plane(Bounds::EMPTY, frame.centre(), 1.0),
        }
    }

    /// The plot with something in the middle of its frame.
    fn of(self, bounds: Bounds) -> Plot {
        let scale = self.frame.scale(bounds);
        Plot { page_from_plane: Similarity::page_from_plane(bounds, self.frame.centre(), scale), ..self }
    }

    /// A scale bar under the frame: a round number of units, about a fifth of the frame's width.
    fn bar(&self, area: &Area, theme: &Theme) {
        let scale = self.page_from_plane.scale;
        let units = round_number(0.2 * self.frame.size.x / scale);
        let length = units * scale;
        let label = units.to_string();
        let size = 0.75 * theme.note;
        let at = Point::new(self.frame.centre().x, self.frame.corner.y + self.frame.size.y + 2.2 * theme.joint + size);
        let words = Words::new(&label, Point::origin(), Anchor::Start, size, theme.grey);
        let gap = 0.4 * size;
        let left = at.x - (length + gap + words.text.width()) / 2.0;
        let tick = 0.3 * size;
        let y = at.y - 0.35 * size;
        let line = |a: (f64, f64), b: (f64, f64)| Line {
            points: vec![Point::new(a.0, a.1), Point::new(b.0, b.1)],
            closed: false,
        };
        let lines = vec![
            line((left, y), (left + length, y)),
            line((left, y - tick), (left, y + tick)),
            line((left + length, y - tick), (left + length, y + tick)),
        ];
        let stroke = Some(theme.stroke(theme.grey, theme.hair));
        let bar = Item::Path(Path { lines, stroke, fill: None });
        let text = Item::Text(Text { at: Point::new(left + length + gap, at.y), ..words.text });
        draw(area, &Drawing { class: "scale", title: format!("a bar of {label}"), items: vec![bar, text] });
    }
}

/// The nearest of 1, 2 and 5 with a power of ten, not above `x`; 1 where `x` is none to go by.
fn round_number(x: f64) -> f64 {
    if !(1e-12..=1e12).contains(&x) {
        return 1.0;
    }
    (-12..=12)
        .flat_map(|power: i32| [1, 2, 5].map(|digit| format!("{digit}e{power}").parse().unwrap_or(1.0)))
        .filter(|round: &f64| *round <= x)
        .fold(1e-12, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_are_round() {
        for (x, round) in [(1.0, 1.0), (1.9, 1.0), (0.7, 0.5), (27.0, 20.0), (0.0, 1.0), (f64::NAN, 1.0)] {
            assert_eq!(round_number(x), round);
        }
    }
}
