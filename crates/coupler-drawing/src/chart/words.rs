//! The quantities of charts in words: titles and units of names, and expressions as formulas of titles.

use coupler_curves::expression::{CompiledExpression, PostfixToken, Unit};
use coupler_curves::measure::{self, Measure};
use coupler_curves::template::{Parameter, ParameterKind, Template};

/// The titles of the values of a sample other than the columns, by their names.
const SAMPLE_TITLES: [(&str, &str); 5] = [
    ("x", "x of the point"),
    ("y", "y of the point"),
    ("input_deg", "input angle of the crank"),
    ("input_length", "length of the actuator"),
    ("arc", "length along the curve"),
];

/// The title of a name of [`super::scope`] that is not one of the family's own.
fn title_of_name(name: &str) -> Option<&'static str> {
    let sample = || SAMPLE_TITLES.iter().find(|(known, _)| *known == name).map(|(_, title)| *title);
    let column = || measure::find_column(name).map(|column| column.title);
    Measure::find(name).map(|measure| measure.title).or_else(column).or_else(sample)
}

/// A name of a family in print: words are separated by spaces.
pub fn printed_name(name: &str) -> String {
    name.replace('_', " ")
}

/// The title of an expression over [`super::scope`] with a family's names, of a linkage: that of its measure, or a
/// formula of titles.
pub fn title(expression: &CompiledExpression, names: &[String], template: &Template) -> String {
    let scope = super::scope(names, template.is_driven_by_length());
    formula(expression, |slot| match names.get(slot) {
        Some(name) => printed_name(name),
        None => scope
            .names()
            .nth(slot)
            .map(|name| title_of_name(name).map_or_else(|| printed_name(name), str::to_owned))
            .unwrap_or_default(),
    })
}

/// An expression with the names of a family as a formula.
pub fn printed_formula(expression: &CompiledExpression, names: &[String]) -> String {
    formula(expression, |slot| names.get(slot).map(|name| printed_name(name)).unwrap_or_default())
}

/// The unit of an expression that is only a name; empty for any other, for lengths and for pure numbers.
pub fn unit(expression: &CompiledExpression, names: &[String], template: &Template) -> &'static str {
    let [PostfixToken::Name(slot)] = expression.postfix().collect::<Vec<_>>()[..] else { return "" };
    if slot < names.len() {
        return template.parameters.get(slot).map_or("", parameter_unit);
    }
    let is_driven_by_length = template.is_driven_by_length();
    let scope = super::scope(names, is_driven_by_length);
    let Some(name) = scope.names().nth(slot) else { return "" };
    let measure = || Measure::find(name).filter(|measure| measure.name == name).map(|measure| measure.unit);
    let column = measure::find_column(name).map(|column| column.unit);
    // The derivatives with respect to a length have the units of other quantities.
    let column = column.filter(|unit| *unit == "deg" || !is_driven_by_length);
    let sample = if name == "input_deg" { "deg" } else { "" };
    measure().or(column).unwrap_or(sample)
}

/// The unit of a parameter: `deg`, `rad` or none.
pub fn parameter_unit(parameter: &Parameter) -> &'static str {
    match parameter.kind {
        ParameterKind::Angle(Unit::Rad) => "rad",
        ParameterKind::Angle(_) => "deg",
        _ => "",
    }
}

/// How tightly the operators of a formula bind, from the loosest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Tightness {
    Sum,
    Product,
    Sign,
    Power,
    Operand,
}

/// An expression in infix notation with printed signs; `word` is the text of a name.
fn formula(expression: &CompiledExpression, word: impl Fn(usize) -> String) -> String {
    let mut stack: Vec<(String, Tightness)> = Vec::new();
    for token in expression.postfix() {
        let printed = match token {
            PostfixToken::Number(value) => number(value),
            PostfixToken::Name(slot) => (word(slot), Tightness::Operand),
            PostfixToken::Operator("neg") => {
                let operand = pop(&mut stack);
                (format!("−{}", enclosed(operand, Tightness::Sign)), Tightness::Sign)
            }
            PostfixToken::Operator(symbol) => {
                let right = pop(&mut stack);
                binary(symbol, pop(&mut stack), right)
            }
            PostfixToken::Call(name, count) => {
                let arguments: Vec<String> =
                    stack.split_off(stack.len().saturating_sub(count)).into_iter().map(|(text, _)| text).collect();
                let name = if name == "sqrt" { "√" } else { name };
                (format!("{name}({})", arguments.join(", ")), Tightness::Operand)
            }
        };
        stack.push(printed);
    }
    pop(&mut stack).0
}

fn pop(stack: &mut Vec<(String, Tightness)>) -> (String, Tightness) {
    stack.pop().unwrap_or((String::new(), Tightness::Operand))
}

