//! Given curves by their shape.

use std::ops::Range;

use super::curve_path::CurvePath;
use super::portion::Stroke;
use super::shape::{Shape, Shapes};
use super::spectrum::{Spectrum, Transform};
use super::target::{PathKind, Target};
use crate::geometry::Point;

/// The shape of a curve, which can be computed on any thread.
#[derive(Clone, Copy)]
pub struct CurveShape(Shape);

/// The points of equal distances from which the shape of a curve is computed.
const POINTS: usize = 256;

impl CurveShape {
    /// The shape of the curve through points. An open curve is one that is passed there and back. The points may be in any unit; of
    /// points without extent, or with a coordinate that is not finite, the shape is one that is like no target.
    pub fn new(points: &[Point], is_closed: bool) -> CurveShape {
        let Some(path) = CurvePath::new(points, is_closed) else { return CurveShape(Shape::EMPTY) };
        let positions = path.spaced_evenly(POINTS);
        let curve: Vec<_> = positions.iter().map(|position| path.point(*position)).collect();
        let (spectrum, _, size) = Transform::new().spectrum(&curve);
        let shape = Shape::new(&spectrum.canonical(), path.length() / size, true);
        CurveShape(if path.is_open { shape.of_open() } else { shape })
    }
}

/// Given curves by their shape, in [`CurveIndex::BYTES_PER_CURVE`] bytes each: those of an atlas, of any linkages.
///
/// They are looked up by a [`CurveLookup`], and those that are found compared by a [`super::CurveFitter`].
pub struct CurveIndex(Shapes);

impl CurveIndex {
    /// The memory of a curve.
    pub const BYTES_PER_CURVE: usize = Shape::BYTES;

    /// An index without curves.
    pub fn new() -> CurveIndex {
        CurveIndex(Shapes::new())
    }

    /// Adds a curve through points, see [`CurveShape::new`]; its number is the number of curves before.
    pub fn push(&mut self, points: &[Point], is_closed: bool) {
        self.push_shape(CurveShape::new(points, is_closed));
    }

    /// Adds the shape of a curve.
    pub fn push_shape(&mut self, CurveShape(shape): CurveShape) {
        self.0.push(shape);
    }

    /// The number of curves.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether it has no curves.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Default for CurveIndex {
    fn default() -> CurveIndex {
        CurveIndex::new()
    }
}

/// The curves of an index that are most like a target, found in steps of any number of curves.
pub struct CurveLookup {
    query: Query,
    most: usize,
    best: Vec<(f32, usize)>,
}

enum Query {
    /// The spectrum of a closed target, and its length in its sizes.
    Whole(Box<Spectrum>, f64),
    /// An open target, and the least part of a curve that may be like it.
    Portion(Box<Stroke>, f64),
}

impl CurveLookup {
    /// Begins to look up a target: at most `most` curves are kept. An open one is looked up in portions of at least
    /// `least_portion` of the length of a curve.
    pub fn new(target: &Target, least_portion: f64, most: usize) -> CurveLookup {
        let points = target.normalized();
        let query = match target.kind() {
            PathKind::Closed => {
                let (spectrum, ..) = Transform::new().spectrum(&points);
                Query::Whole(Box::new(spectrum), target.polyline_length())
            }
            PathKind::Open | PathKind::Part => Query::Portion(Box::new(Stroke::new(&points)), least_portion),
        };
        CurveLookup { query, most: most.max(1), best: Vec::new() }
    }

    /// Compares the curves of a range, or as many of them as the index has. A closed target takes some 20 ns for each, an open one 20 µs.
    pub fn compare(&mut self, CurveIndex(shapes): &CurveIndex, range: Range<usize>) {
        let best = std::mem::take(&mut self.best);
        self.best = match &self.query {
            Query::Whole(spectrum, length) => shapes.nearest((spectrum, *length, false), range, best, self.most),
            Query::Portion(stroke, least) => shapes.nearest_portions_closely((stroke, *least), range, best, self.most),
        };
    }

    /// The curves that have been found so far, the likeliest first: how much they are like the target, the more the greater, and their
    /// numbers.
    pub fn found(&self) -> impl Iterator<Item = (f64, usize)> {
        self.best.iter().map(|(likeness, number)| (f64::from(*likeness), *number))
    }

    /// The numbers of the curves that have been found so far, the likeliest first.
    pub fn numbers(&self) -> Vec<usize> {
        self.best.iter().map(|(_, number)| *number).collect()
    }
}
