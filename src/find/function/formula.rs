//! A function as it is written: `y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output`.

use std::ops::Range;

use coupler_curves::expression::{Error, Expression, Kind, Scope};
use coupler_curves::geometry::trig;
use coupler_curves::problem::Problem;
use coupler_find::{FunctionTarget, Law, LawError};

/// How a function is written.
pub const FORMULA_EXAMPLE: &str = "y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output";

/// The greatest range of an input, in degrees.
const TURN_DEG: f64 = 360.0;

/// Whether a text is meant to be a formula and not the name of a file.
pub fn is_formula(text: &str) -> bool {
    text.contains('=') && word(text, 0, "for").is_some() || word(text, 0, "over").is_some() && text.contains("of input")
}

/// Reads a function: an expression of a variable, its range, and what of the input and the output it takes.
///
/// # Errors
/// All that is wrong with it, with the places.
pub fn parse_formula(text: &str) -> Result<FunctionTarget, Vec<Problem>> {
    let parts = Parts::of(text).map_err(|problem| vec![problem])?;
    let mut problems = Vec::new();
    let name = parts.trimmed(&parts.variable);
    if !is_name(name) {
        let what = if name.is_empty() {
            "the name of the variable is missing".to_owned()
        } else {
            format!("`{name}` is not a name")
        };
        problems
            .push(Problem::error(parts.variable.clone(), what).with_help("name the variable, as in `for x = 1..10`"));
    }
    let mut keep = |found: Result<f64, Problem>| found.map_err(|problem| problems.push(problem)).ok();
    let [from, to] = [&parts.from, &parts.to].map(|range| keep(parts.number(range)));
    let [input, output] = [&parts.input, &parts.output].map(|range| {
        let (number, unit) = parts.split_unit(range);
        keep(parts.number(&number).and_then(|value| parts.nonzero(value, &number))).map(|value| (value, unit, number))
    });
    let expression = parse_expression(&parts, name, &mut problems);
    if let (Some(from), Some(to)) = (from, to)
        && from == to
    {
        let message = format!("the range of {name} is empty: both ends are {from}");
        problems.push(Problem::error(parts.from.start..parts.to.end, message).with_help("write a range like 1..10"));
    }
    let travel = input.and_then(|(value, unit, number)| match unit {
        None => {
            let message = "the range of the input has no unit of an angle";
            problems.push(Problem::error(number, message).with_help("write it like `60 deg of input`"));
            None
        }
        Some(unit) if (unit * value).abs() > TURN_DEG * (1.0 + f64::EPSILON) => {
            let message = format!("the input turns by {}°", unit * value);
            problems.push(Problem::error(number, message).with_help("give at most a turn, 360 deg"));
            None
        }
        Some(unit) => Some(trig::radians(unit * value)),
    });
    if !problems.is_empty() {
        problems.sort_by_key(|problem| problem.span.start);
        return Err(problems);
    }
    let (Some(from), Some(to), Some(travel), Some((range, unit, _)), Some(expression)) =
        (from, to, travel, output, expression)
    else {
        return Err(problems);
    };
    let range = unit.map_or(range, |unit| trig::radians(unit * range));
    let law = Law::new(&expression, name, [from, to], travel, range).map_err(|error| {
        let help = match error {
            LawError::Undefined { .. } => "choose a range in which it is defined",
            _ => "write an expression that changes with the variable",
        };
        vec![Problem::error(parts.expression.clone(), error.to_string()).with_help(help)]
    })?;
    Ok(FunctionTarget::law(law, unit.is_none()))
}

fn parse_expression(parts: &Parts, name: &str, problems: &mut Vec<Problem>) -> Option<Expression> {
    let span = parts.expression.clone();
    let text = &parts.text[span.clone()];
    let parsed = Expression::parse(text).and_then(|expression| {
        expression.compile(&Scope::from_numbers([name]), Kind::Number)?;
        Ok(expression)
    });
    match parsed {
        Ok(expression) => Some(expression),
        Err(error) => {
            let start = span.start;
            let problem = |error: Error| error.into_problem(|inner| start + inner.start..start + inner.end);
            problems.extend(error.into_each().map(problem));
            None
        }
    }
}

