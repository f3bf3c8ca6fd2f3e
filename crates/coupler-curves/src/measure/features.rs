//! What measures find on a curve: straight and circular portions, and symmetry.

use crate::geometry::{Point, Vector, trig};

/// The criterion by which the straight portion is selected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StraightCriterion {
    /// The longest portion whose strip is no wider than this part of its length.
    Tolerance(f64),
    /// The straightest portion that spans this much input, in degrees or as a length.
    Input(f64),
    /// The straightest portion of this length.
    Length(f64),
}

impl Default for StraightCriterion {
    fn default() -> StraightCriterion {
        StraightCriterion::Tolerance(0.001)
    }
}

/// A straight portion.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightPortion {
    /// The length of its projection on its line.
    pub length: f64,
    /// The greatest distance of its points from that line.
    pub deviation: f64,
    /// The input at which it begins.
    pub start_input: f64,
    /// The input it spans, which is counted forward and backward at limits.
    pub input_span: f64,
    /// Points of it, evenly spaced, with its ends.
    pub points: Vec<Point>,
}

/// A circular portion.
#[derive(Clone, Debug, PartialEq)]
pub struct Dwell {
    /// The centre of its circle.
    pub centre: Point,
    /// The radius of its circle.
    pub radius: f64,
    /// The greatest distance of its points from that circle.
    pub deviation: f64,
    /// The input at which it begins.
    pub start_input: f64,
    /// The input it spans, which is counted forward and backward at limits.
    pub input_span: f64,
    /// Points of it, evenly spaced, with its ends.
    pub points: Vec<Point>,
}

/// The symmetry of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetry {
    /// The axis about which it is symmetrical, or most nearly so; `None` for a circle, which has infinitely many.
    pub axis: Option<SymmetryAxis>,
    /// The greatest distance of its mirror image from it, relative to its greatest extent.
    pub residual: f64,
    /// The theorem by which it is symmetrical, if any.
    pub theorem: Option<&'static str>,
}

impl Symmetry {
    /// The greatest residual of a curve that is reported as symmetrical: much less than is visible on paper, and more
    /// than the error of its samples.
    pub const TOLERANCE: f64 = 1e-4;

    /// The greatest residual that is a measure of a curve: what is less symmetrical has no axis that an eye would see.
    pub const GREATEST: f64 = 0.01;

    /// The axis, if the curve is symmetrical.
    pub fn axis_if_symmetric(&self) -> Option<SymmetryAxis> {
        self.axis.filter(|_| self.residual <= Symmetry::TOLERANCE)
    }
}

/// A line about which a curve may be symmetrical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryAxis {
    /// A point on it.
    pub point: Point,
    /// Its direction, of length 1.
    pub direction: Vector,
}

impl SymmetryAxis {
    /// The line through a point in a direction; `None` if the direction is zero or not finite.
    pub fn new(through: Point, direction: Vector) -> Option<SymmetryAxis> {
        let along = direction.try_normalize(0.0).filter(|along| along.x.is_finite() && along.y.is_finite())?;
        Some(SymmetryAxis { point: through, direction: along })
    }

    /// The mirror image of a point.
    pub fn mirror(&self, point: Point) -> Point {
        let offset = point - self.point;
        self.point + self.direction * (2.0 * self.direction.dot(&offset)) - offset
    }

    /// The axis shifted to its left, and rotated by an angle in radians, to the first order.
    pub(super) fn moved(&self, shift: f64, turn: f64) -> Option<SymmetryAxis> {
        let across = Vector::new(-self.direction.y, self.direction.x);
        SymmetryAxis::new(self.point + across * shift, self.direction + across * turn)
    }

    /// Its direction from the x-axis, in degrees, from 0 up to 180.
    pub fn direction_deg(&self) -> f64 {
        let deg = trig::degrees(trig::atan2(self.direction.y, self.direction.x)).rem_euclid(180.0);
        // A direction that differs from 0 by rounding is 0.
        if (1e-9..180.0 - 1e-9).contains(&deg) { deg } else { 0.0 }
    }
}

/// The extremes of the input torque over a circuit.
#[derive(Clone, Copy, Debug)]
pub(super) struct InputTorque {
    /// The least and the greatest.
    pub range: [f64; 2],
    /// The greatest magnitude.
    pub peak: f64,
    /// The input there.
    pub peak_input: f64,
}

/// How far a curve moves across itself for errors of the lengths of its linkage.
#[derive(Clone, Debug)]
pub struct CurveMoves {
    /// The greatest move for a unit of each length; 0 where it is rounding.
    pub lengths: Vec<f64>,
    /// The greatest move for a unit of every length, each to its worse side.
    pub worst_case: f64,
    /// The greatest root of the sum of the squares of the moves for a unit of each length.
    pub root_sum_square: f64,
    /// Along the curve: points, and there the unit vector to the left of the curve, times the move for a unit of every length to its worse side.
    pub worst_along: Vec<(Point, Vector)>,
}
