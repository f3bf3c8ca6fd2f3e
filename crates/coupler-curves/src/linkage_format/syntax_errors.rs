//! What is wrong where TOML cannot be parsed, and how it is written.

use crate::expression::length_unit_help;
use crate::problem::{Problem, Span};

/// The problem for a syntax error at a place with the message of the TOML parser.
pub(super) fn syntax_problem(text: &str, span: Span, message: &str) -> Problem {
    let [message, help] = slip(text, &span, message).unwrap_or_else(|| {
        let help = match message {
            "duplicate key" => "leave one of the two out, or give it another name",
            message if message.contains("recurs") => "put fewer lists and tables into each other",
            _ => "see https://toml.io for how tables, keys and values are written",
        };
        [message.to_owned(), help.to_owned()]
    });
    Problem::error(span, format!("invalid TOML: {message}")).with_help(help)
}

/// What is wrong and what to write, where that can be recognized.
fn slip(text: &str, span: &Span, message: &str) -> Option<[String; 2]> {
    if let Some(number) = number_with_commas(text, span.start) {
        let list = number.replace(',', ", ");
        let help = match number.matches(',').count() {
            1 => format!("write a decimal point, {}, or a list of values, [{list}]", number.replace(',', ".")),
            _ => format!("put a list of values in brackets, [{list}]"),
        };
        return Some([format!("`{number}` has a comma and no brackets"), help]);
    }
    let is_string = message.starts_with("string values must be quoted");
    if let Some(value) = unquoted_value(text, span, is_string) {
        let word = ["true", "false"].into_iter().find(|word| value.eq_ignore_ascii_case(word));
        let bare = value.trim_matches(['“', '”', '„', '‘', '’', '«', '»']);
        return Some(match word {
            None if bare.len() < value.len() => {
                [format!("{value} has other quotes than TOML"), format!("write them straight: \"{bare}\"")]
            }
            Some(word) => [format!("`{value}` is not a boolean"), format!("write `{word}`")],
            None => {
                let length = value.split_once(' ').filter(|(number, _)| number.parse::<f64>().is_ok());
                let length = length.and_then(|(_, unit)| length_unit_help(unit.trim()));
                let help = length.unwrap_or_else(|| format!("write \"{value}\""));
                [format!("`{value}` is not in quotes"), help]
            }
        });
    }
    // The parser takes values without a comma between them for a string without quotes.
    let has_blank = text.get(span.clone()).is_some_and(|text| text.trim().contains([' ', '\t']));
    (has_blank && is_string).then(|| ["there is no comma between values", "write them like [1, 2]"].map(str::to_owned))
}

/// The most bytes on either side of an error that are read: what is longer is no slip in a value.
const MAX_BYTES: usize = 200;

/// The line around a place, at most so much of it, and the place in it.
fn line_around(text: &str, at: usize) -> (&str, usize) {
    let at = text.floor_char_boundary(at);
    let (from, to) = (text.ceil_char_boundary(at.saturating_sub(MAX_BYTES)), text.floor_char_boundary(at + MAX_BYTES));
    let start = text[from..at].rfind('\n').map_or(from, |end| from + end + 1);
    let end = text[at..to].find(['\r', '\n']).map_or(to, |end| at + end);
    (&text[start..end], at - start)
}

/// The numbers after an `=` around a place that are divided by commas without blanks, as `4,5`.
fn number_with_commas(text: &str, at: usize) -> Option<&str> {
    let (line, at) = line_around(text, at);
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '+');
    let start = line[..at].trim_end().trim_end_matches(is_of_number).len();
    let rest = &line[start..];
    let number = rest[..rest.find(|c| !is_of_number(c)).unwrap_or(rest.len())].trim_end_matches(',');
    let is_value = line[..start].trim_end().ends_with('=');
    let is_number =
        |part: &str| part.starts_with(|c: char| c.is_ascii_digit() || c == '-') && part.parse::<f64>().is_ok();
    (is_value && number.contains(',') && number.split(',').all(is_number)).then_some(number)
}

/// The value at a place that is words without quotes: the whole value after an `=`, or if the place is that of a string, this.
fn unquoted_value<'t>(text: &'t str, span: &Span, is_string: bool) -> Option<&'t str> {
    let (line, at) = line_around(text, span.start);
    let after = line[..at].rfind('=').map(|equals| &line[equals + 1..]);
    let is_in_table = line.contains('{');
    let end = |c: char| c == '#' || is_in_table && matches!(c, ',' | '}');
    let whole = after.map(|value| value.split(end).next().unwrap_or_default().trim());
    let part = text.get(span.clone()).filter(|part| is_string && part.len() <= MAX_BYTES).map(str::trim);
    let is_unquoted = |value: &&str| {
        let unsigned = value.trim_start_matches(['+', '-']);
        let is_number = ["inf", "nan"].iter().any(|word| unsigned.eq_ignore_ascii_case(word));
        let is_bare = !value.contains(['"', '\'', '[', ']', '{', '}', '=', '\\', ',', '\n']);
        value.contains(char::is_alphabetic) && is_bare && !is_number
    };
    whole.into_iter().chain(part).find(is_unquoted)
}

#[cfg(test)]
mod tests {
    use crate::linkage_format::TomlParser;

    /// The message of the first problem of a text without "invalid TOML: ", and its help.
    fn problem(text: &str) -> [String; 2] {
        let mut parser = TomlParser::new(text);
        parser.parse_document();
        let problem = parser.into_problems().into_iter().next().unwrap_or_else(|| panic!("{text} is valid"));
        [problem.message.strip_prefix("invalid TOML: ").unwrap().to_owned(), problem.help]
    }

    #[test]
    fn strings_without_quotes_are_named_with_them() {
        for (text, value) in [
            ("title = T", "T"),
            ("title = My bars # all", "My bars"),
            ("a.b = \"x\"\nlinkage = four-bar\nc = 1", "four-bar"),
            ("grid = { p = 2*q, r = 1 }", "2*q"),
            ("formats = [pdf, \"svg\"]", "pdf"),
            ("step = 2 deg", "2 deg"),
        ] {
            assert_eq!(problem(text), [format!("`{value}` is not in quotes"), format!("write \"{value}\"")], "{text}");
        }
        assert_eq!(problem("index = True"), ["`True` is not a boolean", "write `true`"]);
        assert_eq!(problem("title = “T”"), ["“T” has other quotes than TOML", "write them straight: \"T\""]);
    }

    #[test]
    fn a_decimal_comma_is_named() {
        let help = "write a decimal point, 4.5, or a list of values, [4, 5]";
        for text in [
            "frame = 4,5",
            "grid = { frame = 4,5, crank = 1 }",
            "grid = {frame=4,5}",
            "grid = { frame = 4,5 }",
            "a = 1\nframe = 4,5\nb = 2",
        ] {
            assert_eq!(problem(text), ["`4,5` has a comma and no brackets", help], "{text}");
        }
        assert_eq!(problem("p = 1,2,-3.5")[1], "put a list of values in brackets, [1, 2, -3.5]");
    }

    #[test]
    fn other_errors_are_those_of_toml() {
        assert_eq!(problem("p = [1 2]"), ["there is no comma between values", "write them like [1, 2]"]);
        for text in ["p = ", "= 2", "p = 1 =", "p = 5.", "a = \"x", "p = [1,,2]"] {
            assert!(problem(text)[1].contains("https://toml.io"), "{text}: {:?}", problem(text));
        }
    }
}
