//! Whether an expression grows with a measure of which more is better.

use coupler_curves::expression::{CompiledExpression, Expression, Kind, PostfixToken, Scope};
use coupler_curves::measure::Measure;

/// How a value changes where every measure of which more is better increases and all else is kept, and what is known of its sign.
#[derive(Clone, Copy, Debug)]
struct Trend {
    change: Change,
    /// 1 if it is not negative, -1 if it is not positive, 0 if it may be either.
    sign: i8,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Change {
    /// None of these measures is in it.
    Fixed,
    Increasing,
    Decreasing,
    Unknown,
}

/// Whether an expression without a sign before it increases with the measures in it of which more is better, where names are positive: so that its
/// least values, which come first, are those of the worst. What is no expression is not, nor what increases with some of them and decreases
/// with others.
pub(super) fn has_worst_first(text: &str) -> bool {
    if text.trim_start().starts_with(['+', '-']) {
        return false;
    }
    let Ok(expression) = Expression::parse(text) else { return false };
    let names: Vec<String> = expression.names().to_vec();
    let compiled = expression.compile(&Scope::from_numbers(names.iter().map(String::as_str)), Kind::Number);
    compiled.is_ok_and(|compiled| trend(&compiled, &names).change == Change::Increasing)
}

fn trend(expression: &CompiledExpression, names: &[String]) -> Trend {
    let mut stack: Vec<Trend> = Vec::new();
    for token in expression.postfix() {
        let count = match token {
            PostfixToken::Number(_) | PostfixToken::Name(_) => 0,
            PostfixToken::Operator("neg" | "not") => 1,
            PostfixToken::Operator(_) => 2,
            PostfixToken::Call(_, count) => count,
        };
        let operands = stack.split_off(stack.len().saturating_sub(count));
        stack.push(match token {
            PostfixToken::Number(value) => Trend { change: Change::Fixed, sign: if value < 0.0 { -1 } else { 1 } },
            PostfixToken::Name(name) => {
                let is_more_better = Measure::find(&names[name]).is_some_and(|measure| measure.is_more_better);
                Trend { change: if is_more_better { Change::Increasing } else { Change::Fixed }, sign: 1 }
            }
            PostfixToken::Operator(operator) => of_operator(operator, &operands),
            PostfixToken::Call(function, _) => of_function(function, &operands),
        });
    }
    stack.pop().unwrap_or(Trend::UNKNOWN)
}

fn of_operator(operator: &str, operands: &[Trend]) -> Trend {
    match (operator, operands) {
        ("neg", &[a]) => a.negated(),
        ("+", &[a, b]) => a.plus(b),
        ("-", &[a, b]) => a.plus(b.negated()),
        ("*", &[a, b]) => a.times(b),
        ("/", &[a, b]) => a.times(b.inverted()),
        ("^", &[a, b]) if b.change == Change::Fixed && a.sign == 1 => {
            Trend { change: a.change.scaled(b.sign), sign: 1 }
        }
        _ => Trend::with_change(Change::Unknown.unless_fixed(operands)),
    }
}

fn of_function(function: &str, operands: &[Trend]) -> Trend {
    let all = operands.iter().copied().reduce(Trend::plus).unwrap_or(Trend::UNKNOWN);
    match function {
        "sqrt" | "exp" => Trend { sign: 1, ..all },
        "deg" | "rad" | "min" | "max" => all,
        "ln" | "log10" | "asin" => Trend { sign: 0, ..all },
        "acos" => Trend { sign: 1, ..all.negated() },
        "abs" | "hypot" => Trend { change: all.change.scaled(all.sign), sign: 1 },
        _ => Trend::with_change(Change::Unknown.unless_fixed(operands)),
    }
}

impl Trend {
    const UNKNOWN: Trend = Trend::with_change(Change::Unknown);

    const fn with_change(change: Change) -> Trend {
        Trend { change, sign: 0 }
    }

    fn negated(self) -> Trend {
        Trend { change: self.change.scaled(-1), sign: -self.sign }
    }

    /// Of the reciprocal.
    fn inverted(self) -> Trend {
        Trend { change: if self.sign == 0 { self.change.scaled(0) } else { self.change.scaled(-1) }, sign: self.sign }
    }

    fn plus(self, other: Trend) -> Trend {
        Trend { change: self.change.with(other.change), sign: if self.sign == other.sign { self.sign } else { 0 } }
    }

    fn times(self, other: Trend) -> Trend {
        let change = self.change.scaled(other.sign).with(other.change.scaled(self.sign));
        Trend { change, sign: self.sign * other.sign }
    }
}

impl Change {
    /// That of a multiple by a factor of a sign.
    fn scaled(self, sign: i8) -> Change {
        match (self, sign) {
            (Change::Fixed, _) => Change::Fixed,
            (change, 1) => change,
            (Change::Increasing, -1) => Change::Decreasing,
            (Change::Decreasing, -1) => Change::Increasing,
            _ => Change::Unknown,
        }
    }

    /// That of a sum.
    fn with(self, other: Change) -> Change {
        match (self, other) {
            (change, Change::Fixed) | (Change::Fixed, change) => change,
            (one, other) if one == other => one,
            _ => Change::Unknown,
        }
    }

    /// It, or none if all that it depends on is fixed.
    fn unless_fixed(self, operands: &[Trend]) -> Change {
        if operands.iter().all(|operand| operand.change == Change::Fixed) { Change::Fixed } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::has_worst_first;

    #[test]
    fn what_grows_with_what_is_better_has_the_worst_first() {
        for text in [
            "straight_length",
            "straight_length / frame",
            "straight_length * 2",
            "2 * (straight_length + mu_min_deg)",
            "straight_length / straight_deviation",
            "straight_length - straight_deviation",
            "(straight_length)",
            "frame - -straight_length",
            "sqrt(straight_length) / (1 + length) ^ 2",
            "straight_length ^ 2",
            "min(straight_length, 3)",
            "log10(straight_length) + 1",
            "1 / (1 / mu_min_deg)",
            "-2 * 3 * 0 + mu_min_deg",
            "abs(mu_worst_deg)",
            "-1 / straight_length",
        ] {
            let bracketed = format!("({text})");
            assert!(has_worst_first(&bracketed), "{text}");
            assert_eq!(has_worst_first(text), !text.starts_with('-'), "{text}");
            for sign in ['+', '-'] {
                assert!(!has_worst_first(&format!("{sign}{bracketed}")), "{sign}{bracketed}");
            }
        }
        for text in [
            "length",
            "straight_deviation / straight_length",
            "1 / straight_length",
            "frame - straight_length",
            "(-straight_length) / frame",
            "straight_length * (frame - crank)",
            "straight_length - mu_min_deg",
            "straight_length ^ -1",
            "(straight_length - frame) ^ 2",
            "abs(mu_min_deg - 90)",
            "sin(rad(mu_min_deg))",
            "abs(straight_length - frame)",
            "2 ^ frame",
            "straight_length > 2",
            "straight_length *",
            " +straight_length",
            "",
        ] {
            assert!(!has_worst_first(text), "{text}");
        }
    }
}
