//! Arithmetic of compiled expressions over one scope. What has no names is computed at once.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::program::{Instruction, Operator};
use super::{CompiledExpression, Expression, Function};

impl CompiledExpression {
    /// The value of a function at some arguments, as many as it takes.
    pub(crate) fn call<const N: usize>(function: Function, arguments: [CompiledExpression; N]) -> CompiledExpression {
        combine(Instruction::Call(function, N), arguments)
    }

    /// The same value, but 0 where its magnitude is not greater than a bound.
    pub(crate) fn or_zero_within(self, bound: CompiledExpression) -> CompiledExpression {
        let magnitude = CompiledExpression::call(Function::Abs, [self.clone()]);
        // A comparison has the value 1 or 0.
        self * combine(Instruction::Binary(Operator::Greater), [magnitude, bound])
    }

    /// The same value without two signs in a row, and with that of a negated number at the number.
    pub(crate) fn simplified_sign(mut self) -> CompiledExpression {
        let program = &mut self.expression.program;
        if let [.., (Instruction::Negate, _), (Instruction::Negate, _)] = &program[..] {
            program.truncate(program.len() - 2);
        }
        self
    }

    /// The number of its names, numbers and operators.
    pub(crate) fn token_count(&self) -> usize {
        self.expression.program.len()
    }

    /// Whether it is the length of a vector.
    pub(crate) fn is_distance(&self) -> bool {
        self.expression.outermost_function() == Some(Function::Hypot)
    }

    /// The value, if it is the same for all values of names.
    pub(crate) fn constant_value(&self) -> Option<f64> {
        self.slots.is_empty().then(|| self.evaluate(|_| f64::NAN))
    }
}

/// An instruction after the programs of its operands.
fn combine<const N: usize>(instruction: Instruction, operands: [CompiledExpression; N]) -> CompiledExpression {
    let mut program = Vec::new();
    let mut names: Vec<String> = Vec::new();
    let mut slots = Vec::new();
    for operand in operands {
        let own = operand.expression;
        let mut new_names = Vec::with_capacity(own.names.len());
        for (name, slot) in own.names.into_iter().zip(operand.slots) {
            let known = names.iter().position(|known| *known == name);
            new_names.push(known.unwrap_or(names.len()));
            if known.is_none() {
                names.push(name);
                slots.push(slot);
            }
        }
        program.extend(own.program.into_iter().map(|(instruction, span)| match instruction {
            Instruction::Load(name) => (Instruction::Load(new_names[name]), span),
            instruction => (instruction, span),
        }));
    }
    program.push((instruction, 0..0));
    let combined = CompiledExpression { expression: Expression { program, names }, slots };
    match combined.constant_value() {
        Some(value) => CompiledExpression::constant(value),
        None => combined,
    }
}

impl Add for CompiledExpression {
    type Output = CompiledExpression;

    fn add(self, other: CompiledExpression) -> CompiledExpression {
        match [self.constant_value(), other.constant_value()] {
            [Some(0.0), _] => other,
            [_, Some(0.0)] => self,
            _ => combine(Instruction::Binary(Operator::Add), [self, other]),
        }
    }
}

impl Sub for CompiledExpression {
    type Output = CompiledExpression;

    fn sub(self, other: CompiledExpression) -> CompiledExpression {
        match [self.constant_value(), other.constant_value()] {
            [Some(0.0), _] => -other,
            [_, Some(0.0)] => self,
            _ => combine(Instruction::Binary(Operator::Subtract), [self, other]),
        }
    }
}

impl Mul for CompiledExpression {
    type Output = CompiledExpression;

    fn mul(self, other: CompiledExpression) -> CompiledExpression {
        combine(Instruction::Binary(Operator::Multiply), [self, other])
    }
}

impl Div for CompiledExpression {
    type Output = CompiledExpression;

    fn div(self, other: CompiledExpression) -> CompiledExpression {
        combine(Instruction::Binary(Operator::Divide), [self, other])
    }
}

impl Neg for CompiledExpression {
    type Output = CompiledExpression;

    fn neg(self) -> CompiledExpression {
        combine(Instruction::Negate, [self])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::{Kind, Scope};

    #[test]
    fn arithmetic_is_that_of_the_text() {
        let scope = Scope::from_numbers(["p", "q"]);
        let parse = |text: &str| Expression::parse(text).unwrap().compile(&scope, Kind::Number).unwrap();
        let values = |expression: &CompiledExpression| expression.evaluate(|slot| [2.0, 5.0][slot]);
        let (a, b) = (parse("q - p"), parse("p * q"));
        for (made, text) in [
            (a.clone() + b.clone(), "(q - p) + p * q"),
            (a.clone() - b.clone(), "(q - p) - p * q"),
            (a.clone() * b.clone(), "(q - p) * (p * q)"),
            (a.clone() / b.clone(), "(q - p) / (p * q)"),
            (-a.clone(), "-(q - p)"),
            (CompiledExpression::call(Function::Atan2, [a.clone(), b]), "atan2(q - p, p * q)"),
        ] {
            assert_eq!(values(&made), values(&parse(text)), "{text}");
            assert_eq!(made.to_math_text(), parse(text).to_math_text(), "{text}");
        }
        let constant = CompiledExpression::constant;
        assert_eq!(CompiledExpression::call(Function::Hypot, [constant(3.0), constant(4.0)]), constant(5.0));
        assert_eq!(a.clone() - constant(0.0), a);
        assert_eq!([4.0, 3.0, 2.0].map(|bound| values(&a.clone().or_zero_within(constant(bound)))), [0.0, 0.0, 3.0]);
    }
}
