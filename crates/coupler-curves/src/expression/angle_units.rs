//! Degrees and radians within an expression: functions that take the one are not given the other, and the two are not mixed.

use super::program::{Instruction, Operator};
use super::{Error, Expression, Function, Unit};
use crate::problem::Span;
use std::f64::consts::PI;

/// A value on the stack: its unit, if it is plainly an angle, its place, and the function that returns it.
struct Operand {
    unit: Option<Unit>,
    span: Span,
    function: Option<Function>,
    /// Whether it is a number that leaves the unit of what it multiplies.
    is_count: bool,
}

impl Expression {
    /// Checks the units of angles in an expression that was parsed from a text. A name that ends in `_deg` and what `deg` returns are degrees;
    /// `pi` and what `rad` and the arc functions return are radians. Sums have the unit of their terms, and so have whole and half multiples;
    /// other products have none, as they may convert.
    ///
    /// # Errors
    /// Degrees where a function takes radians, or the reverse; degrees and radians that are compared, added, or put into `min` or `max`.
    pub(super) fn check_angle_units(&self, text: &str) -> Result<(), Error> {
        let mut stack: Vec<Operand> = Vec::new();
        for (instruction, span) in &self.program {
            let count = match instruction {
                Instruction::Push(_) | Instruction::Load(_) => 0,
                Instruction::Negate | Instruction::Not => 1,
                Instruction::Binary(_) => 2,
                Instruction::Call(_, count) => *count,
            };
            let operands = stack.split_off(stack.len() - count);
            let start = operands.iter().map(|operand| operand.span.start).min().unwrap_or(span.start).min(span.start);
            let end = operands.iter().map(|operand| operand.span.end).max().unwrap_or(span.end).max(span.end);
            let mut value = Operand { unit: None, span: start..end, function: None, is_count: false };
            match *instruction {
                Instruction::Push(number) => {
                    value.unit = (number == PI).then_some(Unit::Rad);
                    value.is_count = (2.0 * number).fract() == 0.0;
                }
                Instruction::Load(name) => value.unit = self.names[name].ends_with("_deg").then_some(Unit::Deg),
                Instruction::Negate => (value.unit, value.is_count) = (operands[0].unit, operands[0].is_count),
                Instruction::Binary(Operator::Multiply) => {
                    value.unit = match &operands[..] {
                        [count, angle] | [angle, count] if count.is_count => angle.unit,
                        _ => None,
                    };
                    value.is_count = operands.iter().all(|operand| operand.is_count);
                }
                Instruction::Binary(Operator::Divide) => {
                    value.unit = if operands[1].is_count { operands[0].unit } else { None };
                }
                Instruction::Binary(Operator::Add | Operator::Subtract) => value.unit = common(&operands, text)?,
                Instruction::Binary(Operator::Power | Operator::And | Operator::Or) | Instruction::Not => {}
                Instruction::Binary(_) => _ = common(&operands, text)?,
                Instruction::Call(function, _) => {
                    check_argument(function, &operands[0], text)?;
                    let passes = matches!(function, Function::Abs | Function::Min | Function::Max);
                    value.unit = if passes { common(&operands, text)? } else { function.angle_unit() };
                    value.function = Some(function);
                }
            }
            stack.push(value);
        }
        Ok(())
    }
}

/// Refuses degrees where a function takes radians, and the reverse.
fn check_argument(function: Function, argument: &Operand, text: &str) -> Result<(), Error> {
    let name = function.name();
    let span = balanced(text, argument.span.clone());
    let argument_text = &text[span.clone()];
    match (function.argument_unit(), argument.unit) {
        (Some(Unit::Rad), Some(Unit::Deg)) => {
            let help = match (function, argument.function) {
                (Function::Deg, _) => "leave `deg` out, which turns radians into degrees".to_owned(),
                (_, Some(Function::Deg)) => {
                    let inner = inner(argument_text);
                    format!(
                        "`deg` turns radians into degrees: write `{name}(rad({inner}))` if {inner} is in degrees, or `{name}({inner})`"
                    )
                }
                _ => format!("write `{name}(rad({argument_text}))`"),
            };
            let message = format!("`{name}` takes radians, and `{argument_text}` is in degrees");
            Err(Error::new(span, message, help))
        }
        (Some(Unit::Deg), Some(Unit::Rad)) => {
            let message = format!("`{name}` takes degrees, and `{argument_text}` is in radians");
            Err(Error::new(span, message, "leave `rad` out, which turns degrees into radians"))
        }
        _ => Ok(()),
    }
}

