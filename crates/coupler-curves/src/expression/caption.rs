//! Captions: text with expressions in braces.

use super::{Error, Expression, MAX_ERRORS, MathText};
use crate::text::{format_fixed, round_to_six_digits};

/// A line of text with expressions in braces, as in `p = {p:.2}, area {p * r}`.
///
/// `{expression}` is replaced by the value in up to six significant digits, `{expression:.2}` by the value with two
/// decimals; `{{` and `}}` are literal braces.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug, PartialEq)]
enum Piece {
    Text(String),
    Value { expression: Expression, decimals: Option<usize>, start: usize },
}

impl Caption {
    /// Parses a caption.
    ///
    /// # Errors
    /// Unmatched braces, expressions and numbers of decimals that cannot be parsed; spans are in the caption's own
    /// text.
    pub fn parse(text: &str) -> Result<Caption, Error> {
        let (caption, errors) = Caption::parse_partly(text);
        Error::joined(errors).map_or(Ok(caption), Err)
    }

    /// As much of a caption as can be parsed, and the errors in it.
    pub fn parse_partly(text: &str) -> (Caption, Vec<Error>) {
        let mut errors = Vec::new();
        let mut pieces = Vec::new();
        let mut literal = String::new();
        let mut at = 0;
        while let Some(c) = text[at..].chars().next().filter(|_| errors.len() < MAX_ERRORS) {
            let rest = &text[at..];
            if rest.starts_with("{{") || rest.starts_with("}}") {
                literal.push(c);
                at += 2;
            } else if c == '{' {
                let Some(length) = rest.find('}') else {
                    let help = "close it with `}`, or write `{{` for a literal brace";
                    errors.push(Error::new(at..at + 1, "this brace is never closed", help));
                    break;
                };
                pieces.push(Piece::Text(std::mem::take(&mut literal)));
                pieces.extend(parse_value(text, at + 1, at + length, &mut errors));
                at += length + 1;
            } else if c == '}' {
                errors.push(Error::new(at..at + 1, "unmatched closing brace", "write `}}` for a literal brace"));
                at += 1;
            } else {
                literal.push(c);
                at += c.len_utf8();
            }
        }
        pieces.push(Piece::Text(literal));
        (Caption { pieces }, errors)
    }

    /// The expressions in it, each with the index of its first byte in the caption.
    pub fn expressions(&self) -> impl Iterator<Item = (&Expression, usize)> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Value { expression, start, .. } => Some((expression, *start)),
            Piece::Text(_) => None,
        })
    }

    /// The text with its expressions as formulas in place of their values, and with commas between its parts.
    pub fn to_math_text(&self) -> MathText {
        let piece = |piece: &Piece| match piece {
            Piece::Text(text) => MathText::from_words(text.replace(" · ", ", ")),
            Piece::Value { expression, .. } => expression.to_math_text(),
        };
        MathText::join(self.pieces.iter().map(piece), "")
    }

    /// Whether one of its expressions contains a name.
    pub fn uses(&self, name: &str) -> bool {
        self.expressions().any(|(expression, _)| expression.names().iter().any(|used| used == name))
    }

    /// The names that are shown by themselves, each with its number of decimals if that is given.
    pub fn shown_names(&self) -> impl Iterator<Item = (&str, Option<usize>)> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Value { expression, decimals, .. } => Some((expression.as_name()?, *decimals)),
            Piece::Text(_) => None,
        })
    }

    /// The text with values filled in: `load(name)` is the value of a name, and `word(name)` the text of a name that
    /// is a word. A NaN is shown as a dash.
    pub fn format(&self, load: impl Fn(&str) -> f64, word: impl Fn(&str) -> Option<&'static str>) -> String {
        self.format_with(load, word, |_, _, _| None)
    }

    /// The same, with the text `number(expression, decimals, value)` of some numbers; where it comes with `true`, it is rounded, and an
    /// equals sign before it becomes one of approximation.
    pub fn format_with(
        &self,
        load: impl Fn(&str) -> f64,
        word: impl Fn(&str) -> Option<&'static str>,
        number: impl Fn(&Expression, Option<usize>, f64) -> Option<(bool, String)>,
    ) -> String {
        let mut out = String::new();
        for piece in &self.pieces {
            if let Piece::Value { expression, .. } = piece
                && let Some(word) = expression.as_name().and_then(&word)
            {
                out.push_str(word);
                continue;
            }
            match piece {
                Piece::Text(text) => out.push_str(text),
                Piece::Value { expression, decimals, .. } => {
                    // Adding 0 makes a negative zero positive.
                    let value = expression.evaluate(|i| load(&expression.names()[i])) + 0.0;
                    let own = Some(value).filter(|value| value.is_finite());
                    let own = own.and_then(|value| number(expression, *decimals, value));
                    match (own, decimals) {
                        _ if value.is_nan() => out.push('–'),
                        _ if value.is_infinite() => out.push_str(if value > 0.0 { "∞" } else { "−∞" }),
                        (Some((is_rounded, text)), _) => {
                            if is_rounded && let Some(before) = out.strip_suffix("= ") {
                                out = format!("{before}≈ ");
                            }
                            out.push_str(&text);
                        }
                        (None, decimals) => out.push_str(&format_number(value, *decimals)),
                    }
                }
            }
        }
        out
    }
}

/// A number of a caption: with a number of decimals, or up to six significant digits.
pub(crate) fn format_number(value: f64, decimals: Option<usize>) -> String {
    decimals.map_or_else(|| round_to_six_digits(value).to_string(), |n| format_fixed(value, n))
}

/// Parses the expression and the number of decimals between the braces at `start - 1` and `end`; without decimals if these are
/// wrong.
fn parse_value(text: &str, start: usize, end: usize, errors: &mut Vec<Error>) -> Option<Piece> {
    let inner = &text[start..end];
    let (source, decimals) = match inner.rfind(':') {
        None => (inner, None),
        Some(colon) => {
            let digits = inner[colon + 1..].strip_prefix('.');
            // Seventeen decimals distinguish any two numbers near 1.
            let decimals = digits.and_then(|digits| digits.parse().ok()).filter(|&n: &usize| n <= 17);
            if decimals.is_none() {
                let help = "write two decimals as `{x:.2}`; there are at most 17";
                errors.push(Error::new(start + colon..end, "invalid number format", help));
            }
            (&inner[..colon], decimals)
        }
    };
    match Expression::parse(source) {
        Ok(expression) => Some(Piece::Value { expression, decimals, start }),
        Err(error) => {
            errors.push(error.moved_by(start));
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_replaced_by_their_values() {
        let caption = Caption::parse("p = {p:.2}, {{2p}} = {2 * p}").unwrap();
        assert_eq!(caption.format(|_| 2.5, |_| None), "p = 2.50, {2p} = 5");
        assert_eq!(caption.expressions().count(), 2);
        assert_eq!(Caption::parse("{p} {p:.1}").unwrap().format(|_| 2.0 / 3.0, |_| None), "0.666667 0.7");
    }

    #[test]
    fn invalid_braces_and_formats_are_errors() {
        for (text, at) in [("a {p", 2), ("a }", 2), ("{p:2}", 2), ("{p:.99}", 2), ("{p +}", 4), ("{}", 1)] {
            assert_eq!(Caption::parse(text).expect_err(text).span.start, at, "{text}");
        }
        let places =
            |text: &str| Caption::parse(text).unwrap_err().into_each().map(|e| e.span.start).collect::<Vec<_>>();
        assert_eq!(places("{p:2} a } {p +} {q:z} {r"), [2, 8, 14, 18, 22]);
    }
}
