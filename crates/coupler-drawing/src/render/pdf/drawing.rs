//! Drawing of scenes on the pages of a document.

use krilla::color::rgb;
use krilla::geom::{self, PathBuilder, Transform};
use krilla::paint::{Fill, LineCap, LineJoin};
use krilla::surface::Surface;

use super::fonts::{FontCache, layout_glyphs};
use crate::scene::{Circle, Color, Curve, Path, Polyline, Scene, Shape, Stroke, Text};
use coupler_curves::geometry::{Point, Spline, SplineSegment};

/// A length in PDF points.
pub(super) fn mm_to_points(mm: f64) -> f32 {
    (mm * POINTS_PER_MM) as f32
}

const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// The units of coordinates per millimetre. Coordinates are whole numbers, which are short and quick to write.
const UNITS_PER_MM: f64 = 1000.0;

/// Draws scenes on a page of a document, whose origin is the upper left corner with y down, as that of a scene.
pub(super) struct PagePainter<'d> {
    surface: Surface<'d>,
    fonts: &'d mut FontCache,
}

/// A coordinate frame on the page: its origin in millimetres, and its rotation in quarter turns clockwise.
#[derive(Clone, Copy)]
struct CoordinateFrame {
    origin: Point,
    quarter_turns: u8,
}

impl CoordinateFrame {
    fn upright(origin: Point) -> CoordinateFrame {
        CoordinateFrame { origin, quarter_turns: 0 }
    }

    /// The frame whose origin is in the upper left of some points, at a whole millimetre, so that they have few digits.
    fn at_corner(points: impl Iterator<Item = Point>) -> CoordinateFrame {
        let corner = points.fold([f64::INFINITY; 2], |[x, y], p| [x.min(p.x), y.min(p.y)]);
        CoordinateFrame::upright(Point::from(corner.map(|c| clamp_length(c).floor())))
    }

    fn points_from_units(self) -> Transform {
        let scale = (POINTS_PER_MM / UNITS_PER_MM) as f32;
        let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][usize::from(self.quarter_turns % 4)];
        let [x, y] = [self.origin.x, self.origin.y].map(|mm| mm_to_points(clamp_length(mm)));
        Transform::from_row(scale * cos, scale * sin, -scale * sin, scale * cos, x, y)
    }
}