/// The unit of values that must have one unit, if any has one.
///
/// # Errors
/// One is in degrees and another in radians.
fn common(operands: &[Operand], text: &str) -> Result<Option<Unit>, Error> {
    let of_unit = |unit| operands.iter().find(|operand| operand.unit == Some(unit));
    let (Some(degrees), Some(radians)) = (of_unit(Unit::Deg), of_unit(Unit::Rad)) else {
        return Ok(operands.iter().find_map(|operand| operand.unit));
    };
    let spans = [degrees, radians].map(|operand| balanced(text, operand.span.clone()));
    let [degrees, in_radians] = spans.each_ref().map(|span| &text[span.clone()]);
    let help = match radians.function {
        Some(Function::Rad) => {
            let inner = inner(in_radians);
            format!("`rad` turns degrees into radians: write `{inner}` for `{in_radians}`")
        }
        _ => format!("write `deg({in_radians})` for `{in_radians}`"),
    };
    let message = format!("`{degrees}` is in degrees, and `{in_radians}` in radians");
    Err(Error::new(spans[1].clone(), message, help))
}

/// What is between the parentheses of a call.
fn inner(call: &str) -> &str {
    call.split_once('(').map_or(call, |(_, rest)| rest.strip_suffix(')').unwrap_or(rest)).trim()
}

/// A place in a text that is extended until each of its parentheses has its counterpart.
fn balanced(text: &str, mut span: Span) -> Span {
    let bytes = text.as_bytes();
    let (mut depth, mut missing) = (0usize, 0usize);
    for byte in &bytes[span.clone()] {
        match byte {
            b'(' => depth += 1,
            b')' if depth == 0 => missing += 1,
            b')' => depth -= 1,
            _ => {}
        }
    }
    while depth > 0 && span.end < bytes.len() {
        depth = depth + usize::from(bytes[span.end] == b'(') - usize::from(bytes[span.end] == b')');
        span.end += 1;
    }
    while missing > 0 && span.start > 0 {
        span.start -= 1;
        missing = missing + usize::from(bytes[span.start] == b')') - usize::from(bytes[span.start] == b'(');
    }
    span
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_and_radians_are_told_apart() {
        let refused = [
            ("cos(deg(20))", "`cos` takes radians, and `deg(20)` is in degrees", "`cos(rad(20))`"),
            (
                "1 + sin(mu_worst_deg)",
                "`sin` takes radians, and `mu_worst_deg` is in degrees",
                "`sin(rad(mu_worst_deg))`",
            ),
            (
                "tan((mu_min_deg + 90) / 2)",
                "and `(mu_min_deg + 90) / 2` is in degrees",
                "`tan(rad((mu_min_deg + 90) / 2))`",
            ),
            ("deg(mu_deg) > 3", "`deg` takes radians, and `mu_deg` is in degrees", "leave `deg` out"),
            ("rad(acos(a / b))", "`rad` takes degrees, and `acos(a / b)` is in radians", "leave `rad` out"),
            (
                "mu_worst_deg > acos(0.5)",
                "`mu_worst_deg` is in degrees, and `acos(0.5)` in radians",
                "`deg(acos(0.5))`",
            ),
            ("rad(40) < mu_worst_deg", "and `rad(40)` in radians", "write `40` for `rad(40)`"),
            ("a > 1 and not mu_deg == pi / 4", "and `pi / 4` in radians", "`deg(pi / 4)`"),
            ("deg(asin(a)) - pi", "`deg(asin(a))` is in degrees, and `pi` in radians", "`deg(pi)`"),
            ("max(-mu_deg, 3, abs(2 * pi))", "and `abs(2 * pi)` in radians", "`deg(abs(2 * pi))`"),
        ];
        for (text, message, help) in refused {
            let error = Expression::parse(text).expect_err(text);
            assert!(error.message.contains(message) && error.help.contains(help), "{text}: {error:?}");
        }
        let allowed = [
            "cos(rad(20)) + sin(rad(mu_worst_deg))",
            "sin(mu_worst_deg * pi / 180) + sin(pi * mu_deg / 180) + sin(mu_deg / 180 * pi) + sin(mu_deg / 57.29577951308232)",
            "sin(0.017453292519943295 * mu_deg)",
            "mu_worst_deg > deg(acos(0.5)) and acos(0.5) * 180 / pi < mu_worst_deg and mu_deg < 180 / pi * acos(0.5)",
            "deg(pi) == 180 and 2 * pi * a > 3 and mu_deg / 90 > 1",
            "mu_worst_deg > 30 and min(mu_deg, 90) - 20 > a",
        ];
        for text in allowed {
            assert!(Expression::parse(text).is_ok(), "{text}: {:?}", Expression::parse(text));
        }
    }
}
