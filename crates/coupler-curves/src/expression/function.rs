//! The functions of expressions.

use super::Unit;
use crate::geometry::trig;

/// A function an expression can call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Square root.
    Sqrt,
    /// Sine of radians.
    Sin,
    /// Cosine of radians.
    Cos,
    /// Tangent of radians.
    Tan,
    /// Arc sine, in radians.
    Asin,
    /// Arc cosine, in radians.
    Acos,
    /// `atan2(y, x)`: the direction of the vector (x, y), in radians from -pi to pi.
    Atan2,
    /// The exponential, e to a power.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The logarithm to base 10.
    Log10,
    /// Magnitude.
    Abs,
    /// The least of one or more numbers.
    Min,
    /// The greatest of one or more numbers.
    Max,
    /// `hypot(x, y)`: the length of the vector (x, y).
    Hypot,
    /// Radians to degrees.
    Deg,
    /// Degrees to radians.
    Rad,
}

impl Function {
    /// Every function by the name it is called with.
    pub const ALL: [(&'static str, Function); 16] = [
        ("sqrt", Function::Sqrt),
        ("sin", Function::Sin),
        ("cos", Function::Cos),
        ("tan", Function::Tan),
        ("asin", Function::Asin),
        ("acos", Function::Acos),
        ("atan2", Function::Atan2),
        ("exp", Function::Exp),
        ("ln", Function::Ln),
        ("log10", Function::Log10),
        ("abs", Function::Abs),
        ("min", Function::Min),
        ("max", Function::Max),
        ("hypot", Function::Hypot),
        ("deg", Function::Deg),
        ("rad", Function::Rad),
    ];

    /// The function of a name.
    pub fn from_name(name: &str) -> Option<Function> {
        Function::ALL.iter().find(|(n, _)| *n == name).map(|&(_, f)| f)
    }

    /// The name it is called with.
    pub fn name(self) -> &'static str {
        Function::ALL.iter().find(|(_, function)| *function == self).map_or("", |(name, _)| name)
    }

    /// The unit of its value, if that is an angle.
    pub fn angle_unit(self) -> Option<Unit> {
        match self {
            Function::Deg => Some(Unit::Deg),
            Function::Rad | Function::Asin | Function::Acos | Function::Atan2 => Some(Unit::Rad),
            _ => None,
        }
    }

    /// The unit of its argument, if that is an angle.
    pub(super) fn argument_unit(self) -> Option<Unit> {
        match self {
            Function::Sin | Function::Cos | Function::Tan | Function::Deg => Some(Unit::Rad),
            Function::Rad => Some(Unit::Deg),
            _ => None,
        }
    }

    /// The least and the greatest number of arguments.
    pub fn arity(self) -> (usize, usize) {
        match self {
            Function::Atan2 | Function::Hypot => (2, 2),
            Function::Min | Function::Max => (1, usize::MAX),
            _ => (1, 1),
        }
    }

    /// The value; NaN where the function is not defined, or an argument is missing.
    pub(super) fn call(self, arguments: &[f64]) -> f64 {
        let x = arguments[0];
        match self {
            Function::Sqrt => x.sqrt(),
            Function::Sin => trig::sin(x),
            Function::Cos => trig::cos(x),
            Function::Tan => trig::tan(x),
            Function::Asin => trig::asin(x),
            Function::Acos => trig::acos(x),
            Function::Atan2 => trig::atan2(x, arguments[1]),
            Function::Exp => trig::exp(x),
            Function::Ln => trig::ln(x),
            Function::Log10 => trig::log10(x),
            Function::Abs => x.abs(),
            Function::Min => arguments.iter().copied().fold(f64::INFINITY, min_or_nan),
            Function::Max => -arguments.iter().map(|x| -x).fold(f64::INFINITY, min_or_nan),
            Function::Hypot => trig::hypot(x, arguments[1]),
            Function::Deg => trig::degrees(x),
            Function::Rad => trig::radians(x),
        }
    }
}

/// The lesser of two numbers; NaN if either is, unlike `f64::min`.
fn min_or_nan(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) }
}
