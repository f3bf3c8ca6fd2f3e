//! The parameters of a template.

use crate::expression::{Dimension, Error, Expression, Function, Unit, length_unit_help};

/// A parameter of a template.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// What it is a number of.
    pub kind: ParameterKind,
    /// Its value where a family gives none; may use the other parameters.
    pub default: Option<Expression>,
    /// That value as it is written; empty if there is none.
    pub default_text: String,
    /// A value for a family to start from, where there is no default.
    pub example: Option<f64>,
    /// Its least value; a bound of 0 is itself excluded.
    pub min: Option<f64>,
    /// Its greatest value; a bound of 0 is itself excluded.
    pub max: Option<f64>,
}

impl Parameter {
    /// A value to start from where there is no default: the example, or 1 without one.
    pub fn starting_value(&self) -> f64 {
        self.example.unwrap_or(1.0)
    }

    /// The error in a value: not finite, or out of the bounds.
    pub fn value_error(&self, value: f64) -> Option<String> {
        let name = &self.name;
        if !value.is_finite() {
            return Some(format!("`{name}` is {value}, which is not a finite number"));
        }
        match (self.min, self.max) {
            (Some(0.0), _) if value <= 0.0 => Some(format!("`{name}` is {value}, and must be more than 0")),
            (Some(min), _) if value < min => Some(format!("`{name}` is {value}, below its least value of {min}")),
            (_, Some(0.0)) if value >= 0.0 => Some(format!("`{name}` is {value}, and must be less than 0")),
            (_, Some(max)) if value > max => Some(format!("`{name}` is {value}, above its greatest value of {max}")),
            _ => None,
        }
    }

    /// The values within its bounds, in words: "of more than 0", "from 1 to 5"; `None` if it has no bounds.
    pub fn allowed(&self) -> Option<String> {
        let least = |min: f64| if min == 0.0 { "of more than 0".to_owned() } else { format!("of at least {min}") };
        let most = |max: f64| if max == 0.0 { "of less than 0".to_owned() } else { format!("of at most {max}") };
        match (self.min, self.max) {
            (None, None) => None,
            (Some(min), None) => Some(least(min)),
            (None, Some(max)) => Some(most(max)),
            (Some(min), Some(max)) if min != 0.0 && max != 0.0 => Some(format!("from {min} to {max}")),
            (Some(min), Some(max)) => Some(format!("{} and {}", least(min), most(max).trim_start_matches("of "))),
        }
    }
}

/// What a parameter is a number of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ParameterKind {
    /// Units of length, the manifest's own.
    Length,
    /// Degrees or radians.
    Angle(Unit),
    /// A ratio.
    Ratio,
    /// A number of which it is not known what it counts.
    #[default]
    Number,
}

impl ParameterKind {
    /// "length", "angle in degrees".
    pub fn name(self) -> &'static str {
        match self {
            ParameterKind::Length => "length",
            ParameterKind::Angle(Unit::Rad) => "angle in radians",
            ParameterKind::Angle(_) => "angle in degrees",
            ParameterKind::Ratio => "ratio",
            ParameterKind::Number => "number",
        }
    }

    /// "a length", "an angle in degrees".
    pub fn description(self) -> String {
        let article = if matches!(self, ParameterKind::Angle(_)) { "an" } else { "a" };
        format!("{article} {}", self.name())
    }

    /// Parses a value of the parameter: an expression, which for an angle may have a unit, `deg` or `rad`. The expression
    /// returned is in the unit of the parameter.
    ///
    /// # Errors
    /// What is not an expression; a unit where there is none; a number of degrees for radians, or the reverse, which the
    /// outermost function shows.
    pub fn parse_value(self, name: &str, text: &str) -> Result<Expression, Error> {
        let (expression, unit) = Expression::parse_with_angle_unit(text, |word| self.unit_help(word))?;
        match self.conversion(name, unit, expression.outermost_function()) {
            Ok(None) => Ok(expression),
            Ok(Some(function)) => Ok(expression.with_function(function)),
            Err([message, help]) => Err(Error::new(0..text.len(), message, help)),
        }
    }

    /// Parses a value of a parameter of which it is not known what it is a number of: an expression, which may have a unit of angles.
    ///
    /// # Errors
    /// What is not an expression, and another unit.
    pub(crate) fn parse_any_value(text: &str) -> Result<Expression, Error> {
        let parsed = Expression::parse_with_angle_unit(text, |word| ParameterKind::Number.unit_help(word));
        parsed.map(|(expression, _)| expression)
    }

    /// What to do about a word after a value that is no unit of an angle.
    pub(crate) fn unit_help(self, word: &str) -> String {
        let length = || length_unit_help(word);
        match self {
            ParameterKind::Angle(_) => Dimension::Angle.example().to_owned(),
            ParameterKind::Length => length().unwrap_or_else(|| "give a length as a number without a unit".to_owned()),
            ParameterKind::Ratio => "give a ratio as a number without a unit".to_owned(),
            ParameterKind::Number => length().unwrap_or_else(|| {
                "an angle may have the unit `deg` or `rad`; lengths and ratios are numbers without a unit".to_owned()
            }),
        }
    }

    /// The function that turns a number with a unit, if any, into one of the parameter; `function` is the one that
    /// returns the number, if any.
    ///
    /// # Errors
    /// A message and a help: of a unit where there is none, or a function that returns the other unit.
    pub(crate) fn conversion(
        self,
        name: &str,
        unit: Option<Unit>,
        function: Option<Function>,
    ) -> Result<Option<Function>, [String; 2]> {
        let words = |unit| if unit == Unit::Rad { "radians" } else { "degrees" };
        let own = match (self, unit) {
            (ParameterKind::Angle(own), _) => own,
            (_, None) => return Ok(None),
            (kind, Some(unit)) => {
                let message = format!("`{name}` is {}, and takes no {}", kind.description(), words(unit));
                return Err([message, "give a number without a unit".to_owned()]);
            }
        };
        let stated = unit.unwrap_or(own);
        let returned = function.and_then(Function::angle_unit).unwrap_or(stated);
        if returned != stated {
            let function = function.map_or("", Function::name);
            let message = format!("`{function}` returns {}, and `{name}` is {}", words(returned), self.description());
            let help = match function {
                "deg" | "rad" => format!("leave `{function}` out, or state the unit, as in \"30 deg\""),
                _ => format!("state the unit: write \"{function}(…) rad\""),
            };
            return Err([message, help]);
        }
        Ok(match (stated, own) {
            (Unit::Deg, Unit::Rad) => Some(Function::Rad),
            (Unit::Rad, Unit::Deg) => Some(Function::Deg),
            _ => None,
        })
    }
}
