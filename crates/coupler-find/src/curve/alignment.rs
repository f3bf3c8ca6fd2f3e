//! The similarity that takes a curve as near as possible to points in their order: Levenberg and Marquardt's method with distances
//! across the curve.

use crate::complex::{Complex, dot, length, mean, times_i};
use crate::curve::path::CurvePath;
use nalgebra::{Matrix4, Vector4};

/// A curve on points, each of which is matched with a place of it.
pub(crate) struct Alignment<'a> {
    path: &'a CurvePath,
    points: &'a [Complex],
    factor: Complex,
    shift: Complex,
    /// The points in order, in blocks that share a place.
    blocks: Vec<Block>,
    /// The sum of the squares of the distances.
    pub sum: f64,
}

/// Points that follow each other and share a place of the curve, the foot of their mean.
struct Block {
    points: std::ops::Range<usize>,
    mean: Complex,
    position: f64,
}

impl<'a> Alignment<'a> {
    /// The alignment under a similarity, with positions on the curve near which the points have their feet.
    pub fn new(
        path: &'a CurvePath,
        points: &'a [Complex],
        (factor, shift): (Complex, Complex),
        near: &[f64],
    ) -> Alignment<'a> {
        let blocks = blocks(path, points, (factor, shift), near);
        let sum = sum_of(path, points, (factor, shift), &blocks);
        Alignment { path, points, factor, shift, blocks, sum }
    }

    pub fn similarity(&self) -> (Complex, Complex) {
        (self.factor, self.shift)
    }

    /// The positions of the first and of the last point.
    pub fn ends(&self) -> [f64; 2] {
        [0, self.blocks.len() - 1].map(|k| self.blocks[k].position)
    }

    /// Whether each point has its own foot, without the order keeping it from there.
    pub fn is_in_order(&self) -> bool {
        self.blocks.len() == self.points.len()
    }

    /// The greatest distance.
    pub fn greatest(&self) -> f64 {
        squares(self.path, self.points, self.similarity(), &self.blocks).fold(0.0, f64::max).sqrt()
    }

    /// Moves the similarity to where the sum is least, in some steps at most.
    pub fn refine(&mut self, steps: usize) {
        const MAX_DAMPING: f64 = 1e10;
        /// A relative gain that is no progress.
        const NO_GAIN: f64 = 1e-12;
        let mut damping = 1e-4;
        let mut equations = self.normal_equations();
        for _ in 0..steps {
            let (normal, gradient) = equations;
            let floor = 1e-12 * normal.trace();
            let damped = normal
                + Matrix4::from_diagonal(
                    &normal.diagonal().map(|entry| damping * entry.max(floor).max(f64::MIN_POSITIVE)),
                );
            let Some(matrix) = damped.cholesky() else { break };
            let by = matrix.solve(&gradient);
            let similarity = (self.factor + Complex::new(by[0], by[1]), self.shift + Complex::new(by[2], by[3]));
            let blocks = blocks(self.path, self.points, similarity, &self.positions());
            let sum = sum_of(self.path, self.points, similarity, &blocks);
            if sum < self.sum {
                let gain = self.sum - sum;
                (self.factor, self.shift) = similarity;
                (self.blocks, self.sum) = (blocks, sum);
                if gain <= NO_GAIN * sum {
                    break;
                }
                damping = (0.1 * damping).max(1e-12);
                equations = self.normal_equations();
            } else {
                damping *= 10.0;
                if damping > MAX_DAMPING {
                    break;
                }
            }
        }
    }

    fn positions(&self) -> Vec<f64> {
        self.blocks.iter().flat_map(|block| block.points.clone().map(|_| block.position)).collect()
    }

    /// The normal equations of the distances across the curve.
    fn normal_equations(&self) -> (Matrix4<f64>, Vector4<f64>) {
        let (mut normal, mut gradient) = (Matrix4::zeros(), Vector4::zeros());
        for block in &self.blocks {
            let at = self.path.point(block.position);
            let velocity = self.factor * self.path.velocity(block.position);
            let offset = block.mean - (self.factor * at + self.shift);
            let speed = length(velocity);
            let mut add = |axis: Complex| {
                let row = Vector4::new(dot(axis, at), dot(axis, times_i(at)), axis.re, axis.im);
                let weight = block.points.len() as f64;
                normal += row * row.transpose() * weight;
                gradient += row * (weight * dot(axis, offset));
            };
            // At a corner, and where the curve stops, the foot does not move along it.
            let is_foot = dot(velocity, offset).abs() <= 1e-6 * speed * length(offset) || length(offset) <= 1e-12;
            if speed > 0.0 && is_foot {
                add(times_i(velocity) / speed);
            } else {
                add(Complex::new(1.0, 0.0));
                add(Complex::new(0.0, 1.0));
            }
        }
        (normal, gradient)
    }
}

/// The feet of points in their order. Where those of neighbours would change it, these share the foot of their mean: of all common feet
/// it has the least sum of squares (pool adjacent violators).
fn blocks(path: &CurvePath, points: &[Complex], (factor, shift): (Complex, Complex), near: &[f64]) -> Vec<Block> {
    let foot = |points_of: std::ops::Range<usize>, near: f64| {
        let mean = mean(&points[points_of.clone()]);
        let position = path.foot(near, (mean - shift) / factor);
        Block { points: points_of, mean, position }
    };
    let mut blocks: Vec<Block> = Vec::with_capacity(points.len());
    for (k, near) in near.iter().enumerate() {
        let mut block = foot(k..k + 1, *near);
        while let Some(last) = blocks.pop() {
            if last.position <= block.position {
                blocks.push(last);
                break;
            }
            block = foot(last.points.start..block.points.end, last.position);
        }
        blocks.push(block);
    }
    blocks
}

fn sum_of(path: &CurvePath, points: &[Complex], similarity: (Complex, Complex), blocks: &[Block]) -> f64 {
    squares(path, points, similarity, blocks).sum()
}

/// The squares of the distances of the points.
fn squares(
    path: &CurvePath,
    points: &[Complex],
    (factor, shift): (Complex, Complex),
    blocks: &[Block],
) -> impl Iterator<Item = f64> {
    blocks.iter().flat_map(move |block| {
        let at = factor * path.point(block.position) + shift;
        points[block.points.clone()].iter().map(move |point| (point - at).norm_sqr())
    })
}
