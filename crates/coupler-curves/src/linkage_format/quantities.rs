//! Reads values of parameters, inputs and other quantities, which may have units.

use toml::de::DeValue;

use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::{CompiledExpression, Dimension, Expression, Kind, Quantity, Scope};
use crate::problem::Problem;
use crate::template::{InputValue, ParameterKind};

/// What the input of a linkage is, as far as its joints can be read.
#[derive(Clone, Copy, Debug)]
pub enum InputKind {
    /// The angle of a crank, and whether a link slides, whose displacement might be taken for the input.
    Angle {
        /// Whether one does.
        has_slider: bool,
    },
    /// The length of an actuator.
    Length,
    /// There is none, which is reported where joints are read.
    Unknown,
}

impl InputKind {
    /// A value of this kind, as it is written.
    pub fn example(self) -> &'static str {
        if matches!(self, InputKind::Length) { "2.5" } else { "\"90 deg\"" }
    }
}

fn is_number(value: &TomlValue) -> bool {
    matches!(value.get_ref(), DeValue::Integer(_) | DeValue::Float(_))
}

impl<'t> TomlParser<'t> {
    /// A value of a parameter: a number, or an expression in quotes, which for an angle may have a unit. Of a name that
    /// is not a parameter the kind is [`ParameterKind::Number`]; without a kind it is not known whether it is one, and which.
    pub fn parameter_expression(
        &mut self,
        value: &TomlValue<'t>,
        name: &str,
        kind: Option<ParameterKind>,
    ) -> Option<Expression> {
        match value.get_ref() {
            DeValue::String(text) => {
                let parsed = match kind {
                    Some(kind) => kind.parse_value(name, text),
                    None => ParameterKind::parse_any_value(text),
                };
                self.ok_or_report(value, parsed)
            }
            _ => self.expression(value),
        }
    }

    /// A value of a parameter, as [`TomlParser::parameter_expression`], without names.
    pub fn parameter_value(&mut self, value: &TomlValue<'t>, name: &str, kind: Option<ParameterKind>) -> Option<f64> {
        let expression = self.parameter_expression(value, name, kind)?;
        let compiled = expression.compile(&Scope::default(), Kind::Number);
        let compiled = self.ok_or_report(value, compiled)?;
        self.require_finite(value, compiled.evaluate(|_| f64::NAN))
    }

    /// A value of the input over the names of `scope`: an angle with its unit, or a length without a unit.
    pub fn input(&mut self, value: &TomlValue<'t>, kind: InputKind, scope: &Scope) -> Option<InputValue> {
        match kind {
            InputKind::Length => Some(InputValue { value: self.input_length(value, scope)?, unit: None }),
            InputKind::Angle { has_slider: true } if is_number(value) => {
                let number = self.source_text(value);
                let problem = Problem::error(value.span(), "the unit is missing: the input is the angle of the crank");
                self.report(problem.with_help(format!(
                    "write \"{number} deg\" with the quotes; a slider or an actuator that is the input is a joint with `slider` or `piston`"
                )));
                None
            }
            InputKind::Angle { .. } => self.angle(value, scope),
            InputKind::Unknown => None,
        }
    }

    /// An input that is a length, in the manifest's unit: a number, or an expression without a unit.
    pub fn input_length(&mut self, value: &TomlValue<'t>, scope: &Scope) -> Option<CompiledExpression> {
        let is_angle = |text: &str| Quantity::parse(text, Dimension::Angle).is_ok();
        if value.get_ref().as_str().is_some_and(is_angle) {
            let problem = Problem::error(value.span(), "expected a length, found an angle");
            self.report(problem.with_help("the input is an actuator's length: give a number without a unit"));
            return None;
        }
        self.numeric_expression(value, scope)
    }

    /// An angle over the names of `scope`.
    pub fn angle(&mut self, value: &TomlValue<'t>, scope: &Scope) -> Option<InputValue> {
        let quantity = self.quantity(value, Dimension::Angle)?;
        let compiled = quantity.expression.compile(scope, Kind::Number);
        Some(InputValue { value: self.ok_or_report(value, compiled)?, unit: Some(quantity.unit) })
    }

    /// An angle in degrees, or a length on paper in millimetres, without names.
    pub fn constant_quantity(&mut self, value: &TomlValue<'t>, dimension: Dimension) -> Option<f64> {
        let quantity = self.quantity(value, dimension)?;
        let compiled = quantity.expression.compile(&Scope::default(), Kind::Number);
        self.ok_or_report(value, compiled)?;
        self.require_finite(value, quantity.evaluate(|_| f64::NAN))
    }

    fn quantity(&mut self, value: &TomlValue<'t>, dimension: Dimension) -> Option<Quantity> {
        let unit = if dimension == Dimension::Angle { "deg" } else { "mm" };
        match value.get_ref() {
            DeValue::String(text) => {
                let parsed = Quantity::parse(text, dimension);
                self.ok_or_report(value, parsed)
            }
            DeValue::Integer(_) | DeValue::Float(_) => {
                let number = self.source_text(value);
                let help = format!("write \"{number} {unit}\" with the quotes");
                self.report(Problem::error(value.span(), "the unit is missing").with_help(help));
                None
            }
            _ => {
                let help = format!("write a number and a unit in quotes: \"5 {unit}\"");
                self.report_mismatch(value, "a quantity", &help);
                None
            }
        }
    }
}
