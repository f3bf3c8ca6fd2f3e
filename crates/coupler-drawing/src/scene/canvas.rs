//! The plotters backend that records a scene.

use std::convert::Infallible;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
    FontTransform,
};

use super::{Anchor, Circle, Color, Face, Item, Path, Polyline, Scene, Stroke, Text, TextRun, Typeface, pixel};
use coupler_curves::geometry::Point;

/// A plotters backend that records a [`Scene`]; its pixel is 1/100 mm.
#[derive(Debug)]
pub struct Canvas<'s> {
    scene: &'s mut Scene,
}

type DrawResult = Result<(), DrawingErrorKind<Infallible>>;

impl<'s> Canvas<'s> {
    /// A canvas that records into a scene.
    pub fn new(scene: &'s mut Scene) -> Canvas<'s> {
        Canvas { scene }
    }

    /// Records an item in full precision, as the elements of this crate do.
    pub fn record(&mut self, item: Item) {
        self.scene.items.push(item);
    }

    /// The scene.
    pub(crate) fn scene(&mut self) -> &mut Scene {
        self.scene
    }

    /// A colour blended with that of the paper, so that the formats need no transparency.
    fn blend(&self, color: BackendColor) -> Color {
        let Color(r, g, b) = self.scene.paper;
        let mix = |over: u8, under: u8| {
            (f64::from(over) * color.alpha + f64::from(under) * (1.0 - color.alpha)).round() as u8
        };
        Color(mix(color.rgb.0, r), mix(color.rgb.1, g), mix(color.rgb.2, b))
    }

    fn to_stroke<S: BackendStyle>(&self, style: &S) -> Stroke {
        Stroke {
            color: self.blend(style.color()),
            width: f64::from(style.stroke_width()) / pixel::PER_MM,
            has_round_ends: false,
        }
    }

    fn record_path<S: BackendStyle>(&mut self, points: Vec<Point>, closed: bool, style: &S, fill: bool) -> DrawResult {
        if style.color().alpha > 0.0 {
            let (stroke, fill) =
                if fill { (None, Some(self.blend(style.color()))) } else { (Some(self.to_stroke(style)), None) };
            self.record(Item::Path(Path { polylines: vec![Polyline { points, is_closed: closed }], stroke, fill }));
        }
        Ok(())
    }
}

impl DrawingBackend for Canvas<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (pixel::from_millimetres(self.scene.width) as u32, pixel::from_millimetres(self.scene.height) as u32)
    }

    fn ensure_prepared(&mut self) -> DrawResult {
        Ok(())
    }

    fn present(&mut self) -> DrawResult {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> DrawResult {
        self.draw_rect(at, (at.0 + 1, at.1 + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> DrawResult {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> DrawResult {
        let corners = [a, (b.0, a.1), b, (a.0, b.1)].map(pixel::to_millimetres);
        self.record_path(corners.to_vec(), true, style, fill)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> DrawResult {
        self.record_path(path.into_iter().map(pixel::to_millimetres).collect(), false, style, false)
    }

    fn draw_circle<S: BackendStyle>(&mut self, centre: BackendCoord, radius: u32, style: &S, fill: bool) -> DrawResult {
        let (stroke, fill) =
            if fill { (None, Some(self.blend(style.color()))) } else { (Some(self.to_stroke(style)), None) };
        let (centre, radius) = (pixel::to_millimetres(centre), f64::from(radius) / pixel::PER_MM);
        self.record(Item::Circle(Circle { centre, radius, stroke, fill }));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> DrawResult {
        self.record_path(path.into_iter().map(pixel::to_millimetres).collect(), true, style, true)
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> DrawResult {
        let (face, size) = (face_for_style(self.scene.typeface, style), style.size() / pixel::PER_MM);
        let (ascent, descent) = face.ascent_and_descent();
        // From the anchor of the line's box down to its baseline.
        let drop = match style.anchor().v_pos {
            VPos::Top => ascent,
            VPos::Center => (ascent - descent) / 2.0,
            VPos::Bottom => -descent,
        } * size;
        let anchor = match style.anchor().h_pos {
            HPos::Left => Anchor::Start,
            HPos::Center => Anchor::Middle,
            HPos::Right => Anchor::End,
        };
        let at = pixel::to_millimetres(at);
        let (quarter_turns, at) = match style.transform() {
            FontTransform::None => (0, Point::new(at.x, at.y + drop)),
            FontTransform::Rotate90 => (1, Point::new(at.x - drop, at.y)),
            FontTransform::Rotate180 => (2, Point::new(at.x, at.y - drop)),
            FontTransform::Rotate270 => (3, Point::new(at.x + drop, at.y)),
        };
        let color = self.blend(style.color());
        let runs = vec![TextRun::new(text, face)];
        self.record(Item::Text(Text { position: at, anchor, size, color, runs, quarter_turns }));
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let face = face_for_style(self.scene.typeface, style);
        let (ascent, descent) = face.ascent_and_descent();
        let (width, height) = (face.width(text, style.size()), (ascent + descent) * style.size());
        Ok((width.ceil() as u32, height.ceil() as u32))
    }
}

fn face_for_style<T: BackendTextStyle>(typeface: Typeface, style: &T) -> Face {
    match style.style() {
        FontStyle::Italic | FontStyle::Oblique => typeface.italic(),
        FontStyle::Normal | FontStyle::Bold => typeface.regular(),
    }
}
