//! Parses expressions into programs, by precedence climbing.

use std::collections::HashMap;

use super::lexer::{Token, tokenize};
use super::program::{Expression, Instruction, Operator};
use super::unit::length_unit_help;
use super::{CONSTANTS, Dimension, Error, Function, MAX_DEPTH, Unit};
use crate::problem::{Span, nearest_word};

impl Expression {
    /// Parses an expression.
    ///
    /// # Errors
    /// A syntax error, with its place in the text, or degrees in the place of radians. Whether the names exist is checked by [`Expression::check`].
    pub fn parse(text: &str) -> Result<Expression, Error> {
        let mut parser = Parser::new(text)?;
        parser.parse_binary(0)?;
        match parser.peek() {
            (Token::End, _) => parser.finish(),
            (_, span) => Err(parser.unexpected(span)),
        }
    }

    /// Parses an expression and the unit of an angle after it, if any: `360/7 deg`. `help` says what to write in place of another word.
    ///
    /// # Errors
    /// As of [`Expression::parse`]; another word after the expression.
    pub(crate) fn parse_with_angle_unit(
        text: &str,
        help: impl FnOnce(&str) -> String,
    ) -> Result<(Expression, Option<Unit>), Error> {
        let (expression, word) = parse_expression_and_word(text)?;
        let Some((word, span)) = word else { return Ok((expression, None)) };
        match Dimension::Angle.unit(&word) {
            Some(unit) => Ok((expression, Some(unit))),
            None => Err(Error::new(span, format!("`{word}` is not a unit here"), help(&word))),
        }
    }
}

/// Parses an expression and the word after it, if any: `360/7 deg`.
pub(super) fn parse_expression_and_word(text: &str) -> Result<(Expression, Option<(String, Span)>), Error> {
    let mut parser = Parser::new(text)?;
    parser.parse_binary(0)?;
    let word = match parser.peek() {
        (Token::Name(word), span) => {
            parser.position += 1;
            Some((word.to_owned(), span))
        }
        _ => None,
    };
    match (parser.peek(), word) {
        ((Token::End, _), word) => Ok((parser.finish()?, word)),
        ((_, span), Some((word, _))) if is_unit(&word) => {
            let help =
                format!("a unit is the last word, and that of the whole value before it, as in \"(2 + 3) {word}\"");
            Err(Error::new(span.clone(), format!("unexpected `{}` after the unit `{word}`", &text[span]), help))
        }
        ((_, span), word) => Err(parser.unexpected(word.map_or(span, |(_, span)| span))),
    }
}

