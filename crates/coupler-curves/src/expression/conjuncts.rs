//! The conditions that a condition joins by `and`.

use std::ops::Range;

use super::program::{Instruction, Operator};
use super::{CompiledExpression, Expression, Function};

/// A condition that compares two numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The left one.
    pub left: CompiledExpression,
    /// The right one.
    pub right: CompiledExpression,
    /// How the left one is to be to the right one.
    pub relation: Relation,
}

/// How a number is to be to another one; whether a bound is met by the bound itself is left to the condition.
#[derive(Clone, Debug, PartialEq)]
pub enum Relation {
    /// Equal, to a tolerance if the condition has one.
    Equal {
        /// The greatest difference.
        tolerance: Option<CompiledExpression>,
    },
    /// As great at most.
    AtMost,
    /// As great at least.
    AtLeast,
}

impl CompiledExpression {
    /// The conditions that it joins by `and`, in order: it is true if all of them are. Of a condition that joins none, itself.
    pub fn conjuncts(&self) -> Vec<CompiledExpression> {
        let program = &self.expression.program;
        let starts = self.expression.operand_starts();
        let mut found = Vec::new();
        let mut remaining: Vec<Range<usize>> = std::iter::once(0..program.len()).collect();
        while let Some(range) = remaining.pop() {
            match program[range.clone()].last() {
                Some((Instruction::Binary(Operator::And), _)) => {
                    let right = range.end - 1;
                    let middle = starts[right - 1];
                    // The left one comes out first.
                    remaining.extend([middle..right, range.start..middle]);
                }
                _ => found.push(self.part(range)),
            }
        }
        found
    }

    /// The sides of a comparison that compute something of names; none of another condition.
    pub fn computed_sides(&self) -> Vec<CompiledExpression> {
        let program = &self.expression.program;
        let is_computed = |range: &Range<usize>| {
            range.len() > 1 && program[range.clone()].iter().any(|(part, _)| matches!(part, Instruction::Load(_)))
        };
        let sides = self.compared(program.len()).into_iter().flat_map(|(_, sides)| sides);
        sides.filter(is_computed).map(|range| self.part(range)).collect()
    }

    /// The two sides of a condition that is met from one side's value on, or where they are equal; `None` of any other.
    pub fn comparison(&self) -> Option<Comparison> {
        use Operator::{Equal, Greater, GreaterOrEqual, LessOrEqual, NotEqual, Subtract};
        let end = self.expression.program.len();
        let (operator, sides) = self.compared(end)?;
        let part = |range: &Range<usize>| self.part(range.clone());
        let compared = |relation| {
            let [left, right] = sides.each_ref().map(part);
            Some(Comparison { left, right, relation })
        };
        match operator {
            NotEqual => None,
            Equal => compared(Relation::Equal { tolerance: None }),
            Greater | GreaterOrEqual => compared(Relation::AtLeast),
            LessOrEqual if self.is_at(sides[0].end, Instruction::Call(Function::Abs, 1)) => {
                // What `x == 110 +- 0.5` is parsed to.
                let difference = sides[0].end - 1;
                match self.binary(difference) {
                    Some((Subtract, [left, right])) => {
                        let tolerance = Some(self.part(sides[1].clone()));
                        let (left, right) = (self.part(left), self.part(right));
                        Some(Comparison { left, right, relation: Relation::Equal { tolerance } })
                    }
                    _ => compared(Relation::AtMost),
                }
            }
            _ => compared(Relation::AtMost),
        }
    }

    /// The comparison before a place of the program and the places of its sides; `None` if no comparison ends there.
    fn compared(&self, end: usize) -> Option<(Operator, [Range<usize>; 2])> {
        use Operator::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual, NotEqual};
        let is_comparison =
            |operator| matches!(operator, Equal | NotEqual | Less | LessOrEqual | Greater | GreaterOrEqual);
        self.binary(end).filter(|(operator, _)| is_comparison(*operator))
    }

    /// The operator with two operands before a place of the program, and their places.
    fn binary(&self, end: usize) -> Option<(Operator, [Range<usize>; 2])> {
        let Some((Instruction::Binary(operator), _)) = self.expression.program.get(end.checked_sub(1)?) else {
            return None;
        };
        let starts = self.expression.operand_starts();
        let middle = starts[end - 2];
        Some((*operator, [starts[middle - 1]..middle, middle..end - 1]))
    }

    /// Whether an instruction is just before a place of the program.
    fn is_at(&self, end: usize, instruction: Instruction) -> bool {
        self.expression.program[..end].last().is_some_and(|(other, _)| *other == instruction)
    }

    /// The expression as it is set in a message, with the names that it is written with.
    pub fn message_text(&self) -> String {
        self.to_math_text_with_names().to_string()
    }

    /// The part of it that is written at some places of its program.
    fn part(&self, range: Range<usize>) -> CompiledExpression {
        let (mut names, mut slots): (Vec<String>, Vec<usize>) = (Vec::new(), Vec::new());
        let mut program = self.expression.program[range].to_vec();
        for (instruction, _) in &mut program {
            if let Instruction::Load(index) = instruction {
                let name = &self.expression.names[*index];
                let known = names.iter().position(|other| other == name);
                if known.is_none() {
                    names.push(name.clone());
                    slots.push(self.slots[*index]);
                }
                *index = known.unwrap_or(names.len() - 1);
            }
        }
        CompiledExpression { expression: Expression { program, names }, slots }
    }
}

