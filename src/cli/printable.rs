//! Text from files and arguments as a terminal or a log can show it.
//!
//! Such text may come from anyone: from a recorded atlas, a path, a manifest. Control characters in it would be obeyed
//! by a terminal, and a line of it that is a workflow command would be executed by the log of a CI run. Results for
//! programs, such as CSV and JSON, are written as they are.

use std::fmt::Display;

use coupler_curves::text::is_control_or_directional;

/// Whether a character is not shown as itself: one that is obeyed, and the two characters that XML excludes besides.
pub(super) fn is_unprintable(c: char) -> bool {
    is_control_or_directional(c) || matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// A value, or a message of one line, with a visible escape for each unprintable character, as `\n` or `\u{1b}`, and
/// for the first character of `##[`, with which the runner of GitHub's workflows begins a command anywhere in a line.
pub(super) fn printable(value: impl Display) -> String {
    let text = value.to_string();
    let mut out = String::with_capacity(text.len());
    for (at, c) in text.char_indices() {
        match c {
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if is_unprintable(c) || text[at..].starts_with("##[") => push_escape(c, &mut out),
            c => out.push(c),
        }
    }
    out
}

/// A text of several lines, each printable, and none of them a workflow command, which begins with `::` after white
/// space; the line ends are those of the program.
pub(super) fn printable_lines(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let (line, end) = line.strip_suffix('\n').map_or((line, ""), |line| (line, "\n"));
        let rest = line.trim_start();
        out.push_str(&printable(&line[..line.len() - rest.len()]));
        match rest.strip_prefix("::") {
            Some(rest) => {
                push_escape(':', &mut out);
                out.push(':');
                out.push_str(&printable(rest));
            }
            None => out.push_str(&printable(rest)),
        }
        out.push_str(end);
    }
    out
}

/// Appends the escape of a character.
fn push_escape(c: char, out: &mut String) {
    out.push_str(&format!("\\u{{{:x}}}", u32::from(c)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_and_bidirectional_characters_become_visible() {
        let text = "é\u{0}\u{1b}[31m\u{7f}\u{9b}\u{202e}\u{2067}\u{200f}\u{2028}\u{ffff}\r\n\t€𝄞";
        let shown = printable(text);
        assert_eq!(shown, "é\\u{0}\\u{1b}[31m\\u{7f}\\u{9b}\\u{202e}\\u{2067}\\u{200f}\\u{2028}\\u{ffff}\\r\\n\\t€𝄞");
        assert!(!shown.contains(is_unprintable));
    }

    #[test]
    fn lines_keep_their_ends_and_hide_commands() {
        let text = "a: b::c\n::error::x\n \t ::warning::y\r\n\u{85}::notice::z\nx ##[error]\n";
        let lines =
            "a: b::c\n\\u{3a}:error::x\n \\t \\u{3a}:warning::y\\r\n\\u{85}\\u{3a}:notice::z\nx \\u{23}#[error]\n";
        assert_eq!(printable_lines(text), lines);
        assert_eq!(printable_lines("no line end"), "no line end");
    }
}
