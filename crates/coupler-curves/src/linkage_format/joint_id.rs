//! What the id of a joint may be: it is a field of tables and a word in messages.

use crate::problem::{Problem, Span};
use crate::text::is_invisible;

/// The problem of a joint's id, if it is empty, does not look like what it is, or is a formula to a spreadsheet.
pub(super) fn check_joint_id(id: &str, span: &Span) -> Option<Problem> {
    let shown: String =
        id.chars().map(|c| if is_invisible(c) { c.escape_unicode().to_string() } else { c.into() }).collect();
    let (message, help) = if id.trim().is_empty() {
        ("the id of a joint is empty".to_owned(), "name it, as in `A`")
    } else if id.trim() != id {
        (format!("the id `{shown}` of a joint begins or ends with a blank"), "leave the blank out")
    } else if let Some(c) = id.chars().find(|&c| is_invisible(c)) {
        let message = format!("the id `{shown}` of a joint has the invisible character U+{:04X}", c as u32);
        (message, "leave it out: the id would look like another, or change the order of what is around it")
    } else if id.starts_with(FORMULA_MARKS) {
        let message = format!("the id `{shown}` of a joint begins like a formula, which a spreadsheet would compute");
        (message, "begin it with a letter, a digit or a quotation mark")
    } else {
        return None;
    };
    Some(Problem::error(span.clone(), message).with_help(help))
}

/// What a formula begins with, also in the wide forms that spreadsheets take for the same.
const FORMULA_MARKS: [char; 8] = ['=', '+', '-', '@', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}'];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_what_it_looks_like() {
        let problem = |id: &str| check_joint_id(id, &(0..id.len())).map(|problem| problem.message);
        for id in ["A", "A_0", "A-1", "B'", "2", "Ω", "קרנק", "the pin", "a=b"] {
            assert_eq!(problem(id), None);
        }
        for (id, word) in [
            ("", "is empty"),
            (" \t", "is empty"),
            (" A", "begins or ends with a blank"),
            ("A\u{202e}B", "`A\\u{202e}B` of a joint has the invisible character U+202E"),
            ("\u{2067}A", "U+2067"),
            ("A\u{200f}", "U+200F"),
            ("A\u{200b}", "U+200B"),
            ("A\u{7}", "U+0007"),
            ("A\u{3164}", "U+3164"),
            ("A\u{fe0f}", "U+FE0F"),
            ("A\u{e0041}", "U+E0041"),
            ("=HYPERLINK(\"http://a.b\")", "begins like a formula"),
            ("+1", "begins like a formula"),
            ("-1", "begins like a formula"),
            ("@SUM(A1)", "begins like a formula"),
            ("\u{ff1d}1+1", "begins like a formula"),
        ] {
            assert!(problem(id).is_some_and(|message| message.contains(word)), "{id:?}: {:?}", problem(id));
        }
    }
}
