//! Drawing of scenes on the pages of a document.

use std::num::NonZeroU16;

use krilla::color::rgb;
use krilla::geom::{self, PathBuilder, Transform};
use krilla::paint::{Fill, LineCap, LineJoin};
use krilla::surface::Surface;
use krilla::tagging::{Artifact, ArtifactType, ContentTag, Identifier, SpanTag};

use super::fonts::{FontCache, layout_glyphs};
use super::sheet::{POINTS_PER_MM, Sheet, mm_to_points};
use super::structure::PageStructure;
use super::words::sanitize_text;
use crate::scene::group_class::{FOLIO, TAB, TITLE};
use crate::scene::{
    Circle, Color, Curve, GlyphRun, Item, OutlineSegment, Path, PlacedGlyph, Polyline, Scene, Shape, Stroke, Text,
};
use coupler_curves::geometry::{Point, Spline, SplineSegment, Vector};

/// The units of coordinates per millimetre. Coordinates are whole numbers, which are short and quick to write.
const UNITS_PER_MM: f64 = 1000.0;

/// Draws scenes on a page of a document, whose origin is the upper left corner with y down, as that of a scene.
pub(super) struct PagePainter<'d> {
    surface: Surface<'d>,
    fonts: &'d mut FontCache,
    /// What the content belongs to that is being drawn.
    marked: Marked,
    /// The left and right edge of what is drawn of the page, and its bleed.
    edges: ([f64; 2], f64),
    /// The index of the page in the book.
    page_index: usize,
}

/// What drawn content belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Marked {
    Nothing,
    /// A part of the structure of the page.
    Part,
    /// No part of it.
    Artifact(ArtifactType),
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
    pub fn new(surface: Surface<'d>, fonts: &'d mut FontCache, page_index: usize) -> PagePainter<'d> {
        PagePainter { surface, fonts, marked: Marked::Nothing, edges: ([0.0; 2], 0.0), page_index }
    }

    pub fn finish(mut self) {
        self.end_marked();
        self.surface.finish();
    }

    fn end_marked(&mut self) {
        if std::mem::replace(&mut self.marked, Marked::Nothing) != Marked::Nothing {
            self.surface.end_tagged();
        }
    }

    /// Begins a part of the structure.
    fn begin_part(&mut self, tag: ContentTag) -> Identifier {
        self.end_marked();
        self.marked = Marked::Part;
        self.surface.start_tagged(tag)
    }

    /// Begins what is no part of the structure, unless it has begun.
    fn begin_artifact(&mut self, kind: ArtifactType) {
        if self.marked != Marked::Artifact(kind) {
            self.end_marked();
            self.marked = Marked::Artifact(kind);
            self.surface.start_tagged(ContentTag::Artifact(Artifact::with_kind(kind)));
        }
    }

    /// Draws the paper and all items from a corner of the sheet; the result is the structure of the page, whose title has a level.
    pub fn draw_scene<'s>(
        &mut self,
        scene: &'s Scene,
        level: NonZeroU16,
        (sheet, corner): (Sheet, Point),
    ) -> PageStructure<'s> {
        self.begin_artifact(ArtifactType::Other);
        let [width, height] = [scene.width + sheet.binding + 2.0 * sheet.bleed, scene.height + 2.0 * sheet.bleed];
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        let points = corners.map(|(x, y)| Point::new(x, y)).to_vec();
        self.draw_path(&Path {
            polylines: vec![Polyline { points, is_closed: true }],
            stroke: None,
            fill: Some(scene.paper),
        });
        let mut structure = PageStructure::new(&scene.links, (self.page_index, corner.coords));
        self.end_marked();
        let is_moved = corner != Point::origin();
        if is_moved {
            let [x, y] = corner.coords.map(mm_to_points).into();
            self.surface.push_transform(&Transform::from_translate(x, y));
        }
        self.edges = ([0.0, scene.width], sheet.bleed);
        self.draw_items(&scene.items, &mut structure, level);
        self.end_marked();
        if is_moved {
            self.surface.pop();
        }
        structure
    }

    /// Draws items: titles, texts and figures are parts of the structure, and all else is decoration.
    fn draw_items<'s>(&mut self, items: &'s [Item], structure: &mut PageStructure<'s>, level: NonZeroU16) {
        for item in items {
            match item {
                Item::Text(text) => structure.add_text(text, self.draw_line(text)),
                Item::Group(group) if matches!(group.class, FOLIO | TAB) => {
                    self.begin_artifact(ArtifactType::PageNumber);
                    self.draw_shapes(&self.with_bleed(item));
                }
                Item::Group(group) if group.class == TITLE => {
                    let lines: Vec<&Text> = item
                        .shapes()
                        .into_iter()
                        .filter_map(|s| if let Shape::Text(t) = s { Some(t) } else { None })
                        .collect();
                    let words: Vec<String> = lines.iter().map(|line| line.words()).collect();
                    let contents = lines.iter().map(|line| self.draw_line(line)).collect();
                    structure.add_title(&words.join(" "), contents, level);
                }
                Item::Group(group) if !group.description.is_empty() => {
                    let shapes = item.shapes();
                    let bounds = shapes.iter().map(Shape::bounds).reduce(|a, b| a.union(b));
                    let Some(bounds) = bounds.filter(|bounds| !bounds.is_empty()) else { continue };
                    let content = self.begin_part(ContentTag::Other);
                    self.draw_shapes(item);
                    structure.add_figure(bounds, &group.description, content);
                }
                Item::Group(group) => self.draw_items(&group.items, structure, level),
                _ => {
                    self.begin_artifact(ArtifactType::Other);
                    self.draw_shapes(item);
                }
            }
        }
    }

    /// The item with what touches the edges of the page extended beyond them.
    fn with_bleed(&self, item: &Item) -> Item {
        let ([left, right], bleed) = self.edges;
        let mut item = item.clone();
        if let Item::Group(group) = &mut item {
            let paths =
                group.items.iter_mut().filter_map(|item| if let Item::Path(path) = item { Some(path) } else { None });
            for point in paths.flat_map(|path| &mut path.polylines).flat_map(|line| &mut line.points) {
                point.x += if point.x <= left {
                    -bleed
                } else if point.x >= right {
                    bleed
                } else {
                    0.0
                };
            }
        }
        item
    }

    fn draw_shapes(&mut self, item: &Item) {
        for shape in item.shapes() {
            match shape {
                Shape::Path(path) => self.draw_path(path),
                Shape::Curve(curve) => self.draw_curve(curve),
                Shape::Circle(circle) => self.draw_circle(circle),
                Shape::Text(text) => self.draw_text(text),
            }
        }
    }

    /// Draws a line of text as a part of the structure.
    fn draw_line(&mut self, text: &Text) -> Identifier {
        let is_written = text.glyph_runs().iter().all(|run| run.glyphs.iter().all(|glyph| is_writable(run, glyph)));
        let words = sanitize_text(&text.words());
        // What has no glyph is drawn as a box, and read as what it is.
        let span = SpanTag::empty().with_actual_text((!is_written).then_some(words.as_str()));
        let content = self.begin_part(ContentTag::Span(span));
        self.draw_text(text);
        content
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
            let Some(font) = self.fonts.get(&run) else { continue };
            let size = mm_to_units(run.size);
            let glyphs = layout_glyphs(&run);
            if run.glyphs.iter().all(|glyph| is_writable(&run, glyph)) {
                self.surface.draw_glyphs(geom::Point::from_xy(x, y), &glyphs, font, run.text, size, false);
                continue;
            }
            let mut right = 0.0;
            for ((glyph, (at, outline)), laid_out) in run.glyphs.iter().zip(run.outlines()).zip(&glyphs) {
                if is_writable(&run, glyph) {
                    let start = geom::Point::from_xy(x + mm_to_units(right * run.size), y);
                    let glyphs = std::slice::from_ref(laid_out);
                    self.surface.draw_glyphs(start, glyphs, font.clone(), run.text, size, false);
                } else if let Some(path) = outline_path(&outline, at - frame.origin, run.size) {
                    self.surface.draw_path(&path);
                }
                right += glyph.advance;
            }
        }
        self.surface.pop();
    }
}

