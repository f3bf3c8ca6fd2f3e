//! The PNG format.

mod encoder;

use tiny_skia::{FillRule, IntSize, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Transform};

use crate::scene::{Circle, Color, Curve, OutlineSegment, Path, Scene, Shape, Stroke, Text};
use coupler_curves::geometry::{Point, Spline, SplineSegment};
use encoder::Encoder;

/// An error of rendering a scene to PNG.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The image has too many pixels, or none.
    #[error("an image of {width} by {height} pixels does not fit in memory")]
    InvalidSize {
        /// The width in pixels.
        width: u32,
        /// The height in pixels.
        height: u32,
    },
    /// The encoder failed.
    #[error("failed to encode the image: {0}")]
    Encoding(String),
}

/// The size of the strips a page is drawn in, about, in bytes. A strip fits the processor's caches, while a tabloid
/// page at 300 dpi would need 67 million bytes.
const STRIP_BYTES: usize = 1 << 22;

/// Renders a scene to a PNG image of `dpi` pixels per inch, which the file records.
///
/// # Errors
/// If the image has too many pixels or cannot be encoded.
pub fn png(scene: &Scene, dpi: f64) -> Result<Vec<u8>, Error> {
    let scale = dpi / 25.4;
    let pixels = |mm: f64| (mm * scale).round().max(1.0) as u32;
    let (width, height) = (pixels(scene.width), pixels(scene.height));
    let too_large = Error::InvalidSize { width, height };
    let pixels = (width as usize).checked_mul(height as usize);
    pixels.filter(|pixels| *pixels <= isize::MAX as usize / 3).ok_or(too_large.clone())?;
    let failure = |error: png::EncodingError| Error::Encoding(error.to_string());
    let rows = (STRIP_BYTES / (4 * width as usize)).clamp(1, height as usize) as u32;
    let shapes = scene.shapes();
    let Color(r, g, b) = scene.paper;
    let paper = [r, g, b, 255];
    let mut encoder = Encoder::new((width, height), dpi, paper);
    for top in (0..height).step_by(rows as usize) {
        let blank = blank_pixmap(paper, (width, rows.min(height - top)));
        let mut strip = Strip { pixmap: blank.ok_or(too_large.clone())?, scale, top_row: top };
        shapes.iter().for_each(|shape| strip.draw_shape(*shape));
        // The paper makes every pixel opaque, so premultiplied colours equal plain ones.
        encoder.push_rows(strip.pixmap.data()).map_err(|error| failure(error.into()))?;
    }
    encoder.finish().map_err(failure)
}

/// A pixmap filled with one colour; `None` if it would be empty.
fn blank_pixmap(color: [u8; 4], (width, height): (u32, u32)) -> Option<Pixmap> {
    let pixels = vec![color; width as usize * height as usize];
    Pixmap::from_vec(pixels.into_flattened(), IntSize::from_wh(width, height)?)
}

/// A strip of a page.
struct Strip {
    pixmap: Pixmap,
    /// Pixels per millimetre.
    scale: f64,
    /// The row of the page that is the first of the strip.
    top_row: u32,
}

impl Strip {
    fn draw_shape(&mut self, shape: Shape) {
        match shape {
            Shape::Path(path) => self.draw_path(path),
            Shape::Curve(curve) => self.draw_curve(curve),
            Shape::Circle(circle) => self.draw_circle(circle),
            Shape::Text(text) => self.draw_text(text),
        }
    }

    /// The transform from millimetres of the page to pixels of the strip.
    fn strip_from_page(&self) -> Transform {
        Transform::from_row(self.scale as f32, 0.0, 0.0, self.scale as f32, 0.0, -(self.top_row as f32))
    }

    /// Whether shapes from `high` to `low`, in millimetres from the top of the page, may touch the strip.
    fn is_visible(&self, high: f64, low: f64) -> bool {
        // Anti-aliasing adds half a pixel, and the thinnest line is a pixel wide.
        const MARGIN: f64 = 2.0;
        let (top, bottom) = (f64::from(self.top_row), f64::from(self.top_row + self.pixmap.height()));
        low * self.scale >= top - MARGIN && high * self.scale <= bottom + MARGIN
    }

