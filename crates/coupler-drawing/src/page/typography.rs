//! Typographic characters from plain input: apostrophes, quotation marks, dashes, minus signs and raised digits.

use coupler_curves::text;

/// The text with the characters of typesetting in place of those of a typewriter: `'` and `"` become quotation marks or an
/// apostrophe, a hyphen between spaces and two hyphens an en dash, three hyphens an em dash, a hyphen before a number a minus
/// sign, three dots an ellipsis. A hyphen in a word, and between digits, stays.
pub(super) fn typeset(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let before = out.chars().next_back();
        let (set, length) = set_next(before, rest).unwrap_or((c, c.len_utf8()));
        out.push(set);
        rest = &rest[length..];
    }
    out
}

/// The character that replaces the beginning of a text, and the length of that beginning in bytes; `None` if the first
/// character stays.
fn set_next(before: Option<char>, rest: &str) -> Option<(char, usize)> {
    let opens = before.is_none_or(|c| c.is_whitespace() || matches!(c, '(' | '[' | '“' | '‘' | '–' | '—'));
    let after = rest.chars().nth(1);
    match rest.as_bytes() {
        // What is not closed again is an apostrophe, as in 'Twas.
        [b'\'', ..] => Some((if opens && is_closed_again(&rest[1..]) { '‘' } else { '’' }, 1)),
        [b'"', ..] => Some((if opens { '“' } else { '”' }, 1)),
        [b'.', b'.', b'.', ..] => Some(('…', 3)),
        [b'-', b'-', b'-', ..] => Some(('—', 3)),
        [b'-', b'-', ..] => Some(('–', 2)),
        [b'-', b' ', ..] if before == Some(' ') => Some(('–', 1)),
        [b'-', ..] => {
            let is_sign = after.is_some_and(|c| c.is_ascii_digit() || c == '.')
                && before.is_none_or(|c| !c.is_alphanumeric() && c != ')');
            is_sign.then_some(('−', 1))
        }
        _ => None,
    }
}

/// Whether a text after an opening single quotation mark has the closing one: after a word, and not in it.
fn is_closed_again(text: &str) -> bool {
    text.match_indices('\'').any(|(at, _)| {
        let (before, after) = (text[..at].chars().next_back(), text[at + 1..].chars().next());
        before.is_some_and(|c| !c.is_whitespace()) && after.is_none_or(|c| !c.is_alphanumeric())
    })
}

/// Whether the letter at the end of `before` is an article or a pronoun and not a symbol: it is followed by a word that may
/// follow an article.
pub(super) fn is_article(letter: &str, after: &str) -> bool {
    /// Words that follow a symbol but not an article.
    const AFTER_SYMBOLS: [&str; 21] = [
        "about", "above", "across", "along", "and", "are", "as", "at", "below", "by", "for", "from", "has", "in", "is",
        "of", "on", "or", "times", "to", "with",
    ];
    let Some(after) = after.strip_prefix(' ') else { return false };
    let word = after.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
    matches!(letter, "a" | "A" | "I") && word.chars().nth(1).is_some() && !AFTER_SYMBOLS.contains(&word)
}

/// Whether a letter is followed by its value, so that it is a symbol, as `k` in "k = 2".
pub(super) fn is_defined(letter: &str, after: &str) -> bool {
    letter.chars().all(char::is_alphabetic) && letter.chars().nth(1).is_none() && begins_with_value(after)
}

/// Whether a value follows, exact or rounded.
pub(super) fn begins_with_value(text: &str) -> bool {
    [" = ", " ≈ "].iter().any(|sign| text.starts_with(sign))
}

/// A number with a fixed number of decimals and a true minus sign.
pub(super) fn format_fixed(value: f64, decimals: usize) -> String {
    text::format_fixed(value, decimals).replace('-', "−")
}

/// A whole number as superscript digits.
pub(super) fn superscript(number: &str) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| if c == '-' { Some('⁻') } else { DIGITS.get(c.to_digit(10)? as usize).copied() };
    number.chars().filter_map(raise).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_characters_become_those_of_typesetting() {
        for (plain, set) in [
            ("Jansen's leg", "Jansen’s leg"),
            ("the 'holy' numbers", "the ‘holy’ numbers"),
            ("'Twas in '51", "’Twas in ’51"),
            ("\"How (\"a\")\"", "“How (“a”)”"),
            ("u = -1.5, (-2) and x-1", "u = −1.5, (−2) and x-1"),
            (
                "Roberts - Chebyshev, Roberts-Chebyshev, 1--2, 10-12",
                "Roberts – Chebyshev, Roberts-Chebyshev, 1–2, 10-12",
            ),
            ("one --- 'two' ---three", "one — ‘two’ —three"),
            ("and so on...", "and so on…"),
            ("", ""),
        ] {
            assert_eq!(typeset(plain), set);
        }
    }

    #[test]
    fn articles_are_not_symbols() {
        for (after, expected) in [
            (" point of the rocker", true),
            (" from the crank pin", false),
            (", rocker s", false),
            (" = s", false),
            ("", false),
            (" b", false),
        ] {
            assert_eq!(is_article("a", after), expected, "{after}");
        }
        assert!(!is_article("p", " point"));
    }
}
