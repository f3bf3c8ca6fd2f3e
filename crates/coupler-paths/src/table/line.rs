//! The lines of a table and their cells.

/// A line that is neither blank nor a comment, or what follows the mark of a comment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// Its number in the file, from 1.
    pub number: usize,
    pub text: &'a str,
    pub is_comment: bool,
    /// Whether a blank line is before it.
    pub follows_blank: bool,
}

/// What divides the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Divider {
    /// A character.
    Char(char),
    /// Any number of blanks and tabs.
    Blanks,
    /// Any white space, also no-break spaces.
    AnyBlanks,
}

/// The lines of a text, without those that are blank or have nothing but dividers, and without comments after the cells: what follows `#`.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    // The line ends of old systems are carriage returns alone.
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let mut follows_blank = false;
    (1..).zip(text.split(end)).filter_map(move |(number, line)| {
        let line = line.trim_matches(|c: char| c.is_whitespace() && c != '\t' || c == '\u{feff}');
        let start = line.trim_start_matches('\t');
        let comment = ["#", "%", "//"].iter().find_map(|mark| start.strip_prefix(mark));
        let text =
            comment.map_or_else(|| without_comment(line), |comment| comment.trim_start_matches(['#', '%']).trim());
        let is_blank = text.chars().all(|c| c.is_whitespace() || matches!(c, ',' | ';' | '"' | '\u{feff}'));
        if is_blank {
            follows_blank |= comment.is_none();
            return None;
        }
        let found = Line { number, text, is_comment: comment.is_some(), follows_blank };
        follows_blank &= comment.is_some();
        Some(found)
    })
}

/// What is before the first `#` that is not in quotes.
fn without_comment(line: &str) -> &str {
    let mut is_quoted = false;
    let mark = line.char_indices().find(|(_, c)| {
        is_quoted ^= *c == '"';
        *c == '#' && !is_quoted
    });
    mark.map_or(line, |(at, _)| line[..at].trim_end_matches(' '))
}

/// The cells of a line, without their quotes and blanks, and without a last one that is empty.
pub(super) fn cells(line: &str, divider: Divider) -> Vec<String> {
    let is_divider = |c: char| match divider {
        Divider::Char(own) => c == own,
        Divider::Blanks => c.is_ascii_whitespace(),
        Divider::AnyBlanks => c.is_whitespace(),
    };
    let mut cells = Vec::new();
    let mut cell = String::new();
    let mut is_quoted = false;
    let mut chars = line.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            // Quotes within quotes are doubled.
            '"' if is_quoted && chars.peek() == Some(&'"') => {
                chars.next();
                cell.push('"');
            }
            '"' => is_quoted = !is_quoted,
            c if is_divider(c) && !is_quoted => push_cell(&mut cells, std::mem::take(&mut cell), divider),
            c => cell.push(c),
        }
    }
    push_cell(&mut cells, cell, divider);
    if cells.len() > 1 && cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
    cells
}

fn push_cell(cells: &mut Vec<String>, cell: String, divider: Divider) {
    let text = cell.trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
    match (divider, cells.last_mut()) {
        (Divider::Char(_), _) => cells.push(text.to_owned()),
        (_, _) if text.is_empty() => {}
        // A unit belongs to the name before it.
        (_, Some(name)) if text.starts_with(['[', '(']) => *name = format!("{name} {text}"),
        _ => cells.push(text.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_without_quotes_and_blanks() {
        for (line, divider, expected) in [
            ("\"0,58\", \"2,02\"", Divider::Char(','), vec!["0,58", "2,02"]),
            (" 1 ;2;\u{a0}3 ;", Divider::Char(';'), vec!["1", "2", "3"]),
            ("\tx\ty", Divider::Char('\t'), vec!["", "x", "y"]),
            ("\"a \"\"b\"\"\" 2\t 3", Divider::Blanks, vec!["a \"b\"", "2", "3"]),
            ("x [mm]  y (mm)", Divider::Blanks, vec!["x [mm]", "y (mm)"]),
            ("1\u{a0}2", Divider::AnyBlanks, vec!["1", "2"]),
            ("1,,3", Divider::Char(','), vec!["1", "", "3"]),
        ] {
            assert_eq!(cells(line, divider), expected, "{line}");
        }
    }

    #[test]
    fn blank_lines_and_comments_are_known() {
        let found: Vec<_> = lines("# a\n\n 1,2 # b\r\n;;\n\"#\",3\n% c\n").collect();
        let texts: Vec<_> = found.iter().map(|line| (line.number, line.text, line.is_comment)).collect();
        assert_eq!(texts, [(1, "a", true), (3, "1,2", false), (5, "\"#\",3", false), (6, "c", true)]);
        assert_eq!(found.iter().map(|line| line.follows_blank).collect::<Vec<_>>(), [false, true, true, false]);
        assert_eq!(lines("1,2\r3,4\r").count(), 2);
    }
}
