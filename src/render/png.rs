use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Transform};

use crate::scene::{Circle, Color, Item, Path, Scene, Segment, Stroke, Text};

/// Why a scene makes no image.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// There are too many pixels, or none.
    #[error("a page of {width} by {height} pixels cannot be held in memory")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The encoder failed.
    #[error("the image cannot be encoded: {0}")]
    Encoding(String),
}

/// A scene as a PNG image of `dpi` pixels to the inch, which the file records.
///
/// # Errors
/// A size that makes no image.
pub fn png(scene: &Scene, dpi: f64) -> Result<Vec<u8>, Error> {
    let scale = dpi / 25.4;
    let pixels = |mm: f64| (mm * scale).round().max(1.0) as u32;
    let (width, height) = (pixels(scene.width), pixels(scene.height));
    let mut pixmap = Pixmap::new(width, height).ok_or(Error::Size { width, height })?;
    let Color(r, g, b) = scene.paper;
    pixmap.fill(tiny_skia::Color::from_rgba8(r, g, b, 255));
    let mut raster = Raster { pixmap, scale: Transform::from_scale(scale as f32, scale as f32) };
    for item in &scene.items {
        raster.item(item);
    }
    encode(&raster.pixmap, dpi)
}

struct Raster {
    pixmap: Pixmap,
    scale: Transform,
}

impl Raster {
    fn item(&mut self, item: &Item) {
        match item {
            Item::Group(group) => group.items.iter().for_each(|item| self.item(item)),
            Item::Path(path) => self.path(path),
            Item::Circle(circle) => self.circle(circle),
            Item::Text(text) => self.text(text),
            Item::Moving(moving) => moving.frames.iter().take(1).flatten().for_each(|item| self.item(item)),
        }
    }

    fn draw(&mut self, path: Option<tiny_skia::Path>, stroke: Option<Stroke>, fill: Option<Color>) {
        let Some(path) = path else { return };
        if let Some(fill) = fill {
            self.pixmap.fill_path(&path, &paint(fill), FillRule::Winding, self.scale, None);
        }
        if let Some(stroke) = stroke {
            let style = tiny_skia::Stroke {
                width: stroke.width as f32,
                line_cap: if stroke.round { LineCap::Round } else { LineCap::Butt },
                line_join: LineJoin::Round,
                ..tiny_skia::Stroke::default()
            };
            self.pixmap.stroke_path(&path, &paint(stroke.color), &style, self.scale, None);
        }
    }

    fn path(&mut self, path: &Path) {
        let mut builder = PathBuilder::new();
        for line in &path.lines {
            for (k, point) in line.points.iter().enumerate() {
                let (x, y) = (point.x as f32, point.y as f32);
                if k == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
            }
            if line.closed {
                builder.close();
            }
        }
        self.draw(builder.finish(), path.stroke, path.fill);
    }

    fn circle(&mut self, circle: &Circle) {
        let (x, y, radius) = (circle.centre.x as f32, circle.centre.y as f32, circle.radius as f32);
        self.draw(PathBuilder::from_circle(x, y, radius), circle.stroke, circle.fill);
    }

    fn text(&mut self, text: &Text) {
        let mut builder = PathBuilder::new();
        let mut at = text.start();
        for run in &text.runs {
            for c in run.text.chars() {
                let place = |[x, y]: [f64; 2]| ((at.x + x * text.size) as f32, (at.y - y * text.size) as f32);
                for segment in run.face.outline(c) {
                    match segment {
                        Segment::Move(p) => builder.move_to(place(p).0, place(p).1),
                        Segment::Line(p) => builder.line_to(place(p).0, place(p).1),
                        Segment::Quad(c, p) => builder.quad_to(place(c).0, place(c).1, place(p).0, place(p).1),
                        Segment::Cubic(c, d, p) => {
                            let ((cx, cy), (dx, dy), (px, py)) = (place(c), place(d), place(p));
                            builder.cubic_to(cx, cy, dx, dy, px, py);
                        }
                        Segment::Close => builder.close(),
                    }
                }
                at.x += run.face.advance(c) * text.size;
            }
        }
        let angle = f32::from(text.quarter_turns) * 90.0;
        let turned = Transform::from_rotate_at(angle, text.at.x as f32, text.at.y as f32);
        let path = builder.finish().and_then(|path| if angle == 0.0 { Some(path) } else { path.transform(turned) });
        self.draw(path, None, Some(text.color));
    }
}

fn paint(Color(r, g, b): Color) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, 255);
    paint
}

fn encode(pixmap: &Pixmap, dpi: f64) -> Result<Vec<u8>, Error> {
    // The paper covers the page, so that every pixel is opaque and premultiplied colours are plain ones.
    let rgb: Vec<u8> = pixmap.data().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let mut out = Vec::new();
    PngEncoder::new_with_quality(&mut out, CompressionType::Default, FilterType::Adaptive)
        .write_image(&rgb, pixmap.width(), pixmap.height(), ExtendedColorType::Rgb8)
        .map_err(|error| Error::Encoding(error.to_string()))?;
    record_resolution(&mut out, dpi);
    Ok(out)
}

/// Puts a `pHYs` chunk after the header, which the encoder cannot write: pixels to the metre, both ways.
fn record_resolution(png: &mut Vec<u8>, dpi: f64) {
    const SIGNATURE_AND_HEADER: usize = 8 + 25;
    let per_metre = ((dpi / 0.0254).round() as u32).to_be_bytes();
    let body = [&b"pHYs"[..], &per_metre, &per_metre, &[1]].concat();
    let chunk = [&9u32.to_be_bytes()[..], &body, &crc32fast::hash(&body).to_be_bytes()].concat();
    png.splice(SIGNATURE_AND_HEADER..SIGNATURE_AND_HEADER, chunk);
}
