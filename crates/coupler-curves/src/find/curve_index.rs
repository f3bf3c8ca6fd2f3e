//! Given curves by their shape.

use std::ops::Range;

use super::curve_path::CurvePath;
use super::query::Query;
use super::shape::{Shape, Shapes};
use super::spectrum::Transform;
use super::target::Target;
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
    /// The length of the target in its sizes.
    length: f64,
    least_portion: f64,
    most: usize,
    best: Vec<(f32, usize)>,
}

impl CurveLookup {
    /// Begins to look up a target: at most `most` curves are kept. An open one is looked up in portions of at least
    /// `least_portion` of the length of a curve.
    pub fn new(target: &Target, least_portion: f64, most: usize) -> CurveLookup {
        CurveLookup {
            query: Query::new(target.kind(), &target.normalized()),
            length: target.polyline_length(),
            least_portion,
            most: most.max(1),
            best: Vec::new(),
        }
    }

    /// Compares the curves of a range, or as many of them as the index has. A closed target takes some 20 ns for each, an open one 20 µs.
    pub fn compare(&mut self, CurveIndex(shapes): &CurveIndex, range: Range<usize>) {
        let best = std::mem::take(&mut self.best);
        self.best = match &self.query {
            Query::Whole(spectrum, ..) => shapes.nearest((spectrum, self.length, false), range, best, self.most),
            Query::Portion(stroke) => {
                shapes.nearest_portions_closely((stroke, self.least_portion), range, best, self.most)
            }
        };
    }

    /// The numbers of the curves that have been found so far, the likeliest first.
    pub fn numbers(&self) -> Vec<usize> {
        self.best.iter().map(|(_, number)| *number).collect()
    }
}
