//! Vectors whose coordinates are expressions.

use std::ops::Sub;

use crate::expression::{CompiledExpression, Function};

/// A point of a drawing, or the vector from one to another.
#[derive(Clone, Debug)]
pub(super) struct DrawnVector(pub [CompiledExpression; 2]);

impl DrawnVector {
    /// Its length.
    pub fn length(&self) -> CompiledExpression {
        CompiledExpression::call(Function::Hypot, self.0.clone())
    }

    pub fn dot(&self, other: &DrawnVector) -> CompiledExpression {
        let ([x, y], [u, v]) = (self.0.clone(), other.0.clone());
        x * u + y * v
    }

    /// The cross product, positive where the other vector is to the left.
    pub fn cross(&self, other: &DrawnVector) -> CompiledExpression {
        let ([x, y], [u, v]) = (self.0.clone(), other.0.clone());
        x * v - y * u
    }

    /// How far another vector goes in the direction of this one.
    pub fn along(&self, other: &DrawnVector) -> CompiledExpression {
        self.dot(other) / self.length()
    }

    /// How far another vector goes to the left of this one.
    pub fn across(&self, other: &DrawnVector) -> CompiledExpression {
        self.cross(other) / self.length()
    }

    /// How far another vector goes in the direction of this one, and to its left.
    pub fn components(&self, other: &DrawnVector) -> [CompiledExpression; 2] {
        [self.along(other), self.across(other)]
    }

    /// The angle to another vector, in radians.
    pub fn angle_to(&self, other: &DrawnVector) -> CompiledExpression {
        CompiledExpression::call(Function::Atan2, [self.cross(other), self.dot(other)])
    }

    /// The sine of the angle to another vector.
    pub fn sine(&self, other: &DrawnVector) -> CompiledExpression {
        self.across(other) / other.length()
    }
}

impl Sub for &DrawnVector {
    type Output = DrawnVector;

    fn sub(self, other: &DrawnVector) -> DrawnVector {
        let ([x, y], [u, v]) = (self.0.clone(), other.0.clone());
        DrawnVector([x - u, y - v])
    }
}
