//! Mathematical text: words, symbols and exponents, as they are set on paper.

use std::fmt;

use super::program::{Instruction, Operator};
use super::{CompiledExpression, Expression, Function};
use crate::text::{divide_word, format_as_written, format_exactly, is_same_number, round_to_six_digits};

/// A text in which parameters are symbols and exponents are raised.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MathText {
    pieces: Vec<MathPiece>,
}

/// A piece of a [`MathText`] in one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MathPiece {
    /// The text.
    pub text: String,
    /// Whether it is a symbol, which is set in italics: a parameter of a single letter, also with an index or after an underscore. Longer
    /// names are read as words.
    pub is_symbol: bool,
    /// Whether it is an exponent, which is raised.
    pub is_raised: bool,
}

impl MathText {
    /// Words and numbers.
    pub fn from_words(words: impl Into<String>) -> MathText {
        MathText::default().with_words(words)
    }

    /// The name of a parameter, as of [`displayed_name`]; a letter, also with an index, is a symbol.
    pub fn from_name(name: &str) -> MathText {
        let mut text = MathText::default();
        let is_symbol = is_single_letter(name) || is_letter_with_word(name);
        text.push(&displayed_name(name), is_symbol, false);
        text
    }

    /// The text followed by words.
    #[must_use]
    pub fn with_words(mut self, words: impl Into<String>) -> MathText {
        self.push(&words.into(), false, false);
        self
    }

    /// The text followed by another one.
    #[must_use]
    pub fn with(mut self, other: MathText) -> MathText {
        other.pieces.iter().for_each(|piece| self.push(&piece.text, piece.is_symbol, piece.is_raised));
        self
    }

    /// "a = 2", or "a ≈ 1.41421" of a number that is rounded.
    #[must_use]
    pub fn equal_to(self, mut right: MathText) -> MathText {
        let rounded = right.pieces.first().and_then(|first| Some(first.text.strip_prefix('≈')?.to_owned()));
        let sign = if rounded.is_some() { " ≈ " } else { " = " };
        rounded.into_iter().for_each(|rounded| right.pieces[0].text = rounded);
        self.with_words(sign).with(right)
    }

    /// Texts one after the other, with a separator between them.
    pub fn join(texts: impl IntoIterator<Item = MathText>, separator: &str) -> MathText {
        let mut texts = texts.into_iter();
        let first = texts.next().unwrap_or_default();
        texts.fold(first, |joined, text| joined.with_words(separator).with(text))
    }

    /// The pieces, in their order.
    pub fn pieces(&self) -> &[MathPiece] {
        &self.pieces
    }

    /// Whether it has no characters.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// The text in lines that fit: broken after commas and semicolons outside of parentheses where that is possible, and otherwise between words.
    /// A word that does not fit is divided.
    pub fn wrap(&self, fits: impl Fn(&MathText) -> bool) -> Vec<MathText> {
        let mut lines: Vec<MathText> = Vec::new();
        let mut add = |part: MathText| match lines.last_mut() {
            Some(line) if fits(&line.clone().with(part.trimmed())) => *line = std::mem::take(line).with(part),
            _ => lines.push(part),
        };
        for clause in self.clauses() {
            if fits(&clause.trimmed()) {
                add(clause);
            } else {
                clause.split_after(" ").into_iter().flat_map(|word| word.divided(&fits)).for_each(&mut add);
            }
        }
        lines.iter().map(MathText::trimmed).collect()
    }

    /// The parts of the text between commas and semicolons that are not in parentheses, each with what ends it.
    fn clauses(&self) -> Vec<MathText> {
        let parts = self.split_after(", ").into_iter().flat_map(|part| part.split_after("; "));
        let is_open = |text: &MathText| {
            let count = |c: char| text.pieces.iter().map(|piece| piece.text.matches(c).count()).sum::<usize>();
            count('(') > count(')')
        };
        let mut clauses: Vec<MathText> = Vec::new();
        for part in parts {
            match clauses.last_mut() {
                Some(last) if is_open(last) => *last = std::mem::take(last).with(part),
                _ => clauses.push(part),
            }
        }
        clauses
    }

    /// The text, or its parts if it does not fit.
    fn divided(self, fits: impl Fn(&MathText) -> bool) -> Vec<MathText> {
        if fits(&self.trimmed()) {
            return vec![self];
        }
        let of_piece = |piece: MathPiece| -> Vec<MathText> {
            let MathPiece { is_symbol, is_raised, .. } = piece;
            let part =
                |text: &str| MathText { pieces: vec![MathPiece { text: text.to_owned(), is_symbol, is_raised }] };
            divide_word(&piece.text, |text| fits(&part(text).trimmed())).into_iter().map(part).collect()
        };
        self.pieces.into_iter().flat_map(of_piece).collect()
    }

