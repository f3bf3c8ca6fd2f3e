use krilla::color::rgb;
use krilla::geom::{self, PathBuilder, Transform};
use krilla::paint::{Fill, LineCap, LineJoin};
use krilla::surface::Surface;

use super::fonts::{Fonts, glyphs};
use crate::scene::{Circle, Color, Line, Path, Run, Scene, Shape, Stroke, Text};
use coupler_curves::geometry::Point;

/// Millimetres to the points of PDF.
pub(super) fn points(mm: f64) -> f32 {
    (mm * POINTS_PER_MM) as f32
}

const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// The units that places are written in, to a millimetre: whole numbers are short and quickly written.
const UNITS_PER_MM: f64 = 1000.0;

/// Draws scenes on a page of a document, whose origin is the upper left corner with y down, as a scene's is.
pub(super) struct Pen<'d> {
    surface: Surface<'d>,
    fonts: &'d mut Fonts,
}

/// A system of coordinates on the page: where its origin is, in millimetres, and how often it is turned by a quarter,
/// clockwise.
#[derive(Clone, Copy)]
struct Frame {
    origin: Point,
    quarter_turns: u8,
}

impl Frame {
    fn at(origin: Point) -> Frame {
        Frame { origin, quarter_turns: 0 }
    }

    fn points_from_units(self) -> Transform {
        let scale = (POINTS_PER_MM / UNITS_PER_MM) as f32;
        let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][usize::from(self.quarter_turns % 4)];
        let [x, y] = [self.origin.x, self.origin.y].map(|mm| points(on_paper(mm)));
        Transform::from_row(scale * cos, scale * sin, -scale * sin, scale * cos, x, y)
    }
}

impl<'d> Pen<'d> {
    pub fn new(surface: Surface<'d>, fonts: &'d mut Fonts) -> Pen<'d> {
        Pen { surface, fonts }
    }

    pub fn finish(self) {
        self.surface.finish();
    }

    /// The paper and all items.
    pub fn scene(&mut self, scene: &Scene) {
        let corners = [(0.0, 0.0), (scene.width, 0.0), (scene.width, scene.height), (0.0, scene.height)];
        let points = corners.map(|(x, y)| Point::new(x, y)).to_vec();
        self.path(&Path { lines: vec![Line { points, closed: true }], stroke: None, fill: Some(scene.paper) });
        for shape in scene.shapes() {
            match shape {
                Shape::Path(path) => self.path(path),
                Shape::Circle(circle) => self.circle(circle),
                Shape::Text(text) => self.text(text),
            }
        }
    }

    fn draw(&mut self, frame: Frame, path: PathBuilder, stroke: Option<Stroke>, color: Option<Color>) {
        let Some(path) = path.finish().filter(|_| stroke.is_some() || color.is_some()) else { return };
        self.surface.set_fill(color.map(fill));
        self.surface.set_stroke(stroke.map(|stroke| krilla::paint::Stroke {
            paint: rgb(stroke.color).into(),
            width: units(stroke.width),
            line_cap: if stroke.round { LineCap::Round } else { LineCap::Butt },
            line_join: LineJoin::Round,
            ..krilla::paint::Stroke::default()
        }));
        self.surface.push_transform(&frame.points_from_units());
        self.surface.draw_path(&path);
        self.surface.pop();
    }

    /// Places are written from a corner of the path, so that they have few digits.
    fn path(&mut self, path: &Path) {
        let points = path.lines.iter().flat_map(|line| &line.points);
        let low = points.fold([f64::INFINITY; 2], |[x, y], p| [x.min(p.x), y.min(p.y)]);
        let frame = Frame::at(Point::from(low.map(|c| on_paper(c).floor())));
        let mut builder = PathBuilder::new();
        for line in &path.lines {
            let mut last = None;
            for point in &line.points {
                let at = place(point, frame.origin);
                match last {
                    None => builder.move_to(at[0], at[1]),
                    Some(last) if last == at => {}
                    Some(_) => builder.line_to(at[0], at[1]),
                }
                last = Some(at);
            }
            if line.closed && last.is_some() {
                builder.close();
            }
        }
        self.draw(frame, builder, path.stroke, path.fill);
    }

    /// Four cubics, which are off a circle by less than 3/10000 of its radius.
    fn circle(&mut self, circle: &Circle) {
        const REACH: f64 = 0.552_284_749_8;
        let (r, k) = (units(circle.radius), units(REACH * circle.radius));
        let mut builder = PathBuilder::new();
        builder.move_to(r, 0.0);
        builder.cubic_to(r, k, k, r, 0.0, r);
        builder.cubic_to(-k, r, -r, k, -r, 0.0);
        builder.cubic_to(-r, -k, -k, -r, 0.0, -r);
        builder.cubic_to(k, -r, r, -k, r, 0.0);
        builder.close();
        self.draw(Frame::at(circle.centre), builder, circle.stroke, circle.fill);
    }

    fn text(&mut self, text: &Text) {
        let page = Frame::at(Point::origin());
        let frame =
            if text.quarter_turns == 0 { page } else { Frame { origin: text.at, quarter_turns: text.quarter_turns } };
        let mut at = text.start();
        self.surface.set_fill(Some(fill(text.color)));
        self.surface.set_stroke(None);
        self.surface.push_transform(&frame.points_from_units());
        for Run { text: words, face } in &text.runs {
            let [x, y] = place(&at, frame.origin);
            if let Some(font) = self.fonts.get(*face) {
                let (start, size) = (geom::Point::from_xy(x, y), units(text.size));
                self.surface.draw_glyphs(start, &glyphs(words, *face), font, words, size, false);
            }
            at.x += face.width(words, text.size);
        }
        self.surface.pop();
    }
}

/// A place in units from an origin, which are whole.
fn place(point: &Point, origin: Point) -> [f32; 2] {
    [units(point.x - origin.x), units(point.y - origin.y)]
}

/// Millimetres in whole units.
fn units(mm: f64) -> f32 {
    (on_paper(mm) * UNITS_PER_MM).round() as f32
}

/// A length that can be written: what is no number is 0, and what is beyond all paper stays just there.
fn on_paper(mm: f64) -> f64 {
    const BEYOND: f64 = 1e5;
    if mm.is_nan() { 0.0 } else { mm.clamp(-BEYOND, BEYOND) }
}

fn fill(color: Color) -> Fill {
    Fill { paint: rgb(color).into(), ..Fill::default() }
}

fn rgb(Color(r, g, b): Color) -> rgb::Color {
    rgb::Color::new(r, g, b)
}
