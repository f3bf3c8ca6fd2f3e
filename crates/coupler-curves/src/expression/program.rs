//! Expressions as programs of a stack machine, their kinds and their evaluation.

use super::{Error, Function, Kind, MAX_ERRORS, Scope};
use crate::geometry::trig;
use crate::problem::Span;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Instruction {
    Push(f64),
    Load(usize),
    Negate,
    Not,
    Binary(Operator),
    Call(Function, usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    And,
    Or,
}

/// An expression: a flat program for a stack machine, so that evaluation never recurses.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    pub(super) program: Vec<(Instruction, Span)>,
    pub(super) names: Vec<String>,
}

impl Expression {
    /// The expression that is always `value`.
    pub fn constant(value: f64) -> Expression {
        Expression { program: vec![(Instruction::Push(value), 0..0)], names: Vec::new() }
    }

    /// The value of an expression without names, such as `2` or `sqrt(2)`; it need not be finite.
    ///
    /// # Errors
    /// The text is not an expression, or uses a name.
    pub fn evaluate_constant(text: &str) -> Result<f64, Error> {
        Expression::parse(text)?.constant_value()
    }

    /// The value if it uses no names; it need not be finite.
    ///
    /// # Errors
    /// It uses a name.
    pub(crate) fn constant_value(&self) -> Result<f64, Error> {
        let names = self.names.iter().filter_map(|name| Some((name, self.name_span(name)?))).take(MAX_ERRORS);
        let error = |(name, span)| Error::new(span, format!("`{name}` has no value here"), "write a number");
        Error::joined(names.map(error).collect()).map_or_else(|| Ok(self.evaluate(|_| f64::NAN)), Err)
    }

    /// The names it uses, each once, in order of first use; constants such as `pi` are not among them.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The function that returns its value; `None` for an operator, a name or a number.
    pub(crate) fn outermost_function(&self) -> Option<Function> {
        match self.program.last() {
            Some((Instruction::Call(function, _), _)) => Some(*function),
            _ => None,
        }
    }

    /// A function of the expression.
    pub(crate) fn with_function(mut self, function: Function) -> Expression {
        let span = self.program.last().map_or(0..0, |(_, span)| span.clone());
        self.program.push((Instruction::Call(function, 1), span));
        self
    }

    /// The place of a name where it is first used, in the text of the expression.
    pub fn name_span(&self, name: &str) -> Option<Span> {
        let index = self.names.iter().position(|known| known == name)?;
        let is_load = |(instruction, _): &&(Instruction, Span)| *instruction == Instruction::Load(index);
        self.program.iter().find(is_load).map(|(_, span)| span.clone())
    }

    /// The name, if the expression is a single name.
    pub fn as_name(&self) -> Option<&str> {
        match (&self.program[..], &self.names[..]) {
            ([(Instruction::Load(0), _)], [name]) => Some(name),
            _ => None,
        }
    }

    /// The kind of its value, with the names of a scope.
    ///
    /// # Errors
    /// Unknown names, each with the nearest known one; a number where a boolean is expected, or the reverse.
    pub fn check(&self, scope: &Scope) -> Result<Kind, Error> {
        let (kind, errors) = self.kind_and_errors(scope);
        Error::joined(errors).map_or(Ok(kind.unwrap_or(Kind::Number)), Err)
    }

