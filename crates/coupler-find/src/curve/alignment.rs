//! The similarity that takes a curve as near as possible to points in their order, by the distances across the curve.

use coupler_curves::geometry::Similarity;
use nalgebra::{Const, Vector4};

use crate::complex::{Complex, dot, length, times_i};
use crate::curve::path::CurvePath;
use crate::descent::{Candidate, Descent, Equations};
use crate::matching::{Block, feet_in_order, feet_of_points, squares};

/// A curve on points, each of which is matched with a place of it.
pub(crate) struct Alignment<'a> {
    path: &'a CurvePath,
    points: &'a [Complex],
    pub placed: Similarity,
    /// The points in order; a foot is a position on the curve.
    blocks: Vec<Block<f64>>,
    /// The sum of the squares of the distances.
    pub sum: f64,
}

impl<'a> Alignment<'a> {
    /// The alignment under a similarity, with positions on the curve near which the points have their feet.
    pub fn new(
        path: &'a CurvePath,
        points: &'a [Complex],
        placed: Similarity,
        near: impl IntoIterator<Item = f64>,
    ) -> Option<Alignment<'a>> {
        let foot = |point: Complex, near: f64| path.foot(near, placed.preimage(point));
        let feet = points.iter().zip(near).map(|(point, near)| foot(*point, near));
        let blocks = feet_in_order(points, feet, |foot| *foot, |mean, near| Some(foot(mean, near)))?;
        let mut alignment = Alignment { path, points, placed, blocks, sum: 0.0 };
        alignment.sum = alignment.squares().iter().sum();
        Some(alignment)
    }

    fn squares(&self) -> Vec<f64> {
        let at: Vec<Complex> = self.blocks.iter().map(|block| self.placed.image(self.path.point(block.foot))).collect();
        squares(self.points, &self.blocks, &at)
    }

    /// The positions of the first and of the last point.
    pub fn ends(&self) -> [f64; 2] {
        [0, self.blocks.len() - 1].map(|k| self.blocks[k].foot)
    }

    /// Whether each point has its own foot, without the order keeping it from there.
    pub fn is_in_order(&self) -> bool {
        self.blocks.len() == self.points.len()
    }

    /// The greatest distance.
    pub fn greatest(&self) -> f64 {
        self.squares().into_iter().fold(0.0, f64::max).sqrt()
    }

    /// Moves the similarity to where the sum is least, in some steps at most.
    pub fn refine(&mut self, steps: usize) {
        let mut descent = Descent::default();
        (0..steps).for_each(|_| descent.step(self, &()));
    }
}

impl Candidate for Alignment<'_> {
    type Unknowns = Const<4>;
    type Aim<'a> = ();
    const NO_GAIN: f64 = 1e-12;

    fn objective(&self) -> f64 {
        self.sum
    }

    fn equations(&self, _: &()) -> Option<Equations<Const<4>>> {
        let mut equations = Equations::new(Const::<4>);
        for block in &self.blocks {
            let at = self.path.point(block.foot);
            let velocity = self.placed.direction(self.path.velocity(block.foot));
            let offset = block.mean - self.placed.image(at);
            let speed = length(velocity);
            // At a corner, and where the curve stops, the foot does not move along it.
            let is_foot = dot(velocity, offset).abs() <= 1e-6 * speed * length(offset) || length(offset) <= 1e-12;
            for axis in axes(velocity, speed > 0.0 && is_foot) {
                let row = similarity_rates(axis, self.placed.reflected(at));
                equations.add(&row, dot(axis, offset), block.points.len() as f64);
            }
        }
        Some(equations)
    }

    fn moved(&self, _: &(), by: &Vector4<f64>) -> Option<Self> {
        let placed = moved_similarity(&self.placed, [by[0], by[1], by[2], by[3]]);
        Alignment::new(self.path, self.points, placed, feet_of_points(&self.blocks))
    }
}

/// The directions in which the distance of a point counts: across the curve, if its foot follows the curve, or else both of the plane.
pub(crate) fn axes(velocity: Complex, is_foot: bool) -> impl Iterator<Item = Complex> {
    let first = if is_foot { times_i(velocity) / length(velocity) } else { Complex::new(1.0, 0.0) };
    std::iter::once(first).chain((!is_foot).then_some(Complex::new(0.0, 1.0)))
}

/// The derivatives of a placed point's coordinate in a direction by the factor and the shift of the similarity; the point is given after the
/// reflection.
pub(crate) fn similarity_rates(axis: Complex, reflected: Complex) -> [f64; 4] {
    [dot(axis, reflected), dot(axis, times_i(reflected)), axis.re, axis.im]
}

/// The similarity after a motion of its factor and its shift.
pub(crate) fn moved_similarity(placed: &Similarity, [re, im, x, y]: [f64; 4]) -> Similarity {
    Similarity { factor: placed.factor + Complex::new(re, im), shift: placed.shift + Complex::new(x, y), ..*placed }
}