/// Whether a document may have a glyph: that of a character that its font does not have, or of one that is no character, has no
/// meaning for those who do not see it.
fn is_writable(run: &GlyphRun, glyph: &PlacedGlyph) -> bool {
    let text = &run.text[glyph.range.clone()];
    glyph.index != 0 && !text.is_empty() && !text.contains(['\0', '\u{feff}', '\u{fffe}'])
}

/// The outline of a glyph at a size, from a position on the page; `None` if it has none.
fn outline_path(outline: &[OutlineSegment], position: Vector, size: f64) -> Option<geom::Path> {
    let mut builder = PathBuilder::new();
    let on_page =
        |[x, y]: [f64; 2]| point_in_units(&Point::from(position + Vector::new(x, -y) * size), Point::origin());
    for segment in outline.iter().copied() {
        match segment {
            OutlineSegment::Move(p) => {
                let [x, y] = on_page(p);
                builder.move_to(x, y);
            }
            OutlineSegment::Line(p) => {
                let [x, y] = on_page(p);
                builder.line_to(x, y);
            }
            OutlineSegment::Quad(c, p) => {
                let [[a, b], [x, y]] = [c, p].map(on_page);
                builder.quad_to(a, b, x, y);
            }
            OutlineSegment::Cubic(c, d, p) => {
                let [[a, b], [c, d], [x, y]] = [c, d, p].map(on_page);
                builder.cubic_to(a, b, c, d, x, y);
            }
            OutlineSegment::Close => builder.close(),
        }
    }
    builder.finish()
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