impl Expression {
    /// For each place of the program, where the operand begins whose value is on top of the stack after it.
    fn operand_starts(&self) -> Vec<usize> {
        let mut starts: Vec<usize> = Vec::with_capacity(self.program.len());
        for (at, (instruction, _)) in self.program.iter().enumerate() {
            let operands = match instruction {
                Instruction::Push(_) | Instruction::Load(_) => 0,
                Instruction::Negate | Instruction::Not => 1,
                Instruction::Binary(_) => 2,
                Instruction::Call(_, count) => *count,
            };
            // The last operand ends just before this place, and each other one just before the next begins.
            let start = (0..operands).fold(at, |start, _| starts[start - 1]);
            starts.push(start);
        }
        starts
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Kind, Scope};
    use super::*;

    /// The names of each conjunct of a condition on a, b, c and d.
    fn conjuncts(text: &str) -> Vec<Vec<String>> {
        let scope: Scope = ["a", "b", "c", "d"].into_iter().map(|name| (name, Kind::Number)).collect();
        let whole = Expression::parse(text).unwrap().compile(&scope, Kind::Boolean).unwrap();
        let parts = whole.conjuncts();
        // All conjuncts are true together exactly if the whole is.
        for k in 0..256usize {
            let load = |slot: usize| if k >> (2 * slot) & 3 == 3 { f64::NAN } else { (k >> (2 * slot) & 3) as f64 };
            let all = parts.iter().all(|part| part.evaluate(load) == 1.0);
            assert_eq!(whole.evaluate(load) == 1.0, all, "{text} with {k}");
        }
        parts.iter().map(|part| part.expression.names().to_vec()).collect()
    }

    #[test]
    fn sides_of_comparisons_that_compute_something_are_found() {
        let sides = |text: &str| -> Vec<String> {
            let scope: Scope = ["a", "b"].into_iter().map(|name| (name, Kind::Number)).collect();
            let whole = Expression::parse(text).unwrap().compile(&scope, Kind::Boolean).unwrap();
            whole.computed_sides().iter().map(CompiledExpression::message_text).collect()
        };
        assert_eq!(sides("a / b > 0.5"), ["a / b"]);
        assert_eq!(sides("a + 1 <= max(a, b) * 2").len(), 2);
        for text in ["a > 2", "-1 < b", "sqrt(2) / 2 != a", "not (a + b > 2)", "a + b > 2 or a > 1"] {
            assert_eq!(sides(text), [""; 0], "{text}");
        }
    }

    #[test]
    fn comparisons_have_two_sides() {
        let compared = |text: &str| {
            let scope: Scope = ["a", "b"].into_iter().map(|name| (name, Kind::Number)).collect();
            let whole = Expression::parse(text).unwrap().compile(&scope, Kind::Boolean).unwrap();
            let Comparison { left, right, relation } = whole.comparison()?;
            let relation = match relation {
                Relation::Equal { tolerance: None } => "=".to_owned(),
                Relation::Equal { tolerance: Some(tolerance) } => format!("= ± {}", tolerance.message_text()),
                Relation::AtMost => "≤".to_owned(),
                Relation::AtLeast => "≥".to_owned(),
            };
            Some(format!("{} {relation} {}", left.message_text(), right.message_text()))
        };
        for (text, expected) in [
            ("a >= 35", "a ≥ 35"),
            ("2 * a + 1 < b", "2 · a + 1 ≤ b"),
            ("a == b", "a = b"),
            ("a + b == 110 +- 0.5", "a + b = ± 0.5 110"),
            ("abs(a - 110) <= b / 2", "a = ± b / 2 110"),
            ("abs(a) <= 2", "abs(a) ≤ 2"),
            ("abs(a - b) >= 2", "abs(a − b) ≥ 2"),
        ] {
            assert_eq!(compared(text).as_deref(), Some(expected), "{text}");
        }
        for text in ["a != b", "not a > b", "a > 1 or b > 1"] {
            assert_eq!(compared(text), None, "{text}");
        }
    }

    #[test]
    fn conditions_are_divided_at_and() {
        assert_eq!(conjuncts("a < 2"), [["a"]]);
        assert_eq!(conjuncts("b > 0 and a < 2 and max(c, d, a) > 1"), [vec!["b"], vec!["a"], vec!["c", "d", "a"]]);
        assert_eq!(conjuncts("a < 2 and (b > 0 and (c == 1 or d == 1 and a > 0))").len(), 3);
        assert_eq!(conjuncts("(a < 2 and b > 0) and not (c > 1 and d > 0)"), [vec!["a"], vec!["b"], vec!["c", "d"]]);
        assert_eq!(conjuncts("a < 2 or b > 0 and c > 1").len(), 1);
    }
}
