//! Counts in words, and characters that a text does not show as themselves.

/// A count with its noun: "1 page", "2 pages", "3 families".
pub fn pluralize(count: usize, noun: &str) -> String {
    let ends_in_y = noun.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'i', 'o', 'u']));
    match (count, ends_in_y) {
        (1, _) => format!("1 {noun}"),
        (_, Some(stem)) => format!("{count} {stem}ies"),
        (_, None) => format!("{count} {noun}s"),
    }
}

/// Whether a character is obeyed rather than shown: control characters, the separators of lines and paragraphs, and marks,
/// embeddings, overrides and isolates of direction.
pub fn is_control_or_directional(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Whether a character shows nothing itself: one that is obeyed ([`is_control_or_directional`]), joiners and blanks without width, fillers, selectors
/// of variants, and tags. Other blanks are not among them.
pub fn is_invisible(c: char) -> bool {
    let is_joiner = matches!(c, '\u{ad}' | '\u{34f}' | '\u{200b}'..='\u{200d}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
    let is_filler = matches!(c, '\u{115f}' | '\u{1160}' | '\u{2800}' | '\u{3164}' | '\u{ffa0}');
    let is_selector = matches!(c, '\u{180b}'..='\u{180f}' | '\u{fe00}'..='\u{fe0f}' | '\u{e0000}'..='\u{e0fff}');
    is_control_or_directional(c) || is_joiner || is_filler || is_selector
}

/// The parts of a word that fit a line each, as long as possible: it is divided after a hyphen or a dash or before a capital where that is in the
/// second half of what fits, and otherwise anywhere. A character that does not fit is a part of its own.
pub fn divide_word(word: &str, fits: impl Fn(&str) -> bool) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut rest = word;
    loop {
        // What is far behind is not measured for each part: the time grows with the length of the word.
        let places = rest.char_indices().skip(1).map(|(at, _)| at).chain([rest.len()]);
        let ends: Vec<usize> = places.take_while(|at| fits(&rest[..*at])).collect();
        if ends.last().is_some_and(|end| *end == rest.len()) || rest.is_empty() {
            break;
        }
        let is_good = |at: &&usize| {
            let [before, after] = [rest[..**at].chars().next_back(), rest[**at..].chars().next()];
            before.is_some_and(|c| matches!(c, '-' | '–' | '/' | '_'))
                || before.is_some_and(char::is_lowercase) && after.is_some_and(char::is_uppercase)
        };
        let one = rest.chars().next().map_or(0, char::len_utf8);
        let last = ends.last().copied().unwrap_or(one);
        let end = ends.iter().rev().take_while(|at| 2 * **at >= last).find(is_good).copied().unwrap_or(last);
        let (part, after) = rest.split_at(end);
        parts.push(part);
        rest = after;
    }
    if !rest.is_empty() || parts.is_empty() {
        parts.push(rest);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_have_their_nouns() {
        let counts = [(0, "page"), (1, "page"), (2, "page"), (1, "family"), (3, "family"), (2, "survey")];
        let texts = ["0 pages", "1 page", "2 pages", "1 family", "3 families", "2 surveys"];
        assert_eq!(counts.map(|(count, noun)| pluralize(count, noun)), texts);
    }

    #[test]
    fn what_is_obeyed_is_invisible_and_what_is_seen_is_not() {
        for c in ['\0', '\n', '\u{1b}', '\u{7f}', '\u{9b}', '\u{61c}', '\u{200f}', '\u{2028}', '\u{202e}', '\u{2067}'] {
            assert!(is_control_or_directional(c) && is_invisible(c), "{c:?}");
        }
        for c in ['\u{ad}', '\u{200b}', '\u{200d}', '\u{2060}', '\u{feff}', '\u{3164}', '\u{fe0f}', '\u{e0041}'] {
            assert!(!is_control_or_directional(c) && is_invisible(c), "{c:?}");
        }
        for c in [' ', '\u{a0}', 'a', 'é', 'ק', '\u{301}', '€', '𝄞'] {
            assert!(!is_control_or_directional(c) && !is_invisible(c), "{c:?}");
        }
    }

    #[test]
    fn words_are_divided_where_their_parts_meet() {
        let divided = |word, width: usize| divide_word(word, |part| part.chars().count() <= width);
        assert_eq!(divided("FixedPivotOfTheCrank–PinOfTheCrank", 16), ["FixedPivotOfThe", "Crank–PinOfThe", "Crank"]);
        assert_eq!(divided("FixedPivotOfTheCrank–PinOfTheCrank", 21), ["FixedPivotOfTheCrank–", "PinOfTheCrank"]);
        assert_eq!(divided("äöüäöüäöü", 4), ["äöüä", "öüäö", "ü"]);
        assert_eq!(divided("ab", 0), ["a", "b"]);
        assert_eq!(divided("", 3), [""]);
        assert_eq!(divided("short", 9), ["short"]);
    }
}