    /// The parts of the text, each but the last with a separator at its end; separators are in words only.
    fn split_after(&self, separator: &str) -> Vec<MathText> {
        let mut parts = vec![MathText::default()];
        for piece in &self.pieces {
            let is_words = !piece.is_symbol && !piece.is_raised;
            let texts: Vec<&str> =
                if is_words { piece.text.split_inclusive(separator).collect() } else { vec![&piece.text] };
            for text in texts {
                let is_complete = parts
                    .last()
                    .and_then(|part| part.pieces.last())
                    .is_some_and(|last| !last.is_symbol && !last.is_raised && last.text.ends_with(separator));
                if is_complete {
                    parts.push(MathText::default());
                }
                if let Some(part) = parts.last_mut() {
                    part.push(text, piece.is_symbol, piece.is_raised);
                }
            }
        }
        parts
    }

    /// The text without spaces at its end.
    fn trimmed(&self) -> MathText {
        let mut text = self.clone();
        if let Some(last) = text.pieces.last_mut() {
            last.text.truncate(last.text.trim_end().len());
        }
        text.pieces.retain(|piece| !piece.text.is_empty());
        text
    }

    fn push(&mut self, text: &str, is_symbol: bool, is_raised: bool) {
        if text.is_empty() {
            return;
        }
        match self.pieces.last_mut() {
            Some(last) if last.is_symbol == is_symbol && last.is_raised == is_raised => last.text.push_str(text),
            _ => self.pieces.push(MathPiece { text: text.to_owned(), is_symbol, is_raised }),
        }
    }

    fn raised(mut self) -> MathText {
        self.pieces.iter_mut().for_each(|piece| piece.is_raised = true);
        self
    }
}

/// As plain text: an exponent follows `^`.
impl fmt::Display for MathText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut is_raised = false;
        for piece in &self.pieces {
            let caret = if piece.is_raised && !is_raised { "^" } else { "" };
            write!(f, "{caret}{}", piece.text)?;
            is_raised = piece.is_raised;
        }
        Ok(())
    }
}

fn is_single_letter(name: &str) -> bool {
    name.chars().nth(1).is_none()
}

/// The letter and the index of a name such as `k_1`.
fn indexed_letter(name: &str) -> Option<(&str, &str)> {
    let (letter, index) = name.split_once('_')?;
    let is_indexed = is_single_letter(letter)
        && letter.chars().all(char::is_alphabetic)
        && !index.is_empty()
        && index.chars().all(|c| c.is_ascii_digit());
    (is_indexed && !letter.is_empty()).then_some((letter, index))
}

/// Whether a name is a letter with a word as its index, as `a_x` and `r_crank`: with a space it would be read as a product.
fn is_letter_with_word(name: &str) -> bool {
    name.split_once('_').is_some_and(|(letter, _)| is_single_letter(letter) && letter.chars().all(char::is_alphabetic))
}

/// The name of a parameter as it is printed: `k_1` as k₁, `a_x` as it is, and others with spaces in place of underscores.
pub fn displayed_name(name: &str) -> String {
    const INDICES: [char; 10] = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    match indexed_letter(name) {
        Some((letter, index)) => {
            let digits = index.chars().filter_map(|c| INDICES.get(c.to_digit(10)? as usize));
            letter.chars().chain(digits.copied()).collect()
        }
        None if is_letter_with_word(name) => name.to_owned(),
        None => name.replace('_', " "),
    }
}

/// Names of joints in a row as they are printed: AB, O₁A₁, or Knee–Hip if one of them is a word.
pub fn join_names(names: &[&str]) -> String {
    let are_letters = names.iter().all(|name| is_single_letter(name) || indexed_letter(name).is_some());
    let displayed: Vec<String> = names.iter().map(|name| displayed_name(name)).collect();
    displayed.join(if are_letters { "" } else { "–" })
}

/// How tightly a part of an expression holds together, by the table in [`super`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Or,
    And,
    Comparison,
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

impl Expression {
    /// The expression as it is set on paper: `2 * a` as 2 a, `sqrt(x)` as √x, a power with a raised exponent.
    pub fn to_math_text(&self) -> MathText {
        self.to_math_text_with(|name| MathText::from_name(&self.names[name]))
    }

