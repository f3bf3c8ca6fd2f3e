//! Texts as a document can contain them.

/// A text without control characters and noncharacters, which the metadata of a document cannot contain.
pub(super) fn sanitize_text(text: &str) -> String {
    let sanitized = |c: char| match c {
        '\t' | '\n' | '\r' => ' ',
        '\0'..='\x1f' | '\x7f' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    };
    text.chars().map(sanitized).collect()
}