impl<'d> PagePainter<'d> {
    pub fn new(surface: Surface<'d>, fonts: &'d mut FontCache) -> PagePainter<'d> {
        PagePainter { surface, fonts }
    }

    pub fn finish(self) {
        self.surface.finish();
    }

    /// Draws the paper and all items.
    pub fn draw_scene(&mut self, scene: &Scene) {
        let corners = [(0.0, 0.0), (scene.width, 0.0), (scene.width, scene.height), (0.0, scene.height)];
        let points = corners.map(|(x, y)| Point::new(x, y)).to_vec();
        self.draw_path(&Path {
            polylines: vec![Polyline { points, is_closed: true }],
            stroke: None,
            fill: Some(scene.paper),
        });
        for shape in scene.shapes() {
            match shape {
                Shape::Path(path) => self.draw_path(path),
                Shape::Curve(curve) => self.draw_curve(curve),
                Shape::Circle(circle) => self.draw_circle(circle),
                Shape::Text(text) => self.draw_text(text),
            }
        }
    }

    fn paint_path(&mut self, frame: CoordinateFrame, path: PathBuilder, stroke: Option<Stroke>, color: Option<Color>) {
        let Some(path) = path.finish().filter(|_| stroke.is_some() || color.is_some()) else { return };
        self.surface.set_fill(color.map(to_fill));
        self.surface.set_stroke(stroke.map(|stroke| krilla::paint::Stroke {
            paint: to_rgb(stroke.color).into(),
            width: mm_to_units(stroke.width),
            line_cap: if stroke.has_round_ends { LineCap::Round } else { LineCap::Butt },
            line_join: LineJoin::Round,
            ..krilla::paint::Stroke::default()
        }));
        self.surface.push_transform(&frame.points_from_units());
        self.surface.draw_path(&path);
        self.surface.pop();
    }

    /// Draws a path.
    fn draw_path(&mut self, path: &Path) {
        let frame = CoordinateFrame::at_corner(path.polylines.iter().flat_map(|line| &line.points).copied());
        let mut builder = PathBuilder::new();
        for line in &path.polylines {
            let mut last = None;
            for point in &line.points {
                let at = point_in_units(point, frame.origin);
                match last {
                    None => builder.move_to(at[0], at[1]),
                    Some(last) if last == at => {}
                    Some(_) => builder.line_to(at[0], at[1]),
                }
                last = Some(at);
            }
            if line.is_closed && last.is_some() {
                builder.close();
            }
        }
        self.paint_path(frame, builder, path.stroke, path.fill);
    }

    /// Draws splines.
    fn draw_curve(&mut self, curve: &Curve) {
        let frame = CoordinateFrame::at_corner(curve.splines.iter().flat_map(Spline::points));
        let mut builder = PathBuilder::new();
        for spline in &curve.splines {
            let [x, y] = point_in_units(&spline.start, frame.origin);
            builder.move_to(x, y);
            for segment in &spline.segments {
                match segment {
                    SplineSegment::Line(end) => {
                        let [x, y] = point_in_units(end, frame.origin);
                        builder.line_to(x, y);
                    }
                    SplineSegment::Cubic(points) => {
                        let [[bx, by], [cx, cy], [dx, dy]] = points.map(|point| point_in_units(&point, frame.origin));
                        builder.cubic_to(bx, by, cx, cy, dx, dy);
                    }
                }
            }
        }
        self.paint_path(frame, builder, Some(curve.stroke), None);
    }

    /// Draws a circle as four cubics, which deviate from it by less than 3/10000 of the radius.
    fn draw_circle(&mut self, circle: &Circle) {
        const CONTROL_RATIO: f64 = 0.552_284_749_8;
        let (r, k) = (mm_to_units(circle.radius), mm_to_units(CONTROL_RATIO * circle.radius));
        let mut builder = PathBuilder::new();
        builder.move_to(r, 0.0);
        builder.cubic_to(r, k, k, r, 0.0, r);
        builder.cubic_to(-k, r, -r, k, -r, 0.0);
        builder.cubic_to(-r, -k, -k, -r, 0.0, -r);
        builder.cubic_to(k, -r, r, -k, r, 0.0);
        builder.close();
        self.paint_path(CoordinateFrame::upright(circle.centre), builder, circle.stroke, circle.fill);
    }

    fn draw_text(&mut self, text: &Text) {
        let page = CoordinateFrame::upright(Point::origin());
        let frame = if text.quarter_turns == 0 {
            page
        } else {
            CoordinateFrame { origin: text.position, quarter_turns: text.quarter_turns }
        };
        self.surface.set_fill(Some(to_fill(text.color)));
        self.surface.set_stroke(None);
        self.surface.push_transform(&frame.points_from_units());
        for run in text.glyph_runs() {
            let [x, y] = point_in_units(&run.origin, frame.origin);
            if let Some(font) = self.fonts.get(&run) {
                let (start, size) = (geom::Point::from_xy(x, y), mm_to_units(run.size));
                self.surface.draw_glyphs(start, &layout_glyphs(&run), font, run.text, size, false);
            }
        }
        self.surface.pop();
    }
}

/// A point in whole units from an origin.
fn point_in_units(point: &Point, origin: Point) -> [f32; 2] {
    [mm_to_units(point.x - origin.x), mm_to_units(point.y - origin.y)]
}

/// A length in whole units.
fn mm_to_units(mm: f64) -> f32 {
    (clamp_length(mm) * UNITS_PER_MM).round() as f32
}

/// A length limited to what can be written: NaN becomes 0, and a length beyond any paper becomes 100 m.
fn clamp_length(mm: f64) -> f64 {
    const LIMIT: f64 = 1e5;
    if mm.is_nan() { 0.0 } else { mm.clamp(-LIMIT, LIMIT) }
}

fn to_fill(color: Color) -> Fill {
    Fill { paint: to_rgb(color).into(), ..Fill::default() }
}

fn to_rgb(Color(r, g, b): Color) -> rgb::Color {
    rgb::Color::new(r, g, b)
}
