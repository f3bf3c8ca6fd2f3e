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

/// The place of a bracket that is still open where the next entry begins, or at the end of the text; `None` if there is
/// none, or a string is not closed.
pub(super) fn unclosed_bracket(text: &str) -> Option<usize> {
    let mut open: Vec<(usize, char)> = Vec::new();
    let mut start = 0;
    let mut string: Option<&str> = None;
    for line in text.split_inclusive('\n') {
        // An entry of an inline table may be on a line of its own, but is not at the margin.
        let is_key = |(key, _): (&str, &str)| !key.contains(['"', '{', '[']);
        let is_at_margin = line.starts_with(|c: char| c.is_ascii_alphabetic());
        let begins_entry = line.starts_with('[') || is_at_margin && line.split_once('=').is_some_and(is_key);
        if let (None, true, Some((at, _))) = (string, begins_entry, open.last()) {
            return Some(*at);
        }
        let mut at = 0;
        while let Some(c) = line[at..].chars().next() {
            let rest = &line[at..];
            if let Some(quote) = string {
                if rest.starts_with(quote) {
                    string = None;
                    at += quote.len();
                } else if quote.starts_with('"') && c == '\\' {
                    at += 1 + rest[1..].chars().next().map_or(0, char::len_utf8);
                } else {
                    at += c.len_utf8();
                }
                continue;
            }
            string = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|quote| rest.starts_with(quote));
            if let Some(quote) = string {
                at += quote.len();
                continue;
            }
            match (c, open.last()) {
                ('#', _) => break,
                ('[' | '{', _) => open.push((start + at, c)),
                (']', Some((_, '['))) | ('}', Some((_, '{'))) => drop(open.pop()),
                // A bracket of the other kind, or one too many.
                (']' | '}', _) => return open.last().map(|(at, _)| *at),
                _ => {}
            }
            at += c.len_utf8();
        }
        // A string on one line that is not closed there is an error of its own.
        if string.is_some_and(|quote| quote.len() == 1) {
            return None;
        }
        start += line.len();
    }
    open.last().map(|(at, _)| *at)
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
    #[test]
    fn a_bracket_that_is_not_closed_is_found() {
        let place = |text: &'static str| unclosed_bracket(text).map(|at| &text[at..]);
        assert_eq!(place("a = [1, 2\nb = 3\n"), Some("[1, 2\nb = 3\n"));
        assert_eq!(place("a = [\n  1,\n  { x = 2 },\n]\n[b]\nc = { d = 1 # }\n"), Some("{ d = 1 # }\n"));
        assert_eq!(place("a = [{ x = 1 ]\n"), Some("{ x = 1 ]\n"));
        assert_eq!(place("[[a]\nb = 1\n"), Some("[[a]\nb = 1\n"));
        assert_eq!(place("a = \"[\"\nb = '''\n{\n'''\nc = [\"\\\"[\"]\n"), None);
        assert_eq!(place("a = \"open\nb = [1\n"), None);
    }
}