    /// The same, with the text `word(k)` for the k-th of its names.
    fn to_math_text_with(&self, word: impl Fn(usize) -> MathText) -> MathText {
        let mut stack: Vec<(MathText, Binding)> = Vec::new();
        for (instruction, _) in &self.program {
            let set = match *instruction {
                Instruction::Push(value) => set_number(value),
                Instruction::Load(name) => set_name(word(name)),
                Instruction::Negate => {
                    let operand = stack.pop().unwrap_or_else(nothing);
                    (MathText::from_words("−").with(in_parentheses(operand, Binding::Sign)), Binding::Sign)
                }
                Instruction::Not => {
                    let operand = stack.pop().unwrap_or_else(nothing);
                    (
                        MathText::from_words("not ").with(in_parentheses(operand, Binding::Comparison)),
                        Binding::Comparison,
                    )
                }
                Instruction::Binary(operator) => {
                    let right = stack.pop().unwrap_or_else(nothing);
                    let left = stack.pop().unwrap_or_else(nothing);
                    set_operation(operator, left, right)
                }
                Instruction::Call(function, arguments) => {
                    let first = stack.len().saturating_sub(arguments);
                    set_call(function, stack.split_off(first))
                }
            };
            stack.push(set);
        }
        stack.pop().unwrap_or_else(nothing).0
    }
}

impl CompiledExpression {
    /// The expression as it is set on paper.
    pub fn to_math_text(&self) -> MathText {
        self.expression.to_math_text()
    }

    /// The same, with its decimal beside a constant that is no number: "√2 ≈ 1.41421".
    pub fn to_dimension_text(&self) -> MathText {
        let text = self.to_math_text();
        let is_number = |value: f64| text.to_string() == format_as_written(value);
        let Some(value) = self.constant_value().filter(|value| !is_number(*value)) else { return text };
        let rounded = round_to_six_digits(value);
        let sign = if is_same_number(value, rounded) { "=" } else { "≈" };
        text.with_words(format!(" {sign} {}", format_exactly(rounded)))
    }

    /// The same, with the names as they are written.
    pub(super) fn to_math_text_with_names(&self) -> MathText {
        self.expression.to_math_text_with(|name| MathText::from_words(self.expression.names[name].as_str()))
    }

    /// The same, with the text `word(slot)` for the name at an index of the scope.
    pub fn to_math_text_with(&self, word: impl Fn(usize) -> MathText) -> MathText {
        self.expression.to_math_text_with(|name| word(self.slots()[name]))
    }
}

fn nothing() -> (MathText, Binding) {
    (MathText::default(), Binding::Atom)
}

fn set_number(value: f64) -> (MathText, Binding) {
    let text = if value == std::f64::consts::PI { "π".to_owned() } else { format_as_written(value) };
    (MathText::from_words(text), if value < 0.0 { Binding::Sign } else { Binding::Atom })
}

/// A name; one of several words is enclosed where its power is taken, so that it is not read as that of the last word.
fn set_name(text: MathText) -> (MathText, Binding) {
    let has_spaces = text.pieces.iter().any(|piece| piece.text.contains(' '));
    (text, if has_spaces { Binding::Power } else { Binding::Atom })
}

/// A part of an expression, in parentheses unless it holds together at least as tightly as its place needs.
fn in_parentheses((text, binding): (MathText, Binding), needed: Binding) -> MathText {
    if binding >= needed { text } else { MathText::from_words("(").with(text).with_words(")") }
}

fn set_operation(operator: Operator, left: (MathText, Binding), right: (MathText, Binding)) -> (MathText, Binding) {
    // An operand on the right of an operator of its own rank needs parentheses: a - (b - c).
    let (symbol, binding, right_needs) = match operator {
        Operator::Or => (" or ", Binding::Or, Binding::And),
        Operator::And => (" and ", Binding::And, Binding::Comparison),
        Operator::Equal => (" = ", Binding::Comparison, Binding::Sum),
        Operator::NotEqual => (" ≠ ", Binding::Comparison, Binding::Sum),
        Operator::Less => (" < ", Binding::Comparison, Binding::Sum),
        Operator::LessOrEqual => (" ≤ ", Binding::Comparison, Binding::Sum),
        Operator::Greater => (" > ", Binding::Comparison, Binding::Sum),
        Operator::GreaterOrEqual => (" ≥ ", Binding::Comparison, Binding::Sum),
        Operator::Add => (" + ", Binding::Sum, Binding::Sum),
        Operator::Subtract => (" − ", Binding::Sum, Binding::Product),
        Operator::Multiply => (multiplication_sign(&left.0, &right.0), Binding::Product, Binding::Product),
        Operator::Divide => (" / ", Binding::Product, Binding::Power),
        Operator::Power => {
            let exponent = right.0.raised();
            return (in_parentheses(left, Binding::Atom).with(exponent), Binding::Power);
        }
    };
    // Two signs in a row are hard to read.
    let right_needs = if right.1 == Binding::Sign { Binding::Power } else { right_needs };
    // The first operand of a comparison is no comparison.
    let left_needs = if binding == Binding::Comparison { Binding::Sum } else { binding };
    let set = in_parentheses(left, left_needs).with_words(symbol).with(in_parentheses(right, right_needs));
    (set, binding)
}

