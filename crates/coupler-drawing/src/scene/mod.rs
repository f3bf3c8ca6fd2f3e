//! A finished page as a display list in millimetres.
//!
//! A [`Scene`] is recorded by a [`Canvas`], a plotters `DrawingBackend` whose pixel is 1/100 mm. What plotters draws
//! arrives in those whole numbers; elements of our own record their items in full precision. The page's origin is its
//! upper left corner, x to the right and y down.

mod book;
mod canvas;
mod color;
mod font;

pub use book::{OutlineEntry, PageLink, PageNumber};
pub use canvas::Canvas;
pub use color::Color;
pub use font::{Face, OutlineSegment, Typeface};

use coupler_curves::geometry::Point;

/// A page, ready to be turned into bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its width in millimetres.
    pub width: f64,
    /// Its height in millimetres.
    pub height: f64,
    /// The colour of the paper.
    pub paper: Color,
    /// What its texts are set in.
    pub typeface: Typeface,
    /// What the page is called.
    pub title: String,
    /// What is drawn, from back to front.
    pub items: Vec<Item>,
    /// What leads to other pages, where it is a page of a book; elsewhere nothing does.
    pub links: Vec<PageLink>,
}

/// Something drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Items that belong together.
    Group(Group),
    /// Lines.
    Path(Path),
    /// A circle.
    Circle(Circle),
    /// A line of text.
    Text(Text),
    /// Items that move.
    Animation(Animation),
}

/// An item without parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<'a> {
    /// Lines.
    Path(&'a Path),
    /// A circle.
    Circle(&'a Circle),
    /// A line of text.
    Text(&'a Text),
}

/// Items that belong together, and what they are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// A name that no other group of the page has; may be empty.
    pub id: String,
    /// The kind of thing it is; may be empty.
    pub class: &'static str,
    /// What it is, in words; may be empty.
    pub title: String,
    /// Facts about it.
    pub data: Vec<(&'static str, String)>,
    /// What is drawn.
    pub items: Vec<Item>,
}

/// Items that go from place to place, again and again. Where nothing can move they stand as in the first frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// The items at equal steps of time, the first once more at the end where they come back to it. They differ in their
    /// places only.
    pub frames: Vec<Vec<Item>>,
    /// How long it takes from the first frame to the last.
    pub seconds: f64,
}

/// Polylines, stroked or filled or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The polylines.
    pub polylines: Vec<Polyline>,
    /// How they are stroked.
    pub stroke: Option<Stroke>,
    /// The colour they are filled with.
    pub fill: Option<Color>,
}

/// A polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// Its points.
    pub points: Vec<Point>,
    /// Whether the last is joined to the first.
    pub is_closed: bool,
}

/// How a line is stroked; joins are round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The colour.
    pub color: Color,
    /// The width in millimetres.
    pub width: f64,
    /// Whether the ends are round; otherwise they are cut square at the last point.
    pub has_round_ends: bool,
}

/// A circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Circle {
    /// The centre.
    pub centre: Point,
    /// The radius in millimetres.
    pub radius: f64,
    /// How it is stroked.
    pub stroke: Option<Stroke>,
    /// The colour it is filled with.
    pub fill: Option<Color>,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// Where it stands, on its baseline.
    pub position: Point,
    /// Which part of it stands there.
    pub anchor: Anchor,
    /// The size of the em in millimetres.
    pub size: f64,
    /// The colour.
    pub color: Color,
    /// Its pieces, each in a face.
    pub runs: Vec<TextRun>,
    /// Quarter turns clockwise about `at`.
    pub quarter_turns: u8,
}

/// A piece of text in one face.
#[derive(Clone, Debug, PartialEq)]
pub struct TextRun {
    /// The text.
    pub text: String,
    /// The face.
    pub face: Face,
}

/// Which part of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

impl Scene {
    /// What is drawn where nothing can move, from back to front.
    pub fn shapes(&self) -> Vec<Shape<'_>> {
        let mut shapes = Vec::new();
        collect_shapes(&self.items, &mut shapes);
        shapes
    }
}

fn collect_shapes<'s>(items: &'s [Item], shapes: &mut Vec<Shape<'s>>) {
    for item in items {
        match item {
            Item::Group(group) => collect_shapes(&group.items, shapes),
            Item::Path(path) => shapes.push(Shape::Path(path)),
            Item::Circle(circle) => shapes.push(Shape::Circle(circle)),
            Item::Text(text) => shapes.push(Shape::Text(text)),
            Item::Animation(moving) => moving.frames.iter().take(1).for_each(|first| collect_shapes(first, shapes)),
        }
    }
}

impl Text {
    /// Its width in millimetres.
    pub fn width(&self) -> f64 {
        self.runs.iter().map(|run| run.face.width(&run.text, self.size)).sum()
    }

    /// Where it begins on its baseline, before it is turned.
    pub fn start(&self) -> Point {
        let shift = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => self.width() / 2.0,
            Anchor::End => self.width(),
        };
        Point::new(self.position.x - shift, self.position.y)
    }
}

impl Path {
    /// A stroked polyline.
    pub fn stroked(points: Vec<Point>, stroke: Stroke) -> Path {
        Path { polylines: vec![Polyline { points, is_closed: false }], stroke: Some(stroke), fill: None }
    }
}
