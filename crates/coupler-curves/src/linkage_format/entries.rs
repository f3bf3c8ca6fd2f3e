//! The entries of a TOML text, a key and its value or a header, found without parsing it.

use crate::problem::Span;

/// The lines around a place in a text: from the one that begins an entry or a header up to the next that does.
pub(super) fn entry_around(text: &str, at: usize) -> Span {
    let begins_entry = |line: &str| {
        let is_of_key = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '"' | '\'' | ' ');
        let key = line.split_once('=').map(|(key, _)| key);
        line.starts_with('[') || key.is_some_and(|key| !key.trim().is_empty() && key.chars().all(is_of_key))
    };
    let (mut start, mut line_start) = (0, 0);
    for line in text.split_inclusive('\n') {
        if begins_entry(line) {
            if line_start > at {
                return start..line_start;
            }
            start = line_start;
        }
        line_start += line.len();
    }
    start..text.len() + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_reaches_up_to_the_next() {
        let text = "a = [\n  1 2,\n  { x = 3 },\n]\nb = 1\n[c]\nd = 2";
        let entry = |part: &str| &text[entry_around(text, text.find(part).unwrap()).start..][..1];
        assert_eq!(["a", "1", "x", "b", "c", "d"].map(entry), ["a", "a", "a", "b", "[", "d"]);
        assert_eq!(entry_around(text, 0), 0..text.find('b').unwrap());
        assert_eq!(entry_around(text, text.len()).end, text.len() + 1);
    }
}
