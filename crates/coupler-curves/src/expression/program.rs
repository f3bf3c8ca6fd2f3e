use super::{Error, Function, parser};
use crate::geometry::trig;
use crate::problem::{Span, suggestion};

/// What an expression's value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Number,
    /// True or false.
    Boolean,
}

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
    /// Reads an expression.
    ///
    /// # Errors
    /// What is wrong with the text and where in it. Whether its names exist is asked by [`Expression::check`].
    pub fn parse(text: &str) -> Result<Expression, Error> {
        parser::parse_expression(text)
    }

    /// The expression that is always `value`.
    pub fn constant(value: f64) -> Expression {
        Expression { program: vec![(Instruction::Push(value), 0..0)], names: Vec::new() }
    }

    /// The names it asks for, each once, in the order met; constants such as `pi` are not among them.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The name it is, if it is nothing but a name.
    pub fn as_name(&self) -> Option<&str> {
        match (&self.program[..], &self.names[..]) {
            ([(Instruction::Load(0), _)], [name]) => Some(name),
            _ => None,
        }
    }

    /// What its value is, given what each name stands for (`None`: there is no such name).
    ///
    /// # Errors
    /// A name that does not exist, with the nearest of `known`; a number where a truth is wanted, or the reverse.
    pub fn check(&self, known: &[&str], kind_of: impl Fn(&str) -> Option<Kind>) -> Result<Kind, Error> {
        let mut stack: Vec<(Kind, Span)> = Vec::new();
        for (instruction, span) in &self.program {
            let popped = match instruction {
                Instruction::Push(_) | Instruction::Load(_) => 0,
                Instruction::Negate | Instruction::Not => 1,
                Instruction::Binary(_) => 2,
                Instruction::Call(_, n) => *n,
            };
            let operands = stack.split_off(stack.len() - popped);
            let (wanted, given) = match instruction {
                Instruction::Load(name) => {
                    let name = &self.names[*name];
                    let unknown = || {
                        let number = || "write a number: there are no names here".to_owned();
                        let help = if known.is_empty() { number() } else { suggestion(name, known) };
                        Error::new(span.clone(), format!("there is no `{name}`"), help)
                    };
                    (Kind::Number, kind_of(name).ok_or_else(unknown)?)
                }
                Instruction::Push(_) | Instruction::Negate | Instruction::Call(..) => (Kind::Number, Kind::Number),
                Instruction::Not => (Kind::Boolean, Kind::Boolean),
                Instruction::Binary(op) => op.signature(),
            };
            if let Some((_, at)) = operands.iter().find(|(kind, _)| *kind != wanted) {
                let (message, help) = match wanted {
                    Kind::Number => {
                        ("a truth where a number is wanted", "join comparisons with `and`: `1 < x and x < 2`")
                    }
                    Kind::Boolean => ("a number where a truth is wanted", "compare it: `x > 0`"),
                };
                return Err(Error::new(at.clone(), message, help));
            }
            let start = operands.iter().map(|(_, s)| s.start).min().unwrap_or(span.start).min(span.start);
            let end = operands.iter().map(|(_, s)| s.end).max().unwrap_or(span.end).max(span.end);
            stack.push((given, start..end));
        }
        Ok(stack.pop().map_or(Kind::Number, |(kind, _)| kind))
    }

    /// The expression with its names looked up in `scope`, ready to be evaluated often.
    ///
    /// # Errors
    /// As [`Expression::check`], and a value that is not of the `wanted` kind.
    pub fn compile(&self, scope: &[(&str, Kind)], wanted: Kind) -> Result<CompiledExpression, Error> {
        let known: Vec<&str> = scope.iter().map(|(name, _)| *name).collect();
        let slot = |name: &str| known.iter().position(|n| *n == name);
        let given = self.check(&known, |name| slot(name).map(|k| scope[k].1))?;
        if given != wanted {
            let span = self.program.first().map_or(0, |p| p.1.start)..self.program.last().map_or(0, |p| p.1.end);
            return Err(match wanted {
                Kind::Number => Error::new(span, "a truth where a number is wanted", "give a number"),
                Kind::Boolean => Error::new(span, "a number where a truth is wanted", "compare it: `x > 0`"),
            });
        }
        let slots = self.names.iter().filter_map(|name| slot(name)).collect();
        Ok(CompiledExpression { expression: self.clone(), slots })
    }

    /// The value, where `load(i)` is the value of the i-th of [`Expression::names`] (not a number where missing).
    ///
    /// A truth is 1 or 0. Not a number where the value is not defined.
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

/// A step of an expression's program, as other programs may run it on a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PostfixToken {
    /// A number is pushed.
    Number(f64),
    /// The value of the name at a place of the scope is pushed.
    Name(usize),
    /// An operator takes its operands: as it is written in expressions, but for `neg`, which is the sign before one.
    Operator(&'static str),
    /// A function, by its name, takes so many arguments.
    Call(&'static str, usize),
}

/// An expression whose names are places in a scope.
#[derive(Clone, Debug, PartialEq)]
pub struct CompiledExpression {
    expression: Expression,
    slots: Vec<usize>,
}

impl CompiledExpression {
    /// The expression that is always `value`.
    pub fn constant(value: f64) -> CompiledExpression {
        CompiledExpression { expression: Expression::constant(value), slots: Vec::new() }
    }

    /// The value, where `load(slot)` is the value of the name at a place of the scope.
    pub fn evaluate(&self, load: impl Fn(usize) -> f64) -> f64 {
        self.expression.evaluate(|name| load(self.slots[name]))
    }

    /// The name or the number it is, if it is nothing else.
    pub fn name_or_number(&self) -> Option<String> {
        match (self.expression.as_name(), &self.expression.program[..]) {
            (Some(name), _) => Some(name.to_owned()),
            (None, [(Instruction::Push(value), _)]) => Some(value.to_string()),
            _ => None,
        }
    }

    /// Its program, step by step.
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

    /// The places of the names it asks for.
    pub fn slots(&self) -> &[usize] {
        &self.slots
    }
}

/// The parser leaves every operator its operands; a program that lost one would give what a missing value gives.
fn pop_or_nan(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or(f64::NAN)
}

impl Operator {
    /// What it takes and what it gives.
    fn signature(self) -> (Kind, Kind) {
        use Operator::{Add, And, Divide, Multiply, Or, Power, Subtract};
        match self {
            Add | Subtract | Multiply | Divide | Power => (Kind::Number, Kind::Number),
            And | Or => (Kind::Boolean, Kind::Boolean),
            _ => (Kind::Number, Kind::Boolean),
        }
    }

    /// How it is written.
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
        let truth = |t: bool| f64::from(u8::from(t));
        match self {
            Operator::Add => a + b,
            Operator::Subtract => a - b,
            Operator::Multiply => a * b,
            Operator::Divide => a / b,
            Operator::Power => trig::pow(a, b),
            Operator::Equal => truth(a == b),
            // `a != b` alone is true of missing values.
            Operator::NotEqual => truth(a != b && !a.is_nan() && !b.is_nan()),
            Operator::Less => truth(a < b),
            Operator::LessOrEqual => truth(a <= b),
            Operator::Greater => truth(a > b),
            Operator::GreaterOrEqual => truth(a >= b),
            Operator::And => truth(a == 1.0 && b == 1.0),
            Operator::Or => truth(a == 1.0 || b == 1.0),
        }
    }
}
