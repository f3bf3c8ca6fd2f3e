//! Drawings of parts: shapes on layers, which each format writes in its own way.

use super::SelectedCurve;
use super::circle::{Circle, fit_circle};
use super::curve_path::curve_path;
use crate::geometry::{Bounds, Point, Similarity, Vector};
use crate::parts::{Outline, Part, Parts, Sizes, Vertex};

/// A drawing.
pub(super) struct PartDrawing {
    /// What it is of.
    pub title: String,
    pub layers: Vec<Layer>,
    /// The shapes, each with the index of its layer.
    pub shapes: Vec<(usize, Shape)>,
    /// The diameter of holes, which marks and texts are proportional to.
    pub hole: f64,
}

/// A layer.
pub(super) struct Layer {
    pub name: String,
    pub kind: LayerKind,
}

/// What is on a layer.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum LayerKind {
    /// The outline of a part.
    Outline,
    Holes,
    Slots,
    /// The centre lines of holes and slots, and the pitch lines of racks.
    Centres,
    Curve,
    Text,
}

/// A shape.
pub(super) enum Shape {
    Outline(Outline),
    /// A line of many points, and whether the last is followed by the first.
    Polyline(Vec<Point>, bool),
    Line([Point; 2]),
    /// A text, the lower left corner of its first letter, and the height of its capitals.
    Text(String, Point, f64),
}

/// The layers that every drawing has after those of its parts.
const COMMON_LAYERS: [(&str, LayerKind); 4] = [
    ("HOLES", LayerKind::Holes),
    ("SLOTS", LayerKind::Slots),
    ("CENTRES", LayerKind::Centres),
    ("TEXT", LayerKind::Text),
];

impl PartDrawing {
    /// One part in its own coordinates.
    pub fn of_part(part: &Part, sizes: Sizes) -> PartDrawing {
        let mut drawing = PartDrawing::with_layers(part.name.clone(), std::slice::from_ref(part), sizes);
        drawing.add_part(0, part, &Similarity::IDENTITY);
        let bounds = drawing.bounds();
        let height = 0.75 * sizes.hole;
        for (k, words) in std::iter::once(&part.name).chain(&part.notes).enumerate() {
            let below = Point::new(bounds.min.x, bounds.min.y - 2.0 * height * (k as f64 + 1.0));
            drawing.add(LayerKind::Text, Shape::Text(words.clone(), below, height));
        }
        drawing
    }

    /// All parts where they are in the drawn pose, with the curve.
    pub fn of_assembly(selected: &SelectedCurve, parts: &Parts, chord: f64) -> PartDrawing {
        let mut drawing = PartDrawing::with_layers(selected.name(), &parts.parts, parts.sizes);
        drawing.layers.push(Layer { name: "CURVE".to_owned(), kind: LayerKind::Curve });
        let pose = selected.pose();
        for (layer, part) in parts.parts.iter().enumerate() {
            drawing.add_part(layer, part, &part.plane_from_part(&pose));
        }
        let (path, is_closed) = curve_path(selected, chord);
        let curve = match fit_circle(&path, &[]) {
            Some(Circle { centre, radius, arc_deg: None }) => Shape::Outline(Outline::Circle { centre, radius }),
            _ => Shape::Polyline(path, is_closed),
        };
        drawing.add(LayerKind::Curve, curve);
        drawing
    }

    fn with_layers(title: String, parts: &[Part], sizes: Sizes) -> PartDrawing {
        let common = COMMON_LAYERS.map(|(name, kind)| Layer { name: name.to_owned(), kind });
        let own = parts.iter().map(|part| Layer { name: part.name.clone(), kind: LayerKind::Outline });
        PartDrawing { title, layers: own.chain(common).collect(), shapes: Vec::new(), hole: sizes.hole }
    }

    fn add(&mut self, kind: LayerKind, shape: Shape) {
        let layer = self.layers.iter().position(|layer| layer.kind == kind);
        self.shapes.extend(layer.map(|layer| (layer, shape)));
    }

    fn add_part(&mut self, layer: usize, part: &Part, transform: &Similarity) {
        self.shapes.push((layer, Shape::Outline(part.outline.transformed(transform))));
        let radius = self.hole / 2.0;
        let [along, across] =
            [Vector::x(), Vector::y()].map(|axis| transform.apply(Point::from(axis)) - transform.origin());
        for hole in &part.holes {
            let centre = transform.apply(hole.centre);
            self.add(LayerKind::Holes, Shape::Outline(Outline::Circle { centre, radius }));
            for arm in [along, across].map(|axis| axis * (1.5 * radius)) {
                self.add(LayerKind::Centres, Shape::Line([centre - arm, centre + arm]));
            }
            if !hole.name.is_empty() {
                let name = Shape::Text(hole.name.clone(), centre + Vector::repeat(1.2 * radius), self.hole / 2.0);
                self.add(LayerKind::Text, name);
            }
        }
        for slot in &part.slots {
            self.add(LayerKind::Slots, Shape::Outline(slot.outline(self.hole).transformed(transform)));
            self.add(LayerKind::Centres, Shape::Line(slot.ends.map(|end| transform.apply(end))));
        }
        if let Some(line) = part.pitch_line {
            let ends = line.ends.map(|end| transform.apply(end));
            self.add(LayerKind::Centres, Shape::Line(ends));
            let name = Shape::Text("pitch line".to_owned(), ends[0] + Vector::repeat(0.4 * radius), self.hole / 2.0);
            self.add(LayerKind::Text, name);
        }
    }

    /// The bounds of all shapes; of texts, those of as many wide letters.
    pub fn bounds(&self) -> Bounds {
        let shape_bounds = |(_, shape): &(usize, Shape)| match shape {
            Shape::Outline(outline) => outline.bounds(),
            Shape::Polyline(points, _) => Bounds::from_points(points.iter().copied()),
            Shape::Line(ends) => Bounds::from_points(*ends),
            Shape::Text(text, at, height) => {
                let size = Vector::new(text.chars().count() as f64, 1.0) * *height;
                Bounds::from_points([*at, at + size])
            }
        };
        self.shapes.iter().map(shape_bounds).fold(Bounds::EMPTY, Bounds::union)
    }
}

/// The ends of each line or arc of an outline, and the bulge of what is between them.
pub(super) fn edges(vertices: &[Vertex]) -> impl Iterator<Item = (Point, Point, f64)> {
    let next = vertices.iter().cycle().skip(1);
    vertices.iter().zip(next).map(|(from, to)| (from.at, to.at, from.bulge))
}