/// A product is set without a sign if a symbol, parentheses or a root follow a number or a symbol: 2 a, but part · long.
fn multiplication_sign(left: &MathText, right: &MathText) -> &'static str {
    let ends_with_word = left.pieces.last().is_some_and(|piece| {
        !piece.is_symbol && piece.text.chars().next_back().is_some_and(char::is_alphabetic) && piece.text != "π"
    });
    let is_clear = right.pieces.first().is_some_and(|piece| piece.is_symbol || piece.text.starts_with(['(', '√', 'π']));
    if is_clear && !ends_with_word { " " } else { " · " }
}

fn set_call(function: Function, mut arguments: Vec<(MathText, Binding)>) -> (MathText, Binding) {
    if let (Function::Sqrt, [_]) = (function, &arguments[..]) {
        let argument = arguments.pop().unwrap_or_else(nothing);
        return (MathText::from_words("√").with(in_parentheses(argument, Binding::Atom)), Binding::Power);
    }
    if let (Function::Hypot, [_, _]) = (function, &arguments[..]) {
        let square = |side| in_parentheses(side, Binding::Atom).with(MathText::from_words("2").raised());
        let sum = MathText::join(arguments.into_iter().map(square), " + ");
        return (MathText::from_words("√(").with(sum).with_words(")"), Binding::Power);
    }
    let list = MathText::join(arguments.into_iter().map(|(text, _)| text), ", ");
    (MathText::from_words(format!("{}(", function.name())).with(list).with_words(")"), Binding::Atom)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(text: &str) -> String {
        Expression::parse(text).unwrap().to_math_text().to_string()
    }

    #[test]
    fn expressions_are_set_with_as_few_parentheses_as_they_need() {
        for (text, expected) in [
            ("(1 + p)^1.5 / 2", "(1 + p)^1.5 / 2"),
            ("2 * a", "2 a"),
            ("a * 2", "a · 2"),
            ("u * p / a", "u p / a"),
            ("u / (p * a)", "u / (p a)"),
            ("a - (b - c)", "a − (b − c)"),
            ("(a - b) - c", "a − b − c"),
            ("-(a + b)", "−(a + b)"),
            ("-a^2", "−a^2"),
            ("(-a)^2", "(−a)^2"),
            ("sqrt(2) * x", "√2 x"),
            ("sqrt(x + 1)", "√(x + 1)"),
            ("150 * cos(pi / 6)", "150 · cos(π / 6)"),
            ("part * long", "part · long"),
            ("a - -b", "a − (−b)"),
            ("p * (a / 2)", "p a / 2"),
            ("foot_along^2", "(foot along)^2"),
            ("2 * a_x - r_crank * b", "2 a_x − r_crank b"),
            ("hypot(0.268, 0.176)", "√(0.268^2 + 0.176^2)"),
            ("2 * hypot(a - 1, -k_1)", "2 √((a − 1)^2 + (−k₁)^2)"),
            ("a >= 2 and not b < 3", "a ≥ 2 and not b < 3"),
        ] {
            assert_eq!(set(text), expected, "{text}");
        }
    }

    #[test]
    fn symbols_are_single_letters() {
        let text = Expression::parse("k * coupler^n").unwrap().to_math_text();
        let style = |piece: &MathPiece| (piece.text.clone(), piece.is_symbol, piece.is_raised);
        let expected =
            [("k".to_owned(), true, false), (" · coupler".to_owned(), false, false), ("n".to_owned(), true, true)];
        assert_eq!(text.pieces().iter().map(style).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn texts_are_broken_after_commas_or_between_words() {
        let text = MathText::from_words("a = 1, b = 22, c = 3");
        let lines = |width: usize| {
            let lines = text.wrap(|line| line.to_string().len() <= width);
            lines.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(lines(14), ["a = 1, b = 22,", "c = 3"]);
        assert_eq!(lines(4), ["a =", "1, b", "=", "22,", "c =", "3"]);
        let text = MathText::from_words("CrankPin–Knee = 3, RockerPin");
        let lines = text.wrap(|line| line.to_string().chars().count() <= 10);
        assert_eq!(lines.iter().map(ToString::to_string).collect::<Vec<_>>(), ["CrankPin–", "Knee = 3,", "RockerPin"]);
        let text = MathText::from_words("OA = 1; laid out at (1, 0)");
        let lines = text.wrap(|line| line.to_string().len() <= 21);
        assert_eq!(lines.iter().map(ToString::to_string).collect::<Vec<_>>(), ["OA = 1;", "laid out at (1, 0)"]);
    }
}
