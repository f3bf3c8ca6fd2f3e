//! A parameter and its value as one word: `p=2`.

use crate::expression::Expression;

/// Why a word is not a parameter with its value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}`: {message}; write it like p=2 or \"a=sqrt(2)\"")]
pub struct ParameterSyntaxError {
    /// The word, or its value if only that is wrong.
    pub text: String,
    /// What is wrong.
    pub message: String,
}

/// Parses `name=value`, where the value is a number or an expression without names. Whether there is such a parameter,
/// and whether it may have this value, is not checked.
///
/// # Errors
/// There is no `=`, or the value is no such expression.
pub fn parse_parameter(text: &str) -> Result<(String, f64), ParameterSyntaxError> {
    let error = |text: &str, message: String| ParameterSyntaxError { text: text.to_owned(), message };
    let (name, value) = text.split_once('=').ok_or_else(|| error(text, "there is no `=`".to_owned()))?;
    let number = Expression::evaluate_constant(value).map_err(|constant| error(value, constant.message))?;
    Ok((name.trim().to_owned(), number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_constant_expressions() {
        assert_eq!(parse_parameter(" p = 2^2"), Ok(("p".to_owned(), 4.0)));
        let message = |text| parse_parameter(text).unwrap_err().to_string();
        assert_eq!(message("p"), "`p`: there is no `=`; write it like p=2 or \"a=sqrt(2)\"");
        assert_eq!(message("p=2*a"), "`2*a`: `a` has no value here; write it like p=2 or \"a=sqrt(2)\"");
        assert!(message("p=2*").starts_with("`2*`: "));
    }
}
