//! What to write in place of arguments that are wrong.

use std::ffi::OsString;
use std::path::Path;

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};

use super::files;

/// The error in the arguments of a command line, with a hint where it is known what was meant.
pub(super) fn with_hint(mut error: Error, command: &Command, given: &[OsString]) -> Error {
    let words: Vec<&str> = given.iter().skip(1).filter_map(|word| word.to_str()).collect();
    let wrong = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.as_str()),
        _ => None,
    };
    let hint = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            wrong(ContextKind::InvalidSubcommand).and_then(|word| in_place_of_command(word, command, &words))
        }
        ErrorKind::UnknownArgument => {
            wrong(ContextKind::InvalidArg).and_then(|word| in_place_of_argument(word, &words))
        }
        _ => None,
    };
    if let Some(hint) = hint {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(hint)]));
    }
    error
}

/// What to write in place of a word that is no command.
fn in_place_of_command(word: &str, command: &Command, words: &[&str]) -> Option<String> {
    let is_command = |name: &&&str| command.get_subcommands().any(|known| known.get_name() == **name);
    match (word, files::extension(Path::new(word)).as_deref()) {
        ("help", _) => Some(match words.iter().find(is_command) {
            Some(name) => format!("the help on a command is `coupler-atlas {name} --help`"),
            None => "the help is `coupler-atlas --help`, and on a command `coupler-atlas find --help`".to_owned(),
        }),
        (_, Some("toml")) => Some(format!("a manifest is drawn with `coupler-atlas render {word}`")),
        (_, Some("svg" | "csv")) => Some(format!("a path is searched for with `coupler-atlas find {word}`")),
        _ => None,
    }
}

/// What to write in place of an argument that a command does not have.
fn in_place_of_argument(word: &str, words: &[&str]) -> Option<String> {
    // `-format` is taken for the letters of several options.
    let is_long = |given: &&&str| given.len() > 2 && !given.starts_with("--") && given.starts_with(word);
    if let Some(given) = words.iter().find(is_long).filter(|_| word.starts_with('-')) {
        return Some(format!("options of several letters have two hyphens: -{given}"));
    }
    let at = words.iter().position(|given| *given == word)?;
    let option = words[..at].iter().rposition(|given| given.starts_with('-'))?;
    let listed = words.get(option + 1..=at).filter(|_| words[option] == "--format")?;
    Some(format!("several formats are divided by commas: --format {}", listed.join(",")))
}
