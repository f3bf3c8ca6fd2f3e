//! Numbers in the cells of a table.

/// How the numbers of a table are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NumberStyle {
    /// The decimal separator: a point or a comma.
    pub decimal: char,
    /// What divides groups of three digits, besides apostrophes and no-break spaces, which have no other meaning.
    pub grouping: Option<char>,
}

impl NumberStyle {
    pub const POINT: NumberStyle = NumberStyle { decimal: '.', grouping: None };
    pub const COMMA: NumberStyle = NumberStyle { decimal: ',', grouping: None };
    pub const GROUPED_POINT: NumberStyle = NumberStyle { decimal: '.', grouping: Some(',') };
    pub const GROUPED_COMMA: NumberStyle = NumberStyle { decimal: ',', grouping: Some('.') };
}

/// Whether a cell has no value: empty, or one of the words that programs write in its place.
pub(super) fn is_missing(cell: &str) -> bool {
    const WORDS: [&str; 7] = ["-", "na", "n/a", "#n/a", "nan", "null", "none"];
    cell.is_empty() || WORDS.iter().any(|word| cell.eq_ignore_ascii_case(word))
}

/// Reads a number, which may be infinite or not a number; `None` if the cell is none.
pub(super) fn parse_number(cell: &str, style: NumberStyle) -> Option<f64> {
    let (sign, digits) = match cell.chars().next()? {
        // The signs of typesetting: minus, the en dash, and the full-width and the small hyphen.
        '-' | '\u{2212}' | '\u{2013}' | '\u{ff0d}' | '\u{fe63}' => ("-", &cell[cell.chars().next()?.len_utf8()..]),
        '+' => ("", &cell[1..]),
        _ => ("", cell),
    };
    if ["nan", "inf", "infinity"].iter().any(|word| digits.eq_ignore_ascii_case(word)) {
        return format!("{sign}{digits}").parse().ok();
    }
    let (mantissa, exponent) = match digits.find(['e', 'E', 'd', 'D']) {
        Some(at) => (&digits[..at], parse_exponent(&digits[at + 1..])?),
        None => (digits, String::new()),
    };
    let (whole, fraction) = mantissa.split_once(style.decimal).unwrap_or((mantissa, ""));
    let whole = ungrouped(whole, style.grouping)?;
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_digits(fraction) || whole.len() + fraction.len() == 0 {
        return None;
    }
    format!("{sign}{whole}.{fraction}{exponent}").parse().ok()
}

fn parse_exponent(text: &str) -> Option<String> {
    let digits = text.strip_prefix(['+', '-', '\u{2212}']).unwrap_or(text);
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let sign = if text.starts_with(['-', '\u{2212}']) { "-" } else { "" };
    is_number.then(|| format!("e{sign}{digits}"))
}

/// Digits without the separators of their groups of three; `None` if it has other characters or groups.
fn ungrouped(text: &str, grouping: Option<char>) -> Option<String> {
    let is_separator =
        |c: char| matches!(c, '\'' | '\u{2019}' | '\u{a0}' | '\u{202f}' | '\u{2009}') || Some(c) == grouping;
    let groups: Vec<&str> = text.split(is_separator).collect();
    let is_digits = |group: &&str| group.bytes().all(|byte| byte.is_ascii_digit());
    let has_threes =
        groups.len() == 1 || (1..=3).contains(&groups[0].len()) && groups[1..].iter().all(|group| group.len() == 3);
    (groups.iter().all(is_digits) && has_threes).then(|| groups.concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_they_are_written() {
        let point = |text| parse_number(text, NumberStyle::POINT);
        for (text, value) in [
            ("1.5", 1.5),
            ("-.5", -0.5),
            ("+2.", 2.0),
            ("1e-3", 1e-3),
            ("1.5D+02", 150.0),
            ("\u{2212}2.5e\u{2212}1", -0.25),
            ("\u{2013}3", -3.0),
            ("12'345.5", 12345.5),
            ("1\u{a0}234\u{202f}567", 1_234_567.0),
            ("-inf", f64::NEG_INFINITY),
        ] {
            assert_eq!(point(text), Some(value), "{text}");
        }
        for text in ["", "-", ".", "e5", "1e", "1,5", "1.5.2", "12 34", "1'23", "0x10", "1_0", "1.5mm", "1.5,2", "--1"]
        {
            assert_eq!(point(text), None, "{text}");
        }
        assert_eq!(parse_number("1.234,5", NumberStyle::GROUPED_COMMA), Some(1234.5));
        assert_eq!(parse_number("1,234.5", NumberStyle::GROUPED_POINT), Some(1234.5));
        assert_eq!(parse_number("1234,5", NumberStyle::COMMA), Some(1234.5));
        assert_eq!(parse_number("1.234,5", NumberStyle::COMMA), None);
        assert!(is_missing("NaN") && is_missing("") && !is_missing("0"));
    }
}