    /// The kind of its value, if the names show it, and all unknown names and the first value of a wrong kind.
    fn kind_and_errors(&self, scope: &Scope) -> (Option<Kind>, Vec<Error>) {
        let mut stack: Vec<(Option<Kind>, Span)> = Vec::new();
        let mut errors: Vec<Error> = Vec::new();
        let mut unknown: Vec<usize> = Vec::new();
        let mut has_mismatch = false;
        for (instruction, span) in &self.program {
            let popped = match instruction {
                Instruction::Push(_) | Instruction::Load(_) => 0,
                Instruction::Negate | Instruction::Not => 1,
                Instruction::Binary(_) => 2,
                Instruction::Call(_, n) => *n,
            };
            let operands = stack.split_off(stack.len() - popped);
            let (operand_kind, result_kind) = match instruction {
                Instruction::Load(index) => {
                    let kind = scope.kind_of(&self.names[*index]);
                    if kind.is_none() && !unknown.contains(index) && unknown.len() < MAX_ERRORS {
                        unknown.push(*index);
                        errors.push(unknown_name(&self.names[*index], span.clone(), scope));
                    }
                    (Kind::Number, kind)
                }
                Instruction::Push(_) | Instruction::Negate | Instruction::Call(..) => {
                    (Kind::Number, Some(Kind::Number))
                }
                Instruction::Not => (Kind::Boolean, Some(Kind::Boolean)),
                Instruction::Binary(op) => {
                    let (operand_kind, result_kind) = op.signature();
                    (operand_kind, Some(result_kind))
                }
            };
            let is_wrong = |kind: &Option<Kind>| kind.is_some_and(|kind| kind != operand_kind);
            if let (Some((_, operand)), false) = (operands.iter().find(|(kind, _)| is_wrong(kind)), has_mismatch) {
                let help = match operand_kind {
                    Kind::Number => "join comparisons with `and`: `1 < x and x < 2`",
                    Kind::Boolean => "compare it: `x > 0`",
                };
                errors.push(Error::new(operand.clone(), operand_kind.mismatch_message(), help));
                has_mismatch = true;
            }
            let start = operands.iter().map(|(_, s)| s.start).min().unwrap_or(span.start).min(span.start);
            let end = operands.iter().map(|(_, s)| s.end).max().unwrap_or(span.end).max(span.end);
            stack.push((result_kind, start..end));
        }
        (stack.pop().and_then(|(kind, _)| kind).filter(|_| !has_mismatch), errors)
    }

    /// The expression with its names looked up in `scope`, ready to be evaluated often.
    ///
    /// # Errors
    /// As [`Expression::check`], and a value that is not of the `expected` kind.
    pub fn compile(&self, scope: &Scope, expected: Kind) -> Result<CompiledExpression, Error> {
        let (kind, mut errors) = self.kind_and_errors(scope);
        if kind.is_some_and(|kind| kind != expected) {
            let span = self.program.first().map_or(0, |p| p.1.start)..self.program.last().map_or(0, |p| p.1.end);
            let help = match expected {
                Kind::Number => "give a number",
                Kind::Boolean => "compare it: `x > 0`",
            };
            errors.push(Error::new(span, expected.mismatch_message(), help));
        }
        if let Some(error) = Error::joined(errors) {
            return Err(error);
        }
        let slots = self.names.iter().filter_map(|name| scope.index_of(name)).collect();
        Ok(CompiledExpression { expression: self.clone(), slots })
    }

    /// The value, where `load(i)` is the value of the i-th of [`Expression::names`], NaN if missing.
    ///
    /// A boolean is 1 or 0. The value is NaN where it is not defined.
    pub fn evaluate(&self, load: impl Fn(usize) -> f64) -> f64 {
        let mut stack: Vec<f64> = Vec::with_capacity(8);
        for (instruction, _) in &self.program {
            let value = match *instruction {
                Instruction::Push(value) => value,
                Instruction::Load(name) => load(name),
                Instruction::Negate => -pop_or_nan(&mut stack),
                Instruction::Not => f64::from(u8::from(pop_or_nan(&mut stack) == 0.0)),
                Instruction::Binary(op) => {
                    let right = pop_or_nan(&mut stack);
                    op.apply(pop_or_nan(&mut stack), right)
                }
                Instruction::Call(function, n) => {
                    let value = function.call(&stack[stack.len() - n..]);
                    stack.truncate(stack.len() - n);
                    value
                }
            };
            stack.push(value);
        }
        pop_or_nan(&mut stack)
    }
}

/// The error of a name that is not in a scope.
fn unknown_name(name: &str, span: Span, scope: &Scope) -> Error {
    let help = match scope.is_empty() {
        true => "write a number; names cannot be used here".to_owned(),
        false => scope.suggestion(name),
    };
    Error { is_unknown_name: true, ..Error::new(span, format!("unknown name `{name}`"), help) }
}

