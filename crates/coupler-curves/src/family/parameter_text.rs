//! A parameter and its value as one word: `p=2`.

use crate::expression::{Expression, Function, Unit};
use crate::template::{ParameterKind, Template};

/// A parameter and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterText {
    /// The name.
    pub name: String,
    /// The number.
    pub number: f64,
    /// Its unit, if it has one.
    pub unit: Option<Unit>,
    /// The function that returns the number, if its result is an angle.
    function: Option<Function>,
}

/// Why a word is not a parameter with its value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}`: {message}; write it like p=2, \"a=sqrt(2)\" or \"phase=30 deg\"")]
pub struct ParameterSyntaxError {
    /// The word, or its value if only that is wrong.
    pub text: String,
    /// What is wrong.
    pub message: String,
}

/// A value is not one that its parameter can have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}: {help}")]
pub struct ParameterUnitError {
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}

impl ParameterText {
    /// A name and a number without a unit.
    pub fn from_number(name: String, number: f64) -> ParameterText {
        ParameterText { name, number, unit: None, function: None }
    }

    /// Parses `name=value`, where the value is a number or an expression without names, and may have a unit of angles.
    /// Whether there is such a parameter, and whether it may have this value, is not checked.
    ///
    /// # Errors
    /// There is no `=`, or the value is no such expression.
    pub fn parse(text: &str) -> Result<ParameterText, ParameterSyntaxError> {
        let error = |text: &str, message: String| ParameterSyntaxError { text: text.to_owned(), message };
        let (name, value) = text.split_once('=').ok_or_else(|| error(text, "there is no `=`".to_owned()))?;
        let parsed = Expression::parse_with_angle_unit(value, |word| ParameterKind::Number.unit_help(word))
            .and_then(|(expression, unit)| Ok((expression.constant_value()?, unit, expression.outermost_function())));
        let (number, unit, function) = parsed.map_err(|wrong| error(value, wrong.message))?;
        let function = function.filter(|function| function.angle_unit().is_some());
        Ok(ParameterText { name: name.trim().to_owned(), number, unit, function })
    }

    /// The name and the value in the unit that the parameter of this name has in a linkage; of a name that is not a
    /// parameter, the number.
    ///
    /// # Errors
    /// A unit where there is none, or a number of degrees for radians, or the reverse.
    pub fn resolve(&self, template: &Template) -> Result<(String, f64), ParameterUnitError> {
        let parameter = template.parameters.iter().find(|parameter| parameter.name == self.name);
        let kind = parameter.map_or(ParameterKind::Number, |parameter| parameter.kind);
        let conversion = kind.conversion(&self.name, self.unit, self.function);
        let function = conversion.map_err(|[message, help]| ParameterUnitError { message, help })?;
        let number = Expression::constant(self.number);
        let number = function.map_or(number.clone(), |function| number.with_function(function));
        Ok((self.name.clone(), number.evaluate(|_| f64::NAN)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    #[test]
    fn values_are_constant_expressions() {
        assert_eq!(ParameterText::parse(" p = 2^2"), Ok(ParameterText::from_number("p".to_owned(), 4.0)));
        let message = |text| ParameterText::parse(text).unwrap_err().to_string();
        let form = "write it like p=2, \"a=sqrt(2)\" or \"phase=30 deg\"";
        assert_eq!(message("p"), format!("`p`: there is no `=`; {form}"));
        assert_eq!(message("p=2*a"), format!("`2*a`: `a` has no value here; {form}"));
        assert!(message("p=2*").starts_with("`2*`: "));
        assert!(message("p=2 mm").starts_with("`2 mm`: `mm` is not a unit here"));
    }

    #[test]
    fn angles_are_converted_to_the_unit_of_the_parameter() {
        let template = catalogue::find("geared-five-bar").unwrap();
        let value = |text: &str| ParameterText::parse(text).unwrap().resolve(&template).map(|(_, value)| value);
        for text in ["phase=90", "phase=90 deg", "phase=pi/2 rad", "phase=acos(0) rad", "phase=deg(pi/2)"] {
            assert_eq!(value(text), Ok(90.0), "{text}");
        }
        for (text, message) in [
            ("phase=acos(0)", "`acos` returns radians, and `phase` is an angle in degrees"),
            ("phase=rad(90)", "`rad` returns radians, and `phase` is an angle in degrees"),
            ("a=30 deg", "`a` is a length, and takes no degrees"),
        ] {
            assert_eq!(value(text).unwrap_err().message, message);
        }
    }
}
