//! Splits the text of an expression into tokens.

use super::Error;
use crate::problem::Span;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    Number(f64),
    Name(&'a str),
    Plus,
    Minus,
    /// Before the tolerance of `==`.
    PlusMinus,
    Star,
    Slash,
    Caret,
    Open,
    Close,
    Comma,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    And,
    Or,
    Not,
    End,
}

/// The tokens of a text with their spans; the last is [`Token::End`].
pub(super) fn tokenize(text: &str) -> Result<Vec<(Token<'_>, Span)>, Error> {
    let mut out = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let start = at;
        at += c.len_utf8();
        if c.is_whitespace() {
            continue;
        }
        let next = text[at..].chars().next();
        let token = match c {
            '0'..='9' | '.' => {
                at = number_end(text, start);
                let digits = &text[start..at];
                Token::Number(digits.parse().map_err(|_| {
                    Error::new(start..at, format!("`{digits}` is not a number"), "write it like 2, 2.5 or 1e-3")
                })?)
            }
            'a'..='z' | 'A'..='Z' | '_' => {
                let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
                at = start + text[start..].find(|c| !is_word(c)).unwrap_or(text.len() - start);
                match &text[start..at] {
                    "and" => Token::And,
                    "or" => Token::Or,
                    "not" => Token::Not,
                    name => Token::Name(name),
                }
            }
            '±' => Token::PlusMinus,
            '+' if next == Some('-') => {
                at += 1;
                Token::PlusMinus
            }
            '+' => Token::Plus,
            '-' => Token::Minus,
            '*' => Token::Star,
            '/' => Token::Slash,
            '^' => Token::Caret,
            '(' => Token::Open,
            ')' => Token::Close,
            ',' => Token::Comma,
            '=' | '!' | '<' | '>' if next == Some('=') => {
                at += 1;
                match c {
                    '=' => Token::Equal,
                    '!' => Token::NotEqual,
                    '<' => Token::LessOrEqual,
                    _ => Token::GreaterOrEqual,
                }
            }
            '<' => Token::Less,
            '>' => Token::Greater,
            _ => {
                let help = match c {
                    '=' if text[start..].starts_with("=>") => "write `>=`",
                    '=' if text[start..].starts_with("=<") => "write `<=`",
                    '=' => "compare with `==`",
                    '!' => "write `not` or `!=`",
                    '&' => "write `and`",
                    '|' => "write `or`",
                    '−' | '–' => "write the minus sign as `-`",
                    '×' | '·' => "write multiplication as `*`",
                    '°' => {
                        "leave it out: what ends in `_deg` is in degrees; the value of an angle is written `30 deg`"
                    }
                    _ if c.is_alphabetic() => "names have letters from a to z and A to Z, digits and underscores",
                    _ => "an expression has numbers, names, + - * / ^, comparisons, and, or, not, and functions",
                };
                return Err(Error::new(start..at, format!("unexpected `{c}`"), help));
            }
        };
        if token == Token::Star && next == Some('*') {
            return Err(Error::new(start..at + 1, "unexpected `**`", "write a power with `^`"));
        }
        out.push((token, start..at));
    }
    out.push((Token::End, text.len()..text.len()));
    Ok(out)
}

/// The end of the number that starts at `start`: its digits, fraction and exponent.
fn number_end(text: &str, start: usize) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let mut at = digits(start);
    if bytes.get(at) == Some(&b'.') {
        at = digits(at + 1);
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let sign = at + 1 + usize::from(matches!(bytes.get(at + 1), Some(b'+' | b'-')));
        if bytes.get(sign).is_some_and(u8::is_ascii_digit) {
            at = digits(sign);
        }
    }
    at
}