/// The places of the parts of a formula.
struct Parts<'a> {
    text: &'a str,
    expression: Range<usize>,
    variable: Range<usize>,
    from: Range<usize>,
    to: Range<usize>,
    input: Range<usize>,
    output: Range<usize>,
}

impl<'a> Parts<'a> {
    /// # Errors
    /// A word between them is missing.
    fn of(text: &'a str) -> Result<Parts<'a>, Problem> {
        let missing = |after: usize, what: &str| {
            let at = text.len().min(after);
            let message = format!("`{what}` is missing");
            Problem::error(at..text.len().max(at), message).with_help(format!("write it like: {FORMULA_EXAMPLE}"))
        };
        let next_word = |after: usize, what: &str| word(text, after, what).ok_or_else(|| missing(after, what));
        let next = |after: usize, what: &str| {
            text[after..].find(what).map(|at| after + at).ok_or_else(|| missing(after, what))
        };
        let equals = next(0, "=")?;
        let start = equals + 1;
        let r#for = next_word(start, "for")?;
        let variable = r#for + "for".len();
        let equals = next(variable, "=")?;
        let dots = next(equals + 1, "..")?;
        let over = next_word(dots, "over")?;
        let input = over + "over".len();
        let of_input = phrase(text, input, "input").ok_or_else(|| missing(input, "of input"))?;
        let and = next_word(of_input.end, "and")?;
        let output = and + "and".len();
        let of_output = phrase(text, output, "output").ok_or_else(|| missing(output, "of output"))?;
        let rest = &text[of_output.end..];
        if !rest.trim().is_empty() {
            let problem = Problem::error(of_output.end..text.len(), format!("unexpected `{}`", rest.trim()));
            return Err(problem.with_help(format!("write it like: {FORMULA_EXAMPLE}")));
        }
        Ok(Parts {
            text,
            expression: start..r#for,
            variable: variable..equals,
            from: equals + 1..dots,
            to: dots + "..".len()..over,
            input: input..of_input.start,
            output: output..of_output.start,
        })
    }

    fn trimmed(&self, range: &Range<usize>) -> &'a str {
        self.text[range.clone()].trim()
    }

    /// The value of an expression without names, which must be finite.
    fn number(&self, range: &Range<usize>) -> Result<f64, Problem> {
        let value = Expression::evaluate_constant(&self.text[range.clone()])
            .map_err(|error| error.into_problem(|inner| range.start + inner.start..range.start + inner.end))?;
        match value.is_finite() {
            true => Ok(value),
            false => Err(Problem::error(range.clone(), format!("it is {value}")).with_help("write a finite number")),
        }
    }

    fn nonzero(&self, value: f64, range: &Range<usize>) -> Result<f64, Problem> {
        match value {
            0.0 => {
                Err(Problem::error(range.clone(), "the range is 0").with_help("write how far it goes, as in 60 deg"))
            }
            value => Ok(value),
        }
    }

    /// A range without the unit of an angle at its end, and the degrees in it if it has one.
    fn split_unit(&self, range: &Range<usize>) -> (Range<usize>, Option<f64>) {
        const UNITS: [(&str, f64); 5] = [
            ("degrees", 1.0),
            ("deg", 1.0),
            ("°", 1.0),
            ("radians", 180.0 / std::f64::consts::PI),
            ("rad", 180.0 / std::f64::consts::PI),
        ];
        let text = self.text[range.clone()].trim_end();
        let found = UNITS.iter().find_map(|(unit, degrees)| Some((text.strip_suffix(unit)?, *degrees)));
        match found {
            Some((number, degrees)) => (range.start..range.start + number.len(), Some(degrees)),
            None => (range.clone(), None),
        }
    }
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_') && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// Where a word begins, from a place on, that is no part of another word.
fn word(text: &str, after: usize, word: &str) -> Option<usize> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let places = text[after..].match_indices(word).map(|(at, _)| after + at);
    let mut whole =
        places.filter(|at| !text[..*at].ends_with(is_part) && !text[at + word.len()..].starts_with(is_part));
    whole.next()
}

