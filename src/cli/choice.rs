//! Names given on the command line, one of several.

use coupler_curves::problem::suggestion;

/// Finds the value of a name, which may be surrounded by blanks, as in `--format "svg, png"`; `noun` says what it names.
///
/// # Errors
/// A message with the known names.
pub(super) fn parse<T: Copy>(noun: &str, name: &str, known: &[(&str, T)]) -> Result<T, String> {
    let name = name.trim();
    let found = known.iter().find(|(other, _)| *other == name).map(|(_, value)| *value);
    found.ok_or_else(|| unknown(noun, name, &known.iter().map(|(name, _)| *name).collect::<Vec<_>>()))
}

/// The message for a name that is none of those known.
pub(super) fn unknown(noun: &str, name: &str, known: &[&str]) -> String {
    match name.trim() {
        "" => format!("the name of a {noun} is missing: {}", suggestion("", known)),
        name => format!("unknown {noun} `{name}`: {}", suggestion(name, known)),
    }
}