/// A token of an expression in postfix notation, for evaluation by another stack machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PostfixToken {
    /// Pushes a number.
    Number(f64),
    /// Pushes the value of the name at an index of the scope.
    Name(usize),
    /// Applies an operator, as written in expressions, except that unary minus is `neg`.
    Operator(&'static str),
    /// Calls the function of a name with a number of arguments.
    Call(&'static str, usize),
}

/// An expression whose names are resolved to indices in a scope.
#[derive(Clone, Debug, PartialEq)]
pub struct CompiledExpression {
    pub(super) expression: Expression,
    pub(super) slots: Vec<usize>,
}

impl CompiledExpression {
    /// The expression that is always `value`.
    pub fn constant(value: f64) -> CompiledExpression {
        CompiledExpression { expression: Expression::constant(value), slots: Vec::new() }
    }

    /// The value, where `load(slot)` is the value of the name at an index of the scope.
    pub fn evaluate(&self, load: impl Fn(usize) -> f64) -> f64 {
        self.expression.evaluate(|name| load(self.slots[name]))
    }

    /// The name or the number, if the expression is a single one.
    pub fn name_or_number(&self) -> Option<String> {
        match (self.expression.as_name(), &self.expression.program[..]) {
            (Some(name), _) => Some(name.to_owned()),
            (None, [(Instruction::Push(value), _)]) => Some(value.to_string()),
            _ => None,
        }
    }

    /// The expression in postfix notation.
    pub fn postfix(&self) -> impl Iterator<Item = PostfixToken> {
        self.expression.program.iter().map(|(instruction, _)| match *instruction {
            Instruction::Push(value) => PostfixToken::Number(value),
            Instruction::Load(name) => PostfixToken::Name(self.slots[name]),
            Instruction::Negate => PostfixToken::Operator("neg"),
            Instruction::Not => PostfixToken::Operator("not"),
            Instruction::Binary(operator) => PostfixToken::Operator(operator.symbol()),
            Instruction::Call(function, arguments) => PostfixToken::Call(function.name(), arguments),
        })
    }

    /// The indices in the scope of the names it uses.
    pub fn slots(&self) -> &[usize] {
        &self.slots
    }
}

/// Pops a value. The parser gives every operator its operands, so the stack is never empty here.
fn pop_or_nan(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or(f64::NAN)
}

impl Operator {
    /// The kinds of its operands and of its result.
    fn signature(self) -> (Kind, Kind) {
        use Operator::{Add, And, Divide, Multiply, Or, Power, Subtract};
        match self {
            Add | Subtract | Multiply | Divide | Power => (Kind::Number, Kind::Number),
            And | Or => (Kind::Boolean, Kind::Boolean),
            _ => (Kind::Number, Kind::Boolean),
        }
    }

    /// Its symbol in expressions.
    fn symbol(self) -> &'static str {
        match self {
            Operator::Add => "+",
            Operator::Subtract => "-",
            Operator::Multiply => "*",
            Operator::Divide => "/",
            Operator::Power => "^",
            Operator::Equal => "==",
            Operator::NotEqual => "!=",
            Operator::Less => "<",
            Operator::LessOrEqual => "<=",
            Operator::Greater => ">",
            Operator::GreaterOrEqual => ">=",
            Operator::And => "and",
            Operator::Or => "or",
        }
    }

    fn apply(self, a: f64, b: f64) -> f64 {
        let number = |is_true: bool| f64::from(u8::from(is_true));
        match self {
            Operator::Add => a + b,
            Operator::Subtract => a - b,
            Operator::Multiply => a * b,
            Operator::Divide => a / b,
            Operator::Power => trig::pow(a, b),
            Operator::Equal => number(a == b),
            // `a != b` alone would be true for missing values.
            Operator::NotEqual => number(a != b && !a.is_nan() && !b.is_nan()),
            Operator::Less => number(a < b),
            Operator::LessOrEqual => number(a <= b),
            Operator::Greater => number(a > b),
            Operator::GreaterOrEqual => number(a >= b),
            Operator::And => number(a == 1.0 && b == 1.0),
            Operator::Or => number(a == 1.0 || b == 1.0),
        }
    }
}