/// Where `of` and another word are, from a place on.
fn phrase(text: &str, after: usize, what: &str) -> Option<Range<usize>> {
    let of = word(text, after, "of")?;
    let at = word(text, of, what)?;
    text[of + "of".len()..at].trim().is_empty().then_some(of..at + what.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_read_with_its_ranges() {
        let target = parse_formula(FORMULA_EXAMPLE).unwrap();
        let law = target.as_law().unwrap();
        assert_eq!(law.x_range(), [1.0, 10.0]);
        assert!((law.travel() - trig::radians(60.0)).abs() < 1e-15 && !target.is_length());
        assert!((law.wanted(law.travel()) - trig::radians(90.0)).abs() < 1e-15);
        let slider = parse_formula("s=sin(t)for t=-pi/4..pi/4 over 1.5 rad of input and 20 of output").unwrap();
        assert!(slider.is_length() && (slider.size() - 20.0).abs() < 1e-9);
        let text = "y = x^2 for x = 0.5..2 over -90° of input and -45 degrees of output";
        assert!(is_formula(text) && parse_formula(text).is_ok(), "{text}");
        for text in ["points.csv", "a=b.csv", "over.csv", "-"] {
            assert!(!is_formula(text), "{text}");
        }
    }

    #[test]
    fn every_slip_is_told_with_its_place() {
        let told = |text: &str| -> Vec<(String, String)> {
            let problems = parse_formula(text).unwrap_err();
            let told = |problem: &Problem| {
                assert!(!problem.help.is_empty(), "{text}: {}", problem.message);
                (text[problem.span.clone()].trim().to_owned(), problem.message.clone())
            };
            problems.iter().map(told).collect()
        };
        let one = |text: &str, place: &str, message: &str| {
            assert_eq!(told(text), [(place.to_owned(), message.to_owned())], "{text}");
        };
        one("y log10(x)", "y log10(x)", "`=` is missing");
        one("y = log10(x) x = 1..10", "log10(x) x = 1..10", "`for` is missing");
        one("y = x for x = 1..10 over 60 deg of input", "", "`and` is missing");
        one(
            "y = x for x = 1-10 over 60 deg of input and 90 deg of output",
            "1-10 over 60 deg of input and 90 deg of output",
            "`..` is missing",
        );
        one("y = x for x = 1..10 over 60 deg of input and 90 deg of output now", "now", "unexpected `now`");
        one("y = log(x) for x = 1..10 over 60 deg of input and 90 deg of output", "log", "unknown function `log`");
        one("y = x * z for x = 1..10 over 60 deg of input and 90 deg of output", "z", "unknown name `z`");
        one(
            "y = x for x = 1..1 over 60 deg of input and 90 deg of output",
            "1..1",
            "the range of x is empty: both ends are 1",
        );
        one(
            "y = x for x = 1..2 over 60 of input and 90 deg of output",
            "60",
            "the range of the input has no unit of an angle",
        );
        one("y = x for x = 1..2 over 400 deg of input and 90 deg of output", "400", "the input turns by 400°");
        one("y = x for x = 1..2 over 60 deg of input and 0 deg of output", "0", "the range is 0");
        one(
            "y = log10(x) for x = -1..2 over 60 deg of input and 90 deg of output",
            "log10(x)",
            "y is NaN at x = -1: it must be a finite number over the whole range",
        );
        one(
            "y = 2 for x = 1..2 over 60 deg of input and 90 deg of output",
            "2",
            "y is 2 for all x: a constant needs no linkage",
        );
        let several = told("y = (x for x = 1..b over 60 of input and 1/0 deg of output");
        assert_eq!(several.len(), 4, "{several:?}");
    }
}
