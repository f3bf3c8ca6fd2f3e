//! Elements of our own for plotters: they are placed by a drawing area, and keep full precision inside it.

use std::iter::once;

use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingErrorKind};

use crate::scene::{
    Anchor, Animation, Canvas, Circle, Color, Face, Group, Item, Path, Polyline, Stroke, Text, TextRun, Typeface,
};
use coupler_curves::geometry::{Point, Similarity, Vector};
use coupler_curves::motion::{self, DashPattern};

/// A part of the page: its lengths are in 1/100 mm, its origin the upper left corner.
pub(super) type Area<'s> = DrawingArea<Canvas<'s>, Shift>;

/// Draws an element at the origin of an area.
pub(super) fn draw<'a, E>(area: &Area, element: &'a E)
where
    &'a E: PointCollection<'a, BackendCoord>,
    E: for<'s> Drawable<Canvas<'s>>,
{
    // A canvas cannot fail, and an area is never drawn on from within an element.
    area.draw(element).expect("recording a scene does not fail");
}

/// Width and height of an area in millimetres.
pub(super) fn size(area: &Area) -> Vector {
    let (width, height) = area.dim_in_pixel();
    Canvas::to_millimetres((width as i32, height as i32)).coords
}

/// An element whose geometry is in millimetres from the origin of the area it is drawn on.
macro_rules! anchored_at_origin {
    ($element:ty) => {
        impl<'a> PointCollection<'a, BackendCoord> for &'a $element {
            type Point = BackendCoord;
            type IntoIter = std::iter::Once<BackendCoord>;

            fn point_iter(self) -> Self::IntoIter {
                once((0, 0))
            }
        }

        impl<'s> Drawable<Canvas<'s>> for $element {
            fn draw<I: Iterator<Item = BackendCoord>>(
                &self,
                mut origin: I,
                canvas: &mut Canvas<'s>,
                _: (u32, u32),
            ) -> Result<(), DrawingErrorKind<std::convert::Infallible>> {
                if let Some(origin) = origin.next() {
                    canvas.record(self.to_item(Canvas::to_millimetres(origin).coords));
                }
                Ok(())
            }
        }
    };
}

anchored_at_origin!(CouplerCurve);
anchored_at_origin!(Drawing);
anchored_at_origin!(GroupElement);
anchored_at_origin!(TextLine);

/// A coupler curve: a group of its own, with an id, a title and the facts about it.
pub(super) struct CouplerCurve {
    pub id: String,
    pub class: &'static str,
    pub title: String,
    pub data: Vec<(&'static str, String)>,
    /// From the plane to millimetres of the area.
    pub page_from_plane: Similarity,
    /// How the curve is cut into dashes.
    pub dashes: DashPattern,
    /// The dashes, already in millimetres of the area.
    pub dash_lines: Vec<motion::Dash>,
    /// What belongs to the figure, and what is drawn beside it.
    pub stroke_styles: [Stroke; 2],
    /// Marks on the curve.
    pub marks: Vec<Circle>,
}

impl CouplerCurve {
    fn to_item(&self, origin: Vector) -> Item {
        let lines = |figure: bool| -> Vec<Polyline> {
            let ours = self.dash_lines.iter().filter(|stroke| stroke.is_in_figure == figure && stroke.points.len() > 1);
            let moved = |p: &Point| p + origin;
            ours.map(|s| Polyline { points: s.points.iter().map(moved).collect(), is_closed: false }).collect()
        };
        let path = |(figure, stroke): (bool, Stroke)| {
            let lines = lines(figure);
            (!lines.is_empty()).then_some(Item::Path(Path { polylines: lines, stroke: Some(stroke), fill: None }))
        };
        let [figure, beside] = self.stroke_styles;
        let paths = [(false, beside), (true, figure)].into_iter().filter_map(path);
        let marks = self.marks.iter().map(|mark| translated(&Item::Circle(mark.clone()), origin));
        Item::Group(Group {
            id: self.id.clone(),
            class: self.class,
            title: self.title.clone(),
            data: self.data.iter().cloned().chain(self.drawing_data(origin)).collect(),
            items: paths.chain(marks).collect(),
        })
    }