    fn paint_path(&mut self, path: Option<tiny_skia::Path>, stroke: Option<Stroke>, fill: Option<Color>) {
        let Some(path) = path else { return };
        let transform = self.strip_from_page();
        if let Some(fill) = fill {
            self.pixmap.fill_path(&path, &paint(fill), FillRule::Winding, transform, None);
        }
        if let Some(stroke) = stroke {
            let style = tiny_skia::Stroke {
                width: stroke.width as f32,
                line_cap: if stroke.has_round_ends { LineCap::Round } else { LineCap::Butt },
                line_join: LineJoin::Round,
                ..tiny_skia::Stroke::default()
            };
            self.pixmap.stroke_path(&path, &paint(stroke.color), &style, transform, None);
        }
    }

    fn draw_path(&mut self, path: &Path) {
        let heights = || path.polylines.iter().flat_map(|line| &line.points).map(|point| point.y);
        let (high, low) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
        let width = path.stroke.map_or(0.0, |stroke| stroke.width);
        if !self.is_visible(high - width, low + width) {
            return;
        }
        let mut builder = PathBuilder::new();
        for line in &path.polylines {
            for (k, point) in line.points.iter().enumerate() {
                let (x, y) = (point.x as f32, point.y as f32);
                if k == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
            }
            if line.is_closed {
                builder.close();
            }
        }
        self.paint_path(builder.finish(), path.stroke, path.fill);
    }

    fn draw_curve(&mut self, curve: &Curve) {
        let heights = || curve.splines.iter().flat_map(Spline::points).map(|point| point.y);
        let (high, low) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
        if !self.is_visible(high - curve.stroke.width, low + curve.stroke.width) {
            return;
        }
        let mut builder = PathBuilder::new();
        let place = |point: Point| (point.x as f32, point.y as f32);
        for spline in &curve.splines {
            let (x, y) = place(spline.start);
            builder.move_to(x, y);
            for segment in &spline.segments {
                match segment {
                    SplineSegment::Line(end) => {
                        let (x, y) = place(*end);
                        builder.line_to(x, y);
                    }
                    SplineSegment::Cubic(points) => {
                        let [(bx, by), (cx, cy), (dx, dy)] = points.map(place);
                        builder.cubic_to(bx, by, cx, cy, dx, dy);
                    }
                }
            }
        }
        self.paint_path(builder.finish(), Some(curve.stroke), None);
    }

    fn draw_circle(&mut self, circle: &Circle) {
        let reach = circle.radius + circle.stroke.map_or(0.0, |stroke| stroke.width);
        if !self.is_visible(circle.centre.y - reach, circle.centre.y + reach) {
            return;
        }
        let (x, y, radius) = (circle.centre.x as f32, circle.centre.y as f32, circle.radius as f32);
        self.paint_path(PathBuilder::from_circle(x, y, radius), circle.stroke, circle.fill);
    }

    fn draw_text(&mut self, text: &Text) {
        // Letters are less than two ems high; rotated text is always drawn.
        if text.quarter_turns == 0
            && !self.is_visible(text.position.y - 2.0 * text.size, text.position.y + 2.0 * text.size)
        {
            return;
        }
        let mut builder = PathBuilder::new();
        for run in text.glyph_runs() {
            let size = run.size;
            for (at, outline) in run.outlines() {
                let place = |[x, y]: [f64; 2]| ((at.x + x * size) as f32, (at.y - y * size) as f32);
                for segment in outline.iter().copied() {
                    match segment {
                        OutlineSegment::Move(p) => builder.move_to(place(p).0, place(p).1),
                        OutlineSegment::Line(p) => builder.line_to(place(p).0, place(p).1),
                        OutlineSegment::Quad(c, p) => builder.quad_to(place(c).0, place(c).1, place(p).0, place(p).1),
                        OutlineSegment::Cubic(c, d, p) => {
                            let ((cx, cy), (dx, dy), (px, py)) = (place(c), place(d), place(p));
                            builder.cubic_to(cx, cy, dx, dy, px, py);
                        }
                        OutlineSegment::Close => builder.close(),
                    }
                }
            }
        }
        let angle = f32::from(text.quarter_turns) * 90.0;
        let turned = Transform::from_rotate_at(angle, text.position.x as f32, text.position.y as f32);
        let path = builder.finish().and_then(|path| if angle == 0.0 { Some(path) } else { path.transform(turned) });
        self.paint_path(path, None, Some(text.color));
    }
}

fn paint(Color(r, g, b): Color) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, 255);
    paint
}
