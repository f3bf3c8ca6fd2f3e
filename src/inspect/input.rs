//! Inputs of linkages as users write them.

use coupler_curves::expression::{Dimension, Error, Expression, Quantity, Scope};

/// Reads an input: a number or an expression without names, and for an angle a unit, degrees if there is none. `example`
/// is shown in the error.
///
/// # Errors
/// It is none, or an angle where the input is a length.
pub fn parse_input(text: &str, is_length: bool, example: &str) -> Result<f64, String> {
    let error = |error: Error| format!("`{text}`: {error}; write it like {example}");
    match Quantity::parse(text, Dimension::Angle) {
        Ok(_) if is_length => Err(format!("`{text}` is an angle, and the input is a length: write it like {example}")),
        Ok(quantity) => {
            quantity.expression.check(&Scope::default()).map_err(error)?;
            Ok(quantity.evaluate(|_| f64::NAN))
        }
        // Without a unit.
        Err(_) => Expression::evaluate_constant(text).map_err(error),
    }
}
