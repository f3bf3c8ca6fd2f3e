//! Comparisons with measures whose values are words, which expressions do not have.

use super::{ALL, BOOLEANS};
use crate::expression::{Error, Expression};

/// Parses a condition on curves. One that compares a measure with a word, as in `class == crank-rocker`, is an error that names the
/// condition to write in its place.
///
/// # Errors
/// It is no expression, or makes such a comparison.
pub fn parse_condition(text: &str) -> Result<Expression, Error> {
    word_comparison(text).map_or_else(|| Expression::parse(text), Err)
}

/// The error of the first comparison of a measure with a word, if there is one.
fn word_comparison(text: &str) -> Option<Error> {
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let places = |name: &'static str| text.match_indices(name).map(move |(at, _)| (at, name));
    let mut compared =
        ALL.iter().filter(|measure| measure.is_word).flat_map(|measure| places(measure.name)).filter_map(
            |(at, name)| {
                let (before, after) = (&text[..at], &text[at + name.len()..]);
                let operator =
                    ["==", "!=", "=", "is "].into_iter().find(|operator| after.trim_start().starts_with(operator))?;
                let is_whole = !before.ends_with(is_of_name) && !after.starts_with(is_of_name);
                let value = after.trim_start()[operator.len()..].trim_start().trim_start_matches(['"', '\'']);
                let word = &value[..value.find(|c: char| !is_of_name(c) && c != '-').unwrap_or(value.len())];
                is_whole.then_some((at, name, operator, word))
            },
        );
    let (at, name, operator, word) = compared.next()?;
    let not = if operator == "!=" { "not " } else { "" };
    let meant = word.to_lowercase().replace('_', "-");
    let of_measure = || BOOLEANS.iter().filter(|boolean| boolean.measure == name);
    let help = match of_measure().find(|boolean| boolean.word == meant) {
        Some(boolean) => format!("write `{not}{}`", boolean.name),
        None if of_measure().next().is_some() => {
            let names: Vec<String> = of_measure().map(|boolean| format!("`{}`", boolean.name)).collect();
            format!("the conditions on it are {}", names.join(", "))
        }
        None => "conditions have numbers: use one such as `symmetry_residual`".to_owned(),
    };
    Some(Error::new(at..at + name.len(), format!("`{name}` is a word, and cannot be compared"), help))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comparisons_with_words_name_the_condition() {
        let help = |text: &str| parse_condition(text).unwrap_err().help;
        for text in [
            "class = crank-rocker",
            "class == crank_rocker",
            "area > 2 and class=='Crank-Rocker'",
            "class is \"crank-rocker\"",
        ] {
            assert_eq!(help(text), "write `is_crank_rocker`", "{text}");
        }
        assert_eq!(help("class != drag-link"), "write `not is_drag_link`");
        assert_eq!(help("is_full_turn == yes"), "write `is_full_turn`");
        assert!(help("class == rocker").contains("`is_crank_rocker`, `is_rocker_crank`"));
        assert!(help("symmetry = mirror").contains("symmetry_residual"));
        assert_eq!(parse_condition("1 and class = 2").unwrap_err().span, 6..11);
        for text in ["is_crank_rocker and area > 2", "not is_full_turn", "symmetry_residual == 0"] {
            assert!(parse_condition(text).is_ok(), "{text}");
        }
    }
}