fn number(value: f64) -> (String, Tightness) {
    if value == std::f64::consts::PI {
        return ("π".to_owned(), Tightness::Operand);
    }
    (value.to_string(), Tightness::Operand)
}

/// A text in parentheses if it binds less tightly than its place requires.
fn enclosed((text, tightness): (String, Tightness), required: Tightness) -> String {
    if tightness < required { format!("({text})") } else { text }
}

/// Two operands joined by an operator of expressions.
fn binary(symbol: &str, left: (String, Tightness), right: (String, Tightness)) -> (String, Tightness) {
    let (sign, tightness, right_tightness) = match symbol {
        "+" => ("+", Tightness::Sum, Tightness::Sum),
        "-" => ("−", Tightness::Sum, Tightness::Product),
        "*" => ("·", Tightness::Product, Tightness::Product),
        "/" => ("/", Tightness::Product, Tightness::Sign),
        "^" => return power(left, &right),
        other => (other, Tightness::Sum, Tightness::Product),
    };
    // A sign after an operator is enclosed: two signs in a row are hard to read.
    let right_tightness = if right.1 == Tightness::Sign { Tightness::Power } else { right_tightness };
    (format!("{} {sign} {}", enclosed(left, tightness), enclosed(right, right_tightness)), tightness)
}

/// A power: with a raised exponent if that is a whole number.
fn power(base: (String, Tightness), (exponent, tightness): &(String, Tightness)) -> (String, Tightness) {
    let raised = |digit: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit.to_digit(10)? as usize);
    // A title of several words is enclosed, so that its power is not read as that of its last word.
    let is_long = base.0.contains(' ') && base.1 == Tightness::Operand && !base.0.ends_with(')');
    let base = if is_long { format!("({})", base.0) } else { enclosed(base, Tightness::Operand) };
    let printed = match exponent.chars().map(raised).collect::<Option<String>>() {
        Some(raised) => format!("{base}{raised}"),
        None => format!("{base}^{}", enclosed((exponent.clone(), *tightness), Tightness::Operand)),
    };
    (printed, Tightness::Power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::catalogue;
    use coupler_curves::expression::{Expression, Kind};

    fn words(text: &str) -> (String, &'static str) {
        let template = catalogue::find("hoeken").unwrap();
        let names = ["p".to_owned(), "a".to_owned(), "crank_angle".to_owned()];
        let scope = super::super::scope(&names, false);
        let expression = Expression::parse(text).unwrap().compile(&scope, Kind::Number).unwrap();
        (title(&expression, &names, &template), unit(&expression, &names, &template))
    }

    #[test]
    fn names_have_titles_and_units() {
        let expected = [
            ("mu_worst_deg", "worst transmission angle", "deg"),
            ("straight_length", "length of the straight portion", ""),
            ("input_deg", "input angle of the crank", "deg"),
            ("speed", "speed", "per radian"),
            ("psi_deg", "output angle", "deg"),
            ("crank_angle", "crank angle", ""),
            ("p", "p", ""),
        ];
        for (text, title, unit) in expected {
            assert_eq!(words(text), (title.to_owned(), unit), "{text}");
        }
    }

    #[test]
    fn expressions_are_formulas_of_titles() {
        let expected = [
            (
                "straight_length / straight_deviation",
                "length of the straight portion / deviation of the straight portion",
            ),
            ("(bbox_x_max - bbox_x_min) / p", "(greatest x of the curve − least x of the curve) / p"),
            ("p - (a - 2)", "p − (a − 2)"),
            ("(p - a) - 2", "p − a − 2"),
            ("p - (a + 2)", "p − (a + 2)"),
            ("p / (a * 2)", "p / (a · 2)"),
            ("p * (a / 2)", "p · a / 2"),
            ("-p * -a", "−p · (−a)"),
            ("-(p + a)", "−(p + a)"),
            ("2^-1", "2^(−1)"),
            ("(1 + p)^1.5 / 2", "(1 + p)^1.5 / 2"),
            ("p^2 + length^2", "p² + (length of the curve)²"),
            ("(p^2)^a", "(p²)^a"),
            ("(-p)^2", "(−p)²"),
            ("sqrt(p) + atan2(a, pi)", "√(p) + atan2(a, π)"),
            ("max(p - 1, a)", "max(p − 1, a)"),
        ];
        for (text, printed) in expected {
            assert_eq!(words(text).0, printed, "{text}");
        }
    }

    /// No title is an identifier, and every name has one.
    #[test]
    fn every_name_has_a_title() {
        for is_driven_by_length in [false, true] {
            for name in super::super::scope(&[], is_driven_by_length).names() {
                let is_condition = measure::BOOLEANS.iter().any(|boolean| boolean.name == name);
                let title = title_of_name(name);
                assert!(is_condition || title.is_some_and(|title| !title.contains('_')), "{name}: {title:?}");
            }
        }
    }
}
