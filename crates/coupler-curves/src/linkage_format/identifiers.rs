//! Names that folders, files and expressions can have.

use super::toml_parser::{TomlParser, TomlValue};
use crate::problem::{Problem, Span};

/// Parses a name for folders and files: at most 64 lower-case letters, digits and single hyphens, and not a device name
/// of Windows.
pub fn parse_slug<'t>(value: &TomlValue<'t>, parser: &mut TomlParser<'t>) -> Option<String> {
    let text = parser.text(value)?;
    let parts_are_plain = text
        .split('-')
        .all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit()));
    if is_windows_device(&text) {
        let problem = Problem::error(value.span(), format!("the id `{text}` is a device name on Windows"));
        let help = format!("an id names folders and files; choose another, as in \"{text}-1\"");
        parser.report(problem.with_help(help));
        return None;
    }
    if parts_are_plain && text.len() <= 64 {
        return Some(text);
    }
    let lower = text.to_lowercase();
    let words: Vec<&str> = lower.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty()).collect();
    let suggestion = if words.is_empty() { "evans".to_owned() } else { words.join("-").chars().take(64).collect() };
    let problem = Problem::error(value.span(), format!("the id `{}` is not a slug", text.escape_debug()));
    parser.report(problem.with_help(format!(
        "it names folders and files: lower-case letters, digits and hyphens, as in \"{suggestion}\""
    )));
    None
}

/// Whether Windows reserves a name for a device (Microsoft, *Naming files, paths, and namespaces*).
fn is_windows_device(name: &str) -> bool {
    let port = name.strip_prefix("com").or_else(|| name.strip_prefix("lpt"));
    let is_port = port.is_some_and(|number| number.len() == 1 && number.bytes().all(|b| b.is_ascii_digit()));
    is_port || ["con", "prn", "aux", "nul"].contains(&name)
}

/// Reports a parameter, helper or grid name that cannot be used in an expression.
pub fn check_identifier(name: &str, span: Span, parser: &mut TomlParser) {
    if let Some([message, help]) = identifier_error(name) {
        parser.report(Problem::error(span, message).with_help(help));
    }
}

/// Why expressions cannot use a name, if they cannot, and what to do.
pub fn identifier_error(name: &str) -> Option<[String; 2]> {
    let first = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    let is_word = first && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let is_reserved = ["and", "or", "not", "pi"].contains(&name);
    let [why, help] = match is_reserved {
        true => ["is reserved", "expressions have it as a word of their own: use another name"],
        false => [
            "cannot be used in an expression",
            "a name is a letter from a to z or A to Z, then these, digits and underscores",
        ],
    };
    (!is_word || is_reserved).then(|| [format!("the name `{}` {why}", name.escape_debug()), help.to_owned()])
}