/// Whether a word is a unit of angles or lengths.
fn is_unit(word: &str) -> bool {
    [Dimension::Angle, Dimension::PaperLength].iter().any(|dimension| dimension.unit(word).is_some())
        || length_unit_help(word).is_some()
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<(Token<'a>, Span)>,
    position: usize,
    depth: usize,
    expression: Expression,
    /// The indices of the names in `expression`.
    name_indices: HashMap<&'a str, usize>,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str) -> Result<Parser<'a>, Error> {
        let expression = Expression { program: Vec::new(), names: Vec::new() };
        let parser =
            Parser { text, tokens: tokenize(text)?, position: 0, depth: 0, expression, name_indices: HashMap::new() };
        match parser.peek() {
            (Token::End, span) => Err(Error::new(
                span,
                "the expression is empty",
                "give a number, an expression or, for `where`, a condition",
            )),
            _ => Ok(parser),
        }
    }

    /// The expression, whose angles are in the units that they are used in.
    fn finish(self) -> Result<Expression, Error> {
        self.expression.check_angle_units(self.text)?;
        Ok(self.expression)
    }

    fn peek(&self) -> (Token<'a>, Span) {
        self.tokens[self.position].clone()
    }

    fn emit(&mut self, instruction: Instruction, span: Span) {
        self.expression.program.push((instruction, span));
    }

    fn unexpected(&self, span: Span) -> Error {
        match &self.text[span.clone()] {
            "" => Error::new(span, "unexpected end of the expression", "add a value after the last operator"),
            sign @ ("+-" | "±") => Error::new(
                span,
                format!("unexpected `{sign}`"),
                "it gives the tolerance of `==`, as in `x == 110 +- 0.5`; a sum with a negative number is written `a - b`",
            ),
            word => {
                let operator = ["and", "or", "not"].into_iter().find(|operator| word.eq_ignore_ascii_case(operator));
                let is_after_number = matches!(self.tokens[..self.position].last(), Some((Token::Number(_), _)));
                let length = length_unit_help(word).filter(|_| is_after_number);
                let is_angle = is_after_number && Dimension::Angle.unit(word).is_some();
                let help = match (operator, length) {
                    (Some(operator), _) => format!("write `{operator}`"),
                    (None, Some(help)) => help,
                    (None, None) if is_angle => {
                        "numbers have no unit here: `rad(30)` is 30 degrees in radians".to_owned()
                    }
                    (None, None) => "between two values there must be an operator, as in `2 * a`".to_owned(),
                };
                Error::new(span, format!("unexpected `{word}`"), help)
            }
        }
    }

    /// Runs `inner` one nesting level deeper.
    fn nested(&mut self, span: Span, inner: impl FnOnce(&mut Self) -> Result<(), Error>) -> Result<(), Error> {
        if self.depth == MAX_DEPTH {
            return Err(Error::new(
                span,
                format!("the expression is nested more than {MAX_DEPTH} levels deep"),
                "define parts of it under `let`",
            ));
        }
        self.depth += 1;
        inner(self)?;
        self.depth -= 1;
        Ok(())
    }

    /// Parses operators at least as tight as `floor`; `not` is between `and` and the comparisons.
    fn parse_binary(&mut self, floor: u8) -> Result<(), Error> {
        let (token, span) = self.peek();
        if token == Token::Not && floor <= 3 {
            self.position += 1;
            self.nested(span.clone(), |p| p.parse_binary(3))?;
            self.emit(Instruction::Not, span);
        } else {
            self.parse_unary()?;
        }
        loop {
            let (token, span) = self.peek();
            let (tightness, operator) = match token {
                Token::Or => (1, Operator::Or),
                Token::And => (2, Operator::And),
                Token::Equal => (4, Operator::Equal),
                Token::NotEqual => (4, Operator::NotEqual),
                Token::Less => (4, Operator::Less),
                Token::LessOrEqual => (4, Operator::LessOrEqual),
                Token::Greater => (4, Operator::Greater),
                Token::GreaterOrEqual => (4, Operator::GreaterOrEqual),
                Token::Plus => (5, Operator::Add),
                Token::Minus => (5, Operator::Subtract),
                Token::Star => (6, Operator::Multiply),
                Token::Slash => (6, Operator::Divide),
                _ => return Ok(()),
            };
            if tightness < floor {
                return Ok(());
            }
            self.position += 1;
            // The right operand is one tighter, as all of these are left-associative. The recursion is at most one
            // level for each tightness.
            self.parse_binary(tightness + 1)?;
            match self.peek() {
                (Token::PlusMinus, at) if operator == Operator::Equal => self.parse_tolerance(tightness, at)?,
                _ => self.emit(Instruction::Binary(operator), span),
            }
        }
    }

    /// Parses the tolerance of a comparison for equality, whose sides have been parsed: `x == 110 +- 0.5` is `abs(x - 110) <= 0.5`.
    fn parse_tolerance(&mut self, tightness: u8, span: Span) -> Result<(), Error> {
        self.position += 1;
        self.emit(Instruction::Binary(Operator::Subtract), span.clone());
        self.emit(Instruction::Call(Function::Abs, 1), span.clone());
        self.parse_binary(tightness + 1)?;
        self.emit(Instruction::Binary(Operator::LessOrEqual), span);
        Ok(())
    }

    fn parse_unary(&mut self) -> Result<(), Error> {
        match self.peek() {
            (Token::Minus, span) => {
                self.position += 1;
                self.nested(span.clone(), Self::parse_unary)?;
                self.emit(Instruction::Negate, span);
                Ok(())
            }
            (Token::Plus, span) => {
                self.position += 1;
                self.nested(span, Self::parse_unary)
            }
            _ => self.parse_power(),
        }
    }

    fn parse_power(&mut self) -> Result<(), Error> {
        self.parse_primary()?;
        if let (Token::Caret, span) = self.peek() {
            self.position += 1;
            // The exponent may have a sign and a power itself: both associate to the right.
            self.nested(span.clone(), Self::parse_unary)?;
            self.emit(Instruction::Binary(Operator::Power), span);
        }
        Ok(())
    }

    fn parse_primary(&mut self) -> Result<(), Error> {
        let (token, span) = self.peek();
        match token {
            Token::Number(value) if value.is_finite() => {
                self.position += 1;
                self.emit(Instruction::Push(value), span);
                Ok(())
            }
            Token::Number(_) => Err(Error::new(span, "the number is too large", "the largest is about 1.8e308")),
            Token::Open => {
                self.position += 1;
                self.nested(span.clone(), |p| p.parse_binary(0))?;
                self.expect_close(span)
            }
            Token::Name(name) => {
                self.position += 1;
                match self.peek() {
                    (Token::Open, open) => self.parse_call(name, span, open),
                    _ => self.parse_name(name, span),
                }
            }
            _ => Err(self.unexpected(span)),
        }
    }

    fn expect_close(&mut self, open: Span) -> Result<(), Error> {
        match self.peek() {
            (Token::Close, _) => {
                self.position += 1;
                Ok(())
            }
            (Token::End, _) => Err(Error::new(open, "this parenthesis is never closed", "add `)`")),
            (_, span) => Err(self.unexpected(span)),
        }
    }

    fn parse_name(&mut self, name: &'a str, span: Span) -> Result<(), Error> {
        if let Some((_, value)) = CONSTANTS.iter().find(|(n, _)| *n == name) {
            self.emit(Instruction::Push(*value), span);
            return Ok(());
        }
        let next = self.expression.names.len();
        let index = *self.name_indices.entry(name).or_insert(next);
        if index == next {
            self.expression.names.push(name.to_owned());
        }
        self.emit(Instruction::Load(index), span);
        Ok(())
    }

    fn parse_call(&mut self, name: &str, span: Span, open: Span) -> Result<(), Error> {
        let names = Function::ALL.map(|(n, _)| n);
        let function = Function::from_name(name).ok_or_else(|| {
            let help = match nearest_word(name, names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the functions are {}", names.join(", ")),
            };
            Error::new(span.clone(), format!("unknown function `{name}`"), help)
        })?;
        self.position += 1;
        let mut count = 0;
        if !matches!(self.peek().0, Token::Close) {
            loop {
                self.nested(open.clone(), |p| p.parse_binary(0))?;
                count += 1;
                match self.peek() {
                    (Token::Comma, _) => self.position += 1,
                    _ => break,
                }
            }
        }
        self.expect_close(open)?;
        let (least, most) = function.arity();
        if count < least || count > most {
            let expected = if most == usize::MAX { "one or more".to_owned() } else { least.to_string() };
            let message = format!("wrong number of arguments of `{name}`: expected {expected}, found {count}");
            return Err(Error::new(span, message, "separate arguments by commas"));
        }
        self.emit(Instruction::Call(function, count), span);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        Expression::parse(text).unwrap_or_else(|e| panic!("{text}: {e}")).evaluate(|_| f64::NAN)
    }

    #[test]
    fn precedence_and_associativity_are_as_documented() {
        let cases = [
            ("-2^2", -4.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("2^-2^2", 0.0625),
            ("--2", 2.0),
            ("8/4/2", 1.0),
            ("8-4-2", 2.0),
            ("2+3*4", 14.0),
            ("-2*3", -6.0),
            ("(1 + 2)^1.5 / 2", 2.598_076_211_353_316),
            ("1 < 2 and not 2 < 1", 1.0),
            ("not 1 == 2", 1.0),
            ("1 == 1 or 1 == 2 and 1 == 3", 1.0),
            ("not 1 == 1 or 1 == 1", 1.0),
            ("1 <= 1 and 1 >= 1 and 1 != 2", 1.0),
            ("min(3, 1, 2) + max(3, 1, 2)", 4.0),
            ("hypot(3, 4)", 5.0),
            ("deg(pi)", 180.0),
            ("rad(180) == pi", 1.0),
            ("atan2(1, -1) / pi", 0.75),
            ("abs(-3) + sqrt(16)", 7.0),
            ("log10(1000) + ln(exp(2))", 5.0),
            ("acos(1) + asin(0) + tan(0) + sin(0) + cos(0)", 1.0),
            (".5 + 1. + 1e1 + 2E-1", 11.7),
            ("3 == 2 +- 1", 1.0),
            ("3 == 2 + 0.5 ± 0.25 * 2 and 1 < 2", 1.0),
            ("not 3 == 1 +- 1 or 1 > 2", 1.0),
        ];
        for (text, expected) in cases {
            assert_eq!(value(text), expected, "{text}");
        }
    }

    #[test]
    fn a_missing_value_makes_every_comparison_false() {
        for text in ["x < 1", "x > 1", "x == x", "x != 1", "x <= 1", "1 >= min(x, 0)", "max(x, 2) > 1"] {
            assert_eq!(value(text), 0.0, "{text}");
        }
        assert_eq!(value("not x < 1"), 1.0);
        // Neither side is true for a missing value.
        assert_eq!(value("x < 1 or x > 1"), 0.0);
    }

    #[test]
    fn errors_have_the_span_of_their_cause() {
        let cases = [
            ("", 0, "the expression is empty"),
            ("2 +", 3, "unexpected end of the expression"),
            ("2 a", 2, "unexpected `a`"),
            ("(1", 0, "this parenthesis is never closed"),
            ("sine(1)", 0, "unknown function `sine`"),
            ("atan2(1)", 0, "wrong number of arguments of `atan2`: expected 2, found 1"),
            ("min()", 0, "wrong number of arguments of `min`: expected one or more, found 0"),
            ("2 ** 3", 2, "unexpected `**`"),
            ("a = 2", 2, "unexpected `=`"),
            ("1..2", 2, "unexpected `.2`"),
            ("1e999", 0, "the number is too large"),
            (")", 0, "unexpected `)`"),
            ("2 +-3", 2, "unexpected `+-`"),
            ("x >= 2 ± 1", 7, "unexpected `±`"),
            ("x == 2 +- 1 +- 1", 12, "unexpected `+-`"),
        ];
        for (text, at, message) in cases {
            let error = Expression::parse(text).expect_err(text);
            assert_eq!((error.span.start, error.message.as_str()), (at, message), "{text}");
            assert!(!error.help.is_empty());
        }
    }

    #[test]
    fn nesting_is_limited_and_length_is_not() {
        let nested = |n: usize| format!("{}1{}", "(".repeat(n), ")".repeat(n));
        assert!(Expression::parse(&nested(100)).is_ok());
        assert!(Expression::parse(&nested(101)).is_err());
        for deep in ["-".repeat(1_000_000), "not ".repeat(100_000), "2^".repeat(100_000), "sqrt(".repeat(100_000)] {
            assert!(Expression::parse(&format!("{deep}1")).is_err());
        }
        assert_eq!(value(&format!("0{}", "+1".repeat(100_000))), 100_000.0);
    }

    #[test]
    fn numbers_and_booleans_do_not_mix() {
        let kind = |text: &str| {
            let names = [("a", super::super::Kind::Number), ("is_open", super::super::Kind::Boolean)];
            Expression::parse(text).unwrap().check(&names.into_iter().collect())
        };
        assert_eq!(kind("a + 1").unwrap(), super::super::Kind::Number);
        assert_eq!(kind("is_open and a > 1").unwrap(), super::super::Kind::Boolean);
        assert_eq!(kind("1 < a < 2").unwrap_err().message, "expected a number, found a condition");
        assert_eq!(kind("a and 1").unwrap_err().message, "expected a condition, found a numeric expression");
        assert_eq!(kind("b + 1").unwrap_err().help, "it can be `a` or `is_open`");
    }
}
