//! A function that is given by an expression, and how its variables are scaled to angles or lengths.

use coupler_curves::expression::{CompiledExpression, Expression, Kind, Scope};
use coupler_curves::numerical::maximum;

/// A function y = f(x) over a range of x, of which x is the travel of an input and y that of an output.
///
/// The input turns by its range while x goes from the first to the last value. The output goes by its range while y goes from its value at the first
/// x to that at the last; if y is not monotonic its range is from the least y to the greatest, and positive if y has risen in the end, or
/// is as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    expression: CompiledExpression,
    /// The name of x.
    variable: String,
    /// The range of x.
    x: [f64; 2],
    /// The range of the input, in radians.
    travel: f64,
    /// The value of y at the first x, and the output for each unit of y.
    y_first: f64,
    output_per_y: f64,
}

/// Why an expression is no function to generate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// It has no value somewhere.
    #[error("y is {value} at x = {x}: it must be a finite number over the whole range")]
    Undefined {
        /// Where.
        x: f64,
        /// What it is there.
        value: f64,
    },
    /// It is constant.
    #[error("y is {value} for all x: a constant needs no linkage")]
    Constant {
        /// Its value.
        value: f64,
    },
}

/// The parts of the range in which extremes are looked for, and at whose ends the function must have a value.
const PARTS: usize = 720;

impl Law {
    /// The function of an expression of a variable, between two values of it, for an input of `travel` radians and an output of `range` radians or units of
    /// length. All numbers are finite, and the values of x and the ranges are not 0.
    ///
    /// # Errors
    /// It is not defined at one of 720 equal parts of the range, or constant. An expression of other names has no value.
    pub fn new(expression: &Expression, variable: &str, x: [f64; 2], travel: f64, range: f64) -> Result<Law, LawError> {
        let scope = Scope::from_numbers([variable]);
        let undefined = LawError::Undefined { x: x[0], value: f64::NAN };
        let expression = expression.compile(&scope, Kind::Number).map_err(|_| undefined)?;
        let mut law = Law { expression, variable: variable.to_owned(), x, travel, y_first: 0.0, output_per_y: 1.0 };
        let at = |k: usize| travel * k as f64 / PARTS as f64;
        let values: Vec<f64> = (0..=PARTS).map(|k| law.y(at(k))).collect();
        if let Some(k) = values.iter().position(|value| !value.is_finite()) {
            return Err(LawError::Undefined { x: law.x_at(at(k)), value: values[k] });
        }
        let extreme = |sign: f64| {
            let best = (0..=PARTS).max_by(|a, b| (sign * values[*a]).total_cmp(&(sign * values[*b]))).unwrap_or(0);
            let around = [at(best.saturating_sub(1)), at((best + 1).min(PARTS))];
            let inner = maximum(around, 1e-9 * travel.abs(), |travel| sign * law.y(travel)).value;
            (sign * values[best]).max(inner)
        };
        let span = extreme(1.0) + extreme(-1.0);
        let size = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        // A span within the rounding of the values is none.
        if !(span > 1e-12 * size && span.is_finite()) {
            return Err(LawError::Constant { value: values[0] });
        }
        let falls = values[PARTS] < values[0];
        law.y_first = values[0];
        law.output_per_y = if falls { -range / span } else { range / span };
        Ok(law)
    }

    /// The same with the output as many times greater.
    pub(super) fn scaled(&self, factor: f64) -> Law {
        Law { output_per_y: factor * self.output_per_y, ..self.clone() }
    }

    /// The range of the input, in radians.
    pub fn travel(&self) -> f64 {
        self.travel
    }

    /// The name of x.
    pub fn variable(&self) -> &str {
        &self.variable
    }

    /// The range of x.
    pub fn x_range(&self) -> [f64; 2] {
        self.x
    }

    /// The x of a travel of the input.
    pub fn x_at(&self, travel: f64) -> f64 {
        let part = travel / self.travel;
        // Both ends are exact.
        self.x[0] * (1.0 - part) + self.x[1] * part
    }

    fn y(&self, travel: f64) -> f64 {
        let x = self.x_at(travel);
        self.expression.evaluate(|_| x)
    }

    /// The wanted output at a travel of the input, from that at the start.
    pub fn wanted(&self, travel: f64) -> f64 {
        self.output_per_y * (self.y(travel) - self.y_first)
    }

    /// Travels of the input in Chebyshev's spacing: the zeros of his polynomial of this degree over the range.
    pub fn chebyshev_travels(&self, count: usize) -> Vec<f64> {
        let part = |k: usize| {
            let angle = std::f64::consts::PI * (2 * k + 1) as f64 / (2 * count) as f64;
            0.5 - 0.5 * coupler_curves::geometry::trig::cos(angle)
        };
        (0..count).map(|k| self.travel * part(k)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::geometry::trig;

    fn law(text: &str, x: [f64; 2], travel: f64, range: f64) -> Result<Law, LawError> {
        Law::new(&Expression::parse(text).unwrap(), "x", x, travel, range)
    }

    #[test]
    fn the_output_goes_by_its_range_while_y_does() {
        let log = law("log10(x)", [1.0, 10.0], 1.0, 1.5).unwrap();
        assert_eq!([log.wanted(0.0), log.wanted(1.0)], [0.0, 1.5]);
        assert!((log.wanted(0.5) - 1.5 * trig::log10(5.5)).abs() < 1e-15);
        // Svoboda's points: for 1 to 2 and three points the x are 1.0670, 1.5 and 1.9330.
        let travels = law("log10(x)", [1.0, 2.0], 1.0, 1.0).unwrap().chebyshev_travels(3);
        for (travel, x) in travels.iter().zip([0.066_987, 0.5, 0.933_013]) {
            assert!((travel - x).abs() < 1e-6);
        }
        // A falling function still goes by the range from its first to its last value.
        let falling = law("1/x", [1.0, 2.0], -1.0, 2.0).unwrap();
        assert!((falling.wanted(-1.0) - 2.0).abs() < 1e-12);
        // Of a function that rises and falls, the range is that of all values.
        let hill = law("x * (1 - x)", [0.0, 1.0], 1.0, 2.0).unwrap();
        assert!((hill.wanted(0.5) - 2.0).abs() < 1e-12 && hill.wanted(1.0).abs() < 1e-12);
        let dale = law("x * (x - 1.2)", [0.0, 1.0], 1.0, 2.0).unwrap();
        let greatest = dale.wanted(0.6);
        assert!((greatest - 2.0).abs() < 1e-9, "y falls in the end: {greatest}");
    }

    #[test]
    fn a_function_without_values_or_a_constant_is_refused() {
        assert!(matches!(law("log10(x)", [-1.0, 1.0], 1.0, 1.0), Err(LawError::Undefined { x, .. }) if x == -1.0));
        assert!(matches!(law("1/x", [-1.0, 1.0], 1.0, 1.0), Err(LawError::Undefined { x, .. }) if x == 0.0));
        assert_eq!(law("3", [0.0, 1.0], 1.0, 1.0), Err(LawError::Constant { value: 3.0 }));
    }
}
