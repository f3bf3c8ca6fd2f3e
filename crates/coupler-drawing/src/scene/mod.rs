//! Scenes: finished pages as display lists in millimetres.
//!
//! A [`Scene`] is recorded by a [`Canvas`], a plotters `DrawingBackend` whose pixel is 1/100 mm. Elements of plotters
//! are recorded in whole pixels, elements of this crate in full precision. Without the feature `plotters`, pages without
//! charts are recorded to the same scenes. The origin of the page is its upper left corner, with x to the right and y
//! down.

mod book;
#[cfg(feature = "plotters")]
mod canvas;
mod color;
mod font;
pub(crate) mod pixel;
mod text;

pub use book::{LinkKind, LinkTarget, OutlineEntry, PageLink, PageNumber};
#[cfg(feature = "plotters")]
pub use canvas::Canvas;
pub use color::Color;
pub use font::{Face, FontFamily, FontFile, FontFileError, Typeface};
#[cfg(feature = "fonts")]
pub use font::{GlyphRun, OutlineSegment, PlacedGlyph};
pub(crate) use font::{has_right_to_left, reading_parts};
pub use text::{Anchor, MIN_TEXT_SIZE, Text, TextRun};

#[cfg(feature = "pdf")]
use coupler_curves::geometry::Bounds;
use coupler_curves::geometry::{Point, Spline, Vector};

/// A finished page, which can be rendered.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The width in millimetres.
    pub width: f64,
    /// The height in millimetres.
    pub height: f64,
    /// The colour of the paper.
    pub paper: Color,
    /// The typeface of the texts.
    pub typeface: Typeface,
    /// The title of the document.
    pub title: String,
    /// The items, from back to front.
    pub items: Vec<Item>,
    /// Links to other pages, on a page of a book.
    pub links: Vec<PageLink>,
    /// The scale at which its linkages fit, in millimetres to a unit, if that is less than the one that is given: they are reduced to it.
    pub reduced_scale: Option<f64>,
}

/// An item of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Items that belong together.
    Group(Group),
    /// Polylines.
    Path(Path),
    /// Splines.
    Curve(Curve),
    /// A circle.
    Circle(Circle),
    /// A line of text.
    Text(Text),
    /// Items that move over time.
    Animation(Animation),
}

/// A drawn item, which has no other items in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<'a> {
    /// Polylines.
    Path(&'a Path),
    /// Splines.
    Curve(&'a Curve),
    /// A circle.
    Circle(&'a Circle),
    /// A line of text.
    Text(&'a Text),
}

/// Items that belong together, with a description.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// An id, unique on the page; may be empty.
    pub id: String,
    /// The class, which is the same for groups of the same kind; may be empty.
    pub class: &'static str,
    /// A description; may be empty.
    pub title: String,
    /// What a figure shows, in words, for those who cannot see it; empty if the group is none.
    pub description: String,
    /// Data attributes: names and values.
    pub data: Vec<(&'static str, String)>,
    /// The items, from back to front.
    pub items: Vec<Item>,
}

/// The classes of groups that are no figures and no decoration.
pub mod group_class {
    /// The lines of the title of a page.
    pub const TITLE: &str = "title";
    /// The title of the atlas and the number of a page at its foot.
    pub const FOLIO: &str = "folio";
    /// A mark of the thumb index.
    pub const TAB: &str = "tab";
}

/// Items that move, repeated without end. A format without animation shows the first frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// The items at equal time steps; a periodic animation repeats its first frame at the end. Frames differ only in
    /// the positions of their items.
    pub frames: Vec<Vec<Item>>,
    /// The time from the first frame to the last.
    pub seconds: f64,
}

/// Polylines, stroked or filled or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The polylines.
    pub polylines: Vec<Polyline>,
    /// The stroke, if the polylines are stroked.
    pub stroke: Option<Stroke>,
    /// The colour of the fill, if they are filled.
    pub fill: Option<Color>,
}

/// A polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The points.
    pub points: Vec<Point>,
    /// Whether the last point is joined to the first.
    pub is_closed: bool,
}

/// Splines, stroked.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The splines.
    pub splines: Vec<Spline>,
    /// The stroke.
    pub stroke: Stroke,
}

/// The stroke of a line; joins are round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The colour.
    pub color: Color,
    /// The width in millimetres.
    pub width: f64,
    /// Whether the ends are round; otherwise they are butt ends.
    pub has_round_ends: bool,
}

/// A circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Circle {
    /// The centre.
    pub centre: Point,
    /// The radius in millimetres.
    pub radius: f64,
    /// The stroke, if the circle is stroked.
    pub stroke: Option<Stroke>,
    /// The colour of the fill, if it is filled.
    pub fill: Option<Color>,
}