    /// How it was drawn: what it takes to compare the drawing with the samples. Numbers read back to the same f64.
    fn drawing_data(&self, origin: Vector) -> [(&'static str, String); 3] {
        let Similarity { scale, origin: at, .. } = self.page_from_plane;
        let at = at + origin;
        let DashPattern { period, dash_span: drawn } = self.dashes;
        [("scale", scale.to_string()), ("origin", format!("{} {}", at.x, at.y)), ("dash", format!("{period} {drawn}"))]
    }
}

/// A group of lines, circles and words.
pub(super) struct Drawing {
    pub class: &'static str,
    pub title: String,
    pub items: Vec<Item>,
}

impl Drawing {
    fn to_item(&self, origin: Vector) -> Item {
        let items = self.items.iter().map(|item| translated(item, origin)).collect();
        Item::Group(Group { class: self.class, title: self.title.clone(), items, ..Group::default() })
    }
}

/// A group with an id and facts of its own.
pub(super) struct GroupElement {
    pub group: Group,
}

impl GroupElement {
    fn to_item(&self, origin: Vector) -> Item {
        translated(&Item::Group(self.group.clone()), origin)
    }
}

fn translated(item: &Item, by: Vector) -> Item {
    match item {
        Item::Group(group) => {
            let items = group.items.iter().map(|item| translated(item, by)).collect();
            Item::Group(Group { items, ..group.clone() })
        }
        Item::Path(path) => {
            let line =
                |line: &Polyline| Polyline { points: line.points.iter().map(|p| p + by).collect(), ..line.clone() };
            Item::Path(Path { polylines: path.polylines.iter().map(line).collect(), ..path.clone() })
        }
        Item::Circle(circle) => Item::Circle(Circle { centre: circle.centre + by, ..circle.clone() }),
        Item::Text(text) => Item::Text(Text { position: text.position + by, ..text.clone() }),
        Item::Animation(moving) => {
            let frame = |items: &Vec<Item>| items.iter().map(|item| translated(item, by)).collect();
            Item::Animation(Animation { frames: moving.frames.iter().map(frame).collect(), ..moving.clone() })
        }
    }
}

/// A line of text in a room of its own.
pub(super) struct TextLine {
    pub text: Text,
}

impl TextLine {
    /// A line of text at a place of the area.
    pub fn new(text: &str, typeface: Typeface, at: Point, anchor: Anchor, (size, color): (f64, Color)) -> TextLine {
        let runs = vec![TextRun { text: text.to_owned(), face: typeface.regular() }];
        TextLine { text: Text { position: at, anchor, size, color, runs, quarter_turns: 0 } }
    }

    /// The same with the words that are `symbols` in italics.
    pub fn with_italics(mut self, symbols: &[String]) -> TextLine {
        let text: String = self.text.runs.iter().map(|run| run.text.as_str()).collect();
        let mut runs: Vec<TextRun> = Vec::new();
        let typeface = self.text.runs.first().map_or(Typeface::default(), |run| run.face.typeface);
        let mut push = |text: &str, is_italic| match runs.last_mut() {
            Some(last) if last.face.is_italic == is_italic => last.text.push_str(text),
            _ => runs.push(TextRun { text: text.to_owned(), face: Face { typeface, is_italic } }),
        };
        let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
        let mut rest = text.as_str();
        while !rest.is_empty() {
            let word = rest.find(|c| !is_word(c)).unwrap_or(rest.len());
            let word = if word == 0 { rest.find(is_word).unwrap_or(rest.len()) } else { word };
            let (piece, after) = rest.split_at(word);
            // A longer name is a word to be read, a single letter a symbol.
            let is_symbol = piece.chars().count() == 1 && symbols.iter().any(|symbol| symbol == piece);
            push(piece, is_symbol);
            rest = after;
        }
        self.text.runs = runs;
        self
    }

    /// The same in no more than `width`: set smaller, to two thirds, and then cut short.
    pub fn fit_width(self, width: f64) -> TextLine {
        self.fit_width_with_suffix("", width)
    }

