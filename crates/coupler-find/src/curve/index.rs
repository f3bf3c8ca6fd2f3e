//! Given curves by their shape.

use std::ops::Range;

use crate::complex::{Complex, closed_length};
use crate::curve::fit::EVEN;
use crate::curve::path::CurvePath;
use crate::curve_fit_options::CurveFitOptions;
use crate::query::Query;
use crate::shape::best::Best;
use crate::shape::close_portion::portions;
use crate::shape::compact::{Shape, Shapes};
use crate::shape::spectrum::{Extent, HARMONICS, Transform};
use crate::target::Target;
use coupler_curves::geometry::Point;

/// The shape of a curve, which can be computed on any thread.
#[derive(Clone, Copy)]
pub struct CurveShape(Shape);

impl CurveShape {
    /// Its length in bytes.
    pub(crate) const BYTES: usize = Shape::BYTES;

    /// The shape as bytes, the same on every machine.
    pub(crate) fn to_bytes(self) -> [u8; Shape::BYTES] {
        self.0.to_bytes()
    }

    /// The shape with these bytes.
    pub(crate) fn from_bytes(bytes: &[u8; Shape::BYTES]) -> CurveShape {
        CurveShape(Shape::from_bytes(bytes))
    }

    /// The shape of the curve through points. An open curve is one that is passed there and back. The points may be in any unit; of
    /// points without extent, or with a coordinate that is not finite, the shape is one that is like no target.
    pub fn new(points: &[Point], is_closed: bool) -> CurveShape {
        let Some(path) = CurvePath::new(points, is_closed) else { return CurveShape(Shape::EMPTY) };
        CurveShape::with_length(&Transform::new(), &path.even_points(EVEN), path.length(), path.is_open)
    }

    /// What depends neither on the curve's place, size and direction, nor on its first point, its order and reflections: of the harmonics of
    /// each order up to 10, in parts of the curve's size, the magnitudes of the one and of its opposite, the greater first. Of curves that are the
    /// same to a part of their size, each differs by about as much; that may be so of others, too.
    pub fn invariants(&self) -> impl Iterator<Item = f64> {
        let harmonics = self.0.harmonics().map(|[re, im]| f64::from(re * re + im * im).sqrt());
        (0..HARMONICS).flat_map(move |k| {
            let (a, b) = (harmonics[k], harmonics[HARMONICS + k]);
            [a.max(b), a.min(b)]
        })
    }

    /// That of a polyline that is passed around, or there and back along an open curve: of many points, so that it need not be smoothed.
    pub(crate) fn of_polyline(transform: &Transform, points: &[Complex], is_open: bool) -> CurveShape {
        CurveShape::with_length(transform, points, closed_length(points), is_open)
    }

    fn with_length(transform: &Transform, points: &[Complex], length: f64, is_open: bool) -> CurveShape {
        let (spectrum, Extent { size, .. }) = transform.spectrum(points);
        if !size.is_normal() {
            return CurveShape(Shape::EMPTY);
        }
        let shape = Shape::new(&spectrum.canonical(), length / size, true);
        CurveShape(if is_open { shape.of_open() } else { shape })
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

    /// An index without curves that has the memory for so many.
    pub fn with_capacity(count: usize) -> CurveIndex {
        let mut shapes = Shapes::new();
        shapes.reserve(count);
        CurveIndex(shapes)
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
///
/// A closed target is compared with the shapes in the index alone. An open one is like portions of many curves, which the few bytes of a shape
/// do not tell apart: more curves than are wanted are found, for each of which [`CurveLookup::likeness`] then says more closely how much it is
/// like the target.
pub struct CurveLookup {
    query: Query,
    options: CurveFitOptions,
    /// The length of the target in its sizes.
    length: f64,
    most: usize,
    best: Best,
    /// The curves of the indexes before.
    before: usize,
}

impl CurveLookup {
    /// Curves that are found for one that is wanted, if they are to be compared more closely.
    ///
    /// Of forty thirds of curves of an atlas with 7,800 after Hrones and Nelson, the curve itself was among the first 1,800 in 38 cases; compared
    /// more closely, it was among the first 120 in 36.
    const FOUND_PER_WANTED: usize = 15;

    /// Begins to look up a target, for a number of curves that are wanted. The options are those of the fits that follow; of these, that the
    /// curves stay where they are does not count.
    pub fn new(target: &Target, options: CurveFitOptions, wanted: usize) -> CurveLookup {
        let query = Query::new(target.kind(), &target.normalized());
        let per_wanted = if matches!(query, Query::Whole(..)) { 1 } else { CurveLookup::FOUND_PER_WANTED };
        let most = wanted.max(1).saturating_mul(per_wanted);
        CurveLookup { query, options, length: target.smooth_length(), most, best: Best::new(most), before: 0 }
    }

    /// The most curves that are found. If these are more than are wanted, they are to be compared more closely.
    pub fn most(&self) -> usize {
        self.most
    }

    /// Compares the curves of a range, or as many of them as the index has. A closed target takes some 20 ns for each, an open one 7
    /// µs.
    pub fn compare(&mut self, CurveIndex(shapes): &CurveIndex, range: Range<usize>) {
        let (best, first) = (&mut self.best, self.before);
        match &self.query {
            Query::Whole(spectrum, ..) => shapes.nearest((spectrum, self.length, false), (range, first), best),
            Query::Portion(stroke, _) => {
                shapes.nearest_portions_closely((stroke, self.options.least_portion), (range, first), best);
            }
        }
    }

    /// What is compared from now on is in another index: its curves have the numbers that follow those of this one.
    pub fn end_index(&mut self, index: &CurveIndex) {
        self.before += index.len();
    }

    /// The curves that have been found so far, the likeliest first: how much they are like the target, the more the greater, and their
    /// numbers.
    pub fn found(&self) -> impl Iterator<Item = (f64, usize)> {
        self.best.sorted().into_iter().map(|(likeness, number)| (f64::from(likeness), number))
    }

    /// How much the curve through points is like the target, the more the greater, compared more closely than in an index; `None` if it is not, or
    /// has no extent. It takes some 0.2 ms.
    pub fn likeness(&self, points: &[Point], is_closed: bool) -> Option<f64> {
        let path = CurvePath::new(points, is_closed)?;
        let curve = path.even_points(EVEN);
        match &self.query {
            Query::Whole(target, ..) => {
                let transform = Transform::new();
                let (spectrum, ..) = transform.spectrum(&curve);
                Some(transform.likeness(target, &spectrum).value)
            }
            Query::Portion(stroke, close_stroke) => {
                const PORTIONS: usize = 3;
                let found = portions((stroke, close_stroke), (&curve, path.is_open), &self.options, PORTIONS);
                found.first().map(|portion| -portion.residual)
            }
        }
    }
}