impl Scene {
    /// The shapes of the page without animation, from back to front.
    pub fn shapes(&self) -> Vec<Shape<'_>> {
        let mut shapes = Vec::new();
        collect_shapes(&self.items, &mut shapes);
        shapes
    }

    /// The figures of the page, which are groups with a description; those within others are parts of them.
    pub fn figures(&self) -> Vec<&Group> {
        let mut figures = Vec::new();
        collect_figures(&self.items, &mut figures);
        figures
    }

    /// Makes a group of the items from an index on, unless there are none.
    pub(crate) fn group_items(&mut self, first: usize, group: Group) {
        let items = self.items.split_off(first);
        if !items.is_empty() {
            self.items.push(Item::Group(Group { items, ..group }));
        }
    }
}

fn collect_figures<'s>(items: &'s [Item], figures: &mut Vec<&'s Group>) {
    for item in items {
        match item {
            Item::Group(group) if !group.description.is_empty() => figures.push(group),
            Item::Group(group) => collect_figures(&group.items, figures),
            _ => {}
        }
    }
}

impl Group {
    /// A figure: what it is, and what it shows in words.
    pub(crate) fn figure(class: &'static str, description: impl Into<String>) -> Group {
        Group { class, description: description.into(), ..Group::default() }
    }

    /// Items of one kind.
    pub(crate) fn of_class(class: &'static str) -> Group {
        Group { class, ..Group::default() }
    }
}

impl Item {
    /// The shapes of the item without animation, from back to front.
    pub(crate) fn shapes(&self) -> Vec<Shape<'_>> {
        let mut shapes = Vec::new();
        collect_shapes(std::slice::from_ref(self), &mut shapes);
        shapes
    }
}

#[cfg(feature = "pdf")]
impl Shape<'_> {
    /// The bounds of the shape, without the width of its lines.
    pub(crate) fn bounds(&self) -> Bounds {
        match self {
            Shape::Path(path) => {
                Bounds::from_points(path.polylines.iter().flat_map(|line| line.points.iter().copied()))
            }
            Shape::Curve(curve) => Bounds::from_points(curve.splines.iter().flat_map(Spline::points)),
            Shape::Circle(circle) => {
                let reach = Vector::repeat(circle.radius);
                Bounds::from_points([circle.centre - reach, circle.centre + reach])
            }
            Shape::Text(text) => Bounds::from_points(text.corners()),
        }
    }
}

fn collect_shapes<'s>(items: &'s [Item], shapes: &mut Vec<Shape<'s>>) {
    for item in items {
        match item {
            Item::Group(group) => collect_shapes(&group.items, shapes),
            Item::Path(path) => shapes.push(Shape::Path(path)),
            Item::Curve(curve) => shapes.push(Shape::Curve(curve)),
            Item::Circle(circle) => shapes.push(Shape::Circle(circle)),
            Item::Text(text) => shapes.push(Shape::Text(text)),
            Item::Animation(animation) => {
                animation.frames.iter().take(1).for_each(|first| collect_shapes(first, shapes))
            }
        }
    }
}

impl Text {
    /// The width in millimetres.
    pub fn width(&self) -> f64 {
        #[cfg(feature = "fonts")]
        if self.runs.iter().any(|run| run.face.typeface.fallback.is_some()) {
            return font::runs_width(&self.runs, self.size);
        }
        self.runs.iter().map(|run| run.width(self.size)).sum()
    }

    /// The start of the text on its baseline, before the rotation.
    pub fn start(&self) -> Point {
        let shift = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => self.width() / 2.0,
            Anchor::End => self.width(),
        };
        Point::new(self.position.x - shift, self.position.y)
    }

    /// The corners of the box of the text, after its rotation.
    pub(crate) fn corners(&self) -> [Point; 4] {
        let start = self.start() - self.position;
        let (width, size) = (self.width(), self.size);
        let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][usize::from(self.quarter_turns % 4)];
        [(0.0, -size), (width, -size), (width, 0.3 * size), (0.0, 0.3 * size)].map(|(x, y)| {
            let at = start + Vector::new(x, y);
            self.position + Vector::new(cos * at.x - sin * at.y, sin * at.x + cos * at.y)
        })
    }
}

impl Path {
    /// A stroked polyline.
    pub fn stroked(points: Vec<Point>, stroke: Stroke) -> Path {
        Path { polylines: vec![Polyline { points, is_closed: false }], stroke: Some(stroke), fill: None }
    }
}