    /// The same with an `end`, in no more than `width`: set smaller, to two thirds, and then cut short before the end,
    /// which stays whole while there is room for it.
    pub fn fit_width_with_suffix(mut self, end: &str, width: f64) -> TextLine {
        // What fits to rounding fits: a room may have been made for this very text.
        let width = width * (1.0 + 1e-9);
        let face = self.text.runs.last().map(|run| run.face);
        let taken = |size: f64| face.map_or(0.0, |face| face.width(end, size));
        let natural = self.text.width() + taken(self.text.size);
        if natural > width {
            self.text.size *= (width / natural).max(2.0 / 3.0);
        }
        if !end.is_empty() {
            self.truncate(width - taken(self.text.size));
            match self.text.runs.last_mut() {
                Some(run) => run.text.push_str(end),
                // What parts an end from nothing is left out.
                None => self
                    .text
                    .runs
                    .extend(face.map(|face| TextRun { text: end.trim_start_matches(" · ").to_owned(), face })),
            }
        }
        self.truncate(width);
        self
    }

    /// Cuts what is wider than `width`.
    fn truncate(&mut self, width: f64) {
        while self.text.width() > width {
            match self.text.runs.last_mut() {
                Some(run) if run.text.chars().count() > 1 => {
                    let kept: String = run.text.trim_end_matches('…').chars().collect();
                    let shorter: String = kept.chars().take(kept.chars().count().saturating_sub(1)).collect();
                    run.text = format!("{}…", shorter.trim_end());
                    if shorter.is_empty() {
                        self.text.runs.pop();
                    }
                }
                Some(_) => {
                    self.text.runs.pop();
                }
                None => break,
            }
        }
    }

    /// The text in lines no wider than `width`, broken between words.
    pub fn wrap(&self, width: f64) -> Vec<String> {
        let text: String = self.text.runs.iter().map(|run| run.text.as_str()).collect();
        let is_wider =
            |line: &str| self.text.runs.first().is_some_and(|run| run.face.width(line, self.text.size) > width);
        let mut lines: Vec<String> = Vec::new();
        for word in text.split(' ') {
            match lines.last_mut() {
                Some(line) if !is_wider(&format!("{line} {word}")) => {
                    line.push(' ');
                    line.push_str(word);
                }
                // What parts two things parts them no less if a line ends there.
                Some(_) if word == "·" => lines.push(String::new()),
                _ => lines.push(word.to_owned()),
            }
        }
        lines.iter().map(|line| line.trim_start().to_owned()).collect()
    }

    fn to_item(&self, origin: Vector) -> Item {
        translated(&Item::Text(self.text.clone()), origin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> TextLine {
        TextLine::new(text, Typeface::Sans, Point::origin(), Anchor::Start, (3.0, Color(0, 0, 0)))
    }

    #[test]
    fn single_letters_that_are_parameters_are_italic() {
        let symbols = ["p".to_owned(), "frame".to_owned()];
        let runs = words("p = 2, prop frame's p's").with_italics(&symbols).text.runs;
        let texts: Vec<(&str, Face)> = runs.iter().map(|run| (run.text.as_str(), run.face)).collect();
        assert_eq!(texts, [("p", Typeface::Sans.italic()), (" = 2, prop frame's p's", Typeface::Sans.regular())]);
    }

    #[test]
    fn a_long_line_is_set_smaller_and_then_cut() {
        let natural = words("a line of some length").text.width();
        let smaller = words("a line of some length").fit_width(0.9 * natural).text;
        assert!(smaller.width() <= 0.9 * natural * 1.000_001 && smaller.runs[0].text.ends_with("length"));
        let cut = words("a line of some length").fit_width(0.3 * natural).text;
        assert!(cut.width() <= 0.3 * natural && cut.runs[0].text.ends_with('…'));
        assert!(words("a").fit_width(0.0).text.runs.is_empty());
        let ended = words("a line of some length").fit_width_with_suffix(", page 1", 0.6 * natural).text;
        assert!(ended.width() <= 0.6 * natural && ended.runs[0].text.ends_with("…, page 1"), "{ended:?}");
        // In a room of its own width it stays whole, however that was come by.
        for k in 1..200 {
            let before = 0.37 * f64::from(k);
            let room = (before + natural) - before;
            assert_eq!(words("a line of some length").fit_width(room).text, words("a line of some length").text, "{k}");
        }
    }
}
